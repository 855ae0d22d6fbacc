//! Acceleration to velocity.
//!
//! Integration divides a spectrum by i 2 pi f: noise and drift below the lowest frequency of interest grow without
//! bound and have to be cut off, and what is cut off is part of the result's meaning. ISO 13373-2 asks for the
//! high-pass frequency to be stated with the value.

use std::f64::consts::{PI, TAU};

use realfft::num_complex::Complex;
use rustfft::FftPlanner;

use super::band::{Band, bins, check_band};
use super::error::{SignalError, check, require};
use super::fft;
use super::psd::Detrend;

/// Periods of a band's lower edge over which an end is faded, and a share of the signal that it never exceeds.
const FADE: (f64, f64) = (5.0, 0.1);

/// What lies within a band of `x`, sampled at `fs` Hz, with the edges and ends of [`velocity`].
///
/// # Errors
/// As [`velocity`].
pub fn band_pass(x: &[f64], fs: f64, band: Band) -> Result<Vec<f64>, SignalError> {
    velocity(x, fs, Motion::Velocity, band, |_| x.len())
}

/// What a velocity is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Motion {
    /// An acceleration, integrated.
    Acceleration,
    /// A velocity, as it is.
    Velocity,
}

/// Takes the straight line of least squares out of `x`, sampled at `fs` Hz, and fades both ends to nothing by half a
/// cosine (a Tukey window), and tells how many samples at either end are not to be used of what lies above `low` Hz
/// then. A transform takes a signal as periodic: a strong line below the band whose ends do not meet would be a step
/// there, which is in every band.
pub(super) fn fade(x: &mut [f64], fs: f64, low: f64) -> usize {
    Detrend::Linear.apply(x);
    let count = x.len();
    let most = FADE.1 * count as f64;
    let faded = (FADE.0 * fs / low).min(most) as usize;
    for i in 0..faded {
        let share = 0.5 - 0.5 * (PI * (i as f64 + 0.5) / faded as f64).cos();
        x[i] *= share;
        x[count - 1 - i] *= share;
    }
    faded + (fs / low).min(most) as usize
}

/// Velocity of a motion `x` (unit/s^2 gives unit/s) sampled at `fs` Hz, of what lies within a band: the transform, of an
/// acceleration over i 2 pi f, without the bins outside. `Band::above(f)` is a high-pass at f. The values are at as many
/// equal steps over the whole as `count` makes of the number of periods of the band's highest frequency in `x`: as many
/// as it has bins, or more.
///
/// The lower edge must be above 0. The straight line of least squares is removed first; the edges are sharp and the
/// transform takes the signal as periodic, so a period of the lower edge at either end is disturbed. The gain inside
/// the band is that of ideal integration, without the error of a quadrature rule.
///
/// # Errors
/// [`SignalError`] with fewer than 8 samples, samples that are not finite, or a lower edge that is not above 0 and
/// below half the sampling rate and the upper edge, or a band between two bins.
#[doc(hidden)]
pub fn velocity(
    x: &[f64],
    fs: f64,
    from: Motion,
    band: Band,
    count: impl Fn(usize) -> usize,
) -> Result<Vec<f64>, SignalError> {
    check(x, fs, 8, "integration")?;
    require(band.low > 0.0, "lower edge of the band (Hz)", band.low, "above 0")?;
    check_band(fs, x.len(), band)?;
    let mut v = x.to_vec();
    Detrend::Linear.apply(&mut v);
    let spectrum = fft::bins(&mut v);
    // Twice the positive frequencies are the whole; half the sampling rate has no quadrature, and so no integral.
    let integral = |k: usize, bin: Complex<f64>| match from {
        Motion::Acceleration => Complex::new(bin.im, -bin.re) * (2.0 / (TAU * fs) / k as f64),
        Motion::Velocity => bin * (2.0 / x.len() as f64),
    };
    let (inside, mut values) = (bins(fs, x.len(), band), Vec::new());
    let plan = FftPlanner::new().plan_fft_inverse(count(inside.end));
    fft::backward(&*plan, &spectrum, inside, &mut values, integral);
    Ok(values.iter().map(|value| value.re).collect())
}

#[cfg(test)]
mod tests {
    use super::super::test_signals::cosine;
    use super::*;

    const FS: f64 = 5000.0;

    fn integrated(a: &[f64], band: Band) -> Result<Vec<f64>, SignalError> {
        velocity(a, FS, Motion::Acceleration, band, |_| a.len())
    }

    #[test]
    fn analytic_sine_integrates_to_a_quarter_turn() {
        // Whole periods: exact to round-off.
        let (f, n) = (125.0, 4000);
        let mut a = cosine(n, FS, f, 3.0, 0.2);
        let slow = cosine(n, FS, 5.0, 50.0, 0.0);
        a.iter_mut().zip(slow).for_each(|(a, s)| *a += s + 20.0);
        // Removing the slow sine's straight line leaks a little into the band.
        let v = integrated(&a, Band::above(50.0)).unwrap();
        let expected = cosine(n, FS, f, 3.0 / (TAU * f), 0.2 - 0.5 * PI);
        let worst = (200..3800).map(|i| (v[i] - expected[i]).abs()).fold(0.0, f64::max);
        assert!(worst < 3e-2 * 3.0 / (TAU * f), "{worst:e}");
    }

    #[test]
    fn prop_bands_add_up() {
        let a = super::super::test_signals::Noise::new(2).normals(999);
        let bands = [Band::between(10.0, 400.0), Band::between(400.1, 5000.0), Band::above(10.0)];
        let v = bands.map(|band| integrated(&a, band).unwrap());
        let worst = (0..999).map(|i| (v[0][i] + v[1][i] - v[2][i]).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-15);
    }

    #[test]
    fn prop_bad_input_is_an_error() {
        assert!(integrated(&[1.0; 7], Band::above(1.0)).is_err());
        assert!(integrated(&[1.0; 70], Band::above(0.0)).is_err());
        assert!(integrated(&[1.0; 70], Band::above(2500.0)).is_err());
        assert!(integrated(&[f64::NAN; 70], Band::above(10.0)).is_err());
        let v = integrated(&[1.0; 70], Band::above(100.0)).unwrap();
        assert!(v.iter().all(|v| v.abs() < 1e-15));
    }
}
