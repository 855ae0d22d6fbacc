//! What a machine is made of, and where each coordinate is.

use super::structure::{Row, Seat, Structure};
use crate::lanes::WIDTH;
use crate::model::{Layout, Model};
use crate::operation::Rotation;
use crate::scenario::Start;
use crate::start;
use crate::statics::NoBalance;

/// Where a ring sits.
#[derive(Debug, Clone, PartialEq)]
pub struct Mount {
    /// On which structure, from 0.
    pub structure: usize,
    /// Where on it.
    pub seat: Seat,
}

/// A bearing in the machine.
#[derive(Debug, Clone, PartialEq)]
pub struct Seated {
    /// The bearing. Its rings' masses belong to the structures that they sit on, too; supports and loads of a ring act on its seat.
    pub model: Model,
    /// Where the inner and the outer ring sit; a ring that sits nowhere moves on its own support.
    pub mounts: [Option<Mount>; 2],
    /// Its first position.
    pub(super) first: usize,
}

impl Seated {
    /// First position of each ring's shift, and of its tilt where it tilts, in the order of `mounts`.
    pub(super) fn rings(layout: &Layout) -> [(usize, Option<usize>); 2] {
        let tilt = |at: usize| layout.tilts.then_some(at);
        [(layout.inner(), tilt(layout.inner_tilt())), (layout.outer(), tilt(layout.outer_tilt()))]
    }

    /// Its positions among those of the machine.
    pub(super) fn range(&self) -> std::ops::Range<usize> {
        self.first..self.first + self.model.layout.dof()
    }
}

/// A place of a structure that is looked at, in one direction.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Name of its channel.
    pub name: String,
    /// Whether a sensor reads its acceleration, behind the anti-alias filter; else its displacement is recorded.
    pub is_sensor: bool,
    /// Which structure, from 0.
    pub structure: usize,
    /// Where and which way.
    pub row: Row,
}

/// A shaft on its bearings.
#[derive(Debug, Clone, PartialEq)]
pub struct Machine {
    /// The bearings.
    pub bearings: Vec<Seated>,
    /// The shaft, then housings.
    pub structures: Vec<Structure>,
    /// What is looked at beside the bearings' rings.
    pub points: Vec<Point>,
    /// First position of each structure.
    pub(super) firsts: Vec<usize>,
    /// First of the points.
    pub(super) first_point: usize,
    /// How the shaft turns.
    pub rotation: Rotation,
    /// Time over which the loads rise, s.
    pub ramp: f64,
    /// g, m/s^2.
    pub gravity: [f64; 2],
    /// Longest step that every structure allows, s.
    pub(super) longest: f64,
}

impl Machine {
    /// One bearing on its own supports.
    pub fn of_one(bearing: Model) -> Self {
        Self::new(vec![(bearing, [None, None])], Vec::new(), Vec::new())
    }

    /// Whether it is one bearing and nothing else: its state is the bearing's own.
    #[inline]
    pub fn is_one_bearing(&self) -> bool {
        self.bearings.len() == 1 && self.structures.is_empty()
    }

    /// Of at least one bearing; all turn with the shaft of the first, and share its gravity and the ramp of its load.
    ///
    /// # Panics
    /// Where there is no bearing.
    pub fn new(bearings: Vec<(Model, [Option<Mount>; 2])>, structures: Vec<Structure>, points: Vec<Point>) -> Self {
        let mut end = 0;
        let mut next = |size: usize| {
            end += size;
            end - size
        };
        let place = |(mut model, mounts): (Model, [Option<Mount>; 2])| {
            // A shaft turns with all that sits on it: its gyroscopic terms are the shaft's.
            if let (Some(tilt), Some(_)) = (&mut model.tilt, &mounts[0]) {
                tilt.inner.polar_inertia = 0.0;
            }
            Seated { first: next(model.layout.dof()), model, mounts }
        };
        let bearings: Vec<Seated> = bearings.into_iter().map(place).collect();
        let firsts = structures.iter().map(|structure| next(structure.size())).collect();
        let first_point = next(points.len());
        let of = &bearings[0].model;
        let (rotation, ramp, gravity) = (of.rotation.clone(), of.load.ramp, of.gravity);
        let limits = structures.iter().map(|structure: &Structure| structure.longest_step(rotation.max_speed()));
        let longest = limits.fold(f64::INFINITY, f64::min);
        Self { longest, rotation, ramp, gravity, bearings, structures, points, firsts, first_point }
    }

    /// Whether its outer ring is mounted rigidly, by forces that nobody knows.
    pub fn is_held(&self) -> bool {
        self.bearings.iter().any(|seated| seated.model.outer_ring_is_fixed())
    }

    /// Whether every position of another one is of the same kind.
    pub fn is_laid_out_as(&self, other: &Self) -> bool {
        let bearings = |of: &Self| of.bearings.iter().map(|seated| seated.model.layout).collect::<Vec<_>>();
        bearings(self) == bearings(other) && self.firsts == other.firsts && self.first_point == other.first_point
    }

    /// Number of positions; the state has twice as many entries.
    pub fn dof(&self) -> usize {
        (self.first_point + self.points.len()).next_multiple_of(WIDTH)
    }

