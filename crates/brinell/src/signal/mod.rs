//! Signals: what a data logger would hold, and what an analyst reads off it.
//!
//! [`decimate`] is the anti-alias chain of the measured channels, [`indicators`] the condition indicators with their
//! scatter, [`spectrum`] amplitude spectra and power spectral densities, [`mod@envelope`] the envelope spectrum, and
//! [`frequency`] the precise repetition frequency of a train of impacts.
//!
//! All values are SI: time in s, frequency in Hz, and a signal in its own unit (m/s^2 for an acceleration), here
//! written "unit". Everything that follows a run takes one sample at a time and holds a bounded amount of memory,
//! however long the run is; nothing is allocated per sample. Results do not depend on the number of threads: there
//! is only one. The FFT chooses its instructions by processor, so between processors spectra may differ in the last
//! bits; decimated channels and indicators use plain arithmetic and do not.

pub mod decimate;
pub mod envelope;
pub mod frequency;
pub mod indicators;
pub mod spectrum;

#[cfg(test)]
mod test_signals;

pub use decimate::{Decimator, kaiser_lowpass};
pub use envelope::{Band, EnvelopeSpectrum, EnvelopeWelch, envelope};
pub use frequency::{LineFrequency, LineSearch, LineTracker, line_frequency};
pub use indicators::{Blocks, Estimate, Indicator, Interval, Moments, student_t_quantile};
pub use spectrum::{Peak, Spectrum, Welch, amplitude_spectrum, peak_near};
