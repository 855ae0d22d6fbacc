//! Transforms of segments between their bins.

use std::f64::consts::TAU;

use realfft::num_complex::Complex;

use super::super::band::Demodulator;

/// Points of the padded spectrum for each bin of the segment; even.
pub(super) const PADDING: usize = 8;

/// Transforms of the windowed, mean-free envelope of segments of one length, interpolated by zero padding, below a
/// highest frequency.
pub(in super::super) struct Padded {
    fs: f64,
    length: usize,
    /// E: padded bin m represents frequency m fs / (PADDING length). Its phase has the window's middle at time zero, so
    /// that it is smooth.
    pub(super) values: Vec<Complex<f64>>,
}

impl Padded {
    /// Up to `highest`, Hz.
    pub(in super::super) fn new(fs: f64, length: usize, highest: f64) -> Self {
        // The cubic takes a point below and two above.
        let count = (highest / fs * (PADDING * length) as f64) as usize + 4;
        Padded { fs, length, values: vec![Complex::ZERO; count.min(PADDING * length / 2 + 1)] }
    }

    /// Of an envelope less its mean, `window` not yet applied. The transform padded to PADDING times the length is that
    /// of the values turned by r / PADDING of a bin, r = 0, 1, ..., bin by bin; as they are real, the turn by r has
    /// that by -r in its negative frequencies. The demodulator lends its backward plan, which gives the complex
    /// conjugate.
    pub(in super::super) fn transform(&mut self, envelope: &[f64], window: &[f64], room: &mut Demodulator) {
        let n = self.length;
        let turn = TAU / (PADDING * n) as f64;
        for r in 0..=PADDING / 2 {
            for (t, (value, (e, w))) in (room.values.iter_mut()).zip(envelope.iter().zip(window)).enumerate() {
                let (sin, cos) = (turn * (r * t) as f64).sin_cos();
                *value = Complex::new(e * w * cos, e * w * sin);
            }
            room.fft.process_with_scratch(&mut room.values, &mut room.scratch);
            for k in 0..=n / 2 {
                let above = PADDING * k + r;
                if let Some(place) = self.values.get_mut(above) {
                    *place = room.values[k].conj();
                }
                if k > 0
                    && r > 0
                    && let Some(place) = self.values.get_mut(PADDING * k - r)
                {
                    *place = room.values[n - k];
                }
            }
        }
        let half = (n / 2) as u64;
        let period = (PADDING * n) as u64;
        for (m, value) in self.values.iter_mut().enumerate() {
            let (sin, cos) = (turn * (m as u64 * half % period) as f64).sin_cos();
            *value *= Complex::new(cos, sin);
        }
    }

    /// E at a frequency, by the cubic through the four points around it.
    pub(super) fn at(&self, f: f64) -> Complex<f64> {
        let position = f / self.fs * (PADDING * self.length) as f64;
        let at = (position as usize).clamp(1, self.values.len() - 3);
        let t = position - at as f64;
        let e = &self.values[at - 1..at + 3];
        e[0] * (-t * (t - 1.0) * (t - 2.0) / 6.0) + e[1] * ((t * t - 1.0) * (t - 2.0) / 2.0)
            - e[2] * (t * (t + 1.0) * (t - 2.0) / 2.0)
            + e[3] * (t * (t * t - 1.0) / 6.0)
    }
}
