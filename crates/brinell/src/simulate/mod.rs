//! One run: from a scenario through the solver to rows of channels, streamed to an observer.
//!
//! Memory does not grow with the duration. Dense output at eight times the sample rate feeds the anti-alias filter;
//! every eighth of those instants is a sample of the instantaneous channels, evaluated from the equations of motion at
//! the interpolated state (section 11 of the model). To fill the filter at the end, the run continues for half the
//! filter's length past the last sample.

mod anti_alias;
mod averages;
mod cost;
mod failure;
mod pace;
mod run_loop;
mod signals;
mod switches;

use crate::channel::{self, Channel, Frame};
use crate::document::Problem;
use crate::error::{Error, refuse};
use crate::machine::{self, Machine};
use crate::model::{Custom, Energy, Model, ModelError, Power};
use crate::scenario::{Accuracy, Scenario};
use crate::sensor::{Chain, ChannelRecord};
use crate::signal::decimate::FACTOR;
use crate::solver::Work;
use std::ops::ControlFlow;

#[doc(hidden)]
pub use anti_alias::Decimator;
pub use cost::{Cost, cost};
pub use run_loop::Run;
pub use signals::Signals;

/// Receives a run as it goes.
pub trait Observer {
    /// After each accepted step that ends at the last sample at the latest.
    fn step(&mut self, frame: &Frame) {
        let _ = frame;
    }

    /// At each sample instant, with the index of the sample.
    fn sample(&mut self, index: u64, frame: &Frame) {
        let _ = (index, frame);
    }

    /// One complete row of the recorded channels, in the order of [`Simulation::channels`]; `filtered` are the anti-aliased values of
    /// [`Simulation::filtered`] at that sample. Breaking ends the run.
    fn row(&mut self, index: u64, row: &[f64], filtered: &[f64]) -> ControlFlow<()> {
        let _ = (index, row, filtered);
        ControlFlow::Continue(())
    }

    /// The run is made again from t = 0, held tighter, because its energy audit stayed open: what was kept of it is void.
    /// Breaking, which is what happens by default, leaves the run as it was.
    fn again(&mut self, simulation: &Simulation) -> ControlFlow<()> {
        let _ = simulation;
        ControlFlow::Break(())
    }

    /// Every few dozen steps: the simulated time reached. Breaking ends the run.
    fn progress(&mut self, t: f64, work: &SolverWork) -> ControlFlow<()> {
        let _ = (t, work);
        ControlFlow::Continue(())
    }
}

/// Observes nothing.
impl Observer for () {
    fn again(&mut self, _: &Simulation) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// An observer of the simulated time reached, s; its answer may break the run off.
#[derive(Debug, Clone)]
pub struct Progress<F>(pub F);

impl<F: FnMut(f64) -> ControlFlow<()>> Observer for Progress<F> {
    fn again(&mut self, _: &Simulation) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn progress(&mut self, t: f64, _: &SolverWork) -> ControlFlow<()> {
        (self.0)(t)
    }
}

/// Counted work of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct SolverWork {
    /// Steps, rejections and right-hand sides of the solver.
    pub solver: Work,
    /// Right-hand sides spent on samples.
    pub sample_evaluations: u64,
    /// Contacts that opened or closed between steps.
    pub contact_switches: u64,
    /// Pockets that opened or closed, or changed side.
    pub pocket_switches: u64,
    /// Entries to and exits from damage, of all contacts.
    pub damage_switches: u64,
}

/// Share of the turnover that an energy audit may miss in a run to rely on; sound runs stay far below.
pub const RESIDUAL_SHARE: f64 = 0.01;
/// Share of the energy held that a sum of it is exact to: an audit of smaller flows compares round-off.
const ROUND_OFF: f64 = 1e-9;

/// The energy audit of a run, J: the change of the energy compared with everything that flowed.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct EnergyAudit {
    /// Held at the start.
    pub initial: Energy,
    /// Held at the end.
    pub last: Energy,
    /// Flows integrated over the run.
    pub flows: Power,
    /// Parametric work of damage under the rollers (section 3).
    pub parametric: f64,
}

impl From<Energy> for EnergyAudit {
    /// Before anything flowed.
    fn from(held: Energy) -> Self {
        Self { initial: held, last: held, ..Self::default() }
    }
}

