//! Calibrated amplitude spectra and power spectral densities.
//!
//! P. D. Welch, "The use of fast Fourier transform for the estimation of power spectra", IEEE Trans. Audio
//! Electroacoust. 15 (1967) 70-73: segments overlapping by half, periodic Hann window w, powers averaged. Scaling as
//! in G. Heinzel, A. Ruediger, R. Schilling, "Spectrum and spectral density estimation by the DFT" (2002): one-sided
//! amplitude 2 |X| / sum w, one-sided density 2 |X|^2 / (f_s sum w^2), both without the 2 at zero frequency and at
//! half the sampling rate. A sine of amplitude A on a bin shows A (peak, not RMS); between bins Hann's scallop loss
//! takes up to 15 % off, which [`peak_near`] undoes.
//!
//! Nothing is detrended: a mean shows in bins 0 and 1 and, with Hann, nowhere else.

use std::sync::Arc;

use realfft::RealToComplex;
use realfft::num_complex::Complex;

use super::window::Window;

/// Fewest samples that make a spectrum.
pub const FEWEST_SAMPLES: usize = 8;

/// A one-sided spectrum: bin k represents frequency k `frequency_step`, from zero to half the sampling rate.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    /// Distance between bins, Hz.
    pub frequency_step: f64,
    /// Peak amplitude of a sine at the bin, in the signal's unit; root mean square over the segments.
    pub amplitude: Vec<f64>,
    /// Power spectral density, unit^2/Hz; its sum times `frequency_step` is the (window-weighted) mean square.
    pub density: Vec<f64>,
    /// Samples of a segment.
    pub segment_length: usize,
    /// Segments averaged.
    pub segments: usize,
    /// Equivalent noise bandwidth of a bin, Hz: 1.5 bins for Hann.
    pub noise_bandwidth: f64,
    /// Degrees of freedom of a bin's power under Gaussian noise: it scatters as chi-square with so many, over their
    /// number. 2 for one segment; with K segments 2 K / (1 + 2 sum over j of (1 - j / K) rho_j^2), rho_j being the
    /// correlation of windows j segments apart (Welch 1967). Bin 0 and half the sampling rate have half as many.
    pub degrees_of_freedom: f64,
}

impl Spectrum {
    /// Frequency of a bin, Hz.
    pub fn frequency(&self, bin: usize) -> f64 {
        bin as f64 * self.frequency_step
    }

    /// The mean power of several spectra of the same bins, each weighted by its degrees of freedom.
    pub(super) fn averaged(mut each: Vec<Self>) -> Self {
        if each.len() == 1 {
            return each.remove(0);
        }
        let freedom: f64 = each.iter().map(|s| s.degrees_of_freedom).sum();
        let bins = each.iter().map(|s| s.amplitude.len()).min().unwrap_or(0);
        let mean = |of: &dyn Fn(&Self) -> f64| each.iter().map(|s| s.degrees_of_freedom / freedom * of(s)).sum::<f64>();
        Spectrum {
            amplitude: (0..bins).map(|k| mean(&|s| s.amplitude[k] * s.amplitude[k]).sqrt()).collect(),
            density: (0..bins).map(|k| mean(&|s| s.density[k])).collect(),
            segments: each.iter().map(|s| s.segments).sum(),
            degrees_of_freedom: freedom,
            ..each[0].clone()
        }
    }

    /// RMS of the signal's part between two frequencies (Hz, both ends included, by whole bins), in its unit.
    pub fn band_rms(&self, low: f64, high: f64) -> f64 {
        let sum: f64 = (self.density.iter().enumerate())
            .filter(|&(k, _)| (low..=high).contains(&self.frequency(k)))
            .map(|(_, density)| density)
            .sum();
        // The sum over nothing is -0.
        (sum * self.frequency_step + 0.0).sqrt()
    }
}

/// A spectral line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Hz.
    pub frequency: f64,
    /// Peak amplitude, in the signal's unit.
    pub amplitude: f64,
}

/// Exponent of the magnitudes through which [`peak_near`] lays its parabola. Zero would be the logarithm, whose error
/// with Hann reaches 3.8 % of the amplitude and 0.016 bin; 0.23 leaves 0.11 % and 0.0003 bin.
const PEAK_EXPONENT: f64 = 0.23;

