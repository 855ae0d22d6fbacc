//! The rollers one by one, with the functions of the standard library: slow, and plain to read beside the model's text.

use super::{Sums, Turn};
use crate::defect::{Angles, SIDES, Side, damaged_contact};
use crate::model::{Model, Power, Workspace};

/// The rollers' accelerations, into `a`, and what they do to everything else.
pub(super) fn rollers(
    model: &Model,
    (q, v): (&[f64], &[f64]),
    a: &mut [f64],
    turn: Turn,
    ws: &mut Workspace,
) -> Sums {
    let l = &model.layout;
    let g = &model.geometry;
    let m = &model.inertia;
    let [xi, xo] = [l.inner(), l.outer()].map(|at| [q[at], q[at + 1]]);
    let [vi, vo] = [l.inner(), l.outer()].map(|at| [v[at], v[at + 1]]);
    a.fill(0.0);
    ws.max_elastic = Default::default();
    let mut sums = Sums {
        on_inner: [0.0; 2],
        on_outer: [0.0; 2],
        power: Power::default(),
    };
    let power = &mut sums.power;
    for slot in 0..l.rollers() {
        let (r, theta, phi) = (q[l.r() + slot], q[l.theta() + slot], q[l.phi() + slot]);
        let (dr, dtheta, dphi) = (v[l.r() + slot], v[l.theta() + slot], v[l.phi() + slot]);
        let (sin, cos) = theta.sin_cos();
        (ws.sin[slot], ws.cos[slot]) = (sin, cos);
        let radial = |u: [f64; 2]| cos * u[0] + sin * u[1];
        let tangential = |u: [f64; 2]| cos * u[1] - sin * u[0];
        let angles = Angles {
            orbit: theta,
            spin: phi,
            ring: turn.angle,
        };
        let surface = turn.speed * g.inner_radius;
        let (orbit_speed, roll) = (g.pitch_radius * dtheta, g.roller_radius * dphi);

        // Raceways: sections 2 to 4.
        let mut normal = [0.0; 2];
        let mut friction = [0.0; 2];
        for side in SIDES {
            let k = side as usize;
            let law = model.contact(side);
            let (delta, rate, slip) = match side {
                Side::Inner => (
                    radial(xi) - r - g.clearance,
                    radial(vi) + dtheta * tangential(xi) - dr,
                    surface + tangential(vi) - (orbit_speed - roll),
                ),
                Side::Outer => (
                    r - radial(xo) - g.outer_gap,
                    dr - radial(vo) - dtheta * tangential(xo),
                    tangential(vo) - (orbit_speed + roll),
                ),
            };
            let damage = damaged_contact(model.defects_of(slot, side), law, &angles, side, delta);
            let elastic = damage.map_or_else(|| law.healthy(delta), |d| d.elastic);
            normal[k] = law.with_damping(elastic, rate);
            friction[k] = model.friction.force(normal[k], slip);
            power.contact += (normal[k] - elastic) * rate;
            power.friction += friction[k] * slip;
            let c = &mut ws.contacts[k];
            c.deformation[slot] = delta;
            c.approach_rate[slot] = rate;
            c.power[slot] = law.exponent.of(delta);
            c.elastic[slot] = elastic;
            c.force[slot] = normal[k];
            c.friction[slot] = friction[k];
            c.slip[slot] = slip;
            c.on_damage[slot] = damage.is_some();
            c.damaged_length[slot] = damage.map_or(0.0, |d| d.floor.damaged_length);
            ws.max_elastic[k][0] = ws.max_elastic[k][0].max(elastic);
        }
        let [q_in, q_out] = normal;
        let [f_in, f_out] = friction;
        power.drive += f_in * surface;

        // Pocket: section 5.
        let at = l.cage(l.row(slot));
        let (xc, vc) = ([q[at], q[at + 1]], [v[at], v[at + 1]]);
        let (theta_c, dtheta_c) = (q[at + 2], v[at + 2]);
        let s = g.pitch_radius * (theta_c + model.pocket_angle[slot] - theta) + tangential(xc);
        let ds = g.pitch_radius * (dtheta_c - dtheta) + tangential(vc) - dtheta * radial(xc);
        let push = model.pocket.force(s, ds);
        let sigma = if push == 0.0 { 0.0 } else { -push.signum() };
        let u = dr - sigma * g.roller_radius * (dphi - dtheta_c) - radial(vc);
        let rub = model.pocket.friction(push, u);
        let rub_moment = sigma * g.roller_radius * rub;
        (ws.pocket_force[slot], ws.pocket_friction[slot]) = (push, rub);
        let depth = model.pocket.penetration(s);
        power.pocket += (push - model.pocket.stiffness * depth) * ds;
        power.pocket_friction -= rub * u;

        // The roller: Eq. (51) and section 7.
        let drag = model.drag * orbit_speed * orbit_speed.abs();
        let arm = g.pitch_radius + r;
        a[l.r() + slot] =
            arm * dtheta * dtheta + radial(model.gravity) + (q_in - q_out + rub) / m.roller;
        a[l.theta() + slot] = ((f_in + f_out + push - drag) / m.roller + tangential(model.gravity)
            - 2.0 * dr * dtheta)
            / arm;
        a[l.phi() + slot] = (g.roller_radius * (f_out - f_in) - rub_moment) / m.roller_spin;
        power.drag += drag * arm * dtheta;
        power.lever += dtheta
            * (q_in * tangential(xi) - q_out * tangential(xo) - push * radial(xc)
                + r * (f_in + f_out + push));

        // Reactions.
        sums.on_inner[0] += f_in * sin - q_in * cos;
        sums.on_inner[1] -= q_in * sin + f_in * cos;
        sums.on_outer[0] += q_out * cos + f_out * sin;
        sums.on_outer[1] += q_out * sin - f_out * cos;
        a[at] += push * sin - rub * cos;
        a[at + 1] -= push * cos + rub * sin;
        a[at + 2] += rub_moment - push * g.pitch_radius;
    }
    sums
}
