//! Tasks made side by side.

use super::{Ledger, Make, Recorder, RunnerError};
use crate::campaign::{Row, fingerprint};
use crate::listener::Listener;
use brinell::plausibility::after;
use brinell::result::{Quantity, RunResult, finish};
use brinell::scenario::Scenario;
use brinell::simulate::{End, Observer, Simulation};
use std::collections::HashSet;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

/// A point to be run.
#[derive(Debug, Clone, PartialEq)]
pub struct Task {
    /// Key and value of what it sets.
    pub settings: Vec<(String, String)>,
    /// Of its scenario.
    pub fingerprint: String,
    /// Simulated time, s.
    pub duration_s: f64,
}

impl Task {
    /// The scenario that settings made.
    pub fn new(settings: Vec<(String, String)>, scenario: &Scenario) -> Self {
        Self { fingerprint: fingerprint(scenario), duration_s: scenario.simulation.duration_s, settings }
    }
}

/// What is to be run of `tasks`: those that are not done, once where settings mean the same.
pub fn to_run<'a>(tasks: impl IntoIterator<Item = &'a Task>, is_done: impl Fn(&Task) -> bool) -> Vec<Task> {
    let mut seen = HashSet::new();
    let open = tasks.into_iter().filter(|task| !is_done(task) && seen.insert(&task.fingerprint));
    open.cloned().collect()
}

/// Observes a run beside its findings.
pub trait Beside<E>: Observer {
    /// Keeps what its row does not hold, and gives numbers of its own for the row. The run came to its end.
    ///
    /// # Errors
    /// Where that cannot be kept.
    fn finished(self: Box<Self>, finished: &RunResult) -> Result<Vec<Quantity>, E>;
}

/// What makes runs of tasks.
pub trait Work: Sync {
    /// Why it cannot go on.
    type Error: From<RunnerError> + Send;

    /// The scenario of a task. It is made by the thread that runs it, so that memory goes with the runs in progress.
    ///
    /// # Errors
    /// Where there is none any more.
    fn scenario(&self, task: &Task) -> Result<Scenario, Self::Error>;

    /// What a row of that scenario is filed under: everything that its numbers depend on.
    fn fingerprint(&self, scenario: &Scenario) -> String {
        fingerprint(scenario)
    }

    /// Where the task's signals go, if anywhere.
    ///
    /// # Errors
    /// Where they cannot go there.
    fn signals(&self, _: &Task, _: &Simulation) -> Result<Box<Make>, Self::Error> {
        Ok(Box::new(|| Ok(Vec::new())))
    }

    /// What else observes the task's run, if anything.
    fn beside(&self, _: &Task, _: &Simulation) -> Option<Box<dyn Beside<Self::Error> + '_>> {
        None
    }
}

/// Runs tasks side by side, up to `threads` at a time, each on the disk as soon as it is done. A run that fails is a
/// row like another; only files that cannot be read or written end the campaign. Breaks where `listener` broke a run
/// off.
///
/// # Errors
/// Where files cannot be read or written: what was finished stays.
pub fn run<W: Work>(
    tasks: &[Task],
    work: &W,
    ledger: &mut Ledger,
    threads: NonZeroUsize,
    listener: &dyn Listener,
) -> Result<ControlFlow<()>, W::Error> {
    let (mut flow, mut failure) = (ControlFlow::Continue(()), None);
    let stop = AtomicBool::new(false);
    brinell::many::each(
        tasks.len(),
        threads,
        |k| one(k, &tasks[k], work, listener, &stop),
        |k, result| {
            let kept = match result {
                Ok(Some(row)) if failure.is_none() => {
                    let failed = row.result.as_ref().err().cloned();
                    let kept = ledger.add(row).map_err(W::Error::from);
                    if kept.is_ok() {
                        listener.ended(k, failed.as_deref());
                    }
                    kept
                }
                Ok(Some(_)) => Ok(()),
                Ok(None) => {
                    flow = ControlFlow::Break(());
                    Ok(())
                }
                Err(error) => Err(error),
            };
            failure = failure.take().or(kept.err());
            if failure.is_some() {
                stop.store(true, Ordering::Relaxed);
            }
        },
    );
    match failure {
        Some(failure) => Err(failure),
        None => Ok(flow),
    }
}

/// One task; `None` where it was broken off.
fn one<W: Work>(
    k: usize,
    task: &Task,
    work: &W,
    listener: &dyn Listener,
    stop: &AtomicBool,
) -> Result<Option<Row>, W::Error> {
    if stop.load(Ordering::Relaxed) {
        return Ok(None);
    }
    let row = |result, warnings| Row {
        settings: task.settings.clone(),
        scenario: task.fingerprint.clone(),
        version: brinell::VERSION.to_owned(),
        result,
        warnings,
    };
    let scenario = work.scenario(task)?;
    if work.fingerprint(&scenario) != task.fingerprint {
        return Err(RunnerError::Changed.into());
    }
    let simulation = match Simulation::unchecked(&scenario) {
        Ok(simulation) => simulation,
        Err(error) => return Ok(Some(row(Err(error.to_string()), Vec::new()))),
    };
    let files = work.signals(task, &simulation)?;
    let mut hearer = listener.begin(k, task.duration_s);
    let mut beside = work.beside(task, &simulation);
    let mut recorder = Recorder::new(&simulation, &*files, hearer.as_mut())
        .map_err(RunnerError::from)?
        .beside(beside.as_deref_mut().map(|other| other as &mut dyn Observer));
    let finished = finish(scenario, simulation, &mut recorder);
    let files = recorder.close(&finished.outcome.end, false);
    for file in files.map_err(RunnerError::from)? {
        file.publish().map_err(RunnerError::from)?;
    }
    let numbers = match &finished.outcome.end {
        End::Stopped => {
            stop.store(true, Ordering::Relaxed);
            return Ok(None);
        }
        End::Failed(error) => Err(error.to_string()),
        End::Complete => {
            let besides = beside.map_or(Ok(Vec::new()), |b| b.finished(&finished))?;
            Ok([finished.quantities(), besides].concat())
        }
    };
    let RunResult { scenario, simulation, outcome, findings } = &finished;
    let warnings = if numbers.is_ok() { after(scenario, simulation, outcome, findings) } else { Vec::new() };
    Ok(Some(row(numbers, warnings)))
}
