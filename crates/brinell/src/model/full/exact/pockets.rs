//! Pockets with their full levers, section 18: a slot holds its element along t_p alone, a round pocket in every direction.

use crate::lanes::Lanes;
use crate::model::full::pockets::{Cages, Pockets, cage_sums};
use crate::model::full::view::{column, columns, polar};
use crate::model::{Model, Workspace};

/// Where an element is in its pocket, in its own frame (e_r, e_t): X_j - x_c, the distance x, and the direction u from the
/// pocket's middle to the element, along which the wall is.
struct InPocket<L> {
    from_cage: (L, L),
    distance: L,
    toward: (L, L),
}

/// `pocket` are sine and cosine of theta_c + alpha_j; `radial` is r_j - e_r . x_c and `across` -e_t . x_c.
#[inline(always)]
fn in_pocket<L: Lanes>(
    is_round: bool,
    (sin, cos): (L, L),
    (sin_p, cos_p): (L, L),
    (radial, across): (L, L),
    pitch: L,
) -> InPocket<L> {
    // Sine and cosine of theta_c + alpha_j - theta_j.
    let sine = sin_p.times_plus(cos, -(cos_p * sin));
    let cosine = cos_p.times_plus(cos, sin_p * sin);
    let from_cage = (pitch + radial, across);
    if is_round {
        // 1 - cos without cancellation.
        let less = sine * sine / (L::splat(1.0) + cosine);
        let (x_r, x_t) = (pitch.times_plus(less, radial), pitch.minus_times(sine, across));
        let distance = x_r.times_plus(x_r, x_t * x_t).sqrt();
        let per = L::splat(1.0) / distance.at_least(L::splat(1e-300));
        InPocket { from_cage, distance, toward: (x_r * per, x_t * per) }
    } else {
        // x > 0 where the pocket is ahead; the wall then is behind the element.
        let x = sine.times_plus(from_cage.0, -(cosine * across));
        let toward = (sine.xor(x.and_bits(1 << 63)), -cosine.xor(x.and_bits(1 << 63)));
        InPocket { from_cage, distance: x.abs(), toward }
    }
}

/// Distance of the element of a slot from the middle of its pocket at the positions `q`, m.
pub(crate) fn stretch(model: &Model, slot: usize, q: &[f64]) -> f64 {
    let l = &model.layout;
    let at = l.cage(l.row(slot));
    let (sin, cos) = q[l.theta() + slot].sin_cos();
    let (x_r, x_t) = polar((sin, cos), &[q[at], q[at + 1]]);
    let pocket = (q[at + 2] + model.pocket_angle[slot]).sin_cos();
    let offset = (q[l.r() + slot] - x_r, -x_t);
    in_pocket(model.pocket.is_round, (sin, cos), pocket, offset, model.geometry.pitch_radius).distance
}

/// Pockets: their forces on the rollers, and the reactions on the cages, into `a`.
#[inline(always)]
pub(super) fn pockets<L: Lanes>(model: &Model, q: &[f64], v: &[f64], a: &mut [f64], ws: &mut Workspace) -> Pockets<L> {
    let l = &model.layout;
    let count = l.slots / L::COUNT;
    let q_r = column::<L>(q, 0, count);
    let [v_r, v_theta, v_phi] = columns::<L>(v, count);
    let [sin_a, cos_a] = [&model.pocket_direction[0], &model.pocket_direction[1]].map(|c| column::<L>(c, 0, count));
    let [play, per_play] = [&model.pocket_gap, &model.per_pocket_gap].map(|c| column::<L>(c, 0, count));
    let Workspace { sin, cos, pocket_force, on_roller, .. } = ws;
    let sin = column::<L>(sin, 0, count);
    let cos = column::<L>(cos, 0, count);
    let pocket_force = &mut L::groups_mut(pocket_force)[..count];
    let [radial, tangential, torque] = on_roller;
    let [radial, tangential, torque] = [radial, tangential, torque].map(|c| &mut L::groups_mut(c)[..count]);
    let pitch = L::splat(model.geometry.pitch_radius);
    let radius = L::splat(model.geometry.roller_radius);
    let per_slip = L::splat(1.0 / model.friction.slip_velocity);
    let pocket = model.pocket;
    let mut sums = Pockets { pocket: L::zero(), friction: L::zero(), lever: L::zero() };
    let period = l.row_period() / L::COUNT;
    for phase in 0..period {
        let cage = Cages::<L>::spread(model, q, v, phase);
        let (sin_c, cos_c) = cage.theta.sin_cos();
        let [mut to_x, mut to_y, mut to_spin] = [L::zero(); 3];
        let mut group = phase;
        while group < count {
            let (sin, cos) = (L::new(sin[group]), L::new(cos[group]));
            let (sin_a, cos_a) = (L::new(sin_a[group]), L::new(cos_a[group]));
            let pocket_at = (sin_c.times_plus(cos_a, cos_c * sin_a), cos_c.times_plus(cos_a, -(sin_c * sin_a)));
            let (x_r, x_t) = polar((sin, cos), &cage.x);
            let r = L::new(q_r[group]);
            let at = in_pocket(pocket.is_round, (sin, cos), pocket_at, (r - x_r, -x_t), pitch);
            let (w_r, w_t) = at.from_cage;
            let (u_r, u_t) = at.toward;
            // V_j - v_c, along u and along e_z x u.
            let (c_r, c_t) = polar((sin, cos), &cage.v);
            let d_r = L::new(v_r[group]) - c_r;
            let d_t = (pitch + r).times_plus(L::new(v_theta[group]), -c_t);
            let lever = u_r.times_plus(w_t, -(u_t * w_r));
            let reach = u_r.times_plus(w_r, u_t.times_plus(w_t, radius));
            let rate = cage.dtheta.times_plus(lever, u_r.times_plus(d_r, u_t * d_t));
            let (normal, elastic) =
                pocket.wall_force(at.distance, (L::new(play[group]), L::new(per_play[group])), rate);
            let across = u_r.times_plus(d_t, -(u_t * d_r));
            let slip = cage.dtheta.minus_times(reach, radius.times_plus(L::new(v_phi[group]), across));
            let friction = pocket.friction(normal, slip, per_slip);
            // On the element -N u and -friction along e_z x u.
            let on_r = friction.times_plus(u_t, -(normal * u_r));
            let on_t = -friction.times_plus(u_r, normal * u_t);
            radial[group] = on_r.array();
            tangential[group] = on_t.array();
            torque[group] = (-(radius * friction)).array();
            pocket_force[group] = normal.with_sign(-u_t).array();
            to_x += sin.times_plus(on_t, -(cos * on_r));
            to_y -= sin.times_plus(on_r, cos * on_t);
            to_spin += friction.times_plus(reach, -(normal * lever));
            sums.pocket = (normal - elastic).times_plus(rate, sums.pocket);
            sums.friction = friction.times_plus(slip, sums.friction);
            group += period;
        }
        cage_sums(model, phase, [to_x, to_y, to_spin], a);
    }
    sums
}
