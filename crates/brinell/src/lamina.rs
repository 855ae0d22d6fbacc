//! Static load of every contact slice by slice: line load, Hertz's pressure, stiffness of the bearing, and the life
//! that follows.
//!
//! For `law = "sliced"`, planar or tilting. Roller and raceway touch as laminae that do not know of each other: the
//! pressure of a slice is that of an even line contact with its line load. It has no stress concentration, neither at
//! the roller's end nor beside damage. Planar and tilting frames are those of [`crate::model`]; SI.

mod along;
mod life;
mod positions;

use crate::defect::{Angles, SIDES, Side, cover_slices, relative_radius, wrap};
use crate::error::Error;
use crate::model::Model;
use crate::pressure::line_pressure;
use crate::scenario::{Bearing, Element, Law, Scenario};
use crate::slices::{Approach, Cover, Slices};
use crate::statics::{Balance, NoBalance, Problem, solve};
use along::over_damage;
pub use along::{AtRest, LoadAlong};
use life::life_error;
pub use life::{lamina_ratings, reference_life, stress_riser};
use positions::Positions;

/// Slices that the life needs: ISO/TS 16281 divides a roller in at least so many.
pub const FEWEST_SLICES: usize = 30;
/// Most slices: beyond, pressures and lives no longer change and time does.
const MOST_SLICES: usize = 200;

/// What one contact carries.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactLine {
    /// From 0.
    pub row: usize,
    /// Orbit angle, rad in [-pi, pi).
    pub angle: f64,
    /// Raceway.
    pub side: Side,
    /// Q, N.
    pub force: f64,
    /// T = sum of z_k q_k, N m.
    pub moment: f64,
    /// Line load q(z) of each slice, N/m.
    pub line_load: Vec<f64>,
    /// Largest pressure in each slice, Pa: of what damage leaves of it, where it leaves anything.
    pub pressure: Vec<f64>,
    /// Length that touches, m.
    pub touching: f64,
}

/// Where a contact is pressed hardest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Pa.
    pub pressure: f64,
    /// Raceway.
    pub side: Side,
    /// From 0.
    pub row: usize,
    /// Orbit angle, rad.
    pub angle: f64,
    /// Middle of the slice, m.
    pub z: f64,
}

/// Static load distribution under the full load at several positions of the cage.
#[derive(Debug, Clone, PartialEq)]
pub struct Distribution {
    /// Middles of the slices, m.
    pub z: Vec<f64>,
    /// Profile's drop there, m.
    pub drop: Vec<f64>,
    /// Inner and outer contact of every roller at every position, position after position.
    pub contacts: Vec<[ContactLine; 2]>,
    /// Groups of positions that each cover all there are, to tell how sure a mean over them is: position k belongs to
    /// group k modulo this number.
    pub groups: usize,
    /// The roller over damage, at places across each defect (of the first 32), in the middle of the load zone where the
    /// damage turns.
    pub over_damage: Vec<[ContactLine; 2]>,
    /// Tilt of the inner ring in the outer one, mean over the positions, rad; 0 in the plane.
    pub tilt: [f64; 2],
    /// Largest tilt of a roller, rad.
    pub roller_tilt: f64,
    /// Mean stiffness between the rings over (x, y, tau_x, tau_y): N/m, N/rad, N m/rad. In the plane the first two
    /// alone, `None` here. Along the axis cylindrical rollers hold nothing, and about it they turn: what would be the
    /// fifth and sixth are 0.
    pub stiffness: Option<[[f64; 4]; 4]>,
}

impl Distribution {
    /// Of a scenario with its slices and its damage.
    ///
    /// # Errors
    /// Where the scenario makes no model, or nothing holds the rings against the load.
    pub fn of(s: &Scenario) -> Result<Self, Error> {
        let model = Model::new(s)?;
        Ok(distribution(&model, &s.bearing)?)
    }

    /// Largest pressure on any slice; none where nothing is loaded.
    pub fn peak(&self) -> Option<Peak> {
        self.peak_among(0..self.z.len())
    }

    /// Largest pressure on the slices at the rollers' ends.
    pub fn end_peak(&self) -> Option<Peak> {
        self.peak_among([0, self.z.len() - 1])
    }

