//! One run: from a scenario through the solver to rows of channels, streamed to an observer.
//!
//! Memory does not grow with the duration. Dense output at eight times the sample rate feeds the anti-alias filter; every eighth of
//! those instants is a sample of the instantaneous channels, evaluated from the equations of motion at the interpolated state
//! (section 11 of the model). To fill the filter at the end, the run goes on for half the filter's length past the last sample.

use crate::accuracy::settings;
use crate::channel::{self, Channel, Frame};
use crate::defect::SIDES;
use crate::lanes::{Column, WIDTH, blend, positive};
use crate::model::energy::{ContactState, parametric_work};
use crate::model::{Energy, Layout, Model, ModelError, Motion, Power, Workspace, imbalance};
use crate::scenario::{Accuracy, Scenario};
use crate::sensor::{Chain, ChannelRecord, Sensing};
use crate::signal::Decimator;
use crate::signal::decimate::FACTOR;
use crate::solver::{StepError, Stepper, System, Work};
use crate::start;
use crate::statics::NoBalance;
use std::ops::ControlFlow;

/// Why a run ended before its time, or never began.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RunError {
    /// The scenario makes no model.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// There is no equilibrium to start from.
    #[error("start = \"equilibrium\": {0}")]
    NoBalance(#[from] NoBalance),
    /// The state stopped being finite.
    #[error("the state stopped being finite at t = {t:.9} s: {body}; {contact}")]
    NonFinite {
        /// Time of the last good state, s.
        t: f64,
        /// Body and coordinate.
        body: String,
        /// The contact that went first or is pressed hardest.
        contact: String,
    },
    /// No step is short enough for the tolerance.
    #[error(
        "no step is short enough at t = {t:.9} s: {body} changes too fast for the tolerance; {contact}"
    )]
    StepVanished {
        /// Time of the last good state, s.
        t: f64,
        /// Body and coordinate.
        body: String,
        /// The contact that is pressed hardest.
        contact: String,
    },
}

/// Receives a run as it goes.
pub trait Observer {
    /// After each accepted step.
    fn step(&mut self, frame: &Frame) {
        let _ = frame;
    }

    /// At each sample instant, with the index of the sample.
    fn sample(&mut self, index: u64, frame: &Frame) {
        let _ = (index, frame);
    }

    /// One complete row of the recorded channels, in order; `filtered` are the anti-aliased values of
    /// [`Simulation::filtered`] at that sample. Breaking ends the run.
    fn row(&mut self, index: u64, row: &[f64], filtered: &[f64]) -> ControlFlow<()>;

    /// Every few dozen steps: the simulated time reached. Breaking ends the run.
    fn progress(&mut self, t: f64, work: &SolverWork) -> ControlFlow<()> {
        let _ = (t, work);
        ControlFlow::Continue(())
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
    /// Contacts that went onto or off damage.
    pub damage_switches: u64,
}

/// The energy audit of a run, J: the change of the energy held against everything that flowed.
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

impl EnergyAudit {
    /// Energy that no entry explains: the integrator's error.
    pub fn residual(&self) -> f64 {
        self.last.total() - self.initial.total() - self.flows.net() - self.parametric
    }

