//! The load distribution of a bearing: every contact at several positions of the cage.

use super::line::{ContactLine, lines, slices_of};
use crate::defect::Side;
use crate::error::{Error, refuse};
use crate::model::Model;
use crate::scenario::Scenario;
use crate::statics::{NoBalance, Problem, solve};
use std::f64::consts::TAU;

/// Positions of the cage over one pitch.
const POSITIONS: usize = 16;

/// Where a contact is pressed hardest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Pa.
    pub pressure: f64,
    /// Raceway.
    pub side: Side,
    /// From 0.
    pub row: usize,
    /// Orbit angle, rad.
    pub angle: f64,
    /// Middle of the slice, m.
    pub z: f64,
}

/// Static load distribution under the full load at several positions of the cage.
#[derive(Debug, Clone, PartialEq)]
pub struct Distribution {
    /// Middles of the slices, m.
    pub z: Vec<f64>,
    /// Profile's drop there, m.
    pub drop: Vec<f64>,
    /// Inner and outer contact of every roller at every position, position after position.
    pub contacts: Vec<[ContactLine; 2]>,
    /// Tilt of the inner ring in the outer one, mean over the positions, rad; 0 in the plane.
    pub tilt: [f64; 2],
    /// Largest tilt of a roller, rad.
    pub roller_tilt: f64,
    /// Mean stiffness between the rings over (x, y, tau_x, tau_y): N/m, N/rad, N m/rad. In the plane the first two
    /// alone, `None` here. Along the axis cylindrical rollers hold nothing, and about it they turn: what would be the
    /// fifth and sixth are 0.
    pub stiffness: Option<[[f64; 4]; 4]>,
}

impl Distribution {
    /// Of a scenario with its slices, without its damage.
    ///
    /// # Errors
    /// Every error among [`Scenario::problems`]; where the scenario makes no model, or nothing holds the rings against the load.
    pub fn of(s: &Scenario) -> Result<Self, Error> {
        refuse(s.problems())?;
        Self::unchecked(&Scenario { defects: Vec::new(), ..s.clone() })
    }

    /// The same of a scenario that was checked and has no damage.
    pub(super) fn unchecked(s: &Scenario) -> Result<Self, Error> {
        Ok(distribution(&Model::new(s)?, s)?)
    }

    /// Largest pressure on any slice; none where nothing is loaded.
    pub fn peak(&self) -> Option<Peak> {
        self.peak_among(0..self.z.len())
    }

    /// Largest pressure on the slices at the rollers' ends.
    pub fn end_peak(&self) -> Option<Peak> {
        self.peak_among([0, self.z.len() - 1])
    }

    fn peak_among(&self, slices: impl IntoIterator<Item = usize> + Clone) -> Option<Peak> {
        let lines = self.contacts.iter().flatten();
        let all = lines.flat_map(|line| slices.clone().into_iter().map(move |k| (line, k)));
        let (line, k) = all
            .filter(|(line, k)| line.pressure[*k] > 0.0)
            .max_by(|(a, i), (b, j)| a.pressure[*i].total_cmp(&b.pressure[*j]))?;
        Some(Peak { pressure: line.pressure[k], side: line.side, row: line.row, angle: line.angle, z: self.z[k] })
    }

    /// The contacts of the roller whose inner or outer contact carries most.
    pub fn heaviest(&self) -> Option<&[ContactLine; 2]> {
        let most = |pair: &[ContactLine; 2]| pair[0].force.max(pair[1].force);
        let loaded = self.contacts.iter().filter(|pair| most(pair) > 0.0);
        loaded.max_by(|a, b| most(a).total_cmp(&most(b)))
    }
}

fn distribution(model: &Model, s: &Scenario) -> Result<Distribution, NoBalance> {
    let l = &model.layout;
    let slices = slices_of(model, s);
    let share = 1.0 / POSITIONS as f64;
    let mut problem = Problem::at_start(model);
    let mut all = Distribution {
        z: slices.z[..slices.count].to_vec(),
        drop: slices.drop[..slices.count].to_vec(),
        contacts: Vec::with_capacity(POSITIONS * l.rollers()),
        tilt: [0.0; 2],
        roller_tilt: 0.0,
        stiffness: model.tilt.is_some().then_some([[0.0; 4]; 4]),
    };
    for k in 0..POSITIONS {
        problem.turn_cage(model, TAU / l.rollers_per_row as f64 * k as f64 / POSITIONS as f64);
        let balance = solve(model, &problem)?;
        problem.guess = [balance.inner, balance.outer];
        for slot in 0..l.rollers() {
            let pair = lines(model, s, &slices, (&problem, &balance), slot);
            all.contacts.push(pair);
        }
        let Some(tilted) = &balance.tilting else {
            continue;
        };
        for k in 0..2 {
            all.tilt[k] += share * (tilted.rings[0][k] - tilted.rings[1][k]);
        }
        let tilts = tilted.rollers.iter().map(|beta| beta.abs());
        all.roller_tilt = tilts.fold(all.roller_tilt, f64::max);
        for (sum, own) in all.stiffness.iter_mut().flatten().zip(&tilted.stiffness) {
            sum.iter_mut().zip(own).for_each(|(k, own)| *k += share * own);
        }
    }
    Ok(all)
}
