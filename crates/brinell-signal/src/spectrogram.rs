//! Spectrogram: the power spectral density of each segment by itself, over time.

use super::error::SignalError;
use super::psd::Segments;
use super::spectrum::SegmentTransform;

/// A spectrogram. Frame i lies about time `first_time + i time_step`, bin k about frequency `k frequency_step`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Spectrogram {
    /// Distance between bins, Hz.
    pub frequency_step: f64,
    /// Middle of the first frame, s from the first sample.
    pub first_time: f64,
    /// Distance between frames, s.
    pub time_step: f64,
    /// Bins of a frame, zero frequency to half the sampling rate.
    pub bins: usize,
    /// Power spectral density, one-sided, unit^2/Hz: frame after frame, `bins` values each.
    pub density: Vec<f64>,
}

impl Spectrogram {
    /// Number of frames.
    pub fn frames(&self) -> usize {
        self.density.len().checked_div(self.bins).unwrap_or(0)
    }

    /// Densities of a frame, unit^2/Hz.
    ///
    /// # Panics
    /// Where there is no such frame.
    pub fn frame(&self, index: usize) -> &[f64] {
        self.density.chunks_exact(self.bins).nth(index).expect("a frame of the spectrogram")
    }
}

/// Spectrogram of `x`, sampled at `fs` Hz, in segments that each make a frame; an incomplete last one is dropped.
/// Nothing is padded, so the first frame lies half a segment into the signal. Holds every frame.
///
/// # Errors
/// As [`psd`](super::psd()).
pub fn spectrogram(x: &[f64], fs: f64, segments: &Segments) -> Result<Spectrogram, SignalError> {
    let (length, step) = segments.plan(x, fs)?;
    let mut transform = SegmentTransform::new(segments.window.periodic(length));
    let energy: f64 = transform.window.iter().map(|w| w * w).sum();
    let bins = transform.output.len();
    let mut density = Vec::with_capacity(bins * ((x.len() - length) / step + 1));
    for segment in x.windows(length).step_by(step) {
        transform.input.copy_from_slice(segment);
        segments.detrend.apply(&mut transform.input);
        density.extend(transform.windowed_input().iter().enumerate().map(|(k, value)| {
            let sides = if k == 0 || 2 * k == length { 1.0 } else { 2.0 };
            sides * value.norm_sqr() / (fs * energy)
        }));
    }
    Ok(Spectrogram {
        frequency_step: fs / length as f64,
        first_time: 0.5 * length as f64 / fs,
        time_step: step as f64 / fs,
        bins,
        density,
    })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::super::psd::psd;
    use super::super::test_signals::Noise;
    use super::super::window::Window;
    use super::*;

    const FS: f64 = 8000.0;

    #[test]
    fn regress_nothing_has_no_frames() {
        assert_eq!(Spectrogram::default().frames(), 0);
    }

    #[test]
    fn analytic_chirp_is_followed() {
        // 500 Hz to 2500 Hz over a second, amplitude 2.
        let x: Vec<f64> =
            (0..8000).map(|i| i as f64 / FS).map(|t| 2.0 * (TAU * (500.0 * t + 1000.0 * t * t)).cos()).collect();
        let options = Segments { window: Window::FlatTop, ..Segments::of(256) };
        let s = spectrogram(&x, FS, &options).unwrap();
        let bandwidth = psd(&x, FS, &options).unwrap().noise_bandwidth;
        assert_eq!((s.frames(), s.bins), (61, 129));
        for i in 0..s.frames() {
            let frame = s.frame(i);
            let top = (0..s.bins).max_by(|&a, &b| frame[a].total_cmp(&frame[b])).unwrap();
            let t = s.first_time + i as f64 * s.time_step;
            let f = 500.0 + 2000.0 * t;
            assert!((top as f64 * s.frequency_step - f).abs() < 1.5 * s.frequency_step);
            let amplitude = (2.0 * bandwidth * frame[top]).sqrt();
            assert!((amplitude - 2.0).abs() < 0.05, "{amplitude}");
        }
    }

    #[test]
    fn prop_mean_over_frames_is_the_density() {
        let x = Noise::new(8).normals(3000);
        let options = Segments::of(200);
        let (s, p) = (spectrogram(&x, FS, &options).unwrap(), psd(&x, FS, &options).unwrap());
        assert_eq!(s.frames(), p.segments);
        for k in 0..s.bins {
            let mean = (0..s.frames()).map(|i| s.frame(i)[k]).sum::<f64>() / s.frames() as f64;
            assert!((mean / p.density[k] - 1.0).abs() < 1e-12);
        }
        assert!(spectrogram(&x[..4], FS, &options).is_err());
    }
}
