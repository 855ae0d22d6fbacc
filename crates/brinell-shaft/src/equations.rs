//! Equations of motion of a plane of a shaft, and what they say with linear bearings.

use nalgebra::{Complex, DMatrix, DVector, Matrix2, SymmetricEigen};
use std::f64::consts::TAU;

/// Matrices of one plane; the other has the same.
#[derive(Debug, Clone, PartialEq)]
pub struct Equations {
    /// M.
    pub mass: DMatrix<f64>,
    /// K.
    pub stiffness: DMatrix<f64>,
    /// C.
    pub damping: DMatrix<f64>,
    /// G, by which w couples the planes.
    pub gyroscopic: DMatrix<f64>,
}

/// A place of a shaft as a row of numbers: its displacement or tilt in a plane is their product with the coordinates of that plane, and what
/// a force or a moment does there is the same numbers times it.
#[derive(Debug, Clone, PartialEq)]
pub struct Port(pub DVector<f64>);

impl Port {
    /// Of nothing, among so many coordinates of a plane.
    pub fn zeros(size: usize) -> Self {
        Self(DVector::zeros(size))
    }
}

/// A linear bearing or support at a place of the shaft: the force on it is -K (x, y) - C d(x, y)/dt.
#[derive(Debug, Clone, PartialEq)]
pub struct Linear {
    /// Where.
    pub port: Port,
    /// N/m.
    pub stiffness: [[f64; 2]; 2],
    /// N s/m.
    pub damping: [[f64; 2]; 2],
}

/// Which way the shaft's centre goes round in a natural motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Whirl {
    /// As the shaft turns.
    Forward,
    /// Against it.
    Backward,
}

impl Whirl {
    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Forward => "forward",
            Self::Backward => "backward",
        }
    }
}

/// A natural motion at a speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mode {
    /// Damped natural frequency, Hz.
    pub frequency: f64,
    /// Share of critical damping.
    pub damping_ratio: f64,
    /// Of most of the shaft; at rest one forward and one backward on round bearings, else either.
    pub whirl: Whirl,
}

/// Complex amplitudes of the coordinates of X, then of those of Y.
type Shape = DVector<Complex<f64>>;

/// A mode and its shape.
type Motion = (Mode, Shape);

/// Share of a motion's kinetic energy that is that of one at another speed: from the first on both are surely one; below the second they
/// are not. Of two motions that mix, one has a half.
const SAME_MOTION: [f64; 2] = [0.8, 0.4];

/// How often a step from speed to speed is halved until each motion is surely found again.
const HALVINGS: u32 = 5;

impl Whirl {
    fn reversed(self) -> Self {
        match self {
            Self::Forward => Self::Backward,
            Self::Backward => Self::Forward,
        }
    }
}

impl Equations {
    /// All 0, of `n` coordinates a plane.
    pub fn new(n: usize) -> Self {
        let zeros = || DMatrix::zeros(n, n);
        Self { mass: zeros(), stiffness: zeros(), damping: zeros(), gyroscopic: zeros() }
    }

    /// Coordinates of a plane.
    pub fn size(&self) -> usize {
        self.mass.nrows()
    }

    /// The motions that oscillate at the speed `w` (rad/s), by ascending frequency. None where a part has no mass or a number is not finite.
    pub fn modes(&self, bearings: &[Linear], w: f64) -> Vec<Mode> {
        self.motions(bearings, w).into_iter().map(|(mode, _)| mode).collect()
    }

