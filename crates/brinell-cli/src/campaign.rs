//! Many runs with a journal: what is finished is on the disk, and is not run again.
//!
//! A folder's `journal.jsonl` begins with what it is the journal of; then comes one line a finished point, a [`Row`]. A point counts as
//! finished where a row has the fingerprint of its scenario and the version of this program.

use crate::failure::Failure;
use crate::progress::{Joint, Progress};
use crate::recorder::Recorder;
use brinell::channel::Frame;
use brinell::result::{Finished, Quantity, finish};
use brinell::scenario::Scenario;
use brinell::simulate::{End, Observer, Simulation, SolverWork};
use brinell_io::{Journal, SignalWriter};
use brinell_study::campaign::{Row, fingerprint};
use serde_json::Value;
use std::collections::{HashMap, HashSet};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

/// Name of the journal within its folder.
pub(crate) const JOURNAL: &str = "journal.jsonl";

/// The points that a journal holds.
#[derive(Default)]
pub(crate) struct Kept {
    rows: HashMap<String, Row>,
    /// Scenarios that another version of this program finished.
    outdated: HashSet<String>,
}

impl Kept {
    /// What is in a folder's journal, which stays as it is; nothing where there is none.
    pub(crate) fn look(folder: &Path) -> Result<Self, Failure> {
        Ok(Self::of(&Journal::read(folder.join(JOURNAL))?))
    }

    fn of(lines: &[Value]) -> Self {
        let mut kept = Self::default();
        for row in lines.iter().filter_map(Row::from_json) {
            if row.version == brinell::VERSION {
                kept.rows.insert(row.scenario.clone(), row);
            } else {
                kept.outdated.insert(row.scenario);
            }
        }
        kept
    }

    /// The row of a scenario that is finished.
    pub(crate) fn row(&self, fingerprint: &str) -> Option<&Row> {
        self.rows.get(fingerprint)
    }

    /// Scenarios that are finished.
    pub(crate) fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether a scenario is finished, but by another version of this program.
    pub(crate) fn is_outdated(&self, fingerprint: &str) -> bool {
        self.outdated.contains(fingerprint) && !self.rows.contains_key(fingerprint)
    }
}

/// A folder's journal, open for more, and the points that are finished.
pub(crate) struct Ledger {
    journal: Journal,
    pub(crate) kept: Kept,
}

impl Ledger {
    /// Opens the journal of `folder`, which exists, for the campaign that `header` describes: an object with `campaign`, its kind, and
    /// whatever tells it from others. Another campaign's journal is refused, with `words` for what to do; `extend` makes it this one's.
    pub(crate) fn open(
        folder: &Path,
        header: &Value,
        extend: bool,
        words: impl Fn(&Value) -> String,
    ) -> Result<Self, Failure> {
        let (mut journal, lines) = Journal::open(folder.join(JOURNAL))?;
        let is_header = |line: &&Value| line.get("campaign").is_some();
        let latest = lines.iter().rfind(is_header);
        match latest {
            Some(other) if other["campaign"] != header["campaign"] => {
                return Err(Failure::Usage(words(other)));
            }
            Some(other) if other != header && !extend => {
                return Err(Failure::Usage(words(other)));
            }
            Some(other) if other == header => {}
            None if !lines.is_empty() => return Err(Failure::Usage(words(&Value::Null))),
            _ => journal.append(header)?,
        }
        let kept = Kept::of(&lines);
        Ok(Self { journal, kept })
    }

    fn add(&mut self, row: Row) -> Result<(), Failure> {
        self.journal.append(&row.to_json())?;
        self.kept.rows.insert(row.scenario.clone(), row);
        Ok(())
    }
}

/// A point to be run.
#[derive(Debug, Clone)]
pub(crate) struct Task {
    /// Key and value of what it sets.
    pub(crate) settings: Vec<(String, String)>,
    /// Of its scenario.
    pub(crate) fingerprint: String,
    /// Simulated time, s.
    pub(crate) duration_s: f64,
}

/// Observes a run beside its findings.
pub(crate) trait Beside: Observer {
    /// Keeps what its row does not hold, and gives numbers of its own for the row. The run came to its end.
    fn finished(self: Box<Self>, finished: &Finished) -> Result<Vec<Quantity>, Failure>;
}

/// What makes runs of tasks.
pub(crate) trait Work: Sync {
    /// The scenario of a task. It is made by the thread that runs it, so that memory goes with the runs in progress.
    fn scenario(&self, task: &Task) -> Result<Scenario, Failure>;

    /// What a row of that scenario is filed under: everything that its numbers depend on.
    fn fingerprint(&self, scenario: &Scenario) -> String {
        fingerprint(scenario)
    }

    /// Where the task's signals go, if anywhere.
    fn signals(&self, _: &Task, _: &Simulation) -> Result<Option<Box<dyn SignalWriter>>, Failure> {
        Ok(None)
    }

    /// Which of [`Simulation::filtered`] it wants to hear whole, if any.
    fn hears(&self) -> Option<usize> {
        None
    }

