//! Rings and rollers in the plane: each roller's radial offset is eliminated, for it has one equilibrium at given ring
//! offsets.

use super::balance::{
    Balance, NoBalance, Offsets, Problem, angles, by_slot, external, force_scale, own_force, softest, stalled,
};
use super::newton::{Fixed, minimise};
use super::pressed::Pressed;
use crate::defect::{Angles, SIDES, Side};
use crate::model::{Model, Resting, lumped};
use crate::scenario::ModelKind;

/// What one roller contributes at given ring offsets.
#[derive(Debug, Clone, Copy, Default)]
struct Roller {
    r: f64,
    inner: f64,
    outer: f64,
    /// dQ/d(deformation of the rings) through the roller, N/m.
    tangent: f64,
    /// Potential energy, J.
    energy: f64,
    /// Directions in which the contacts press on the rings, inner and outer: e_r, or n of either contact.
    along: [[f64; 2]; 2],
    /// What damage pushes the inner and the outer ring by, N.
    push: [[f64; 2]; 2],
}

/// Balances at angles held, at most.
const MOST_TURNS: usize = 20;
/// A change of the place on a raceway that no damage notices, m.
const SAME_PLACE: f64 = 1e-10;

/// By how much rollers are seen from the inner and the outer ring's centre farther on than their orbit angle, rad.
type Turned = [f64; 2];

