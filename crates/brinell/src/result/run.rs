//! A scenario from start to findings.

use crate::channel::Frame;
use crate::observe::{Findings, Watch};
use crate::scenario::Scenario;
use crate::simulate::{End, Observer, Outcome, RunError, Simulation, SolverWork};
use std::ops::ControlFlow;

/// A run that is over, with all that was found in it.
#[derive(Debug)]
pub struct Finished {
    /// What was run.
    pub scenario: Scenario,
    /// The same, made a model of.
    pub simulation: Simulation,
    /// How it went.
    pub outcome: Outcome,
    /// What was gathered.
    pub findings: Findings,
}

impl Finished {
    /// The run as named numbers.
    pub fn quantities(&self) -> Vec<super::Quantity> {
        super::quantities(
            &self.scenario,
            &self.simulation,
            &self.outcome,
            &self.findings,
        )
    }
}

/// Why a run did not come to its end.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Unfinished {
    /// It could not.
    #[error(transparent)]
    Failed(#[from] RunError),
    /// Somebody stopped it.
    #[error("stopped before its end")]
    Stopped,
}

/// Runs a simulation and gathers its findings; `besides` gets every call of an observer too, and may break it off.
pub fn finish(scenario: Scenario, simulation: Simulation, besides: &mut dyn Observer) -> Finished {
    let mut both = Both {
        watch: Watch::new(&scenario, &simulation),
        simulation: &simulation,
        besides,
    };
    let outcome = simulation.run(&mut both);
    let findings = both.watch.finish(&simulation);
    Finished {
        scenario,
        simulation,
        outcome,
        findings,
    }
}

/// Runs one scenario to its end. `progress` is told the simulated time reached, s, and may break off.
///
/// # Errors
/// Where the run fails or is broken off: there is no half-finished run among finished ones.
pub fn run(
    scenario: Scenario,
    progress: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<Finished, Unfinished> {
    let simulation = Simulation::new(&scenario)?;
    whole(finish(scenario, simulation, &mut Told(progress)))
}

/// Only what came to its end.
fn whole(finished: Finished) -> Result<Finished, Unfinished> {
    match &finished.outcome.end {
        End::Complete => Ok(finished),
        End::Stopped => Err(Unfinished::Stopped),
        End::Failed(error) => Err(Unfinished::Failed(error.clone())),
    }
}

struct Both<'a> {
    watch: Watch,
    simulation: &'a Simulation,
    besides: &'a mut dyn Observer,
}

impl Observer for Both<'_> {
    fn step(&mut self, frame: &Frame) {
        self.watch.step(frame);
        self.besides.step(frame);
    }

    fn sample(&mut self, index: u64, frame: &Frame) {
        self.watch.sample(frame);
        self.besides.sample(index, frame);
    }

    fn row(&mut self, index: u64, row: &[f64], filtered: &[f64]) -> ControlFlow<()> {
        self.watch.row(self.simulation, index, row, filtered);
        self.besides.row(index, row, filtered)
    }

    fn progress(&mut self, t: f64, work: &SolverWork) -> ControlFlow<()> {
        self.besides.progress(t, work)
    }
}

/// Hears nothing but the time.
struct Told<F>(F);

impl<F: FnMut(f64) -> ControlFlow<()>> Observer for Told<F> {
    fn row(&mut self, _: u64, _: &[f64], _: &[f64]) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn progress(&mut self, t: f64, _: &SolverWork) -> ControlFlow<()> {
        (self.0)(t)
    }
}
