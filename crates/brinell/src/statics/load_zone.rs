//! The static balance as the cage turns through a pitch: load zone, ring shift, stiffness of the bearing.

use super::balance::{NoBalance, Problem};
use super::solve;
use crate::defect::{SIDES, wrap};
use crate::model::Model;
use std::f64::consts::{PI, TAU};

/// Load distribution of the static balance: rollers of all rows at several positions of the cage.
#[derive(Debug, Clone, PartialEq)]
pub struct StaticLoadZone {
    /// (row from 0, orbit angle in rad in [-pi, pi), Q_in, Q_out in N).
    pub points: Vec<(usize, f64, f64, f64)>,
    /// Largest Q_out, N.
    pub largest: f64,
    /// Extent of the zone where the inner raceway carries, rad; 0 where none does, a full turn where every roller
    /// carries everywhere.
    pub extent: f64,
    /// Where it begins and ends, rad, counted from its middle [`Self::middle`].
    pub ends: (f64, f64),
    /// Direction in which the inner ring is displaced in the outer one, rad.
    pub middle: f64,
    /// Mean ring offset, inner less outer, m.
    pub shift: [f64; 2],
    /// Mean stiffness of the bearing between its rings, N/m.
    pub stiffness: [[f64; 2]; 2],
}

impl StaticLoadZone {
    /// What the inner raceway carries together, the mean over the positions of the cage, N.
    pub(crate) fn resultant(&self) -> f64 {
        let along = |k: fn(f64) -> f64| self.points.iter().map(|p| p.2 * k(p.1)).sum::<f64>() / PHASES as f64;
        along(f64::cos).hypot(along(f64::sin))
    }

    /// Static deformation of the heaviest contact on the softer raceway, m.
    pub(crate) fn deformation(&self, model: &Model) -> f64 {
        let on = |side| model.deflection(side, self.largest);
        SIDES.into_iter().map(on).fold(0.0, f64::max)
    }
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
        ends: (0.0, 0.0),
        middle: 0.0,
        shift: [0.0; 2],
        stiffness: [[0.0; 2]; 2],
    };
    for phase in 0..PHASES {
        let turn = pitch * phase as f64 / PHASES as f64;
        problem.orbit.iter_mut().zip(&model.pocket_angle).for_each(|(o, a)| *o = a + turn);
        let balance = solve(model, &problem)?;
        problem.guess = [balance.inner, balance.outer];
        for slot in 0..l.rollers() {
            let force = balance.outer_force[slot];
            zone.points.push((l.row(slot), wrap(problem.orbit[slot]), balance.inner_force[slot], force));
            zone.largest = zone.largest.max(force);
        }
        for k in 0..2 {
            zone.shift[k] += (balance.inner[k] - balance.outer[k]) / PHASES as f64;
            for j in 0..2 {
                zone.stiffness[k][j] += balance.stiffness[k][j] / PHASES as f64;
            }
        }
    }
    zone.middle = zone.shift[1].atan2(zone.shift[0]);
    if zone.points.iter().all(|point| point.2 > 0.0) {
        zone.ends = (-PI, PI);
    } else {
        for &(_, angle, inner, _) in &zone.points {
            if inner > 0.0 {
                let from_middle = wrap(angle - zone.middle);
                zone.ends.0 = zone.ends.0.min(from_middle);
                zone.ends.1 = zone.ends.1.max(from_middle);
            }
        }
    }
    zone.extent = zone.ends.1 - zone.ends.0;
    Ok(zone)
}