/// As [`super::solve`], for rings that do not tilt.
///
/// The law `ecl` knows no force for the energy that a contact gains or loses along the surface, so with angles seen from displaced centres
/// its forces have no potential. There the angles are held while the balance is found, and those of that balance are held for the next.
pub(super) fn solve(model: &Model, problem: &Problem) -> Result<Balance, NoBalance> {
    let moves_damage = model.exact && !model.defects.is_empty();
    if !moves_damage || model.has_pushing_law() {
        return solve_held(model, problem, None);
    }
    let mut held: Vec<Turned> = vec![[0.0; 2]; model.layout.rollers()];
    let mut found = solve_held(model, problem, Some(&held))?;
    for _ in 1..MOST_TURNS {
        let at = [found.inner, found.outer];
        let seen =
            |slot: usize| rings_at(model, problem.orbit[slot].sin_cos(), at).map(|ring| ring.turned(found.r[slot]));
        let next: Vec<Turned> = (0..held.len()).map(seen).collect();
        let moved = held.iter().flatten().zip(next.iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        if moved * model.geometry.pitch_radius < SAME_PLACE {
            break;
        }
        held = next;
        let iterations = found.iterations;
        found = solve_held(model, &Problem { guess: at, ..problem.clone() }, Some(&held))?;
        found.iterations += iterations;
    }
    // Where the law jumps between two places neither has a balance at its own angles: the last one counts.
    Ok(found)
}

/// The same with the angles at which damage is met `held`, or as the rings move them.
fn solve_held(model: &Model, problem: &Problem, held: Option<&[Turned]>) -> Result<Balance, NoBalance> {
    let free = [!problem.fix_inner, !problem.fix_inner, !problem.fix_outer, !problem.fix_outer];
    let guess: Offsets = std::array::from_fn(|k| problem.guess[k / 2][k % 2]);
    let mut rollers = vec![Roller::default(); model.layout.rollers()];
    let [springs, forces] = held_by(model);
    let scale = force_scale(model, problem, &forces);
    let mut evaluate = |x: &Offsets| {
        let mut state = Fixed::of_springs(&springs, &forces, x);
        press((model, problem, held), x, &mut rollers, &mut state);
        state
    };
    let found = minimise(guess, &free, (scale, stalled(model, problem, scale), softest(model)), &mut evaluate)?;
    evaluate(&found.x);
    let mut stiffness = [[0.0; 2]; 2];
    for roller in &rollers {
        let e = roller.along[0];
        for i in 0..2 {
            for j in 0..2 {
                stiffness[i][j] += roller.tangent * e[i] * e[j];
            }
        }
    }
    let [x_in, y_in, x_out, y_out] = found.x;
    Ok(Balance {
        inner: [x_in, y_in],
        outer: [x_out, y_out],
        r: by_slot(model, &rollers, |r| r.r),
        inner_force: by_slot(model, &rollers, |r| r.inner),
        outer_force: by_slot(model, &rollers, |r| r.outer),
        stiffness,
        tilting: None,
        residual: found.residual,
        iterations: found.iterations,
    })
}

/// Adds what the rollers hold and do at the rings' offsets `x`.
fn press(
    (model, problem, held): (&Model, &Problem, Option<&[Turned]>),
    x: &Offsets,
    rollers: &mut [Roller],
    state: &mut Fixed<4>,
) {
    if (x[0] - x[2]).hypot(x[1] - x[3]) > reach(model) {
        state.potential = f64::INFINITY;
        return;
    }
    for (slot, roller) in rollers.iter_mut().enumerate() {
        *roller = match model.kind {
            ModelKind::Full | ModelKind::Tilting => {
                between_raceways(model, problem, (slot, held.map(|of| of[slot])), x)
            }
            ModelKind::Lumped => in_series(model, problem, slot, x),
        };
        state.potential += roller.energy;
        let [[in_x, in_y], [out_x, out_y]] = roller.along;
        let along = [in_x, in_y, -out_x, -out_y];
        for i in 0..4 {
            state.gradient[i] += along[i] * if i < 2 { roller.inner } else { roller.outer };
            state.gradient[i] -= roller.push[i / 2][i % 2];
            for j in 0..4 {
                state.hessian[i][j] += roller.tangent * along[i] * along[j];
            }
        }
    }
}

/// Springs to the ground and forces of each coordinate, as [`solve`] has them.
pub(super) fn held_by(model: &Model) -> [Offsets; 2] {
    let (ki, ko) = (model.inner_support.stiffness, model.acting_outer_support().stiffness);
    [[ki, ki, ko, ko], external(model)]
}

/// The rollers alone between rings at `x`.
pub(super) fn pressed(model: &Model, problem: &Problem, x: &Offsets) -> Pressed {
    let mut rollers = vec![Roller::default(); model.layout.rollers()];
    let mut state = Fixed::of_springs(&[0.0; 4], &[0.0; 4], x);
    press((model, problem, None), x, &mut rollers, &mut state);
    Pressed { state: state.of_any_size(), r: by_slot(model, &rollers, |r| r.r), beta: Vec::new() }
}

/// How far the rings may be from each other, m. Beyond a roller's radius and the gap exact geometry has rings that do not meet
/// at all, and a soft support a balance there: a first step without a loaded contact leads to it.
fn reach(model: &Model) -> f64 {
    let g = &model.geometry;
    if model.exact { g.roller_radius + g.clearance.abs() + g.outer_gap.abs() } else { f64::INFINITY }
}

fn in_series(model: &Model, problem: &Problem, slot: usize, x: &Offsets) -> Roller {
    let (sin, cos) = problem.orbit[slot].sin_cos();
    let g = &model.geometry;
    let delta = cos * (x[0] - x[2]) + sin * (x[1] - x[3]) - g.clearance - g.outer_gap;
    let (force, tangent, energy) = lumped::elastic_at(model, slot, &angles(problem, slot), delta);
    Roller { r: 0.0, inner: force, outer: force, tangent, energy, along: [[cos, sin]; 2], push: [[0.0; 2]; 2] }
}

/// One roller between the rings at the offsets `x`.
fn between<'a>(model: &'a Model, problem: &Problem, (slot, held): (usize, Option<Turned>), x: &Offsets) -> Between<'a> {
    let angles = angles(problem, slot);
    let rings = [[x[0], x[1]], [x[2], x[3]]];
    let sides = rings_at(model, angles.orbit.sin_cos(), rings);
    Between { model, slot, angles, held, sides, own: own_force(model, problem, slot) }
}

/// The roller's equilibrium: the r at which Q_in - Q_out and its own radial force N balance.
fn between_raceways(model: &Model, problem: &Problem, at: (usize, Option<Turned>), x: &Offsets) -> Roller {
    let between = between(model, problem, at, x);
    let r = between.equilibrium();
    let (seen, contacts) = between.contacts(r);
    let [(q_in, k_in), (q_out, k_out)] = contacts.map(|c| (c.force, c.tangent));
    let along = between.along(&seen);
    Roller {
        along,
        r,
        inner: q_in,
        outer: q_out,
        tangent: if k_in + k_out > 0.0 { k_in * k_out / (k_in + k_out) } else { 0.0 },
        energy: between.energy(r, &seen),
        // (P/rho) t on either ring, turned into the plane.
        push: [0, 1].map(|k: usize| {
            let [n_x, n_y] = along[k];
            let per_rho = contacts[k].push / seen[k].distance;
            [-n_y * per_rho, n_x * per_rho]
        }),
    }
}

