//! The rollers' own motion, and what the rings feel of them.

use super::contacts::closed;
use super::pockets::pockets;
use super::sums::Sums;
use super::view::{Plane, along_t, column, columns_mut, pair, polar};
use crate::defect::Side;
use crate::lanes::Lanes;
use crate::model::{Model, Power, Workspace};

/// Drag (section 7) and the rollers' own motion (Eq. 51), and what the rings feel of them.
#[inline(always)]
pub(super) fn forces<L: Lanes, const TILT: bool>(
    model: &Model,
    (q, v): (&[f64], &[f64]),
    a: &mut [f64],
    w: f64,
    ws: &mut Workspace,
) -> Sums {
    let l = &model.layout;
    let g = &model.geometry;
    let m = &model.inertia;
    let count = l.slots / L::COUNT;
    let cage_at = l.cage(0);
    a[cage_at..cage_at + 3 * l.rows].fill(0.0);
    let inner = closed::<L::Pair, TILT>(model, Side::Inner, ws);
    let outer = closed::<L::Pair, TILT>(model, Side::Outer, ws);
    let pockets = pockets::<L>(model, q, v, a, ws);
    let q_r = column::<L>(q, 0, count);
    let v_r = column::<L>(v, 0, count);
    let v_theta = column::<L>(v, 1, count);
    let mask = column::<L>(&model.roller_mask, 0, count);
    let heavy = model.gravity != [0.0; 2];
    let (xi, xo) = (pair(&q[l.inner()..]), pair(&q[l.outer()..]));
    let ([out_r, out_theta, out_phi], out_beta) = columns_mut::<L>(a, count);
    let sin = column::<L>(&ws.sin, 0, count);
    let cos = column::<L>(&ws.cos, 0, count);
    let pocket_force = column::<L>(&ws.pocket_force, 0, count);
    let pocket_friction = column::<L>(&ws.pocket_friction, 0, count);
    let [at_inner, at_outer] = &ws.contacts;
    let force_in = column::<L>(&at_inner.force, 0, count);
    let force_out = column::<L>(&at_outer.force, 0, count);
    let friction_in = column::<L>(&at_inner.friction, 0, count);
    let friction_out = column::<L>(&at_outer.friction, 0, count);
    let film_in = column::<L>(&at_inner.film, 0, count);
    let film_out = column::<L>(&at_outer.film, 0, count);

    let pitch = L::splat(g.pitch_radius);
    let gravity = pair(&model.gravity);
    let per_mass = L::splat(1.0 / m.roller);
    let per_spin = L::splat(g.roller_radius / m.roller_spin);
    // Of the square of the orbit's rate.
    let drag_factor = L::splat(model.drag * g.pitch_radius * g.pitch_radius);

    let mut on_inner = [L::zero(); 2];
    let mut on_outer = [L::zero(); 2];
    let mut turning = if TILT { Some(Turning::<L>::new(model, q)) } else { None };
    let (mut drive, mut drags, mut lever) = (L::zero(), L::zero(), pockets.lever);
    for group in 0..count {
        let r = L::new(q_r[group]);
        let (dr, dtheta) = (L::new(v_r[group]), L::new(v_theta[group]));
        let axes = (L::new(sin[group]), L::new(cos[group]));
        let (sin, cos) = axes;
        let (mut q_in, f_in) = (L::new(force_in[group]), L::new(friction_in[group]));
        let (mut q_out, f_out) = (L::new(force_out[group]), L::new(friction_out[group]));
        if model.film.is_some() {
            q_in += L::new(film_in[group]);
            q_out += L::new(film_out[group]);
        }
        drive += f_in;

        // Roller.
        let drag = drag_factor * dtheta * dtheta.abs();
        let arm = pitch + r;
        let (push, rub) = (L::new(pocket_force[group]), L::new(pocket_friction[group]));
        let tangential = f_in + f_out + push;
        let radial = q_in - q_out + rub;
        let mut a_r = (dtheta * dtheta).times_plus(arm, radial * per_mass);
        let mut a_t = (dr + dr).minus_times(dtheta, (tangential - drag) * per_mass);
        if heavy {
            // Nothing else moves the slots that have no roller.
            let mask = L::new(mask[group]);
            let (g_r, g_t) = polar(axes, &gravity);
            a_r = mask.times_plus(g_r, a_r);
            a_t = mask.times_plus(g_t, a_t);
        }
        // The pocket rubs where it presses: behind the roller or before it.
        let around = f_out - f_in + rub.xor(push.and_bits(1 << 63));
        out_r[group] = a_r.array();
        out_theta[group] = (a_t / arm).array();
        out_phi[group] = (around * per_spin).array();

        // Reactions.
        on_inner[0] = q_in.minus_times(cos, f_in.times_plus(sin, on_inner[0]));
        on_inner[1] = q_in.minus_times(sin, f_in.minus_times(cos, on_inner[1]));
        on_outer[0] = q_out.times_plus(cos, f_out.times_plus(sin, on_outer[0]));
        on_outer[1] = q_out.times_plus(sin, f_out.minus_times(cos, on_outer[1]));

        drags = (drag * arm).times_plus(dtheta, drags);
        let (mut xi_t, mut xo_t) = (along_t(axes, &xi), along_t(axes, &xo));
        if let Some(turning) = &mut turning {
            let moments = [at_inner, at_outer].map(|c| L::new(L::groups(&c.moment)[group]));
            let forces = [(q_in, f_in), (q_out, f_out)];
            turning.take(group, axes, forces, moments);
            out_beta[group] = ((moments[0] - moments[1]) * turning.per_inertia).array();
            let z = L::new(turning.levers[group]);
            let (tau_i, tau_o) = (along_t(axes, &turning.tau[0]), along_t(axes, &turning.tau[1]));
            (xi_t, xo_t) = (z.times_plus(tau_i, xi_t), z.times_plus(tau_o, xo_t));
            lever = dtheta.times_plus(moments[0] * tau_i - moments[1] * tau_o, lever);
        }
        let levers = q_out.minus_times(xo_t, r.times_plus(tangential, q_in * xi_t));
        lever = dtheta.times_plus(levers, lever);
    }
    Sums {
        on_inner: on_inner.map(L::sum),
        on_outer: on_outer.map(L::sum),
        moments: turning.map_or([[0.0; 2]; 2], |turning| turning.moments.map(|m| m.map(L::sum))),
        power: Power {
            contact: (inner.contact + outer.contact).sum(),
            friction: (inner.friction + outer.friction).sum(),
            drive: drive.sum() * w * g.inner_radius,
            pocket: pockets.pocket.sum(),
            pocket_friction: pockets.friction.sum(),
            drag: drags.sum(),
            lever: lever.sum(),
            ..Power::default()
        },
    }
}

