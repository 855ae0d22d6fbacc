//! The light on the sound surface: what a photo would show without damage.
//!
//! Medians of cells of the picture; a polynomial of degree 2 through them that half of the cells fit best (least median
//! of squares, Rousseeuw, J. Am. Stat. Assoc. 79 (1984) 871), so that damage may take a third of the picture; degrees 3
//! and 4 by Tukey's weights from there; then, with the damage found, what remains of the cells outside it, smoothed.

use crate::numbers::{median, solved};
use crate::pixels::Pixels;

/// Cells along the longer side.
const CELLS: usize = 64;
/// Pixels along a cell's side that its median is taken of, at most.
const SAMPLES: usize = 12;
/// Cells under which a picture has no light that could be told from damage.
const LEAST_CELLS: usize = 64;
/// Draws of the least median of squares: with 40 % outliers the chance to draw none is above 99.9999 %.
const DRAWS: usize = 400;
/// Cells that a draw is judged by.
const JUDGES: usize = 500;
/// Residuals are never taken for better known than this share of the light.
const LEAST_SCALE: f64 = 0.004;
/// Tukey's constant, in standard deviations.
const TUKEY: f64 = 6.0;
/// Standard deviation of the smoothing of what remains, cells.
const LOCAL: f64 = 4.0;
/// The light is nowhere less than this share of its median.
const DARKEST: f64 = 0.02;

/// The picture in cells.
pub(crate) struct Cells {
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    /// Side of a cell, px.
    pub(crate) side: usize,
    /// Median of each.
    pub(crate) values: Vec<f64>,
}

impl Cells {
    pub(crate) fn of(pixels: &Pixels) -> Self {
        let side = pixels.width.max(pixels.height).div_ceil(CELLS).max(2);
        let (columns, rows) = (pixels.width.div_ceil(side), pixels.height.div_ceil(side));
        let step = side.div_ceil(SAMPLES);
        let mut all: Vec<u16> = Vec::with_capacity(SAMPLES * SAMPLES);
        let mut values = Vec::with_capacity(columns * rows);
        for row in 0..rows {
            for column in 0..columns {
                all.clear();
                for y in (row * side..((row + 1) * side).min(pixels.height)).step_by(step) {
                    let line = &pixels.values[y * pixels.width..(y + 1) * pixels.width];
                    let end = ((column + 1) * side).min(pixels.width);
                    all.extend(line[column * side..end].iter().step_by(step));
                }
                let middle = all.len() / 2;
                values.push(f64::from(*all.select_nth_unstable(middle).1));
            }
        }
        Self { columns, rows, side, values }
    }

    /// Of a cell, from -1 to 1.
    fn place(&self, i: usize) -> [f64; 2] {
        let share = |k: usize, n: usize| (2 * k + 1) as f64 / n as f64 - 1.0;
        [share(i % self.columns, self.columns), share(i / self.columns, self.rows)]
    }

    /// The light at each cell, `damaged` ones left out of it.
    pub(crate) fn light(&self, damaged: Option<&[bool]>) -> Vec<f64> {
        let free = |i: &usize| damaged.is_none_or(|d| !d[*i]);
        let used: Vec<usize> = (0..self.values.len()).filter(free).collect();
        let level = median(used.iter().map(|&i| self.values[i])).max(1.0);
        if used.len() < LEAST_CELLS {
            return vec![level; self.values.len()];
        }
        let mut fit = self.half(&used);
        let mut weights = Vec::new();
        for degree in [2, 3, 4, 4] {
            for _ in 0..4 {
                weights = self.weights(&fit, &used, level);
                fit = self.fitted(degree, &used, &weights).unwrap_or(fit);
            }
        }
        let mut light: Vec<f64> =
            (0..self.values.len()).map(|i| value(&fit, self.place(i)).max(DARKEST * level)).collect();
        if damaged.is_some() {
            self.follow(&mut light, &used, &weights);
        }
        light
    }