    fn peak_among(&self, slices: impl IntoIterator<Item = usize> + Clone) -> Option<Peak> {
        let lines = self.contacts.iter().chain(&self.over_damage).flatten();
        let all = lines.flat_map(|line| slices.clone().into_iter().map(move |k| (line, k)));
        let (line, k) = all
            .filter(|(line, k)| line.pressure[*k] > 0.0)
            .max_by(|(a, i), (b, j)| a.pressure[*i].total_cmp(&b.pressure[*j]))?;
        Some(Peak { pressure: line.pressure[k], side: line.side, row: line.row, angle: line.angle, z: self.z[k] })
    }

    /// The contacts of the roller whose inner or outer contact carries most.
    pub fn heaviest(&self) -> Option<&[ContactLine; 2]> {
        let most = |pair: &[ContactLine; 2]| pair[0].force.max(pair[1].force);
        let loaded = self.contacts.iter().filter(|pair| most(pair) > 0.0);
        loaded.max_by(|a, b| most(a).total_cmp(&most(b)))
    }
}

/// Load distribution and life, healthy and damaged, with the scenario's slices, but 30 to 200 of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Rating {
    /// Of the bearing without its damage.
    pub healthy: Distribution,
    /// Of the bearing as it is, where it is damaged.
    pub damaged: Option<Distribution>,
    /// L10r of the healthy bearing, revolutions; none without load.
    pub life: Option<f64>,
    /// The same formula over the load distribution of the damaged bearing: what the redistribution of load takes.
    /// Fatigue that starts at the damage, its stress concentration and its impacts are not in it: it is no forecast of
    /// the damaged bearing's life.
    pub damaged_life: Option<f64>,
    /// Its standard error from the positions of turning damage, revolutions.
    pub damaged_life_error: Option<f64>,
}

impl Rating {
    /// The healthy bearing's distribution alone.
    ///
    /// # Errors
    /// As for [`Distribution::of`].
    pub fn healthy(s: &Scenario) -> Result<Option<Distribution>, Error> {
        let Some(mut s) = in_slices(s) else {
            return Ok(None);
        };
        s.defects.clear();
        Distribution::of(&s).map(Some)
    }

    /// Of a scenario; `None` where its rollers have no slices (`law = "ecl"`, the lumped model), and of balls.
    ///
    /// # Errors
    /// As for [`Distribution::of`].
    pub fn of(s: &Scenario) -> Result<Option<Self>, Error> {
        let Some(mut s) = in_slices(s) else {
            return Ok(None);
        };
        let damaged = match s.defects.is_empty() {
            true => None,
            false => Some(Distribution::of(&s)?),
        };
        s.defects.clear();
        let healthy = Distribution::of(&s)?;
        let b = &s.bearing;
        Ok(Some(Self {
            life: reference_life(b, &healthy),
            damaged_life: damaged.as_ref().and_then(|d| reference_life(b, d)),
            damaged_life_error: damaged.as_ref().and_then(|d| life_error(b, d)),
            healthy,
            damaged,
        }))
    }
}

/// The scenario with [`FEWEST_SLICES`] to [`MOST_SLICES`]; `None` where its rollers have no slices (`law = "ecl"`, the
/// lumped model), and of balls.
fn in_slices(s: &Scenario) -> Option<Scenario> {
    let rollers = s.bearing.element == Element::Roller;
    if !rollers || s.contact.law != Law::Sliced || !s.simulation.model.moves_every_part() {
        return None;
    }
    let mut s = s.clone();
    s.contact.slices = s.contact.slices.clamp(FEWEST_SLICES, MOST_SLICES);
    Some(s)
}

/// In the plane a straight roller's are not kept in the model.
fn slices_of(model: &Model, bearing: &Bearing) -> Slices {
    let g = &model.geometry;
    let (length, diameter) = (g.roller_length, 2.0 * g.roller_radius);
    Slices::new(model.rules.slices, length, diameter, &bearing.profile)
}

