//! The anti-alias chain of the sensor channels: linear-phase FIR, then one sample in eight.
//!
//! `docs/src/theory/numerics.md`: the state is sampled at 8 f_s, filtered by a Kaiser-window low-pass (passband to 0.4
//! f_s, stopband from 0.5 f_s, 80 dB), its delay removed, and decimated by 8.

use crate::lanes::inner_products;
use crate::signal::decimate::{ATTENUATION_DB, FACTOR, PASSBAND, STOPBAND, kaiser_lowpass};

/// Partial sums of the inner product: fixed, so that the compiler may use vector lanes without changing the result.
const LANES: usize = 8;

/// Filters and decimates any number of channels by [`FACTOR`], one frame at a time.
///
/// Output k is the filtered input at input index 8 k: the filter's delay is removed, at the price that output k can
/// be given only once input 8 k + [`half_length`](Self::half_length) has arrived. To get every output up to t_end,
/// push that many frames past it. Input before the first frame counts as zero, so where a channel does not start
/// from zero, the outputs of the first `half_length` inputs (25 output samples) carry the filter's step response.
#[derive(Debug, Clone)]
pub struct Decimator {
    channels: usize,
    /// Taps, padded with zeros at the far end to a multiple of `LANES`.
    taps: Vec<f64>,
    half: usize,
    /// For each channel a ring of `taps.len()` samples written twice, so that any window of it is contiguous.
    rings: Vec<f64>,
    /// Where the next frame goes in a ring.
    at: usize,
    /// Frames still to come before the next output.
    wait: usize,
    output: Vec<f64>,
}

impl Decimator {
    /// A decimator with the chain of the module's head, for frames of `channels` values.
    pub fn new(channels: usize) -> Self {
        let factor = FACTOR as f64;
        let mut taps = kaiser_lowpass(PASSBAND / factor, STOPBAND / factor, ATTENUATION_DB);
        let half = taps.len() / 2;
        taps.resize(taps.len().next_multiple_of(LANES), 0.0);
        // The window is read oldest first and the filter is symmetric: the padding must meet the oldest samples.
        let padding = taps.len() - (2 * half + 1);
        taps.rotate_right(padding);
        Decimator {
            channels,
            rings: vec![0.0; 2 * taps.len() * channels],
            taps,
            half,
            at: 0,
            wait: half,
            output: vec![0.0; channels],
        }
    }

    /// Half the filter's length: input frames by which an output lags the input it represents.
    pub fn half_length(&self) -> usize {
        self.half
    }

    /// Takes the next input frame, one value for each channel; gives output frame k = 0, 1, ... as it completes.
    ///
    /// # Panics
    /// Where the frame does not hold one value for each channel.
    pub fn push(&mut self, input_frame: &[f64]) -> Option<&[f64]> {
        assert_eq!(input_frame.len(), self.channels, "one value for each channel");
        let length = self.taps.len();
        for (ring, &value) in self.rings.chunks_exact_mut(2 * length).zip(input_frame) {
            ring[self.at] = value;
            ring[self.at + length] = value;
        }
        self.at = if self.at + 1 == length { 0 } else { self.at + 1 };
        if self.wait > 0 {
            self.wait -= 1;
            return None;
        }
        self.wait = FACTOR - 1;
        let window = |channel: usize| &self.rings[2 * length * channel + self.at..][..length];
        // Two channels at a time share the taps that they load.
        let (pairs, rest) = self.output.as_chunks_mut::<2>();
        for (k, pair) in pairs.iter_mut().enumerate() {
            *pair = inner_products(&self.taps, [window(2 * k), window(2 * k + 1)]);
        }
        if let [last] = rest {
            [*last] = inner_products(&self.taps, [window(self.channels - 1)]);
        }
        Some(&self.output)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;
    use std::f64::consts::TAU;

    const FS: f64 = 25_600.0;

    /// `amplitude * cos(2 pi f t + phase)`, n samples from t = 0.
    fn cosine(n: usize, fs: f64, f: f64, amplitude: f64, phase: f64) -> Vec<f64> {
        (0..n).map(|i| amplitude * (TAU * f * i as f64 / fs + phase).cos()).collect()
    }

    fn decimate(x: &[f64]) -> Vec<f64> {
        let mut decimator = Decimator::new(1);
        x.iter().filter_map(|&v| decimator.push(&[v]).map(|y| y[0])).collect()
    }

    #[test]
    fn analytic_sine_passes_without_delay() {
        let n = 400;
        let x = cosine(8 * n + 400, 8.0 * FS, 0.3 * FS, 1.7, 0.4);
        let expected = cosine(n, FS, 0.3 * FS, 1.7, 0.4);
        let y = decimate(&x);
        let worst = (60..n).map(|k| (y[k] - expected[k]).abs()).fold(0.0, f64::max);
        assert!(worst < 1.7e-4, "{worst:e}");
    }

    #[test]
    fn analytic_alias_is_down_80_db() {
        let x = cosine(8 * 400, 8.0 * FS, 0.55 * FS, 1.0, 0.4);
        let worst = decimate(&x)[60..].iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        assert!(worst < 1e-4, "{worst:e}");
    }

    #[test]
    fn prop_output_is_the_centred_convolution() {
        let mut random = Random::new(7);
        let x: Vec<f64> = (0..3000).map(|_| random.normal()).collect();
        let taps = kaiser_lowpass(PASSBAND / 8.0, STOPBAND / 8.0, ATTENUATION_DB);
        let mut decimator = Decimator::new(2);
        assert_eq!(taps.len(), 2 * decimator.half_length() + 1);
        let half = decimator.half_length() as isize;
        let mut k = 0;
        for (i, &v) in x.iter().enumerate() {
            let arrived = i >= half as usize && (i - half as usize).is_multiple_of(FACTOR);
            let output = decimator.push(&[v, -2.0 * v]);
            assert_eq!(output.is_some(), arrived, "at input {i}");
            let Some(output) = output else { continue };
            let expected: f64 = (-half..=half)
                .filter(|m| (8 * k + m) >= 0)
                .map(|m| taps[(half + m) as usize] * x[(8 * k + m) as usize])
                .sum();
            assert!((output[0] - expected).abs() < 1e-13);
            assert_eq!(output[1], -2.0 * output[0]);
            k += 1;
        }
        assert_eq!(k, (3000 - half + 7) / 8);
    }
}
