//! The load along the healthy bearing's roller that carries most.

use super::line::{ContactLine, in_slices, lines, slices_of};
use crate::defect::wrap;
use crate::error::{Error, refuse};
use crate::model::Model;
use crate::scenario::Scenario;
use crate::statics::{PHASES, Problem, StaticLoadZone, solve, static_load_zone};
use std::f64::consts::TAU;

/// Rows whose heaviest contacts differ by less than this share carry alike.
const ALIKE: f64 = 1e-3;

/// One roller under the full load, every part at rest and nothing damaged: where rollers carry most. Its contacts name its
/// row and angle.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadAlong {
    /// Middles of the slices, m from the roller's middle.
    pub z: Vec<f64>,
    /// Profile's drop there, m.
    pub drop: Vec<f64>,
    /// Inner and outer contact.
    pub contacts: [ContactLine; 2],
}

impl LoadAlong {
    /// Of a scenario; `None` for balls and for the lumped model.
    ///
    /// # Errors
    /// Every error among [`Scenario::problems`]; where the scenario makes no model, or nothing holds the rings against the load.
    pub fn of(s: &Scenario) -> Result<Option<Self>, Error> {
        refuse(s.problems())?;
        let Some(s) = in_slices(s) else {
            return Ok(None);
        };
        let model = Model::new(&s)?;
        let (row, angle) = heaviest(&model, &static_load_zone(&model)?);
        let (problem, slot) = Problem::at_rest(&model, None, row, angle);
        let balance = solve(&model, &problem)?;
        let slices = slices_of(&model, &s);
        Ok(Some(Self {
            z: slices.z[..slices.count].to_vec(),
            drop: slices.drop[..slices.count].to_vec(),
            contacts: lines(&model, &s, &slices, (&problem, &balance), slot),
        }))
    }
}

/// Row and angle (rad) of the roller that carries most. Rows that carry alike count as the first of them, and an angle
/// beside the middle of the load zone as the middle: the rollers' positions have a grid.
fn heaviest(model: &Model, zone: &StaticLoadZone) -> (usize, f64) {
    let carries_most = |p: &&(usize, f64, f64, f64)| p.3 >= (1.0 - ALIKE) * zone.largest;
    let most = zone.points.iter().filter(carries_most).min_by_key(|p| p.0);
    let Some(&(row, angle, ..)) = most else {
        return (0, zone.middle);
    };
    let grid = TAU / (model.layout.rollers_per_row * PHASES) as f64;
    (row, if wrap(angle - zone.middle).abs() < 2.0 * grid { zone.middle } else { angle })
}
