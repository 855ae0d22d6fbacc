//! What commands of many runs share: the journal of their folder, and runs shown on a bar.

use crate::failure::Failure;
use crate::progress::Joint;
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
        other @ RunnerError::OtherKernel { .. } => Failure::Usage(format!("{}: {other}", folder.display())),
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
    runner::run(tasks, work, ledger, threads, &Terminal::new(tasks.len(), total, quiet, stop))
}

impl From<RunnerError> for Failure {
    fn from(error: RunnerError) -> Self {
        match error {
            RunnerError::Io(error) => Self::Write(error),
            other => Self::Usage(other.to_string()),
        }
    }
}

/// Shows runs on one bar, listens for Ctrl-C, and keeps why runs failed.
pub(crate) struct Terminal<'a> {
    joint: Joint,
    stop: &'a AtomicBool,
    /// Simulated time of a run that was there before, s.
    each_s: f64,
    failures: Mutex<Vec<(usize, String)>>,
}

impl<'a> Terminal<'a> {
    /// For `runs` runs of `duration_s` seconds together; `stop` breaks them off.
    pub(crate) fn new(runs: usize, duration_s: f64, quiet: bool, stop: &'a AtomicBool) -> Self {
        let each_s = duration_s / runs.max(1) as f64;
        Self { joint: Joint::new(runs, duration_s, quiet), stop, each_s, failures: Mutex::default() }
    }

    /// Which runs failed, and why.
    pub(crate) fn failures(self) -> Vec<(usize, String)> {
        self.failures.into_inner().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Listener for Terminal<'_> {
    fn begin(&self, _: usize, duration_s: f64) -> RunListener<'_> {
        let mut part = self.joint.part(duration_s, self.stop);
        Box::new(move |t| part.at(t))
    }

    fn before(&self, runs: usize) {
        (0..runs).for_each(|_| self.joint.done_before(self.each_s));
    }

    fn ended(&self, run: usize, failed: Option<&str>) {
        if let Some(reason) = failed {
            let mut all = self.failures.lock().unwrap_or_else(PoisonError::into_inner);
            all.push((run, reason.to_owned()));
        }
        self.joint.ended(&[], Path::new(""));
    }
}
