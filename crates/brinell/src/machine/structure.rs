//! A shaft or a housing, on which bearings sit, elastic or rigid, in coordinates of which each is a mode of its own: M = 1.

use crate::model::Support;
use crate::solver::DAMPED_CONTACT;
use brinell_shaft::{Beam, Port, Reduced, normal_modes};

/// A place of a body and a direction: the displacement or tilt there is the product of its numbers with the coordinates, and a force or moment
/// there pushes the coordinates by the same numbers times it.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// The first coordinate with a share.
    from: usize,
    values: Vec<f64>,
}

impl Row {
    /// Of a plane of a shaft, 0 for (X, Z) and 1 for (Y, Z).
    fn in_plane(port: &Port, plane: usize) -> Self {
        Self { from: plane * port.0.len(), values: port.0.as_slice().to_vec() }
    }

    /// The share of a coordinate.
    pub(super) fn share(&self, coordinate: usize) -> f64 {
        let at = coordinate.checked_sub(self.from);
        at.and_then(|at| self.values.get(at)).copied().unwrap_or(0.0)
    }

    /// Of one coordinate alone.
    fn at(coordinate: usize, value: f64) -> Self {
        Self { from: coordinate, values: vec![value] }
    }

    /// At these coordinates, or at their rates.
    #[inline]
    pub(super) fn of(&self, coordinates: &[f64]) -> f64 {
        self.values.iter().zip(&coordinates[self.from..]).map(|(share, q)| share * q).sum()
    }

    /// The same of what `each` coordinate has.
    pub(super) fn of_each(&self, each: impl Fn(usize) -> f64) -> f64 {
        self.values.iter().enumerate().map(|(k, share)| share * each(self.from + k)).sum()
    }

    /// The sum of its squares.
    pub(super) fn square(&self) -> f64 {
        self.values.iter().map(|share| share * share).sum()
    }

    /// Adds what `force` (N, or N m) does there.
    #[inline]
    pub(crate) fn push(&self, force: f64, onto: &mut [f64]) {
        self.values.iter().zip(&mut onto[self.from..]).for_each(|(share, f)| *f += share * force);
    }
}

/// A place of a body in both planes: where a bearing's ring sits.
#[derive(Debug, Clone, PartialEq)]
pub struct Seat {
    /// x and y.
    pub shift: [Row; 2],
    /// tau_x and tau_y.
    pub tilt: [Row; 2],
}

impl Seat {
    /// The displacement in a direction, rad from X.
    pub fn along(&self, direction: f64) -> Row {
        let (sin, cos) = direction.sin_cos();
        let [x, y] = &self.shift;
        let (from, end) = (x.from.min(y.from), (x.from + x.values.len()).max(y.from + y.values.len()));
        let mut all = vec![0.0; end];
        x.push(cos, &mut all);
        y.push(sin, &mut all);
        Row { from, values: all.split_off(from) }
    }
}

/// A shaft or a housing.
#[derive(Debug, Clone, PartialEq)]
pub struct Structure {
    /// Squares of the natural frequencies, rad^2/s^2.
    pub(super) squares: Vec<f64>,
    /// Dampers, 1/s.
    pub(super) dampers: Vec<f64>,
    /// G over the coordinates of a plane, row by row, at 1 rad/s; empty where nothing turns.
    gyroscopic: Vec<f64>,
    /// What its weight is of x and of y: momentum in that direction over the rates.
    pub(super) momentum: [Row; 2],
    /// The full load.
    pub(super) load: Vec<f64>,
    /// Unbalance where the shaft stands at 0 and a quarter of a turn on, kg m.
    pub(super) unbalance: [Vec<f64>; 2],
    /// Whether it moves as a whole, the same way in both planes: a shaft, a rigid body.
    pub(super) is_body: bool,
}

impl Structure {
    fn new(squares: Vec<f64>, dampers: Vec<f64>, momentum: [Row; 2]) -> Self {
        let zeros = vec![0.0; squares.len()];
        Self {
            squares,
            dampers,
            gyroscopic: Vec::new(),
            momentum,
            load: zeros.clone(),
            unbalance: [zeros.clone(), zeros],
            is_body: true,
        }
    }

