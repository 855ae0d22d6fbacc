//! The observer of a recorded run: writes rows to files, and reports the time to its listener.

use brinell::channel::Frame;
use brinell::simulate::{End, Observer, Simulation, SolverWork};
use brinell_io::{Complete, IoError, Outcome, SignalWriter};
use std::ops::ControlFlow;

/// Records a run for its files and its listener.
pub struct Recorder<'a> {
    row: Vec<f64>,
    sample_rate: f64,
    make: &'a Make,
    writers: Vec<Box<dyn SignalWriter>>,
    failed: Option<IoError>,
    listener: &'a mut At<'a>,
    beside: Option<&'a mut dyn Observer>,
}

/// Gets the simulated time that the run reached, s, and may break it off.
type At<'a> = dyn FnMut(f64) -> ControlFlow<()> + 'a;

/// Begins the files of a run.
pub type Make = dyn Fn() -> Result<Vec<Box<dyn SignalWriter>>, IoError>;

impl<'a> Recorder<'a> {
    /// Rows go to every file that `make` begins; `listener` may break the run off.
    ///
    /// # Errors
    /// Where a file cannot be begun.
    pub fn new(simulation: &Simulation, make: &'a Make, listener: &'a mut At<'a>) -> Result<Self, IoError> {
        Ok(Self {
            row: vec![0.0; simulation.channels().len() + 1],
            sample_rate: simulation.sample_rate(),
            make,
            writers: make()?,
            failed: None,
            listener,
            beside: None,
        })
    }

    /// Another observer of the same run. The time goes to the listener alone.
    pub fn beside(mut self, other: Option<&'a mut dyn Observer>) -> Self {
        self.beside = other;
        self
    }

    /// Ends the files as the run ended, up to their names. A run that was broken off leaves whole files of the part
    /// that was run, which say so, or none: `keep_stopped` decides.
    ///
    /// # Errors
    /// Where a file could not be written.
    pub fn close(self, end: &End, keep_stopped: bool) -> Result<Vec<Complete>, IoError> {
        if let Some(error) = self.failed {
            return Err(error);
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
        Ok(files)
    }
}

impl Observer for Recorder<'_> {
    fn again(&mut self, simulation: &Simulation) -> ControlFlow<()> {
        if let Some(beside) = &mut self.beside {
            beside.again(simulation)?;
        }
        // The files begun are removed first: their names are locked until then.
        self.writers.clear();
        match (self.make)() {
            Ok(writers) => self.writers = writers,
            Err(error) => self.failed = Some(error),
        }
        ControlFlow::Continue(())
    }

    fn step(&mut self, frame: &Frame) {
        if let Some(beside) = &mut self.beside {
            beside.step(frame);
        }
    }

    fn sample(&mut self, index: u64, frame: &Frame) {
        if let Some(beside) = &mut self.beside {
            beside.sample(index, frame);
        }
    }

    fn row(&mut self, index: u64, row: &[f64], filtered: &[f64]) -> ControlFlow<()> {
        if let Some(beside) = &mut self.beside {
            beside.row(index, row, filtered)?;
        }
        if self.failed.is_some() {
            return ControlFlow::Break(());
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
        (self.listener)(t)
    }
}
