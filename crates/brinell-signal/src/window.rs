//! Windows: cosine sums.
//!
//! F. J. Harris, "On the use of windows for harmonic analysis with the discrete Fourier transform", Proc. IEEE 66
//! (1978) 51-83. w(t) = a_0 - a_1 cos 2 pi t + a_2 cos 4 pi t - ..., t from 0 to 1. A periodic window of n samples has
//! t = i / n and belongs to a transform of n samples; a symmetric one has t = i / (n - 1) and belongs to a filter.

use std::f64::consts::{PI, TAU};

/// A window.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Window {
    /// One throughout: sharpest lines, strongest leakage.
    Rectangular,
    /// Hann's: the usual choice.
    #[default]
    Hann,
    /// Hamming's: lower first side lobe, slower decay than Hann.
    Hamming,
    /// Four-term minimum window of Blackman and Harris: side lobes below -92 dB.
    BlackmanHarris,
    /// Flat top: amplitudes between bins to 0.01 dB, lines five bins wide to either side.
    FlatTop,
}

impl Window {
    #[cfg(test)]
    pub(crate) const ALL: [Window; 5] =
        [Window::Rectangular, Window::Hann, Window::Hamming, Window::BlackmanHarris, Window::FlatTop];

    /// a_0, a_1, ...
    fn coefficients(self) -> &'static [f64] {
        match self {
            Window::Rectangular => &[1.0],
            Window::Hann => &[0.5, 0.5],
            Window::Hamming => &[0.54, 0.46],
            Window::BlackmanHarris => &[0.35875, 0.48829, 0.14128, 0.01168],
            // G. D'Antona, A. Ferrero, "Digital signal processing for measurement systems" (2006), table 3.2.
            Window::FlatTop => &[0.21557895, 0.41663158, 0.277263158, 0.083578947, 0.006947368],
        }
    }

    /// For a transform of `length` samples.
    pub fn periodic(self, length: usize) -> Vec<f64> {
        if self == Window::Rectangular {
            return vec![1.0; length];
        }
        let n = length as f64;
        if self == Window::Hann {
            return (0..length).map(|i| (PI * i as f64 / n).sin().powi(2)).collect();
        }
        (0..length).map(|i| self.at(i as f64 / n)).collect()
    }

    /// For a filter of `length` taps; a single tap is 1.
    pub fn symmetric(self, length: usize) -> Vec<f64> {
        if length == 1 {
            return vec![1.0];
        }
        let span = length.saturating_sub(1) as f64;
        (0..length).map(|i| self.at(i as f64 / span)).collect()
    }

    fn at(self, t: f64) -> f64 {
        let mut sign = 1.0;
        let mut sum = 0.0;
        for (k, a) in self.coefficients().iter().enumerate() {
            sum += sign * a * (TAU * k as f64 * t).cos();
            sign = -sign;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lit_gain_and_bandwidth_of_harris_table() {
        // Harris 1978, table I: Hann, Hamming and the minimum four-term window.
        for (window, gain, bandwidth) in [
            (Window::Rectangular, 1.0, 1.0),
            (Window::Hann, 0.5, 1.5),
            (Window::Hamming, 0.54, 1.36),
            (Window::BlackmanHarris, 0.36, 2.0),
        ] {
            let w = window.periodic(48);
            let (sum, squares) = w.iter().fold((0.0, 0.0), |(sum, squares), w| (sum + w, squares + w * w));
            assert!((sum / 48.0 - gain).abs() <= 0.005);
            assert!((48.0 * squares / (sum * sum) - bandwidth).abs() <= 0.005);
        }
    }

    #[test]
    fn prop_symmetric_windows_are() {
        for window in Window::ALL {
            let s = window.symmetric(48);
            assert!((0..48).all(|i| (s[i] - s[47 - i]).abs() < 1e-14));
            assert!(window.periodic(0).is_empty() && window.symmetric(0).is_empty());
        }
    }
}
