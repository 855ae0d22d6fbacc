//! Spectra of a slice by Welch's method, with any window, overlap and detrending.
//!
//! The scaling is that of [`spectrum`](super::spectrum): amplitudes are peak values of a sine at the bin, densities
//! unit^2/Hz, both one-sided. [`StreamSpectra`](super::StreamSpectra) has the same for a stream, with Hann's window and
//! half overlap.

use super::error::{SignalError, check, check_squares, require};
use super::lengths::fast_up_to;
use super::spectrum::{FEWEST_SAMPLES, PowerAverage, SegmentTransform, Spectrum};
use super::window::Window;

/// What is taken off each segment before its window.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Detrend {
    /// Nothing: a mean shows at zero frequency.
    #[default]
    None,
    /// The mean.
    Mean,
    /// The straight line of least squares.
    Linear,
}

impl Detrend {
    /// In place.
    pub fn apply(self, x: &mut [f64]) {
        let n = x.len() as f64;
        let Some(&first) = x.first().filter(|_| self != Detrend::None) else {
            return;
        };
        // From the first value on, so that nothing is left of a constant, round-off neither.
        let mean = first + x.iter().map(|v| v - first).sum::<f64>() / n;
        let middle = 0.5 * (n - 1.0);
        let mut slope = 0.0;
        if self == Detrend::Linear && x.len() > 1 {
            let moment: f64 = (x.iter().enumerate()).map(|(i, v)| (i as f64 - middle) * (v - first)).sum();
            slope = moment * 12.0 / (n * (n * n - 1.0));
        }
        for (i, v) in x.iter_mut().enumerate() {
            *v -= mean + slope * (i as f64 - middle);
        }
    }
}

/// How a signal is cut into segments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segments {
    /// Samples of a segment, 8 or more; cut down to the signal's length where that is shorter. Bins lie
    /// `fs / length` apart.
    pub length: usize,
    /// Share of a segment that it has in common with the next, 0 to below 1.
    pub overlap: f64,
    /// Window.
    pub window: Window,
    /// What is removed from each segment.
    pub detrend: Detrend,
}

impl Segments {
    /// Hann's window, half overlap, nothing removed.
    pub fn of(length: usize) -> Self {
        Segments { length, overlap: 0.5, window: Window::Hann, detrend: Detrend::None }
    }

    /// Length and distance of the segments of a signal.
    pub(super) fn plan(&self, x: &[f64], fs: f64) -> Result<(usize, usize), SignalError> {
        check(x, fs, FEWEST_SAMPLES, "a spectrum")?;
        check_squares(x)?;
        require(self.length >= FEWEST_SAMPLES, "segment length (samples)", self.length as f64, "8 or more")?;
        require((0.0..1.0).contains(&self.overlap), "overlap", self.overlap, "0 to below 1")?;
        let length = self.length.min(x.len());
        let step = length - ((self.overlap * length as f64).floor() as usize).min(length - 1);
        Ok((length, step))
    }
}

/// Averaged amplitude spectrum and power spectral density of `x`, sampled at `fs` Hz. An incomplete last segment is
/// dropped.
///
/// # Errors
/// [`SignalError`] with fewer than 8 samples, samples that are not finite or beyond 1e140, or segments out of range.
pub fn psd(x: &[f64], fs: f64, segments: &Segments) -> Result<Spectrum, SignalError> {
    let (length, step) = segments.plan(x, fs)?;
    let mut transform = SegmentTransform::new(segments.window.periodic(length));
    let mut average = PowerAverage::new(length);
    for segment in x.windows(length).step_by(step) {
        transform.input.copy_from_slice(segment);
        segments.detrend.apply(&mut transform.input);
        average.add(transform.windowed_input());
    }
    Ok(average.finish(fs, &transform.window, step))
}

/// The spectrum of several records, each with its own rate (Hz), in segments that no two records share: of at most
/// `turns` periods of `hz`, as long as the shortest record allows, and fast to transform.
pub(super) fn of_records(records: &[(&[f64], f64)], (turns, hz): (f64, f64)) -> Result<Spectrum, SignalError> {
    let duration = |(x, fs): &(&[f64], f64)| x.len() as f64 / fs;
    let shortest = records.iter().copied().min_by(|a, b| duration(a).total_cmp(&duration(b)));
    let (x, fs) = shortest.unwrap_or((&[], 1.0));
    let length = fast_up_to(((turns * fs / hz) as usize).min(x.len()));
    let seconds = length as f64 / fs;
    let each = records.iter().map(|(x, fs)| psd(x, *fs, &Segments::of((seconds * fs).round() as usize)));
    Ok(Spectrum::averaged(each.collect::<Result<_, _>>()?))
}

#[cfg(test)]
mod tests {
    use super::super::distribution::chi_square_quantile;
    use super::super::test_signals::{Noise, cosine};
    use super::*;

    const FS: f64 = 2048.0;

    fn segments(window: Window) -> Segments {
        Segments { window, ..Segments::of(512) }
    }

