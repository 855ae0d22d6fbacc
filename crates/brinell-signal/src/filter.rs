//! Butterworth filters as second-order sections, applied once or forwards and backwards.
//!
//! The analogue prototype's poles lie on the unit circle's left half; they are scaled (low-pass), inverted (high-pass)
//! or split (band-pass), and mapped by the bilinear transform with the edges pre-warped, so the digital gain at an edge
//! is 1 / sqrt 2 exactly: A. V. Oppenheim and R. W. Schafer, "Discrete-time signal processing", 3rd ed. (2010), section
//! 7.3. Forwards and backwards the phase is zero and the gain squared: 1/2 (-6.02 dB) at an edge.

use std::f64::consts::PI;

use realfft::num_complex::Complex;

use super::envelope::Band;
use super::error::{SignalError, check, require};

/// What a filter lets through; edges in Hz.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Passband {
    /// Below an edge.
    Below(f64),
    /// Above an edge.
    Above(f64),
    /// Between two edges.
    Between(Band),
}

impl Passband {
    /// Its edges in cycles per sample, one or two, if they lie in order strictly within 0 and half the sampling rate.
    pub(super) fn edges(self, fs: f64) -> Result<Vec<f64>, SignalError> {
        let hertz = match self {
            Passband::Below(f) | Passband::Above(f) => vec![f],
            Passband::Between(band) => vec![band.low, band.high],
        };
        for f in &hertz {
            require(*f > 0.0 && *f < 0.5 * fs, "filter edge (Hz)", *f, "above 0 and below half the sampling rate")?;
        }
        let last = hertz[hertz.len() - 1];
        require(hertz.len() == 1 || hertz[0] < last, "upper filter edge (Hz)", last, "above the lower edge")?;
        Ok(hertz.iter().map(|f| f / fs).collect())
    }
}

/// One second-order section, `(b0 + b1 z^-1 + b2 z^-2) / (1 + a1 z^-1 + a2 z^-2)`; of first order where b2 = a2 = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// b0, b1, b2.
    pub b: [f64; 3],
    /// a1, a2.
    pub a: [f64; 2],
}

impl Section {
    /// With the poles of `denominator`, a numerator's shape, and unit gain at z = e^(i `at`).
    fn normalised(shape: [f64; 3], a: [f64; 2], at: f64) -> Self {
        let section = Section { b: shape, a };
        let gain = section.response(at).norm();
        Section { b: shape.map(|b| b / gain), a }
    }

    /// Its response at z = e^(i `angle`), the angle in radians a sample.
    pub fn response(&self, angle: f64) -> Complex<f64> {
        let z = Complex::from_polar(1.0, -angle);
        let [b0, b1, b2] = self.b;
        let [a1, a2] = self.a;
        (b0 + z * (b1 + z * b2)) / (1.0 + z * (a1 + z * a2))
    }
}

/// Highest order that [`Butterworth::new`] takes.
pub const HIGHEST_ORDER: usize = 24;

/// A Butterworth filter.
#[derive(Debug, Clone, PartialEq)]
pub struct Butterworth {
    fs: f64,
    sections: Vec<Section>,
}

impl Butterworth {
    /// Of `order` 1 to [`HIGHEST_ORDER`], for samples at `fs` Hz. A band-pass has `order` poles at each edge, 2 `order`
    /// in all.
    ///
    /// # Errors
    /// [`SignalError::OutOfRange`] where the order or an edge is out of range.
    pub fn new(order: usize, pass: Passband, fs: f64) -> Result<Self, SignalError> {
        require((1..=HIGHEST_ORDER).contains(&order), "filter order", order as f64, "1 to 24")?;
        require(fs > 0.0 && fs.is_finite(), "sample rate (Hz)", fs, "above 0")?;
        let warped: Vec<f64> = pass.edges(fs)?.iter().map(|f| (PI * f).tan()).collect();
        // Upper half of the prototype's poles; the real one of an odd order comes last.
        let poles = (0..order.div_ceil(2)).map(|i| {
            let angle = PI * (2 * i + order + 1) as f64 / (2 * order) as f64;
            if 2 * i + 1 == order { Complex::new(-1.0, 0.0) } else { Complex::from_polar(1.0, angle) }
        });
        let mut sections = Vec::new();
        for p in poles {
            let real = p.im == 0.0;
            match pass {
                Passband::Below(_) => sections.push(edge_section(p * warped[0], real, 1.0)),
                Passband::Above(_) => sections.push(edge_section(warped[0] / p, real, -1.0)),
                Passband::Between(_) => {
                    let (half_width, center2) = (0.5 * (warped[1] - warped[0]), warped[0] * warped[1]);
                    let center = 2.0 * center2.sqrt().atan();
                    let mid = p * half_width;
                    let root = (mid * mid - center2).sqrt();
                    let (s1, s2) = (mid + root, mid - root);
                    let pairs = if real { vec![(s1, s2)] } else { vec![(s1, s1.conj()), (s2, s2.conj())] };
                    sections.extend(pairs.into_iter().map(|(s, t)| {
                        let (z, y) = (bilinear(s), bilinear(t));
                        let a = [-(z + y).re, (z * y).re];
                        Section::normalised([1.0, 0.0, -1.0], a, center)
                    }));
                }
            }
        }
        Ok(Butterworth { fs, sections })
    }

