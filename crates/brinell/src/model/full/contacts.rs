//! Contacts of rollers with raceways: how each moves, what may be on damage, elementary functions, damage, and what
//! those that are closed carry.

use super::view::{Plane, column, columns, pair, polar};
use crate::contact::film::SqueezeFilm;
use crate::contact::{ContactLaw, Damping, damped};
use crate::defect::{Angles, SIDES, Side, ecl};
use crate::lanes::Lanes;
use crate::model::contact_law::by_law;
use crate::model::leaning::{Leaned, positive};
use crate::model::workspace::Contacts;
use crate::model::{Model, Resting, Workspace};
use crate::scenario::Law;
use crate::slices::{Pressed, Slices};

/// Finds what may be on damage.
#[inline(always)]
pub(super) fn candidates<L: Lanes>(model: &Model, ws: &mut Workspace) {
    let count = model.layout.slots / L::COUNT;
    let Workspace { sin, cos, contacts, directions, candidates, seen, .. } = ws;
    let sin = column::<L>(sin, 0, count);
    let cos = column::<L>(cos, 0, count);
    for (k, broad_phase) in model.broad_phase.iter().enumerate() {
        if broad_phase.slots.is_empty() {
            continue;
        }
        let candidates = &mut candidates[k][..count];
        if !model.exact {
            broad_phase.lanes::<L>((sin, cos), &directions[k], candidates);
            continue;
        }
        // Damage is met at the angle seen from the ring's own centre.
        let [n_r, n_t] = contacts[k].normal.each_ref().map(|n| column::<L>(n, 0, count));
        let [seen_sin, seen_cos] = seen.each_mut().map(|column| &mut L::groups_mut(column)[..count]);
        for group in 0..count {
            let (sin, cos) = (L::new(sin[group]), L::new(cos[group]));
            let (n_r, n_t) = (L::new(n_r[group]), L::new(n_t[group]));
            seen_sin[group] = sin.times_plus(n_r, cos * n_t).array();
            seen_cos[group] = cos.times_plus(n_r, -(sin * n_t)).array();
        }
        broad_phase.lanes::<L>((seen_sin, seen_cos), &directions[k], candidates);
    }
}

