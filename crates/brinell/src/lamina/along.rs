//! The load along one roller at rest over damage, beside that of the healthy bearing.

use super::line::{ContactLine, in_slices, lines, slices_of};
use crate::defect::{Defect, Side, wrap};
use crate::error::{Error, refuse};
use crate::model::Model;
use crate::scenario::{Bearing, Scenario, Surface};
use crate::slices::{Cover, Slices};
use crate::statics::{NoBalance, PHASES, Problem, StaticLoadZone, solve, static_load_zone};
use std::f64::consts::TAU;

/// Places along damage among which the weakest is looked for.
const PLACES: usize = 401;
/// Places across defects at which their pressures are looked at, of all defects together.
const ACROSS: usize = 64;
/// Defects that are looked at one by one: thousands can be alike.
const MOST_DEFECTS: usize = 32;
/// Rows whose heaviest contacts differ by less than this share carry alike.
const ALIKE: f64 = 1e-3;

/// One roller under the full load, every part at rest: over the damage where the contact carries least, or where the
/// healthy bearing's rollers carry most. Its contacts name its row and angle.
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
    /// Of one roller, as [`AtRest::over`] says.
    ///
    /// # Errors
    /// As for [`AtRest::of`].
    pub fn of(s: &Scenario, defect: Option<usize>) -> Result<Option<Self>, Error> {
        match AtRest::of(s)? {
            Some(at_rest) => at_rest.over(defect).map(Some),
            None => Ok(None),
        }
    }
}

/// A bearing at rest with and without its damage: what [`LoadAlong`] of each defect is taken from.
#[derive(Debug)]
pub struct AtRest {
    bearing: Bearing,
    healthy: Model,
    model: Model,
    /// Of the healthy bearing.
    zone: StaticLoadZone,
    slices: Slices,
}

impl AtRest {
    /// Of a scenario; `None` where rollers have no slices (`law = "ecl"`, the lumped model), and of balls.
    ///
    /// # Errors
    /// Every error among [`Scenario::problems`]; where the scenario makes no model, or nothing holds the rings against the load.
    pub fn of(s: &Scenario) -> Result<Option<Self>, Error> {
        refuse(s.problems())?;
        let Some(s) = in_slices(s) else {
            return Ok(None);
        };
        let healthy = Model::new(&Scenario { defects: Vec::new(), ..s.clone() })?;
        let zone = static_load_zone(&healthy)?;
        let model = Model::new(&s)?;
        let slices = slices_of(&model, &s.bearing);
        Ok(Some(Self { bearing: s.bearing, healthy, model, zone, slices }))
    }

    /// Over the defect with this index: damage of the outer raceway where it lies, of the inner one or of a roller
    /// turned into the middle of the load zone, a roller's towards the outer raceway. Without an index, or where that
    /// is of no defect, the roller that carries most: in the middle of the load zone, of the row with the most load.
    ///
    /// # Errors
    /// Where nothing holds the rings against the load.
    pub fn over(&self, defect: Option<usize>) -> Result<LoadAlong, Error> {
        let (model, slices) = (&self.model, &self.slices);
        let over = defect.and_then(|k| model.defects.get(k)).map(|defect| {
            let pressed = model.deflection(Side::Outer, self.zone.largest);
            (defect, weakest(model, slices, defect, pressed))
        });
        let (row, angle) = match over {
            Some(_) => (0, self.zone.middle),
            None => self.heaviest(),
        };
        let (problem, slot) = Problem::at_rest(model, over, row, angle);
        let contacts = |model: &Model| -> Result<_, Error> {
            let balance = solve(model, &problem)?;
            let balanced = (&problem, &balance);
            Ok(lines(model, &self.bearing, slices, balanced, slot))
        };
        let damaged = match model.defects.is_empty() {
            true => None,
            false => Some(contacts(model)?),
        };
        Ok(LoadAlong {
            z: slices.z[..slices.count].to_vec(),
            drop: slices.drop[..slices.count].to_vec(),
            healthy: contacts(&self.healthy)?,
            damaged,
        })
    }

    /// Row and angle (rad) of the roller that carries most in the healthy bearing. Rows that carry alike count as the
    /// first of them, and an angle beside the middle of the load zone as the middle: the rollers' positions have a grid.
    fn heaviest(&self) -> (usize, f64) {
        let (l, zone) = (&self.healthy.layout, &self.zone);
        let carries_most = |p: &&(usize, f64, f64, f64)| p.3 >= (1.0 - ALIKE) * zone.largest;
        let most = zone.points.iter().filter(carries_most).min_by_key(|p| p.0);
        let Some(&(row, angle, ..)) = most else {
            return (0, zone.middle);
        };
        let grid = TAU / (l.rollers_per_row * PHASES) as f64;
        (row, if wrap(angle - zone.middle).abs() < 2.0 * grid { zone.middle } else { angle })
    }
}

/// The roller over each defect, at places across it from edge to edge.
pub(super) fn over_damage(
    model: &Model,
    bearing: &Bearing,
    slices: &Slices,
) -> Result<Vec<[ContactLine; 2]>, NoBalance> {
    if model.defects.is_empty() {
        return Ok(Vec::new());
    }
    let middle = static_load_zone(model)?.middle;
    let looked_at = model.defects.len().min(MOST_DEFECTS);
    let across = (ACROSS / looked_at).max(1);
    let mut all = Vec::new();
    for defect in &model.defects[..looked_at] {
        let (first, last) = defect.shape.arc();
        for k in 0..across {
            // The middles of equal parts: an edge itself is on one side or the other by round-off.
            let s = first + (last - first) * (k as f64 + 0.5) / across as f64;
            let (problem, slot) = Problem::at_rest(model, Some((defect, s)), 0, middle);
            let balance = solve(model, &problem)?;
            all.push(lines(model, bearing, slices, (&problem, &balance), slot));
        }
    }
    Ok(all)
}

/// s (m) in the middle of where a contact that is pressed by `deformation` (m) without tilt carries least.
fn weakest(model: &Model, slices: &Slices, defect: &Defect, deformation: f64) -> f64 {
    let side = match defect.surface {
        Surface::InnerRaceway => Side::Inner,
        _ => Side::Outer,
    };
    let (first, last) = defect.shape.arc();
    let place = |k: usize| first + (last - first) * (k as f64 + 0.5) / PLACES as f64;
    let mut cover = Cover::new(slices.count);
    let carried: Vec<f64> = (0..PLACES)
        .map(|k| model.force_over(defect, side, place(k) / defect.radius, deformation, &mut cover))
        .collect();
    let least = carried.iter().copied().fold(f64::INFINITY, f64::min);
    let weak = |k: &usize| carried[*k] <= least * (1.0 + 1e-9);
    let first = (0..PLACES).find(weak).unwrap_or(0);
    let run = (first..PLACES).take_while(weak).count();
    place(first + run.saturating_sub(1) / 2)
}
