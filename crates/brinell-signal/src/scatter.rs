//! How far the mean of a correlated series may be trusted.
//!
//! The variance of the mean of n values of a stationary series is S / n, S being the sum of its autocovariances over
//! all lags: the spectral density at frequency zero. Blocks of one revolution are correlated, as cages, rollers and
//! whirl move at rates of their own, so S is not their variance: a slow wander makes it larger, a periodic exchange
//! between neighbours smaller.
//!
//! S is measured where it matters, by the slowest variation that the series itself shows, as the mean of the squares of
//! its first B cosines
//!
//! ```text
//! c_k = sqrt(2 / n) sum over i of z_i cos(pi k (i - 1/2) / n),   k = 1 ... B,
//! ```
//!
//! each of which has variance S where the spectrum is flat below B / (2 n) per value. The mean over its standard error
//! sqrt(S / n) then follows Student's t with B degrees of freedom (U. K. Mueller, "A theory of robust long-run variance
//! estimation", J. Econometrics 141, 2007; E. Lazarus, D. J. Lewis, J. H. Stock and M. W. Watson, "HAR inference:
//! recommendations for practice", J. Business and Economic Statistics 36, 2018). B is 4 (3 of 6 or 7 values):
//! correlation over up to n / 8 values is accounted for without a model of it, and the few degrees of freedom widen the
//! interval. With up to 8 cosines intervals would be a sixth narrower, and those of runs of 2 s too narrow by as much
//! (`examples/coverage.rs`): cages and whirl exchange energy over many revolutions. What is slower than the record
//! shows in none of its values, and in no interval.

use super::distribution::{f_tail, normal_quantile};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Fewest values whose scatter is estimated.
pub const FEWEST: usize = 6;
/// Cosines of an interval, of 8 values or more; of fewer, half as many as values.
const TERMS: usize = 4;
/// Cosines of a comparison of two parts of a record at most, a quarter as many as values: with 4 it would hardly ever
/// see a difference at a false-alarm probability of one in five hundred.
const MOST_TERMS: usize = 8;

/// Scatter of a mean.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scatter {
    /// Standard error of the mean, in the unit of the values.
    pub error: f64,
    /// Degrees of freedom that it was estimated with.
    pub freedom: u32,
}

impl Scatter {
    /// Half the width of the 95 % interval: Student's t times the standard error.
    pub fn half_width(&self) -> f64 {
        student_t_quantile(0.975, self.freedom) * self.error
    }
}

/// Scatter of the mean of a series of values at equal distances, in order; `None` of fewer than [`FEWEST`], or where
/// one is not finite.
pub fn scatter(series: &[f64]) -> Option<Scatter> {
    by_cosines(series, TERMS.min(series.len() / 2))
}

fn by_cosines(series: &[f64], terms: usize) -> Option<Scatter> {
    let n = series.len();
    if n < FEWEST {
        return None;
    }
    let sum: f64 = (1..=terms).map(|k| cosine(series, k).powi(2)).sum();
    let error = (sum / terms as f64 / n as f64).sqrt();
    error.is_finite().then_some(Scatter { error, freedom: terms as u32 })
}

/// c_k. Values are taken about the first, so that a constant has none.
fn cosine(series: &[f64], k: usize) -> f64 {
    let n = series.len();
    let step = std::f64::consts::PI * k as f64 / n as f64;
    let about = series[0];
    let terms = series.iter().enumerate();
    let sum: f64 = terms.map(|(i, z)| (z - about) * (step * (i as f64 + 0.5)).cos()).sum();
    (2.0 / n as f64).sqrt() * sum
}

/// Fraction of a series, at its beginning, that is compared with its last half.
const BEGINNING: f64 = 0.2;
/// False-alarm probability: a steady series is called drifting.
const FALSE_ALARM: f64 = 2e-3;

