//! A damped Newton method for the least potential energy.

use super::balance::NoBalance;

const MAX_ITERATIONS: usize = 200;

/// Potential energy with its derivatives.
pub(super) struct State<const N: usize> {
    pub(super) potential: f64,
    pub(super) gradient: [f64; N],
    pub(super) hessian: [[f64; N]; N],
}

impl<const N: usize> State<N> {
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
}

/// Where the gradient vanishes.
pub(super) struct Minimum<const N: usize> {
    pub(super) x: [f64; N],
    pub(super) residual: f64,
    pub(super) iterations: usize,
}

/// The minimum near `guess` over the coordinates that are `free`; the others stay at 0. `scale` is the largest force at
/// play, `stalled` the residual with which a search that gets no farther has found it, `damping` what is added to the Hessian at first.
pub(super) fn minimise<const N: usize>(
    guess: [f64; N],
    free: &[bool; N],
    (scale, stalled, mut damping): (f64, f64, f64),
    mut evaluate: impl FnMut(&[f64; N]) -> State<N>,
) -> Result<Minimum<N>, NoBalance> {
    let mut held = |x: &[f64; N]| {
        let mut state = evaluate(x);
        for i in (0..N).filter(|&i| !free[i]) {
            state.gradient[i] = 0.0;
            for j in 0..N {
                (state.hessian[i][j], state.hessian[j][i]) = (0.0, 0.0);
            }
        }
        state
    };
    let ended = |x, residual, iterations| match residual <= stalled {
        true => Ok(Minimum { x, residual, iterations }),
        false => Err(NoBalance { residual, scale, iterations }),
    };
    let largest = |gradient: &[f64; N]| gradient.iter().fold(0.0_f64, |m, g| m.max(g.abs()));
    let mut x: [f64; N] = std::array::from_fn(|k| if free[k] { guess[k] } else { 0.0 });
    let mut state = held(&x);
    let mut residual = 0.0;
    for iterations in 0..MAX_ITERATIONS {
        residual = largest(&state.gradient);
        if residual <= 1e-10 * scale {
            return Ok(Minimum { x, residual, iterations });
        }
        let mut improved = false;
        for _ in 0..60 {
            let mut damped = state.hessian;
            (0..N).for_each(|k| damped[k][k] += if free[k] { damping } else { 1.0 });
            let Some(step) = eliminate(damped, state.gradient.map(|g| -g)) else {
                damping *= 10.0;
                continue;
            };
            let trial: [f64; N] = std::array::from_fn(|k| if free[k] { x[k] + step[k] } else { x[k] });
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
pub(super) fn eliminate<const N: usize>(mut a: [[f64; N]; N], mut b: [f64; N]) -> Option<[f64; N]> {
    for column in 0..N {
        let pivot = (column..N).max_by(|&i, &j| a[i][column].abs().total_cmp(&a[j][column].abs()))?;
        if a[pivot][column] == 0.0 || !a[pivot][column].is_finite() {
            return None;
        }
        a.swap(column, pivot);
        b.swap(column, pivot);
        for row in column + 1..N {
            let factor = a[row][column] / a[column][column];
            for k in column..N {
                a[row][k] -= factor * a[column][k];
            }
            b[row] -= factor * b[column];
        }
    }
    for row in (0..N).rev() {
        for k in row + 1..N {
            b[row] -= a[row][k] * b[k];
        }
        b[row] /= a[row][row];
    }
    Some(b)
}
