//! RMS velocity in three bands, as rolling bearings are accepted by.
//!
//! ISO 15242 (parts 2 to 4) measures the RMS vibration velocity of a bearing turned at a nominal speed, 1800 r/min for
//! most, in a low (50 to 300 Hz), a medium (300 to 1800 Hz) and a high band (1800 to 10000 Hz).
//!
//! Differences to a measurement by the standard: it is of the resting ring under the standard's axial or radial load
//! and its pick-up, none of which is this function's business; its band-pass filters have slopes within a prescribed
//! mask, here the edges are sharp.

use super::band::Band;
use super::blocks::Blocks;
use super::error::{SignalError, check_squares, require};
use super::estimate::Estimate;
use super::indicators::Indicator;
use super::integrate::{Motion, fade, velocity};
use super::lengths::fast_from;
use super::spectrum::FEWEST_SAMPLES;
use serde::Serialize;

/// Low, medium and high band at 1800 r/min, Hz.
pub const NOMINAL: [Band; 3] =
    [Band { low: 50.0, high: 300.0 }, Band { low: 300.0, high: 1800.0 }, Band { low: 1800.0, high: 10_000.0 }];

/// RMS velocity in a band.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BandVelocity {
    /// The band, Hz.
    #[serde(flatten)]
    pub band: Band,
    /// RMS velocity with its interval, in the acceleration's unit times s (m/s from m/s^2).
    #[serde(rename = "rms_m_per_s")]
    pub rms: Estimate,
    /// Whether half the sampling rate cuts the band short: the value is then too small.
    pub cut_short: bool,
}

/// Low, medium and high band; `None` for one that lies above half the sampling rate altogether.
pub type VelocityBands = [Option<BandVelocity>; 3];

/// RMS velocity in `bands` of an acceleration `a` sampled at `fs` Hz, with 95 % intervals from blocks of `block` s
/// (whole revolutions, best). Six periods of a band's lower edge at either end are left out, or a fifth of the signal: the
/// ends are faded, so that a strong line below a band is not in it, where the signal holds sixty periods of the edge.
///
/// # Errors
/// [`SignalError`] with fewer than 8 samples, samples that are not finite, a band that is empty or begins at 0, or a
/// block that is not longer than a sample.
pub fn velocity_bands(a: &[f64], fs: f64, bands: &[Band; 3], block: f64) -> Result<VelocityBands, SignalError> {
    let samples = block * fs;
    require(samples >= 1.0 && samples.is_finite(), "block (s)", block, "at least one sample")?;
    let mut found = [None; 3];
    for (found, band) in found.iter_mut().zip(bands).filter(|(_, band)| band.low < 0.5 * fs) {
        let mut faded = a.to_vec();
        let end = fade(&mut faded, fs, band.low);
        let v = velocity(&faded, fs, Motion::Acceleration, *band, |periods| steps(periods, a.len()))?;
        let ratio = v.len() as f64 / a.len() as f64;
        let rms = inner_rms(&v, ratio * end as f64, samples * ratio);
        *found = rms.map(|rms| BandVelocity { band: *band, rms, cut_short: band.high > 0.5 * fs });
    }
    Ok(found)
}

/// RMS velocity in one band of a signal sampled at `fs` Hz, with its 95 % interval from blocks of `block` s. A period
/// of the band's lower edge at either end is left out: it is disturbed where the signal's ends do not meet.
///
/// # Errors
/// [`SignalError`] with samples that are not finite, a band that is empty or begins at 0, a block that is not longer
/// than a sample, or fewer samples than three periods of the lower edge hold.
pub fn velocity_rms(x: &[f64], fs: f64, from: Motion, band: Band, block: f64) -> Result<Estimate, SignalError> {
    let seconds = x.len() as f64 / fs;
    require(seconds * band.low >= 3.0, "signal (s)", seconds, "at least three periods of the band's lower edge")?;
    require(block * fs >= 1.0 && block.is_finite(), "block (s)", block, "at least one sample")?;
    let v = velocity(x, fs, from, band, |periods| steps(periods, x.len()))?;
    // Not before samples that are not finite are found.
    check_squares(x)?;
    let rate = fs * v.len() as f64 / x.len() as f64;
    let found = inner_rms(&v, rate / band.low, block * rate);
    found.ok_or(SignalError::OutOfRange { name: "block (s)", value: block, range: "at most the signal's length" })
}

/// RMS without so many values at either end, from blocks of so many.
fn inner_rms(v: &[f64], end: f64, block: f64) -> Option<Estimate> {
    let end = end.ceil() as usize;
    let inner = v.get(end..v.len().saturating_sub(end)).unwrap_or_default();
    Blocks::of(inner, block).estimate(Indicator::Rms)
}

