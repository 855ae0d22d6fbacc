//! The lumped model of section 10: two rings, kinematic cages, both contacts of a roller in series.
//!
//! It is our reading of what the paper's Ref. [43] does; the paper says no more of it. The state keeps the full model's
//! layout; coordinates of rollers and cages have zero rates there and their motion is a function of time.

use super::{Model, Power, Workspace, series_stiffness};
use crate::contact::{ContactReduction, LoadDeflection, damped};
use crate::defect::ecl::{depth_at_bottom, floors};
use crate::defect::{Angles, SIDES, Side};
use crate::scenario::Element;

/// One roller's series contact: law, and the depth that full-width damage takes from the deformation.
#[derive(Clone, Copy)]
struct Series {
    law: LoadDeflection,
    sunk: f64,
    damaged_length: [f64; 2],
    on_damage: [bool; 2],
}

impl Series {
    fn elastic(&self, delta: f64) -> f64 {
        self.law.healthy(delta - self.sunk)
    }
}

/// The series contact of one roller. Damage on either side acts on its own contact; of several on one side, the one
/// with the smallest elastic sum acts.
fn series(model: &Model, slot: usize, angles: &Angles, delta: f64) -> Series {
    let healthy = Series { law: model.series_contact, sunk: 0.0, damaged_length: [0.0; 2], on_damage: [false; 2] };
    if model.element == Element::Ball {
        return of_ball(model, slot, angles, healthy);
    }
    let damaged = SIDES.map(|side| {
        floors(model.defects_of(slot, side), angles)
            .map(|floor| (with_floors(model, &healthy, &[(side, floor)]).elastic(delta), floor))
            .reduce(|a, b| if b.0 < a.0 { b } else { a })
            .map(|(_, floor)| (side, floor))
    });
    match damaged {
        [None, None] => healthy,
        [Some(one), None] | [None, Some(one)] => with_floors(model, &healthy, &[one]),
        [Some(inner), Some(outer)] => with_floors(model, &healthy, &[inner, outer]),
    }
}

/// Damage takes its depth at the groove's bottom from a ball's deformation, by the ball's path (section 17).
fn of_ball(model: &Model, slot: usize, angles: &Angles, healthy: Series) -> Series {
    let mut series = healthy;
    for side in SIDES {
        if let Some(depth) = depth_at_bottom(model.defects_of(slot, side), angles) {
            series.sunk += depth;
            series.on_damage[side as usize] = true;
        }
    }
    series
}

/// A partial width multiplies its side's stiffness by g; the full width sinks the roller by h.
fn with_floors(model: &Model, healthy: &Series, floors: &[(Side, ContactReduction)]) -> Series {
    let mut series = *healthy;
    let mut k = [model.inner_contact.stiffness, model.outer_contact.stiffness];
    for &(side, floor) in floors {
        series.damaged_length[side as usize] = floor.damaged_length;
        series.on_damage[side as usize] = true;
        if floor.damaged_length < model.geometry.roller_length {
            k[side as usize] *= floor.share;
        } else {
            series.sunk += floor.depth;
        }
    }
    // Undamaged stiffnesses keep the healthy value to the bit.
    if k != [model.inner_contact.stiffness, model.outer_contact.stiffness] {
        series.law.stiffness = series_stiffness(k[0], k[1], model.series_contact.exponent.value());
    }
    series
}

/// Elastic energy of one roller's series contact at a deformation, J.
pub(super) fn energy_at(model: &Model, slot: usize, angles: &Angles, delta: f64) -> f64 {
    let contact = series(model, slot, angles, delta);
    contact.law.energy(delta - contact.sunk)
}

/// Elastic force (N), its tangent (N/m) and energy (J) of one roller's series contact at a deformation.
pub(crate) fn elastic_at(model: &Model, slot: usize, angles: &Angles, delta: f64) -> (f64, f64, f64) {
    let contact = series(model, slot, angles, delta);
    let x = delta - contact.sunk;
    (contact.law.healthy(x), contact.law.tangent(x), contact.law.energy(x))
}

/// Elastic energy of one roller's series contact as evaluated in `ws`, J.
pub(super) fn contact_energy(model: &Model, t: f64, slot: usize, ws: &Workspace) -> f64 {
    let angles = Angles { orbit: ws.kinematic_orbit[slot], spin: ws.kinematic_spin, ring: model.rotation.at(t).1 };
    energy_at(model, slot, &angles, ws.contacts[0].deformation[slot])
}

/// Accelerations at (t, y).
pub(super) fn accelerations(model: &Model, t: f64, y: &[f64], a: &mut [f64], ws: &mut Workspace) {
    let l = &model.layout;
    let g = &model.geometry;
    let (q, v) = y.split_at(l.dof());
    a.fill(0.0);
    let outer_moves = !model.outer_ring_is_fixed();

    let (w, ring_angle) = model.rotation.at(t);
    let travel = ring_angle * g.inner_radius / (2.0 * g.pitch_radius);
    let orbit_speed = model.rolling_orbit_speed(w);
    ws.kinematic_spin = -(ring_angle * g.inner_radius - g.pitch_radius * travel) / g.roller_radius;
    let (xi, vi) = (&q[l.inner()..l.inner() + 2], &v[l.inner()..l.inner() + 2]);
    let (xo, vo) = (&q[l.outer()..l.outer() + 2], &v[l.outer()..l.outer() + 2]);
    let x = [xi[0] - xo[0], xi[1] - xo[1]];
    let speed = [vi[0] - vo[0], vi[1] - vo[1]];
    let mut on_inner = [0.0; 2];
    let mut power = Power::default();
    for slot in 0..l.rollers() {
        let orbit = model.pocket_angle[slot] + travel;
        let (sin, cos) = orbit.sin_cos();
        (ws.cos[slot], ws.sin[slot]) = (cos, sin);
        ws.kinematic_orbit[slot] = orbit;
        let tangential = cos * x[1] - sin * x[0];
        let delta = cos * x[0] + sin * x[1] - g.clearance - g.outer_gap;
        let rate = cos * speed[0] + sin * speed[1] + orbit_speed * tangential;
        let angles = Angles { orbit, spin: ws.kinematic_spin, ring: ring_angle };
        let contact = series(model, slot, &angles, delta);
        let elastic = contact.elastic(delta);
        let damper = contact.law.damper(elastic, delta - contact.sunk);
        let force = damped(elastic, damper, rate);
        for side in SIDES {
            let k = side as usize;
            let c = &mut ws.contacts[k];
            (c.deformation[slot], c.elastic[slot], c.force[slot]) = (delta, elastic, force);
            (c.damaged_length[slot], c.on_damage[slot]) = (contact.damaged_length[k], contact.on_damage[k]);
        }
        on_inner[0] -= force * cos;
        on_inner[1] -= force * sin;
        power.contact += (force - elastic) * rate;
        power.lever += force * orbit_speed * tangential;
    }
    let (load_in, load_out) = model.load.on_rings(model.load.share(t));
    let m = &model.inertia;
    for k in 0..2 {
        let speed_in = vi[k];
        let support = &model.inner_support;
        a[l.inner() + k] = (on_inner[k] + load_in[k] - support.stiffness * xi[k] - support.damping * speed_in)
            / m.inner_ring
            + model.gravity[k];
        power.load += load_in[k] * speed_in;
        power.support += support.damping * speed_in * speed_in;
        if outer_moves {
            a[l.outer() + k] = (load_out[k] - on_inner[k]) / m.outer_ring + model.gravity[k];
            power.load += load_out[k] * vo[k];
        }
    }
    ws.power = power;
}
