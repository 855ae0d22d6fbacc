//! Hears a run: its signals as 32-bit floats, and what happened that no sensor tells. Allocates as rollers pass damage,
//! never in a step.

use brinell::channel::Frame;
use brinell::defect::{SIDES, Side};
use brinell::observe::passes::{Event, Passes};
use brinell::scenario::Scenario;
use brinell::simulate::{Observer, Simulation};
use brinell_io::Column;
use std::ops::ControlFlow;

/// An entry or exit, and the force with which its contact arrives there, at the solver's step before it, N.
pub(crate) struct Instant {
    pub(crate) event: Event,
    pub(crate) force: f64,
}

impl Instant {
    /// Contact of the roller: inner or outer.
    pub(crate) fn side(&self) -> String {
        self.event.side.word().to_owned()
    }
}

pub(crate) struct Truth {
    settled: f64,
    passes: Passes,
    /// Contact forces at the step before, by side, N.
    before: [Vec<f64>; 2],
    pub(crate) instants: Vec<Instant>,
    /// Of each roller's outer contact: sum and largest force over samples, N.
    pub(crate) outer: Vec<(f64, f64)>,
    pub(crate) samples: u64,
    pub(crate) largest: f64,
    /// Samples of the signals: sample_rate_hz * duration_s, half a second at 25 600 Hz being 12 800. The sample at the
    /// end of the run would be the first of what follows.
    keep: u64,
    pub(crate) kept: u64,
    /// Of each signal: its place in a row, where the run has it.
    places: Vec<Option<usize>>,
    pub(crate) signals: Vec<Vec<f32>>,
    /// The signal and the value that no 32-bit float holds, which ended the run.
    pub(crate) too_large: Option<(usize, f64)>,
}

impl Truth {
    pub(crate) fn new(scenario: &Scenario, simulation: &Simulation, signals: &[Column]) -> Self {
        let layout = &simulation.model().layout;
        let place = |signal: &Column| simulation.channels().iter().position(|c| c.name == signal.name);
        let places: Vec<Option<usize>> = signals.iter().map(place).collect();
        let whole = (scenario.simulation.duration_s * simulation.sample_rate()).round();
        let keep = simulation.samples().min(whole.max(1.0) as u64);
        let room = |place: &Option<usize>| match place {
            Some(_) => Vec::with_capacity(keep as usize),
            None => Vec::new(),
        };
        Self {
            settled: scenario.settled_s(),
            passes: Passes::new(simulation.model()),
            before: [0; 2].map(|_| vec![0.0; layout.rollers()]),
            instants: Vec::new(),
            outer: vec![(0.0, 0.0); layout.rollers()],
            samples: 0,
            largest: 0.0,
            keep,
            kept: 0,
            too_large: None,
            signals: places.iter().map(room).collect(),
            places,
        }
    }

    /// A signal, where the run has it.
    pub(crate) fn signal(&mut self, k: usize) -> Option<Vec<f32>> {
        self.places[k].map(|_| std::mem::take(&mut self.signals[k]))
    }
}

impl Observer for Truth {
    fn again(&mut self, simulation: &Simulation) -> ControlFlow<()> {
        self.passes = Passes::new(simulation.model());
        self.before.iter_mut().for_each(|forces| forces.fill(0.0));
        self.instants.clear();
        self.outer.fill((0.0, 0.0));
        self.signals.iter_mut().for_each(Vec::clear);
        (self.samples, self.largest, self.kept) = (0, 0.0, 0);
        ControlFlow::Continue(())
    }

    fn step(&mut self, frame: &Frame) {
        self.passes.take(frame, false, false);
        while let Some(event) = self.passes.events.pop_front() {
            let force = self.before[event.side as usize][event.slot];
            self.instants.push(Instant { event, force });
        }
        for (before, contacts) in self.before.iter_mut().zip(&frame.ws.contacts) {
            for (before, now) in before.iter_mut().zip(contacts.force.iter()) {
                *before = *now;
            }
        }
    }

    fn sample(&mut self, _: u64, frame: &Frame) {
        if frame.t < self.settled {
            return;
        }
        self.samples += 1;
        for side in SIDES {
            let force = &frame.ws.contacts[side as usize].force;
            for (slot, (sum, largest)) in self.outer.iter_mut().enumerate() {
                self.largest = self.largest.max(force[slot]);
                if side == Side::Outer {
                    *sum += force[slot];
                    *largest = largest.max(force[slot]);
                }
            }
        }
    }

    fn row(&mut self, index: u64, row: &[f64], _: &[f64]) -> ControlFlow<()> {
        if index >= self.keep {
            return ControlFlow::Continue(());
        }
        self.kept += 1;
        for (k, (signal, place)) in self.signals.iter_mut().zip(&self.places).enumerate() {
            if let Some(place) = place {
                let sample = row[*place] as f32;
                if !sample.is_finite() {
                    self.too_large.get_or_insert((k, row[*place]));
                    return ControlFlow::Break(());
                }
                signal.push(sample);
            }
        }
        ControlFlow::Continue(())
    }
}
