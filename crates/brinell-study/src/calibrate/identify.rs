//! What a Jacobian says of the keys: intervals, correlations, and the directions along which the targets do not change.
//!
//! Everything is in the unit cube, and residuals are in standard uncertainties. With J = U S V^T, the variance along
//! column i of V is 1/s_i^2 and the covariance V S^-2 V^T (linear least squares; Bates and Watts 1988, section 1.2).
//! Where the residuals are larger than their uncertainties explain, with f degrees of freedom left, the covariance is
//! multiplied by chi^2/f (Birge 1932), as the Particle Data Group does. Intervals are then 1.96 of these standard
//! deviations: at chi^2 = f they do not jump, as they would with Student's t, which is for uncertainties that are
//! known but for a factor.
//!
//! Differences of noisy runs give a Jacobian with noise in it, which on average adds its own square to each s^2. That
//! share is taken off: a direction that shows no more than noise has no information.

use brinell::signal::estimate::NORMAL;
use nalgebra::{DMatrix, DVector};

/// An interval that covers so much of a key's range says nothing.
#[doc(hidden)]
pub const MOST: f64 = 0.75;
/// A key that moves by less than this share of the key that moves most along a free direction is not free by it: the bounds of the other one limit both.
const LIMITED: f64 = 0.4;
/// Variance over a range where nothing is known but the bounds.
const UNIFORM: f64 = 1.0 / 12.0;
/// Information along a direction, relative to the largest, below which it is round-off.
const ROUND_OFF: f64 = 1e-10;

/// One direction of the unit cube.
#[derive(Debug, Clone, PartialEq)]
pub struct Direction {
    /// Of length 1, a number for each key, the largest positive.
    pub vector: Vec<f64>,
    /// Singular value: residuals, in standard uncertainties, for the whole range.
    pub singular_value: f64,
    /// What noise alone would show on average.
    pub noise: f64,
    /// Half the 95 % interval along it, in ranges; infinite where there is no information.
    pub half_width: f64,
}

impl Direction {
    /// Whether the data tell: no key is moved by most of its range within the interval.
    pub fn is_determined(&self) -> bool {
        let largest = self.vector.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        2.0 * self.half_width * largest < MOST
    }
}

/// What is known of the keys.
#[derive(Debug, Clone, PartialEq)]
pub struct Identified {
    /// From the best determined to the worst.
    pub directions: Vec<Direction>,
    /// Standard deviation of each key, in ranges; infinite where there is no information.
    pub deviations: Vec<f64>,
    /// Half the 95 % interval of each key, in ranges.
    pub half_widths: Vec<f64>,
    /// Correlation of the keys' estimates; directions without information count as very wide.
    pub correlation: DMatrix<f64>,
    /// Sum of squares of the residuals.
    pub chi_square: f64,
    /// Targets less keys.
    pub freedom: i64,
    /// What standard deviations were multiplied by, as the residuals are larger than their uncertainties explain; at
    /// least 1.
    pub inflation: f64,
    /// How much chi-square rises from the best point to the end of a key's 95 % interval, the other keys following,
    /// where targets depend linearly on keys.
    pub rise: f64,
    /// From the point to where linear least squares expects the least misfit, in ranges, along the directions that the
    /// data tell. Beyond a key's interval the search has not come to its end, or the targets are not linear there.
    pub step: Vec<f64>,
}

/// From the residuals at a point, the Jacobian there, and the noise of its columns: the standard deviation of a
/// column's length that noise causes (see `column_noise`).
#[doc(hidden)]
pub fn identify(residuals: &[f64], jacobian: &DMatrix<f64>, noise: &[f64]) -> Identified {
    let keys = jacobian.ncols();
    let chi_square: f64 = residuals.iter().map(|r| r * r).sum();
    let freedom = residuals.len() as i64 - keys as i64;
    let birge = match freedom {
        1.. => (chi_square / freedom as f64).sqrt().max(1.0),
        _ => 1.0,
    };
    let factor = NORMAL * birge;
    let information = directions(jacobian, residuals.len(), noise, factor);
    let largest = information.first().map_or(0.0, |i| i.0);
    let exact = covariance(&information, 0.0);
    let wide = covariance(&information, if largest > 0.0 { ROUND_OFF * largest } else { 1.0 });
    let deviation = |k: usize| match exact[(k, k)] {
        v if v.is_finite() => v.sqrt(),
        _ => f64::INFINITY,
    };
    Identified {
        deviations: (0..keys).map(|k| birge * deviation(k)).collect(),
        half_widths: (0..keys).map(|k| factor * deviation(k)).collect(),
        correlation: DMatrix::from_fn(keys, keys, |a, b| {
            let scale = (wide[(a, a)] * wide[(b, b)]).sqrt();
            if a == b || scale <= 0.0 {
                return f64::from(u8::from(a == b));
            }
            (wide[(a, b)] / scale).clamp(-1.0, 1.0)
        }),
        directions: information.into_iter().map(|i| i.1).collect(),
        chi_square,
        freedom,
        inflation: birge,
        rise: factor * factor,
        step: least_squares(jacobian, residuals),
    }
}

