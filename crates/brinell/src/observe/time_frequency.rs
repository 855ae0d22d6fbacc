//! The spectrogram of a signal of any length, in a bounded number of frames: of a long signal, neighbours are averaged.

use super::stretches::Stretches;
use crate::signal::{Spectrogram, Window};
use realfft::RealToComplex;
use realfft::num_complex::Complex;
use std::sync::Arc;

/// Frames kept, at most.
#[doc(hidden)]
pub const FRAMES: usize = 400;
/// Samples of a segment, least and most; the most that ball-pass periods may ask for.
const SEGMENT: [usize; 2] = [64, 1024];
const LONGEST: usize = 4096;
/// Ball-pass periods in a segment from which on a Hann window's energy no longer follows their phase.
const PERIODS: f64 = 3.0;
/// Segments that begin within a ball-pass period where each pass is resolved.
const WITHIN: f64 = 4.0;

/// A spectrogram on its way: Hann windows that overlap by half, as in [`crate::signal::spectrogram()`].
pub(crate) struct TimeFrequency {
    sample_rate: f64,
    length: usize,
    window: Vec<f64>,
    energy: f64,
    fft: Arc<dyn RealToComplex<f64>>,
    latest: Vec<f64>,
    filled: usize,
    input: Vec<f64>,
    output: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
    /// Sums of densities, frame after frame; the last may be incomplete.
    sums: Stretches<f64>,
}

impl TimeFrequency {
    /// For about `samples` samples, with ball-pass periods of so many samples, the longest first.
    pub(crate) fn new(sample_rate: f64, samples: u64, periods: [f64; 2]) -> Self {
        Self::with_length(sample_rate, segment(samples, periods))
    }

    fn with_length(sample_rate: f64, length: usize) -> Self {
        let fft = crate::signal::fft::forward(length);
        let window = Window::Hann.periodic(length);
        Self {
            sample_rate,
            length,
            energy: window.iter().map(|w| w * w).sum(),
            window,
            latest: vec![0.0; length],
            filled: 0,
            input: fft.make_input_vec(),
            output: fft.make_output_vec(),
            scratch: fft.make_scratch_vec(),
            sums: Stretches::new(FRAMES, length / 2 + 1),
            fft,
        }
    }

    /// Takes one sample.
    pub(crate) fn push(&mut self, x: f64) {
        self.latest[self.filled] = x;
        self.filled += 1;
        if self.filled < self.length {
            return;
        }
        for ((input, x), w) in self.input.iter_mut().zip(&self.latest).zip(&self.window) {
            *input = x * w;
        }
        self.latest.copy_within(self.length / 2.., 0);
        self.filled = self.length - self.length / 2;
        let done = self.fft.process_with_scratch(&mut self.input, &mut self.output, &mut self.scratch);
        if done.is_err() {
            return;
        }
        let density = 1.0 / (self.sample_rate * self.energy);
        let frame = self.sums.next(0.0, |a, b| a + b);
        for (k, (sum, value)) in frame.iter_mut().zip(&self.output).enumerate() {
            let sides = if k == 0 || 2 * k == self.length { 1.0 } else { 2.0 };
            *sum += sides * value.norm_sqr() * density;
        }
    }

    /// The frames, each the mean of as many segments; `None` where the signal was shorter than one.
    pub(crate) fn finish(self) -> Option<Spectrogram> {
        let bins = self.output.len();
        let Stretches { mut values, samples, begun, .. } = self.sums;
        if begun > 0 {
            values.truncate(values.len() - bins);
        }
        if values.is_empty() {
            return None;
        }
        values.iter_mut().for_each(|sum| *sum /= samples as f64);
        let step = (self.length / 2) as f64 / self.sample_rate;
        Some(Spectrogram {
            frequency_step: self.sample_rate / self.length as f64,
            first_time: 0.5 * self.length as f64 / self.sample_rate + 0.5 * (samples - 1) as f64 * step,
            time_step: samples as f64 * step,
            bins,
            density: values,
        })
    }
}

