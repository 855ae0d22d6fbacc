//! The static balance as the cage turns through a pitch: load zone, ring shift, stiffness of the bearing.

use super::balance::{Balance, NoBalance, Problem, own_force};
use super::planar::RingAt;
use super::solve;
use crate::defect::{Defect, SIDES, Side, wrap};
use crate::model::Model;
use crate::scenario::{LoadOn, Surface};
use std::f64::consts::{PI, TAU};

/// Load distribution of the static balance: rollers of all rows at several positions of the cage.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StaticLoadZone {
    /// (row from 0, orbit angle in rad in [-pi, pi), Q_in, Q_out in N).
    pub points: Vec<(usize, f64, f64, f64)>,
    /// Largest Q_out, N; where damage turns, with up to two pieces of it, the longest, in and about the load zone.
    pub largest: f64,
    /// Largest Q_in, N, likewise.
    pub largest_inner: f64,
    /// Largest Q_out of the healthy bearing, N.
    pub healthy_largest: f64,
    /// Extent of the zone where rollers of the healthy bearing carry load between the raceways, rad; 0 where none does, a
    /// full turn where every roller does everywhere. A roller whose own weight rests on the inner ring carries none, and
    /// damage takes the load off rollers that are over it: so the zone is that without damage.
    pub extent: f64,
    /// Where it begins and ends, rad, counted from its middle [`Self::middle`].
    pub ends: (f64, f64),
    /// Direction in which the inner ring of the healthy bearing is displaced in the outer one, rad.
    pub middle: f64,
    /// How far, m.
    pub displacement: f64,
    /// Mean ring offset, inner less outer, m.
    pub shift: [f64; 2],
    /// Mean stiffness of the bearing between its rings, N/m.
    pub stiffness: [[f64; 2]; 2],
    /// What the support of the ring that the load is on takes of it, by the ring's mean displacement, N.
    pub support: f64,
    /// How far the bearing as a whole is from the origin, m, towards the load zone: of the two rings' mean displacements
    /// along [`Self::middle`] the smaller; negative away from it, as under a load on the outer ring, where loaded rollers
    /// are nearer to the origin. The model's levers are those of the centred bearing, so the cage, and FTF and BPFO with
    /// it, come out faster by up to this over R_m.
    pub sunk: f64,
}

impl StaticLoadZone {
    /// Where the zone begins and ends, rad, counter-clockwise from +x; not wrapped.
    pub fn arc(&self) -> [f64; 2] {
        [self.middle + self.ends.0, self.middle + self.ends.1]
    }

    /// Whether rollers bear load over damage on the outer raceway: where those of the healthy bearing do, and where the
    /// damage is raised by more than the healthy gap. Other damage turns into the zone.
    pub fn reaches(&self, model: &Model, defect: &Defect) -> bool {
        if defect.surface != Surface::OuterRaceway {
            return true;
        }
        let (first, last) = defect.shape.arc();
        // From the middle of the zone to the middle of the damage.
        let half = 0.5 * (last - first) / defect.radius;
        let away = wrap(defect.center + 0.5 * (first + last) / defect.radius - self.middle);
        let loaded = self.extent > 0.0 && away + half >= self.ends.0 && away - half <= self.ends.1;
        let nearest = (away.abs() - half).max(0.0);
        let gap = model.geometry.clearance + model.geometry.outer_gap - self.displacement * nearest.cos();
        loaded || defect.shape.raised() > gap
    }

    /// Takes the forces of one balance into the largest.
    fn take(&mut self, balance: &Balance) {
        let largest = |forces: &[f64], so_far: f64| forces.iter().copied().fold(so_far, f64::max);
        self.largest = largest(&balance.outer_force, self.largest);
        self.largest_inner = largest(&balance.inner_force, self.largest_inner);
    }

    /// Largest force of a contact on each raceway, N.
    pub fn heaviest(&self) -> [f64; 2] {
        [self.largest_inner, self.largest]
    }

    /// Static deformation of the heaviest contact on the softer raceway, m.
    pub(crate) fn deformation(&self, model: &Model) -> f64 {
        let on = |side| model.deflection(side, self.largest);
        SIDES.into_iter().map(on).fold(0.0, f64::max)
    }
}

/// Positions of the cage over one pitch.
pub(crate) const PHASES: usize = 16;