impl EnergyAudit {
    /// Energy that no entry explains: the integrator's error.
    pub fn residual(&self) -> f64 {
        self.last.total() - self.initial.total() - self.flows.net() - self.parametric
    }

    /// Everything that moved, as a scale for the residual.
    pub fn turnover(&self) -> f64 {
        let f = &self.flows;
        f.load.abs() + f.drive.abs() + f.film.abs() + f.lever.abs() + f.dissipated() + self.parametric.abs()
    }

    /// The residual over the turnover; over the round-off of what is held, where less than that flowed. `None` where
    /// there is no energy.
    pub fn relative_residual(&self) -> Option<f64> {
        let held = self.initial.size().max(self.last.size());
        let scale = self.turnover().max(ROUND_OFF * held);
        (scale > 0.0).then(|| self.residual() / scale)
    }

    /// The size of [`EnergyAudit::relative_residual`] where it is more than [`RESIDUAL_SHARE`]: steps were too long for
    /// the motion.
    pub fn left_open(&self) -> Option<f64> {
        // What is not a number is open too.
        self.relative_residual().map(f64::abs).filter(|share| share.is_nan() || *share > RESIDUAL_SHARE)
    }
}

/// How a run ended.
#[derive(Debug, Clone, PartialEq)]
pub enum End {
    /// At its duration.
    Complete,
    /// The observer broke off.
    Stopped,
    /// The solver could not go on.
    Failed(Error),
}

/// Run summary (no time series).
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// How it ended.
    pub end: End,
    /// Complete rows given.
    pub rows: u64,
    /// Simulated time reached, s; the filter's tail past the last sample included.
    pub t: f64,
    /// Time of the last complete row, s.
    pub reached: f64,
    /// Counted work.
    pub work: SolverWork,
    /// Energy audit.
    pub energy: EnergyAudit,
    /// What the audit was left open by at `standard`, where the run was made again at `reference` for that.
    pub refined: Option<f64>,
    /// Largest relative momentum imbalance over the samples; `None` where it is not defined.
    pub momentum_imbalance: Option<f64>,
    /// What the sensor did to each of its channels, in the order of [`Simulation::filtered`]; empty without one.
    pub sensor: Vec<ChannelRecord>,
}

/// How a machine's run is recorded; as the keys of `[simulation]` of these names.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// s.
    pub duration_s: f64,
    /// Samples a second.
    pub sample_rate_hz: f64,
    /// Patterns of channels.
    pub record: Vec<String>,
    /// How tight the solver is held.
    pub accuracy: Accuracy,
    /// Steps that the run may take.
    pub most_steps: f64,
    /// From when on statistics count, s.
    pub settled_s: f64,
}

impl Recording {
    /// As a scenario says.
    pub fn of(scenario: &Scenario) -> Self {
        let s = &scenario.simulation;
        Self {
            duration_s: s.duration_s,
            sample_rate_hz: s.sample_rate_hz,
            record: s.record.clone(),
            accuracy: s.accuracy,
            most_steps: s.most_steps,
            settled_s: scenario.settled_s(),
        }
    }
}

/// Samples of a duration (s), both its ends included.
fn samples_in(duration: f64, rate: f64) -> u64 {
    (duration * rate * (1.0 + 1e-12)).floor() as u64 + 1
}

/// A run that is ready to go.
#[derive(Debug)]
pub struct Simulation {
    machine: Machine,
    channels: Vec<Channel>,
    filtered: Vec<Channel>,
    /// Where each acceleration of the fast grid goes among them, and its entry of the derivative.
    filtered_entries: Vec<(usize, usize)>,
    sensor: Option<Chain>,
    /// From when on statistics count, s.
    settled: f64,
    idle_patterns: Vec<String>,
    initial: Vec<f64>,
    sample_rate: f64,
    samples: u64,
    accuracy: Accuracy,
    /// Steps that a run may take.
    most_steps: f64,
    /// Bearing whose frames are observed, from 0.
    lead: usize,
    /// Which of the filtered accelerations findings are of.
    shown: usize,
}

