//! FIR filters of linear phase, designed by windowing and applied without delay.
//!
//! A. V. Oppenheim and R. W. Schafer, "Discrete-time signal processing", 3rd ed. (2010), section 7.5: the ideal
//! filter's impulse response, cut off by a window. For a Kaiser window of given attenuation see
//! [`kaiser_lowpass`](super::kaiser_lowpass).

use std::f64::consts::PI;

use super::error::{SignalError, check, require};
use super::filter::{Passband, extend_oddly};
use super::window::Window;

/// Taps of a linear-phase filter, odd in number and symmetric, for samples at `fs` Hz.
///
/// The gain is 1 at zero frequency (low-pass), half the sampling rate (high-pass) or the band's middle, and about 1/2
/// at an edge. Between pass and stop band lie about `4 fs / taps` Hz with Hann; the stop band is then down by 44 dB.
///
/// # Errors
/// [`SignalError::OutOfRange`] where an edge is out of range or `taps` is even or below 3.
pub fn fir(taps: usize, pass: Passband, window: Window, fs: f64) -> Result<Vec<f64>, SignalError> {
    require(taps >= 3 && taps % 2 == 1, "number of taps", taps as f64, "odd, 3 or more")?;
    require(fs > 0.0 && fs.is_finite(), "sample rate (Hz)", fs, "above 0")?;
    let edges = pass.edges(fs)?;
    let (low, high, center) = match pass {
        Passband::Below(_) => (0.0, edges[0], 0.0),
        Passband::Above(_) => (edges[0], 0.5, 0.5),
        Passband::Between(_) => (edges[0], edges[1], 0.5 * (edges[0] + edges[1])),
    };
    let half = (taps / 2) as f64;
    let ideal = |cutoff: f64, m: f64| {
        if m == 0.0 { 2.0 * cutoff } else { (2.0 * PI * cutoff * m).sin() / (PI * m) }
    };
    let mut h = window.symmetric(taps);
    let mut gain = 0.0;
    for (i, h) in h.iter_mut().enumerate() {
        let m = i as f64 - half;
        *h *= ideal(high, m) - ideal(low, m);
        gain += *h * (2.0 * PI * center * m).cos();
    }
    require(gain > 0.0, "number of taps", taps as f64, "enough for the band's width")?;
    h.iter_mut().for_each(|h| *h /= gain);
    Ok(h)
}

/// `x` through a filter of symmetric `taps`, its delay removed: as many samples as came in.
///
/// The ends are extended by the signal turned about its end point, as in
/// [`Butterworth::zero_phase`](super::Butterworth::zero_phase). Costs `taps` multiplications a sample.
///
/// # Errors
/// [`SignalError::TooShort`] with fewer samples than taps, [`SignalError::NotFinite`], [`SignalError::OutOfRange`]
/// where the taps are even in number.
pub fn convolve(x: &[f64], taps: &[f64]) -> Result<Vec<f64>, SignalError> {
    require(taps.len() % 2 == 1, "number of taps", taps.len() as f64, "odd")?;
    check(x, 1.0, taps.len(), "a filter of this length")?;
    let extended = extend_oddly(x, taps.len() / 2);
    Ok(strided(&extended, taps, 1))
}

/// Inner products of symmetric `taps` with every `step`-th window of `x`.
pub(super) fn strided(x: &[f64], taps: &[f64], step: usize) -> Vec<f64> {
    const LANES: usize = 8;
    x.windows(taps.len())
        .step_by(step)
        .map(|window| {
            let mut sums = [0.0; LANES];
            let (w, t) = (window.chunks_exact(LANES), taps.chunks_exact(LANES));
            let rest: f64 = (w.remainder().iter().zip(t.remainder())).map(|(x, h)| x * h).sum();
            for (x, h) in w.zip(t) {
                for lane in 0..LANES {
                    sums[lane] += x[lane] * h[lane];
                }
            }
            sums.iter().sum::<f64>() + rest
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::envelope::Band;
    use super::super::test_signals::{Noise, cosine};
    use super::*;

    const FS: f64 = 1000.0;

    #[test]
    fn analytic_sine_passes_or_stops_without_delay() {
        let x = cosine(2000, FS, 100.0, 1.0, 0.7);
        for (pass, gain) in [
            (Passband::Below(150.0), 1.0),
            (Passband::Below(50.0), 0.0),
            (Passband::Above(50.0), 1.0),
            (Passband::Above(150.0), 0.0),
            (Passband::Between(Band::between(60.0, 140.0)), 1.0),
            (Passband::Between(Band::between(160.0, 240.0)), 0.0),
            (Passband::Below(100.0), 0.5),
        ] {
            let taps = fir(201, pass, Window::Hann, FS).unwrap();
            let y = convolve(&x, &taps).unwrap();
            assert_eq!(y.len(), x.len());
            let worst = (200..1800).map(|i| (y[i] - gain * x[i]).abs()).fold(0.0, f64::max);
            assert!(worst < 6e-3, "{pass:?} {worst:e}");
        }
    }

    #[test]
    fn prop_time_reversal() {
        let x = Noise::new(4).normals(500);
        let reversed: Vec<f64> = x.iter().rev().copied().collect();
        let taps = fir(51, Passband::Below(100.0), Window::Hamming, FS).unwrap();
        let y = convolve(&x, &taps).unwrap();
        let z = convolve(&reversed, &taps).unwrap();
        let worst = (0..500).map(|i| (y[i] - z[499 - i]).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-14, "{worst:e}");
    }

    #[test]
    fn prop_bad_input_is_an_error() {
        assert!(fir(10, Passband::Below(100.0), Window::Hann, FS).is_err());
        assert!(fir(11, Passband::Below(600.0), Window::Hann, FS).is_err());
        assert!(convolve(&[1.0; 5], &[0.2; 7]).is_err());
        assert!(convolve(&[1.0; 5], &[]).is_err());
        assert!(convolve(&[f64::INFINITY; 9], &[0.2; 3]).is_err());
    }
}
