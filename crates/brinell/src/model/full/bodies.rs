//! Cages and rings, which take up what the rollers leave, and the push of damage's edges.

use super::{Sums, Turn};
use crate::cage::GuideForce;
use crate::defect::{Angles, SIDES, Side, edge_gradient};
use crate::model::{Model, Power, Workspace};

/// The push of damage's slopes, `edge_reaction = "conservative"` (section 3): the generalised forces -dE/dtheta on the orbit and -dE/dphi on the
/// spin of each roller. At an inner defect the drive holds the ring against -dE/dW and so puts in dE/dW w_i.
///
/// -dE/dtheta is a moment about the bearing's centre; over the roller's arm it is a force along e_t. The local angles know nothing of the
/// rings' displacements, so that force has no reaction on them: the momentum audit books it as external.
pub(super) fn edge_reaction(
    model: &Model,
    q: &[f64],
    a: &mut [f64],
    turn: Turn,
    ws: &mut Workspace,
    power: &mut Power,
) {
    let l = &model.layout;
    ws.edge_force.fill(0.0);
    for side in SIDES {
        let contacts = &ws.contacts[side as usize];
        for &slot in &model.broad_phase[side as usize].slots {
            if !contacts.on_damage[slot] || contacts.elastic[slot] <= 0.0 {
                continue;
            }
            let angles = Angles {
                orbit: q[l.theta() + slot],
                spin: q[l.phi() + slot],
                ring: turn.angle,
            };
            let arm = model.geometry.pitch_radius + q[l.r() + slot];
            let delta = contacts.deformation[slot];
            let defects = model.defects_of(slot, side);
            let e = edge_gradient(defects, model.contact(side), &angles, side, delta);
            ws.edge_force[slot] -= e.orbit / arm;
            a[l.theta() + slot] -= e.orbit / (model.inertia.roller * arm * arm);
            a[l.phi() + slot] -= e.spin / model.inertia.roller_spin;
            power.drive += e.ring * turn.speed;
        }
    }
}

/// What guides each cage (section 6), into the workspace. Long chains of operations that wait for one another and for no roller: a processor
/// that is given them first works on the rollers meanwhile.
#[inline(always)]
pub(super) fn guidance(model: &Model, (q, v): (&[f64], &[f64]), w: f64, ws: &mut Workspace) {
    let l = &model.layout;
    let (ring, ring_speed) = match model.land_on() {
        Side::Inner => (l.inner(), w),
        Side::Outer => (l.outer(), 0.0),
    };
    for (row, f) in ws.guidance.iter_mut().enumerate() {
        let at = l.cage(row);
        let offset = [q[at] - q[ring], q[at + 1] - q[ring + 1]];
        let velocity = [v[at] - v[ring], v[at + 1] - v[ring + 1]];
        *f = model.guide.force(offset, velocity, v[at + 2], ring_speed);
    }
}

/// The cages' own motion (Eq. 41).
#[inline(always)]
pub(super) fn cages(
    model: &Model,
    v: &[f64],
    a: &mut [f64],
    guidance: &[GuideForce],
    sums: &mut Sums,
) {
    let l = &model.layout;
    let m = &model.inertia;
    let (ring, reaction) = match model.land_on() {
        Side::Inner => (l.inner(), &mut sums.on_inner),
        Side::Outer => (l.outer(), &mut sums.on_outer),
    };
    for (row, f) in guidance.iter().enumerate() {
        let at = l.cage(row);
        for k in 0..2 {
            a[at + k] += f.film[k] + f.land[k];
            reaction[k] -= f.film[k] + f.land[k];
            sums.power.film += f.film[k] * (v[at + k] - v[ring + k]);
        }
        a[at + 2] += f.moment;
        sums.power.film += f.moment * v[at + 2];
        sums.power.land += f.land_loss;
        a[at] = a[at] / m.cage + model.gravity[0];
        a[at + 1] = a[at + 1] / m.cage + model.gravity[1];
        a[at + 2] /= m.cage_spin;
    }
}

/// Rings: Eqs. (28) and (35).
#[inline(always)]
pub(super) fn rings(model: &Model, t: f64, q: &[f64], v: &[f64], a: &mut [f64], sums: &mut Sums) {
    let l = &model.layout;
    let m = &model.inertia;
    let (load_in, load_out) = model.load.on_rings(model.load.share(t));
    let rings = [
        (
            l.inner(),
            m.inner_ring,
            model.inner_support,
            sums.on_inner,
            load_in,
        ),
        (
            l.outer(),
            m.outer_ring,
            model.outer_support,
            sums.on_outer,
            load_out,
        ),
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
