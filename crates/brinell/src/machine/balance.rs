//! Static balance of a machine under its full load: the deflected shaft, and what each bearing carries of it.

use super::assembly::{Machine, Mount, Ring, Seated};
use super::structure::Row;
use crate::statics::{NoBalance, Pressed, Problem, State, held_by, minimise, pressed};

/// The balance.
#[derive(Debug, Clone, PartialEq)]
pub struct Balance {
    /// Positions of the machine; angles of elements and cages are those at the start.
    pub positions: Vec<f64>,
    /// Of each bearing.
    pub bearings: Vec<Carried>,
    /// Largest force left over on a coordinate, N.
    pub residual: f64,
}

/// What a bearing carries.
#[derive(Debug, Clone, PartialEq)]
pub struct Carried {
    /// Force of the inner ring on the elements, N.
    pub force: [f64; 2],
    /// Moment that tilts, of the inner ring on the elements, N m; 0 where nothing tilts.
    pub moment: [f64; 2],
    /// Slope of the inner ring's axis less that of the outer one's, rad: misalignment; of what sits on a structure also where bearings do not tilt.
    pub misalignment: [f64; 2],
}

/// Damping of the search's first step, N/m: any of the order of a contact's stiffness at little load does.
const DAMPING: f64 = 1e4;

/// A coordinate of a bearing's rings: what it is of the coordinates of the search.
enum Place {
    /// On a structure, from that coordinate on, times a lever; and how far off that.
    Seated { from: usize, row: Row, lever: f64, off: f64 },
    /// Its own.
    Own(usize),
}

impl Place {
    fn of(&self, z: &[f64]) -> f64 {
        match self {
            Self::Seated { from, row, lever, off } => lever * (row.of(&z[*from..]) + off),
            Self::Own(k) => z[*k],
        }
    }

    /// What a force on it does to the coordinates.
    fn push(&self, force: f64, onto: &mut [f64]) {
        match self {
            Self::Seated { from, row, lever, .. } => row.push(lever * force, &mut onto[*from..]),
            Self::Own(k) => onto[*k] += force,
        }
    }
}

impl Machine {
    /// The balance with elements at the angles at which they start.
    ///
    /// # Errors
    /// Where something is not held against the load.
    pub fn balance(&self) -> Result<Balance, NoBalance> {
        let coordinates = self.coordinates();
        let mut size = coordinates.len();
        let rings: Vec<Vec<Place>> = self.bearings.iter().map(|seated| self.rings(seated, &mut size)).collect();
        let problems: Vec<Problem> = self.bearings.iter().map(|seated| Problem::at_start(&seated.model)).collect();
        let (springs, forces) = self.held(&rings, size);
        // Less than a thousandth of a newton is no load: preload alone holds.
        let scale = forces.iter().fold(1e-3_f64, |scale, f| scale.max(f.abs()));
        let press = |k: usize, z: &[f64]| {
            let at: Vec<f64> = rings[k].iter().map(|ring| ring.of(z)).collect();
            pressed(&self.bearings[k].model, &problems[k], scale, &at)
        };
        let evaluate = |z: &Vec<f64>| {
            let mut state = State { potential: 0.0, gradient: vec![0.0; size], hessian: springs.clone() };
            for i in 0..size {
                let spring: f64 = springs[i].iter().zip(z).map(|(k, z)| k * z).sum();
                state.potential += (0.5 * spring - forces[i]) * z[i];
                state.gradient[i] = spring - forces[i];
            }
            for (k, rings) in rings.iter().enumerate() {
                let Pressed { state: of, .. } = press(k, z);
                state.potential += of.potential;
                for (ring, force) in rings.iter().zip(&of.gradient) {
                    ring.push(*force, &mut state.gradient);
                }
                spread(&of.hessian, rings, &mut state.hessian);
            }
            state
        };
        let found = minimise(vec![0.0; size], &vec![true; size], (scale, 1e-6 * scale, DAMPING), evaluate)?;
        let mut positions = self.off_balance();
        positions.truncate(self.dof());
        positions[coordinates.clone()].copy_from_slice(&found.x[..coordinates.len()]);
        self.place(&mut positions);
        let mut bearings = Vec::new();
        for (k, seated) in self.bearings.iter().enumerate() {
            let (Pressed { state, r, beta }, l) = (press(k, &found.x), &seated.model.layout);
            let own = &mut positions[seated.range()];
            own[l.r()..][..l.rollers()].copy_from_slice(&r[..l.rollers()]);
            if l.tilts {
                own[l.beta()..][..l.rollers()].copy_from_slice(&beta[..l.rollers()]);
            }
            let (arm, of_ring) = (seated.model.geometry.pitch_radius, rings[k].len() / 2);
            for (side, Ring { shift, tilt, .. }) in Seated::rings(&seated.model).into_iter().enumerate() {
                let at = |i: usize| rings[k][side * of_ring + i].of(&found.x);
                own[shift..][..2].copy_from_slice(&[at(0), at(1)]);
                if let Some((tilt, _)) = tilt {
                    own[tilt..][..2].copy_from_slice(&[at(2) / arm, at(3) / arm]);
                }
            }
            let slope = |side: usize, axis: usize| match &seated.mounts[side] {
                Some(Mount { structure, seat, tilt, .. }) => {
                    seat.tilt[axis].of(self.of_structure(*structure, &positions)) + tilt[axis]
                }
                None if seated.fit.is_some() => {
                    let Some(Mount { structure, seat, tilt, .. }) = &seated.fit else { return 0.0 };
                    seat.tilt[axis].of(self.of_structure(*structure, &positions)) + tilt[axis]
                }
                None if l.tilts => rings[k][side * of_ring + 2 + axis].of(&found.x) / arm,
                None => 0.0,
            };
            bearings.push(Carried {
                force: [0, 1].map(|axis: usize| state.gradient[axis]),
                moment: [0, 1].map(|axis: usize| if l.tilts { arm * state.gradient[2 + axis] } else { 0.0 }),
                misalignment: [0, 1].map(|axis| slope(0, axis) - slope(1, axis)),
            });
        }
        Ok(Balance { positions, bearings, residual: found.residual })
    }

