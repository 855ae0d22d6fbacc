//! What a machine is made of, and where each coordinate is.

use super::structure::{Row, Seat, Structure};
use crate::analysis::STANDARD_GRAVITY;
use crate::lanes::WIDTH;
use crate::model::{Model, Support};
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
    /// By how much the ring is off that place, m.
    pub shift: [f64; 2],
    /// By how much it is tilted against it, rad.
    pub tilt: [f64; 2],
}

/// A ring among a bearing's positions.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ring {
    /// x; y follows.
    pub(super) shift: usize,
    /// kg.
    pub(super) mass: f64,
    /// tau_x, and tau_y follows, with the moment of inertia, kg m^2, where it tilts.
    pub(super) tilt: Option<(usize, f64)>,
}

/// A bearing in the machine.
#[derive(Debug, Clone, PartialEq)]
pub struct Seated {
    /// The bearing. Its rings' masses belong to the structures that they sit on, too; supports and loads of a ring act on its seat.
    pub model: Model,
    /// Where the inner and the outer ring sit; a ring that sits nowhere moves on its own support.
    pub mounts: [Option<Mount>; 2],
    /// Where the outer ring's support is fixed; none: to the ground.
    pub fit: Option<Mount>,
    /// Its first position.
    pub(super) first: usize,
}

impl Seated {
    /// The inner and the outer ring, in the order of `mounts`.
    pub(super) fn rings(model: &Model) -> [Ring; 2] {
        let (l, m) = (&model.layout, &model.inertia);
        let tilts = model.tilt.as_ref().map(|tilt| [tilt.inner.inertia, tilt.outer.inertia]);
        let tilt = |at: usize, side: usize| tilts.map(|inertia| (at, inertia[side]));
        [
            Ring { shift: l.inner(), mass: m.inner_ring, tilt: tilt(l.inner_tilt(), 0) },
            Ring { shift: l.outer(), mass: m.outer_ring, tilt: tilt(l.outer_tilt(), 1) },
        ]
    }

    /// Its positions among those of the machine.
    pub(super) fn range(&self) -> std::ops::Range<usize> {
        self.first..self.first + self.model.layout.dof()
    }
}

