//! The equations of motion of every part, section 8 of the model: Eqs. (28), (35), (41), (51).
//!
//! One pass over the rollers for the contacts, one for the damage, one for what the bodies feel. Levers are those of the
//! centred bearing, as in the paper; the energy that this leaves over is booked as [`Power::lever`].

use super::{Model, Power, Workspace};
use crate::defect::{Angles, SIDES, acting, edge_gradient};
use crate::scenario::Guidance;

/// Relative motion of one contact.
struct Approach {
    delta: f64,
    rate: f64,
}

/// dy/dt at (t, y).
pub(super) fn derivative(model: &Model, t: f64, y: &[f64], dy: &mut [f64], ws: &mut Workspace) {
    let l = &model.layout;
    let g = &model.geometry;
    let dof = l.dof();
    let (q, v) = y.split_at(dof);
    let (dq, a) = dy.split_at_mut(dof);
    dq.copy_from_slice(v);

    let (w, ring_angle) = model.rotation.at(t);
    let (xi, vi) = (&q[l.inner()..l.inner() + 2], &v[l.inner()..l.inner() + 2]);
    let (xo, vo) = (&q[l.outer()..l.outer() + 2], &v[l.outer()..l.outer() + 2]);
    let mut power = Power::default();
    let mut on_inner = [0.0; 2];
    let mut on_outer = [0.0; 2];

    normal_contacts(model, q, v, ring_angle, ws);

    // Cages gather their reactions while the rollers are visited.
    for row in 0..l.rows {
        let at = l.cage(row);
        a[at..at + 3].fill(0.0);
    }
    let m = &model.inertia;
    for slot in 0..l.rollers() {
        let (cos, sin) = (ws.cos[slot], ws.sin[slot]);
        let along_r = |u: &[f64]| cos * u[0] + sin * u[1];
        let along_t = |u: &[f64]| cos * u[1] - sin * u[0];
        let (r, theta) = (q[l.r() + slot], q[l.theta() + slot]);
        let (dr, dtheta, dphi) = (v[l.r() + slot], v[l.theta() + slot], v[l.phi() + slot]);
        let orbit_speed = g.pitch_radius * dtheta;
        let roll = g.roller_radius * dphi;

        // Raceway friction, section 4.
        let [inner, outer] = &mut ws.contacts;
        let (q_in, q_out) = (inner.force[slot], outer.force[slot]);
        let s_in = w * g.inner_radius + along_t(vi) - (orbit_speed - roll);
        let s_out = along_t(vo) - (orbit_speed + roll);
        let f_in = model.friction.force(q_in, s_in);
        let f_out = model.friction.force(q_out, s_out);
        (inner.slip[slot], outer.slip[slot]) = (s_in, s_out);
        (inner.friction[slot], outer.friction[slot]) = (f_in, f_out);

        // Pocket, section 5.
        let at = l.cage(l.row(slot));
        let (xc, vc) = (&q[at..at + 3], &v[at..at + 3]);
        let s = g.pitch_radius * (xc[2] + model.pocket_angle[slot] - theta) + along_t(xc);
        let ds = g.pitch_radius * (vc[2] - dtheta) + along_t(vc) - dtheta * along_r(xc);
        let push = model.pocket.force(s, ds);
        let sigma = if push == 0.0 { 0.0 } else { -push.signum() };
        let u = dr - sigma * g.roller_radius * (dphi - vc[2]) - along_r(vc);
        let rub = model.pocket.friction(push, u);
        (ws.pocket_force[slot], ws.pocket_friction[slot]) = (push, rub);

        let drag = model.drag * orbit_speed * orbit_speed.abs();

        // Roller.
        let arm = g.pitch_radius + r;
        let radial = q_in - q_out + rub;
        let tangential = f_in + f_out + push - drag;
        a[l.r() + slot] = radial / m.roller + along_r(&model.gravity) + arm * dtheta * dtheta;
        a[l.theta() + slot] =
            (tangential / m.roller + along_t(&model.gravity) - 2.0 * dr * dtheta) / arm;
        a[l.phi() + slot] = g.roller_radius * (f_out - f_in - sigma * rub) / m.roller_spin;

        // Reactions.
        on_inner[0] += -q_in * cos + f_in * sin;
        on_inner[1] += -q_in * sin - f_in * cos;
        on_outer[0] += q_out * cos + f_out * sin;
        on_outer[1] += q_out * sin - f_out * cos;
        a[at] += push * sin - rub * cos;
        a[at + 1] += -push * cos - rub * sin;
        a[at + 2] += -push * g.pitch_radius + sigma * g.roller_radius * rub;

        // Flows of energy: see `energy`.
        let rate_in = along_r(vi) + dtheta * along_t(xi) - dr;
        let rate_out = dr - along_r(vo) - dtheta * along_t(xo);
        power.contact +=
            (q_in - inner.elastic[slot]) * rate_in + (q_out - outer.elastic[slot]) * rate_out;
        power.friction += f_in * s_in + f_out * s_out;
        power.drive += f_in * w * g.inner_radius;
        power.pocket += push * ds - model.pocket.stiffness * model.pocket.penetration(s) * ds;
        power.pocket_friction -= rub * u;
        power.drag += drag * arm * dtheta;
        power.lever += dtheta * (q_in * along_t(xi) - q_out * along_t(xo) - push * along_r(xc))
            + r * dtheta * (f_in + f_out + push);
    }

    if model.rules.is_conservative() && !model.defects.is_empty() {
        edge_reaction(model, q, a, (w, ring_angle), ws, &mut power);
    }

    for row in 0..l.rows {
        let at = l.cage(row);
        let (guide_x, guide_v, guide_speed, reaction) = match model.guidance {
            Guidance::OuterRing => (xo, vo, 0.0, Some(&mut on_outer)),
            Guidance::InnerRing => (xi, vi, w, Some(&mut on_inner)),
            Guidance::Rollers => (xo, vo, 0.0, None),
        };
        if let Some(reaction) = reaction {
            let offset = [q[at] - guide_x[0], q[at + 1] - guide_x[1]];
            let f = model.guide.force(offset, v[at + 2], guide_speed);
            for k in 0..2 {
                a[at + k] += f.film[k] + f.land[k];
                reaction[k] -= f.film[k] + f.land[k];
                power.film += f.film[k] * (v[at + k] - guide_v[k]);
            }
            a[at + 2] += f.moment;
            power.film += f.moment * v[at + 2];
        }
        a[at] = a[at] / m.cage + model.gravity[0];
        a[at + 1] = a[at + 1] / m.cage + model.gravity[1];
        a[at + 2] /= m.cage_spin;
    }

    let (load_in, load_out) = model.load.on_rings(model.load.share(t));
    let rings = [
        (
            l.inner(),
            m.inner_ring,
            model.inner_support,
            on_inner,
            load_in,
        ),
        (
            l.outer(),
            m.outer_ring,
            model.outer_support,
            on_outer,
            load_out,
        ),
    ];
    for (at, mass, support, reaction, load) in rings {
        for k in 0..2 {
            let (x, speed) = (q[at + k], v[at + k]);
            let held = -support.stiffness * x - support.damping * speed;
            a[at + k] = (held + reaction[k] + load[k]) / mass + model.gravity[k];
            power.load += load[k] * speed;
            power.support += support.damping * speed * speed;
        }
    }
    ws.power = power;
}