    /// The coordinates of a bearing's rings; those of a ring that sits nowhere are counted up from `next` on.
    fn rings(&self, seated: &Seated, next: &mut usize) -> Vec<Place> {
        let first = self.coordinates().start;
        let arm = seated.model.geometry.pitch_radius;
        let of = |mount: &Option<Mount>| -> Vec<Place> {
            let count = if seated.model.layout.tilts { 4 } else { 2 };
            match mount {
                Some(Mount { structure, seat, shift, tilt }) => {
                    let shifts = seat.shift.iter().zip(shift).map(|(row, off)| (row, 1.0, *off));
                    let levers = shifts.chain(seat.tilt.iter().zip(tilt).map(|(row, off)| (row, arm, *off)));
                    let from = self.firsts[*structure] - first;
                    let place =
                        |(row, lever, off): (&Row, f64, f64)| Place::Seated { from, row: row.clone(), lever, off };
                    levers.take(count).map(place).collect()
                }
                None => {
                    *next += count;
                    (*next - count..*next).map(Place::Own).collect()
                }
            }
        };
        seated.mounts.iter().flat_map(of).collect()
    }

    /// Springs and full forces over the coordinates of the search.
    fn held(&self, rings: &[Vec<Place>], size: usize) -> (Vec<Vec<f64>>, Vec<f64>) {
        let (mut springs, mut forces) = (vec![vec![0.0; size]; size], vec![0.0; size]);
        let (first, gravity) = (self.coordinates().start, self.leading().gravity);
        for (structure, &at) in self.structures.iter().zip(&self.firsts) {
            let onto = &mut forces[at - first..];
            onto.iter_mut().zip(&structure.load).for_each(|(f, load)| *f += load);
            (0..2).for_each(|k| structure.momentum[k].push(gravity[k], onto));
            structure
                .squares
                .iter()
                .enumerate()
                .for_each(|(k, square)| springs[at - first + k][at - first + k] += square);
        }
        for (seated, rings) in self.bearings.iter().zip(rings) {
            let [own_springs, mut own] = held_by(&seated.model);
            // The weight of a ring on a structure is that structure's.
            let (model, half) = (&seated.model, rings.len() / 2);
            for (side, ring) in Seated::rings(model).into_iter().enumerate() {
                if seated.mounts[side].is_some() {
                    (0..2).for_each(|k| own[side * half + k] -= ring.mass * model.gravity[k]);
                }
            }
            let alone: Vec<Vec<f64>> = (0..own.len())
                .map(|i| (0..own.len()).map(|j| if i == j { own_springs[i] } else { 0.0 }).collect())
                .collect();
            spread(&alone, rings, &mut springs);
            self.add_fit(seated, &rings[half..], &mut springs, &mut forces);
            rings.iter().zip(&own).for_each(|(ring, f)| ring.push(*f, &mut forces));
        }
        (springs, forces)
    }
}

impl Machine {
    /// Fixes the support of an outer ring, whose coordinates `rings` are, to where it fits instead of to the ground.
    fn add_fit(&self, seated: &Seated, rings: &[Place], springs: &mut [Vec<f64>], forces: &mut [f64]) {
        let Some(Mount { structure, seat, shift, .. }) = &seated.fit else { return };
        let stiffness = seated.model.outer_support.stiffness;
        let from = self.firsts[*structure] - self.coordinates().start;
        for k in 0..2 {
            let mut ring = vec![0.0; forces.len()];
            rings[k].push(1.0, &mut ring);
            let mut off = ring.clone();
            seat.shift[k].push(-1.0, &mut off[from..]);
            for (i, row) in springs.iter_mut().enumerate() {
                forces[i] += stiffness * shift[k] * off[i];
                row.iter_mut()
                    .enumerate()
                    .for_each(|(j, sum)| *sum += stiffness * (off[i] * off[j] - ring[i] * ring[j]));
            }
        }
    }
}

/// Adds a matrix over the coordinates of a bearing's rings to that over those of the search.
fn spread(of: &[Vec<f64>], rings: &[Place], onto: &mut [Vec<f64>]) {
    let size = onto.len();
    for (row, own) in rings.iter().zip(of) {
        // The row of the bearing, over all coordinates, then along its own ring.
        let (mut across, mut along) = (vec![0.0; size], vec![0.0; size]);
        rings.iter().zip(own).for_each(|(ring, value)| ring.push(*value, &mut across));
        row.push(1.0, &mut along);
        for (onto, share) in onto.iter_mut().zip(&along).filter(|(_, share)| **share != 0.0) {
            onto.iter_mut().zip(&across).for_each(|(sum, value)| *sum += share * value);
        }
    }
}
