//! A frequency band, and the envelope of a segment in it: the modulus of the band's analytic signal.

use super::error::{SignalError, require};
use super::fft::round_off;
use serde::Serialize;
use std::ops::Range;
use std::sync::Arc;

use realfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

/// A frequency band, Hz; bins on its edges belong to it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Band {
    /// Lower edge, Hz.
    #[serde(rename = "low_hz")]
    pub low: f64,
    /// Upper edge, Hz; infinity for everything above `low`.
    #[serde(rename = "high_hz")]
    pub high: f64,
}

impl Band {
    /// The band between two frequencies, Hz.
    pub fn between(low: f64, high: f64) -> Self {
        Band { low, high }
    }

    /// Everything above a high-pass frequency, Hz.
    pub fn above(low: f64) -> Self {
        Band { low, high: f64::INFINITY }
    }
}

/// Subtracts the window-weighted mean, and gives it.
pub(super) fn remove_weighted_mean(x: &mut [f64], window: &[f64]) -> f64 {
    let sum: f64 = x.iter().zip(window).map(|(x, w)| x * w).sum();
    let mean = sum / window.iter().sum::<f64>();
    x.iter_mut().for_each(|x| *x -= mean);
    mean
}

/// That a band satisfies 0 <= low < high and low < fs / 2, and holds a bin of a transform of `length` samples at `fs` Hz.
pub(super) fn check_band(fs: f64, length: usize, band: Band) -> Result<(), SignalError> {
    let range = "0 to below the upper edge and half the sampling rate";
    let holds = 0.0 <= band.low && band.low < band.high && band.low < 0.5 * fs;
    require(holds, "lower edge of the band (Hz)", band.low, range)?;
    let range = "a bin of the transform within the band; bins lie the sampling rate over the samples apart";
    require(!bins(fs, length, band).is_empty(), "lower edge of the band (Hz)", band.low, range)
}

/// First bin of a band and the one after its last, of a transform of `length` samples at `fs` Hz.
///
/// # Panics
/// Where the band does not satisfy 0 <= low < high and low < fs / 2.
pub(super) fn bins(fs: f64, length: usize, band: Band) -> Range<usize> {
    assert!(
        0.0 <= band.low && band.low < band.high && band.low < 0.5 * fs,
        "band from {} to {} Hz, sampled at {fs} Hz",
        band.low,
        band.high
    );
    // Zero frequency and half the sampling rate have no quadrature: they never belong to the band.
    let most = length.div_ceil(2);
    let step = fs / length as f64;
    let first = ((band.low / step).ceil() as usize).clamp(1, most);
    let end = ((band.high / step).floor() as usize).saturating_add(1).clamp(first, most);
    first..end
}

/// Moduli of complex values: roots of sums of squares, by the much slower `hypot` only where a square would leave the
/// range of numbers.
pub(super) fn moduli(values: &[Complex<f64>], moduli: &mut [f64]) {
    for (modulus, value) in moduli.iter_mut().zip(values) {
        *modulus = value.norm_sqr().sqrt();
    }
    let sound = (moduli.iter()).fold(true, |sound, m| sound & (*m > 1e-150) & (*m < 1e150));
    if !sound {
        for (modulus, value) in moduli.iter_mut().zip(values) {
            *modulus = value.re.hypot(value.im);
        }
    }
}

/// Band-pass and Hilbert transform of segments of one length: from their transform to their envelope.
pub(super) struct Demodulator {
    bins: Range<usize>,
    /// Backward.
    pub(super) fft: Arc<dyn Fft<f64>>,
    /// A value a sample; between calls, room for whoever needs some.
    pub(super) values: Vec<Complex<f64>>,
    pub(super) scratch: Vec<Complex<f64>>,
}

impl Demodulator {
    pub(super) fn new(fs: f64, length: usize, band: Band) -> Self {
        let fft = FftPlanner::new().plan_fft_inverse(length);
        Demodulator {
            bins: bins(fs, length, band),
            values: vec![Complex::ZERO; length],
            scratch: vec![Complex::ZERO; fft.get_inplace_scratch_len()],
            fft,
        }
    }

    /// The envelope of the segment whose transform this is: the modulus of its analytic signal, which has the band's
    /// positive frequencies twice and nothing else.
    pub(super) fn envelope(&mut self, transform: &[Complex<f64>], envelope: &mut [f64]) {
        let twice = 2.0 / envelope.len() as f64;
        let round_off = round_off(transform);
        self.values.fill(Complex::ZERO);
        let band = self.values[self.bins.clone()].iter_mut();
        for (value, bin) in band.zip(&transform[self.bins.clone()]).filter(|(_, bin)| bin.norm_sqr() >= round_off) {
            *value = bin * twice;
        }
        self.fft.process_with_scratch(&mut self.values, &mut self.scratch);
        moduli(&self.values, envelope);
    }
}
