//! The orbit of each cage's centre about the centre of the land that guides it: the last turns of the cage.

use crate::channel::Frame;
use crate::model::Model;
use crate::scenario::ModelKind;
use std::f64::consts::TAU;

/// Turns of the cage that are kept.
#[doc(hidden)]
pub const TURNS: usize = 4;
/// Points of a turn.
const POINTS: usize = 256;

/// A ring buffer of the cages' centres.
#[derive(Debug, Clone, PartialEq)]
pub struct CageOrbit {
    rows: usize,
    /// Samples from point to point.
    stride: u64,
    seen: u64,
    taken: usize,
    centres: Vec<[f64; 2]>,
    times: Vec<f64>,
}

impl CageOrbit {
    /// For a run of `duration` s at `sample_rate` Hz.
    pub fn new(model: &Model, duration: f64, sample_rate: f64) -> Self {
        let last = model.rotation.at(duration).0.abs();
        let speed = model.rolling_orbit_speed(if last > 0.0 { last } else { model.rotation.max_speed().abs() });
        let turn = if speed > 0.0 { TAU / speed } else { duration };
        // A cage of the lumped model has no freedom.
        let rows = match model.kind {
            ModelKind::Full | ModelKind::Tilting => model.layout.rows,
            ModelKind::Lumped => 0,
        };
        let span = (TURNS as f64 * turn).min(duration);
        let capacity = TURNS * POINTS;
        Self {
            rows,
            stride: ((span * sample_rate / capacity as f64).round() as u64).max(1),
            seen: 0,
            taken: 0,
            centres: vec![[0.0; 2]; capacity * rows],
            times: vec![0.0; capacity],
        }
    }

    /// Takes one sample instant.
    pub fn take(&mut self, f: &Frame) {
        self.seen += 1;
        if self.rows == 0 || !(self.seen - 1).is_multiple_of(self.stride) {
            return;
        }
        let l = &f.model.layout;
        let land = f.model.land();
        let at = self.taken % self.times.len();
        self.taken += 1;
        self.times[at] = f.t;
        for row in 0..self.rows {
            let cage = l.cage(row);
            let [x, y] = land.centre(row, f.y);
            self.centres[at * self.rows + row] = [f.y[cage] - x, f.y[cage + 1] - y];
        }
    }

    /// Orbits of the cages, a row each; empty for the lumped model.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The row's points in time's order: (t in s, x and y in m from the guiding land's centre).
    pub fn points(&self, row: usize) -> impl Iterator<Item = (f64, [f64; 2])> + '_ {
        let capacity = self.times.len();
        let held = self.taken.min(capacity);
        (self.taken - held..self.taken).map(move |k| {
            let at = k % capacity;
            (self.times[at], self.centres[at * self.rows + row])
        })
    }
}
