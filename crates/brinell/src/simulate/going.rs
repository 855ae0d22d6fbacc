//! The loop of a run: steps, their audits, samples and the anti-alias filter.

use super::Decimator;
use super::failure::explain;
use super::switches::Switches;
use super::{End, EnergyAudit, Observer, Outcome, Simulation, SolverWork};
use crate::accuracy::settings;
use crate::channel::Frame;
use crate::model::energy::{ContactState, parametric_work};
use crate::model::{Energy, Motion, Power, imbalance};
use crate::sensor::Sensing;
use crate::signal::decimate::FACTOR;
use crate::slices::Cover;
use crate::solver::{Stepper, System};
use std::ops::ControlFlow;

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

/// A simulation under way.
pub(super) struct Run<'a> {
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
    /// What damage covers of one of them at a time.
    cover: Cover,
    switches: Switches,
    y: Vec<f64>,
    a: Vec<f64>,
}

impl<'a> Run<'a> {
    pub(super) fn new(simulation: &'a Simulation, observer: &'a mut dyn Observer) -> Self {
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
            cover: Cover::new(model.slices.as_ref().map_or(0, |s| s.count)),
            switches,
            y: vec![0.0; n],
            a: vec![0.0; model.layout.dof()],
            motion,
        }
    }

    pub(super) fn go(mut self) -> Outcome {
        let end = self.advance();
        let model = &self.simulation.model;
        let t = self.stepper.t();
        self.y.copy_from_slice(self.stepper.y());
        self.motion.accelerations(t, &self.y, &mut self.a);
        self.energy.last = Energy::of(model, t, &self.y, &self.motion.ws);
        self.work.solver = self.stepper.work();
        Outcome {
            end,
            rows: self.rows,
            t,
            reached: self.rows.saturating_sub(1) as f64 / self.simulation.sample_rate,
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
                Err(error) => {
                    return End::Failed(explain(error, &simulation.model.layout, &self.motion.ws));
                }
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
        self.energy.parametric += parametric_work(model, before, after, &mut self.cover);
        self.contact_states.swap(0, 1);
        self.switches.count(&self.motion.ws, &mut self.work);
        self.observer.step(&Frame {
            model,
            t,
            y,
            a: self.stepper.accelerations(),
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
            self.motion.accelerations(t, &self.y, &mut self.a);
            self.work.sample_evaluations += 1;
            let frame = Frame {
                model,
                t,
                y: &self.y,
                a: &self.a,
                ws: &self.motion.ws,
            };
            let index = self.next / FACTOR as u64;
            let row = self.pending.row(index);
            for (value, channel) in row.iter_mut().zip(&self.simulation.channels) {
                *value = channel.value(&frame);
            }
            if let (Some(worst), Some(now)) = (
                &mut self.imbalance,
                imbalance(model, t, &self.y, &self.a, &self.motion.ws),
            ) {
                *worst = worst.max(now);
            }
            if index < self.simulation.samples {
                self.observer.sample(index, &frame);
            }
        }
        self.stepper.interpolated_accelerations(
            t,
            &self.simulation.filtered_entries,
            &mut self.fast,
        );
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
                if let Some(axis) = channel.sensor_axis() {
                    *value = self.filtered[axis];
                }
            }
            self.observer.row(self.rows, row, &self.filtered)?;
            self.rows += 1;
        }
        ControlFlow::Continue(())
    }
}