    /// What else observes the task's run, if anything.
    fn beside(&self, _: &Task, _: &Simulation) -> Option<Box<dyn Beside>> {
        None
    }

    /// Keeps of a run that came to its end what its row does not hold, and gives numbers of its own for the row. `heard` is what was asked
    /// for, from when the run had settled.
    fn finished(&self, _: &Task, _: &Finished, _heard: &[f64]) -> Result<Vec<Quantity>, Failure> {
        Ok(Vec::new())
    }
}

/// How the tasks went.
pub(crate) struct Went {
    /// Some were not run, or not to their end.
    pub(crate) interrupted: bool,
}

/// Runs tasks side by side, up to `threads` at a time, each on the disk as soon as it is done. A run that fails is a row like
/// another; only files that cannot be read or written end the campaign.
pub(crate) fn run(
    tasks: &[Task],
    work: &impl Work,
    ledger: &mut Ledger,
    threads: NonZeroUsize,
    quiet: bool,
    stop: &AtomicBool,
) -> Result<Went, Failure> {
    let total = tasks.iter().map(|task| task.duration_s).sum();
    let mut joint = Joint::new(tasks.len(), total, quiet);
    run_within(tasks, work, ledger, threads, &mut joint, stop)
}

/// [`run()`] as a part of the work that `joint` shows.
pub(crate) fn run_within(
    tasks: &[Task],
    work: &impl Work,
    ledger: &mut Ledger,
    threads: NonZeroUsize,
    joint: &mut Joint,
    stop: &AtomicBool,
) -> Result<Went, Failure> {
    let bar = joint.bar();
    let (mut interrupted, mut failure) = (false, None);
    brinell::many::each(
        tasks.len(),
        threads,
        |k| {
            one(
                &tasks[k],
                work,
                Joint::part(&bar, tasks[k].duration_s),
                stop,
            )
        },
        |_, result| {
            match result {
                Ok(Some(row)) => {
                    if failure.is_none() {
                        failure = ledger.add(row).err();
                    }
                }
                Ok(None) => interrupted = true,
                Err(error) => failure = failure.take().or(Some(error)),
            }
            if failure.is_some() {
                stop.store(true, Ordering::Relaxed);
            }
            joint.ended(&[], Path::new(""));
        },
    );
    match failure {
        Some(failure) => Err(failure),
        None => Ok(Went { interrupted }),
    }
}

/// One task; `None` where it was broken off.
fn one(
    task: &Task,
    work: &impl Work,
    progress: Progress,
    stop: &AtomicBool,
) -> Result<Option<Row>, Failure> {
    if stop.load(Ordering::Relaxed) {
        return Ok(None);
    }
    let row = |result| Row {
        settings: task.settings.clone(),
        scenario: task.fingerprint.clone(),
        version: brinell::VERSION.to_owned(),
        result,
    };
    let scenario = work.scenario(task)?;
    if work.fingerprint(&scenario) != task.fingerprint {
        return Err(Failure::Usage(
            "a file of the scenario changed since the campaign began; the same command begins anew with what it holds now".into(),
        ));
    }
    let simulation = match Simulation::new(&scenario) {
        Ok(simulation) => simulation,
        Err(error) => return Ok(Some(row(Err(error.to_string())))),
    };
    let writers = work.signals(task, &simulation)?;
    let mut recorder = Recorder::new(&simulation, writers.into_iter().collect(), progress, stop)
        .hearing(work.hears());
    let mut beside = work.beside(task, &simulation);
    let finished = match &mut beside {
        Some(other) => {
            let mut both = Both(&mut recorder, other.as_mut());
            finish(scenario, simulation, &mut both)
        }
        None => finish(scenario, simulation, &mut recorder),
    };
    let heard = recorder.close(&finished.outcome.end, false)?;
    for file in heard.files {
        file.publish()?;
    }
    let numbers = match &finished.outcome.end {
        End::Stopped => return Ok(None),
        End::Failed(error) => Err(error.to_string()),
        End::Complete => {
            let settled = finished.findings.from * finished.simulation.sample_rate();
            let settled = heard.signal.get(settled.ceil() as usize..).unwrap_or(&[]);
            let more = work.finished(task, &finished, settled)?;
            let besides = beside.map_or(Ok(Vec::new()), |b| b.finished(&finished))?;
            Ok([finished.quantities(), more, besides].concat())
        }
    };
    Ok(Some(row(numbers)))
}

/// Two observers of one run; the first alone is told the time.
struct Both<'a>(&'a mut dyn Observer, &'a mut dyn Observer);

impl Observer for Both<'_> {
    fn step(&mut self, frame: &Frame) {
        self.0.step(frame);
        self.1.step(frame);
    }

    fn sample(&mut self, index: u64, frame: &Frame) {
        self.0.sample(index, frame);
        self.1.sample(index, frame);
    }

    fn row(&mut self, index: u64, row: &[f64], filtered: &[f64]) -> ControlFlow<()> {
        self.1.row(index, row, filtered)?;
        self.0.row(index, row, filtered)
    }

    fn progress(&mut self, t: f64, work: &SolverWork) -> ControlFlow<()> {
        self.0.progress(t, work)
    }
}
