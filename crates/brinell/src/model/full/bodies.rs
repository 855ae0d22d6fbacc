//! Cages and rings, which take up what the rollers leave.

use super::sums::{Sums, Turn};
use crate::cage::GuideForce;
use crate::defect::Side;
use crate::model::{Bodies, External, Forces, Model, Power, Tilt, Workspace};

/// What guides each cage (section 6), into the workspace. Long chains of operations that wait for one another and for
/// no roller: a processor that is given them first works on the rollers meanwhile.
#[inline(always)]
pub(super) fn guidance(model: &Model, (q, v): (&[f64], &[f64]), w: f64, ws: &mut Workspace) {
    let l = &model.layout;
    let ring_speed = match model.land_on() {
        Side::Inner => w,
        Side::Outer => 0.0,
    };
    let land = model.land();
    for (row, f) in ws.guidance.iter_mut().enumerate() {
        let at = l.cage(row);
        let (x, dx) = (land.centre(row, q), land.centre(row, v));
        let offset = [q[at] - x[0], q[at + 1] - x[1]];
        let velocity = [v[at] - dx[0], v[at + 1] - dx[1]];
        *f = model.guide.force(offset, velocity, v[at + 2], ring_speed);
    }
}

/// The cages' own motion (Eq. 41).
#[inline(always)]
pub(super) fn cages(
    model: &Model,
    (q, v): (&[f64], &[f64]),
    (a, ring_speed): (&mut [f64], f64),
    guidance: &[GuideForce],
    sums: &mut Sums,
) {
    let l = &model.layout;
    let m = &model.inertia;
    let side = model.land_on();
    let reaction = match side {
        Side::Inner => &mut sums.on_inner,
        Side::Outer => &mut sums.on_outer,
    };
    let land = model.land();
    for (row, f) in guidance.iter().enumerate() {
        let at = l.cage(row);
        let ring = land.centre(row, v);
        for k in 0..2 {
            let guided = f.film[k] + f.land[k];
            a[at + k] += guided;
            reaction[k] -= guided;
            if let Some(tilt) = &model.tilt {
                sums.moments[side as usize][k] -= tilt.rows[row] * guided;
            }
            sums.power.film += f.film[k] * (v[at + k] - ring[k]);
        }
        a[at + 2] += f.moment;
        sums.power.film += f.moment * v[at + 2];
        // The film's reaction on the ring, which drive or housing hold: M, and with its full lever e x F.
        let mut reaction = f.moment;
        if model.exact {
            let centre = land.centre(row, q);
            reaction += (q[at] - centre[0]) * f.film[1] - (q[at + 1] - centre[1]) * f.film[0];
            if side == Side::Inner {
                sums.power.film -= reaction * ring_speed;
                sums.power.drive += reaction * ring_speed;
            }
        }
        sums.torques[side as usize] += reaction;
        sums.power.land += f.land_loss;
        a[at] = a[at] / m.cage + model.gravity[0];
        a[at + 1] = a[at + 1] / m.cage + model.gravity[1];
        a[at + 2] /= m.cage_spin;
    }
}

/// Rings: Eqs. (28) and (35).
#[inline(always)]
pub(super) fn rings(model: &Model, t: f64, (q, v): (&[f64], &[f64]), a: &mut [f64], sums: &mut Sums) {
    let l = &model.layout;
    let m = &model.inertia;
    let (load_in, load_out) = model.load.on_rings(model.load.share(t));
    let rings = [
        (l.inner(), m.inner_ring, model.inner_support, sums.on_inner, load_in),
        (l.outer(), m.outer_ring, model.outer_support, sums.on_outer, load_out),
    ];
    for (at, mass, support, reaction, load) in rings {
        for k in 0..2 {
            let (x, speed) = (q[at + k], v[at + k]);
            let held = -support.stiffness * x - support.damping * speed;
            a[at + k] = (held + reaction[k] + load[k]) / mass + model.gravity[k];
            sums.power.load += load[k] * speed;
            sums.power.support += support.damping * speed * speed;
        }
    }
}

/// Tilting of the rings, section 16: the gyroscopic terms of the ring that turns do no work.
#[inline(always)]
pub(super) fn tilting_rings(
    model: &Model,
    tilt: &Tilt,
    (t, speed): (f64, f64),
    (q, v): (&[f64], &[f64]),
    a: &mut [f64],
    sums: &mut Sums,
) {
    let l = &model.layout;
    let (load_in, load_out) = model.load.on_rings(model.load.share(t));
    let rings = [(l.inner_tilt(), &tilt.inner, load_in), (l.outer_tilt(), &tilt.outer, load_out)];
    for ((at, ring, load), moment) in rings.into_iter().zip(sums.moments) {
        let spin = ring.polar_inertia * speed;
        // J ddtau_x = N_x - H dtau_y, J ddtau_y = N_y + H dtau_x.
        let gyroscopic = [-spin * v[at + 1], spin * v[at]];
        for k in 0..2 {
            let rate = v[at + k];
            let held = -ring.support.stiffness * q[at + k] - ring.support.damping * rate;
            let loaded = tilt.load_offset * load[k];
            a[at + k] = (held + moment[k] + loaded + gyroscopic[k]) / ring.inertia;
            sums.power.load += loaded * rate;
            sums.power.support += ring.support.damping * rate * rate;
        }
    }
}

/// Further forces of the user's own on all bodies.
#[cold]
pub(super) fn further(
    model: &Model,
    (t, turn): (f64, Turn),
    (q, v): (&[f64], &[f64]),
    a: &mut [f64],
    ws: &mut Workspace,
    power: &mut Power,
) {
    let bodies = Bodies {
        layout: &model.layout,
        pitch: model.geometry.pitch_radius,
        q,
        v,
        directions: [&ws.sin, &ws.cos],
        turn: (turn.angle, turn.speed),
    };
    let levers = model.tilt.as_ref().map_or(&[][..], |tilt| &tilt.rows);
    let (inertia, external) = (&model.inertia, External::default());
    let mut forces = Forces { bodies: &bodies, inertia, levers, a, power: 0.0, external };
    model.custom.forces.iter().for_each(|force| force.add(t, &bodies, &mut forces));
    power.load += forces.power;
    ws.external = forces.external;
}
