//! The rollers' own motion, and what the rings feel of them.

use super::contacts::closed;
use super::pockets::pockets;
use super::sums::Sums;
use super::view::{Plane, along_t, column, columns_mut, pair, polar};
use crate::defect::Side;
use crate::lanes::Lanes;
use crate::model::workspace::Contacts;
use crate::model::{Model, Power, Workspace};

/// What acts on a group of rollers.
struct OnRollers<L> {
    /// Sine and cosine of the orbit angles.
    axes: (L, L),
    r: L,
    dr: L,
    dtheta: L,
    /// Q and f at the inner and at the outer raceway, the films' part among Q.
    contacts: [(L, L); 2],
    /// Normal force and friction of the pockets.
    pocket: (L, L),
}

/// Columns of that.
struct Columns<'a, L: Lanes> {
    axes: [&'a [L::Group]; 2],
    r: &'a [L::Group],
    dr: &'a [L::Group],
    dtheta: &'a [L::Group],
    /// Q, f and film of each side.
    contacts: [[&'a [L::Group]; 3]; 2],
    pocket: [&'a [L::Group]; 2],
    has_film: bool,
}

impl<'a, L: Lanes> Columns<'a, L> {
    #[inline(always)]
    fn new(model: &Model, q: &'a [f64], v: &'a [f64], ws: &'a Workspace) -> Self {
        let count = model.layout.slots / L::COUNT;
        let all = |from: &'a [f64]| column::<L>(from, 0, count);
        let side = |of: &'a Contacts| [all(&of.force), all(&of.friction), all(&of.film)];
        Self {
            axes: [all(&ws.sin), all(&ws.cos)],
            r: all(q),
            dr: all(v),
            dtheta: column::<L>(v, 1, count),
            contacts: [side(&ws.contacts[0]), side(&ws.contacts[1])],
            pocket: [all(&ws.pocket_force), all(&ws.pocket_friction)],
            has_film: model.film.is_some(),
        }
    }

    /// A function, and arrays without `map`, which is not compiled for the lanes' instructions: calls would cost a tenth.
    #[inline(always)]
    fn contact(&self, side: usize, k: usize) -> (L, L) {
        let [force, friction, film] = self.contacts[side];
        let mut normal = L::new(force[k]);
        if self.has_film {
            normal += L::new(film[k]);
        }
        (normal, L::new(friction[k]))
    }

    #[inline(always)]
    fn group(&self, k: usize) -> OnRollers<L> {
        let at = |column: &[L::Group]| L::new(column[k]);
        OnRollers {
            axes: (at(self.axes[0]), at(self.axes[1])),
            r: at(self.r),
            dr: at(self.dr),
            dtheta: at(self.dtheta),
            contacts: [self.contact(0, k), self.contact(1, k)],
            pocket: (at(self.pocket[0]), at(self.pocket[1])),
        }
    }
}

/// What the rollers' own motion (Eq. 51) needs of the model.
struct Constants<L> {
    pitch: L,
    /// Where gravity acts.
    gravity: Option<Plane<L>>,
    per_mass: L,
    per_spin: L,
    /// Of the square of the orbit's rate.
    drag: L,
}

impl<L: Lanes> Constants<L> {
    #[inline(always)]
    fn new(model: &Model) -> Self {
        let (g, m) = (&model.geometry, &model.inertia);
        Self {
            pitch: L::splat(g.pitch_radius),
            gravity: (model.gravity != [0.0; 2]).then(|| pair(&model.gravity)),
            per_mass: L::splat(1.0 / m.roller),
            per_spin: L::splat(g.roller_radius / m.roller_spin),
            drag: L::splat(model.drag * g.pitch_radius * g.pitch_radius),
        }
    }

    /// Second derivatives of r, theta and phi; the tangential force without drag, and the drag's power over the orbit's
    /// rate. `mask` is 0 for slots without a roller, which nothing but gravity would move.
    #[inline(always)]
    fn motion(&self, on: &OnRollers<L>, mask: L) -> ([L; 3], L, L) {
        let [(q_in, f_in), (q_out, f_out)] = on.contacts;
        let (pocket, pocket_friction) = on.pocket;
        let drag = self.drag * on.dtheta * on.dtheta.abs();
        let arm = self.pitch + on.r;
        let tangential = f_in + f_out + pocket;
        let radial = q_in - q_out + pocket_friction;
        let mut a_r = (on.dtheta * on.dtheta).times_plus(arm, radial * self.per_mass);
        let mut a_t = (on.dr + on.dr).minus_times(on.dtheta, (tangential - drag) * self.per_mass);
        if let Some(gravity) = &self.gravity {
            let (g_r, g_t) = polar(on.axes, gravity);
            a_r = mask.times_plus(g_r, a_r);
            a_t = mask.times_plus(g_t, a_t);
        }
        // The pocket rubs where it presses: behind the roller or before it.
        let around = f_out - f_in + pocket_friction.xor(pocket.and_bits(1 << 63));
        ([a_r, a_t / arm, around * self.per_spin], tangential, drag * arm)
    }
}

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
    let count = l.slots / L::COUNT;
    let cage_at = l.cage(0);
    a[cage_at..cage_at + 3 * l.rows].fill(0.0);
    let inner = closed::<L::Pair, TILT>(model, Side::Inner, ws);
    let outer = closed::<L::Pair, TILT>(model, Side::Outer, ws);
    let pockets = pockets::<L>(model, q, v, a, ws);
    let columns = Columns::<L>::new(model, q, v, ws);
    let constants = Constants::<L>::new(model);
    let mask = column::<L>(&model.roller_mask, 0, count);
    let (xi, xo) = (pair(&q[l.inner()..]), pair(&q[l.outer()..]));
    let ([out_r, out_theta, out_phi], out_beta) = columns_mut::<L>(a, count);

    let mut on_inner = [L::zero(); 2];
    let mut on_outer = [L::zero(); 2];
    let mut turning = if TILT { Some(Turning::<L>::new(model, q)) } else { None };
    let (mut drive, mut held) = (L::zero(), L::zero());
    let (mut drags, mut lever) = (L::zero(), pockets.lever);
    for group in 0..count {
        let on = columns.group(group);
        let ([a_r, a_theta, a_phi], tangential, drag) = constants.motion(&on, L::new(mask[group]));
        out_r[group] = a_r.array();
        out_theta[group] = a_theta.array();
        out_phi[group] = a_phi.array();

        // Reactions.
        let OnRollers { axes, r, dtheta, contacts: [(q_in, f_in), (q_out, f_out)], .. } = on;
        let (sin, cos) = axes;
        on_inner[0] = q_in.minus_times(cos, f_in.times_plus(sin, on_inner[0]));
        on_inner[1] = q_in.minus_times(sin, f_in.minus_times(cos, on_inner[1]));
        on_outer[0] = q_out.times_plus(cos, f_out.times_plus(sin, on_outer[0]));
        on_outer[1] = q_out.times_plus(sin, f_out.minus_times(cos, on_outer[1]));

        drive += f_in;
        held += f_out;
        drags = drag.times_plus(dtheta, drags);
        let (mut xi_t, mut xo_t) = (along_t(axes, &xi), along_t(axes, &xo));
        if let Some(turning) = &mut turning {
            let moment = |side: usize| L::new(L::groups(&ws.contacts[side].moment)[group]);
            let moments = [moment(0), moment(1)];
            turning.take(group, axes, on.contacts, moments);
            out_beta[group] = ((moments[0] - moments[1]) * turning.per_inertia).array();
            let z = L::new(turning.levers[group]);
            let (tau_i, tau_o) = (along_t(axes, &turning.tau[0]), along_t(axes, &turning.tau[1]));
            (xi_t, xo_t) = (z.times_plus(tau_i, xi_t), z.times_plus(tau_o, xo_t));
            lever = dtheta.times_plus(moments[0] * tau_i - moments[1] * tau_o, lever);
        }
        let levers = q_out.minus_times(xo_t, r.times_plus(tangential, q_in * xi_t));
        lever = dtheta.times_plus(levers, lever);
    }
    let torques = [drive.sum() * model.geometry.inner_radius, held.sum() * model.geometry.outer_radius];
    Sums {
        torques,
        on_inner: on_inner.map(L::sum),
        on_outer: on_outer.map(L::sum),
        moments: turning.map_or([[0.0; 2]; 2], |turning| turning.moments.map(|m| m.map(L::sum))),
        power: Power {
            contact: (inner.contact + outer.contact).sum(),
            friction: (inner.friction + outer.friction).sum(),
            drive: drive.sum() * w * model.geometry.inner_radius,
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
