//! Signals: what a data logger would hold, and what an analyst reads off it.
//!
//! Following a run, sample by sample: [`mod@decimate`] is the anti-alias chain of the measured channels, [`blocks`]
//! the condition [`indicators`] with their intervals, which rest on [`mod@scatter`], [`mod@ratio`] how those of two runs compare, and [`stream`] the spectra: [`spectrum`] amplitudes and
//! power spectral densities, [`mod@envelope`] the envelope's, and [`frequency`] the precise repetition frequency of a train of impacts.
//! These hold a bounded amount of memory, however long the run is; nothing is allocated per sample.
//!
//! Of a signal held as a slice, with its sample rate in Hz: [`window`], [`mod@psd`] (Welch with any window),
//! [`mod@spectrogram`], [`mod@kurtogram`] (which band to demodulate), [`order`] (varying speed), [`filter`] and
//! [`mod@fir`] (zero phase), [`integrate`] (acceleration to velocity), [`mod@velocity_bands`], [`lines`] (harmonics over the local noise),
//! [`double_impulse`] (entry and exit of a defect, and the length that they imply), and [`distribution`] (what powers
//! of noise follow). They return [`SignalError`] for input that they cannot use, and do not panic.
//!
//! All values are SI: time in s, frequency in Hz, and a signal in its own unit (m/s^2 for an acceleration), here
//! written "unit". Results do not depend on the number of threads: there is only one. The FFT chooses its instructions by processor, so between processors spectra may differ in the last
//! bits; decimated channels and indicators use plain arithmetic and do not.

pub mod blocks;
pub mod decimate;
pub mod distribution;
pub mod double_impulse;
pub mod envelope;
mod error;
pub mod filter;
pub mod fir;
pub mod frequency;
pub mod indicators;
pub mod integrate;
mod interleaved;
pub mod kurtogram;
pub(crate) mod lengths;
pub mod lines;
pub mod order;
pub mod psd;
pub mod ratio;
pub mod scatter;
pub mod series;
pub mod spectrogram;
pub mod spectrum;
pub mod stream;
pub mod transformed;
pub mod velocity_bands;
pub mod window;

#[cfg(test)]
pub(crate) mod test_signals;

pub use blocks::{Blocks, Estimate, Interval, RECORD_PEAK, RECORD_PEAK_TO_PEAK};
pub use decimate::{Decimator, decimate, kaiser_lowpass};
pub use double_impulse::{
    DefectLength, Events, Separation, SeparationSearch, consensus, defect_length, separations,
};
pub use envelope::{Band, EnvelopeSpectrum, envelope, envelope_spectrum};
pub use error::SignalError;
pub use filter::{Butterworth, Passband, Section};
pub use fir::{convolve, fir};
pub use frequency::{LineFrequency, LineSearch, line_frequency};
pub use indicators::{Indicator, Moments};
pub use integrate::{band_pass, velocity, velocity_trapezoid};
pub use kurtogram::{Kurtogram, KurtogramBand, kurtogram};
pub use lines::{Line, LineSet, harmonics};
pub use order::{Angular, Rotation, order_spectrum, resample};
pub use psd::{Detrend, Segments, density_interval, psd};
pub use scatter::{Scatter, scatter, student_t_quantile};
pub use series::{Averages, MOST_BLOCKS};
pub use spectrogram::{Spectrogram, spectrogram};
pub use spectrum::{Peak, Spectrum, amplitude_spectrum, peak_near};
pub use stream::{Spectra, StreamSpectra};
pub use transformed::{Thinned, Transformed};
pub use velocity_bands::{VelocityBands, velocity_bands, velocity_rms};
pub use window::Window;