    /// The lines of a Campbell diagram: the first `count` modes at the first of `speeds` (rad/s), and at each further speed those that move
    /// most as they did, so that lines may cross; the bearings are those at the speed. An entry a speed, `None` from where a motion no longer
    /// oscillates.
    pub fn campbell(
        &self,
        bearings: impl Fn(f64) -> Vec<Linear>,
        speeds: &[f64],
        count: usize,
    ) -> Vec<Vec<Option<Mode>>> {
        let Some(&first) = speeds.first() else { return Vec::new() };
        let at = |w: f64| self.motions(&bearings(w), w);
        let mut now: Vec<_> = at(first).into_iter().take(count).map(Some).collect();
        let told =
            |now: &[Option<Motion>]| -> Vec<_> { now.iter().map(|motion| motion.as_ref().map(|m| m.0)).collect() };
        let mut columns = vec![told(&now)];
        for pair in speeds.windows(2) {
            now = self.follow(&at, now, (pair[0], pair[1], &at(pair[1])), HALVINGS);
            columns.push(told(&now));
        }
        (0..now.len()).map(|k| columns.iter().map(|column| column[k]).collect()).collect()
    }

    /// Motions from one speed to another, of all that there are, by way of the speed between them where one is not found again.
    fn follow(
        &self,
        at: &impl Fn(f64) -> Vec<Motion>,
        now: Vec<Option<Motion>>,
        (from, to, there): (f64, f64, &[Motion]),
        halvings: u32,
    ) -> Vec<Option<Motion>> {
        let mut pairs = Vec::new();
        for (j, (_, shape)) in there.iter().enumerate() {
            let heavy = self.momentum(shape);
            for (i, before) in now.iter().enumerate() {
                let Some((_, before)) = before else { continue };
                let share = before.dotc(&heavy).norm_sqr() / shape.dotc(&heavy).re;
                pairs.push((share / before.dotc(&self.momentum(before)).re, i, j));
            }
        }
        pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
        let enough = SAME_MOTION[usize::from(halvings == 0)];
        let mut free: Vec<_> = there.iter().map(Some).collect();
        let mut found: Vec<_> = now.iter().map(|_| None).collect();
        for (_, i, j) in pairs.into_iter().take_while(|pair| pair.0 > enough) {
            if found[i].is_none() {
                found[i] = free[j].take();
            }
        }
        if halvings > 0 && now.iter().zip(&found).any(|(before, after)| before.is_some() && after.is_none()) {
            let between = 0.5 * (from + to);
            let half = self.follow(at, now, (from, between, &at(between)), halvings - 1);
            return self.follow(at, half, (between, to, there), halvings - 1);
        }
        found.into_iter().map(|motion| motion.cloned()).collect()
    }

    /// Modes with their shapes.
    fn motions(&self, bearings: &[Linear], w: f64) -> Vec<Motion> {
        let n = 2 * self.size();
        let [mass, damping, stiffness] = self.both_planes(bearings, w);
        let Some(inverse) = mass.clone().cholesky() else { return Vec::new() };
        let (spring, damper) = (inverse.solve(&stiffness), inverse.solve(&damping));
        // Time in units that make frequencies and their squares of one size.
        let unit = (spring.trace() / n as f64).sqrt().max(1.0);
        let mut matrix = DMatrix::zeros(2 * n, 2 * n);
        matrix.view_mut((0, n), (n, n)).fill_with_identity();
        matrix.view_mut((n, 0), (n, n)).copy_from(&(-spring / (unit * unit)));
        matrix.view_mut((n, n), (n, n)).copy_from(&(-damper / unit));
        // Of what is not finite no eigenvalue would ever be found.
        if !matrix.iter().all(|x| x.is_finite()) {
            return Vec::new();
        }
        let rates = matrix.complex_eigenvalues() * Complex::from(unit);
        let scale = rates.iter().map(|rate| rate.norm()).fold(0.0, f64::max);
        let mut swinging: Vec<_> = rates.iter().copied().filter(|rate| rate.im > 1e-9 * scale).collect();
        swinging.sort_by(|a, b| a.im.total_cmp(&b.im));
        let mut shapes: Vec<Shape> = Vec::new();
        for (k, &rate) in swinging.iter().enumerate() {
            let twins = (0..k).rev().take_while(|&j| (swinging[j] - rate).norm() < 1e-6 * rate.norm());
            let twins: Vec<_> = twins.map(|j| [shapes[j].clone(), self.momentum(&shapes[j])]).collect();
            let mut shape = shape([&mass, &damping, &stiffness], rate, &twins);
            if let [[twin, _]] = &twins[..] {
                [shapes[k - 1], shape] = self.parted([twin, &shape]);
            }
            shapes.push(shape);
        }
        let mode = |(rate, shape): (Complex<f64>, Shape)| {
            let whirl = self.whirl(&shape);
            let mode = Mode {
                frequency: rate.im / TAU,
                damping_ratio: -rate.re / rate.norm(),
                whirl: if w < 0.0 { whirl.reversed() } else { whirl },
            };
            (mode, shape)
        };
        swinging.into_iter().zip(shapes).map(mode).collect()
    }