fn distribution(model: &Model, bearing: &Bearing) -> Result<Distribution, NoBalance> {
    let l = &model.layout;
    let slices = slices_of(model, bearing);
    let Positions { places, groups } = Positions::of(model);
    let positions = places;
    let share = 1.0 / positions.len() as f64;
    let mut problem = Problem::at_start(model);
    let mut all = Distribution {
        z: slices.z[..slices.count].to_vec(),
        drop: slices.drop[..slices.count].to_vec(),
        contacts: Vec::with_capacity(positions.len() * l.rollers()),
        groups,
        over_damage: Vec::new(),
        tilt: [0.0; 2],
        roller_tilt: 0.0,
        stiffness: model.tilt.is_some().then_some([[0.0; 4]; 4]),
    };
    for [cage, ring, spin] in positions {
        let places = problem.orbit.iter_mut().zip(&model.pocket_angle);
        places.for_each(|(orbit, pocket)| *orbit = pocket + cage);
        problem.spin.fill(spin);
        problem.ring_angle = ring;
        let balance = solve(model, &problem)?;
        problem.guess = [balance.inner, balance.outer];
        for slot in 0..l.rollers() {
            let pair = lines(model, bearing, &slices, (&problem, &balance), slot);
            all.contacts.push(pair);
        }
        let Some(tilted) = &balance.tilting else {
            continue;
        };
        for k in 0..2 {
            all.tilt[k] += share * (tilted.rings[0][k] - tilted.rings[1][k]);
        }
        let tilts = tilted.rollers.iter().map(|beta| beta.abs());
        all.roller_tilt = tilts.fold(all.roller_tilt, f64::max);
        for (sum, own) in all.stiffness.iter_mut().flatten().zip(&tilted.stiffness) {
            sum.iter_mut().zip(own).for_each(|(k, own)| *k += share * own);
        }
    }
    all.over_damage = over_damage(model, bearing, &slices)?;
    Ok(all)
}

/// How a roller and a raceway approach in a balance.
fn approach(model: &Model, balance: &Balance, orbit: f64, (slot, side): (usize, Side)) -> Approach {
    let (sin, cos) = orbit.sin_cos();
    let along = |x: [f64; 2]| cos * x[0] + sin * x[1];
    let lever = model.tilt.as_ref().map_or(0.0, |tilt| tilt.levers[slot]);
    let (slopes, beta) = match &balance.tilting {
        Some(tilted) => (tilted.rings.map(along), tilted.rollers[slot]),
        None => ([0.0; 2], 0.0),
    };
    let r = balance.r[slot];
    let (deformation, tilt) = match side {
        Side::Inner => {
            let raceway = along(balance.inner) + lever * slopes[0] - model.geometry.clearance;
            (raceway - r, slopes[0] - beta)
        }
        Side::Outer => {
            let raceway = along(balance.outer) + lever * slopes[1] + model.geometry.outer_gap;
            (r - raceway, beta - slopes[1])
        }
    };
    Approach { deformation, tilt, ..Approach::default() }
}

/// Inner and outer contact of a roller in a balance.
fn lines(
    model: &Model,
    bearing: &Bearing,
    slices: &Slices,
    balanced: (&Problem, &Balance),
    slot: usize,
) -> [ContactLine; 2] {
    SIDES.map(|side| {
        let radius = relative_radius(bearing, side);
        line(model, slices, balanced, (slot, side), radius)
    })
}

/// One contact of a balance; `radius` is R_eq.
fn line(
    model: &Model,
    slices: &Slices,
    (problem, balance): (&Problem, &Balance),
    (slot, side): (usize, Side),
    radius: f64,
) -> ContactLine {
    let orbit = problem.orbit[slot];
    let at = approach(model, balance, orbit, (slot, side));
    let angles = Angles { orbit, spin: problem.spin[slot], ring: problem.ring_angle };
    let mut cover = Cover::new(slices.count);
    cover_slices(model.defects_of(slot, side), &angles, &mut cover);
    let law = model.contact(side);
    let width = model.geometry.roller_length / slices.count as f64;
    let mut contact = ContactLine {
        row: model.layout.row(slot),
        angle: wrap(orbit),
        side,
        force: 0.0,
        moment: 0.0,
        line_load: Vec::with_capacity(slices.count),
        pressure: Vec::with_capacity(slices.count),
        touching: 0.0,
    };
    for k in 0..slices.count {
        let delta = at.deformation + at.tilt * slices.z[k] - slices.drop[k];
        // Of the whole slice, as if all of it were left, and as if all of it were damaged.
        let [left, sunk] = [delta, delta - cover.depth[k]].map(|delta| law.healthy(delta) / slices.count as f64);
        let covered = cover.fraction[k];
        let force = (1.0 - covered) * left + covered * sunk;
        let touching = [(1.0 - covered, left), (covered, sunk)];
        contact.force += force;
        contact.moment += slices.z[k] * force;
        contact.line_load.push(force / width);
        let hardest = touching.iter().filter(|part| part.0 > 0.0);
        let hardest = hardest.fold(0.0, |most: f64, part| most.max(part.1));
        contact.pressure.push(line_pressure(hardest, width, radius));
        let touches = touching.iter().filter(|part| part.1 > 0.0);
        contact.touching += width * touches.map(|part| part.0).sum::<f64>();
    }
    contact
}
