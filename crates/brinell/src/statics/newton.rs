//! A damped Newton method for the least potential energy.

use super::balance::NoBalance;

const MAX_ITERATIONS: usize = 200;

/// Coordinates.
pub(crate) trait Vector: Clone + AsRef<[f64]> + AsMut<[f64]> {}

impl<V: Clone + AsRef<[f64]> + AsMut<[f64]>> Vector for V {}

/// A square matrix by its rows.
pub(crate) trait Square<V>: Clone + AsRef<[V]> + AsMut<[V]> {}

impl<V, M: Clone + AsRef<[V]> + AsMut<[V]>> Square<V> for M {}

/// Potential energy with its derivatives.
pub(crate) struct State<V, M> {
    pub(crate) potential: f64,
    pub(crate) gradient: V,
    pub(crate) hessian: M,
}

/// The same of as many coordinates as the compiler is told.
pub(super) type Fixed<const N: usize> = State<[f64; N], [[f64; N]; N]>;

impl<const N: usize> Fixed<N> {
    /// Of springs from 0 to the coordinates `x` and of forces on them.
    pub(super) fn of_springs(springs: &[f64; N], forces: &[f64; N], x: &[f64; N]) -> Self {
        let mut hessian = [[0.0; N]; N];
        (0..N).for_each(|i| hessian[i][i] = springs[i]);
        Self {
            potential: (0..N).map(|i| 0.5 * springs[i] * x[i] * x[i] - forces[i] * x[i]).sum(),
            gradient: std::array::from_fn(|i| springs[i] * x[i] - forces[i]),
            hessian,
        }
    }

    /// The same, its size forgotten.
    pub(super) fn of_any_size(self) -> State<Vec<f64>, Vec<Vec<f64>>> {
        let hessian = self.hessian.iter().map(|row| row.to_vec()).collect();
        State { potential: self.potential, gradient: self.gradient.to_vec(), hessian }
    }
}

/// Where the gradient vanishes.
pub(crate) struct Minimum<V> {
    pub(crate) x: V,
    pub(crate) residual: f64,
    pub(crate) iterations: usize,
}

/// The minimum near `guess` over the coordinates that are `free`; the others stay at 0. `scale` is the largest force at
/// play, `stalled` the residual with which a search that gets no farther has found it, `damping` what is added to the Hessian at first.
pub(crate) fn minimise<V: Vector, M: Square<V>>(
    guess: V,
    free: &[bool],
    (scale, stalled, mut damping): (f64, f64, f64),
    mut evaluate: impl FnMut(&V) -> State<V, M>,
) -> Result<Minimum<V>, NoBalance> {
    let n = free.len();
    let mut held = |x: &V| {
        let mut state = evaluate(x);
        for i in (0..n).filter(|&i| !free[i]) {
            state.gradient.as_mut()[i] = 0.0;
            let rows = state.hessian.as_mut();
            for j in 0..n {
                rows[i].as_mut()[j] = 0.0;
                rows[j].as_mut()[i] = 0.0;
            }
        }
        state
    };
    let ended = |x, residual, iterations| match residual <= stalled {
        true => Ok(Minimum { x, residual, iterations }),
        false => Err(NoBalance { residual, scale, iterations }),
    };
    let largest = |gradient: &V| gradient.as_ref().iter().fold(0.0_f64, |m, g| m.max(g.abs()));
    let mut x = guess;
    (0..n).filter(|&k| !free[k]).for_each(|k| x.as_mut()[k] = 0.0);
    let mut state = held(&x);
    let mut residual = 0.0;
    for iterations in 0..MAX_ITERATIONS {
        residual = largest(&state.gradient);
        if residual <= 1e-10 * scale {
            return Ok(Minimum { x, residual, iterations });
        }
        let mut improved = false;
        for _ in 0..60 {
            let (mut damped, mut down) = (state.hessian.clone(), state.gradient.clone());
            (0..n).for_each(|k| damped.as_mut()[k].as_mut()[k] += if free[k] { damping } else { 1.0 });
            down.as_mut().iter_mut().for_each(|g| *g = -*g);
            let Some(step) = eliminate(damped, down) else {
                damping *= 10.0;
                continue;
            };
            let mut trial = x.clone();
            (0..n).filter(|&k| free[k]).for_each(|k| trial.as_mut()[k] += step.as_ref()[k]);
            let tried = held(&trial);
            let potential = state.potential;
            // Near the solution the potential no longer resolves the progress, but the residual does.
            if tried.potential < potential
                || (largest(&tried.gradient) < residual && tried.potential <= potential + 1e-12 * potential.abs())
            {
                x = trial;
                state = tried;
                damping *= 0.1;
                improved = true;
                break;
            }
            damping = (damping * 10.0).max(1e-6);
        }
        if !improved {
            return ended(x, residual, iterations);
        }
    }
    ended(x, residual, MAX_ITERATIONS)
}

/// Gaussian elimination with partial pivoting; `None` where the matrix is singular.
pub(crate) fn eliminate<V: Vector, M: Square<V>>(mut a: M, mut x: V) -> Option<V> {
    let (a, b) = (a.as_mut(), x.as_mut());
    let n = b.len();
    for column in 0..n {
        let size = |i: usize| a[i].as_ref()[column].abs();
        let pivot = (column..n).max_by(|&i, &j| size(i).total_cmp(&size(j)))?;
        if size(pivot) == 0.0 || !size(pivot).is_finite() {
            return None;
        }
        a.swap(column, pivot);
        b.swap(column, pivot);
        let (above, below) = a.split_at_mut(column + 1);
        let above = above[column].as_ref();
        for (row, of) in (column + 1..n).zip(below) {
            let of = of.as_mut();
            let factor = of[column] / above[column];
            for k in column..n {
                of[k] -= factor * above[k];
            }
            b[row] -= factor * b[column];
        }
    }
    for row in (0..n).rev() {
        let of = a[row].as_ref();
        for k in row + 1..n {
            b[row] -= of[k] * b[k];
        }
        b[row] /= of[row];
    }
    Some(x)
}