/// The healthy or damaged bearing's static load distribution under its full load, as the cage turns through a pitch; the
/// load zone is the healthy bearing's.
///
/// # Errors
/// Where the rings are not held against the load.
pub fn static_load_zone(model: &Model) -> Result<StaticLoadZone, NoBalance> {
    let zone = as_it_is(model)?;
    if model.defects.is_empty() {
        return Ok(zone);
    }
    let Ok(StaticLoadZone { healthy_largest, extent, ends, middle, displacement, .. }) =
        as_it_is(&model.without_damage())
    else {
        return Ok(zone);
    };
    let mut zone = StaticLoadZone { healthy_largest, extent, ends, middle, displacement, ..zone };
    heaviest_over_turns(model, &mut zone);
    Ok(zone)
}

/// Pieces of turning damage that are looked at, the longest ones; one where there are many pieces, alike, as each balance
/// asks all of them.
const TURNED: usize = 2;
const MANY: usize = 32;

/// The heaviest contacts with damage of the inner raceway and of rollers turned through the load zone: it takes load off
/// the rollers that are over it, and others carry more.
fn heaviest_over_turns(model: &Model, zone: &mut StaticLoadZone) {
    let pitch = TAU / model.layout.rollers_per_row as f64;
    let half_arc = |defect: &Defect| {
        let (first, last) = defect.shape.arc();
        0.5 * (last - first) / defect.radius
    };
    let mut turning: Vec<_> = model.defects.iter().filter(|d| d.surface != Surface::OuterRaceway).collect();
    turning.sort_by(|a, b| half_arc(b).total_cmp(&half_arc(a)));
    let most = if model.defects.len() > MANY { 1 } else { TURNED };
    for defect in turning.into_iter().take(most) {
        let (first, last) = defect.shape.arc();
        let of_roller = defect.surface != Surface::InnerRaceway;
        // Its middle in steps of half a pitch, until its ends are two pitches beyond the middle of the load zone. The arc
        // of a roller's damage is its own.
        let reach = 2.0 * pitch + if of_roller { 0.0 } else { half_arc(defect) };
        let steps = (reach.min(PI) / (0.5 * pitch)).ceil() as i32;
        for step in -steps..=steps {
            let at = zone.middle + 0.5 * pitch * f64::from(step);
            let (mut problem, slot) = Problem::at_rest(model, Some((defect, 0.5 * (first + last))), 0, at);
            let cage = problem.orbit[slot] - model.pocket_angle[slot];
            // A roller's damage turns with its roller; between the inner raceway's and the rollers there is a pitch.
            let phases = if of_roller { 1 } else { PHASES / 4 };
            for phase in 0..phases {
                problem.turn_cage(model, cage + pitch * phase as f64 / phases as f64);
                // Where nothing holds the rings there, other positions tell.
                if let Ok(balance) = solve(model, &problem) {
                    problem.guess = [balance.inner, balance.outer];
                    zone.take(&balance);
                }
            }
        }
    }
}

/// The same, with the zone of the bearing as it is.
fn as_it_is(model: &Model) -> Result<StaticLoadZone, NoBalance> {
    let l = &model.layout;
    let mut problem = Problem::at_start(model);
    let pitch = TAU / l.rollers_per_row as f64;
    let mut zone = StaticLoadZone { points: Vec::with_capacity(PHASES * l.rollers()), ..StaticLoadZone::default() };
    let mut places: Vec<Place> = Vec::with_capacity(PHASES * l.rollers());
    // Of the inner and the outer ring.
    let mut displaced = [[0.0; 2]; 2];
    for phase in 0..PHASES {
        let turn = pitch * phase as f64 / PHASES as f64;
        problem.turn_cage(model, turn);
        let balance = solve(model, &problem)?;
        problem.guess = [balance.inner, balance.outer];
        for slot in 0..l.rollers() {
            let force = balance.outer_force[slot];
            zone.points.push((l.row(slot), wrap(problem.orbit[slot]), balance.inner_force[slot], force));
            let squeeze = squeeze(model, &problem, &balance, slot);
            places.push(Place { slot, turn, angle: problem.orbit[slot], squeeze });
        }
        zone.take(&balance);
        for k in 0..2 {
            displaced[0][k] += balance.inner[k] / PHASES as f64;
            displaced[1][k] += balance.outer[k] / PHASES as f64;
            zone.shift[k] += (balance.inner[k] - balance.outer[k]) / PHASES as f64;
            for j in 0..2 {
                zone.stiffness[k][j] += balance.stiffness[k][j] / PHASES as f64;
            }
        }
    }
    zone.healthy_largest = zone.largest;
    zone.middle = zone.shift[1].atan2(zone.shift[0]);
    zone.displacement = zone.shift[0].hypot(zone.shift[1]);
    zone.ends = if places.iter().all(|place| place.squeeze > 0.0) {
        (-PI, PI)
    } else {
        places.iter_mut().for_each(|place| place.angle = wrap(place.angle - zone.middle));
        (-end(model, &mut problem, &places, -1.0)?, end(model, &mut problem, &places, 1.0)?)
    };
    zone.extent = zone.ends.1 - zone.ends.0;
    let loaded = match model.load.on {
        LoadOn::InnerRing => displaced[0],
        LoadOn::OuterRing => displaced[1],
    };
    zone.support = model.loaded_support().stiffness * loaded[0].hypot(loaded[1]);
    let (sin, cos) = zone.middle.sin_cos();
    let [inner, outer] = displaced.map(|by| cos * by[0] + sin * by[1]);
    zone.sunk = if inner.abs() < outer.abs() { inner } else { outer };
    Ok(zone)
}