    #[test]
    fn analytic_sine_shows_its_amplitude_in_any_window() {
        let x = cosine(4096, FS, 200.0, 3.0, 0.4);
        for window in Window::ALL {
            let s = psd(&x, FS, &segments(window)).unwrap();
            assert!((s.amplitude[50] - 3.0).abs() < 1e-10, "{window:?}");
            assert!((s.band_rms(150.0, 250.0) - 3.0 / 2f64.sqrt()).abs() < 1e-10);
        }
        // A flat top shows it between bins too.
        let x = cosine(4096, FS, 202.0, 3.0, 0.4);
        let s = psd(&x, FS, &segments(Window::FlatTop)).unwrap();
        assert!((s.amplitude[50] / 3.0 - 1.0).abs() < 2e-3);
    }

    #[test]
    fn analytic_white_noise_level_and_its_interval() {
        let sigma = 1.7;
        let x: Vec<f64> = (Noise::new(5).normals(400_000).iter()).map(|v| sigma * v).collect();
        let level = 2.0 * sigma * sigma / FS;
        for window in Window::ALL {
            let s = psd(&x, FS, &segments(window)).unwrap();
            let inner = &s.density[5..250];
            let mean = inner.iter().sum::<f64>() / inner.len() as f64;
            assert!((mean / level - 1.0).abs() < 6e-3, "{window:?} {}", mean / level);
            let freedom = s.degrees_of_freedom;
            let [high, low] = [0.025, 0.975].map(|p| freedom / chi_square_quantile(p, freedom));
            let inside = inner.iter().filter(|d| (low * **d..=high * **d).contains(&level));
            let share = inside.count() as f64 / inner.len() as f64;
            // 245 correlated bins: a standard error of some 0.02.
            assert!((share - 0.95).abs() < 0.06, "{window:?} {share}");
        }
    }

    /// Records of several lengths and rates, one of them shorter than a segment may be.
    #[test]
    fn analytic_records_are_averaged_in_segments_of_their_own() {
        let noise = Noise::new(9).normals(60_000);
        let records = [(&noise[..500], FS), (&noise[500..9_000], 1.01 * FS), (&noise[9_000..60_000], 0.99 * FS)];
        let s = of_records(&records, (64.0, 100.0)).unwrap();
        // 500 samples are the longest that all have.
        assert_eq!((s.segment_length, s.frequency_step), (500, FS / 500.0));
        let each = records.map(|(x, fs)| psd(x, fs, &Segments::of((500.0 * fs / FS).round() as usize)).unwrap());
        assert_eq!(s.segments, each.iter().map(|s| s.segments).sum::<usize>());
        let freedom: f64 = each.iter().map(|s| s.degrees_of_freedom).sum();
        assert!((s.degrees_of_freedom / freedom - 1.0).abs() < 1e-12);
        // Of white noise each bin scatters as chi-square with so many degrees of freedom.
        let inner = &s.amplitude[5..240];
        let power: Vec<f64> = inner.iter().map(|a| a * a).collect();
        let mean = power.iter().sum::<f64>() / power.len() as f64;
        let variance = power.iter().map(|p| (p / mean - 1.0).powi(2)).sum::<f64>() / power.len() as f64;
        assert!((variance * freedom / 2.0 - 1.0).abs() < 0.3, "{variance} {freedom}");
        // One alone is its own.
        let one = of_records(&records[1..2], (64.0, 100.0)).unwrap();
        assert_eq!(one, psd(records[1].0, records[1].1, &Segments::of(one.segment_length)).unwrap());
    }

    #[test]
    fn analytic_parseval_with_detrending() {
        for n in [300, 301] {
            let noise = Noise::new(7).normals(n);
            let x: Vec<f64> = (noise.iter().enumerate()).map(|(i, v)| v + 3.0 + 0.05 * i as f64).collect();
            let options = Segments { window: Window::Rectangular, detrend: Detrend::Linear, ..Segments::of(n) };
            let s = psd(&x, FS, &options).unwrap();
            let mut rest = x.clone();
            Detrend::Linear.apply(&mut rest);
            let mean_square = rest.iter().map(|v| v * v).sum::<f64>() / n as f64;
            let sum = s.density.iter().sum::<f64>() * s.frequency_step;
            assert!((sum / mean_square - 1.0).abs() < 1e-12, "{n}");
            assert!((s.band_rms(0.0, FS).powi(2) / sum - 1.0).abs() < 1e-12);
            assert!(s.amplitude[0] < 1e-12);
            assert_eq!(s.degrees_of_freedom, 2.0);
        }
    }

    #[test]
    fn prop_bad_input_is_an_error() {
        let good = Segments::of(64);
        assert!(psd(&[], FS, &good).is_err());
        assert!(psd(&[1.0; 7], FS, &good).is_err());
        assert!(psd(&[f64::NAN; 70], FS, &good).is_err());
        assert!(psd(&[1.0; 70], f64::NAN, &good).is_err());
        assert!(psd(&[1.0; 70], FS, &Segments::of(4)).is_err());
        let overlap = Segments { overlap: 1.0, ..good };
        assert!(psd(&[1.0; 70], FS, &overlap).is_err());
        assert!(psd(&[1.0; 70], FS, &good).is_ok());
    }
}
