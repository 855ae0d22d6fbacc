//! The load along one roller at rest over damage, beside that of the healthy bearing.

use super::{ContactLine, in_slices, lines, slices_of};
use crate::defect::{Defect, Side};
use crate::error::Error;
use crate::model::Model;
use crate::scenario::{Scenario, Surface};
use crate::statics::{Problem, solve, static_load_zone};

/// Places along damage among which the widest is looked for.
const PLACES: usize = 401;

/// One roller under the full load, every part at rest: over the damage where that is widest, or in the middle of the load zone.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadAlong {
    /// Middles of the slices, m from the roller's middle.
    pub z: Vec<f64>,
    /// Profile's drop there, m.
    pub drop: Vec<f64>,
    /// Inner and outer contact without any damage.
    pub healthy: [ContactLine; 2],
    /// The same with all damage; none where nothing is damaged.
    pub damaged: Option<[ContactLine; 2]>,
}

impl LoadAlong {
    /// Over the defect with this index: damage of the outer raceway where it lies, of the inner one or of a roller turned into the middle of the
    /// load zone, a roller's towards the outer raceway. Without an index, or where that is of no defect, the roller in the middle of the load zone.
    /// `None` where rollers have no slices (`law = "ecl"`, the lumped model), and of balls.
    ///
    /// # Errors
    /// Where the scenario makes no model, or nothing holds the rings against the load.
    pub fn of(s: &Scenario, defect: Option<usize>) -> Result<Option<Self>, Error> {
        let Some(s) = in_slices(s) else {
            return Ok(None);
        };
        let healthy = Model::new(&Scenario {
            defects: Vec::new(),
            ..s.clone()
        })?;
        let zone = static_load_zone(&healthy)?;
        let model = Model::new(&s)?;
        let over = defect.and_then(|k| model.defects.get(k));
        let (problem, slot) = at_rest(&model, over, zone.middle);
        let slices = slices_of(&model, &s.bearing);
        let contacts = |model: &Model| -> Result<_, Error> {
            let balance = solve(model, &problem)?;
            Ok(lines(
                model,
                &s.bearing,
                &slices,
                (&problem, &balance),
                slot,
            ))
        };
        let damaged = match model.defects.is_empty() {
            true => None,
            false => Some(contacts(&model)?),
        };
        Ok(Some(Self {
            z: slices.z[..slices.count].to_vec(),
            drop: slices.drop[..slices.count].to_vec(),
            healthy: contacts(&healthy)?,
            damaged,
        }))
    }
}

/// Where every part stands, and the slot that is looked at; `middle` is that of the load zone, rad.
fn at_rest(model: &Model, over: Option<&Defect>, middle: f64) -> (Problem, usize) {
    let l = &model.layout;
    let mut problem = Problem::at_start(model);
    let (slot, orbit) = match over {
        None => (0, middle),
        Some(defect) => {
            // With spin and inner ring at 0.
            let met = |side| defect.met_at(side, widest(defect) / defect.radius).orbit;
            match defect.surface {
                Surface::OuterRaceway => (l.slot(defect.row, 0), met(Side::Outer)),
                Surface::InnerRaceway => {
                    problem.ring_angle = middle - met(Side::Inner);
                    (l.slot(defect.row, 0), middle)
                }
                Surface::Roller(roller) => {
                    let slot = l.slot(defect.row, roller);
                    problem.spin[slot] = middle - met(Side::Outer);
                    (slot, middle)
                }
            }
        }
    };
    let cage = orbit - model.pocket_angle[slot];
    let places = problem.orbit.iter_mut().zip(&model.pocket_angle);
    places.for_each(|(orbit, pocket)| *orbit = pocket + cage);
    (problem, slot)
}

/// s (m) in the middle of where the damage is widest.
fn widest(defect: &Defect) -> f64 {
    let (first, last) = defect.shape.arc();
    let at = |k: usize| first + (last - first) * k as f64 / (PLACES - 1) as f64;
    let widths: Vec<f64> = (0..PLACES).map(|k| defect.damaged_length(at(k))).collect();
    let most = widths.iter().fold(0.0_f64, |m, w| m.max(*w));
    let wide = |k: &usize| widths[*k] >= (1.0 - 1e-9) * most;
    let first = (0..PLACES).find(wide).unwrap_or(0);
    let run = (first..PLACES).take_while(wide).count();
    at(first + run.saturating_sub(1) / 2)
}
