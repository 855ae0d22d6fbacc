//! The loop of a run: steps, their audits, samples and the anti-alias filter.

use super::Decimator;
use super::averages::{Averages, LAG};
use super::failure::{body, explain};
use super::pace::{Pace, Told};
use super::switches::Switches;
use super::{End, EnergyAudit, Observer, Outcome, Simulation, SolverWork};
use crate::error::Error;
use crate::machine::{MachineMotion, Parts};
use crate::model::Power;
use crate::model::energy::{ContactState, parametric_work};
use crate::sensor::Sensing;
use crate::signal::decimate::FACTOR;
use crate::solver::{Stepper, System, Work};
use std::ops::{ControlFlow, Deref};

/// Steps between two reports of progress.
const PROGRESS: u64 = 32;

/// Rows that wait for their filtered samples.
#[derive(Debug)]
struct Pending {
    width: usize,
    rows: Vec<f64>,
    depth: usize,
}

impl Pending {
    fn new(simulation: &Simulation, decimator: &Decimator) -> Self {
        let width = simulation.channels.len();
        let depth = decimator.half_length() / FACTOR + 2;
        Self { width, rows: vec![0.0; depth * width], depth }
    }

    fn row(&mut self, index: u64) -> &mut [f64] {
        let at = (index % self.depth as u64) as usize * self.width;
        &mut self.rows[at..at + self.width]
    }
}

/// A run under way: begun by [`Run::new`]. It stops after any sample and goes on with the same bits.
///
/// `S` is how it holds its simulation: a reference, or an [`Arc`](std::sync::Arc) or `Box` where the run is kept.
#[derive(Debug)]
pub struct Run<S> {
    simulation: S,
    parts: Parts,
    stepper: Stepper<Power>,
    averages: Averages,
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
    /// Rows of a complete run.
    last: u64,
    work: SolverWork,
    pace: Pace,
    energy: EnergyAudit,
    imbalance: Option<f64>,
    /// Of each bearing, before and after a step.
    contact_states: Vec<[ContactState; 2]>,
    switches: Vec<Switches>,
    y: Vec<f64>,
    a: Vec<f64>,
}

impl<S: Deref<Target = Simulation>> Run<S> {
    /// At t = 0, to be advanced a few rows at a time.
    pub fn new(simulation: S) -> Self {
        let machine = &simulation.machine;
        let mut parts = Parts::new(machine);
        let mut motion = MachineMotion { machine, parts: &mut parts };
        let settings = machine.settings(simulation.accuracy);
        let stepper = Stepper::new(&mut motion, settings, 0.0, &simulation.initial);
        let n = motion.size();
        let rates = &simulation.initial[n / 2..];
        let mut contact_states = Vec::new();
        let mut switches = Vec::new();
        for (k, (seated, part)) in machine.bearings.iter().zip(&parts.each).enumerate() {
            let mut state = ContactState::new(&seated.model.layout);
            state.store(&seated.model, 0.0, parts.state(machine, k, &simulation.initial), &part.ws);
            contact_states.push([state.clone(), state]);
            let mut of = Switches::new(&seated.model.layout);
            of.store(&part.ws);
            switches.push(of);
        }
        let decimator = Decimator::new(simulation.filtered.len());
        // The filter has its last sample by then.
        let end = simulation.samples as f64 / simulation.sample_rate
            + decimator.half_length() as f64 / simulation.fast_rate();
        Self {
            pending: Pending::new(&simulation, &decimator),
            averages: Averages::new(&simulation.filtered_entries, 1.0 / simulation.fast_rate(), rates),
            stepper,
            decimator,
            fast: vec![0.0; simulation.filtered.len()],
            filtered: vec![0.0; simulation.filtered.len()],
            sensing: simulation.sensor.as_ref().map(Sensing::new),
            next: 0,
            rows: 0,
            last: simulation.samples,
            work: SolverWork::default(),
            pace: Pace::new(end, simulation.most_steps),
            energy: EnergyAudit::from(machine.energy(0.0, &simulation.initial, &parts)),
            imbalance: (!machine.is_held()).then_some(0.0),
            contact_states,
            switches,
            y: vec![0.0; n],
            a: vec![0.0; machine.dof()],
            parts,
            simulation,
        }
    }