    /// Any two motions of one rate and at right angles are others just as well: those that go round most, either way. As speed parts them,
    /// on round bearings, they are what is there at rest.
    fn parted(&self, [a, b]: [&Shape; 2]) -> [Shape; 2] {
        let [a, b] = [a, b].map(|u| u / Complex::from(u.dotc(&self.momentum(u)).re.sqrt()));
        let of = |u, v| self.turned(u, v);
        let ways = Matrix2::new(of(&a, &a), of(&a, &b), of(&b, &a), of(&b, &b)).symmetric_eigen().eigenvectors;
        [0, 1].map(|k| &a * ways[(0, k)] + &b * ways[(1, k)])
    }

    /// Of a shaft that turns from X to Y and moves as Re(u exp(i w t)).
    fn whirl(&self, shape: &Shape) -> Whirl {
        if self.turned(shape, shape).re <= 0.0 { Whirl::Forward } else { Whirl::Backward }
    }

    /// How far motions go round, as a Hermitian form: of a motion and itself below 0 where that is from X to Y.
    fn turned(&self, a: &Shape, b: &Shape) -> Complex<f64> {
        let (n, heavy) = (self.size(), self.momentum(b));
        let crossed = |from, to| a.rows(from, n).dotc(&heavy.rows(to, n));
        (crossed(0, n) - crossed(n, 0)) / Complex::new(0.0, 2.0)
    }

    /// M times both planes of a shape.
    fn momentum(&self, shape: &Shape) -> Shape {
        let n = self.size();
        let part = |of: fn(&Complex<f64>) -> f64| {
            let planes = DMatrix::from_iterator(n, 2, shape.iter().map(of));
            &self.mass * planes
        };
        let [re, im] = [part(|u| u.re), part(|u| u.im)];
        DVector::from_iterator(2 * n, re.iter().zip(&im).map(|(re, im)| Complex::new(*re, *im)))
    }

    /// Speeds, rad/s and ascending, that are natural frequencies of the shaft that turns with them, without damping and with the symmetric
    /// part of the bearings' stiffness; on round bearings unbalance excites the forward ones alone. None where a rigid motion is free.
    pub fn critical_speeds(&self, bearings: &[Linear]) -> Vec<(f64, Whirl)> {
        let n = self.size();
        let [mass, _, stiffness] = self.both_planes(bearings, 0.0);
        let Some(root) = (0.5 * (&stiffness + stiffness.transpose())).cholesky() else { return Vec::new() };
        let mut turning = mass.map(Complex::from);
        let gyroscopic = self.gyroscopic.map(|g| Complex::new(0.0, g));
        // K x = w^2 (M x - i G y) and K y = w^2 (M y + i G x), of x and y that go as exp(i w t).
        turning.view_mut((0, n), (n, n)).copy_from(&(-&gyroscopic));
        turning.view_mut((n, 0), (n, n)).copy_from(&gyroscopic);
        let root = root.l().map(Complex::from);
        let Some(half) = root.solve_lower_triangular(&turning) else { return Vec::new() };
        let Some(whole) = root.solve_lower_triangular(&half.adjoint()) else { return Vec::new() };
        let eigen = SymmetricEigen::new(whole);
        let Some(shapes) = root.ad_solve_lower_triangular(&eigen.eigenvectors) else { return Vec::new() };
        let largest = eigen.eigenvalues.max();
        let found = eigen.eigenvalues.iter().zip(shapes.column_iter());
        let mut speeds: Vec<_> = found
            .filter(|(value, _)| **value > 1e-12 * largest)
            .map(|(value, shape)| (value, shape.into_owned()))
            .map(|(value, shape)| (value.sqrt().recip(), self.whirl(&shape)))
            .collect();
        speeds.sort_by(|a, b| a.0.total_cmp(&b.0));
        speeds
    }

