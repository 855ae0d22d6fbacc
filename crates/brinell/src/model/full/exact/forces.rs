//! The rollers' own motion and what the rings feel of them, every force with its full lever (section 18).

use super::pockets::pockets;
use crate::defect::{SIDES, Side};
use crate::lanes::Lanes;
use crate::model::full::contacts::closed;
use crate::model::full::sums::{Sums, Turn};
use crate::model::full::view::{Plane, column, columns, columns_mut, pair, polar};
use crate::model::workspace::Contacts;
use crate::model::{Model, Power, Workspace};

/// Columns of one side's contacts.
struct Columns<'a, L: Lanes> {
    force: &'a [L::Group],
    film: &'a [L::Group],
    friction: &'a [L::Group],
    rolling: &'a [L::Group],
    normal_r: &'a [L::Group],
    normal_t: &'a [L::Group],
    distance: &'a [L::Group],
    deformation: &'a [L::Group],
    push: &'a [L::Group],
    push_element: &'a [L::Group],
    moment: &'a [L::Group],
}

impl<'a, L: Lanes> Columns<'a, L> {
    #[inline(always)]
    fn new(of: &'a Contacts, count: usize) -> Self {
        let all = |from: &'a [f64]| column::<L>(from, 0, count);
        Self {
            force: all(&of.force),
            film: all(&of.film),
            friction: all(&of.friction),
            rolling: all(&of.rolling),
            normal_r: all(&of.normal[0]),
            normal_t: all(&of.normal[1]),
            distance: all(&of.distance),
            deformation: all(&of.deformation),
            push: all(&of.push),
            push_element: all(&of.push_element),
            moment: L::groups(&of.moment),
        }
    }
}

/// What one side's contacts do, added up over a group of rollers.
#[derive(Clone, Copy)]
struct OnGroup<L> {
    /// Along e_r and e_t on the roller, N.
    radial: L,
    tangential: L,
    /// About its axis, N m.
    spin: L,
    /// Torque about the ring's centre on the ring, N m.
    ring: L,
    /// T, N m.
    moment: L,
}

/// What every roller needs of the model.
struct Constants<L> {
    radius: L,
    has_film: bool,
    has_damage: bool,
}

impl<L: Lanes> Columns<'_, L> {
    /// What the contacts of a group do; `tau` is the ring's slope where it tilts, in the rollers' frame.
    #[inline(always)]
    fn on_rollers<const TILT: bool>(&self, side: Side, k: usize, of: &Constants<L>, tau: (L, L)) -> OnGroup<L> {
        let mut normal = L::new(self.force[k]);
        if of.has_film {
            normal += L::new(self.film[k]);
        }
        let friction = L::new(self.friction[k]);
        let rolling = L::new(self.rolling[k]);
        let (n_r, n_t) = (L::new(self.normal_r[k]), L::new(self.normal_t[k]));
        let rho = L::new(self.distance[k]);
        let arm = L::splat(0.5).minus_times(L::new(self.deformation[k]), of.radius);
        // Forces along t without a lever: -P/rho, and of the normal's turning where rings tilt.
        let mut across = L::zero();
        let (mut spin, mut ring, mut moment) = (-rolling, rolling, L::zero());
        if of.has_damage {
            let (push, element) = (L::new(self.push[k]), L::new(self.push_element[k]));
            // Few groups have a contact that is pushed.
            if push.abs().any_positive() {
                across = -(push / rho);
            }
            spin += element;
            ring += push - element;
        }
        if TILT {
            moment = L::new(self.moment[k]);
            let turned = n_r.times_plus(tau.1, -(n_t * tau.0));
            let by_turning = moment * turned / rho;
            across = if side == Side::Inner { across - by_turning } else { across + by_turning };
        }
        // Q on the roller along n inside, against it outside; friction's levers b, and A = rho - b or rho + b on the ring.
        let along_t = friction + across;
        let (along_n, lever) = match side {
            Side::Inner => {
                spin = arm.minus_times(friction, spin);
                (normal, rho - arm)
            }
            Side::Outer => {
                spin = arm.times_plus(friction, spin);
                (-normal, rho + arm)
            }
        };
        OnGroup {
            radial: n_r.times_plus(along_n, -(n_t * along_t)),
            tangential: n_t.times_plus(along_n, n_r * along_t),
            spin,
            ring: lever.minus_times(friction, ring),
            moment,
        }
    }
}

