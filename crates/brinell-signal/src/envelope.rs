//! The envelope and its spectrum: what repeats in a resonance.
//!
//! Impacts ring resonances far above their own rate; the envelope of such a band carries the rate and its harmonics.
//! R. B. Randall and J. Antoni, "Rolling element bearing diagnostics - a tutorial", Mech. Syst. Signal Process. 25
//! (2011) 485-520, section 5. A segment is transformed, the bins outside the band are removed, and the envelope is
//! the modulus of the analytic signal, `sqrt(x^2 + H[x]^2)`.
//!
//! The band's edges are sharp and the transform treats a segment as periodic, so the first and last few periods of
//! the band's lower edge are disturbed where a segment's ends do not meet; the Hann window of the spectrum hides them.

use super::band::{Band, check_band};
use super::error::{SignalError, check};
use super::psd::{Detrend, Segments, psd};
use super::spectrum::{FEWEST_SAMPLES, Spectrum};
use super::transformed::Transformed;

/// The envelope of `x` (sampled at `fs` Hz) in a band, sample by sample and in its unit. Its ends are disturbed (see the
/// module); holds the whole transform in memory.
///
/// # Errors
/// [`SignalError`] with fewer than [`FEWEST_SAMPLES`] samples, samples that are not finite, or a band out of range or
/// between two bins.
pub fn envelope(x: &[f64], fs: f64, band: Band) -> Result<Vec<f64>, SignalError> {
    check(x, fs, FEWEST_SAMPLES, "an envelope")?;
    check_band(fs, x.len(), band)?;
    Ok(Transformed::unchecked(x, fs).envelope(band, x.len()).values)
}

/// An averaged envelope spectrum.
#[derive(Debug, Clone, PartialEq)]
pub struct EnvelopeSpectrum {
    /// Spectrum of the envelope less its mean: peak amplitudes in the signal's unit.
    pub spectrum: Spectrum,
    /// Mean of the envelope, in the signal's unit: a line's amplitude over it is the depth of modulation.
    pub mean: f64,
}