/// How each contact moves: deformation, its rate and slip.
#[inline(always)]
pub(super) fn motion<L: Lanes, const TILT: bool>(model: &Model, (q, v): (&[f64], &[f64]), w: f64, ws: &mut Workspace) {
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
    let Workspace { sin, cos, contacts: [inner, outer], .. } = ws;
    let sin = column::<L>(sin, 0, count);
    let cos = column::<L>(cos, 0, count);
    let tilting = if TILT { Some(Tilting::<L>::new(model, (q, v), count)) } else { None };
    let [delta_in, rate_in, slip_in, tilt_in, turn_in] = motion_of::<L>(inner, count);
    let [delta_out, rate_out, slip_out, tilt_out, turn_out] = motion_of::<L>(outer, count);
    for group in 0..count {
        let r = L::new(q_r[group]);
        let dr = L::new(v_r[group]);
        let (dtheta, dphi) = (L::new(v_theta[group]), L::new(v_phi[group]));
        let axes = (L::new(sin[group]), L::new(cos[group]));
        let (mut xi_r, mut xi_t) = polar(axes, &xi);
        let (mut vi_r, mut vi_t) = polar(axes, &vi);
        let (mut xo_r, mut xo_t) = polar(axes, &xo);
        let (mut vo_r, mut vo_t) = polar(axes, &vo);
        if let Some(tilting) = &tilting {
            // Rings' centres and velocities at the row's middle, and how both change along the roller.
            let lever = L::new(tilting.levers[group]);
            let (beta, dbeta) = (L::new(tilting.beta[group]), L::new(tilting.dbeta[group]));
            let (tau_r, tau_t) = polar(axes, &tilting.inner);
            let (dtau_r, dtau_t) = polar(axes, &tilting.inner_rate);
            (xi_r, xi_t) = (lever.times_plus(tau_r, xi_r), lever.times_plus(tau_t, xi_t));
            (vi_r, vi_t) = (lever.times_plus(dtau_r, vi_r), lever.times_plus(dtau_t, vi_t));
            tilt_in[group] = (tau_r - beta).array();
            turn_in[group] = (dtheta.times_plus(tau_t, dtau_r) - dbeta).array();
            let (tau_r, tau_t) = polar(axes, &tilting.outer);
            let (dtau_r, dtau_t) = polar(axes, &tilting.outer_rate);
            (xo_r, xo_t) = (lever.times_plus(tau_r, xo_r), lever.times_plus(tau_t, xo_t));
            (vo_r, vo_t) = (lever.times_plus(dtau_r, vo_r), lever.times_plus(dtau_t, vo_t));
            tilt_out[group] = (beta - tau_r).array();
            turn_out[group] = dtheta.minus_times(tau_t, dbeta - dtau_r).array();
        }
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

/// Elastic deformation, its rate and slip, and, where rollers tilt, how the former two change along the roller, to
/// write to.
#[inline(always)]
fn motion_of<L: Lanes>(contacts: &mut Contacts, count: usize) -> [&mut [L::Group]; 5] {
    [
        &mut L::groups_mut(&mut contacts.deformation)[..count],
        &mut L::groups_mut(&mut contacts.approach_rate)[..count],
        &mut L::groups_mut(&mut contacts.slip)[..count],
        L::groups_mut(&mut contacts.tilt),
        L::groups_mut(&mut contacts.tilt_rate),
    ]
}

/// Tilts of rollers and rings.
struct Tilting<'a, L: Lanes> {
    levers: &'a [L::Group],
    beta: &'a [L::Group],
    dbeta: &'a [L::Group],
    inner: Plane<L>,
    inner_rate: Plane<L>,
    outer: Plane<L>,
    outer_rate: Plane<L>,
}

impl<'a, L: Lanes> Tilting<'a, L> {
    #[inline(always)]
    fn new(model: &'a Model, (q, v): (&'a [f64], &'a [f64]), count: usize) -> Self {
        let l = &model.layout;
        let levers = model.tilt.as_ref().map_or(&[][..], |tilt| &tilt.levers);
        Self {
            levers: column::<L>(levers, 0, count),
            beta: column::<L>(q, 3, count),
            dbeta: column::<L>(v, 3, count),
            inner: pair(&q[l.inner_tilt()..]),
            inner_rate: pair(&v[l.inner_tilt()..]),
            outer: pair(&q[l.outer_tilt()..]),
            outer_rate: pair(&v[l.outer_tilt()..]),
        }
    }
}

/// What each contact asks of elementary functions: the elastic force of a healthy raceway (section 2), and tanh of the
/// slip in place of the friction.
#[inline(always)]
pub(super) fn functions<L: Lanes>(model: &Model, ws: &mut Workspace) {
    let count = model.layout.slots / L::COUNT;
    let per_slip = L::splat(1.0 / model.friction.slip_velocity);
    let by_custom_law = model.custom.contact.is_some();
    for side in SIDES {
        let law = *model.contact(side);
        let stiffness = L::splat(law.stiffness);
        let timed = matches!(law.damping, Damping::Time { .. });
        let contacts = &mut ws.contacts[side as usize];
        let pressed = if contacts.pressed.is_empty() { &contacts.deformation } else { &contacts.pressed };
        let deformation = column::<L>(pressed, 0, count);
        let damper = &mut L::groups_mut(&mut contacts.damper)[..count];
        let slip = column::<L>(&contacts.slip, 0, count);
        let candidates = &ws.candidates[side as usize][..count];
        let power = &mut L::groups_mut(&mut contacts.power)[..count];
        let elastic = &mut L::groups_mut(&mut contacts.elastic)[..count];
        let tanh = &mut L::groups_mut(&mut contacts.friction)[..count];
        let maybe_closed = &mut ws.maybe_closed[side as usize][..count];
        for group in 0..count {
            let delta = L::new(deformation[group]);
            // Outside the load zone whole groups of inner contacts are open; a raised edge may still meet one.
            maybe_closed[group] = by_custom_law || candidates[group] != 0 || delta.any_positive();
            let mut x = L::zero();
            if maybe_closed[group] {
                x = law.exponent.of(delta);
            }
            power[group] = x.array();
            elastic[group] = (stiffness * x).array();
        }
        if timed {
            for group in 0..count {
                if maybe_closed[group] {
                    damper[group] = law.damper(L::new(elastic[group]), L::new(deformation[group])).array();
                }
            }
        }
        for group in 0..count {
            if maybe_closed[group] {
                tanh[group] = (L::new(slip[group]) * per_slip).tanh().array();
            }
        }
    }
}

/// Forces of healthy contacts slice by slice, and tanh of the slip in place of the friction: sections 15 and 16. Where
/// nothing tilts the elastic forces alone, since the damper is the whole contact's there.
#[inline(always)]
pub(super) fn slices<L: Lanes, const TILT: bool>(model: &Model, slices: &Slices, ws: &mut Workspace) {
    let l = &model.layout;
    let per_slip = L::splat(1.0 / model.friction.slip_velocity);
    let length = model.geometry.roller_length;
    for side in SIDES {
        let k = side as usize;
        let law = model.contact(side);
        let contacts = &mut ws.contacts[k];
        for group in 0..l.slots / L::COUNT {
            let mut closed = ws.candidates[k][group] != 0;
            for lane in 0..L::COUNT {
                let slot = group * L::COUNT + lane;
                let at = contacts.approach(slot);
                let pressed = if slices.are_clear(at.deformation, at.tilt) {
                    Pressed::default()
                } else if !TILT {
                    slices.press_evenly::<L>(law, at.deformation)
                } else {
                    slices.press::<L>(law, &at)
                };
                contacts.elastic[slot] = pressed.elastic;
                contacts.damper[slot] = law.damping.of(pressed.tangent, at.deformation);
                contacts.damaged_length[slot] = length * (1.0 - pressed.touching);
                if TILT {
                    contacts.force[slot] = pressed.force;
                    contacts.moment[slot] = pressed.moment;
                    contacts.loss[slot] = pressed.loss;
                }
                closed |= pressed.elastic > 0.0;
            }
            ws.maybe_closed[k][group] = closed;
            if closed {
                let slip = L::new(column::<L>(&contacts.slip, group, 1)[0]);
                L::groups_mut(&mut contacts.friction)[group] = (slip * per_slip).tanh().array();
            }
        }
    }
}

/// Elastic forces of the contacts that are on damage, section 3, in place of those of healthy raceways; where rollers tilt the damped ones.
#[inline(always)]
pub(super) fn damage<L: Lanes, const TILT: bool>(model: &Model, q: &[f64], ring_angle: f64, ws: &mut Workspace) {
    if let Some(law) = &model.custom.contact {
        return custom(model, &**law, (q, ring_angle), ws);
    }
    for side in SIDES {
        let k = side as usize;
        if model.broad_phase[k].slots.is_empty() {
            continue;
        }
        let contacts = &mut ws.contacts[k];
        if model.law == Law::Ecl {
            contacts.damaged_length.fill(0.0);
        }
        let count = model.layout.slots / L::COUNT;
        let groups = ws.candidates[k][..count].iter().zip(&mut ws.written[k][..count]);
        for (group, (candidates, written)) in groups.enumerate() {
            // Waves push everywhere.
            if *written != 0 || model.waviness.is_some() {
                contacts.heal::<L>(group * L::COUNT);
            }
            *written = *candidates;
            if *candidates != 0 {
                let at = (side, group * L::COUNT, *candidates);
                match model.law {
                    Law::HalfSpace if TILT => leaning(model, at, (q, ring_angle), contacts),
                    Law::HalfSpace => half_space(model, at, (q, ring_angle), contacts),
                    Law::Ecl => on_damage(model, at, (q, ring_angle), contacts),
                }
            }
        }
    }
}

/// Every contact by a law of the user's own, in place of the program's.
#[cold]
fn custom(model: &Model, law: &dyn ContactLaw, (q, ring_angle): (&[f64], f64), ws: &mut Workspace) {
    for side in SIDES {
        let contacts = &mut ws.contacts[side as usize];
        for slot in 0..model.layout.rollers() {
            let delta = contacts.pressed_or_deformed()[slot];
            let angles = met_at(model, (q, ring_angle), contacts, slot);
            let resting = Resting::from(by_law(law, (slot, side), &model.layout, &angles, delta));
            contacts.elastic[slot] = resting.force;
            contacts.damper[slot] = model.contact(side).damping.of(resting.tangent, delta.max(0.0));
            contacts.push[slot] = resting.push;
            contacts.push_element[slot] = resting.push_element;
            // A force that is no number would be taken for an open contact.
            if !resting.force.is_finite() {
                contacts.push[slot] = f64::NAN;
            }
        }
    }
}

/// The slots that have a bit of `candidates`, which counts from `first`.
#[inline]
fn slots(first: usize, mut candidates: u8) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let slot = (candidates != 0).then(|| first + candidates.trailing_zeros() as usize)?;
        candidates &= candidates - 1;
        Some(slot)
    })
}