/// What `make` makes of each bearing of a scenario.
fn each<T>(scenario: &Scenario, make: impl Fn(&Scenario) -> Result<T, ModelError>) -> Result<Vec<T>, Error> {
    match &scenario.machine {
        // The studio's page runs one bearing: the browser is spared the matrices of shafts.
        Some(_) if cfg!(target_arch = "wasm32") => {
            Err(vec![Problem::error("shaft", "a machine is run by `brinell run`, not in a browser")].into())
        }
        Some(of) => Ok(machine::bearings(scenario, of)?.iter().map(make).collect::<Result<_, _>>()?),
        None => Ok(vec![make(scenario)?]),
    }
}

impl Simulation {
    /// Builds the model and its initial state. A scenario built or changed in code is held to what a file is.
    ///
    /// # Errors
    /// Every error among [`Scenario::problems`]; where the scenario makes no model or has no equilibrium to start from.
    pub fn new(scenario: &Scenario) -> Result<Self, Error> {
        refuse(scenario.problems())?;
        Self::unchecked(scenario)
    }

    /// The same with a contact law and further forces of the user's own.
    ///
    /// # Errors
    /// As [`Self::new`]; where the scenario's equations have no place for them: `lumped`, and for a law of contact `tilting`, a profile and
    /// centred geometry.
    pub fn with_custom(scenario: &Scenario, custom: Custom) -> Result<Self, Error> {
        refuse(scenario.problems())?;
        if scenario.machine.is_some() {
            let message = "laws and forces of one's own are of one bearing on its supports";
            return Err(vec![Problem::error("shaft", message)].into());
        }
        Self::of(scenario, vec![Model::with_custom(scenario, custom)?])
    }

    /// The same of a scenario as it was read, which has been checked.
    ///
    /// # Errors
    /// Where it makes no model or has no equilibrium to start from.
    #[doc(hidden)]
    pub fn unchecked(scenario: &Scenario) -> Result<Self, Error> {
        Self::of(scenario, each(scenario, Model::new)?)
    }

    /// The same where the tables of damage are at hand, by [`Model::at_hand`].
    ///
    /// # Errors
    /// As [`Self::unchecked`].
    #[doc(hidden)]
    pub fn at_hand(scenario: &Scenario) -> Result<Option<Self>, Error> {
        let models: Option<Vec<_>> = each(scenario, Model::at_hand)?.into_iter().collect();
        models.map(|models| Self::of(scenario, models)).transpose()
    }

    /// The same to plan with, by [`Model::planned`]: not to be run.
    ///
    /// # Errors
    /// As [`Self::unchecked`].
    #[doc(hidden)]
    pub fn planned(scenario: &Scenario) -> Result<Self, Error> {
        Self::of(scenario, each(scenario, Model::planned)?)
    }

    /// Of a machine, recorded as said.
    ///
    /// # Errors
    /// Where it has no state to start from.
    pub fn of_machine(machine: Machine, recording: &Recording) -> Result<Self, Error> {
        let (channels, idle_patterns) = channel::chosen(machine.channels(), &recording.record);
        let sensors = machine.sensors();
        let of_bearings = (machine.bearings.iter().enumerate())
            .flat_map(|(k, seated)| channel::filterable(&seated.model).into_iter().map(move |c| c.of_bearing(k)))
            // Without a sensor the outer rings are what is looked at.
            .filter(|c| channels.iter().any(|r| r.name == c.name) || sensors.is_empty() && c.name.contains(".outer_a"));
        let filtered: Vec<_> = sensors.iter().map(|(_, channel)| channel.clone()).chain(of_bearings).collect();
        let entry = |c: &Channel| Some(machine.bearing(c.bearing) + c.acceleration_entry()?);
        let entries = sensors.iter().map(|(entry, _)| Some(*entry)).chain(filtered[sensors.len()..].iter().map(entry));
        Ok(Self {
            filtered_entries: entries.enumerate().filter_map(|(place, entry)| Some((place, entry?))).collect(),
            sensor: None,
            settled: recording.settled_s,
            initial: machine.initial()?,
            samples: samples_in(recording.duration_s, recording.sample_rate_hz),
            sample_rate: recording.sample_rate_hz,
            accuracy: recording.accuracy,
            most_steps: recording.most_steps,
            channels,
            filtered,
            idle_patterns,
            machine,
            lead: 0,
            shown: 0,
        })
    }