/// The strongest line within `halfwidth` of `frequency` (both Hz), interpolated between bins; `None` where no bin
/// there is above both neighbours. The bin nearest to `frequency` always takes part.
///
/// A parabola through power-scaled magnitudes of the bin and its neighbours: K. J. Werner and F. G. Germain,
/// "Sinusoidal parameter estimation using quadratic interpolation around power-scaled magnitude spectrum peaks",
/// Applied Sciences 6 (2016) 306. Holds for Hann's window and a line at least four bins from any other: with a
/// rectangular one the amplitude is up to 28 % off, with a flat top 2 %.
pub fn peak_near(spectrum: &Spectrum, frequency: f64, halfwidth: f64) -> Option<Peak> {
    let amplitude = &spectrum.amplitude;
    let nearest = (frequency / spectrum.frequency_step).round();
    let first = ((frequency - halfwidth) / spectrum.frequency_step).ceil().min(nearest).max(1.0) as usize;
    let last = ((frequency + halfwidth) / spectrum.frequency_step).floor().max(nearest).max(0.0) as usize;
    let last = last.min(amplitude.len().saturating_sub(2));
    let top = (first..=last)
        .filter(|&k| amplitude[k] > amplitude[k - 1] && amplitude[k] >= amplitude[k + 1])
        .max_by(|&a, &b| amplitude[a].total_cmp(&amplitude[b]))?;
    let (offset, amplitude) = interpolate([amplitude[top - 1], amplitude[top], amplitude[top + 1]]);
    Some(Peak { frequency: (top as f64 + offset) * spectrum.frequency_step, amplitude })
}

/// Offset in bins and height of the peak of a Hann line, from the highest bin and its neighbours.
pub(crate) fn interpolate(magnitudes: [f64; 3]) -> (f64, f64) {
    let [left, top, right] = magnitudes.map(|m| m.powf(PEAK_EXPONENT));
    let offset = 0.5 * (left - right) / (left - 2.0 * top + right);
    let height = top - 0.25 * (left - right) * offset;
    (offset, height.powf(1.0 / PEAK_EXPONENT))
}

/// The transform of segments of one length.
pub(super) struct SegmentTransform {
    pub(super) window: Vec<f64>,
    fft: Arc<dyn RealToComplex<f64>>,
    /// What is transformed; after that, room for whoever needs some.
    pub(super) input: Vec<f64>,
    pub(super) output: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

impl SegmentTransform {
    pub(super) fn new(window: Vec<f64>) -> Self {
        let fft = crate::fft::forward(window.len());
        SegmentTransform {
            window,
            input: fft.make_input_vec(),
            output: fft.make_output_vec(),
            scratch: fft.make_scratch_vec(),
            fft,
        }
    }

    /// Of a segment as it is, to `output`.
    pub(super) fn plain(&mut self, segment: &[f64]) -> &[Complex<f64>] {
        self.input.copy_from_slice(segment);
        self.transform()
    }

    /// Of a segment under the window, to `output`.
    pub(super) fn windowed(&mut self, segment: &[f64]) -> &[Complex<f64>] {
        self.input.copy_from_slice(segment);
        self.windowed_input()
    }

    /// Of what is in `input`, under the window, to `output`.
    pub(super) fn windowed_input(&mut self) -> &[Complex<f64>] {
        for (input, w) in self.input.iter_mut().zip(&self.window) {
            *input *= w;
        }
        self.transform()
    }

    fn transform(&mut self) -> &[Complex<f64>] {
        self.fft
            .process_with_scratch(&mut self.input, &mut self.output, &mut self.scratch)
            .expect("buffers were made by the plan");
        &self.output
    }
}

/// Mean of the power spectra of segments.
pub(super) struct PowerAverage {
    power: Vec<f64>,
    pub(super) segments: usize,
}

impl PowerAverage {
    /// For segments of `length` samples.
    pub(super) fn new(length: usize) -> Self {
        PowerAverage { power: vec![0.0; length / 2 + 1], segments: 0 }
    }

    /// Takes the transform of a segment under its window.
    pub(super) fn add(&mut self, transform: &[Complex<f64>]) {
        for (power, value) in self.power.iter_mut().zip(transform) {
            *power += value.norm_sqr();
        }
        self.segments += 1;
    }

    /// Of segments under the window `w` that begin `step` samples apart.
    fn degrees_of_freedom(&self, w: &[f64], step: usize) -> f64 {
        let count = self.segments as f64;
        let energy: f64 = w.iter().map(|w| w * w).sum();
        let mut correlated = 0.0;
        for j in 1..self.segments.min(w.len().div_ceil(step.max(1))) {
            let shared: f64 = w.iter().zip(&w[j * step..]).map(|(a, b)| a * b).sum();
            correlated += (1.0 - j as f64 / count) * (shared / energy).powi(2);
        }
        2.0 * count / (1.0 + 2.0 * correlated)
    }

    /// The spectrum of what was sampled at `fs` Hz, cut into segments `step` samples apart, each under the window `w`.
    pub(super) fn finish(&self, fs: f64, w: &[f64], step: usize) -> Spectrum {
        let length = w.len();
        let sum: f64 = w.iter().sum();
        let sum_of_squares: f64 = w.iter().map(|w| w * w).sum();
        let count = self.segments as f64;
        let alone = |k: usize| k == 0 || 2 * k == length;
        let scaled = |scale: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
            (self.power.iter().enumerate())
                .map(|(k, power)| scale(power / count, if alone(k) { 1.0 } else { 2.0 }))
                .collect()
        };
        Spectrum {
            frequency_step: fs / length as f64,
            amplitude: scaled(&|power, sides| sides * power.sqrt() / sum),
            density: scaled(&|power, sides| sides * power / (fs * sum_of_squares)),
            segment_length: length,
            segments: self.segments,
            noise_bandwidth: fs * sum_of_squares / (sum * sum),
            degrees_of_freedom: self.degrees_of_freedom(w, step),
        }
    }
}

