//! The equations of motion of every part, section 8 of the model: Eqs. (28), (35), (41), (51).
//!
//! Rollers go eight at a time, in three passes: how each contact moves and what may stand on damage; the elementary functions; and
//! forces, damage, pockets and what the bodies feel. Levers are those of the centred bearing, as in the paper; the energy that this
//! leaves over is booked as [`Power::lever`]. Padded slots never close a contact and never move.

use super::workspace::Contacts;
use super::{Kernel, Model, Power, Workspace};
use crate::defect::{Angles, SIDES, Side, acting_given, edge_gradient};
use crate::elementary::Exponent;
use crate::lanes::{self, Lanes, Portable, WIDTH};
use crate::scenario::Guidance;

/// dy/dt at (t, y), compiled for the instructions that the workspace's kernel names.
pub(super) fn derivative(model: &Model, t: f64, y: &[f64], dy: &mut [f64], ws: &mut Workspace) {
    match ws.kernel() {
        #[cfg(target_arch = "x86_64")]
        // SAFETY: a workspace holds a kernel only where the processor has its instructions.
        Kernel::Avx512 => unsafe { with_avx512(model, t, y, dy, ws) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        Kernel::Avx2 => unsafe { with_avx2(model, t, y, dy, ws) },
        _ => equations::<Portable>(model, t, y, dy, ws),
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
fn with_avx512(model: &Model, t: f64, y: &[f64], dy: &mut [f64], ws: &mut Workspace) {
    equations::<lanes::Avx512>(model, t, y, dy, ws);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn with_avx2(model: &Model, t: f64, y: &[f64], dy: &mut [f64], ws: &mut Workspace) {
    equations::<lanes::Avx2>(model, t, y, dy, ws);
}

/// dy/dt at (t, y).
#[inline(always)]
pub(super) fn equations<L: Lanes>(
    model: &Model,
    t: f64,
    y: &[f64],
    dy: &mut [f64],
    ws: &mut Workspace,
) {
    let l = &model.layout;
    let dof = l.dof();
    let (q, v) = y.split_at(dof);
    let (dq, a) = dy.split_at_mut(dof);
    dq.copy_from_slice(v);
    let (w, ring_angle) = model.rotation.at(t);
    for (exposure, directions) in model.exposure.iter().zip(&mut ws.directions) {
        exposure.turn(ring_angle, directions);
    }
    // Passes of their own, because these functions are long chains of operations that wait for one another: with little in between,
    // the processor works on several groups at once.
    motion::<L>(model, q, v, w, ws);
    functions::<L>(model, ws);
    let mut sums = rollers::<L>(model, q, v, a, (w, ring_angle), ws);
    if model.rules.is_conservative() && !model.defects.is_empty() {
        edge_reaction(model, q, a, (w, ring_angle), ws, &mut sums.power);
    }
    cages(model, q, v, a, w, &mut sums);
    self::rings(model, t, q, v, a, &mut sums);
    ws.power = sums.power;
}

type Group = [f64; WIDTH];

/// Column `k` of a structure of arrays, of `groups` groups each.
#[inline(always)]
fn column(from: &[f64], k: usize, groups: usize) -> &[Group] {
    &from.as_chunks::<WIDTH>().0[k * groups..(k + 1) * groups]
}

/// r, theta and phi.
#[inline(always)]
fn columns(from: &[f64], groups: usize) -> [&[Group]; 3] {
    [
        column(from, 0, groups),
        column(from, 1, groups),
        column(from, 2, groups),
    ]
}

/// Three columns to write to.
#[inline(always)]
fn columns_mut(from: &mut [f64], groups: usize) -> [&mut [Group]; 3] {
    let (all, _) = from[..3 * groups * WIDTH].as_chunks_mut::<WIDTH>();
    let (first, rest) = all.split_at_mut(groups);
    let (second, third) = rest.split_at_mut(groups);
    [first, second, third]
}

#[inline(always)]
fn groups(from: &[f64]) -> &[Group] {
    from.as_chunks::<WIDTH>().0
}

#[inline(always)]
fn groups_mut(from: &mut [f64]) -> &mut [Group] {
    from.as_chunks_mut::<WIDTH>().0
}

#[inline(always)]
fn put<L: Lanes>(x: L, to: &mut [f64], group: usize) {
    to.as_chunks_mut::<WIDTH>().0[group] = x.array();
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

#[inline(always)]
fn at<L: Lanes>(from: &[f64], group: usize) -> L {
    L::new(from.as_chunks::<WIDTH>().0[group])
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
        Exponent::Other(_) => L::new(delta.array().map(|x| exponent.of(x))),
    }
}

/// Elastic forces of a group's contacts that stand on damage, section 3, in place of those of healthy raceways.
#[inline(always)]
fn damaged_contacts<L: Lanes>(
    model: &Model,
    (side, group, exposed): (Side, usize, u8),
    (q, ring_angle): (&[f64], f64),
    elastic: L,
    contacts: &mut Contacts,
) -> L {
    let mut forces = elastic.array();
    on_damage(
        model,
        (side, group, exposed),
        (q, ring_angle),
        &mut forces,
        contacts,
    );
    L::new(forces)
}

#[inline(never)]
fn on_damage(
    model: &Model,
    (side, group, mut exposed): (Side, usize, u8),
    (q, ring_angle): (&[f64], f64),
    forces: &mut Group,
    contacts: &mut Contacts,
) {
    let l = &model.layout;
    while exposed != 0 {
        let lane = exposed.trailing_zeros() as usize;
        exposed &= exposed - 1;
        let slot = group * WIDTH + lane;
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
            forces[lane] = acting.elastic;
            contacts.on_damage[slot] = true;
            contacts.damaged_length[slot] = acting.floor.damaged_length;
        }
    }
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
    ws.edge_force.fill(0.0);
    for side in SIDES {
        let contacts = &ws.contacts[side as usize];
        for &slot in &model.exposure[side as usize].slots {
            if !contacts.on_damage[slot] || contacts.elastic[slot] <= 0.0 {
                continue;
            }
            let angles = Angles {
                orbit: q[l.theta() + slot],
                spin: q[l.phi() + slot],
                ring: ring_angle,
            };
            let arm = model.geometry.pitch_radius + q[l.r() + slot];
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

/// What the rollers do to everything else.
struct Sums {
    on_inner: [f64; 2],
    on_outer: [f64; 2],
    power: Power,
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
    /// `rows` has a group for each row: 1 in the lanes of its rollers, else 0.
    #[inline(always)]
    fn spread(model: &Model, q: &[f64], v: &[f64], rows: &[Group]) -> Self {
        let l = &model.layout;
        let mut all = [L::zero(); 6];
        for (row, lanes) in rows.iter().enumerate() {
            let lanes = L::new(*lanes);
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
    contact: L,
    friction: L,
    drive: L,
    pocket: L,
    pocket_friction: L,
    drag: L,
    lever: L,
}

/// How each contact moves: approach, its rate and slip. Finds what may stand on damage.
#[inline(always)]
fn motion<L: Lanes>(model: &Model, q: &[f64], v: &[f64], w: f64, ws: &mut Workspace) {
    let l = &model.layout;
    let g = &model.geometry;
    let groups = l.slots / WIDTH;
    let [q_r, q_theta, _] = columns(q, groups);
    let [v_r, v_theta, v_phi] = columns(v, groups);
    let (xi, vi) = (pair(&q[l.inner()..]), pair(&v[l.inner()..]));
    let (xo, vo) = (pair(&q[l.outer()..]), pair(&v[l.outer()..]));
    let pitch = L::splat(g.pitch_radius);
    let radius = L::splat(g.roller_radius);
    let surface = L::splat(w * g.inner_radius);
    let gaps = [
        column(&model.gaps[0], 0, groups),
        column(&model.gaps[1], 0, groups),
    ];
    for group in 0..groups {
        let r = L::new(q_r[group]);
        let dr = L::new(v_r[group]);
        let (dtheta, dphi) = (L::new(v_theta[group]), L::new(v_phi[group]));
        let axes = lanes::sin_cos(L::new(q_theta[group]));
        let (xi_r, xi_t) = polar(axes, &xi);
        let (vi_r, vi_t) = polar(axes, &vi);
        let (xo_r, xo_t) = polar(axes, &xo);
        let (vo_r, vo_t) = polar(axes, &vo);
        let delta = [
            xi_r - r - L::new(gaps[0][group]),
            r - xo_r - L::new(gaps[1][group]),
        ];
        let rate = [
            dtheta.times_plus(xi_t, vi_r) - dr,
            dtheta.minus_times(xo_t, dr - vo_r),
        ];
        let slip = [
            radius.times_plus(dphi, pitch.minus_times(dtheta, surface + vi_t)),
            radius.minus_times(dphi, pitch.minus_times(dtheta, vo_t)),
        ];
        put(axes.0, &mut ws.sin, group);
        put(axes.1, &mut ws.cos, group);
        for side in SIDES {
            let k = side as usize;
            let contacts = &mut ws.contacts[k];
            put(delta[k], &mut contacts.approach, group);
            put(rate[k], &mut contacts.approach_rate, group);
            put(slip[k], &mut contacts.slip, group);
            ws.exposed[k][group] = model.exposure[k].lanes(group, axes, &ws.directions[k]);
        }
    }
}

/// What each contact asks of elementary functions: `[delta]_+^n`, and tanh of the slip in place of the friction.
#[inline(always)]
fn functions<L: Lanes>(model: &Model, ws: &mut Workspace) {
    let per_slip = L::splat(1.0 / model.friction.slip_velocity);
    for side in SIDES {
        let exponent = model.contact(side).exponent;
        let contacts = &mut ws.contacts[side as usize];
        let approach = groups(&contacts.approach);
        let slip = &groups(&contacts.slip)[..approach.len()];
        let power = &mut groups_mut(&mut contacts.power)[..approach.len()];
        let tanh = &mut groups_mut(&mut contacts.friction)[..approach.len()];
        let exposed = &ws.exposed[side as usize][..approach.len()];
        let near = &mut ws.near[side as usize][..approach.len()];
        for group in 0..approach.len() {
            let delta = L::new(approach[group]);
            // Outside the load zone whole groups of inner contacts are open; a raised edge may still meet one.
            near[group] = exposed[group] != 0 || delta.any_positive();
            if near[group] {
                power[group] = self::power(exponent, delta).array();
                tanh[group] = lanes::tanh(L::new(slip[group]) * per_slip).array();
            } else {
                power[group] = [0.0; WIDTH];
            }
        }
    }
}

/// Normal forces (section 2) and damage (section 3), friction (section 4), pockets (section 5), drag (section 7) and the rollers' own
/// motion (Eq. 51).
#[inline(always)]
fn rollers<L: Lanes>(
    model: &Model,
    q: &[f64],
    v: &[f64],
    a: &mut [f64],
    (w, ring_angle): (f64, f64),
    ws: &mut Workspace,
) -> Sums {
    let l = &model.layout;
    let g = &model.geometry;
    let m = &model.inertia;
    let groups = l.slots / WIDTH;
    let [q_r, q_theta, _] = columns(q, groups);
    let [v_r, v_theta, v_phi] = columns(v, groups);
    let live = column(&model.live, 0, groups);
    let pocket_angle = column(&model.pocket_angle, 0, groups);
    let pocket_gap = column(&model.pocket_gap, 0, groups);
    let heavy = model.gravity != [0.0; 2];
    let (xi, xo) = (pair(&q[l.inner()..]), pair(&q[l.outer()..]));
    let cage_at = l.cage(0);
    a[cage_at..cage_at + 3 * l.rows].fill(0.0);
    let (a_rollers, a_bodies) = a.split_at_mut(cage_at);
    let [out_r, out_theta, out_phi] = columns_mut(a_rollers, groups);

    let pitch = L::splat(g.pitch_radius);
    let radius = L::splat(g.roller_radius);
    let surface = L::splat(w * g.inner_radius);
    let gravity = pair(&model.gravity);
    let damping = [
        L::splat(model.inner_contact.damping),
        L::splat(model.outer_contact.damping),
    ];
    let mu = L::splat(model.friction.coefficient);
    let per_mass = L::splat(1.0 / m.roller);
    let per_spin = L::splat(1.0 / m.roller_spin);
    let drag_factor = L::splat(model.drag);
    let one = L::splat(1.0);

    let mut heaviest = [L::zero(); 2];
    let mut on_inner = [L::zero(); 2];
    let mut on_outer = [L::zero(); 2];
    let mut flows = Flows {
        contact: L::zero(),
        friction: L::zero(),
        drive: L::zero(),
        pocket: L::zero(),
        pocket_friction: L::zero(),
        drag: L::zero(),
        lever: L::zero(),
    };
    let period = model.row_lanes.len();
    for (phase, rows) in model.row_lanes.iter().enumerate() {
        let cage = Cages::<L>::spread(model, q, v, rows);
        let [mut to_x, mut to_y, mut to_spin] = [L::zero(); 3];
        for group in (phase..groups).step_by(period) {
            let (r, theta) = (L::new(q_r[group]), L::new(q_theta[group]));
            let dr = L::new(v_r[group]);
            let (dtheta, dphi) = (L::new(v_theta[group]), L::new(v_phi[group]));
            let (sin, cos) = (at(&ws.sin, group), at(&ws.cos, group));
            let axes = (sin, cos);
            let orbit_speed = pitch * dtheta;

            // Normal forces and raceway friction.
            let mut normal = [L::zero(); 2];
            let mut friction = [L::zero(); 2];
            for side in SIDES {
                let k = side as usize;
                let law = model.contact(side);
                let contacts = &mut ws.contacts[k];
                if !model.exposure[k].slots.is_empty() {
                    contacts.on_damage[group * WIDTH..][..WIDTH].fill(false);
                    contacts.damaged_length[group * WIDTH..][..WIDTH].fill(0.0);
                }
                let mut elastic = L::zero();
                if ws.near[k][group] {
                    elastic = L::splat(law.stiffness) * at(&contacts.power, group);
                    if ws.exposed[k][group] != 0 {
                        elastic = damaged_contacts(
                            model,
                            (side, group, ws.exposed[k][group]),
                            (q, ring_angle),
                            elastic,
                            contacts,
                        );
                    }
                    let rate: L = at(&contacts.approach_rate, group);
                    let pressed = rate.times_plus(damping[k], elastic).positive_part();
                    normal[k] = elastic.if_above(L::zero(), pressed, L::zero());
                    // A contact that parts faster than its damper lets it push carries no force, but still loses its elastic energy.
                    friction[k] = mu * normal[k] * at(&contacts.friction, group);
                    flows.contact = (normal[k] - elastic).times_plus(rate, flows.contact);
                    flows.friction =
                        friction[k].times_plus(at(&contacts.slip, group), flows.friction);
                }
                heaviest[k] = heaviest[k].at_least(elastic);
                put(elastic, &mut contacts.elastic, group);
                put(normal[k], &mut contacts.force, group);
                put(friction[k], &mut contacts.friction, group);
            }
            let [q_in, q_out] = normal;
            let [f_in, f_out] = friction;
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
            put(push, &mut ws.pocket_force, group);
            put(rub, &mut ws.pocket_friction, group);
        }
        for (row, lanes) in rows.iter().enumerate() {
            let lanes = L::new(*lanes);
            for (k, sum) in [to_x, to_y, to_spin].into_iter().enumerate() {
                a_bodies[3 * row + k] += (sum * lanes).sum();
            }
        }
    }
    ws.heaviest = [heaviest[0].array(), heaviest[1].array()];
    Sums {
        on_inner: [on_inner[0].sum(), on_inner[1].sum()],
        on_outer: [on_outer[0].sum(), on_outer[1].sum()],
        power: Power {
            contact: flows.contact.sum(),
            friction: flows.friction.sum(),
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

/// Guidance (section 6) and the cages' own motion (Eq. 41).
#[inline(always)]
fn cages(model: &Model, q: &[f64], v: &[f64], a: &mut [f64], w: f64, sums: &mut Sums) {
    let l = &model.layout;
    let m = &model.inertia;
    for row in 0..l.rows {
        let at = l.cage(row);
        let guiding = match model.guidance {
            Guidance::OuterRing => Some((l.outer(), 0.0, &mut sums.on_outer)),
            Guidance::InnerRing => Some((l.inner(), w, &mut sums.on_inner)),
            Guidance::Rollers => None,
        };
        if let Some((ring, ring_speed, reaction)) = guiding {
            let offset = [q[at] - q[ring], q[at + 1] - q[ring + 1]];
            let f = model.guide.force(offset, v[at + 2], ring_speed);
            for k in 0..2 {
                a[at + k] += f.film[k] + f.land[k];
                reaction[k] -= f.film[k] + f.land[k];
                sums.power.film += f.film[k] * (v[at + k] - v[ring + k]);
            }
            a[at + 2] += f.moment;
            sums.power.film += f.moment * v[at + 2];
        }
        a[at] = a[at] / m.cage + model.gravity[0];
        a[at + 1] = a[at + 1] / m.cage + model.gravity[1];
        a[at + 2] /= m.cage_spin;
    }
}

/// Rings: Eqs. (28) and (35).
#[inline(always)]
fn rings(model: &Model, t: f64, q: &[f64], v: &[f64], a: &mut [f64], sums: &mut Sums) {
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
