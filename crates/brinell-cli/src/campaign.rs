//! What commands of many runs share: the journal of their folder, and runs shown on a bar.

use crate::failure::Failure;
use crate::progress::{Joint, Shown};
use brinell_study::listener::{Listener, RunListener};
use brinell_study::runner::{self, Ledger, RunnerError, Task, Work};
use serde_json::Value;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::sync::{Mutex, PoisonError};

/// [`Ledger::open`]; another campaign's journal is refused with `words` for what to do.
pub(crate) fn ledger(
    folder: &Path,
    header: &Value,
    extend: bool,
    words: impl Fn(&Value) -> String,
) -> Result<Ledger, Failure> {
    Ledger::open(folder, header, extend).map_err(|error| match error {
        RunnerError::OtherCampaign(other) => Failure::Usage(words(&other)),
        other => other.into(),
    })
}

/// [`runner::run`] with a bar of its own; `stop` breaks it off.
pub(crate) fn run(
    tasks: &[Task],
    work: &impl Work<Error = Failure>,
    ledger: &mut Ledger,
    threads: NonZeroUsize,
    quiet: bool,
    stop: &AtomicBool,
) -> Result<ControlFlow<()>, Failure> {
    let total = tasks.iter().map(|task| task.duration_s).sum();
    let mut joint = Joint::new(tasks.len(), total, quiet);
    run_within(tasks, work, ledger, threads, &mut joint, stop)
}

/// [`run()`] as a part of the work that `joint` shows.
pub(crate) fn run_within(
    tasks: &[Task],
    work: &impl Work<Error = Failure>,
    ledger: &mut Ledger,
    threads: NonZeroUsize,
    joint: &mut Joint,
    stop: &AtomicBool,
) -> Result<ControlFlow<()>, Failure> {
    let terminal = Terminal { joint: Mutex::new(joint), stop };
    runner::run(tasks, work, ledger, threads, &terminal)
}

impl From<RunnerError> for Failure {
    fn from(error: RunnerError) -> Self {
        match error {
            RunnerError::Io(error) => Self::Write(error),
            RunnerError::OtherCampaign(_) | RunnerError::Changed => Self::Usage(error.to_string()),
        }
    }
}

/// Shows runs on one bar, and listens for Ctrl-C.
struct Terminal<'a> {
    joint: Mutex<&'a mut Joint>,
    stop: &'a AtomicBool,
}

impl Listener for Terminal<'_> {
    fn begin(&self, _: usize, duration_s: f64) -> Box<dyn RunListener + '_> {
        let joint = self.joint.lock().unwrap_or_else(PoisonError::into_inner);
        let progress = Joint::part(&joint.bar(), duration_s);
        Box::new(Shown::new(progress, self.stop))
    }

    fn ended(&self, _: usize, _: Option<&str>) {
        let mut joint = self.joint.lock().unwrap_or_else(PoisonError::into_inner);
        joint.ended(&[], Path::new(""));
    }
}