/// Damping of the bearing between its rings about a balance, N s/m, along the directions in which [`Balance::stiffness`] is.
///
/// The elements are condensed out as there. Contacts k_i + s c_i and k_o + s c_o in series are, to first order in s, the stiffness
/// k_i k_o/(k_i + k_o) and the damping (k_o^2 c_i + k_i^2 c_o)/(k_i + k_o)^2; an element's inertia comes with s^2.
pub(super) fn damping(model: &Model, problem: &Problem, balance: &Balance) -> [[f64; 2]; 2] {
    let x = [balance.inner[0], balance.inner[1], balance.outer[0], balance.outer[1]];
    let mut all = [[0.0; 2]; 2];
    for slot in 0..model.layout.rollers() {
        let between = between(model, problem, (slot, None), &x);
        let (r, deltas) = (balance.r[slot], between.deformations(balance.r[slot]));
        let (seen, contacts) = between.contacts(r);
        let [(k_in, c_in), (k_out, c_out)] = SIDES.map(|side| {
            let (k, delta) = (contacts[side as usize].tangent, deltas[side as usize]);
            if delta > 0.0 { (k, model.contact(side).damping.of(k, delta)) } else { (0.0, 0.0) }
        });
        if k_in + k_out > 0.0 {
            let damper = (k_out * k_out * c_in + k_in * k_in * c_out) / (k_in + k_out).powi(2);
            let [e, _] = between.along(&seen);
            (0..2).for_each(|i| (0..2).for_each(|j| all[i][j] += damper * e[i] * e[j]));
        }
    }
    all
}

/// Both rings as a roller meets them.
fn rings_at(model: &Model, at: (f64, f64), [inner, outer]: [[f64; 2]; 2]) -> [RingAt; 2] {
    [RingAt::new(model, at, inner, -model.geometry.clearance), RingAt::new(model, at, outer, model.geometry.outer_gap)]
}

/// A ring that is held, as a roller at one orbit angle meets it: e_r . x_g and -e_t . x_g (0 in centred geometry), the gap with the
/// sign with which it moves the raceway outwards, and R_m, m.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RingAt {
    along: f64,
    across: f64,
    gap: f64,
    pitch: f64,
}

impl RingAt {
    pub(crate) fn new(model: &Model, (sin, cos): (f64, f64), x: [f64; 2], gap: f64) -> Self {
        // Rings that tilt have their balance in centred geometry.
        let across = if model.exact && model.tilt.is_none() { sin * x[0] - cos * x[1] } else { 0.0 };
        Self { along: cos * x[0] + sin * x[1], across, gap, pitch: model.geometry.pitch_radius }
    }

    /// rho - R_m, less the gap, m: what a roller at r stands beyond the raceway by (section 18).
    pub(crate) fn beyond(&self, r: f64) -> f64 {
        let a = r - self.along;
        if self.across == 0.0 {
            return a - self.gap;
        }
        let square = self.across * self.across;
        let rho = ((self.pitch + a).powi(2) + square).sqrt();
        (a * (2.0 * self.pitch + a) + square) / (rho + self.pitch) - self.gap
    }

    /// The r at which the roller just touches.
    pub(super) fn touching(&self) -> f64 {
        let square = self.across * self.across;
        let root = ((self.pitch + self.gap).powi(2) - square).max(0.0).sqrt();
        self.along + (self.gap * (2.0 * self.pitch + self.gap) - square) / (root + self.pitch)
    }

    /// A roller at r as it is seen from the ring's centre.
    fn see(&self, r: f64) -> Seen {
        let along = self.pitch + r - self.along;
        let distance = along.hypot(self.across);
        let normal = if self.across == 0.0 { [1.0, 0.0] } else { [along / distance, self.across / distance] };
        Seen { distance, normal }
    }

    /// How much farther on than its orbit angle a roller at r is seen from the ring's centre, rad.
    fn turned(&self, r: f64) -> f64 {
        self.see(r).turned()
    }
}

/// A roller as it is seen from a ring's centre.
#[derive(Debug, Clone, Copy)]
struct Seen {
    /// rho, m.
    distance: f64,
    /// n along e_r and e_t.
    normal: [f64; 2],
}

impl Seen {
    fn turned(&self) -> f64 {
        let [n_r, n_t] = self.normal;
        (n_t / n_r).atan()
    }
}