    /// The simulation that it goes on in.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// Time that the solver has reached, s.
    pub fn t(&self) -> f64 {
        self.stepper.t()
    }

    /// Rows given so far.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Gives `rows` more rows at most. `None`: there are more to come. However a run is cut, its bits are the same.
    pub fn advance(&mut self, rows: u64, observer: &mut dyn Observer) -> Option<End> {
        let stop = self.rows.saturating_add(rows);
        let fast_rate = self.simulation.fast_rate();
        loop {
            // Dense output: every instant of the fast grid that the last step covered.
            loop {
                if self.rows == self.last {
                    return Some(End::Complete);
                }
                if self.rows == stop {
                    return None;
                }
                let t = self.next as f64 / fast_rate;
                if t > self.stepper.t() {
                    break;
                }
                if self.sample(t, observer).is_break() {
                    return Some(End::Stopped);
                }
                self.next += 1;
            }
            self.averages.pass(&self.stepper);
            let machine = &self.simulation.machine;
            let parts = &mut self.parts;
            match self.stepper.step(&mut MachineMotion { machine, parts }) {
                Ok(flows) => {
                    self.book(flows, observer);
                    // Steps rather than samples: a stiff run may take minutes from one sample to the next.
                    self.work.solver = self.stepper.work();
                    let (steps, t) = (self.work.solver.steps, self.stepper.t());
                    if !steps.is_multiple_of(PROGRESS) {
                        continue;
                    }
                    if observer.progress(t, &self.work).is_break() {
                        return Some(End::Stopped);
                    }
                    if let Some(told) = self.pace.too_long(steps, t) {
                        return Some(End::Failed(self.too_long(told)));
                    }
                }
                Err(error) => {
                    return Some(End::Failed(explain(error, machine, &self.parts)));
                }
            }
        }
    }

    /// The outcome so far, the end given.
    pub fn outcome(&mut self, end: End) -> Outcome {
        let machine = &self.simulation.machine;
        let t = self.stepper.t();
        self.y.copy_from_slice(self.stepper.y());
        machine.accelerations(t, &self.y, &mut self.a, &mut self.parts);
        self.energy.last = machine.energy(t, &self.y, &self.parts);
        self.work.solver = self.stepper.work();
        Outcome {
            end,
            rows: self.rows,
            t,
            reached: self.rows.saturating_sub(1) as f64 / self.simulation.sample_rate,
            work: self.work,
            energy: self.energy,
            refined: None,
            momentum_imbalance: self.imbalance,
            sensor: (self.sensing.as_ref()).map_or(Vec::new(), |s| s.records().to_vec()),
        }
    }

    /// Goes on in another simulation, without an end: places, rates, filter and time stay, forces change at once. Such
    /// a run is no run of the other scenario from t = 0. The sensor of the other starts from rest; the audits start
    /// anew; channels that are not filtered wait for those that are, and what waited is lost: they are 0 for half
    /// the length of the filter. `false`: the entries of their states, their sample rates or their filtered channels do
    /// not correspond, and the run stays as it is.
    #[must_use]
    pub fn go_on_in(&mut self, other: S) -> bool {
        let names = |s: &Simulation| -> Vec<String> { s.filtered.iter().map(|c| c.name.clone()).collect() };
        if !other.machine.is_laid_out_as(&self.simulation.machine)
            || other.sample_rate != self.simulation.sample_rate
            || names(&other) != names(&self.simulation)
        {
            return false;
        }
        let machine = &other.machine;
        let mut parts = Parts::new(machine);
        let settings = machine.settings(other.accuracy);
        let motion = &mut MachineMotion { machine, parts: &mut parts };
        self.averages.pass(&self.stepper);
        self.stepper.go_on_in(motion, settings);
        self.averages.go_on(&self.stepper);
        let (t, y) = (self.stepper.t(), self.stepper.y());
        self.energy = EnergyAudit::from(machine.energy(t, y, &parts));
        self.imbalance = (!machine.is_held()).then_some(0.0);
        for (k, (seated, part)) in machine.bearings.iter().zip(&parts.each).enumerate() {
            self.contact_states[k][0].store(&seated.model, t, parts.state(machine, k, y), &part.ws);
            self.switches[k].store(&part.ws);
        }
        self.pending = Pending::new(&other, &self.decimator);
        self.sensing = other.sensor.as_ref().map(Sensing::new);
        self.last = u64::MAX;
        self.pace = Pace::unbounded();
        self.parts = parts;
        self.simulation = other;
        true
    }