/// Angles at which a contact meets damage, seen from its ring's centre.
#[inline]
pub(super) fn met_at(model: &Model, (q, ring): (&[f64], f64), contacts: &Contacts, slot: usize) -> Angles {
    let l = &model.layout;
    Angles { orbit: q[l.theta() + slot] + contacts.lean(slot), spin: q[l.phi() + slot], ring }
}

/// Contacts that are on damage by the law `ecl`. `candidates` has a bit for each slot from `first`.
#[inline(never)]
fn on_damage(
    model: &Model,
    (side, first, candidates): (Side, usize, u8),
    (q, ring_angle): (&[f64], f64),
    contacts: &mut Contacts,
) {
    for slot in slots(first, candidates) {
        let angles = met_at(model, (q, ring_angle), contacts, slot);
        let pressed = (contacts.pressed_or_deformed()[slot], contacts.power[slot]);
        let damaged = ecl::damaged_contact(model.defects_of(slot, side), model.contact(side), &angles, pressed);
        if let Some(damaged) = damaged {
            contacts.elastic[slot] = damaged.elastic;
            if let Damping::Time { .. } = model.contact(side).damping {
                let x = contacts.pressed_or_deformed()[slot];
                let tangent = model.contact(side).damaged_tangent(x, &damaged.floor);
                contacts.damper[slot] = model.contact(side).damping.of(tangent, x.max(0.0));
            }
            contacts.on_damage[slot] = true;
            contacts.damaged_length[slot] = damaged.floor.damaged_length;
        }
    }
}