/// The push of damage's slopes, `edge_reaction = "conservative"` (section 3): the generalised forces -dE/dtheta on the orbit and -dE/dphi on the
/// spin of each roller. At an inner defect the drive holds the ring against -dE/dW and so puts in dE/dW w_i.
///
/// -dE/dtheta is a moment about the bearing's centre; over the roller's arm it is a force along e_t. The local angles know nothing of the
/// rings' displacements, so that force has no reaction on them: the momentum audit books it as external.
fn edge_reaction(
    model: &Model,
    q: &[f64],
    a: &mut [f64],
    (w, ring_angle): (f64, f64),
    ws: &mut Workspace,
    power: &mut Power,
) {
    let l = &model.layout;
    for slot in 0..l.rollers() {
        let angles = Angles {
            orbit: q[l.theta() + slot],
            spin: q[l.phi() + slot],
            ring: ring_angle,
        };
        let arm = model.geometry.pitch_radius + q[l.r() + slot];
        ws.edge_force[slot] = 0.0;
        for side in SIDES {
            let contacts = &ws.contacts[side as usize];
            if !contacts.on_damage[slot] || contacts.elastic[slot] <= 0.0 {
                continue;
            }
            let delta = contacts.approach[slot];
            let defects = model.defects_of(slot, side);
            let e = edge_gradient(defects, model.contact(side), &angles, side, delta);
            ws.edge_force[slot] -= e.orbit / arm;
            a[l.theta() + slot] -= e.orbit / (model.inertia.roller * arm * arm);
            a[l.phi() + slot] -= e.spin / model.inertia.roller_spin;
            power.drive += e.ring * w;
        }
    }
}

/// Normal forces of every contact, sections 2 and 3.
fn normal_contacts(model: &Model, q: &[f64], v: &[f64], ring_angle: f64, ws: &mut Workspace) {
    let l = &model.layout;
    let g = &model.geometry;
    let (xi, vi) = (&q[l.inner()..l.inner() + 2], &v[l.inner()..l.inner() + 2]);
    let (xo, vo) = (&q[l.outer()..l.outer() + 2], &v[l.outer()..l.outer() + 2]);
    for slot in 0..l.rollers() {
        let (sin, cos) = q[l.theta() + slot].sin_cos();
        (ws.cos[slot], ws.sin[slot]) = (cos, sin);
        let (r, dr, dtheta) = (q[l.r() + slot], v[l.r() + slot], v[l.theta() + slot]);
        let along_r = |u: &[f64]| cos * u[0] + sin * u[1];
        let along_t = |u: &[f64]| cos * u[1] - sin * u[0];
        let approaches = [
            Approach {
                delta: along_r(xi) - r - g.clearance,
                rate: along_r(vi) + dtheta * along_t(xi) - dr,
            },
            Approach {
                delta: r - along_r(xo) - g.outer_gap,
                rate: dr - along_r(vo) - dtheta * along_t(xo),
            },
        ];
        for (side, approach) in SIDES.into_iter().zip(approaches) {
            let law = model.contact(side);
            let contacts = &mut ws.contacts[side as usize];
            let mut elastic = law.healthy(approach.delta);
            let mut damaged_length = 0.0;
            let mut on_damage = false;
            if !model.defects.is_empty() {
                let angles = Angles {
                    orbit: q[l.theta() + slot],
                    spin: q[l.phi() + slot],
                    ring: ring_angle,
                };
                if let Some(acting) = acting(
                    model.defects_of(slot, side),
                    law,
                    &angles,
                    side,
                    approach.delta,
                ) {
                    elastic = acting.elastic;
                    damaged_length = acting.floor.damaged_length;
                    on_damage = true;
                }
            }
            contacts.approach[slot] = approach.delta;
            contacts.elastic[slot] = elastic;
            contacts.damaged_length[slot] = damaged_length;
            contacts.on_damage[slot] = on_damage;
            contacts.force[slot] = law.with_damping(elastic, approach.rate);
        }
    }
}