    /// How fast it goes.
    pub(super) fn pace(&self) -> &Pace {
        &self.pace
    }

    /// What the solver has done.
    pub(super) fn work(&self) -> Work {
        self.work.solver
    }

    /// Why a run of so many steps of such a length does not go on.
    pub(super) fn too_long(&mut self, Told { steps, step, .. }: Told) -> Error {
        let machine = &self.simulation.machine;
        let held = match self.stepper.hardest() {
            None => String::from("stability: the stiffest contacts, dampers and friction on the lightest parts"),
            Some(index) => format!("how fast {} changes", body(machine, index)),
        };
        Error::TooLong { steps, most: self.simulation.most_steps, step, held }
    }

    /// Audits of an accepted step.
    fn book(&mut self, flows: Power, observer: &mut dyn Observer) {
        let machine = &self.simulation.machine;
        let (t, y) = (self.stepper.t(), self.stepper.y());
        self.energy.flows += flows;
        for (k, (seated, part)) in machine.bearings.iter().zip(&self.parts.each).enumerate() {
            let states = &mut self.contact_states[k];
            let [before, after] = states;
            after.store(&seated.model, t, self.parts.state(machine, k, y), &part.ws);
            self.energy.parametric += parametric_work(&seated.model, before, after);
            states.swap(0, 1);
            self.switches[k].count(&part.ws, &mut self.work);
        }
        // Behind the last sample only the filter's lag is left.
        if t * self.simulation.sample_rate <= self.last.saturating_sub(1) as f64 {
            let at = (t, y, self.stepper.accelerations());
            observer.step(&machine.frame(self.simulation.lead, at, &self.parts));
        }
    }

    /// One instant of the fast grid.
    ///
    /// What passes the anti-alias filter are averages of the interpolated motion, not right-hand sides at interpolated
    /// states: an eighth of the evaluations, and nothing folds.
    fn sample(&mut self, t: f64, observer: &mut dyn Observer) -> ControlFlow<()> {
        let simulation: &Simulation = &self.simulation;
        let machine = &simulation.machine;
        if self.next.is_multiple_of(FACTOR as u64) {
            self.stepper.interpolate(t, &mut self.y);
            machine.accelerations(t, &self.y, &mut self.a, &mut self.parts);
            self.work.sample_evaluations += 1;
            let at = (t, &self.y[..], &self.a[..]);
            let index = self.next / FACTOR as u64;
            let row = self.pending.row(index);
            for (value, channel) in row.iter_mut().zip(&simulation.channels) {
                *value = match channel.machine_entry() {
                    Some(entry) => self.y[entry],
                    None => channel.value(&machine.frame(channel.bearing, at, &self.parts)),
                };
            }
            if let (Some(worst), Some(now)) = (&mut self.imbalance, machine.imbalance(at, &self.parts)) {
                *worst = worst.max(now);
            }
            if index < self.last {
                observer.sample(index, &machine.frame(simulation.lead, at, &self.parts));
            }
        }
        if self.next == 0 {
            return ControlFlow::Continue(());
        }
        self.averages.at(t, &self.stepper, &mut self.fast);
        if self.next < LAG {
            return ControlFlow::Continue(());
        }
        if let (Some(sensing), Some(chain)) = (&mut self.sensing, &simulation.sensor) {
            if let Some(own) = chain.along([self.fast[0], self.fast[1]]) {
                self.fast[2] = own;
            }
            sensing.fast(&mut self.fast);
        }
        if let Some(filtered) = self.decimator.push(&self.fast) {
            self.filtered.copy_from_slice(filtered);
            if let Some(sensing) = &mut self.sensing {
                let at = self.rows as f64 / simulation.sample_rate;
                sensing.sample(&mut self.filtered, at >= simulation.settled);
            }
            let row = self.pending.row(self.rows);
            for (value, channel) in row.iter_mut().zip(&simulation.channels) {
                if let Some(axis) = channel.sensor_axis() {
                    *value = self.filtered[axis];
                }
            }
            self.rows += 1;
            observer.row(self.rows - 1, row, &self.filtered)?;
        }
        ControlFlow::Continue(())
    }
}
