//! Plans of Fourier transforms, and transforms of long signals. Here alone is the planner of real ones called: each
//! crate that called it would compile all of the transforms' code again, a third of a minute.

use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::Fft;
use std::ops::Range;
use std::sync::Arc;

/// The transform of `length` real samples to the positive frequencies.
pub fn forward(length: usize) -> Arc<dyn RealToComplex<f64>> {
    RealFftPlanner::new().plan_fft_forward(length)
}

/// The transform of the positive frequencies to `length` real samples, `length` times as large as those before
/// [`forward`].
pub fn inverse(length: usize) -> Arc<dyn ComplexToReal<f64>> {
    RealFftPlanner::new().plan_fft_inverse(length)
}

/// Bins 0 to N / 2 of the transform of `x`, which is lost; those that hold round-off alone are 0.
pub(crate) fn bins(x: &mut [f64]) -> Vec<Complex<f64>> {
    let plan = forward(x.len());
    let mut bins = plan.make_output_vec();
    plan.process(x, &mut bins).expect("buffers were made by the plan");
    let round_off = round_off(&bins);
    bins.iter_mut().filter(|bin| bin.norm_sqr() < round_off).for_each(|bin| *bin = Complex::ZERO);
    bins
}

/// Round-off in a bin over the root mean square of all, with room: more than 8 units in the last place of that were
/// seen, at lengths with large prime factors. What an offset 1e14 times as strong leaves of a signal goes with it.
const ROUND_OFF: f64 = 64.0 * f64::EPSILON;

/// Power of a transform's bin below which it may hold nothing but round-off. Of a constant, that is all there is but at
/// zero frequency, and it would have a kurtosis, an envelope and lines. 0 where squares are no numbers.
pub(crate) fn round_off(bins: &[Complex<f64>]) -> f64 {
    let power = bins.iter().map(Complex::norm_sqr).sum::<f64>() / bins.len() as f64;
    if power.is_normal() { ROUND_OFF * ROUND_OFF * power } else { 0.0 }
}

/// The complex signal that has the bins of `range` and no others, at the equal steps of a backward `plan`, as many
/// times as large. The bins are those of a transform of any length: with no more of them than steps, the values are the
/// signal's. `shape` gets the number of a bin and what is there.
pub(crate) fn backward(
    plan: &dyn Fft<f64>,
    bins: &[Complex<f64>],
    range: Range<usize>,
    values: &mut Vec<Complex<f64>>,
    shape: impl Fn(usize, Complex<f64>) -> Complex<f64>,
) {
    assert!(range.len() <= plan.len(), "more bins than values");
    values.clear();
    values.resize(plan.len(), Complex::ZERO);
    for k in range {
        values[k % plan.len()] = shape(k, bins[k]);
    }
    plan.process(values);
}

#[cfg(test)]
mod tests {
    use super::*;
    use rustfft::FftPlanner;
    use std::f64::consts::TAU;

    /// Fewer samples than there were, or more, are those of the same signal at other times.
    #[test]
    fn analytic_samples_at_other_times() {
        let bins: Vec<Complex<f64>> = (0..4000).map(|k| Complex::new((k % 7) as f64 - 3.0, (k % 5) as f64)).collect();
        let range = 1203..1297;
        for length in [97, 600, 6144] {
            let at = |n: usize| -> Complex<f64> {
                let angle = |k: usize| TAU * (k * n % length) as f64 / length as f64;
                (range.clone()).map(|k| bins[k] * Complex::from_polar(1.0, angle(k))).sum()
            };
            let (plan, mut values) = (FftPlanner::new().plan_fft_inverse(length), Vec::new());
            backward(&*plan, &bins, range.clone(), &mut values, |_, bin| bin);
            assert!(values.iter().enumerate().all(|(n, value)| (value - at(n)).norm() < 1e-10), "{length}");
        }
    }
}