/// Contacts that are on damage by its table, section 19. `candidates` has a bit for each slot from `first`.
#[inline(never)]
fn half_space(
    model: &Model,
    (side, first, candidates): (Side, usize, u8),
    (q, ring_angle): (&[f64], f64),
    contacts: &mut Contacts,
) {
    let healthy = model.healthy(side);
    for slot in slots(first, candidates) {
        let angles = met_at(model, (q, ring_angle), contacts, slot);
        let delta = contacts.pressed_or_deformed()[slot];
        let Some(met) = model.defects_of(slot, side).effective(&angles, delta, None) else {
            continue;
        };
        let resting = Resting::on_table(&healthy, &met);
        contacts.elastic[slot] = resting.force;
        contacts.damper[slot] = healthy.law.damping.of(resting.tangent, delta.max(met.delta));
        contacts.push[slot] = resting.push;
        contacts.push_element[slot] = resting.push_element;
        contacts.on_damage[slot] = true;
    }
}

/// The same of contacts that tilt: forces with their damping, tau sigma times the Hessian of the energy times the rates (section 20).
#[inline(never)]
fn leaning(
    model: &Model,
    (side, first, candidates): (Side, usize, u8),
    (q, ring_angle): (&[f64], f64),
    contacts: &mut Contacts,
) {
    let Some(slices) = &model.slices else { return };
    let half = 0.5 * model.geometry.roller_length;
    for slot in slots(first, candidates) {
        let angles = met_at(model, (q, ring_angle), contacts, slot);
        let at = contacts.approach(slot);
        let Some(leaned) = model.leaned(model.defects_of(slot, side), side, &angles, &at) else {
            continue;
        };
        let Leaned { carried, push, largest } = leaned;
        let healthy = contacts.elastic[slot];
        let share = if healthy > 0.0 { (carried.force / healthy).clamp(0.0, 1.0) } else { 0.0 };
        // Palmgren's force goes with the length to the power 8/9.
        let touching = (2.0 * half - contacts.damaged_length[slot]) * share * share.sqrt().sqrt().sqrt();
        let [h11, h12, h22] = match model.contact(side).damping {
            // Of a line of contact, as of a healthy one, over all of the roller.
            Damping::Constant(c) => [c, 0.0, c * half * half / 3.0],
            of @ Damping::Time { .. } => {
                let damper = of.of(1.0, slices.deepest(largest, at.tilt).max(0.0));
                positive(carried.stiffness, half).map(|h| damper * h)
            }
        };
        let added = [h11 * at.rate + h12 * at.tilt_rate, h12 * at.rate + h22 * at.tilt_rate];
        let open = carried.force + added[0] <= 0.0 || carried.force <= 0.0;
        let [by_force, by_moment] = if open { [-carried.force, -carried.moment] } else { added };
        contacts.elastic[slot] = carried.force;
        contacts.force[slot] = carried.force + by_force;
        contacts.moment[slot] = carried.moment + by_moment;
        contacts.loss[slot] = by_force * at.rate + by_moment * at.tilt_rate;
        contacts.push[slot] = push[0] + push[1];
        contacts.push_element[slot] = push[1];
        contacts.on_damage[slot] = true;
        contacts.damaged_length[slot] = 2.0 * half - touching;
    }
}

