//! Contact force around the bearing, gathered over a run: the load distribution of each row.

use crate::channel::Frame;
use crate::defect::{Side, wrap};
use crate::model::Layout;
use crate::scenario::ModelKind;
use std::f64::consts::TAU;

/// Angular bins around the bearing.
#[doc(hidden)]
pub const BINS: usize = 72;

/// The bin of an orbit angle, rad.
pub(super) fn bin_at(orbit: f64) -> usize {
    let turn = wrap(orbit) * (1.0 / TAU);
    let turn = if turn < 0.0 { turn + 1.0 } else { turn };
    ((turn * BINS as f64) as usize).min(BINS - 1)
}

/// Forces at the outer contacts of one row, by orbit angle: bin k spans [k, k + 1) 2 pi / BINS from +X, counter-clockwise.
#[derive(Debug, Clone, PartialEq)]
pub struct RowLoad {
    /// Sum of forces in each bin, N.
    sum: Vec<f64>,
    /// Largest force in each bin, N.
    pub max: Vec<f64>,
    /// Rollers seen in each bin.
    pub count: Vec<u64>,
}

impl RowLoad {
    fn new() -> Self {
        Self {
            sum: vec![0.0; BINS],
            max: vec![0.0; BINS],
            count: vec![0; BINS],
        }
    }

    /// Mean force in each bin, N; 0 where no roller came by.
    pub fn mean(&self) -> Vec<f64> {
        self.sum
            .iter()
            .zip(&self.count)
            .map(|(s, &n)| if n > 0 { s / n as f64 } else { 0.0 })
            .collect()
    }
}

/// Load distribution of every row.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadZone {
    /// One a row.
    pub rows: Vec<RowLoad>,
}

impl LoadZone {
    /// Empty.
    pub fn new(layout: &Layout) -> Self {
        Self {
            rows: vec![RowLoad::new(); layout.rows],
        }
    }

    /// Takes one instant.
    pub fn take(&mut self, f: &Frame) {
        let l = &f.model.layout;
        let force = &f.ws.contacts[Side::Outer as usize].force;
        for slot in 0..l.rollers() {
            let orbit = match f.model.kind {
                ModelKind::Full => f.y[l.theta() + slot],
                ModelKind::Lumped => f.ws.kinematic_orbit[slot],
            };
            let bin = bin_at(orbit);
            let row = &mut self.rows[l.row(slot)];
            row.sum[bin] += force[slot];
            row.max[bin] = row.max[bin].max(force[slot]);
            row.count[bin] += 1;
        }
    }
}
