//! The rollers, a group of lanes at a time, in passes: how each contact moves and what may stand on damage; the elementary functions;
//! damage; and forces, pockets and what the bodies feel. Padded slots never close a contact and never move.

use super::{Sums, Turn};
use crate::defect::{Angles, SIDES, Side, acting_given};
use crate::elementary::Exponent;
use crate::lanes::{self, Lanes};
use crate::model::workspace::Contacts;
use crate::model::{Model, Power, Workspace};

/// The rollers' accelerations, into `a`, and what they do to everything else.
#[inline(always)]
pub(super) fn rollers<L: Lanes>(
    model: &Model,
    (q, v): (&[f64], &[f64]),
    a: &mut [f64],
    turn: Turn,
    ws: &mut Workspace,
) -> Sums {
    for (exposure, directions) in model.exposure.iter().zip(&mut ws.directions) {
        exposure.turn(turn.angle, directions);
    }
    // A pass for each function that is a long chain of operations which wait for one another: with little in between, the processor
    // works on several groups at once.
    directions::<L>(model, q, ws);
    motion::<L>(model, q, v, turn.speed, ws);
    exposed::<L>(model, ws);
    functions::<L>(model, ws);
    damage::<L>(model, q, turn.angle, ws);
    forces::<L>(model, q, v, a, turn.speed, ws)
}

/// Column `k` of a structure of arrays, as `count` groups.
#[inline(always)]
fn column<L: Lanes>(from: &[f64], k: usize, count: usize) -> &[L::Group] {
    &L::groups(from)[k * count..][..count]
}

/// r, theta and phi.
#[inline(always)]
fn columns<L: Lanes>(from: &[f64], count: usize) -> [&[L::Group]; 3] {
    [
        column::<L>(from, 0, count),
        column::<L>(from, 1, count),
        column::<L>(from, 2, count),
    ]
}

/// Three columns to write to.
#[inline(always)]
fn columns_mut<L: Lanes>(from: &mut [f64], count: usize) -> [&mut [L::Group]; 3] {
    let (first, rest) = L::groups_mut(from).split_at_mut(count);
    let (second, third) = rest.split_at_mut(count);
    [first, second, &mut third[..count]]
}

/// A vector in the plane, the same in every lane.
type Plane<L> = [L; 2];

#[inline(always)]
fn pair<L: Lanes>(from: &[f64]) -> Plane<L> {
    [L::splat(from[0]), L::splat(from[1])]
}

/// u along e_r and along e_t.
#[inline(always)]
fn polar<L: Lanes>((sin, cos): (L, L), u: &Plane<L>) -> (L, L) {
    (
        cos.times_plus(u[0], sin * u[1]),
        sin.minus_times(u[0], cos * u[1]),
    )
}

/// u along e_t.
#[inline(always)]
fn along_t<L: Lanes>((sin, cos): (L, L), u: &Plane<L>) -> L {
    sin.minus_times(u[0], cos * u[1])
}

/// `[delta]_+^n`.
#[inline(always)]
fn power<L: Lanes>(exponent: Exponent, delta: L) -> L {
    match exponent {
        Exponent::TenNinths => lanes::ten_ninths(delta),
        Exponent::One => delta.positive_part(),
        Exponent::Other(_) => delta.each(|x| exponent.of(x)),
    }
}

/// x, y and theta of each lane's cage, and their rates.
#[derive(Clone, Copy)]
struct Cages<L> {
    x: Plane<L>,
    theta: L,
    v: Plane<L>,
    dtheta: L,
}

impl<L: Lanes> Cages<L> {
    /// For the groups that stand as `phase` does in the pattern of rows.
    #[inline(always)]
    fn spread(model: &Model, q: &[f64], v: &[f64], phase: usize) -> Self {
        let l = &model.layout;
        let mut all = [L::zero(); 6];
        for (row, lanes) in model.row_lanes.iter().enumerate() {
            let lanes = L::new(L::groups(lanes)[phase]);
            let at = l.cage(row);
            for k in 0..3 {
                all[k] = lanes.times_plus(L::splat(q[at + k]), all[k]);
                all[3 + k] = lanes.times_plus(L::splat(v[at + k]), all[3 + k]);
            }
        }
        let [x, y, theta, dx, dy, dtheta] = all;
        Self {
            x: [x, y],
            theta,
            v: [dx, dy],
            dtheta,
        }
    }
}

/// Sums of power over the rollers.
#[derive(Clone, Copy)]
struct Flows<L> {
    drive: L,
    pocket: L,
    pocket_friction: L,
    drag: L,
    lever: L,
}