/// The periodic Hann window.
pub(super) fn hann(length: usize) -> Vec<f64> {
    Window::Hann.periodic(length)
}

#[cfg(test)]
mod tests {
    use super::super::psd::{Segments, psd};
    use super::super::test_signals::{Noise, cosine};
    use super::super::{Band, StreamSpectra};
    use super::*;

    const FS: f64 = 25_600.0;

    fn whole(x: &[f64], fs: f64) -> Spectrum {
        psd(x, fs, &Segments::of(x.len())).unwrap()
    }

    fn welch(x: &[f64], length: usize) -> Spectrum {
        let spectra = StreamSpectra::of(x, FS, length, Band::above(0.0), &[]);
        spectra.spectrum.unwrap()
    }

    #[test]
    fn analytic_sine_on_a_bin_shows_its_amplitude() {
        let spectrum = welch(&cosine(10_240, FS, 250.0, 3.0, 0.7), 2048);
        assert_eq!(spectrum.segments, 9);
        assert_eq!(spectrum.frequency_step, 12.5);
        assert!((spectrum.amplitude[20] - 3.0).abs() < 1e-12);
        // Hann: half the amplitude in the neighbours, nothing beyond.
        assert!((spectrum.amplitude[19] - 1.5).abs() < 1e-12);
        assert!(spectrum.amplitude.iter().enumerate().all(|(k, a)| k.abs_diff(20) < 2 || *a < 1e-11));
        assert!((spectrum.noise_bandwidth - 1.5 * 12.5).abs() < 1e-12);
        // Mean square A^2 / 2 over the three bins of the density.
        assert!((spectrum.band_rms(230.0, 270.0) - 3.0 / 2f64.sqrt()).abs() < 1e-12);
        assert!(spectrum.band_rms(270.0, 230.0).is_sign_positive());
    }

    #[test]
    fn analytic_mean_and_nyquist_are_not_doubled() {
        let x: Vec<f64> = (0..256).map(|i| if i % 2 == 0 { 5.0 } else { 1.0 }).collect();
        let spectrum = whole(&x, FS);
        assert!((spectrum.amplitude[0] - 3.0).abs() < 1e-13);
        assert!((spectrum.amplitude[128] - 2.0).abs() < 1e-13);
        assert_eq!(spectrum.amplitude.len(), 129);
    }

    #[test]
    fn analytic_peak_between_bins() {
        let (mut worst_frequency, mut worst_amplitude): (f64, f64) = (0.0, 0.0);
        for i in -10..=10 {
            let bin = 100.0 + 0.05 * f64::from(i);
            let x = cosine(4096, 4096.0, bin, 2.0, 0.3);
            let peak = peak_near(&whole(&x, 4096.0), 99.0, 3.0).unwrap();
            worst_frequency = worst_frequency.max((peak.frequency - bin).abs());
            worst_amplitude = worst_amplitude.max((peak.amplitude / 2.0 - 1.0).abs());
        }
        assert!(worst_frequency < 3e-4 && worst_amplitude < 1.2e-3, "{worst_frequency} {worst_amplitude}");
    }

    #[test]
    fn prop_skirt_is_not_a_line() {
        let x = cosine(4096, 4096.0, 100.3, 1.0, 0.0);
        let spectrum = whole(&x, 4096.0);
        assert_eq!(peak_near(&spectrum, 105.0, 3.0), None);
        assert!(peak_near(&spectrum, 105.0, 5.0).is_some());
        assert_eq!(peak_near(&spectrum, 1e6, 5.0), None);
        assert_eq!(peak_near(&spectrum, -50.0, 5.0), None);
    }

    #[test]
    fn prop_stream_is_the_slice() {
        let x = Noise::new(11).normals(5000);
        for length in [512, 1022] {
            assert_eq!(welch(&x, length), psd(&x, FS, &Segments::of(length)).unwrap());
        }
    }

    #[test]
    fn prop_short_run_is_one_segment_of_its_own_length() {
        let x = Noise::new(13).normals(1000);
        assert_eq!(welch(&x, 1024), whole(&x, FS));
        assert_eq!(welch(&x, 1000), whole(&x, FS));
        // An incomplete last segment changes nothing.
        assert_eq!(welch(&x[..999], 400), welch(&x[..800], 400));
        assert_ne!(welch(&x, 400), welch(&x[..800], 400));
        let none = StreamSpectra::of(&[], FS, 64, Band::above(0.0), &[]);
        assert!(none.spectrum.is_none() && none.envelope.is_none());
    }
}