    /// Everything that moved, as a scale for the residual.
    pub fn turnover(&self) -> f64 {
        let f = &self.flows;
        f.load.abs()
            + f.drive.abs()
            + f.film.abs()
            + f.lever.abs()
            + f.dissipated()
            + self.parametric.abs()
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
    Failed(RunError),
}

/// What remains of a run when its rows are gone.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// How it ended.
    pub end: End,
    /// Complete rows given.
    pub rows: u64,
    /// Simulated time reached, s; the filter's tail past the last sample included.
    pub t: f64,
    /// Counted work.
    pub work: SolverWork,
    /// Energy audit.
    pub energy: EnergyAudit,
    /// Largest relative momentum imbalance over the samples; `None` where it cannot be told.
    pub momentum_imbalance: Option<f64>,
    /// What the sensor did to each of its channels, in the order of [`Simulation::filtered`]; empty without one.
    pub sensor: Vec<ChannelRecord>,
}

/// A run that is ready to go.
#[derive(Debug)]
pub struct Simulation {
    model: Model,
    channels: Vec<Channel>,
    filtered: Vec<Channel>,
    /// Where each slope of the fast grid goes among them, and its entry of the derivative.
    filtered_entries: Vec<(usize, usize)>,
    sensor: Option<Chain>,
    idle_patterns: Vec<String>,
    initial: Vec<f64>,
    sample_rate: f64,
    samples: u64,
    accuracy: Accuracy,
}

impl Simulation {
    /// Builds the model and its initial state.
    ///
    /// # Errors
    /// Where the scenario makes no model or has no equilibrium to start from.
    pub fn new(scenario: &Scenario) -> Result<Self, RunError> {
        let model = Model::new(scenario)?;
        let initial = start::state(&model)?;
        let (channels, idle_patterns) =
            channel::select(&model, &scenario.sensor, &scenario.simulation.record);
        let sample_rate = scenario.simulation.sample_rate_hz;
        let (ring, others): (Vec<_>, Vec<_>) = channel::filterable(&model)
            .into_iter()
            .partition(|c| c.name.starts_with("outer_a"));
        let others = others
            .into_iter()
            .filter(|c| channels.iter().any(|r| r.name == c.name));
        let mut filtered = channel::measured(&scenario.sensor);
        let measured = filtered.len();
        filtered.extend(others);
        let slopes = ring.iter().chain(&filtered[measured..]);
        let places = (0..ring.len()).chain(measured..);
        Ok(Self {
            filtered_entries: places
                .zip(slopes.filter_map(Channel::slope_entry))
                .collect(),
            sensor: Chain::new(&scenario.sensor, sample_rate),
            channels,
            filtered,
            idle_patterns,
            initial,
            sample_rate,
            samples: (scenario.simulation.duration_s * sample_rate * (1.0 + 1e-12)).floor() as u64
                + 1,
            accuracy: scenario.simulation.accuracy,
            model,
        })
    }

    /// The model.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The recorded channels, in the order of rows; time is not among them.
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// The accelerations that pass the anti-alias filter: the measured channels, x and y of the outer ring and the sensor's own if it has
    /// one, then those of the other rings and cages that are recorded.
    pub fn filtered(&self) -> &[Channel] {
        &self.filtered
    }

    /// What stands between the outer ring and the measured channels, if anything does.
    pub fn sensor(&self) -> Option<&Chain> {
        self.sensor.as_ref()
    }

    /// Samples a second.
    pub fn sample_rate(&self) -> f64 {
        self.sample_rate
    }

    /// Patterns of `record` that match no channel.
    pub fn idle_patterns(&self) -> &[String] {
        &self.idle_patterns
    }

    /// Samples of a complete run, t = 0 included.
    pub fn samples(&self) -> u64 {
        self.samples
    }

    /// Runs to the end, or until the observer breaks off or the solver fails.
    pub fn run(&self, observer: &mut dyn Observer) -> Outcome {
        Run::new(self, observer).go()
    }
}

/// Steps between two reports of progress.
const PROGRESS: u64 = 32;

/// Rows that wait for their filtered samples.
struct Pending {
    width: usize,
    rows: Vec<f64>,
    depth: usize,
}

impl Pending {
    fn row(&mut self, index: u64) -> &mut [f64] {
        let at = (index % self.depth as u64) as usize * self.width;
        &mut self.rows[at..at + self.width]
    }
}

struct Run<'a> {
    simulation: &'a Simulation,
    observer: &'a mut dyn Observer,
    motion: Motion<'a>,
    stepper: Stepper<Power>,
    decimator: Decimator,
    /// Input of the decimator.
    fast: Vec<f64>,
    /// Its output, behind the sensor.
    filtered: Vec<f64>,
    sensing: Option<Sensing>,
    pending: Pending,
    /// Next instant of the fast grid.
    next: u64,
    rows: u64,
    work: SolverWork,
    energy: EnergyAudit,
    imbalance: Option<f64>,
    contact_states: [ContactState; 2],
    switches: Switches,
    y: Vec<f64>,
    dy: Vec<f64>,
}

impl<'a> Run<'a> {
    fn new(simulation: &'a Simulation, observer: &'a mut dyn Observer) -> Self {
        let model = &simulation.model;
        let mut motion = Motion::new(model);
        let settings = settings(model, simulation.accuracy);
        let stepper = Stepper::new(&mut motion, settings, 0.0, &simulation.initial);
        let initial = Energy::of(model, 0.0, &simulation.initial, &motion.ws);
        let mut contact_state = ContactState::new(&model.layout);
        contact_state.store(model, 0.0, &simulation.initial, &motion.ws);
        let mut switches = Switches::new(&model.layout);
        switches.store(&motion.ws);
        let decimator = Decimator::new(simulation.filtered.len());
        let width = simulation.channels.len();
        let depth = decimator.half_length() / FACTOR + 2;
        let n = motion.size();
        Self {
            pending: Pending {
                width,
                rows: vec![0.0; depth * width],
                depth,
            },
            simulation,
            observer,
            stepper,
            decimator,
            fast: vec![0.0; simulation.filtered.len()],
            filtered: vec![0.0; simulation.filtered.len()],
            sensing: simulation.sensor.as_ref().map(Sensing::new),
            next: 0,
            rows: 0,
            work: SolverWork::default(),
            energy: EnergyAudit {
                initial,
                last: initial,
                ..EnergyAudit::default()
            },
            imbalance: if model.outer_ring_is_fixed() {
                None
            } else {
                Some(0.0)
            },
            contact_states: [contact_state.clone(), contact_state],
            switches,
            y: vec![0.0; n],
            dy: vec![0.0; n],
            motion,
        }
    }