/// Sine and cosine of every orbit angle.
#[inline(always)]
fn directions<L: Lanes>(model: &Model, q: &[f64], ws: &mut Workspace) {
    let count = model.layout.slots / L::COUNT;
    let theta = column::<L>(q, 1, count);
    let sin = &mut L::groups_mut(&mut ws.sin)[..count];
    let cos = &mut L::groups_mut(&mut ws.cos)[..count];
    for group in 0..count {
        let (s, c) = lanes::sin_cos(L::new(theta[group]));
        sin[group] = s.array();
        cos[group] = c.array();
    }
}

/// Finds what may stand on damage.
#[inline(always)]
fn exposed<L: Lanes>(model: &Model, ws: &mut Workspace) {
    let count = model.layout.slots / L::COUNT;
    let sin = column::<L>(&ws.sin, 0, count);
    let cos = column::<L>(&ws.cos, 0, count);
    for (k, exposure) in model.exposure.iter().enumerate() {
        if exposure.slots.is_empty() {
            continue;
        }
        exposure.lanes::<L>((sin, cos), &ws.directions[k], &mut ws.exposed[k][..count]);
    }
}

/// How each contact moves: approach, its rate and slip.
#[inline(always)]
fn motion<L: Lanes>(model: &Model, q: &[f64], v: &[f64], w: f64, ws: &mut Workspace) {
    let l = &model.layout;
    let g = &model.geometry;
    let count = l.slots / L::COUNT;
    let q_r = column::<L>(q, 0, count);
    let [v_r, v_theta, v_phi] = columns::<L>(v, count);
    let (xi, vi) = (pair(&q[l.inner()..]), pair(&v[l.inner()..]));
    let (xo, vo) = (pair(&q[l.outer()..]), pair(&v[l.outer()..]));
    let pitch = L::splat(g.pitch_radius);
    let radius = L::splat(g.roller_radius);
    let surface = L::splat(w * g.inner_radius);
    let gap_in = column::<L>(&model.gaps[0], 0, count);
    let gap_out = column::<L>(&model.gaps[1], 0, count);
    let Workspace {
        sin,
        cos,
        contacts: [inner, outer],
        ..
    } = ws;
    let sin = column::<L>(sin, 0, count);
    let cos = column::<L>(cos, 0, count);
    let [delta_in, rate_in, slip_in] = motion_of::<L>(inner, count);
    let [delta_out, rate_out, slip_out] = motion_of::<L>(outer, count);
    for group in 0..count {
        let r = L::new(q_r[group]);
        let dr = L::new(v_r[group]);
        let (dtheta, dphi) = (L::new(v_theta[group]), L::new(v_phi[group]));
        let axes = (L::new(sin[group]), L::new(cos[group]));
        let (xi_r, xi_t) = polar(axes, &xi);
        let (vi_r, vi_t) = polar(axes, &vi);
        let (xo_r, xo_t) = polar(axes, &xo);
        let (vo_r, vo_t) = polar(axes, &vo);
        delta_in[group] = (xi_r - r - L::new(gap_in[group])).array();
        delta_out[group] = (r - xo_r - L::new(gap_out[group])).array();
        rate_in[group] = (dtheta.times_plus(xi_t, vi_r) - dr).array();
        rate_out[group] = dtheta.minus_times(xo_t, dr - vo_r).array();
        let orbit_in = pitch.minus_times(dtheta, surface + vi_t);
        let orbit_out = pitch.minus_times(dtheta, vo_t);
        slip_in[group] = radius.times_plus(dphi, orbit_in).array();
        slip_out[group] = radius.minus_times(dphi, orbit_out).array();
    }
}

/// Approach, its rate and slip, to write to.
#[inline(always)]
fn motion_of<L: Lanes>(contacts: &mut Contacts, count: usize) -> [&mut [L::Group]; 3] {
    [
        &mut L::groups_mut(&mut contacts.approach)[..count],
        &mut L::groups_mut(&mut contacts.approach_rate)[..count],
        &mut L::groups_mut(&mut contacts.slip)[..count],
    ]
}