/// What tilts the rings (section 16).
struct Turning<'a, L: Lanes> {
    levers: &'a [L::Group],
    /// 1/J_r.
    per_inertia: L,
    /// tau of the inner and of the outer ring.
    tau: [Plane<L>; 2],
    /// Moments N on both, N m.
    moments: [Plane<L>; 2],
}

impl<'a, L: Lanes> Turning<'a, L> {
    #[inline(always)]
    fn new(model: &'a Model, q: &[f64]) -> Self {
        let l = &model.layout;
        let tilt = model.tilt.as_ref();
        let per_inertia = tilt.map_or(0.0, |tilt| 1.0 / tilt.roller_inertia);
        Self {
            levers: L::groups(tilt.map_or(&[][..], |tilt| &tilt.levers)),
            per_inertia: L::splat(per_inertia),
            tau: [pair(&q[l.inner_tilt()..]), pair(&q[l.outer_tilt()..])],
            moments: [[L::zero(); 2]; 2],
        }
    }

    /// Takes up -(Z Q + T) e_r - Z f e_t on the inner ring and (Z Q + T) e_r - Z f e_t on the outer one.
    #[inline(always)]
    fn take(&mut self, group: usize, (sin, cos): (L, L), forces: [(L, L); 2], moments: [L; 2]) {
        let z = L::new(self.levers[group]);
        for (side, ((normal, friction), moment)) in forces.into_iter().zip(moments).enumerate() {
            let along_r = z.times_plus(normal, moment);
            let along_r = if side == 0 { -along_r } else { along_r };
            let along_t = z * friction;
            let [x, y] = &mut self.moments[side];
            *x = along_r.times_plus(cos, along_t.times_plus(sin, *x));
            *y = along_r.times_plus(sin, along_t.minus_times(cos, *y));
        }
    }
}