    fn go(mut self) -> Outcome {
        let end = self.advance();
        let model = &self.simulation.model;
        let t = self.stepper.t();
        self.y.copy_from_slice(self.stepper.y());
        self.motion.derivative(t, &self.y, &mut self.dy);
        self.energy.last = Energy::of(model, t, &self.y, &self.motion.ws);
        self.work.solver = self.stepper.work();
        Outcome {
            end,
            rows: self.rows,
            t,
            work: self.work,
            energy: self.energy,
            momentum_imbalance: self.imbalance,
            sensor: self.sensing.map_or(Vec::new(), |s| s.records().to_vec()),
        }
    }

    fn advance(&mut self) -> End {
        let simulation = self.simulation;
        let fast_rate = simulation.sample_rate * FACTOR as f64;
        loop {
            // Dense output: every instant of the fast grid that the last step covered.
            loop {
                if self.rows == simulation.samples {
                    return End::Complete;
                }
                let t = self.next as f64 / fast_rate;
                if t > self.stepper.t() {
                    break;
                }
                if self.sample(t).is_break() {
                    return End::Stopped;
                }
                self.next += 1;
            }
            match self.stepper.step(&mut self.motion) {
                Ok(flows) => {
                    self.book(flows);
                    // Steps rather than samples: a stiff run may take minutes from one sample to the next.
                    self.work.solver = self.stepper.work();
                    let due = self.work.solver.steps.is_multiple_of(PROGRESS);
                    if due
                        && self
                            .observer
                            .progress(self.stepper.t(), &self.work)
                            .is_break()
                    {
                        return End::Stopped;
                    }
                }
                Err(error) => return End::Failed(self.explain(error)),
            }
        }
    }

    /// Audits of an accepted step.
    fn book(&mut self, flows: Power) {
        let model = &self.simulation.model;
        let (t, y) = (self.stepper.t(), self.stepper.y());
        self.energy.flows += flows;
        let [before, after] = &mut self.contact_states;
        after.store(model, t, y, &self.motion.ws);
        self.energy.parametric += parametric_work(model, before, after);
        self.contact_states.swap(0, 1);
        self.switches.count(&self.motion.ws, &mut self.work);
        self.observer.step(&Frame {
            model,
            t,
            y,
            dy: self.stepper.slope(),
            ws: &self.motion.ws,
        });
    }

    /// One instant of the fast grid.
    ///
    /// What passes the anti-alias filter are slopes of the interpolated rates, not right-hand sides at interpolated states: an eighth of the
    /// evaluations. They keep the momentum of every step, so they differ from those above the filter's band alone.
    fn sample(&mut self, t: f64) -> ControlFlow<()> {
        if self.next.is_multiple_of(FACTOR as u64) {
            let model = &self.simulation.model;
            self.stepper.interpolate(t, &mut self.y);
            self.motion.derivative(t, &self.y, &mut self.dy);
            self.work.sample_evaluations += 1;
            let frame = Frame {
                model,
                t,
                y: &self.y,
                dy: &self.dy,
                ws: &self.motion.ws,
            };
            let index = self.next / FACTOR as u64;
            let row = self.pending.row(index);
            for (value, channel) in row.iter_mut().zip(&self.simulation.channels) {
                *value = channel.value(&frame);
            }
            if let (Some(worst), Some(now)) = (
                &mut self.imbalance,
                imbalance(model, t, &self.y, &self.dy, &self.motion.ws),
            ) {
                *worst = worst.max(now);
            }
            if index < self.simulation.samples {
                self.observer.sample(index, &frame);
            }
        }
        for (place, entry) in &self.simulation.filtered_entries {
            self.fast[*place] = self.stepper.interpolated_slope(t, *entry);
        }
        if let (Some(sensing), Some(chain)) = (&mut self.sensing, &self.simulation.sensor) {
            if let Some(own) = chain.along([self.fast[0], self.fast[1]]) {
                self.fast[2] = own;
            }
            sensing.fast(&mut self.fast);
        }
        if let Some(filtered) = self.decimator.push(&self.fast) {
            self.filtered.copy_from_slice(filtered);
            if let Some(sensing) = &mut self.sensing {
                let at = self.rows as f64 / self.simulation.sample_rate;
                sensing.sample(&mut self.filtered, at >= self.simulation.model.load.ramp);
            }
            let row = self.pending.row(self.rows);
            for (value, channel) in row.iter_mut().zip(&self.simulation.channels) {
                if let Some(axis) = channel.measured_axis() {
                    *value = self.filtered[axis];
                }
            }
            self.observer.row(self.rows, row, &self.filtered)?;
            self.rows += 1;
        }
        ControlFlow::Continue(())
    }

