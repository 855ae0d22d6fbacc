//! RMS velocity in three bands, as rolling bearings are accepted by.
//!
//! ISO 15242 (parts 2 to 4) measures the RMS vibration velocity of a bearing turned at a nominal speed, 1800 r/min for
//! most, in a low (50 to 300 Hz), a medium (300 to 1800 Hz) and a high band (1800 to 10000 Hz).
//!
//! Differences to a measurement by the standard: it is of the resting ring under the standard's axial or radial load and
//! its pick-up, none of which is this function's business; its band-pass filters have slopes within a prescribed mask,
//! here the edges are sharp. [`scaled`] moves the bands in proportion to the speed, which keeps each at the same orders
//! of rotation; whether the standard asks for that at speeds of its own choosing was not checked against its text.

use super::blocks::{Blocks, Estimate};
use super::envelope::Band;
use super::error::{SignalError, require};
use super::indicators::Indicator;
use super::integrate::velocities;
use super::lengths::fast_from;
use super::spectrum::FEWEST_SAMPLES;

/// The speed that [`NOMINAL`] belongs to, Hz: 1800 r/min.
pub const NOMINAL_SPEED: f64 = 30.0;

/// Low, medium and high band at 1800 r/min, Hz.
pub const NOMINAL: [Band; 3] = [
    Band {
        low: 50.0,
        high: 300.0,
    },
    Band {
        low: 300.0,
        high: 1800.0,
    },
    Band {
        low: 1800.0,
        high: 10_000.0,
    },
];

/// [`NOMINAL`] in proportion to the speed `shaft` (Hz).
pub fn scaled(shaft: f64) -> [Band; 3] {
    NOMINAL.map(|band| {
        let factor = shaft / NOMINAL_SPEED;
        Band::between(factor * band.low, factor * band.high)
    })
}

/// RMS velocity in a band.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BandVelocity {
    /// The band, Hz.
    pub band: Band,
    /// RMS velocity with its interval, in the acceleration's unit times s (m/s from m/s^2).
    pub rms: Estimate,
    /// Whether half the sampling rate cuts the band short: the value is then too small.
    pub cut_short: bool,
}

/// Low, medium and high band; `None` for one that lies above half the sampling rate altogether.
pub type VelocityBands = [Option<BandVelocity>; 3];

/// RMS velocity in `bands` of an acceleration `a` sampled at `fs` Hz, with 95 % intervals from blocks of `block` s (whole
/// revolutions, best). Bands are [`NOMINAL`] or [`scaled`].
///
/// # Errors
/// [`SignalError`] with fewer than 8 samples, samples that are not finite, a band that is empty or begins at 0, or a
/// block that is not longer than a sample.
pub fn velocity_bands(
    a: &[f64],
    fs: f64,
    bands: &[Band; 3],
    block: f64,
) -> Result<VelocityBands, SignalError> {
    let samples = block * fs;
    require(
        samples >= 1.0 && samples.is_finite(),
        "block (s)",
        block,
        "at least one sample",
    )?;
    let inside: Vec<usize> = (0..bands.len())
        .filter(|i| bands[*i].low < 0.5 * fs)
        .collect();
    let wanted: Vec<Band> = inside.iter().map(|i| bands[*i]).collect();
    let mut found = [None; 3];
    // Squares reach up to twice a band's highest frequency: with more steps than that little folds back to where a block's mean would see it.
    let count = |periods: usize| fast_from(5 * periods / 2).min(a.len()).max(FEWEST_SAMPLES);
    velocities(a, fs, &wanted, count, |place, velocity| {
        let band = wanted[place];
        let samples = samples * velocity.len() as f64 / a.len() as f64;
        let rms = Blocks::of(velocity, samples).estimate(Indicator::Rms);
        found[inside[place]] = rms.map(|rms| BandVelocity {
            band,
            rms,
            cut_short: band.high > 0.5 * fs,
        });
    })?;
    Ok(found)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

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
            assert!((band.rms.value / expected - 1.0).abs() < 1e-4);
            let interval = band.rms.interval.unwrap();
            for end in [interval.low, interval.high] {
                assert!((end / expected - 1.0).abs() < 1e-3);
            }
            assert!(!band.cut_short);
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
        assert_eq!(scaled(15.0)[1], Band::between(150.0, 900.0));
    }
}