/// Forces of contacts and pockets, the rollers' own motion, and what rings and cages feel of them.
#[inline(always)]
pub(in crate::model::full) fn forces<L: Lanes, const TILT: bool>(
    model: &Model,
    (q, v): (&[f64], &[f64]),
    a: &mut [f64],
    turn: Turn,
    ws: &mut Workspace,
) -> Sums {
    let l = &model.layout;
    let (g, m) = (&model.geometry, &model.inertia);
    let count = l.slots / L::COUNT;
    let cage_at = l.cage(0);
    a[cage_at..cage_at + 3 * l.rows].fill(0.0);
    let closed = SIDES.map(|side| closed::<L::Pair, TILT>(model, side, ws));
    let rolled = SIDES.map(|side| rolling::<L>(model, side, (v, turn.speed), ws));
    let pockets = pockets::<L>(model, q, v, a, ws);
    let sides = [Columns::<L>::new(&ws.contacts[0], count), Columns::<L>::new(&ws.contacts[1], count)];
    let sin = column::<L>(&ws.sin, 0, count);
    let cos = column::<L>(&ws.cos, 0, count);
    let [on_r, on_t, on_spin] = ws.on_roller.each_ref().map(|c| column::<L>(c, 0, count));
    let constants =
        Constants { radius: L::splat(g.roller_radius), has_film: model.film.is_some(), has_damage: model.pushes() };
    let mask = column::<L>(&model.roller_mask, 0, count);
    let q_r = column::<L>(q, 0, count);
    let [v_r, v_theta, _] = columns::<L>(v, count);
    let ([out_r, out_theta, out_phi], out_beta) = columns_mut::<L>(a, count);
    let gravity = (model.gravity != [0.0; 2]).then(|| pair::<L>(&model.gravity));
    let (pitch, per_mass) = (L::splat(g.pitch_radius), L::splat(1.0 / m.roller));
    let per_spin = L::splat(1.0 / m.roller_spin);
    let drag_factor = L::splat(model.drag * g.pitch_radius * g.pitch_radius);
    let nothing = [[L::zero(); 2]; 2];
    let tau: [Plane<L>; 2] = if TILT { [pair(&q[l.inner_tilt()..]), pair(&q[l.outer_tilt()..])] } else { nothing };
    let levers = L::groups(model.tilt.as_ref().map_or(&[][..], |tilt| &tilt.levers));
    let per_tilt = L::splat(model.tilt.as_ref().map_or(0.0, |tilt| 1.0 / tilt.roller_inertia));
    let (mut on_ring, mut moments, mut torques) = (nothing, nothing, [L::zero(); 2]);
    let mut drags = L::zero();
    for group in 0..count {
        let axes = (L::new(sin[group]), L::new(cos[group]));
        let (sin, cos) = axes;
        let mut radial = L::new(on_r[group]);
        let mut tangential = L::new(on_t[group]);
        let mut spin = L::new(on_spin[group]);
        let mut tilting = L::zero();
        for (k, side) in SIDES.into_iter().enumerate() {
            let slope = if TILT { polar(axes, &tau[k]) } else { (L::zero(), L::zero()) };
            let on = sides[k].on_rollers::<TILT>(side, group, &constants, slope);
            radial += on.radial;
            tangential += on.tangential;
            spin += on.spin;
            torques[k] += on.ring;
            let x = cos.times_plus(on.radial, -(sin * on.tangential));
            let y = sin.times_plus(on.radial, cos * on.tangential);
            on_ring[k][0] -= x;
            on_ring[k][1] -= y;
            if TILT {
                // The ring's force acts at Z_i, and T tilts it about n.
                let z = L::new(levers[group]);
                let (n_r, n_t) = (L::new(sides[k].normal_r[group]), L::new(sides[k].normal_t[group]));
                let n_x = cos.times_plus(n_r, -(sin * n_t));
                let n_y = sin.times_plus(n_r, cos * n_t);
                let own = if side == Side::Inner { -on.moment } else { on.moment };
                moments[k][0] += own.times_plus(n_x, -(z * x));
                moments[k][1] += own.times_plus(n_y, -(z * y));
                tilting = if side == Side::Inner { tilting + on.moment } else { tilting - on.moment };
            }
        }
        let (dr, dtheta) = (L::new(v_r[group]), L::new(v_theta[group]));
        let arm = pitch + L::new(q_r[group]);
        let drag = drag_factor * dtheta * dtheta.abs();
        let mut a_r = (dtheta * dtheta).times_plus(arm, radial * per_mass);
        let mut a_t = (dr + dr).minus_times(dtheta, (tangential - drag) * per_mass);
        if let Some(gravity) = &gravity {
            let mask = L::new(mask[group]);
            let (g_r, g_t) = polar(axes, gravity);
            a_r = mask.times_plus(g_r, a_r);
            a_t = mask.times_plus(g_t, a_t);
        }
        out_r[group] = a_r.array();
        out_theta[group] = (a_t / arm).array();
        out_phi[group] = (spin * per_spin).array();
        if TILT {
            out_beta[group] = (tilting * per_tilt).array();
        }
        drags = (drag * arm).times_plus(dtheta, drags);
    }
    let drive = -torques[0].sum();
    Sums {
        on_inner: [on_ring[0][0].sum(), on_ring[0][1].sum()],
        on_outer: [on_ring[1][0].sum(), on_ring[1][1].sum()],
        moments: [0, 1].map(|k: usize| [moments[k][0].sum(), moments[k][1].sum()]),
        torques: [drive, -torques[1].sum()],
        power: Power {
            contact: (closed[0].contact + closed[1].contact).sum(),
            friction: (closed[0].friction + closed[1].friction).sum(),
            rolling: (rolled[0] + rolled[1]).sum(),
            drive: drive * turn.speed,
            pocket: pockets.pocket.sum(),
            pocket_friction: pockets.friction.sum(),
            drag: drags.sum(),
            ..Power::default()
        },
    }
}

