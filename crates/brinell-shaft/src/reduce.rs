//! A shaft in a few modes.

use crate::beam::Beam;
use crate::equations::{Equations, Port};
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use std::f64::consts::TAU;

/// A shaft in coordinates of which each is a mode of its own: M is 1, K the squares of the natural frequencies.
#[derive(Debug, Clone, PartialEq)]
pub struct Reduced {
    /// The displacements and tilts of the nodes in each mode, a column a mode.
    pub shapes: DMatrix<f64>,
    /// Natural frequencies at rest without bearings, rad/s, ascending; the first two are 0 where no spring holds the shaft.
    pub frequencies: Vec<f64>,
    /// The equations in these coordinates.
    pub equations: Equations,
}

impl Reduced {
    /// A place of the beam in these coordinates.
    pub fn port(&self, of_beam: &Port) -> Port {
        Port(self.shapes.tr_mul(&of_beam.0))
    }
}

/// Modes that are kept at least: the rigid ones and four that bend, for gyroscopic moments of discs, which no residual vector knows.
const LEAST: usize = 6;

/// Fastest motion that is followed, rad/s: 20 kHz, below the 40 kHz of a loaded rolling element.
const FASTEST: f64 = TAU * 2e4;

/// The modes at rest up to `band` (Hz), six at least, and one residual vector for each of `ports`, where forces act: what all other modes
/// together yield there to a static force. Modes have the damping ratio `damping`.
///
/// The shaft is rigid where `is_rigid`: it keeps its two rigid motions alone. Motions faster than 20 kHz are slowed down to that, and yield to a static
/// force as before.
///
/// `None` where the shaft has a part without mass.
pub fn reduce(beam: &Beam, band: f64, ports: &[Port], damping: f64, is_rigid: bool) -> Option<Reduced> {
    let full = &beam.equations;
    let basis = if is_rigid {
        DMatrix::from_columns(&beam.rigid())
    } else {
        let (frequencies, modes) = modes(&full.mass, &full.stiffness)?;
        let kept = frequencies.iter().filter(|w| **w <= TAU * band).count().max(LEAST).min(frequencies.len());
        let mut basis = modes.columns(0, kept).into_owned();
        // On springs the motions of the rigid shaft are no modes, and belong to it all the same: its momentum and weight.
        if frequencies[0] > 0.0 {
            let rigid = DMatrix::from_columns(&beam.rigid());
            basis = DMatrix::from_columns(&rigid.column_iter().chain(basis.column_iter()).collect::<Vec<_>>());
        }
        for port in ports {
            let mut residual = DVector::zeros(full.size());
            for k in kept..frequencies.len() {
                let mode = modes.column(k);
                residual += mode * (mode.dot(&port.0) / frequencies[k].powi(2));
            }
            // Of M-length 1; nothing where the modes kept say it all.
            let length = residual.dot(&(&full.mass * &residual)).sqrt();
            if length > 0.0 {
                let columns = basis.ncols();
                basis = basis.insert_column(columns, 0.0);
                basis.set_column(columns, &(residual / length));
            }
        }
        independent(&basis, &full.mass)
    };
    let project = |matrix: &DMatrix<f64>| basis.tr_mul(&(matrix * &basis));
    let (mut frequencies, turned) = modes(&project(&full.mass), &project(&full.stiffness))?;
    let mut shapes = basis * turned;
    if is_rigid {
        // Its own elasticity is round-off, and the springs' are kept.
        frequencies.iter_mut().for_each(|w| *w = if *w < 1e-3 { 0.0 } else { *w });
    }
    // What is faster yields as much to a force, and moves slower: as with more mass of its own. No step is shortened by a stiff shaft.
    for (k, w) in frequencies.iter_mut().enumerate().filter(|(_, w)| **w > FASTEST) {
        shapes.column_mut(k).scale_mut(FASTEST / *w);
        *w = FASTEST;
    }
    let n = frequencies.len();
    let diagonal = |of: &dyn Fn(f64) -> f64| {
        DMatrix::from_diagonal(&DVector::from_iterator(n, frequencies.iter().map(|w| of(*w))))
    };
    let equations = Equations {
        mass: DMatrix::identity(n, n),
        stiffness: diagonal(&|w| w * w),
        damping: diagonal(&|w| 2.0 * damping * w),
        gyroscopic: shapes.tr_mul(&(&full.gyroscopic * &shapes)),
    };
    Some(Reduced { shapes, frequencies, equations })
}

/// Natural frequencies of K u = w^2 M u, rad/s and ascending, each with its shape of modal mass 1: u^T M u = 1. Matrices are symmetric, row by row.
///
/// `None` where M is not positive definite, or a row has another length.
pub fn normal_modes(mass: &[Vec<f64>], stiffness: &[Vec<f64>]) -> Option<Vec<(f64, Vec<f64>)>> {
    let n = mass.len();
    let square = |rows: &[Vec<f64>]| rows.len() == n && rows.iter().all(|row| row.len() == n);
    if n == 0 || !square(mass) || !square(stiffness) || !mass.iter().chain(stiffness).flatten().all(|x| x.is_finite()) {
        return None;
    }
    let matrix = |rows: &[Vec<f64>]| DMatrix::from_fn(n, n, |i, j| rows[i][j]);
    let (frequencies, shapes) = modes(&matrix(mass), &matrix(stiffness))?;
    Some(frequencies.into_iter().zip(shapes.column_iter().map(|shape| shape.iter().copied().collect())).collect())
}

/// Natural frequencies, rad/s and ascending, and M-orthonormal shapes of K u = w^2 M u.
fn modes(mass: &DMatrix<f64>, stiffness: &DMatrix<f64>) -> Option<(Vec<f64>, DMatrix<f64>)> {
    let root = mass.clone().cholesky()?.l();
    let half = root.solve_lower_triangular(stiffness)?;
    let whole = root.solve_lower_triangular(&half.transpose())?;
    let eigen = SymmetricEigen::new(0.5 * (&whole + whole.transpose()));
    let mut order: Vec<usize> = (0..mass.nrows()).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
    let largest = eigen.eigenvalues.max();
    // A rigid motion's own is round-off.
    let frequency = |k: &usize| {
        let square = eigen.eigenvalues[*k];
        if square > 1e-12 * largest { square.sqrt() } else { 0.0 }
    };
    let frequencies = order.iter().map(frequency).collect();
    let columns: Vec<_> = order.iter().map(|&k| eigen.eigenvectors.column(k).into_owned()).collect();
    Some((frequencies, root.tr_solve_lower_triangular(&DMatrix::from_columns(&columns))?))
}

/// The same space by vectors of M-length 1 at right angles, without those that the ones before say.
fn independent(basis: &DMatrix<f64>, mass: &DMatrix<f64>) -> DMatrix<f64> {
    let mut kept: Vec<DVector<f64>> = Vec::new();
    for column in basis.column_iter() {
        let mut vector = column.into_owned();
        // Twice is enough.
        for _ in 0..2 {
            for other in &kept {
                let share = other.dot(&(mass * &vector));
                vector -= other * share;
            }
        }
        let length = vector.dot(&(mass * &vector)).sqrt();
        if length > 1e-6 {
            kept.push(vector / length);
        }
    }
    DMatrix::from_columns(&kept)
}
