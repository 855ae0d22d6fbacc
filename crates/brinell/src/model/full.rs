//! The equations of motion of every part, section 8 of the model: Eqs. (28), (35), (41), (51).
//!
//! Rollers go eight at a time: one pass for the normal contacts of healthy raceways, one over the damage, which replaces the elastic
//! force of the few contacts that stand on it, and one for friction, pockets and what the bodies feel. Levers are those of
//! the centred bearing, as in the paper; the energy that this leaves over is booked as [`Power::lever`]. Padded slots carry
//! no force and never move.

use super::{Kernel, Model, Power, Workspace};
use crate::defect::{Angles, SIDES, acting_given, edge_gradient};
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

/// x and y of the two rings and their rates, in every lane.
#[derive(Clone, Copy)]
struct Rings<L> {
    xi: [L; 2],
    vi: [L; 2],
    xo: [L; 2],
    vo: [L; 2],
}

#[inline(always)]
fn pair<L: Lanes>(from: &[f64]) -> [L; 2] {
    [L::splat(from[0]), L::splat(from[1])]
}

/// u along e_r.
#[inline(always)]
fn along_r<L: Lanes>(cos: L, sin: L, u: &[L; 2]) -> L {
    cos.times_plus(u[0], sin * u[1])
}

/// u along e_t.
#[inline(always)]
fn along_t<L: Lanes>(cos: L, sin: L, u: &[L; 2]) -> L {
    cos.times_plus(u[1], -(sin * u[0]))
}

#[inline(always)]
fn equations<L: Lanes>(model: &Model, t: f64, y: &[f64], dy: &mut [f64], ws: &mut Workspace) {
    let l = &model.layout;
    let dof = l.dof();
    let (q, v) = y.split_at(dof);
    let (dq, a) = dy.split_at_mut(dof);
    dq.copy_from_slice(v);
    let (w, ring_angle) = model.rotation.at(t);
    let rings = Rings {
        xi: pair(&q[l.inner()..]),
        vi: pair(&v[l.inner()..]),
        xo: pair(&q[l.outer()..]),
        vo: pair(&v[l.outer()..]),
    };
    normal_contacts::<L>(model, q, v, &rings, ws);
    damaged_contacts(model, q, ring_angle, ws);
    let mut sums = rollers::<L>(model, q, v, a, w, &rings, ws);
    if model.rules.is_conservative() && !model.defects.is_empty() {
        edge_reaction(model, q, a, (w, ring_angle), ws, &mut sums.power);
    }
    cages(model, q, v, a, w, &mut sums);
    self::rings(model, t, q, v, a, &mut sums);
    ws.power = sums.power;
}

/// Normal contacts of healthy raceways, section 2.
#[inline(always)]
fn normal_contacts<L: Lanes>(
    model: &Model,
    q: &[f64],
    v: &[f64],
    rings: &Rings<L>,
    ws: &mut Workspace,
) {
    let l = &model.layout;
    let g = &model.geometry;
    for at in (0..l.slots).step_by(WIDTH) {
        let (sin, cos) = lanes::sin_cos(L::load(&q[l.theta() + at..]));
        sin.store(&mut ws.sin[at..]);
        cos.store(&mut ws.cos[at..]);
        let r = L::load(&q[l.r() + at..]);
        let dr = L::load(&v[l.r() + at..]);
        let dtheta = L::load(&v[l.theta() + at..]);
        let radial = |u| along_r(cos, sin, u);
        let tangential = |u| along_t(cos, sin, u);
        let delta = [
            radial(&rings.xi) - r - L::splat(g.clearance),
            r - radial(&rings.xo) - L::splat(g.outer_gap),
        ];
        let rate = [
            dtheta.times_plus(tangential(&rings.xi), radial(&rings.vi)) - dr,
            dr - dtheta.times_plus(tangential(&rings.xo), radial(&rings.vo)),
        ];
        for side in SIDES {
            let k = side as usize;
            let contacts = &mut ws.contacts[k];
            let power = match model.contact(side).exponent {
                Exponent::TenNinths => lanes::ten_ninths(delta[k]),
                Exponent::One => delta[k].positive_part(),
                exponent @ Exponent::Other(_) => L::new(delta[k].array().map(|x| exponent.of(x))),
            };
            delta[k].store(&mut contacts.approach[at..]);
            rate[k].store(&mut contacts.approach_rate[at..]);
            power.store(&mut contacts.power[at..]);
            (L::splat(model.contact(side).stiffness) * power).store(&mut contacts.elastic[at..]);
        }
    }
}