/// Envelope spectrum of the slice `x`, sampled at `fs` Hz: demodulated as a whole, the envelope's mean removed, then
/// [`psd`]. Give one segment of the signal's length for the finest lines, several for a smoother noise floor.
///
/// # Errors
/// [`SignalError`] with fewer than 8 samples, samples that are not finite, or a band or segments out of range.
pub fn envelope_spectrum(x: &[f64], fs: f64, band: Band, segments: &Segments) -> Result<EnvelopeSpectrum, SignalError> {
    let mut envelope = envelope(x, fs, band)?;
    let mean = envelope.iter().sum::<f64>() / envelope.len() as f64;
    envelope.iter_mut().for_each(|e| *e -= mean);
    let segments = Segments {
        detrend: match segments.detrend {
            Detrend::None => Detrend::Mean,
            other => other,
        },
        ..*segments
    };
    Ok(EnvelopeSpectrum { spectrum: psd(&envelope, fs, &segments)?, mean })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::super::StreamSpectra;
    use super::super::spectrum::peak_near;
    use super::super::test_signals::{ImpactTrain, cosine};
    use super::*;

    const FS: f64 = 25_600.0;

    fn envelope_spectrum(x: &[f64], length: usize, band: Band) -> EnvelopeSpectrum {
        let spectra = StreamSpectra::of(x, FS, length, band, &[]);
        spectra.envelope.unwrap()
    }

    /// 2 (1 + depth cos 2 pi f t) cos 2 pi 6000.3 t.
    fn modulated(n: usize, f: f64, depth: f64) -> Vec<f64> {
        let carrier = cosine(n, FS, 6000.3, 2.0, 0.2);
        carrier.iter().enumerate().map(|(i, c)| c * (1.0 + depth * (TAU * f * i as f64 / FS).cos())).collect()
    }

    #[test]
    fn analytic_modulation_frequency_and_depth() {
        // A slow component fifty times as strong lies outside the band.
        let mut x = modulated(40_000, 87.3, 0.4);
        x.iter_mut().zip(cosine(40_000, FS, 33.0, 100.0, 0.0)).for_each(|(x, slow)| *x += slow);
        for band in [Band::between(5000.0, 7000.0), Band::above(4000.0)] {
            let result = envelope_spectrum(&x, 8192, band);
            let line = peak_near(&result.spectrum, 87.0, 10.0).unwrap();
            assert!((line.frequency - 87.3).abs() < 0.01, "{line:?}");
            assert!((line.amplitude / result.mean / 0.4 - 1.0).abs() < 2e-3, "{line:?} {}", result.mean);
            assert!((result.mean / 2.0 - 1.0).abs() < 1e-3, "{}", result.mean);
            assert!(result.spectrum.amplitude[0] < 1e-12);
            let strongest = result.spectrum.amplitude.iter().fold(0.0, |m: f64, a| m.max(*a));
            assert!(strongest <= line.amplitude, "nothing is present above the modulation");
        }
    }

    #[test]
    fn analytic_envelope_of_a_periodic_segment_is_exact() {
        // 25.6 kHz / 1024 = 25 Hz: carrier and modulation on bins, so the segment's ends meet.
        let x: Vec<f64> = (0..1024)
            .map(|i| {
                let t = i as f64 / FS;
                (1.0 + 0.5 * (TAU * 100.0 * t).sin()) * (TAU * 5000.0 * t).cos()
            })
            .collect();
        let result = envelope(&x, FS, Band::between(4900.0, 5100.0)).unwrap();
        for (i, e) in result.iter().enumerate() {
            let expected = 1.0 + 0.5 * (TAU * 100.0 * i as f64 / FS).sin();
            assert!((e - expected).abs() < 1e-12, "{i}: {e} {expected}");
        }
        // With the upper sideband cut off the lower remains:
        let cut = envelope(&x, FS, Band::between(4900.0, 5099.0)).unwrap();
        // -(m/2) sin(w_c - w_m) = Re[(m/2) i e^(-i w_m t) e^(i w_c t)].
        let lower = |i: usize| {
            let phase = TAU * 100.0 * i as f64 / FS;
            (1.0 + 0.25 * phase.sin()).hypot(0.25 * phase.cos())
        };
        assert!(cut.iter().enumerate().all(|(i, e)| (e - lower(i)).abs() < 1e-12));
    }

    #[test]
    fn analytic_impulse_train_shows_its_rate_and_harmonics() {
        let train = ImpactTrain { fs: FS, rate: 99.7, jitter: 0.0, resonance: 6000.0, decay: 2e-3, noise: 0.0 };
        let result = envelope_spectrum(&train.generate(100_000, 1), 16_384, Band::above(2000.0));
        let fundamental = peak_near(&result.spectrum, 100.0, 20.0).unwrap();
        for h in 1..=4 {
            let order = f64::from(h);
            let line = peak_near(&result.spectrum, 100.0 * order, 20.0).unwrap();
            assert!((line.frequency - 99.7 * order).abs() < 0.02, "{h}: {line:?}");
            // Envelope exp(-t/tau) repeated: amplitudes fall as 1 / sqrt(1 + (2 pi h f tau)^2). The sharp onset is
            // not narrow-band, so the analytic signal rounds it: 2.6 % at the fourth harmonic.
            let expected = ((1.0 + (TAU * 99.7 * 2e-3).powi(2)) / (1.0 + (TAU * 99.7 * order * 2e-3).powi(2))).sqrt();
            let ratio = line.amplitude / fundamental.amplitude;
            assert!((ratio / expected - 1.0).abs() < 0.03, "{h}: {ratio} {expected}");
        }
        // Nothing half way between them.
        let between = peak_near(&result.spectrum, 150.0, 20.0).map_or(0.0, |p| p.amplitude);
        assert!(between < 1e-2 * fundamental.amplitude, "{between}");
    }

    #[test]
    fn prop_sizes_whose_squares_are_no_numbers() {
        let x = modulated(2000, 90.0, 0.4);
        let band = Band::between(5000.0, 7000.0);
        let expected = envelope(&x, FS, band).unwrap();
        for size in [1e-200, 1e200] {
            let scaled: Vec<f64> = x.iter().map(|v| size * v).collect();
            let found = envelope(&scaled, FS, band).unwrap();
            for (a, b) in found.iter().zip(&expected) {
                assert!((a / size / b - 1.0).abs() < 1e-12);
            }
        }
        assert_eq!(envelope(&[0.0; 100], FS, band).unwrap(), [0.0; 100]);
    }

    #[test]
    fn prop_mean_and_half_the_sample_rate_are_in_no_envelope() {
        let x = modulated(512, 90.0, 0.4);
        let more: Vec<f64> =
            (x.iter().enumerate()).map(|(i, v)| v + 3.0 + if i % 2 == 0 { 1.0 } else { -1.0 }).collect();
        let [expected, found] = [x, more].map(|x| envelope(&x, FS, Band::above(0.0)).unwrap());
        assert!(found.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-12));
    }

    #[test]
    fn prop_short_run_is_one_segment_of_its_own_length() {
        let x = modulated(3001, 200.0, 0.3);
        let result = envelope_spectrum(&x, 4096, Band::above(1000.0));
        assert_eq!((result.spectrum.segment_length, result.spectrum.segments), (3001, 1));
        let line = peak_near(&result.spectrum, 200.0, 20.0).unwrap();
        assert!((line.frequency - 200.0).abs() < 0.1 && (line.amplitude - 0.6).abs() < 0.01, "{line:?}");
    }

    #[test]
    fn prop_an_envelope_that_cannot_be_is_an_error() {
        let x = modulated(512, 90.0, 0.4);
        for (low, high) in [(-1.0, 5000.0), (5000.0, 5000.0), (f64::NAN, 5000.0), (12_800.0, 13_000.0)] {
            let band = Band { low, high };
            assert!(matches!(envelope(&x, FS, band), Err(SignalError::OutOfRange { .. })), "{low} to {high}");
        }
        assert_eq!(envelope(&[f64::NAN; 100], FS, Band::above(0.0)), Err(SignalError::NotFinite { index: 0 }));
        assert!(envelope(&x[..7], FS, Band::above(0.0)).is_err());
    }

    #[test]
    #[should_panic(expected = "band from 13000 to inf Hz")]
    fn prop_band_above_half_the_rate_is_refused() {
        StreamSpectra::new(FS, 1024, Band::above(13_000.0), &[]);
    }

    #[test]
    fn prop_a_band_between_two_bins_is_refused() {
        let x = cosine(12_000, 12_000.0, 440.0, 1.0, 0.0);
        for band in [Band::between(437.1, 437.9), Band::between(5999.5, 6000.0)] {
            let error = envelope(&x, 12_000.0, band).unwrap_err().to_string();
            assert!(error.contains("a bin of the transform within the band"), "{error}");
        }
        assert!(envelope(&x, 12_000.0, Band::between(437.1, 438.0)).is_ok());
    }

    #[test]
    fn prop_a_constant_has_no_envelope() {
        let x = vec![0.1; 24_000];
        assert!(envelope(&x, 12_000.0, Band::between(1000.0, 3000.0)).unwrap().iter().all(|e| *e == 0.0));
    }
}
