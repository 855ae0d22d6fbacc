//! One contact of a balance, slice by slice: line load and Hertz's pressure.

use crate::defect::{SIDES, Side, relative_radius, wrap};
use crate::model::Model;
use crate::pressure::line_pressure;
use crate::scenario::{Contact, Scenario};
use crate::slices::{Approach, Slices};
use crate::statics::{Balance, Problem, RingAt};

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
    /// Largest pressure in each slice, Pa.
    pub pressure: Vec<f64>,
    /// Length that touches, m.
    pub touching: f64,
}

/// The undamaged scenario with [`FEWEST_SLICES`] to [`MOST_SLICES`]; `None` for balls and for the lumped model.
pub(super) fn in_slices(s: &Scenario) -> Option<Scenario> {
    if s.bearing.has_balls() || !s.simulation.model.moves_every_part() {
        return None;
    }
    let mut s = Scenario { defects: Vec::new(), ..s.clone() };
    s.contact.slices = s.contact.slices.clamp(FEWEST_SLICES, MOST_SLICES);
    Some(s)
}

/// In the plane a straight roller's are not kept in the model.
pub(super) fn slices_of(model: &Model, s: &Scenario) -> Slices {
    let g = &model.geometry;
    Slices::new(s.contact.slices, g.roller_length, 2.0 * g.roller_radius, &s.bearing.profile)
}

/// How a roller and a raceway approach in a balance.
fn approach(model: &Model, balance: &Balance, orbit: f64, (slot, side): (usize, Side)) -> Approach {
    let (sin, cos) = orbit.sin_cos();
    let along = |x: [f64; 2]| cos * x[0] + sin * x[1];
    let (r, g) = (balance.r[slot], &model.geometry);
    let Some((tilted, tilt)) = balance.tilting.as_ref().zip(model.tilt.as_ref()) else {
        return Approach::pressed(match side {
            Side::Inner => -RingAt::new(model, (sin, cos), balance.inner, -g.clearance).beyond(r),
            Side::Outer => RingAt::new(model, (sin, cos), balance.outer, g.outer_gap).beyond(r),
        });
    };
    let (slopes, beta, lever) = (tilted.rings.map(along), tilted.rollers[slot], tilt.levers[slot]);
    let (deformation, tilt) = match side {
        Side::Inner => (along(balance.inner) + lever * slopes[0] - g.clearance - r, slopes[0] - beta),
        Side::Outer => (r - along(balance.outer) - lever * slopes[1] - g.outer_gap, beta - slopes[1]),
    };
    Approach { deformation, tilt, ..Approach::default() }
}

/// Inner and outer contact of a roller in a balance.
pub(super) fn lines(
    model: &Model,
    s: &Scenario,
    slices: &Slices,
    balanced: (&Problem, &Balance),
    slot: usize,
) -> [ContactLine; 2] {
    SIDES.map(|side| {
        let radius = relative_radius(&s.bearing, side);
        line(model, slices, balanced, (slot, side), (&s.contact, radius))
    })
}

/// One contact of a balance; `radius` is R_eq, and `of` has its material.
fn line(
    model: &Model,
    slices: &Slices,
    (problem, balance): (&Problem, &Balance),
    (slot, side): (usize, Side),
    (of, radius): (&Contact, f64),
) -> ContactLine {
    let orbit = problem.orbit[slot];
    let at = approach(model, balance, orbit, (slot, side));
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
    for (delta, z) in slices.deformations(at).zip(&slices.z) {
        let force = law.healthy(delta) / slices.count as f64;
        contact.force += force;
        contact.moment += z * force;
        contact.line_load.push(force / width);
        contact.pressure.push(line_pressure(of, force, width, radius));
        contact.touching += if delta > 0.0 { width } else { 0.0 };
    }
    contact
}
