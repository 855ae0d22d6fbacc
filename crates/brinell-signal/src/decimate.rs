//! The low-pass of a decimation, which keeps one sample in several.
//!
//! The low-pass has a Kaiser window: passband to 0.4 of the output rate, stopband from 0.5, 80 dB. Everything above
//! half the output rate is therefore down by 80 dB before it can fold. The filter is J. F. Kaiser, "Nonrecursive
//! digital filter design using the I0-sinh window function", Proc. IEEE Int. Symp. Circuits and Systems (1974), 20-23.

use std::f64::consts::PI;

/// Input samples for each output sample of a simulation.
pub const FACTOR: usize = 8;
/// Upper edge of the passband as a fraction of the output rate.
pub const PASSBAND: f64 = 0.4;
/// Lower edge of the stopband as a fraction of the output rate.
pub const STOPBAND: f64 = 0.5;
/// Ripple in both bands, dB below the passband.
pub const ATTENUATION_DB: f64 = 80.0;

/// Modified Bessel function of the first kind and order zero, by its power series sum ((x/2)^k / k!)^2.
///
/// All terms are positive, so the sum is accurate to round-off; meant for |x| below about 30 (a Kaiser window for
/// 100 dB needs 10), beyond which it only takes longer.
pub(super) fn bessel_i0(x: f64) -> f64 {
    let quarter_square = 0.25 * x * x;
    let mut term = 1.0;
    let mut sum = 1.0;
    let mut k = 0.0;
    while term > sum * (0.25 * f64::EPSILON) {
        k += 1.0;
        term *= quarter_square / (k * k);
        sum += term;
    }
    sum
}

/// Taps of a linear-phase low-pass by the Kaiser window, odd in number, symmetric, with unit gain at zero frequency.
///
/// `passband` and `stopband` are edges in cycles per sample, `0 < passband < stopband <= 0.5`; the ripple in both is
/// `10^(-attenuation_db / 20)`. Kaiser's estimates beta = 0.1102 (A - 8.7) and order (A - 7.95) / (2.285 dw) hold
/// for A > 50 dB and are good to about 0.1 dB, so the window is designed half a decibel tighter than asked.
///
/// # Panics
/// Where the edges are out of order or range, or so close that it takes more than 2^24 taps, or `attenuation_db` is not
/// within 50 to 160.
pub fn kaiser_lowpass(passband: f64, stopband: f64, attenuation_db: f64) -> Vec<f64> {
    assert!(
        0.0 < passband && passband < stopband && stopband <= 0.5,
        "edges out of order: passband {passband}, stopband {stopband} cycles per sample"
    );
    assert!((50.0..=160.0).contains(&attenuation_db), "attenuation {attenuation_db} dB is outside 50 to 160 dB");
    let attenuation = attenuation_db + 0.5;
    let beta = 0.1102 * (attenuation - 8.7);
    let order = (attenuation - 7.95) / (2.285 * 2.0 * PI * (stopband - passband));
    let half = (0.5 * order).ceil() as usize;
    assert!(half <= 1 << 23, "edges too close: passband {passband}, stopband {stopband} cycles per sample");
    let cutoff = 0.5 * (passband + stopband);

    let mut taps = vec![0.0; 2 * half + 1];
    for m in 0..=half {
        let ratio = m as f64 / half as f64;
        let window = bessel_i0(beta * (1.0 - ratio * ratio).sqrt()) / bessel_i0(beta);
        let ideal = if m == 0 { 2.0 * cutoff } else { (2.0 * PI * cutoff * m as f64).sin() / (PI * m as f64) };
        taps[half - m] = ideal * window;
        taps[half + m] = ideal * window;
    }
    let sum: f64 = taps.iter().sum();
    taps.iter_mut().for_each(|tap| *tap /= sum);
    taps
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Zero-phase response at `f` cycles per input sample.
    fn response(taps: &[f64], f: f64) -> f64 {
        let half = (taps.len() / 2) as f64;
        taps.iter().enumerate().map(|(m, h)| h * (2.0 * PI * f * (m as f64 - half)).cos()).sum()
    }

    #[test]
    fn lit_bessel_i0() {
        // Abramowitz and Stegun, tables 9.8 and 9.11.
        for (x, value) in [(1.0, 1.266_065_877_752_008), (5.0, 27.239_871_823_604_44), (10.0, 2_815.716_628_466_254)] {
            assert!((bessel_i0(x) / value - 1.0).abs() < 1e-14, "I0({x}) = {}", bessel_i0(x));
        }
    }

    #[test]
    fn analytic_ripple_is_below_80_db_in_both_bands() {
        let taps = &kaiser_lowpass(PASSBAND / 8.0, STOPBAND / 8.0, ATTENUATION_DB);
        assert!((response(taps, 0.0) - 1.0).abs() < 1e-14);
        let (mut pass, mut stop): (f64, f64) = (0.0, 0.0);
        for i in 0..=20_000 {
            let f = 0.5 * i as f64 / 20_000.0;
            if f <= PASSBAND / 8.0 {
                pass = pass.max((response(taps, f) - 1.0).abs());
            } else if f >= STOPBAND / 8.0 {
                stop = stop.max(response(taps, f).abs());
            }
        }
        pass = pass.max((response(taps, PASSBAND / 8.0) - 1.0).abs());
        stop = stop.max(response(taps, STOPBAND / 8.0).abs());
        assert!(pass < 1e-4 && stop < 1e-4, "passband {pass:e}, stopband {stop:e}");
        // Not bought with needless length either.
        assert!(pass.max(stop) > 0.8e-4, "passband {pass:e}, stopband {stop:e}");
    }

    #[test]
    fn xval_scipy_firwin() {
        // SciPy 1.17.1: firwin(407, 0.1125, window=('kaiser', 0.1102 * 71.8)), beta as kaiser_lowpass takes it.
        let taps = kaiser_lowpass(0.05, 0.0625, 80.0);
        assert_eq!(taps.len(), 407);
        for (m, value) in [
            (0, 0.11249836130918815),
            (1, 0.1101609928309988),
            (8, 0.01222479844888883),
            (50, -0.004684614351990797),
            (203, 1.944917652611465e-06),
        ] {
            assert!((taps[203 + m] - value).abs() < 1e-15, "{m}");
            assert_eq!(taps[203 - m], taps[203 + m]);
        }
    }

    #[test]
    fn analytic_tap_count_is_kaisers() {
        // (A - 7.95) / (14.36 df) + 1 with A = 80 dB, df = 0.1 / 8 cycles per sample.
        let formula = (80.0 - 7.95) / (14.36 * 0.1 / 8.0) + 1.0;
        let count = kaiser_lowpass(PASSBAND / 8.0, STOPBAND / 8.0, ATTENUATION_DB).len() as f64;
        assert!((count - formula).abs() <= 6.0, "{count} taps, formula {formula}");
    }
}
