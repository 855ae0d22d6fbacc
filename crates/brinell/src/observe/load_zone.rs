//! Contact force around the bearing, gathered over a run: the load distribution of each row.

use crate::channel::Frame;
use crate::defect::{Side, wrap};
use crate::model::Layout;
use std::f64::consts::TAU;

/// Angular bins around the bearing.
#[doc(hidden)]
pub const BINS: usize = 72;

/// Where the rollers are at one instant, by bins: what [`LoadZone`] and the course of slip both ask.
#[derive(Debug, Clone, Default)]
pub struct Places(Vec<usize>);

impl Places {
    /// The bin of each roller, by slot.
    pub fn at(&mut self, f: &Frame) -> &[usize] {
        self.0.clear();
        self.0.extend(f.orbits()[..f.model.layout.rollers()].iter().map(|orbit| bin_at(*orbit)));
        &self.0
    }
}

/// The bin of an orbit angle, rad.
fn bin_at(orbit: f64) -> usize {
    let turn = wrap(orbit) * (1.0 / TAU);
    let turn = if turn < 0.0 { turn + 1.0 } else { turn };
    ((turn * BINS as f64) as usize).min(BINS - 1)
}

/// Forces at the outer contacts of one row, by orbit angle: bin k spans [k, k + 1) 2 pi / BINS from +X,
/// counter-clockwise.
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
        Self { sum: vec![0.0; BINS], max: vec![0.0; BINS], count: vec![0; BINS] }
    }

    /// Mean force in each bin, N; 0 where no roller came by.
    pub fn mean(&self) -> Vec<f64> {
        self.sum.iter().zip(&self.count).map(|(s, &n)| if n > 0 { s / n as f64 } else { 0.0 }).collect()
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
        Self { rows: vec![RowLoad::new(); layout.rows] }
    }

    /// Takes one instant, at which the rollers are in these bins.
    pub fn take(&mut self, f: &Frame, bins: &[usize]) {
        let force = &f.ws.contacts[Side::Outer as usize].force;
        let rows = self.rows.len();
        for (bins, force) in bins.chunks_exact(rows).zip(force.chunks_exact(rows)) {
            for ((row, bin), force) in self.rows.iter_mut().zip(bins).zip(force) {
                row.sum[*bin] += force;
                row.max[*bin] = row.max[*bin].max(*force);
                row.count[*bin] += 1;
            }
        }
    }
}