    fn explain(&self, error: StepError) -> RunError {
        let l = &self.simulation.model.layout;
        let contact = suspect(l, &self.motion.ws);
        match error {
            StepError::NonFinite { t, index } => RunError::NonFinite {
                t,
                body: l.name(index % l.dof()),
                contact,
            },
            StepError::Vanished { t, index } => RunError::StepVanished {
                t,
                body: l.name(index % l.dof()),
                contact,
            },
        }
    }
}

/// The contact that is not finite, or else the one pressed hardest, in words.
fn suspect(layout: &Layout, ws: &Workspace) -> String {
    let mut worst = (f64::NEG_INFINITY, String::from("no contact is closed"));
    for side in SIDES {
        let c = &ws.contacts[side as usize];
        for slot in 0..layout.rollers() {
            let force = c.force[slot];
            let size = if force.is_finite() {
                force
            } else {
                f64::INFINITY
            };
            if size > worst.0.max(0.0) {
                let (roller, row) = (layout.roller(slot) + 1, layout.row(slot) + 1);
                let side = format!("{side:?}").to_lowercase();
                worst = (
                    size,
                    format!("{side} contact of roller {roller} in row {row} carries {force:.4e} N"),
                );
            }
        }
    }
    for (slot, force) in ws.pocket_force[..layout.rollers()].iter().enumerate() {
        let size = if force.is_finite() {
            force.abs()
        } else {
            f64::INFINITY
        };
        if size > worst.0.max(0.0) {
            let (roller, row) = (layout.roller(slot) + 1, layout.row(slot) + 1);
            worst = (
                size,
                format!("the pocket of roller {roller} in row {row} carries {size:.4e} N"),
            );
        }
    }
    worst.1
}

/// Which forces act, to count the changes: closed contacts by side and pockets pressed from behind and from before, a bit a slot; and
/// which contacts stand on damage.
struct Switches {
    acting: [Vec<u8>; 4],
    now: [Vec<u8>; 4],
    pull: Column,
    on_damage: [Vec<bool>; 2],
}

impl Switches {
    fn new(layout: &Layout) -> Self {
        let bits = || std::array::from_fn(|_| vec![0; layout.slots / WIDTH]);
        Self {
            acting: bits(),
            now: bits(),
            pull: Column::new(layout.slots, 0.0),
            on_damage: std::array::from_fn(|_| vec![false; layout.slots]),
        }
    }

    fn store(&mut self, ws: &Workspace) {
        self.count(ws, &mut SolverWork::default());
    }

    fn count(&mut self, ws: &Workspace, work: &mut SolverWork) {
        blend(&mut self.pull, [-1.0], [&ws.pocket_force]);
        let [inner, outer] = &ws.contacts;
        let [a, b, c, d] = &mut self.now;
        positive(
            [&inner.force, &outer.force, &ws.pocket_force, &self.pull],
            [a, b, c, d],
        );
        let changed = |k: usize| -> u64 {
            let pairs = self.acting[k].iter().zip(&self.now[k]);
            pairs.map(|(a, b)| u64::from((a ^ b).count_ones())).sum()
        };
        work.contact_switches += changed(0) + changed(1);
        let pockets = (0..self.now[2].len()).map(|group| {
            let differ = |k: usize| self.acting[k][group] ^ self.now[k][group];
            u64::from((differ(2) | differ(3)).count_ones())
        });
        work.pocket_switches += pockets.sum::<u64>();
        std::mem::swap(&mut self.acting, &mut self.now);
        for (before, contacts) in self.on_damage.iter_mut().zip(&ws.contacts) {
            let now = &contacts.on_damage;
            if before != now {
                work.damage_switches +=
                    before.iter().zip(now).filter(|(a, b)| a != b).count() as u64;
                before.copy_from_slice(now);
            }
        }
    }
}
