//! Contact force around the bearing, gathered over a run: the load distribution of each row.

use crate::channel::Frame;
use crate::defect::{Side, wrap};
use crate::model::{Layout, Model};
use crate::scenario::ModelKind;
use crate::statics::{self, NoBalance, Problem};
use std::f64::consts::TAU;

/// Angular bins around the bearing.
pub const BINS: usize = 72;

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
                ModelKind::Reference => f.ws.kinematic_orbit[slot],
            };
            let turn = wrap(orbit) / TAU;
            let turn = if turn < 0.0 { turn + 1.0 } else { turn };
            let bin = ((turn * BINS as f64) as usize).min(BINS - 1);
            let row = &mut self.rows[l.row(slot)];
            row.sum[bin] += force[slot];
            row.max[bin] = row.max[bin].max(force[slot]);
            row.count[bin] += 1;
        }
    }
}

/// Load distribution of the static balance: rollers of all rows at several positions of the cage.
#[derive(Debug, Clone, PartialEq)]
pub struct StaticLoadZone {
    /// (row from 0, orbit angle in rad in [-pi, pi), Q_in, Q_out in N).
    pub points: Vec<(usize, f64, f64, f64)>,
    /// Largest Q_out, N.
    pub largest: f64,
    /// Extent of the zone where the inner raceway carries, rad; 0 where none does.
    pub extent: f64,
    /// Mean ring offset, inner less outer, m.
    pub shift: [f64; 2],
    /// Mean stiffness of the bearing between its rings, N/m.
    pub stiffness: [[f64; 2]; 2],
}

/// Positions of the cage over one pitch.
const PHASES: usize = 16;

/// The healthy or damaged bearing's static load distribution under its full load, as the cage turns through a pitch.
///
/// # Errors
/// Where the rings are not held against the load.
pub fn static_load_zone(model: &Model) -> Result<StaticLoadZone, NoBalance> {
    let l = &model.layout;
    let mut problem = Problem::at_start(model);
    let pitch = TAU / l.rollers_per_row as f64;
    let mut zone = StaticLoadZone {
        points: Vec::with_capacity(PHASES * l.rollers()),
        largest: 0.0,
        extent: 0.0,
        shift: [0.0; 2],
        stiffness: [[0.0; 2]; 2],
    };
    for phase in 0..PHASES {
        let turn = pitch * phase as f64 / PHASES as f64;
        problem
            .orbit
            .iter_mut()
            .zip(&model.pocket_angle)
            .for_each(|(o, a)| *o = a + turn);
        let balance = statics::solve(model, &problem)?;
        problem.guess = [balance.inner, balance.outer];
        for slot in 0..l.rollers() {
            let force = balance.outer_force[slot];
            zone.points.push((
                l.row(slot),
                wrap(problem.orbit[slot]),
                balance.inner_force[slot],
                force,
            ));
            zone.largest = zone.largest.max(force);
        }
        for k in 0..2 {
            zone.shift[k] += (balance.inner[k] - balance.outer[k]) / PHASES as f64;
            for j in 0..2 {
                zone.stiffness[k][j] += balance.stiffness[k][j] / PHASES as f64;
            }
        }
    }
    let middle = zone.shift[1].atan2(zone.shift[0]);
    let (mut first, mut last) = (0.0_f64, 0.0_f64);
    for &(_, angle, inner, _) in &zone.points {
        if inner > 0.0 {
            let from_middle = wrap(angle - middle);
            first = first.min(from_middle);
            last = last.max(from_middle);
        }
    }
    zone.extent = last - first;
    Ok(zone)
}