    /// Of the models of its bearings.
    fn of(scenario: &Scenario, mut models: Vec<Model>) -> Result<Self, Error> {
        if let Some(of) = scenario.machine.as_ref().filter(|_| !cfg!(target_arch = "wasm32")) {
            let models = models.into_iter().map(machine::unloaded).collect();
            let made = Self::of_machine(machine::machine(of, models)?, &Recording::of(scenario))?;
            let shown = scenario.shown_channel();
            let place = made.filtered.iter().position(|channel| channel.name == shown);
            return Ok(Self { lead: of.lead, shown: place.unwrap_or(0), ..made });
        }
        let machine = Machine::of_one(models.remove(0));
        let (initial, model) = (machine.initial()?, &machine.bearings[0].model);
        let (channels, idle_patterns) = channel::select(model, &scenario.sensor, &scenario.simulation.record);
        let sample_rate = scenario.simulation.sample_rate_hz;
        let (ring, others): (Vec<_>, Vec<_>) =
            channel::filterable(model).into_iter().partition(|c| c.name.starts_with("outer_a"));
        let others = others.into_iter().filter(|c| channels.iter().any(|r| r.name == c.name));
        let mut filtered = channel::sensor_channels(&scenario.sensor);
        let own = filtered.len();
        filtered.extend(others);
        let slopes = ring.iter().chain(&filtered[own..]);
        let places = (0..ring.len()).chain(own..);
        Ok(Self {
            filtered_entries: places.zip(slopes.filter_map(Channel::acceleration_entry)).collect(),
            sensor: Chain::new(&scenario.sensor, sample_rate),
            settled: scenario.settled_s(),
            channels,
            filtered,
            idle_patterns,
            initial,
            sample_rate,
            samples: samples_in(scenario.simulation.duration_s, sample_rate),
            accuracy: scenario.simulation.accuracy,
            most_steps: scenario.simulation.most_steps,
            machine,
            lead: 0,
            shown: scenario.operation.axis_of_load(),
        })
    }

    /// The model; of a machine that of the bearing whose frames are observed.
    pub fn model(&self) -> &Model {
        &self.machine.bearings[self.lead].model
    }

    /// The machine; of one bearing alone the smallest.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// The channel of [`Self::filtered`] that findings are of.
    pub fn shown(&self) -> &Channel {
        &self.filtered[self.shown]
    }

    /// Which of them it is.
    pub(crate) fn shown_index(&self) -> usize {
        self.shown
    }

    /// The recorded channels, in the order of rows; time is not among them.
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// Name, unit and description of each of [`Simulation::channels`], as files have them.
    pub fn table(&self) -> impl Iterator<Item = (&str, &str, &str)> {
        self.channels.iter().map(|c| (&*c.name, c.unit, &*c.description))
    }

    /// The accelerations that pass the anti-alias filter: the sensor channels, x and y of the outer ring and the
    /// sensor's own if it has one, then those of the other rings and cages that are recorded.
    pub fn filtered(&self) -> &[Channel] {
        &self.filtered
    }

    /// Whether a channel of this name is what a sensor reads.
    pub fn is_sensor(&self, name: &str) -> bool {
        self.filtered.iter().any(|channel| channel.name == name && channel.sensor_axis().is_some())
    }

    /// What is between the outer ring and the sensor channels, if anything is.
    pub fn sensor(&self) -> Option<&Chain> {
        self.sensor.as_ref()
    }

    /// Samples a second.
    pub fn sample_rate(&self) -> f64 {
        self.sample_rate
    }

    /// Instants of the fast grid a second, in front of the anti-alias filter.
    fn fast_rate(&self) -> f64 {
        self.sample_rate * FACTOR as f64
    }

    /// Patterns of `record` that match no channel.
    pub fn idle_patterns(&self) -> &[String] {
        &self.idle_patterns
    }

    /// Samples of a complete run, t = 0 included.
    pub fn samples(&self) -> u64 {
        self.samples
    }

    /// How tight the solver is held.
    pub fn accuracy(&self) -> Accuracy {
        self.accuracy
    }

    /// Holds the solver otherwise than the scenario says.
    pub(crate) fn hold(&mut self, accuracy: Accuracy) {
        self.accuracy = accuracy;
    }

    /// Runs to the end, or until the observer breaks off or the solver fails.
    pub fn run(&self, observer: &mut dyn Observer) -> Outcome {
        let mut run = Run::new(self);
        let end = run.advance(u64::MAX, observer);
        run.outcome(end.unwrap_or(End::Complete))
    }
}
