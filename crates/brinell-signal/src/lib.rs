//! Signal processing and diagnosis of rolling bearings from vibration. Knows no simulator and no files.
//!
//! From a signal to an envelope spectrum to a verdict:
//!
//! ```
//! use brinell_signal::analysis::{NamedBearing, Options, Verdict, analyze};
//! use brinell_signal::{Band, Segments, envelope_spectrum, peak_near};
//!
//! // Two seconds at 12 kHz: impacts on the outer race, 3.585 a revolution at 30 Hz, ringing at 3 kHz.
//! let (fs, shaft) = (12_000.0, 30.0);
//! let x: Vec<f64> = (0..24_000)
//!     .map(|i| {
//!         let since = (f64::from(i) / fs) % (1.0 / (3.585 * shaft));
//!         (-since / 4e-4).exp() * (6.283 * 3000.0 * since).sin() + 1e-3 * f64::from(i * 7919 % 101)
//!     })
//!     .collect();
//!
//! // The envelope of the band around the resonance: its highest line is at the frequency of the impacts.
//! let envelope = envelope_spectrum(&x, fs, Band::between(2000.0, 4000.0), &Segments::of(12_000))?;
//! let line = peak_near(&envelope.spectrum, 3.585 * shaft, 2.0).unwrap();
//! assert!((line.frequency - 107.55).abs() < 0.5);
//!
//! // The same, judged: all defect frequencies with their harmonics and sidebands, over all bands.
//! let bearing = NamedBearing::find("6205-2RS").unwrap().orders();
//! let analysis = analyze(&x, fs, &Options::new(shaft, bearing))?;
//! assert_eq!(analysis.conclusion(), Verdict::Damage);
//! assert_eq!(analysis.causes().next().unwrap().name, "BPFO");
//! println!("{}", analysis.verdict());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What is here
//!
//! [`analysis`] takes one vibration signal to a verdict with its evidence.
//!
//! Following a signal, sample by sample: [`blocks`] gives the condition [`indicators`] with their intervals, which rest
//! on [`mod@scatter`], [`mod@ratio`] how those of two signals compare, and [`stream`] the spectra: [`spectrum`]
//! amplitudes and power spectral densities, [`mod@envelope`] the envelope's, and [`frequency`] the precise repetition
//! frequency of a train of impacts. These hold a bounded amount of memory, however long the signal is; nothing is
//! allocated per sample.
//!
//! Of a signal held as a slice, with its sample rate in Hz: [`window`], [`mod@psd`] (Welch with any window),
//! [`mod@envelope`], [`mod@spectrogram`], [`mod@kurtogram`] (which band to demodulate), [`order`] (varying speed), [`tacho`] (speed from pulses), [`decimate`] (its low-pass),
//! [`integrate`] (acceleration to velocity), [`mod@velocity_bands`], [`lines`] (harmonics over the local noise), and
//! [`distribution`] (what powers of noise follow). Functions of a signal return [`SignalError`] for input that
//! they cannot use, and do not panic; the few others that do say so, as [`kaiser_lowpass`] of edges out of order.
//!
//! All values are SI: time in s, frequency in Hz, and a signal in its own unit (m/s^2 for an acceleration), here
//! written "unit". Results do not depend on the number of threads; only [`analysis`] uses more than one. The FFT
//! chooses its instructions by processor, so between processors spectra may differ in the last bits;
//! indicators use plain arithmetic and do not.

#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]

pub mod analysis;
pub mod band;
pub mod blocks;
pub mod decimate;
mod digits;
pub mod distribution;
pub mod envelope;
mod error;
pub mod estimate;
pub mod events;
#[doc(hidden)]
pub mod fft;
pub mod frequency;
pub mod indicators;
pub mod integrate;
pub mod kurtogram;
pub(crate) mod lengths;
pub mod lines;
mod objects;
pub mod order;
pub mod parallel;
pub mod psd;
pub mod random;
pub mod ratio;
pub mod scatter;
pub mod series;
pub mod spectrogram;
pub mod spectrum;
pub mod stream;
pub mod tacho;
pub mod transformed;
pub mod trend;
pub mod velocity_bands;
pub mod window;

#[cfg(test)]
pub(crate) mod test_signals;

pub use band::Band;
pub use blocks::{Blocks, RECORD_CREST_FACTOR, RECORD_PEAK, RECORD_PEAK_TO_PEAK};
pub use decimate::kaiser_lowpass;
#[doc(hidden)]
pub use digits::{rounded, short};
pub use envelope::{EnvelopeSpectrum, envelope, envelope_spectrum};
pub use error::SignalError;
pub use estimate::{Estimate, InUnit, Interval, Written};
pub use events::{EventSpacing, event_spacing};
#[doc(hidden)]
pub use frequency::FEWEST_PERIODS;
pub use frequency::{LineFrequency, LineSearch, mean_rate_uncertainty};
pub use indicators::{Indicator, Moments};
pub use integrate::band_pass;
pub use kurtogram::{Kurtogram, KurtogramBand, kurtogram};
pub use lines::{Line, harmonics};
pub use order::{Angular, Rotation, resample};
pub use psd::{Detrend, Segments, psd};
pub use scatter::{Scatter, scatter, student_t_quantile};
pub use series::{Averages, MOST_BLOCKS};
pub use spectrogram::{Spectrogram, spectrogram};
pub use spectrum::{Peak, Spectrum, peak_near};
pub use stream::{Spectra, StreamSpectra, line_frequency};
pub use transformed::{Thinned, Transformed};
pub use velocity_bands::{VelocityBands, velocity_bands, velocity_rms};
pub use window::Window;