    /// A shaft, and the beam that it was.
    pub fn shaft(beam: &Beam, reduced: &Reduced) -> Self {
        let weight = reduced.port(&beam.weight());
        let twice = |of: Vec<f64>| [of.clone(), of].concat();
        let equations = &reduced.equations;
        let of = |matrix: &dyn Fn(usize) -> f64| twice((0..equations.size()).map(matrix).collect());
        Self {
            gyroscopic: equations.gyroscopic.transpose().as_slice().to_vec(),
            ..Self::new(
                of(&|k| equations.stiffness[(k, k)]),
                of(&|k| equations.damping[(k, k)]),
                [0, 1].map(|plane| Row::in_plane(&weight, plane)),
            )
        }
    }

    /// A rigid body of this mass (kg) and moment of inertia (kg m^2) on springs to the ground.
    pub fn rigid((mass, inertia): (f64, f64), (shift, tilt): (Support, Support)) -> Self {
        let over = |of: [f64; 2]| [of[0] / mass, of[0] / mass, of[1] / inertia, of[1] / inertia].to_vec();
        Self::new(
            over([shift.stiffness, tilt.stiffness]),
            over([shift.damping, tilt.damping]),
            [0, 1].map(|k| Row::at(k, mass.sqrt())),
        )
    }

    /// The `k`-th of the coordinates that move in (X, Z); a shaft's come first, those of a rigid body alternate with those in (Y, Z).
    pub(super) fn in_first_plane(&self, k: usize) -> usize {
        if self.is_shaft() { k } else { 2 * k }
    }

    fn is_shaft(&self) -> bool {
        !self.gyroscopic.is_empty()
    }

    /// G, row by row, at 1 rad/s.
    pub(super) fn gyroscopic_rows(&self) -> impl Iterator<Item = &[f64]> {
        self.gyroscopic.chunks_exact((self.size() / 2).max(1))
    }

    /// A housing of these modes, each with its shape, and with rings of these masses (kg) on it, where `seats[ring][axis]` are the
    /// displacements in each mode; and the rows that rows over the modes become. `None` where a mass is not one.
    pub fn elastic(
        (squares, dampers): (&[f64], &[f64]),
        rings: &[(f64, [Vec<f64>; 2])],
    ) -> Option<(Self, impl Fn(&[f64]) -> Row + use<>)> {
        let n = squares.len();
        let diagonal = |of: &[f64]| -> Vec<Vec<f64>> {
            (0..n).map(|i| (0..n).map(|j| if i == j { of[i] } else { 0.0 }).collect()).collect()
        };
        let mut mass = diagonal(&vec![1.0; n]);
        for (ring, places) in rings {
            for place in places {
                for i in 0..n {
                    (0..n).for_each(|j| mass[i][j] += ring * place[i] * place[j]);
                }
            }
        }
        let modes = normal_modes(&mass, &diagonal(squares))?;
        let taken = |shape: &Vec<f64>| -> f64 { shape.iter().zip(dampers).map(|(u, damper)| damper * u * u).sum() };
        let (squares, dampers) = modes.iter().map(|(w, shape)| (w * w, taken(shape))).unzip();
        let shapes: Vec<Vec<f64>> = modes.into_iter().map(|(_, shape)| shape).collect();
        let row = move |of: &[f64]| Row {
            from: 0,
            values: shapes.iter().map(|shape| shape.iter().zip(of).map(|(u, share)| u * share).sum()).collect(),
        };
        let momentum = [0, 1].map(|axis: usize| {
            let sum = (0..n).map(|k| rings.iter().map(|(ring, places)| ring * places[axis][k]).sum::<f64>());
            row(&sum.collect::<Vec<_>>())
        });
        Some((Self { is_body: false, ..Self::new(squares, dampers, momentum) }, row))
    }

    /// A place of it: x and y, without tilt.
    pub(super) fn seat_of_elastic(shift: [Row; 2]) -> Seat {
        Seat { shift, tilt: [0, 1].map(|_| Row { from: 0, values: Vec::new() }) }
    }

    /// Coordinates.
    pub fn size(&self) -> usize {
        self.squares.len()
    }