/// One roller between raceways that are held.
struct Between<'a> {
    model: &'a Model,
    slot: usize,
    angles: Angles,
    held: Option<Turned>,
    /// The inner ring and the outer one.
    sides: [RingAt; 2],
    /// Its own radial force, N.
    own: f64,
}

impl Between<'_> {
    /// The contacts' normals in the plane, inner and outer.
    fn along(&self, seen: &[Seen; 2]) -> [[f64; 2]; 2] {
        let (sin, cos) = self.angles.orbit.sin_cos();
        seen.each_ref().map(|Seen { normal: [n_r, n_t], .. }| [cos * n_r - sin * n_t, sin * n_r + cos * n_t])
    }

    /// The roller's angles as seen from the centre of a ring. Where nothing is damaged they do not matter.
    fn angles(&self, side: Side, seen: &Seen) -> Angles {
        if self.model.defects.is_empty() && self.model.custom.contact.is_none() {
            return self.angles;
        }
        let turned = self.held.map_or_else(|| seen.turned(), |held| held[side as usize]);
        Angles { orbit: self.angles.orbit + turned, ..self.angles }
    }

    /// Deformations of both contacts of the roller at r, m.
    fn deformations(&self, r: f64) -> [f64; 2] {
        [-self.sides[0].beyond(r), self.sides[1].beyond(r)]
    }

    /// The roller at r as both rings see it, and its contacts.
    fn contacts(&self, r: f64) -> ([Seen; 2], [Resting; 2]) {
        let (seen, deltas) = (self.sides.map(|side| side.see(r)), self.deformations(r));
        let contact = |side: Side| {
            let (seen, delta) = (&seen[side as usize], deltas[side as usize]);
            self.model.at_rest((self.slot, side), &self.angles(side, seen), delta)
        };
        (seen, SIDES.map(contact))
    }

    /// Q_in - Q_out + N, which falls with r, and how steeply.
    fn balance(&self, r: f64) -> (f64, f64) {
        let (seen, contacts) = self.contacts(r);
        let [(q_in, k_in, p_in), (q_out, k_out, p_out)] = contacts.map(|c| (c.force, c.tangent, c.push));
        let [Seen { normal: [n_in, t_in], .. }, Seen { normal: [n_out, t_out], .. }] = seen;
        let pushed = p_in * t_in / seen[0].distance + p_out * t_out / seen[1].distance;
        (q_in * n_in - q_out * n_out + pushed + self.own, k_in * n_in * n_in + k_out * n_out * n_out)
    }

    /// Where the balance is positive, and where it is negative, around the raceways.
    fn bracket(&self) -> (f64, f64) {
        let [inner_at, outer_at] = self.sides.map(|side| side.touching());
        let mut low = inner_at.min(outer_at);
        let mut high = inner_at.max(outer_at);
        let mut reach = 1e-7;
        while self.balance(low).0 < 0.0 && reach < 1.0 {
            low -= reach;
            reach *= 2.0;
        }
        reach = 1e-7;
        while self.balance(high).0 > 0.0 && reach < 1.0 {
            high += reach;
            reach *= 2.0;
        }
        (low, high)
    }

    /// The r of the balance, by bisection with Newton steps.
    fn equilibrium(&self) -> f64 {
        let (mut low, mut high) = self.bracket();
        // From the raceway that the roller's own force presses it against.
        let mut r = if self.own < 0.0 { low } else { high };
        // Deformations are differences of r and of where the raceways are: finer than their round-off is nothing.
        let grain = 1e-22 + 2.0 * f64::EPSILON * self.sides.iter().map(|side| side.touching().abs()).sum::<f64>();
        if self.balance(r).0 == 0.0 {
            return r;
        }
        for _ in 0..200 {
            let (f, slope) = self.balance(r);
            if f > 0.0 {
                low = r;
            } else {
                high = r;
            }
            let newton = if slope > 0.0 { r + f / slope } else { f64::NAN };
            // Where it is found, the step leads nowhere, and so not into the bracket either.
            if (newton - r).abs() <= grain {
                break;
            }
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            r = next;
            if high - low <= grain {
                break;
            }
        }
        r
    }

    /// Potential energy at r, J.
    fn energy(&self, r: f64, seen: &[Seen; 2]) -> f64 {
        let (model, deltas) = (self.model, self.deformations(r));
        let stored = |side: Side| {
            model.energy_at_rest((self.slot, side), &self.angles(side, &seen[side as usize]), deltas[side as usize])
        };
        stored(Side::Inner) + stored(Side::Outer) - self.own * r
    }
}
