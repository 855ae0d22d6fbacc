//! Whitening: every line of a spectrum brought to one level, phases kept.
//!
//! The cepstrum pre-whitening of P. Borghesani, P. Pennacchi, R. B. Randall, N. Sawalhi, R. Ricci, Mech. Syst. Signal Process.
//! 36 (2013) 370-384: with the whole cepstrum but its zeroth value set to zero, a spectrum X becomes X / |X|. Tones of shaft, gears
//! and mains weigh no more than any bin of noise, and every resonance as much as the next; impacts, which fill many
//! bins with phases in step, remain.

use realfft::RealFftPlanner;
use realfft::num_complex::Complex;

use super::envelope::Band;
use super::error::{SignalError, check, require};
use super::spectrum::FEWEST_SAMPLES;

/// `x` (sampled at `fs` Hz) whitened within a band, and nothing outside it; unit RMS. Without zero frequency.
///
/// # Errors
/// [`SignalError`] with fewer than 8 samples, samples that are not finite, or a band out of range.
pub fn whitened(x: &[f64], fs: f64, band: Band) -> Result<Vec<f64>, SignalError> {
    check(x, fs, FEWEST_SAMPLES, "whitening")?;
    require(
        0.0 <= band.low && band.low < band.high && band.low < 0.5 * fs,
        "lower edge of the band (Hz)",
        band.low,
        "0 to below the upper edge and half the sampling rate",
    )?;
    const MADE: &str = "buffers were made by the plan";
    let n = x.len();
    let mut planner = RealFftPlanner::new();
    let forward = planner.plan_fft_forward(n);
    let inverse = planner.plan_fft_inverse(n);
    let mut spectrum = forward.make_output_vec();
    let mut values = x.to_vec();
    forward.process(&mut values, &mut spectrum).expect(MADE);
    let step = fs / n as f64;
    let mut bins = 0.0;
    let last = n.div_ceil(2);
    for (k, value) in spectrum.iter_mut().enumerate() {
        let frequency = k as f64 * step;
        let size = value.norm();
        let inside = k > 0 && k < last && frequency >= band.low && frequency <= band.high;
        if inside && size > 0.0 {
            *value /= size;
            bins += 1.0;
        } else {
            *value = Complex::new(0.0, 0.0);
        }
    }
    inverse.process(&mut spectrum, &mut values).expect(MADE);
    // Each bin of unit size carries a mean square of 2.
    let scale = 1.0 / (2.0 * f64::max(bins, 1.0)).sqrt();
    values.iter_mut().for_each(|v| *v *= scale);
    Ok(values)
}

#[cfg(test)]
mod tests {
    use super::super::test_signals::{Noise, cosine};
    use super::*;

    #[test]
    fn analytic_unit_rms_and_a_single_impulse_stays_one() {
        let fs = 10_000.0;
        let mut x = vec![0.0; 1000];
        x[300] = 5.0;
        let y = whitened(&x, fs, Band::above(0.0)).unwrap();
        let rms = (y.iter().map(|v| v * v).sum::<f64>() / 1000.0).sqrt();
        assert!((rms - 1.0).abs() < 1e-12, "{rms}");
        // 499 bins in phase: 2 * 499 / sqrt(2 * 499).
        assert!((y[300] - 998f64.sqrt()).abs() < 1e-9, "{}", y[300]);
    }

    #[test]
    fn prop_a_tone_weighs_no_more_than_noise() {
        let fs = 10_000.0;
        let n = 10_000;
        let mut x = Noise::new(3).normals(n);
        (x.iter_mut().zip(cosine(n, fs, 3000.0, 50.0, 0.0))).for_each(|(x, c)| *x += c);
        let y = whitened(&x, fs, Band::between(1000.0, 4000.0)).unwrap();
        let amplitude = |x: &[f64], f: f64| {
            let sum = |shift: f64| -> f64 {
                (x.iter().zip(cosine(n, fs, f, 1.0, shift)))
                    .map(|(a, b)| a * b)
                    .sum()
            };
            2.0 / n as f64 * sum(0.0).hypot(sum(std::f64::consts::FRAC_PI_2))
        };
        assert!(amplitude(&x, 3000.0) > 100.0 * amplitude(&x, 2500.0));
        let ratio = amplitude(&y, 3000.0) / amplitude(&y, 2500.0);
        assert!((ratio - 1.0).abs() < 1e-6, "{ratio}");
        assert!(amplitude(&y, 500.0) < 1e-9);
        assert!(whitened(&x, fs, Band::between(6000.0, 7000.0)).is_err());
        assert!(whitened(&[1.0; 4], fs, Band::above(0.0)).is_err());
    }
}