    /// The polynomial of degree 2 with the least median residual.
    fn half(&self, used: &[usize]) -> Vec<f64> {
        let mut state = 0x2545_F491_4F6C_DD1D_u64;
        let mut draw = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            used[(state >> 33) as usize % used.len()]
        };
        let judges = used.iter().step_by(1 + used.len() / JUDGES);
        let judges: Vec<(f64, Vec<f64>)> = judges.map(|&i| (self.values[i], basis(2, self.place(i)))).collect();
        let mut best = (f64::INFINITY, vec![0.0; terms(2)]);
        let alike = vec![1.0; terms(2) + 2];
        for _ in 0..DRAWS {
            let few: Vec<usize> = alike.iter().map(|_| draw()).collect();
            let Some(fit) = self.fitted(2, &few, &alike) else {
                continue;
            };
            let residual = |(value, basis): &(f64, Vec<f64>)| (value - sum(basis, &fit)).abs();
            let middle = median(judges.iter().map(residual));
            if middle < best.0 {
                best = (middle, fit);
            }
        }
        best.1
    }

    /// Tukey's weights of the cells about a fit.
    fn weights(&self, fit: &[f64], used: &[usize], level: f64) -> Vec<f64> {
        let off: Vec<f64> = used.iter().map(|&i| self.values[i] - value(fit, self.place(i))).collect();
        let scale = 1.4826 * median(off.iter().map(|r| r.abs()));
        let reach = TUKEY * scale.max(LEAST_SCALE * level);
        let weight = |r: &f64| (1.0 - (r / reach).powi(2)).max(0.0).powi(2);
        off.iter().map(weight).collect()
    }

    /// Least squares; `None` where the cells do not determine it.
    fn fitted(&self, degree: usize, used: &[usize], weights: &[f64]) -> Option<Vec<f64>> {
        let n = terms(degree);
        let mut matrix = vec![vec![0.0; n + 1]; n];
        for (&i, &weight) in used.iter().zip(weights).filter(|(_, w)| **w > 0.0) {
            let basis = basis(degree, self.place(i));
            for (row, a) in matrix.iter_mut().zip(&basis) {
                for (entry, b) in row.iter_mut().zip(&basis) {
                    *entry += weight * a * b;
                }
                row[n] += weight * a * self.values[i];
            }
        }
        let largest = matrix
            .iter()
            .map(|row| row[..row.len() - 1].iter().fold(0.0_f64, |m, v| m.max(v.abs())))
            .fold(0.0, f64::max);
        solved(&mut matrix, 1e-9 * largest)
    }

    /// Multiplies the light by what is left of the cells, smoothed.
    fn follow(&self, light: &mut [f64], used: &[usize], weights: &[f64]) {
        let mut sums = vec![[0.0; 2]; light.len()];
        for (&i, &weight) in used.iter().zip(weights) {
            sums[i] = [weight * (self.values[i] / light[i] - 1.0), weight];
        }
        for (step, end) in [(1, self.columns), (self.columns, self.rows)] {
            let before = sums.clone();
            let reach = (2.5 * LOCAL) as usize;
            for (i, sum) in sums.iter_mut().enumerate() {
                let at = i / step % end;
                *sum = [0.0; 2];
                for k in at.saturating_sub(reach)..(at + reach + 1).min(end) {
                    let g = (-0.5 * ((k as f64 - at as f64) / LOCAL).powi(2)).exp();
                    let from = before[i + k * step - at * step];
                    *sum = [sum[0] + g * from[0], sum[1] + g * from[1]];
                }
            }
        }
        for (level, [off, weight]) in light.iter_mut().zip(sums) {
            // Far from every cell that is used it stays as it is.
            *level *= 1.0 + off / (weight + 1.0);
        }
    }

    /// The light at a pixel, straight between the cells' middles.
    pub(crate) fn at(&self, light: &[f64], x: usize, y: usize) -> f64 {
        let along = |p: usize, n: usize| {
            let t = ((p as f64 + 0.5) / self.side as f64 - 0.5).clamp(0.0, (n - 1) as f64);
            let first = (t as usize).min(n.saturating_sub(2));
            (first, (first + 1).min(n - 1), t - first as f64)
        };
        let (left, right, u) = along(x, self.columns);
        let (up, down, v) = along(y, self.rows);
        let row = |r: usize| light[r * self.columns + left] * (1.0 - u) + light[r * self.columns + right] * u;
        row(up) * (1.0 - v) + row(down) * v
    }
}

/// Monomials up to a degree.
fn terms(degree: usize) -> usize {
    (degree + 1) * (degree + 2) / 2
}

fn basis(degree: usize, [x, y]: [f64; 2]) -> Vec<f64> {
    let mut all = Vec::with_capacity(terms(degree));
    for total in 0..=degree {
        for j in 0..=total {
            all.push(x.powi((total - j) as i32) * y.powi(j as i32));
        }
    }
    all
}

fn value(fit: &[f64], place: [f64; 2]) -> f64 {
    let degree = (0..).find(|&d| terms(d) >= fit.len()).unwrap_or(0);
    sum(&basis(degree, place), fit)
}

fn sum(basis: &[f64], fit: &[f64]) -> f64 {
    basis.iter().zip(fit).map(|(b, c)| b * c).sum()
}