/// What each contact asks of elementary functions: the elastic force of a healthy raceway (section 2), and tanh of the slip in place of the
/// friction.
#[inline(always)]
fn functions<L: Lanes>(model: &Model, ws: &mut Workspace) {
    let count = model.layout.slots / L::COUNT;
    let per_slip = L::splat(1.0 / model.friction.slip_velocity);
    for side in SIDES {
        let law = model.contact(side);
        let stiffness = L::splat(law.stiffness);
        let contacts = &mut ws.contacts[side as usize];
        let approach = column::<L>(&contacts.approach, 0, count);
        let slip = column::<L>(&contacts.slip, 0, count);
        let exposed = &ws.exposed[side as usize][..count];
        let power = &mut L::groups_mut(&mut contacts.power)[..count];
        let elastic = &mut L::groups_mut(&mut contacts.elastic)[..count];
        let tanh = &mut L::groups_mut(&mut contacts.friction)[..count];
        let near = &mut ws.near[side as usize][..count];
        for group in 0..count {
            let delta = L::new(approach[group]);
            // Outside the load zone whole groups of inner contacts are open; a raised edge may still meet one.
            near[group] = exposed[group] != 0 || delta.any_positive();
            let mut x = L::zero();
            if near[group] {
                x = self::power(law.exponent, delta);
            }
            power[group] = x.array();
            elastic[group] = (stiffness * x).array();
        }
        for group in 0..count {
            if near[group] {
                tanh[group] = lanes::tanh(L::new(slip[group]) * per_slip).array();
            }
        }
    }
}

/// Elastic forces of the contacts that stand on damage, section 3, in place of those of healthy raceways.
#[inline(always)]
fn damage<L: Lanes>(model: &Model, q: &[f64], ring_angle: f64, ws: &mut Workspace) {
    for side in SIDES {
        let k = side as usize;
        if model.exposure[k].slots.is_empty() {
            continue;
        }
        let contacts = &mut ws.contacts[k];
        contacts.on_damage.fill(false);
        contacts.damaged_length.fill(0.0);
        let count = model.layout.slots / L::COUNT;
        for (group, exposed) in ws.exposed[k][..count].iter().enumerate() {
            if *exposed != 0 {
                let first = group * L::COUNT;
                on_damage(model, (side, first, *exposed), (q, ring_angle), contacts);
            }
        }
    }
}

/// `exposed` has a bit for each slot from `first`.
#[inline(never)]
fn on_damage(
    model: &Model,
    (side, first, mut exposed): (Side, usize, u8),
    (q, ring_angle): (&[f64], f64),
    contacts: &mut Contacts,
) {
    let l = &model.layout;
    while exposed != 0 {
        let slot = first + exposed.trailing_zeros() as usize;
        exposed &= exposed - 1;
        let angles = Angles {
            orbit: q[l.theta() + slot],
            spin: q[l.phi() + slot],
            ring: ring_angle,
        };
        let acting = acting_given(
            model.defects_of(slot, side),
            model.contact(side),
            &angles,
            side,
            contacts.approach[slot],
            contacts.power[slot],
        );
        if let Some(acting) = acting {
            contacts.elastic[slot] = acting.elastic;
            contacts.on_damage[slot] = true;
            contacts.damaged_length[slot] = acting.floor.damaged_length;
        }
    }
}

/// What the closed contacts of one side dissipate, and their stiffest.
#[derive(Clone, Copy)]
struct Closed<L> {
    contact: L,
    friction: L,
    heaviest: L,
}

/// Normal forces (section 2) and friction (section 4) of one side.
#[inline(always)]
fn closed<L: Lanes>(model: &Model, side: Side, ws: &mut Workspace) -> Closed<L> {
    let count = model.layout.slots / L::COUNT;
    let contacts = &mut ws.contacts[side as usize];
    let near = &ws.near[side as usize][..count];
    let rate = column::<L>(&contacts.approach_rate, 0, count);
    let slip = column::<L>(&contacts.slip, 0, count);
    let elastic = column::<L>(&contacts.elastic, 0, count);
    // tanh of the slip, and then the friction.
    let friction = &mut L::groups_mut(&mut contacts.friction)[..count];
    let force = &mut L::groups_mut(&mut contacts.force)[..count];
    let damping = L::splat(model.contact(side).damping);
    let mu = L::splat(model.friction.coefficient);
    let mut sums = Closed {
        contact: L::zero(),
        friction: L::zero(),
        heaviest: L::zero(),
    };
    for group in 0..count {
        let (mut normal, mut tangential) = (L::zero(), L::zero());
        if near[group] {
            let elastic = L::new(elastic[group]);
            let rate = L::new(rate[group]);
            let pressed = rate.times_plus(damping, elastic).positive_part();
            normal = elastic.if_above(L::zero(), pressed, L::zero());
            // A contact that parts faster than its damper lets it push carries no force, but still loses its elastic energy.
            tangential = mu * normal * L::new(friction[group]);
            sums.contact = (normal - elastic).times_plus(rate, sums.contact);
            sums.friction = tangential.times_plus(L::new(slip[group]), sums.friction);
            sums.heaviest = sums.heaviest.at_least(elastic);
        }
        force[group] = normal.array();
        friction[group] = tangential.array();
    }
    L::groups_mut(&mut ws.heaviest[side as usize])[0] = sums.heaviest.array();
    sums
}

