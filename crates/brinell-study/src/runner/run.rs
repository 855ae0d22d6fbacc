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
    let make = |k: usize| one(k, &tasks[k], work, listener);
    side_by_side(tasks.len(), threads, make, |k, row| {
        let failed = row.result.as_ref().err().cloned();
        ledger.add(row)?;
        listener.ended(k, failed.as_deref());
        Ok(())
    })
}

/// Makes each of `count` things, up to `threads` at a time, and hands it to `keep` on this thread. Once one is broken
/// off (`None`) or an error is there, no other begins; the first error is given.
pub(crate) fn side_by_side<T: Send, E: Send>(
    count: usize,
    threads: NonZeroUsize,
    make: impl Fn(usize) -> Result<Option<T>, E> + Sync,
    mut keep: impl FnMut(usize, T) -> Result<(), E>,
) -> Result<ControlFlow<()>, E> {
    let mut outcome = Ok(ControlFlow::Continue(()));
    let stop = AtomicBool::new(false);
    let make = |k| {
        let made = if stop.load(Ordering::Relaxed) { Ok(None) } else { make(k) };
        // A full disk fails every run to come as well.
        stop.fetch_or(!matches!(made, Ok(Some(_))), Ordering::Relaxed);
        made
    };
    brinell::many::each(count, threads, make, |k, made| {
        let Ok(flow) = &mut outcome else { return };
        match made.and_then(|made| made.map(|made| keep(k, made)).transpose()) {
            Ok(Some(())) => {}
            Ok(None) => *flow = ControlFlow::Break(()),
            Err(error) => {
                stop.store(true, Ordering::Relaxed);
                outcome = Err(error);
            }
        }
    });
    outcome
}

/// Run `k` to its end, observed by `beside`; its rows go to the files that `make` begins, which are there where it was
/// not broken off.
pub(crate) fn observed(
    k: usize,
    (scenario, simulation): (Scenario, Simulation),
    make: &Make,
    beside: Option<&mut dyn Observer>,
    listener: &dyn Listener,
) -> Result<RunResult, RunnerError> {
    let mut hearer = listener.begin(k, scenario.simulation.duration_s);
    let mut recorder = Recorder::new(&simulation, make, &mut *hearer)?.beside(beside.map(|beside| beside as _));
    let finished = finish(scenario, simulation, &mut recorder);
    for file in recorder.close(&finished.outcome.end, false)? {
        file.publish()?;
    }
    Ok(finished)
}

/// One task; `None` where it was broken off.
fn one<W: Work>(k: usize, task: &Task, work: &W, listener: &dyn Listener) -> Result<Option<Row>, W::Error> {
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
    let mut beside = work.beside(task, &simulation);
    let observer = beside.as_deref_mut().map(|other| other as &mut dyn Observer);
    let finished = observed(k, (scenario, simulation), &*files, observer, listener)?;
    let RunResult { scenario, simulation, outcome, findings } = &finished;
    Ok(match &outcome.end {
        End::Stopped => None,
        End::Failed(error) => Some(row(Err(error.to_string()), Vec::new())),
        End::Complete => {
            let warnings = after(scenario, simulation, outcome, findings);
            let besides = beside.map_or(Ok(Vec::new()), |b| b.finished(&finished))?;
            Some(row(Ok([finished.quantities(), besides].concat()), warnings))
        }
    })
}