/// Rolling resistance, section 22: M_r = k_r r Q tanh((dphi - w_g)/w_0) of each contact of one side, in place of its tanh; what it
/// dissipates, W.
#[inline(always)]
fn rolling<L: Lanes>(model: &Model, side: Side, (v, speed): (&[f64], f64), ws: &mut Workspace) -> L {
    let mut taken = L::zero();
    if model.friction.rolling == 0.0 {
        return taken;
    }
    let count = model.layout.slots / L::COUNT;
    let spin = column::<L>(v, 2, count);
    let speed = L::splat(if side == Side::Inner { speed } else { 0.0 });
    let arm = L::splat(model.friction.rolling * model.geometry.roller_radius);
    let per_speed = L::splat(1.0 / crate::friction::ROLLING_SPEED);
    let contacts = &mut ws.contacts[side as usize];
    let force = column::<L>(&contacts.force, 0, count);
    let rolling = &mut L::groups_mut(&mut contacts.rolling)[..count];
    for group in 0..count {
        let force = L::new(force[group]);
        let mut couple = L::zero();
        if force.any_positive() {
            let rate = L::new(spin[group]) - speed;
            couple = arm * force * (rate * per_speed).tanh();
            taken = couple.times_plus(rate, taken);
        }
        rolling[group] = couple.array();
    }
    taken
}
