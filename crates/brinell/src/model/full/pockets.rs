//! Pockets, section 5.

use super::view::{Plane, along_t, column, columns, polar};
use crate::lanes::Lanes;
use crate::model::{Model, Workspace};

/// x, y and theta of each lane's cage, and their rates.
#[derive(Clone, Copy)]
pub(super) struct Cages<L> {
    pub(super) x: Plane<L>,
    pub(super) theta: L,
    pub(super) v: Plane<L>,
    pub(super) dtheta: L,
}

impl<L: Lanes> Cages<L> {
    /// For the groups at the place of `phase` in the pattern of rows.
    #[inline(always)]
    pub(super) fn spread(model: &Model, q: &[f64], v: &[f64], phase: usize) -> Self {
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
        Self { x: [x, y], theta, v: [dx, dy], dtheta }
    }
}

/// What the pockets make of the rollers' and cages' motion.
#[derive(Clone, Copy)]
pub(super) struct Pockets<L> {
    pub(super) pocket: L,
    pub(super) friction: L,
    pub(super) lever: L,
}

/// Pockets, section 5: their forces on the rollers, and the reactions on the cages, into `a`.
#[inline(always)]
pub(super) fn pockets<L: Lanes>(model: &Model, q: &[f64], v: &[f64], a: &mut [f64], ws: &mut Workspace) -> Pockets<L> {
    let l = &model.layout;
    let g = &model.geometry;
    let count = l.slots / L::COUNT;
    let theta = column::<L>(q, 1, count);
    let [v_r, v_theta, v_phi] = columns::<L>(v, count);
    let pocket_angle = column::<L>(&model.pocket_angle, 0, count);
    let [pocket_gap, per_gap] = [&model.pocket_gap, &model.per_pocket_gap].map(|c| column::<L>(c, 0, count));
    let Workspace { sin, cos, pocket_force, pocket_friction, .. } = ws;
    let sin = column::<L>(sin, 0, count);
    let cos = column::<L>(cos, 0, count);
    let pocket_force = &mut L::groups_mut(pocket_force)[..count];
    let pocket_friction = &mut L::groups_mut(pocket_friction)[..count];
    let pitch = L::splat(g.pitch_radius);
    let radius = L::splat(g.roller_radius);
    let one = L::splat(1.0);
    let per_slip = L::splat(1.0 / model.friction.slip_velocity);
    let pocket = model.pocket;
    let mut sums = Pockets { pocket: L::zero(), friction: L::zero(), lever: L::zero() };
    let period = l.row_period() / L::COUNT;
    for phase in 0..period {
        let cage = Cages::<L>::spread(model, q, v, phase);
        let [mut to_x, mut to_y, mut to_spin] = [L::zero(); 3];
        let mut group = phase;
        while group < count {
            let axes = (L::new(sin[group]), L::new(cos[group]));
            let xc_t = along_t(axes, &cage.x);
            let gone = cage.theta + L::new(pocket_angle[group]) - L::new(theta[group]);
            let s = pitch.times_plus(gone, xc_t);
            let play = L::new(pocket_gap[group]);
            let (mut normal, mut friction) = (L::zero(), L::zero());
            if pocket.wall.is_some() || (s.abs() - play).any_positive() {
                let (sin, cos) = axes;
                let (dr, dtheta, dphi) = (L::new(v_r[group]), L::new(v_theta[group]), L::new(v_phi[group]));
                let (xc_r, _) = polar(axes, &cage.x);
                let (vc_r, vc_t) = polar(axes, &cage.v);
                let ds = dtheta.minus_times(xc_r, pitch.times_plus(cage.dtheta - dtheta, vc_t));
                // Both sides at once: what closes on the side of s, with its sign.
                let closing = ds * one.with_sign(s);
                let (size, elastic) = pocket.wall_force(s.abs(), (play, L::new(per_gap[group])), closing);
                normal = size.with_sign(s);
                // sigma = -sign(F_c), 0 where the pocket is open.
                let sigma = size.if_above(L::zero(), one.with_sign(-normal), L::zero());
                let u = dr - sigma * radius * (dphi - cage.dtheta) - vc_r;
                friction = -pocket.friction(size, u, per_slip);
                sums.pocket = (size - elastic).times_plus(closing, sums.pocket);
                sums.friction -= friction * u;
                sums.lever = (dtheta * normal).minus_times(xc_r, sums.lever);
                to_x += normal * sin - friction * cos;
                to_y -= normal * cos + friction * sin;
                to_spin += sigma * radius * friction - normal * pitch;
            }
            pocket_force[group] = normal.array();
            pocket_friction[group] = friction.array();
            group += period;
        }
        cage_sums(model, phase, [to_x, to_y, to_spin], a);
    }
    sums
}

/// Adds what the groups at the place of `phase` do to the cages, into `a`.
#[inline(always)]
pub(super) fn cage_sums<L: Lanes>(model: &Model, phase: usize, sums: [L; 3], a: &mut [f64]) {
    for (row, lanes) in model.row_lanes.iter().enumerate() {
        let lanes = L::new(L::groups(lanes)[phase]);
        let at = model.layout.cage(row);
        for (k, sum) in sums.into_iter().enumerate() {
            a[at + k] += (sum * lanes).sum();
        }
    }
}