/// By how much the mean of the first fifth of a series lies above that of its last half, where that is more than its
/// scatter explains, or where the series has a trend: then it was not steady when it began. `None` where it is not, or
/// the series is too short to tell.
///
/// J. Geweke's comparison ("Evaluating the accuracy of sampling-based approaches", Bayesian Statistics 4, 1992), with
/// the scatter of the last half, autocorrelation included, and Student's t; and, because a trend that goes on inflates
/// that scatter, the trend of the whole. Each has a false-alarm probability of one in five hundred.
pub fn drift(series: &[f64]) -> Option<f64> {
    let n = series.len();
    let mean = |x: &[f64]| x.iter().sum::<f64>() / x.len() as f64;
    let first = &series[..((BEGINNING * n as f64) as usize).max(1).min(n)];
    let last = &series[n / 2..];
    let steady = by_cosines(last, (last.len() / 4).clamp(TERMS.min(last.len() / 2), MOST_TERMS))?;
    let difference = mean(first) - mean(last);
    let error = steady.error * (1.0 + last.len() as f64 / first.len() as f64).sqrt();
    let limit = student_t_quantile(1.0 - 0.5 * FALSE_ALARM, steady.freedom) * error;
    (difference.abs() > limit || has_trend(series)).then_some(difference)
}

/// Whether a series has a linear trend: its projection on the line, over the mean square of cosines of even order, all
/// of which have the variance S where it is steady. A line has none of the even cosines, so that a trend does not hide
/// in the scatter that it is held against.
fn has_trend(series: &[f64]) -> bool {
    let n = series.len();
    let terms = (n / 4).min(TERMS);
    if terms < 2 {
        return false;
    }
    let (about, middle) = (series[0], 0.5 * (n as f64 - 1.0));
    let places = series.iter().enumerate();
    let projection: f64 = places.map(|(i, z)| (z - about) * (i as f64 - middle)).sum();
    let length = (n as f64 * (n as f64 * n as f64 - 1.0) / 12.0).sqrt();
    let variance = (1..=terms).map(|k| cosine(series, 2 * k).powi(2)).sum::<f64>() / terms as f64;
    let limit = student_t_quantile(1.0 - 0.5 * FALSE_ALARM, terms as u32);
    (projection / length).abs() > limit * variance.sqrt()
}

/// The value that Student's t with `freedom` degrees of freedom stays below with probability `p`, to a relative 1e-10.
/// NaN where `freedom` is zero, or p is not between 0 and 1 or within 1e-100 of them.
pub fn student_t_quantile(p: f64, freedom: u32) -> f64 {
    let (tail, freedom) = (p.min(1.0 - p), f64::from(freedom));
    if !(tail >= 1e-100 && freedom > 0.0) {
        return f64::NAN;
    }
    let is_far = tail < FAR;
    let is_nearly_normal = freedom > if is_far { MANY_FAR } else { MANY };
    if is_far || is_nearly_normal {
        let above = if is_nearly_normal { nearly_normal(tail, freedom) } else { far_quantile(tail, freedom) };
        return if p < 0.5 { -above } else { above };
    }
    StudentsT::new(0.0, 1.0, freedom).map_or(f64::NAN, |t| t.inverse_cdf(p))
}

/// Degrees of freedom above which the expansion about the normal quantile is taken, and below [`FAR`]: incomplete beta
/// functions take ever longer, and at 1e6 the quantile of `statrs` is off by 6e-5.
const MANY: f64 = 1e4;
const MANY_FAR: f64 = 1e6;

/// The value that Student's t of many degrees of freedom exceeds with a probability up to 1/2: Abramowitz and Stegun 26.7.5 to
/// 1/freedom^2. The next term, about 3 z^6 / (384 freedom^3), is below 3e-11 of the value from [`MANY`] on, and below 1e-12 from
/// [`MANY_FAR`] on for a probability of 1e-100.
fn nearly_normal(tail: f64, freedom: f64) -> f64 {
    let z = -normal_quantile(tail);
    let z2 = z * z;
    z * (1.0 + (z2 + 1.0) / (4.0 * freedom) + ((5.0 * z2 + 16.0) * z2 + 3.0) / (96.0 * freedom * freedom))
}

/// Probability below which the quantile of `statrs` is off: by a factor of five at 1e-9.
const FAR: f64 = 1e-4;

/// The value that Student's t exceeds with a probability below [`FAR`]: its square has the F distribution. By bisection of
/// the logarithm.
fn far_quantile(tail: f64, freedom: f64) -> f64 {
    let (mut low, mut high) = (0.0, 512.0);
    for _ in 0..60 {
        let middle: f64 = 0.5 * (low + high);
        if f_tail((2.0 * middle).exp2(), 1.0, freedom) > 2.0 * tail { low = middle } else { high = middle }
    }
    low.exp2()
}

#[cfg(test)]
mod tests;