/// How often a velocity is taken. Its squares reach up to twice a band's highest frequency: with more steps than that
/// little folds back to where a block's mean would see it.
fn steps(periods: usize, samples: usize) -> usize {
    fast_from(5 * periods / 2).min(samples).max(FEWEST_SAMPLES)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::super::psd::{Segments, psd};
    use super::super::spectrogram::spectrogram;
    use super::super::test_signals::cosine;
    use super::*;

    #[test]
    fn analytic_one_sine_in_each_band() {
        let (fs, n) = (25_600.0, 51_200);
        let mut a = vec![0.0; n];
        let lines = [(120.0, 2.0), (900.0, 5.0), (6000.0, 30.0)];
        for (f, amplitude) in lines {
            let x = cosine(n, fs, f, amplitude, 0.3);
            a.iter_mut().zip(x).for_each(|(a, x)| *a += x);
        }
        let bands = velocity_bands(&a, fs, &NOMINAL, 1.0 / 30.0).unwrap();
        for (band, (f, amplitude)) in bands.iter().zip(lines) {
            let band = band.unwrap();
            let expected = amplitude / (TAU * f) / 2f64.sqrt();
            // The faded ends of a line are in the band in part, and reach a little into what is used.
            assert!((band.rms.value / expected - 1.0).abs() < 1e-3);
            let interval = band.rms.interval.unwrap();
            for end in [interval.low, interval.high] {
                assert!((end / expected - 1.0).abs() < 1e-3);
            }
            assert!(!band.cut_short);
        }
    }

    /// White noise of RMS sigma from 0 to fs / 2 has the velocity v with v^2 = 2 sigma^2 / fs / (2 pi)^2 (1 / low - 1 /
    /// high) between two frequencies, beside an unbalance 2000 times as fast whose ends do not meet.
    #[test]
    fn analytic_a_line_below_the_bands_is_in_none() {
        let (fs, n, sigma) = (25_600.0, 102_400, 0.03);
        let mut a = cosine(n, fs, 29.7, 3.0, 0.3);
        let noise = super::super::test_signals::Noise::new(5).normals(n);
        a.iter_mut().zip(noise).for_each(|(a, n)| *a += sigma * n);
        for found in velocity_bands(&a, fs, &NOMINAL, 1.0 / 30.0).unwrap() {
            let found = found.unwrap();
            let Band { low, high } = found.band;
            let expected = sigma * (2.0 / fs * (1.0 / low - 1.0 / high)).sqrt() / TAU;
            // The low band holds few independent values in 4 s: 2 B T = 2000, of unequal weight.
            assert!((found.rms.value / expected - 1.0).abs() < 0.1, "{low} Hz: {:e} for {expected:e}", found.rms.value);
        }
    }

    #[test]
    fn prop_bands_beyond_the_sampling_rate_are_none_or_marked() {
        let a = cosine(8000, 8000.0, 120.0, 1.0, 0.0);
        let bands = velocity_bands(&a, 8000.0, &NOMINAL, 0.1).unwrap();
        assert!(bands[2].unwrap().cut_short && !bands[1].unwrap().cut_short);
        let a = cosine(8000, 3000.0, 120.0, 1.0, 0.0);
        assert!(velocity_bands(&a, 3000.0, &NOMINAL, 0.1).unwrap()[2].is_none());
        assert!(velocity_bands(&a, 3000.0, &NOMINAL, 0.0).is_err());
        assert!(velocity_bands(&[], 3000.0, &NOMINAL, 0.1).is_err());
    }

    /// RMS velocity A / (2 pi f sqrt 2) of a sine of acceleration A, at frequencies whose periods do not fit the
    /// record.
    #[test]
    fn analytic_a_sine_of_known_acceleration_has_its_velocity() {
        let fs = 25_600.0;
        let band = Band::between(10.0, 1000.0);
        for (f, n) in [(24.7, 25_600), (49.83, 40_001), (160.3, 30_011), (811.7, 102_400)] {
            let a = cosine(n, fs, f, 9.80665, 0.3);
            let expected = 9.80665 / (TAU * f) / 2f64.sqrt();
            let of = |x: &[f64], from| velocity_rms(x, fs, from, band, 1.0 / f).unwrap().value / expected - 1.0;
            let off = of(&a, Motion::Acceleration);
            assert!(off.abs() < 0.01, "{f} Hz: {off:+.4}");
            let v = cosine(n, fs, f, 9.80665 / (TAU * f), 0.3);
            let off = of(&v, Motion::Velocity);
            assert!(off.abs() < 0.01, "{f} Hz as a velocity: {off:+.4}");
        }
    }

    /// What lies outside is not told: a tone above, whose ends do not meet, and a slow drift below.
    #[test]
    fn analytic_what_lies_outside_the_band_is_left_out() {
        let (fs, n) = (25_600.0, 30_011);
        let band = Band::between(10.0, 1000.0);
        let mut a = cosine(n, fs, 5003.3, 100.0, 0.3);
        let slow = cosine(n, fs, 0.3, 1.0, 1.0);
        a.iter_mut().zip(slow).for_each(|(a, s)| *a += s + 9.81);
        let found = velocity_rms(&a, fs, Motion::Acceleration, band, 0.04).unwrap();
        // The tone's own velocity is 2.2 mm/s, the drift's 375 mm/s.
        assert!(found.value < 1e-4, "{:e}", found.value);
    }

    #[test]
    fn prop_a_velocity_needs_periods_and_blocks() {
        let band = Band::between(10.0, 1000.0);
        let a = cosine(2000, 10_000.0, 100.0, 1.0, 0.0);
        let of = |x: &[f64], block| velocity_rms(x, 10_000.0, Motion::Acceleration, band, block);
        assert!(of(&a, 0.01).is_err());
        let a = cosine(4000, 10_000.0, 100.0, 1.0, 0.0);
        assert!(of(&a, 0.01).is_ok());
        assert!(of(&a, 0.0).is_err());
        assert!(of(&[f64::NAN; 4000], 0.01).is_err());
        // Its squares overflow, and the block is blameless; so do those of any spectrum.
        let told = of(&[1e300; 4000], 0.03).unwrap_err();
        assert!(
            told.to_string().starts_with("power of ten of the largest sample = 300 is outside its range"),
            "{told}"
        );
        let segments = Segments::of(512);
        assert_eq!(psd(&[1e300; 4000], 1e4, &segments), Err(told.clone()));
        assert_eq!(spectrogram(&[1e300; 4000], 1e4, &segments), Err(told));
        assert!(of(&[-9e139; 4000], 0.03).unwrap().value.is_finite());
        assert!(psd(&[9e139; 4000], 1e4, &segments).unwrap().density.iter().all(|d| d.is_finite()));
    }
}
