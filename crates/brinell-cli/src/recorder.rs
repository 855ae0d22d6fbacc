//! What a run is heard with: rows to files, one filtered signal kept where it is asked for, time to the bar, Ctrl-C to the run.

use crate::failure::Failure;
use crate::progress::Progress;
use brinell::simulate::{End, Observer, Simulation, SolverWork};
use brinell_io::{Complete, IoError, Outcome, SignalWriter};
use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

pub(crate) struct Recorder<'a> {
    row: Vec<f64>,
    sample_rate: f64,
    writers: Vec<Box<dyn SignalWriter>>,
    failed: Option<IoError>,
    hears: Option<usize>,
    heard: Vec<f64>,
    progress: Progress,
    stop: &'a AtomicBool,
}

impl<'a> Recorder<'a> {
    /// Rows go to every one of `writers`; `stop` breaks the run off.
    pub(crate) fn new(
        simulation: &Simulation,
        writers: Vec<Box<dyn SignalWriter>>,
        progress: Progress,
        stop: &'a AtomicBool,
    ) -> Self {
        Self {
            row: vec![0.0; simulation.channels().len() + 1],
            sample_rate: simulation.sample_rate(),
            writers,
            failed: None,
            hears: None,
            heard: Vec::new(),
            progress,
            stop,
        }
    }

    /// Keeps that one of [`Simulation::filtered`] whole, in memory.
    pub(crate) fn hearing(mut self, which: Option<usize>) -> Self {
        self.hears = which;
        self
    }

    /// Ends the files as the run ended, up to their names. Gives them and what was heard. A run that was broken off leaves whole files of the
    /// part that was run, which say so, or none: `keep_stopped` decides.
    pub(crate) fn close(self, end: &End, keep_stopped: bool) -> Result<Heard, Failure> {
        self.progress.finish();
        if let Some(error) = self.failed {
            return Err(error.into());
        }
        let outcome = match end {
            End::Complete => Outcome::Complete,
            End::Stopped => Outcome::Partial("interrupted".into()),
            End::Failed(error) => Outcome::Partial(error.to_string()),
        };
        let mut files = Vec::new();
        if keep_stopped || *end != End::Stopped {
            for writer in self.writers {
                files.push(writer.complete(outcome.clone())?);
            }
        }
        Ok(Heard {
            elapsed: self.progress.elapsed(),
            files,
            signal: self.heard,
        })
    }
}

/// What is left of a run beside its findings.
pub(crate) struct Heard {
    /// Wall time, s.
    pub(crate) elapsed: f64,
    /// Files of signals, to be published.
    pub(crate) files: Vec<Complete>,
    /// The signal that was asked for, from t = 0.
    pub(crate) signal: Vec<f64>,
}

impl Observer for Recorder<'_> {
    fn row(&mut self, index: u64, row: &[f64], filtered: &[f64]) -> ControlFlow<()> {
        if let Some(x) = self.hears.and_then(|k| filtered.get(k)) {
            self.heard.push(*x);
        }
        if self.writers.is_empty() {
            return ControlFlow::Continue(());
        }
        self.row[0] = index as f64 / self.sample_rate;
        self.row[1..].copy_from_slice(row);
        for writer in &mut self.writers {
            if let Err(error) = writer.write_row(&self.row) {
                self.failed = Some(error);
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    }

    fn progress(&mut self, t: f64, _: &SolverWork) -> ControlFlow<()> {
        self.progress.at(t);
        brinell::many::go_on(self.stop)
    }
}