/// What the closed contacts of one side dissipate, and their stiffest.
#[derive(Clone, Copy)]
pub(super) struct Closed<L> {
    pub(super) contact: L,
    pub(super) friction: L,
    max_elastic: L,
}

/// Normal forces (section 2) and friction (section 4) of one side.
#[inline(always)]
pub(super) fn closed<L: Lanes, const TILT: bool>(model: &Model, side: Side, ws: &mut Workspace) -> Closed<L> {
    let count = model.layout.slots / L::COUNT;
    let contacts = &mut ws.contacts[side as usize];
    let maybe_closed = &ws.maybe_closed[side as usize][..count];
    let rate = column::<L>(&contacts.approach_rate, 0, count);
    let slip = column::<L>(&contacts.slip, 0, count);
    let elastic = column::<L>(&contacts.elastic, 0, count);
    // tanh of the slip, and then the friction.
    let friction = &mut L::groups_mut(&mut contacts.friction)[..count];
    let dampers = column::<L>(&contacts.damper, 0, count);
    let force = &mut L::groups_mut(&mut contacts.force)[..count];
    // A copy: what is written to does not lie in it, so its numbers stay in registers.
    let law = *model.contact(side);
    let mu = L::splat(model.friction.coefficient);
    let mut sums = Closed { contact: L::zero(), friction: L::zero(), max_elastic: L::zero() };
    for group in 0..count {
        let (mut normal, mut tangential) = (L::zero(), L::zero());
        if maybe_closed[group] {
            let elastic = L::new(elastic[group]);
            let rate = L::new(rate[group]);
            // A contact that parts faster than its damper lets it push carries no force, but still loses its elastic
            // energy.
            if TILT {
                normal = L::new(force[group]);
                sums.contact += L::new(L::groups(&contacts.loss)[group]);
            } else {
                let damper = match law.damping {
                    Damping::Constant(c) => L::splat(c),
                    Damping::Time { .. } => L::new(dampers[group]),
                };
                normal = damped(elastic, damper, rate);
                sums.contact = (normal - elastic).times_plus(rate, sums.contact);
            }
            tangential = mu * normal * L::new(friction[group]);
            sums.friction = tangential.times_plus(L::new(slip[group]), sums.friction);
            sums.max_elastic = sums.max_elastic.at_least(elastic);
        }
        force[group] = normal.array();
        friction[group] = tangential.array();
    }
    L::groups_mut(&mut ws.max_elastic[side as usize])[0] = sums.max_elastic.array();
    if let Some(films) = &model.film {
        let film = &films[side as usize];
        sums.contact += squeezed::<L>(film, law.damping.constant(), &ws.candidates[side as usize], contacts);
    }
    sums
}

/// What the films of open contacts carry, and what they take, W. On damage there is none: the oil has where to go. The
/// gap is the one at the roller's middle.
#[inline(always)]
fn squeezed<L: Lanes>(film: &SqueezeFilm, damping: f64, candidates: &[u8], contacts: &mut Contacts) -> L {
    let mut taken = L::zero();
    for group in 0..contacts.film.len() / L::COUNT {
        let gap = (-L::new(L::groups(&contacts.deformation)[group])).positive_part();
        let closing = L::new(L::groups(&contacts.approach_rate)[group]);
        let open = film.force(damping, gap, closing);
        let elastic = L::new(L::groups(&contacts.elastic)[group]);
        let mut carried = elastic.if_above(L::zero(), L::zero(), open).array();
        if candidates[group] != 0 {
            let on_damage = &contacts.on_damage[group * L::COUNT..];
            for (carried, on_damage) in carried.as_mut().iter_mut().zip(on_damage) {
                if *on_damage {
                    *carried = 0.0;
                }
            }
        }
        taken = L::new(carried).times_plus(closing, taken);
        L::groups_mut(&mut contacts.film)[group] = carried;
    }
    taken
}