/// Where linear least squares expects the least misfit, from the point with these residuals. Directions with a
/// thousandth of the largest singular value stay as they are.
fn least_squares(jacobian: &DMatrix<f64>, residuals: &[f64]) -> Vec<f64> {
    let svd = jacobian.clone().svd(true, true);
    let least = 1e-3 * svd.singular_values.max();
    let step = svd.solve(&-DVector::from_column_slice(residuals), least);
    step.map_or_else(|_| vec![0.0; jacobian.ncols()], |step| step.iter().copied().collect())
}

/// Directions with what is known along each, from the best determined to the worst: the square of the singular value
/// less the noise's share. `factor` times a standard deviation is half an interval.
fn directions(jacobian: &DMatrix<f64>, residuals: usize, noise: &[f64], factor: f64) -> Vec<(f64, Direction)> {
    let keys = jacobian.ncols();
    // Rows of zeros, so that V is whole where there are fewer targets than keys.
    let tall = jacobian.clone().resize_vertically(residuals.max(keys), 0.0);
    let (values, vectors) = match tall.svd(false, true) {
        nalgebra::SVD { singular_values, v_t: Some(v_t), .. } => (singular_values, v_t),
        _ => (DVector::zeros(keys), DMatrix::identity(keys, keys)),
    };
    let mut information: Vec<(f64, Direction)> = (0..keys)
        .map(|i| {
            let mut vector: Vec<f64> = vectors.row(i).iter().copied().collect();
            let largest = vector.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()));
            if largest.is_some_and(|v| v < 0.0) {
                vector.iter_mut().for_each(|v| *v = -*v);
            }
            let noise2: f64 = vector.iter().zip(noise).map(|(v, c)| (v * c).powi(2)).sum();
            let known = (values[i] * values[i] - noise2).max(0.0);
            let direction = Direction { vector, singular_value: values[i], noise: noise2.sqrt(), half_width: 0.0 };
            (known, direction)
        })
        .collect();
    let largest = information.iter().map(|i| i.0).fold(0.0, f64::max);
    for (known, direction) in &mut information {
        if *known <= ROUND_OFF * largest {
            *known = 0.0;
        }
        direction.half_width = factor / known.sqrt();
    }
    information.sort_by(|a, b| b.0.total_cmp(&a.0));
    information
}

/// Covariance of the keys, where a direction has the information `least` at least.
fn covariance(information: &[(f64, Direction)], least: f64) -> DMatrix<f64> {
    let keys = information.len();
    DMatrix::from_fn(keys, keys, |a, b| {
        let part = |(known, d): &(f64, Direction)| {
            let product = d.vector[a] * d.vector[b];
            // What is not there at all does not become infinite.
            if product.abs() < 1e-8 {
                return 0.0;
            }
            let largest = d.vector.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            let is_limited = d.vector[a].abs().max(d.vector[b].abs()) < LIMITED * largest;
            product / known.max(if is_limited { largest * largest / UNIFORM } else { least })
        };
        information.iter().map(part).sum::<f64>()
    })
}