    /// Where a shaft's node is, by its displacement and its tilt in a plane.
    pub fn seat_of_shaft(shift: &Port, tilt: &Port) -> Seat {
        let rows = |port: &Port| [0, 1].map(|plane| Row::in_plane(port, plane));
        Seat { shift: rows(shift), tilt: rows(tilt) }
    }

    /// A place of a rigid body, `lever` (m) along the axis from its centre of mass.
    pub fn seat_of_rigid((mass, inertia): (f64, f64), lever: f64) -> Seat {
        let (shift, tilt) = (mass.sqrt().recip(), inertia.sqrt().recip());
        Seat {
            shift: [0, 1].map(|k| Row { from: k, values: vec![shift, 0.0, lever * tilt] }),
            tilt: [0, 1].map(|k| Row::at(2 + k, tilt)),
        }
    }

    /// Adds a force [x, y], N, of the load.
    pub fn add_load(&mut self, seat: &Seat, force: [f64; 2]) {
        (0..2).for_each(|k| seat.shift[k].push(force[k], &mut self.load));
    }

    /// Adds an unbalance (kg m) that stands at `angle` (rad) from X at t = 0.
    pub fn add_unbalance(&mut self, seat: &Seat, size: f64, angle: f64) {
        let (sin, cos) = angle.sin_cos();
        let [at_0, quarter_on] = &mut self.unbalance;
        seat.shift[0].push(size * cos, at_0);
        seat.shift[1].push(size * sin, at_0);
        seat.shift[0].push(-size * sin, quarter_on);
        seat.shift[1].push(size * cos, quarter_on);
    }

    /// Load and weight together, N, along X and Y.
    pub(super) fn pulled(&self, gravity: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k: usize| self.momentum[k].of(&self.load) + self.momentum[k].square() * gravity[k])
    }

    /// What loads and unbalances do to coordinate `k` ([`Machine::driven`](super::Machine)).
    #[inline]
    pub(super) fn driving(&self, k: usize, (share, pulls): (f64, [f64; 2])) -> f64 {
        share * self.load[k] + pulls[0] * self.unbalance[0][k] + pulls[1] * self.unbalance[1][k]
    }

    /// Adds springs, dampers and gyroscopic terms at the speed `w` to the forces `f`, and gives what the dampers take, W.
    #[inline]
    pub(super) fn hold(&self, (q, v): (&[f64], &[f64]), w: f64, f: &mut [f64]) -> f64 {
        let mut taken = 0.0;
        for k in 0..self.size() {
            f[k] -= self.squares[k] * q[k] + self.dampers[k] * v[k];
            taken += self.dampers[k] * v[k] * v[k];
        }
        if !self.gyroscopic.is_empty() {
            let n = self.size() / 2;
            let (v_x, v_y) = v.split_at(n);
            let (f_x, f_y) = f.split_at_mut(n);
            for (k, row) in self.gyroscopic.chunks_exact(n).enumerate() {
                let of = |rates: &[f64]| row.iter().zip(rates).map(|(g, v)| g * v).sum::<f64>();
                f_x[k] -= w * of(v_y);
                f_y[k] += w * of(v_x);
            }
        }
        taken
    }

    /// Longest step in which every motion decays at speeds up to `fastest`, rad/s.
    pub(super) fn longest_step(&self, fastest: f64) -> f64 {
        let n = (self.size() / 2).max(1);
        let row = |row: &[f64]| row.iter().map(|g| g.abs()).sum();
        let turning = fastest * self.gyroscopic.chunks_exact(n).map(row).fold(0.0, f64::max);
        let of = self.squares.iter().zip(&self.dampers).map(|(square, damper)| {
            let rate = square.sqrt() + turning;
            DAMPED_CONTACT.stability_limit(rate, 0.5 * damper / rate.max(f64::MIN_POSITIVE))
        });
        of.fold(f64::INFINITY, f64::min)
    }

    /// Kinetic energy and that of its springs, J.
    pub(super) fn energy(&self, (q, v): (&[f64], &[f64])) -> [f64; 2] {
        let kinetic: f64 = v[..self.size()].iter().map(|v| v * v).sum();
        let elastic: f64 = self.squares.iter().zip(q).map(|(square, q)| square * q * q).sum();
        [0.5 * kinetic, 0.5 * elastic]
    }
}