/// Pockets (section 5), drag (section 7) and the rollers' own motion (Eq. 51).
#[inline(always)]
fn forces<L: Lanes>(
    model: &Model,
    q: &[f64],
    v: &[f64],
    a: &mut [f64],
    w: f64,
    ws: &mut Workspace,
) -> Sums {
    let l = &model.layout;
    let g = &model.geometry;
    let m = &model.inertia;
    let count = l.slots / L::COUNT;
    let [q_r, q_theta, _] = columns::<L>(q, count);
    let [v_r, v_theta, v_phi] = columns::<L>(v, count);
    let live = column::<L>(&model.live, 0, count);
    let pocket_angle = column::<L>(&model.pocket_angle, 0, count);
    let pocket_gap = column::<L>(&model.pocket_gap, 0, count);
    let heavy = model.gravity != [0.0; 2];
    let (xi, xo) = (pair(&q[l.inner()..]), pair(&q[l.outer()..]));
    let cage_at = l.cage(0);
    a[cage_at..cage_at + 3 * l.rows].fill(0.0);
    let (a_rollers, a_bodies) = a.split_at_mut(cage_at);
    let [out_r, out_theta, out_phi] = columns_mut::<L>(a_rollers, count);
    let inner = closed::<L>(model, Side::Inner, ws);
    let outer = closed::<L>(model, Side::Outer, ws);
    let Workspace {
        sin,
        cos,
        contacts: [at_inner, at_outer],
        pocket_force,
        pocket_friction,
        ..
    } = ws;
    let sin = column::<L>(sin, 0, count);
    let cos = column::<L>(cos, 0, count);
    let pocket_force = &mut L::groups_mut(pocket_force)[..count];
    let pocket_friction = &mut L::groups_mut(pocket_friction)[..count];
    let force_in = column::<L>(&at_inner.force, 0, count);
    let force_out = column::<L>(&at_outer.force, 0, count);
    let friction_in = column::<L>(&at_inner.friction, 0, count);
    let friction_out = column::<L>(&at_outer.friction, 0, count);

    let pitch = L::splat(g.pitch_radius);
    let radius = L::splat(g.roller_radius);
    let surface = L::splat(w * g.inner_radius);
    let gravity = pair(&model.gravity);
    let per_mass = L::splat(1.0 / m.roller);
    let per_spin = L::splat(1.0 / m.roller_spin);
    let drag_factor = L::splat(model.drag);
    let one = L::splat(1.0);

    let mut on_inner = [L::zero(); 2];
    let mut on_outer = [L::zero(); 2];
    let mut flows = Flows {
        drive: L::zero(),
        pocket: L::zero(),
        pocket_friction: L::zero(),
        drag: L::zero(),
        lever: L::zero(),
    };
    let period = l.row_period() / L::COUNT;
    for phase in 0..period {
        let cage = Cages::<L>::spread(model, q, v, phase);
        let [mut to_x, mut to_y, mut to_spin] = [L::zero(); 3];
        let mut group = phase;
        while group < count {
            let (r, theta) = (L::new(q_r[group]), L::new(q_theta[group]));
            let dr = L::new(v_r[group]);
            let (dtheta, dphi) = (L::new(v_theta[group]), L::new(v_phi[group]));
            let (sin, cos) = (L::new(sin[group]), L::new(cos[group]));
            let axes = (sin, cos);
            let orbit_speed = pitch * dtheta;
            let (q_in, f_in) = (L::new(force_in[group]), L::new(friction_in[group]));
            let (q_out, f_out) = (L::new(force_out[group]), L::new(friction_out[group]));
            flows.drive = f_in.times_plus(surface, flows.drive);

            // Pocket.
            let (xc_r, xc_t) = polar(axes, &cage.x);
            let alpha = L::new(pocket_angle[group]);
            let s = pitch.times_plus(cage.theta + alpha - theta, xc_t);
            let depth = (s.abs() - L::new(pocket_gap[group])).positive_part();
            let (mut push, mut rub, mut rub_moment) = (L::zero(), L::zero(), L::zero());
            if depth.any_positive() {
                let (vc_r, vc_t) = polar(axes, &cage.v);
                let ds = dtheta.minus_times(xc_r, pitch.times_plus(cage.dtheta - dtheta, vc_t));
                // Both sides at once: what closes on the side of s, with its sign.
                let closing = ds * one.with_sign(s);
                let elastic = L::splat(model.pocket.stiffness) * depth;
                let size = closing
                    .times_plus(L::splat(model.pocket.damping), elastic)
                    .positive_part();
                let size = depth.if_above(L::zero(), size, L::zero());
                push = size.with_sign(s);
                // sigma = -sign(F_c), 0 where the pocket is open.
                let sigma = size.if_above(L::zero(), one.with_sign(-push), L::zero());
                let u = dr - sigma * radius * (dphi - cage.dtheta) - vc_r;
                rub = -(traction(u.abs()) * size).with_sign_of(u);
                rub_moment = sigma * radius * rub;
                flows.pocket = (size - elastic).times_plus(closing, flows.pocket);
                flows.pocket_friction -= rub * u;
                to_x += push * sin - rub * cos;
                to_y -= push * cos + rub * sin;
                to_spin += rub_moment - push * pitch;
            }
            pocket_force[group] = push.array();
            pocket_friction[group] = rub.array();

            // Roller.
            let drag = drag_factor * orbit_speed * orbit_speed.abs();
            let arm = pitch + r;
            let tangential = f_in + f_out + push;
            let mut a_r = (dtheta * dtheta).times_plus(arm, (q_in - q_out + rub) * per_mass);
            let mut a_t = (dr + dr).minus_times(dtheta, (tangential - drag) * per_mass);
            if heavy {
                // Nothing else moves the slots that have no roller.
                let live = L::new(live[group]);
                let (g_r, g_t) = polar(axes, &gravity);
                a_r = live.times_plus(g_r, a_r);
                a_t = live.times_plus(g_t, a_t);
            }
            let a_phi = radius.times_plus(f_out - f_in, -rub_moment) * per_spin;
            out_r[group] = a_r.array();
            out_theta[group] = (a_t / arm).array();
            out_phi[group] = a_phi.array();

            // Reactions.
            on_inner[0] = q_in.minus_times(cos, f_in.times_plus(sin, on_inner[0]));
            on_inner[1] = q_in.minus_times(sin, f_in.minus_times(cos, on_inner[1]));
            on_outer[0] = q_out.times_plus(cos, f_out.times_plus(sin, on_outer[0]));
            on_outer[1] = q_out.times_plus(sin, f_out.minus_times(cos, on_outer[1]));

            flows.drag = (drag * arm).times_plus(dtheta, flows.drag);
            let (xi_t, xo_t) = (along_t(axes, &xi), along_t(axes, &xo));
            let levers = r.times_plus(tangential, q_in * xi_t);
            let levers = push.minus_times(xc_r, q_out.minus_times(xo_t, levers));
            flows.lever = dtheta.times_plus(levers, flows.lever);
            group += period;
        }
        for (row, lanes) in model.row_lanes.iter().enumerate() {
            let lanes = L::new(L::groups(lanes)[phase]);
            for (k, sum) in [to_x, to_y, to_spin].into_iter().enumerate() {
                a_bodies[3 * row + k] += (sum * lanes).sum();
            }
        }
    }
    Sums {
        on_inner: on_inner.map(L::sum),
        on_outer: on_outer.map(L::sum),
        power: Power {
            contact: (inner.contact + outer.contact).sum(),
            friction: (inner.friction + outer.friction).sum(),
            drive: flows.drive.sum(),
            pocket: flows.pocket.sum(),
            pocket_friction: flows.pocket_friction.sum(),
            drag: flows.drag.sum(),
            lever: flows.lever.sum(),
            ..Power::default()
        },
    }
}

/// The traction curve, Eq. (48), of |u|: see [`crate::cage::traction`].
#[inline(always)]
fn traction<L: Lanes>(u: L) -> L {
    use crate::cage::{TRACTION_DECAY, TRACTION_LIMIT, TRACTION_SLOPE};
    // Beyond this slip the exponential is below the last bit of the limit.
    let enough = L::splat(40.0 / TRACTION_DECAY);
    let u = u.if_above(enough, enough, u);
    let limit = L::splat(TRACTION_LIMIT);
    let rise = u.times_plus(L::splat(TRACTION_SLOPE), -limit);
    rise.times_plus(lanes::exp(u * L::splat(-TRACTION_DECAY)), limit)
}
