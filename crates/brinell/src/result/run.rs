//! A scenario from start to findings.

use crate::channel::Frame;
use crate::document;
use crate::error::Error;
use crate::model::Custom;
use crate::observe::{Findings, Watch};
use crate::scenario::{Accuracy, Scenario};
use crate::simulate::{End, Observer, Outcome, Signals, Simulation, SolverWork};
use std::ops::ControlFlow;

impl Scenario {
    /// Reads the text of a scenario file. [`document::read`] takes overrides, and gives warnings and the origin of
    /// every value too.
    ///
    /// # Errors
    /// [`Error::Scenario`] with every problem of the text.
    pub fn from_toml(text: &str) -> Result<Self, Error> {
        Ok(document::read(text, &[])?.scenario)
    }

    /// A healthy bearing by its name (`bearing.preset`) at a speed, r/min, under a load `[x, y]`, N; all else by default.
    ///
    /// # Errors
    /// [`Error::Scenario`] where no catalogue has the bearing, or it cannot run so.
    pub fn of_bearing(name: &str, speed_rpm: f64, [x, y]: [f64; 2]) -> Result<Self, Error> {
        let number = document::toml_float;
        let given = [
            ("bearing.preset", document::toml_quote(name)),
            ("operation.speed_rpm", number(speed_rpm)),
            ("operation.load_n", format!("[{}, {}]", number(x), number(y))),
        ];
        Ok(document::read("", &given.map(|(key, value)| (key.into(), value)))?.scenario)
    }
}

/// A run that is over, with all that was found in it.
#[derive(Debug)]
pub struct RunResult {
    /// What was run.
    pub scenario: Scenario,
    /// The same, made a model of.
    pub simulation: Simulation,
    /// Its outcome.
    pub outcome: Outcome,
    /// What was gathered.
    pub findings: Findings,
}

impl RunResult {
    /// The run as named numbers.
    pub fn quantities(&self) -> Vec<super::Quantity> {
        super::quantities(&self.scenario, &self.simulation, &self.outcome, &self.findings)
    }

    /// One of [`RunResult::quantities`] by its name, such as `sensor_ax.rms`.
    pub fn quantity(&self, name: &str) -> Option<super::Quantity> {
        self.quantities().into_iter().find(|q| q.name == name)
    }
}

/// Steps at `reference` over those at `standard`, about: a run that would take too many is left as it is.
const TIGHTER: f64 = 12.0;

/// Runs a simulation and gathers its findings; `observer` is informed of the run as it goes, and may stop it. A run at
/// `standard` whose energy audit stays open is made again at `reference`, where [`Observer::again`] allows it.
pub fn finish(scenario: Scenario, mut simulation: Simulation, observer: &mut dyn Observer) -> RunResult {
    let (mut outcome, mut findings) = watched(&scenario, &simulation, observer);
    if outcome.end == End::Complete
        && simulation.accuracy() == Accuracy::Standard
        && let Some(open) = outcome.energy.left_open()
        && TIGHTER * outcome.work.solver.steps as f64 <= scenario.simulation.most_steps
        && observer.again(&simulation).is_continue()
    {
        simulation.hold(Accuracy::Reference);
        (outcome, findings) = watched(&scenario, &simulation, observer);
        outcome.refined = Some(open);
    }
    RunResult { scenario, simulation, outcome, findings }
}

fn watched(scenario: &Scenario, simulation: &Simulation, observer: &mut dyn Observer) -> (Outcome, Findings) {
    let mut watched = WithWatch { watch: Watch::new(scenario, simulation), simulation, observer };
    let outcome = simulation.run(&mut watched);
    (outcome, watched.watch.finish(simulation))
}

/// Runs one scenario to its end.
///
/// # Errors
/// Where the scenario has an error that [`Scenario::problems`] lists, or no equilibrium to start from, or the run fails.
pub fn simulate(scenario: &Scenario) -> Result<RunResult, Error> {
    simulate_with(scenario, &mut ())
}

/// Runs one scenario to its end; `observer` is informed of the run as it goes, and may stop it.
///
/// # Errors
/// As [`simulate`], and [`Error::Stopped`]: there is no half-finished run among results.
pub fn simulate_with(scenario: &Scenario, observer: &mut dyn Observer) -> Result<RunResult, Error> {
    let simulation = Simulation::new(scenario)?;
    complete(finish(scenario.clone(), simulation, observer))
}

/// As [`simulate_with`], with a contact law and further forces of the user's own.
///
/// # Errors
/// As [`simulate_with`] and [`Simulation::with_custom`].
pub fn simulate_custom(scenario: &Scenario, custom: Custom, observer: &mut dyn Observer) -> Result<RunResult, Error> {
    let simulation = Simulation::with_custom(scenario, custom)?;
    complete(finish(scenario.clone(), simulation, observer))
}

/// Runs one scenario to its end and keeps its recorded channels in memory: 8 bytes a channel and sample.
///
/// # Errors
/// As [`simulate`], and [`Error::TooLarge`].
pub fn record(scenario: &Scenario) -> Result<(RunResult, Signals), Error> {
    let simulation = Simulation::new(scenario)?;
    let mut signals = Signals::new(&simulation)?;
    let result = complete(finish(scenario.clone(), simulation, &mut signals))?;
    Ok((result, signals))
}

/// Only what came to its end.
fn complete(result: RunResult) -> Result<RunResult, Error> {
    match result.outcome.end {
        End::Complete => Ok(result),
        End::Stopped => Err(Error::Stopped),
        End::Failed(error) => Err(error),
    }
}

struct WithWatch<'a> {
    watch: Watch,
    simulation: &'a Simulation,
    observer: &'a mut dyn Observer,
}

impl Observer for WithWatch<'_> {
    fn step(&mut self, frame: &Frame) {
        self.watch.step(frame);
        self.observer.step(frame);
    }

    fn sample(&mut self, index: u64, frame: &Frame) {
        self.watch.sample(frame);
        self.observer.sample(index, frame);
    }

    fn row(&mut self, index: u64, row: &[f64], filtered: &[f64]) -> ControlFlow<()> {
        self.watch.row(self.simulation, index, row, filtered);
        self.observer.row(index, row, filtered)
    }

    fn progress(&mut self, t: f64, work: &SolverWork) -> ControlFlow<()> {
        self.observer.progress(t, work)
    }
}
