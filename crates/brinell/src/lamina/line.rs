//! One contact of a balance, slice by slice: line load and Hertz's pressure.

use crate::defect::{Angles, SIDES, Side, relative_radius, wrap};
use crate::model::Model;
use crate::pressure::line_pressure;
use crate::scenario::{Bearing, Element, Law, Scenario};
use crate::slices::{Approach, Cover, Slices};
use crate::statics::{Balance, Problem};

/// Slices that the life needs: ISO/TS 16281 divides a roller in at least so many.
pub const FEWEST_SLICES: usize = 30;
/// Most slices: beyond, pressures and lives no longer change and time does.
const MOST_SLICES: usize = 200;

/// What one contact carries.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactLine {
    /// From 0.
    pub row: usize,
    /// Orbit angle, rad in [-pi, pi).
    pub angle: f64,
    /// Raceway.
    pub side: Side,
    /// Q, N.
    pub force: f64,
    /// T = sum of z_k q_k, N m.
    pub moment: f64,
    /// Line load q(z) of each slice, N/m.
    pub line_load: Vec<f64>,
    /// Largest pressure in each slice, Pa: of what damage leaves of it, where it leaves anything.
    pub pressure: Vec<f64>,
    /// Length that touches, m.
    pub touching: f64,
}

/// The scenario with [`FEWEST_SLICES`] to [`MOST_SLICES`]; `None` where its rollers have no slices (`law = "ecl"`, the
/// lumped model), and of balls.
pub(super) fn in_slices(s: &Scenario) -> Option<Scenario> {
    let rollers = s.bearing.element == Element::Roller;
    if !rollers || s.contact.law != Law::Sliced || !s.simulation.model.moves_every_part() {
        return None;
    }
    let mut s = s.clone();
    s.contact.slices = s.contact.slices.clamp(FEWEST_SLICES, MOST_SLICES);
    Some(s)
}

/// In the plane a straight roller's are not kept in the model.
pub(super) fn slices_of(model: &Model, bearing: &Bearing) -> Slices {
    let g = &model.geometry;
    let (length, diameter) = (g.roller_length, 2.0 * g.roller_radius);
    Slices::new(model.rules.slices, length, diameter, &bearing.profile)
}

/// How a roller and a raceway approach in a balance.
fn approach(model: &Model, balance: &Balance, orbit: f64, (slot, side): (usize, Side)) -> Approach {
    let (sin, cos) = orbit.sin_cos();
    let along = |x: [f64; 2]| cos * x[0] + sin * x[1];
    let lever = model.tilt.as_ref().map_or(0.0, |tilt| tilt.levers[slot]);
    let (slopes, beta) = match &balance.tilting {
        Some(tilted) => (tilted.rings.map(along), tilted.rollers[slot]),
        None => ([0.0; 2], 0.0),
    };
    let r = balance.r[slot];
    let (deformation, tilt) = match side {
        Side::Inner => {
            let raceway = along(balance.inner) + lever * slopes[0] - model.geometry.clearance;
            (raceway - r, slopes[0] - beta)
        }
        Side::Outer => {
            let raceway = along(balance.outer) + lever * slopes[1] + model.geometry.outer_gap;
            (r - raceway, beta - slopes[1])
        }
    };
    Approach { deformation, tilt, ..Approach::default() }
}

/// Inner and outer contact of a roller in a balance.
pub(super) fn lines(
    model: &Model,
    bearing: &Bearing,
    slices: &Slices,
    balanced: (&Problem, &Balance),
    slot: usize,
) -> [ContactLine; 2] {
    SIDES.map(|side| {
        let radius = relative_radius(bearing, side);
        line(model, slices, balanced, (slot, side), radius)
    })
}

/// One contact of a balance; `radius` is R_eq.
fn line(
    model: &Model,
    slices: &Slices,
    (problem, balance): (&Problem, &Balance),
    (slot, side): (usize, Side),
    radius: f64,
) -> ContactLine {
    let orbit = problem.orbit[slot];
    let at = approach(model, balance, orbit, (slot, side));
    let angles = Angles { orbit, spin: problem.spin[slot], ring: problem.ring_angle };
    let mut cover = Cover::new(slices.count);
    let (at, covered) = model.shown_in_slices((slot, side), &angles, at, &mut cover);
    let law = model.contact(side);
    let width = model.geometry.roller_length / slices.count as f64;
    let mut contact = ContactLine {
        row: model.layout.row(slot),
        angle: wrap(orbit),
        side,
        force: 0.0,
        moment: 0.0,
        line_load: Vec::with_capacity(slices.count),
        pressure: Vec::with_capacity(slices.count),
        touching: 0.0,
    };
    for (parts, z) in slices.parts(at, covered.then_some(&cover)).zip(&slices.z) {
        // Of the whole slice, as if all of it were left, and as if all of it were damaged.
        let carried = parts.map(|(share, delta)| (share, law.healthy(delta) / slices.count as f64));
        let [whole, sunk] = carried.map(|(share, force)| share * force);
        let force = whole + sunk;
        contact.force += force;
        contact.moment += z * force;
        contact.line_load.push(force / width);
        let hardest = carried.iter().filter(|part| part.0 > 0.0);
        let hardest = hardest.fold(0.0, |most: f64, part| most.max(part.1));
        contact.pressure.push(line_pressure(hardest, width, radius));
        let touches = carried.iter().filter(|part| part.1 > 0.0);
        contact.touching += width * touches.map(|part| part.0).sum::<f64>();
    }
    contact
}