    /// Name of the body and coordinate behind a position.
    pub fn name(&self, index: usize) -> String {
        let of = |(k, seated): (usize, &Seated)| {
            let name = seated.model.layout.name(index - seated.first, seated.model.element);
            if self.is_one_bearing() { name } else { format!("{name} of bearing {}", k + 1) }
        };
        let bearing = self.bearings.iter().enumerate().find(|(_, seated)| seated.range().contains(&index));
        let structure = self.firsts.iter().rposition(|first| *first <= index);
        match (bearing.map(of), structure) {
            (Some(name), _) => name,
            (None, Some(0)) => format!("mode {} of the shaft", index - self.firsts[0] + 1),
            (None, of) => format!("a mode of housing {}", of.unwrap_or_default()),
        }
    }

    /// Position of a point that is looked at, from 0.
    pub fn point(&self, k: usize) -> usize {
        self.first_point + k
    }

    /// First position of a bearing, from 0.
    pub fn bearing(&self, k: usize) -> usize {
        self.bearings[k].first
    }

    /// The positions of a structure, or their rates or accelerations, of those of the machine.
    #[inline]
    pub(super) fn of_structure<'a>(&self, k: usize, all: &'a [f64]) -> &'a [f64] {
        &all[self.firsts[k]..][..self.structures[k].size()]
    }

    /// At `t`: the share of the full load, and what unbalances pull with where they stand at 0 and a quarter of a turn on, 1/s^2.
    #[inline]
    fn driven(&self, t: f64) -> (f64, [f64; 2]) {
        let (w, angle) = self.rotation.at(t);
        let (sin, cos) = angle.sin_cos();
        let change = self.rotation.acceleration(t);
        let share = if self.ramp > 0.0 { (t / self.ramp).clamp(0.0, 1.0) } else { 1.0 };
        (share, [w * w * cos + change * sin, w * w * sin - change * cos])
    }

    /// Writes what loads and unbalances do to each structure's coordinates at `t` into `f`, where its positions are.
    #[inline]
    pub(super) fn drive(&self, t: f64, f: &mut [f64]) {
        let (share, pulls) = self.driven(t);
        for (structure, &first) in self.structures.iter().zip(&self.firsts) {
            for (k, f) in f[first..][..structure.size()].iter_mut().enumerate() {
                let [at_0, quarter_on] = [0, 1].map(|turn: usize| pulls[turn] * structure.unbalance[turn][k]);
                *f = share * structure.load[k] + at_0 + quarter_on;
            }
        }
    }

    /// Has everything that follows a structure follow it: positions, rates or accelerations.
    #[inline]
    pub(super) fn follow(&self, all: &mut [f64]) {
        for seated in &self.bearings {
            let rings = Seated::rings(&seated.model.layout);
            for (mount, (shift, tilt)) in seated.mounts.iter().zip(rings) {
                let Some(Mount { structure, seat }) = mount else { continue };
                let [x, y] = [0, 1].map(|k: usize| seat.shift[k].of(self.of_structure(*structure, all)));
                all[seated.first + shift..][..2].copy_from_slice(&[x, y]);
                if let Some(tilt) = tilt {
                    let [x, y] = [0, 1].map(|k: usize| seat.tilt[k].of(self.of_structure(*structure, all)));
                    all[seated.first + tilt..][..2].copy_from_slice(&[x, y]);
                }
            }
        }
        for (k, point) in self.points.iter().enumerate() {
            all[self.first_point + k] = point.row.of(self.of_structure(point.structure, all));
        }
    }

    /// The state at t = 0, by the start of the first bearing: in balance, or every structure and ring `start::INITIAL_OFFSET` off in X and in
    /// Y and every bearing's elements rolling, or at rest.
    ///
    /// # Errors
    /// Where the start is `equilibrium` and there is none.
    pub fn initial(&self) -> Result<Vec<f64>, NoBalance> {
        let first = &self.bearings[0].model;
        if self.is_one_bearing() {
            return start::state(first);
        }
        let dof = self.dof();
        let mut y = vec![0.0; 2 * dof];
        let positions = match first.start {
            Start::Equilibrium => self.balance()?.positions,
            Start::Rolling | Start::Rest => self.initial_positions(),
        };
        y[..dof].copy_from_slice(&positions);
        for seated in &self.bearings {
            let own = start::off_balance(&seated.model);
            y[dof..][seated.range()].copy_from_slice(&own[seated.model.layout.dof()..]);
        }
        self.follow(&mut y[dof..]);
        Ok(y)
    }

    /// Positions at t = 0 out of balance.
    pub(super) fn initial_positions(&self) -> Vec<f64> {
        let mut q = vec![0.0; self.dof()];
        for seated in &self.bearings {
            let own = start::off_balance(&seated.model);
            q[seated.range()].copy_from_slice(&own[..seated.model.layout.dof()]);
        }
        for (structure, &first) in self.structures.iter().zip(&self.firsts) {
            let coordinates = &mut q[first..][..structure.size()];
            structure.momentum.iter().for_each(|along| along.push(start::INITIAL_OFFSET, coordinates));
        }
        self.follow(&mut q);
        q
    }
}