    /// Its sections, in the order of application.
    pub fn sections(&self) -> &[Section] {
        &self.sections
    }

    /// Gain of one application at `frequency` Hz.
    pub fn gain(&self, frequency: f64) -> f64 {
        let angle = 2.0 * PI * frequency / self.fs;
        (self.sections.iter()).map(|s| s.response(angle).norm()).product()
    }

    /// The filtered signal, from rest: causal, with the filter's delay.
    ///
    /// # Errors
    /// [`SignalError::NotFinite`].
    pub fn once(&self, x: &[f64]) -> Result<Vec<f64>, SignalError> {
        check(x, self.fs, 0, "a filter")?;
        let mut y = x.to_vec();
        self.run(&mut y, 0.0);
        Ok(y)
    }

    /// Samples by which [`zero_phase`](Self::zero_phase) extends the signal at each end; it needs one more than that.
    pub fn extension(&self) -> usize {
        let first_order = self.sections.iter().filter(|s| s.b[2] == 0.0 && s.a[1] == 0.0);
        3 * (2 * self.sections.len() + 1 - first_order.count())
    }

    /// The signal filtered forwards and backwards: no delay, and the square of [`gain`](Self::gain).
    ///
    /// Both ends are extended by the signal turned about its end point (odd extension) and the filter starts settled on
    /// the first value, as in F. Gustafsson, "Determining the initial states in forward-backward filtering", IEEE
    /// Trans. Signal Process. 44 (1996) 988-992, and SciPy's `sosfiltfilt`. The filter's own transient is longer than
    /// the extension where an edge is below about a fiftieth of the sampling rate: distrust a few periods of the lowest
    /// edge.
    ///
    /// # Errors
    /// [`SignalError::TooShort`], [`SignalError::NotFinite`].
    pub fn zero_phase(&self, x: &[f64]) -> Result<Vec<f64>, SignalError> {
        let extension = self.extension();
        check(x, self.fs, extension + 1, "a zero-phase filter")?;
        let mut y = extend_oddly(x, extension);
        let first = y[0];
        self.run(&mut y, first);
        y.reverse();
        let first = y[0];
        self.run(&mut y, first);
        y.reverse();
        y.truncate(y.len() - extension);
        y.drain(..extension);
        Ok(y)
    }

    /// In place, section by section, each settled on the constant input `level` before the first sample.
    fn run(&self, x: &mut [f64], level: f64) {
        let mut level = level;
        for section in &self.sections {
            let [b0, b1, b2] = section.b;
            let [a1, a2] = section.a;
            // Transposed direct form II.
            let settled = level * (b0 + b1 + b2) / (1.0 + a1 + a2);
            let mut z1 = settled - b0 * level;
            let mut z2 = b2 * level - a2 * settled;
            for v in x.iter_mut() {
                let y = b0 * *v + z1;
                z1 = b1 * *v - a1 * y + z2;
                z2 = b2 * *v - a2 * y;
                *v = y;
            }
            level = settled;
        }
    }
}

/// s to z at unit step of the warped frequency axis.
fn bilinear(s: Complex<f64>) -> Complex<f64> {
    (1.0 + s) / (1.0 - s)
}

/// Section of a low-pass (`sign` 1: zeros at -1, unit gain at 0) or high-pass (`sign` -1) with the pole s and its
/// conjugate, or s alone.
fn edge_section(s: Complex<f64>, real: bool, sign: f64) -> Section {
    let z = bilinear(s);
    let at = if sign > 0.0 { 0.0 } else { PI };
    if real {
        Section::normalised([1.0, sign, 0.0], [-z.re, 0.0], at)
    } else {
        Section::normalised([1.0, 2.0 * sign, 1.0], [-2.0 * z.re, z.norm_sqr()], at)
    }
}