/// Elastic forces of the contacts that stand on damage, section 3.
#[inline(always)]
fn damaged_contacts(model: &Model, q: &[f64], ring_angle: f64, ws: &mut Workspace) {
    let l = &model.layout;
    for side in SIDES {
        let contacts = &mut ws.contacts[side as usize];
        let law = model.contact(side);
        for &slot in &model.exposed[side as usize] {
            let angles = Angles {
                orbit: q[l.theta() + slot],
                spin: q[l.phi() + slot],
                ring: ring_angle,
            };
            contacts.on_damage[slot] = false;
            contacts.damaged_length[slot] = 0.0;
            if !model
                .defects_of(slot, side)
                .any(|d| d.may_cover(&angles, side))
            {
                continue;
            }
            let delta = contacts.approach[slot];
            let found = acting_given(
                model.defects_of(slot, side),
                law,
                &angles,
                side,
                delta,
                contacts.power[slot],
            );
            if let Some(acting) = found {
                contacts.on_damage[slot] = true;
                contacts.elastic[slot] = acting.elastic;
                contacts.damaged_length[slot] = acting.floor.damaged_length;
            }
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

/// What the rollers do to everything else.
struct Sums {
    on_inner: [f64; 2],
    on_outer: [f64; 2],
    power: Power,
}

/// Cage quantities of each lane: rows are interleaved, so that their pattern over the slots repeats.
struct Cages<'a> {
    pattern: &'a mut [[[f64; WIDTH]; CAGE]],
}

/// x, y, theta and their rates, then the sums of the reactions: x, y, moment.
pub(super) const CAGE: usize = 9;

impl Cages<'_> {
    #[inline(always)]
    fn spread(&mut self, model: &Model, q: &[f64], v: &[f64]) {
        let l = &model.layout;
        for (group, cage) in self.pattern.iter_mut().enumerate() {
            for lane in 0..WIDTH {
                let at = l.cage(l.row(group * WIDTH + lane));
                for k in 0..3 {
                    cage[k][lane] = q[at + k];
                    cage[3 + k][lane] = v[at + k];
                }
            }
            cage[6..].fill([0.0; WIDTH]);
        }
    }

    #[inline(always)]
    fn gather(&self, model: &Model, a: &mut [f64]) {
        let l = &model.layout;
        a[l.cage(0)..l.cage(l.rows)].fill(0.0);
        for (group, cage) in self.pattern.iter().enumerate() {
            for lane in 0..WIDTH {
                let at = l.cage(l.row(group * WIDTH + lane));
                for k in 0..3 {
                    a[at + k] += cage[6 + k][lane];
                }
            }
        }
    }
}

/// Friction (section 4), pockets (section 5), drag (section 7) and the rollers' own motion (Eq. 51).
#[inline(always)]
fn rollers<L: Lanes>(
    model: &Model,
    q: &[f64],
    v: &[f64],
    a: &mut [f64],
    w: f64,
    rings: &Rings<L>,
    ws: &mut Workspace,
) -> Sums {
    let l = &model.layout;
    let g = &model.geometry;
    let m = &model.inertia;
    let mut pattern = std::mem::take(&mut ws.cage_lanes);
    let mut cages = Cages {
        pattern: &mut pattern,
    };
    cages.spread(model, q, v);
    let pitch = L::splat(g.pitch_radius);
    let radius = L::splat(g.roller_radius);
    let surface = L::splat(w * g.inner_radius);
    let gravity = pair(&model.gravity);
    let damping = [model.inner_contact.damping, model.outer_contact.damping].map(L::splat);
    let mu = L::splat(model.friction.coefficient);
    let per_slip = L::splat(1.0 / model.friction.slip_velocity);
    let mut on_inner = [L::zero(); 2];
    let mut on_outer = [L::zero(); 2];
    let [mut p_contact, mut p_friction, mut p_drive, mut p_pocket] = [L::zero(); 4];
    let [mut p_rub, mut p_drag, mut p_lever] = [L::zero(); 3];
    for at in (0..l.slots).step_by(WIDTH) {
        let live = L::load(&model.live[at..]);
        let (cos, sin) = (L::load(&ws.cos[at..]), L::load(&ws.sin[at..]));
        let radial = |u: &[L; 2]| along_r(cos, sin, u);
        let tangential = |u: &[L; 2]| along_t(cos, sin, u);
        let (r, theta) = (L::load(&q[l.r() + at..]), L::load(&q[l.theta() + at..]));
        let dr = L::load(&v[l.r() + at..]);
        let (dtheta, dphi) = (L::load(&v[l.theta() + at..]), L::load(&v[l.phi() + at..]));
        let orbit_speed = pitch * dtheta;
        let roll = radius * dphi;

        // Normal forces and raceway friction.
        let slip = [
            surface + tangential(&rings.vi) - (orbit_speed - roll),
            tangential(&rings.vo) - (orbit_speed + roll),
        ];
        let mut normal = [L::zero(); 2];
        let mut friction = [L::zero(); 2];
        for side in SIDES {
            let k = side as usize;
            let contacts = &mut ws.contacts[k];
            let elastic = L::load(&contacts.elastic[at..]) * live;
            let rate = L::load(&contacts.approach_rate[at..]);
            let pressed = rate.times_plus(damping[k], elastic).positive_part();
            normal[k] = elastic.if_above(L::zero(), pressed, L::zero());
            // Outside the load zone whole groups of inner contacts are open. A contact that parts faster than its damper lets it push
            // carries no force, but still loses its elastic energy.
            if elastic.any_positive() {
                friction[k] = mu * normal[k] * lanes::tanh(slip[k] * per_slip);
                p_contact += (normal[k] - elastic) * rate;
                p_friction += friction[k] * slip[k];
            }
            elastic.store(&mut contacts.elastic[at..]);
            normal[k].store(&mut contacts.force[at..]);
            friction[k].store(&mut contacts.friction[at..]);
            slip[k].store(&mut contacts.slip[at..]);
        }
        let [q_in, q_out] = normal;
        let [f_in, f_out] = friction;
        p_drive += f_in * surface;

        // Pocket.
        let group = (at / WIDTH) % cages.pattern.len();
        let cage = cages.pattern[group];
        let [
            xc,
            yc,
            theta_c,
            vxc,
            vyc,
            dtheta_c,
            mut to_x,
            mut to_y,
            mut to_spin,
        ] = cage.map(L::new);
        let (xc, vc) = ([xc, yc], [vxc, vyc]);
        let alpha = L::load(&model.pocket_angle[at..]);
        let s = pitch.times_plus(theta_c + alpha - theta, tangential(&xc));
        let ds = pitch.times_plus(dtheta_c - dtheta, tangential(&vc)) - dtheta * radial(&xc);
        let depth = (s.abs() - L::splat(model.pocket.clearance)).positive_part() * live;
        let (mut push, mut rub, mut rub_moment) = (L::zero(), L::zero(), L::zero());
        if depth.any_positive() {
            // Both sides at once: what closes on the side of s, with its sign.
            let closing = ds * L::splat(1.0).with_sign(s);
            let elastic = L::splat(model.pocket.stiffness) * depth;
            let size = closing
                .times_plus(L::splat(model.pocket.damping), elastic)
                .positive_part();
            let size = depth.if_above(L::zero(), size, L::zero());
            push = size.with_sign(s);
            // sigma = -sign(F_c), 0 where the pocket is open.
            let sigma = size.if_above(L::zero(), L::splat(1.0).with_sign(-push), L::zero());
            let u = dr - sigma * radius * (dphi - dtheta_c) - radial(&vc);
            rub = -(traction(u.abs()) * size).with_sign_of(u);
            rub_moment = sigma * radius * rub;
            p_pocket += (size - elastic) * closing;
            p_rub -= rub * u;
        }
        push.store(&mut ws.pocket_force[at..]);
        rub.store(&mut ws.pocket_friction[at..]);

        // Roller.
        let drag = L::splat(model.drag) * orbit_speed * orbit_speed.abs();
        let arm = pitch + r;
        let per_mass = L::splat(1.0 / m.roller);
        let a_r =
            (dtheta * dtheta).times_plus(arm, radial(&gravity)) + (q_in - q_out + rub) * per_mass;
        let a_theta = ((f_in + f_out + push - drag).times_plus(per_mass, tangential(&gravity))
            - L::splat(2.0) * dr * dtheta)
            / arm;
        let a_phi = (radius * (f_out - f_in) - rub_moment) * L::splat(1.0 / m.roller_spin);
        (a_r * live).store(&mut a[l.r() + at..]);
        (a_theta * live).store(&mut a[l.theta() + at..]);
        (a_phi * live).store(&mut a[l.phi() + at..]);

        // Reactions.
        on_inner[0] += f_in * sin - q_in * cos;
        on_inner[1] -= q_in * sin + f_in * cos;
        on_outer[0] += q_out * cos + f_out * sin;
        on_outer[1] += q_out * sin - f_out * cos;
        to_x += push * sin - rub * cos;
        to_y -= push * cos + rub * sin;
        to_spin += rub_moment - push * pitch;
        for (sum, lanes) in cages.pattern[group][6..]
            .iter_mut()
            .zip([to_x, to_y, to_spin])
        {
            *sum = lanes.array();
        }

        p_drag += drag * arm * dtheta;
        p_lever += dtheta
            * (q_in * tangential(&rings.xi) - q_out * tangential(&rings.xo) - push * radial(&xc)
                + r * (f_in + f_out + push));
    }
    cages.gather(model, a);
    ws.cage_lanes = pattern;
    Sums {
        on_inner: on_inner.map(Lanes::sum),
        on_outer: on_outer.map(Lanes::sum),
        power: Power {
            contact: p_contact.sum(),
            friction: p_friction.sum(),
            drive: p_drive.sum(),
            pocket: p_pocket.sum(),
            pocket_friction: p_rub.sum(),
            drag: p_drag.sum(),
            lever: p_lever.sum(),
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