    /// What unbalances (kg m, and where on the shaft they are, rad from X at t = 0) do at the speed `w`, rad/s: the complex amplitudes u of
    /// Re(u exp(i w t)), the coordinates of X before those of Y.
    ///
    /// `None` where the speed is a natural frequency without damping.
    pub fn unbalance_response(
        &self,
        bearings: &[Linear],
        w: f64,
        unbalances: &[(Port, f64, f64)],
    ) -> Option<DVector<Complex<f64>>> {
        let n = self.size();
        let matrices = self.both_planes(bearings, w);
        let mut force = DVector::from_element(2 * n, Complex::from(0.0));
        for (port, size, angle) in unbalances {
            let pull = Complex::from_polar(size * w * w, *angle);
            for k in 0..n {
                force[k] += pull * port.0[k];
                // A quarter of a turn later.
                force[n + k] -= pull * Complex::i() * port.0[k];
            }
        }
        dynamic(matrices.each_ref(), Complex::new(0.0, w)).lu().solve(&force)
    }

    /// M, C + w G and K of both planes.
    fn both_planes(&self, bearings: &[Linear], w: f64) -> [DMatrix<f64>; 3] {
        let n = self.size();
        let twice = |of: &DMatrix<f64>| {
            let mut both = DMatrix::zeros(2 * n, 2 * n);
            (0..2).for_each(|plane| both.view_mut((plane * n, plane * n), (n, n)).copy_from(of));
            both
        };
        let [mass, mut damping, mut stiffness] = [&self.mass, &self.damping, &self.stiffness].map(twice);
        damping.view_mut((0, n), (n, n)).copy_from(&(w * &self.gyroscopic));
        damping.view_mut((n, 0), (n, n)).copy_from(&(-w * &self.gyroscopic));
        for bearing in bearings {
            let place = &bearing.port.0 * bearing.port.0.transpose();
            for i in 0..2 {
                for j in 0..2 {
                    let mut spring = stiffness.view_mut((i * n, j * n), (n, n));
                    spring += bearing.stiffness[i][j] * &place;
                    let mut damper = damping.view_mut((i * n, j * n), (n, n));
                    damper += bearing.damping[i][j] * &place;
                }
            }
        }
        [mass, damping, stiffness]
    }
}

/// s^2 M + s C + K.
fn dynamic([mass, damping, stiffness]: [&DMatrix<f64>; 3], s: Complex<f64>) -> DMatrix<Complex<f64>> {
    mass.map(|m| s * s * m) + damping.map(|c| s * c) + stiffness.map(Complex::from)
}

/// The motion of an eigenvalue at right angles to its `twins` (and M times these), by inverse iteration beside it.
fn shape(matrices: [&DMatrix<f64>; 3], rate: Complex<f64>, twins: &[[Shape; 2]]) -> Shape {
    let beside = dynamic(matrices, rate * Complex::new(1.0, 1e-7)).lu();
    // No eigenvector is orthogonal to it but by chance.
    let mut shape = DVector::from_fn(matrices[0].nrows(), |k, _| Complex::new(1.0, (k as f64 + 1.0).sin()));
    for _ in 0..3 {
        if let Some(better) = beside.solve(&shape) {
            shape = better;
        }
        for [twin, heavy] in twins {
            let share = heavy.dotc(&shape) / twin.dotc(heavy);
            shape -= twin * share;
        }
        let size = shape.norm();
        shape /= Complex::from(size);
    }
    shape
}