/// `x` with `extension` samples more at each end, turned about the end points: 2 x_0 - x_k. Needs extension < length.
pub(super) fn extend_oddly(x: &[f64], extension: usize) -> Vec<f64> {
    let (first, last) = (x[0], x[x.len() - 1]);
    let before = x[1..=extension].iter().rev().map(|v| 2.0 * first - v);
    let after = (x[x.len() - 1 - extension..x.len() - 1].iter().rev()).map(|v| 2.0 * last - v);
    before.chain(x.iter().copied()).chain(after).collect()
}

#[cfg(test)]
mod tests {
    use super::super::test_signals::{Noise, cosine};
    use super::*;

    const FS: f64 = 1000.0;

    fn every_kind() -> Vec<Butterworth> {
        let mut filters = Vec::new();
        for order in 1..=7 {
            for pass in [
                Passband::Below(80.0),
                Passband::Above(80.0),
                Passband::Between(Band::between(80.0, 120.0)),
                Passband::Between(Band::between(20.0, 490.0)),
            ] {
                filters.push(Butterworth::new(order, pass, FS).unwrap());
            }
        }
        filters
    }

    #[test]
    fn analytic_gain_is_butterworths() {
        for order in 1..=7 {
            let exponent = 2 * order as i32;
            let warp = |f: f64| (PI * f / FS).tan();
            for f in [5.0, 80.0, 99.0, 120.0, 400.0] {
                let gain = |pass| Butterworth::new(order, pass, FS).unwrap().gain(f);
                let ratio = warp(f) / warp(80.0);
                let low = (1.0 + ratio.powi(exponent)).sqrt().recip();
                let high = (1.0 + ratio.powi(-exponent)).sqrt().recip();
                let (k1, k2) = (warp(80.0), warp(120.0));
                let offset = (warp(f).powi(2) - k1 * k2) / (warp(f) * (k2 - k1));
                let band = (1.0 + offset.powi(exponent)).sqrt().recip();
                for (value, expected) in [
                    (gain(Passband::Below(80.0)), low),
                    (gain(Passband::Above(80.0)), high),
                    (gain(Passband::Between(Band::between(80.0, 120.0))), band),
                ] {
                    assert!((value / expected - 1.0).abs() < 1e-9, "{order} {f}");
                }
            }
        }
    }

    #[test]
    fn analytic_zero_phase_halves_a_sine_at_the_edge() {
        let x = cosine(4000, FS, 80.0, 1.0, 0.3);
        for pass in [Passband::Below(80.0), Passband::Above(80.0)] {
            let y = Butterworth::new(4, pass, FS).unwrap().zero_phase(&x).unwrap();
            let worst = (500..3500).map(|i| (y[i] - 0.5 * x[i]).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-9, "{worst:e}");
        }
    }

    #[test]
    fn prop_zero_phase_commutes_with_time_reversal() {
        // Exactly so only far from the ends: forwards-backwards and backwards-forwards meet the ends differently.
        let x = Noise::new(3).normals(3000);
        let reversed: Vec<f64> = x.iter().rev().copied().collect();
        for filter in every_kind() {
            let y = filter.zero_phase(&x).unwrap();
            let mut z = filter.zero_phase(&reversed).unwrap();
            z.reverse();
            let worst = (1200..1800).map(|i| (y[i] - z[i]).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-6, "{worst:e} {:?}", filter.sections().len());
        }
    }

    #[test]
    fn prop_bad_input_is_an_error() {
        let band = |low, high| Passband::Between(Band::between(low, high));
        for pass in [
            Passband::Below(0.0),
            Passband::Above(500.0),
            Passband::Below(f64::NAN),
            band(100.0, 50.0),
            band(100.0, 100.0),
        ] {
            assert!(Butterworth::new(4, pass, FS).is_err());
        }
        assert!(Butterworth::new(0, Passband::Below(10.0), FS).is_err());
        assert!(Butterworth::new(2, Passband::Below(0.1), 0.0).is_err());
        let filter = Butterworth::new(4, Passband::Below(80.0), FS).unwrap();
        assert!(matches!(filter.zero_phase(&[1.0; 15]), Err(SignalError::TooShort { have: 15, need: 16, .. })));
        assert_eq!(filter.zero_phase(&[f64::NAN; 40]), Err(SignalError::NotFinite { index: 0 }));
        assert!(filter.once(&[]).unwrap().is_empty());
        let constant = filter.zero_phase(&[3.0; 40]).unwrap();
        assert!(constant.iter().all(|y| (y - 3.0).abs() < 1e-12));
    }
}