/// How far the sound raceways overlap at a roller, less its deformation under its own weight and centrifugal force, m:
/// positive where both press it. Along e_r, from where the roller touches the one to where it touches the other: in exact
/// geometry (section 18) a raceway that is displaced across e_r stands off by the square of that over 2 R_m.
fn squeeze(model: &Model, problem: &Problem, balance: &Balance, slot: usize) -> f64 {
    let at = problem.orbit[slot].sin_cos();
    let (lever, tilts) = match (&model.tilt, &balance.tilting) {
        (Some(tilt), Some(tilting)) => (tilt.levers[slot], tilting.rings),
        _ => (0.0, [[0.0; 2]; 2]),
    };
    let in_row = |x: [f64; 2], tau: [f64; 2]| [x[0] + lever * tau[0], x[1] + lever * tau[1]];
    let touching = |x, tau, gap| RingAt::new(model, at, in_row(x, tau), gap).touching();
    let middle = touching(balance.inner, tilts[0], -model.geometry.clearance)
        - touching(balance.outer, tilts[1], model.geometry.outer_gap);
    let slope = at.1 * (tilts[0][0] - tilts[1][0]) + at.0 * (tilts[0][1] - tilts[1][1]);
    let overlap = model.slices.as_ref().map_or(middle, |slices| {
        let of = |k: usize| middle + slope * slices.z[k] - 2.0 * slices.drop[k];
        (0..slices.count).map(of).fold(f64::NEG_INFINITY, f64::max)
    });
    // The lumped model's rollers have no weight.
    let own = if model.kind.moves_every_part() { own_force(model, problem, slot) } else { 0.0 };
    let side = if own < 0.0 { Side::Inner } else { Side::Outer };
    overlap - model.contact(side).deflection(own.abs())
}

/// A roller at one position of the cage.
#[derive(Clone, Copy)]
struct Place {
    slot: usize,
    /// How far the cage has turned, rad.
    turn: f64,
    /// Of the roller, rad.
    angle: f64,
    squeeze: f64,
}

/// How far the load zone reaches from its middle, forwards or backwards by `sign`, rad; `places` count from there.
///
/// The squeeze is interpolated between the last place that is loaded and the next, and once more from the balance at
/// the angle found: a roller that takes up load pushes the rings back, so the squeeze bends there.
fn end(model: &Model, problem: &mut Problem, places: &[Place], sign: f64) -> Result<f64, NoBalance> {
    let outwards = |place: &Place| (sign * place.angle, place.squeeze);
    let farther = |a: &&Place, b: &&Place| outwards(a).0.total_cmp(&outwards(b).0);
    let (mut reach, mut between) = (0.0, None);
    for row in 0..model.layout.rows {
        let of_row = || places.iter().filter(move |place| model.layout.row(place.slot) == row);
        let Some(loaded) = of_row().filter(|place| place.squeeze > 0.0).max_by(farther) else {
            continue;
        };
        let next = of_row().filter(|place| outwards(place).0 > outwards(loaded).0).min_by(farther);
        let at = next.map_or(outwards(loaded).0, |next| zero(outwards(loaded), outwards(next)));
        if at > reach {
            (reach, between) = (at, next.map(|next| (loaded, next)));
        }
    }
    let Some((loaded, next)) = between else {
        return Ok(reach);
    };
    let turn = loaded.turn + sign * reach - loaded.angle;
    problem.turn_cage(model, turn);
    let balance = solve(model, problem)?;
    let found = (reach, squeeze(model, problem, &balance, loaded.slot));
    Ok(if found.1 > 0.0 { zero(found, outwards(next)) } else { zero(outwards(loaded), found) })
}

/// The angle at which the squeeze is 0, between (angle, squeeze) of a roller that is loaded and of one that is not.
fn zero(loaded: (f64, f64), next: (f64, f64)) -> f64 {
    loaded.0 + (next.0 - loaded.0) * loaded.1 / (loaded.1 - next.1)
}
