//! Why there is no analysis.

use crate::SignalError;

/// What is wrong with the signal, or with what was asked of it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum AnalysisError {
    /// The sample rate leaves no room for the defect frequencies.
    #[error(
        "sampled at {rate_hz} Hz the signal holds nothing above {:.1} Hz, and {name} lies at {frequency_hz:.1} Hz: \
         it takes {needed_hz:.0} Hz or more for two of its harmonics in an envelope", rate_hz / 2.0
    )]
    RateTooLow {
        /// Sample rate, Hz.
        rate_hz: f64,
        /// The defect frequency that does not fit.
        name: &'static str,
        /// Its value, Hz.
        frequency_hz: f64,
        /// The least that would do, Hz.
        needed_hz: f64,
    },
    /// No vibration.
    #[error("its values only {0}, sample after sample: a column of times, or a counter, and no vibration")]
    OneWay(&'static str),
    /// One of several records.
    #[error("record {number}: {why}")]
    InRecord {
        /// Which, counted from 1.
        number: usize,
        /// What is wrong with it.
        why: Box<AnalysisError>,
    },
    /// Too few revolutions.
    #[error(
        "{seconds:.4} s are {revolutions:.2} revolutions of the shaft; it takes {} s or more, {FEWEST_REVOLUTIONS} revolutions",
        plain(*needed_s)
    )]
    TooShort {
        /// Length of the signal, s.
        seconds: f64,
        /// The same in revolutions.
        revolutions: f64,
        /// Length needed, s.
        needed_s: f64,
    },
    /// A defect frequency that no rolling bearing has.
    #[error(
        "{name} of {order:.4} times the shaft's frequency: expected {least} to {most} times for a rolling bearing whose outer ring rests"
    )]
    Order {
        /// BPFO, BPFI, BSF or FTF.
        name: &'static str,
        /// Over the shaft's.
        order: f64,
        /// The least possible.
        least: f64,
        /// The most.
        most: f64,
    },
    /// Frequencies of two raceways that exchange their places.
    #[error(
        "BPFO {bpfo:.4}x and BPFI {bpfi:.4}x: {}",
        if bpfo == bpfi { "elements pass both races alike, as in a thrust bearing, and no line tells which of them is damaged; give --bpfo and --bsf for what can be told" }
        else { "expected the inner race to be passed more often than the outer, which rests" }
    )]
    Passes {
        /// Over the shaft's.
        bpfo: f64,
        /// Over the shaft's.
        bpfi: f64,
    },
    /// Samples that are not numbers.
    #[error("{count} of {samples} samples are missing or infinite, the first at sample {first} (counted from 1)")]
    NotFinite {
        /// How many.
        count: usize,
        /// Of how many.
        samples: usize,
        /// The first, counted from 1.
        first: usize,
    },
    /// A signal so large or so small that its fourth powers leave a double's range.
    #[error("its largest value is {largest:e}: expected 1e-60 to 1e60; is the unit right?")]
    Scale {
        /// Largest absolute value, in the signal's unit.
        largest: f64,
    },
    /// A signal that never changes.
    #[error("{} {value}: a constant is no vibration", all(*samples))]
    Constant {
        /// Samples.
        samples: usize,
        /// Their value.
        value: f64,
    },
    /// A band to demodulate whose envelope cannot hold the lines sought.
    #[error(
        "the band to demodulate is {width_hz:.1} Hz wide: expected {needed_hz:.1} Hz or more, for two harmonics \
         of the highest defect frequency in its envelope"
    )]
    BandTooNarrow {
        /// Its width below half the sample rate, Hz.
        width_hz: f64,
        /// The least that would do, Hz.
        needed_hz: f64,
    },
    /// A band to demodulate that reaches beyond what the signal holds.
    #[error("the band to demodulate ends at {high_hz} Hz: expected at most {most_hz} Hz, half the sample rate")]
    BandTooHigh {
        /// Its upper edge, Hz.
        high_hz: f64,
        /// Half the sample rate, Hz.
        most_hz: f64,
    },
    /// A unit that nobody knows.
    #[error("no unit is called `{spelling}`; known are {known}")]
    UnknownUnit {
        /// As it was given.
        spelling: String,
        /// Those that are known.
        known: &'static str,
    },
    /// No sensitivity.
    #[error("`{text}`: expected a sensor's output for one unit of vibration, with both units, such as {forms}")]
    NoSensitivity {
        /// As it was given.
        text: String,
        /// Spellings that are taken.
        forms: &'static str,
    },
    /// No full scale.
    #[error("`{text}`: expected what the largest number means, with its unit, such as 5V, 500mV or 10g")]
    NoFullScale {
        /// As it was given.
        text: String,
    },
    /// A parameter out of its range.
    #[error(transparent)]
    Signal(#[from] SignalError),
}

/// Fourth powers of larger values, and of the inverse of smaller ones, leave a double's range.
pub(super) const LARGEST: f64 = 1e60;

/// Fewest revolutions that are analysed: below, neighbouring defect frequencies can hardly be told apart.
pub const FEWEST_REVOLUTIONS: f64 = 8.0;

pub(super) fn out_of_range(name: &'static str, value: f64, range: &'static str) -> AnalysisError {
    SignalError::OutOfRange { name, value, range }.into()
}

/// A time, s: without the hundreds of digits of one that no record has.
fn plain(seconds: f64) -> String {
    if seconds < 1e9 { format!("{seconds:.4}") } else { format!("{seconds:.1e}") }
}

/// Samples that are one value, with their verb.
fn all(samples: usize) -> String {
    if samples == 1 { "the only sample is".into() } else { format!("all {samples} samples are") }
}