/// Samples of a segment: about as many bins as frames, moved to where frames do not beat with the ball-pass period.
/// Either a segment holds several periods, or frames follow each other quickly enough to show each pass. Without such a
/// length, bins as many as frames.
fn segment(samples: u64, [longest, shortest]: [f64; 2]) -> usize {
    let even = ((samples.max(1) as f64).sqrt() as usize).next_power_of_two().clamp(SEGMENT[0], SEGMENT[1]);
    let clear = |length: &usize| {
        let hop = (length / 2) as f64;
        let resolved = WITHIN * hop <= shortest && samples as f64 / hop <= FRAMES as f64;
        resolved || *length as f64 >= PERIODS * longest
    };
    let lengths = (0..).map(|k| SEGMENT[0] << k);
    lengths
        .take_while(|length| *length <= LONGEST && *length as u64 <= samples.max(1))
        .filter(clear)
        .min_by_key(|length| length.ilog2().abs_diff(even.ilog2()))
        .unwrap_or(even)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::{Segments, spectrogram};

    #[test]
    fn analytic_frames_are_those_of_the_whole_signal_and_means_of_them() {
        let fs = 1000.0;
        let x: Vec<f64> = (0..64 * 300).map(|k| (k as f64 * 0.3).sin() + (k as f64 * k as f64 * 1e-5).cos()).collect();
        let whole = spectrogram(&x, fs, &Segments::of(64)).unwrap();
        let mut streamed = TimeFrequency::with_length(fs, 64);
        x.iter().for_each(|x| streamed.push(*x));
        let streamed = streamed.finish().unwrap();
        // 599 segments: more than fit, so frames are means of two.
        assert_eq!((whole.frames(), streamed.frames(), streamed.bins), (599, 299, 33));
        assert_eq!(streamed.time_step, 2.0 * whole.time_step);
        assert!((streamed.first_time - whole.first_time - 0.5 * whole.time_step).abs() < 1e-12);
        for frame in 0..streamed.frames() {
            for k in 0..streamed.bins {
                let mean = 0.5 * (whole.frame(2 * frame)[k] + whole.frame(2 * frame + 1)[k]);
                assert!((streamed.frame(frame)[k] - mean).abs() <= 1e-12 * (mean + 1e-3));
            }
        }
    }

    #[test]
    fn prop_memory_is_bounded() {
        let mut stream = TimeFrequency::with_length(1000.0, 64);
        let room = stream.sums.values.capacity();
        (0..1_000_000_u32).for_each(|k| stream.push(f64::from(k % 7)));
        assert_eq!(stream.sums.values.capacity(), room);
        assert!(stream.finish().is_some_and(|s| s.frames() <= FRAMES));
        assert!(TimeFrequency::new(1000.0, 10, [100.0, 60.0]).finish().is_none());
    }

    /// Impacts once a ball-pass period are steady: so are the frames, whatever the period.
    #[test]
    fn prop_frames_do_not_beat_with_the_ball_pass_period() {
        for (samples, period) in [(40_000_u64, 205.3), (100_000, 97.1), (20_000, 331.7)] {
            let length = segment(samples, [period, 0.7 * period]);
            let mut view = TimeFrequency::with_length(1.0, length);
            for k in 0..samples {
                let since = k as f64 % period;
                view.push((-0.1 * since).exp() * (0.9 * since).sin());
            }
            let view = view.finish().unwrap();
            let frames = view.density.chunks(view.bins);
            let powers: Vec<f64> = frames.map(|frame| frame.iter().sum()).collect();
            let mean = powers.iter().sum::<f64>() / powers.len() as f64;
            // The window's side lobes, and impacts that fall between samples.
            let most = powers.iter().fold(0.0, |m: f64, p| m.max((p / mean - 1.0).abs()));
            assert!(most < 0.02, "{samples} {period} {length}: {most}");
        }
        // Slow passes in a short run are resolved one by one.
        assert!(segment(10_000, [2000.0, 1500.0]) <= 512);
        assert_eq!(segment(1_000_000, [1e9, 1e9]), SEGMENT[1]);
    }
}