/// What a fit adds to a support that is fixed to the ground.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fit {
    /// The ring's x; y follows.
    pub(super) ring: usize,
    /// Further force on the ring, N.
    pub(super) on_ring: [f64; 2],
    /// Force on the structure at the seat, N.
    pub(super) on_seat: [f64; 2],
    /// Further loss in the damper, W.
    pub(super) loss: f64,
    /// Further energy of the spring, J.
    pub(super) energy: f64,
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
            Seated { first: next(model.layout.dof()), model, mounts, fit: None }
        };
        let bearings: Vec<Seated> = bearings.into_iter().map(place).collect();
        let firsts = structures.iter().map(|structure| next(structure.size())).collect();
        let first_point = next(points.len());
        let fastest = bearings[0].model.rotation.max_speed();
        let limits = structures.iter().map(|structure: &Structure| structure.longest_step(fastest));
        let longest = limits.fold(f64::INFINITY, f64::min);
        Self { longest, bearings, structures, points, firsts, first_point }
    }

    /// Fixes the support of a bearing's outer ring, which sits nowhere, to a structure: a fit that gives way.
    #[must_use]
    pub fn with_fit(mut self, bearing: usize, mount: Mount) -> Self {
        self.bearings[bearing].fit = Some(mount);
        self
    }

    /// What a fit makes of its ring's support to the ground.
    #[inline]
    pub(super) fn fit(&self, seated: &Seated, y: &[f64]) -> Option<Fit> {
        let mount = seated.fit.as_ref()?;
        let (q, v) = y.split_at(self.dof());
        let Support { stiffness, damping } = seated.model.outer_support;
        let at = seated.first + seated.model.layout.outer();
        let mut fit = Fit { ring: at, on_ring: [0.0; 2], on_seat: [0.0; 2], loss: 0.0, energy: 0.0 };
        for k in 0..2 {
            let row = &mount.seat.shift[k];
            let place = row.of(self.of_structure(mount.structure, q)) + mount.shift[k];
            let rate = row.of(self.of_structure(mount.structure, v));
            let (off, slip) = (q[at + k] - place, v[at + k] - rate);
            fit.on_ring[k] = stiffness * place + damping * rate;
            fit.on_seat[k] = stiffness * off + damping * slip;
            fit.loss += damping * (slip * slip - v[at + k].powi(2));
            fit.energy += 0.5 * stiffness * (off * off - q[at + k].powi(2));
        }
        Some(fit)
    }

    /// The bearing whose speed, gravity and ramp of the load all have.
    #[inline]
    pub(super) fn leading(&self) -> &Model {
        &self.bearings[0].model
    }

    /// The positions of all structures.
    pub(super) fn coordinates(&self) -> std::ops::Range<usize> {
        self.firsts.first().copied().unwrap_or(self.first_point)..self.first_point
    }

    /// Weight of the shaft and of all that is on it, N; 0 without a shaft.
    pub fn shaft_weight(&self) -> f64 {
        self.structures.first().map_or(0.0, |shaft| STANDARD_GRAVITY * shaft.momentum[0].square())
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

    /// What drives structures at `t`: the share of the full load, and what unbalances pull with where they stand at 0 and a quarter of a turn
    /// on, 1/s^2.
    #[inline]
    pub(super) fn driven(&self, t: f64) -> (f64, [f64; 2]) {
        let of = self.leading();
        let (w, angle) = of.rotation.at(t);
        let (sin, cos) = angle.sin_cos();
        let change = of.rotation.acceleration(t);
        (of.load.share(t), [w * w * cos + change * sin, w * w * sin - change * cos])
    }

    /// Has everything that follows a structure follow it: positions, rates or accelerations.
    #[inline]
    pub(super) fn follow(&self, all: &mut [f64]) {
        for seated in &self.bearings {
            let rings = Seated::rings(&seated.model);
            for (mount, Ring { shift, tilt, .. }) in seated.mounts.iter().zip(rings) {
                let Some(Mount { structure, seat, .. }) = mount else { continue };
                let [x, y] = [0, 1].map(|k: usize| seat.shift[k].of(self.of_structure(*structure, all)));
                all[seated.first + shift..][..2].copy_from_slice(&[x, y]);
                if let Some((tilt, _)) = tilt {
                    let [x, y] = [0, 1].map(|k: usize| seat.tilt[k].of(self.of_structure(*structure, all)));
                    all[seated.first + tilt..][..2].copy_from_slice(&[x, y]);
                }
            }
        }
        for (k, point) in self.points.iter().enumerate() {
            all[self.first_point + k] = point.row.of(self.of_structure(point.structure, all));
        }
    }

    /// Has the positions of what follows a structure follow it, as its seats are made.
    pub(super) fn place(&self, positions: &mut [f64]) {
        self.follow(positions);
        for seated in &self.bearings {
            let rings = Seated::rings(&seated.model);
            for (mount, Ring { shift, tilt, .. }) in seated.mounts.iter().zip(rings) {
                let Some(mount) = mount else { continue };
                let off = |at: usize, by: [f64; 2]| (0..2).map(move |k| (seated.first + at + k, by[k]));
                let shifts = off(shift, mount.shift);
                let tilts = tilt.into_iter().flat_map(|(at, _)| off(at, mount.tilt));
                shifts.chain(tilts).for_each(|(at, by)| positions[at] += by);
            }
            if let Some(mount) = &seated.fit {
                let at = seated.first + seated.model.layout.outer();
                (0..2).for_each(|k| positions[at + k] += mount.shift[k]);
            }
        }
    }

    /// The state at t = 0, by the start of the first bearing: in balance, or every structure and ring `start::INITIAL_OFFSET` off in X and in
    /// Y and every bearing's elements rolling, or at rest.
    ///
    /// # Errors
    /// Where the start is `equilibrium` and there is none.
    pub fn initial(&self) -> Result<Vec<f64>, NoBalance> {
        let first = self.leading();
        if self.is_one_bearing() {
            return start::state(first);
        }
        let mut y = self.off_balance();
        if first.start == Start::Equilibrium {
            y[..self.dof()].copy_from_slice(&self.balance()?.positions);
        }
        Ok(y)
    }

    /// The same whatever the start but for rest, out of balance.
    pub(super) fn off_balance(&self) -> Vec<f64> {
        let mut y = vec![0.0; 2 * self.dof()];
        let (q, v) = y.split_at_mut(self.dof());
        for seated in &self.bearings {
            let own = start::off_balance(&seated.model);
            let (own_q, own_v) = own.split_at(seated.model.layout.dof());
            q[seated.range()].copy_from_slice(own_q);
            v[seated.range()].copy_from_slice(own_v);
        }
        for (structure, &first) in self.structures.iter().zip(&self.firsts) {
            let coordinates = &mut q[first..][..structure.size()];
            structure.momentum.iter().for_each(|along| along.push(start::INITIAL_OFFSET, coordinates));
        }
        self.place(q);
        self.follow(v);
        y
    }
}