/// Standard deviation of a column's length from noise alone: `noise` is that of each residual in one run, `distance`
/// the length of the difference.
pub(crate) fn column_noise(noise: &[f64], distance: f64) -> f64 {
    let sum: f64 = noise.iter().map(|n| 2.0 * n * n).sum();
    sum.sqrt() / distance
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line through points with known uncertainties: the covariance of slope and intercept has a formula.
    #[test]
    fn analytic_a_straight_line_has_the_covariance_of_the_textbook() {
        let (x, sigma) = ([-1.0, 0.5, 2.0, 4.0, 7.0], 0.3);
        let jacobian = DMatrix::from_fn(5, 2, |row, column| if column == 0 { 1.0 / sigma } else { x[row] / sigma });
        let found = identify(&[0.1, -0.2, 0.3, 0.1, -0.3], &jacobian, &[0.0, 0.0]);
        let (n, sx): (f64, f64) = (5.0, x.iter().sum());
        let sxx: f64 = x.iter().map(|x| x * x).sum();
        let delta = n * sxx - sx * sx;
        let expected = [sigma * (sxx / delta).sqrt(), sigma * (n / delta).sqrt()];
        for (found, expected) in found.deviations.iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
        }
        let correlation = -sx / (n * sxx).sqrt();
        assert!((found.correlation[(0, 1)] - correlation).abs() < 1e-12);
        assert_eq!((found.freedom, found.inflation), (3, 1.0));
        let ratio = found.half_widths[0] / found.deviations[0];
        assert!((ratio - 1.96).abs() < 1e-3);
        // 95 % of chi-square with one degree of freedom.
        assert!((found.rise - 3.841_459).abs() < 1e-5);
    }

    #[test]
    fn analytic_residuals_that_are_too_large_widen_the_intervals() {
        let jacobian = DMatrix::from_fn(4, 1, |_, _| 10.0);
        let found = identify(&[2.0, -2.0, 2.0, -2.0], &jacobian, &[0.0]);
        // chi^2 = 16 with 3 degrees of freedom.
        let inflation = (16.0_f64 / 3.0).sqrt();
        assert!((found.inflation - inflation).abs() < 1e-12);
        assert!((found.half_widths[0] - 1.959_964 * inflation / 20.0).abs() < 1e-6);
    }

    #[test]
    fn prop_intervals_do_not_jump_where_residuals_begin_to_be_too_large() {
        let jacobian = DMatrix::from_fn(2, 1, |_, _| 10.0);
        let half = |r: f64| identify(&[r, -0.5], &jacobian, &[0.0]).half_widths[0];
        let one = 0.75_f64.sqrt();
        assert!((half(one + 1e-6) / half(one - 1e-6) - 1.0).abs() < 1e-5);
    }

    /// r depends on a + 2 b alone: 2 a - b is free, and c is determined.
    #[test]
    fn analytic_a_combination_that_nothing_depends_on_is_found() {
        let jacobian =
            DMatrix::from_row_slice(4, 3, &[10.0, 20.0, 0.0, -5.0, -10.0, 0.0, 0.0, 0.0, 40.0, 3.0, 6.0, 0.0]);
        let found = identify(&[0.0; 4], &jacobian, &[0.0; 3]);
        let free = &found.directions[2];
        assert!(!free.is_determined() && free.half_width.is_infinite());
        let length = 5.0_f64.sqrt();
        for (v, expected) in free.vector.iter().zip([2.0, -1.0, 0.0]) {
            assert!((v - expected / length).abs() < 1e-9, "{:?}", free.vector);
        }
        assert!(found.deviations[0].is_infinite() && found.deviations[1].is_infinite());
        assert!((found.deviations[2] - 1.0 / 40.0).abs() < 1e-12);
        assert!(found.correlation[(0, 1)] < -0.99999);
        assert!(found.correlation[(0, 2)].abs() < 1e-6);
        assert!(found.directions[0].is_determined() && found.directions[1].is_determined());
    }

    /// r depends on 10 a + 0.2 b: b, which is free within its range, moves a by a fiftieth of its range.
    #[test]
    fn analytic_a_free_key_moves_another_no_further_than_its_own_bounds() {
        let found = identify(&[0.0], &DMatrix::from_row_slice(1, 2, &[10.0, 0.2]), &[0.0; 2]);
        let expected = (0.01 + 0.02 * 0.02 / 12.0_f64).sqrt();
        assert!((found.deviations[0] / expected - 1.0).abs() < 1e-3, "{:?}", found.deviations);
        assert!(found.deviations[1].is_infinite());
    }

    #[test]
    fn analytic_fewer_targets_than_keys_leave_directions_free() {
        let jacobian = DMatrix::from_row_slice(1, 3, &[0.0, 30.0, 0.0]);
        let found = identify(&[0.5], &jacobian, &[0.0; 3]);
        assert!((found.deviations[1] - 1.0 / 30.0).abs() < 1e-12);
        assert!(found.deviations[0].is_infinite() && found.deviations[2].is_infinite());
        let free = found.directions.iter().filter(|d| !d.is_determined());
        assert_eq!((free.count(), found.freedom), (2, -2));
    }

    /// Noise in a difference adds its square to a singular value's; a direction that shows nothing else is free.
    #[test]
    fn analytic_noise_is_not_information() {
        let jacobian = DMatrix::from_row_slice(2, 2, &[50.0, 0.0, 0.0, 5.0]);
        let found = identify(&[0.0; 2], &jacobian, &[3.0, 5.0]);
        assert!((found.deviations[0] - 1.0 / (2500.0_f64 - 9.0).sqrt()).abs() < 1e-12);
        assert!(found.deviations[1].is_infinite());
        // Two runs with noise 0.1, 0.2 of a range apart.
        assert!((column_noise(&[0.1], 0.2) - 0.1 * 2.0_f64.sqrt() / 0.2).abs() < 1e-15);
    }
}
