//! Why an analysis of a slice gave nothing.

/// What is wrong with a signal or with what was asked of it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SignalError {
    /// Fewer samples than the analysis needs.
    #[error("{have} samples, fewer than the {need} that {what} needs")]
    TooShort {
        /// What was requested.
        what: &'static str,
        /// Samples given.
        have: usize,
        /// Samples needed.
        need: usize,
    },
    /// A sample that is infinite or not a number.
    #[error("sample {} is not finite (counted from 1)", index + 1)]
    NotFinite {
        /// The first such sample, from 0.
        index: usize,
    },
    /// A signal without any variation where the analysis needs some.
    #[error("the signal is constant: {what} is not defined")]
    Constant {
        /// What was requested.
        what: &'static str,
    },
    /// A parameter out of its range.
    #[error("{name} = {value} is outside its range: {range}")]
    OutOfRange {
        /// Parameter.
        name: &'static str,
        /// Value given.
        value: f64,
        /// Allowed range, in words.
        range: &'static str,
    },
}

/// That `x` has at least `need` samples, all finite, and that the sample rate is a positive number.
pub(super) fn check(x: &[f64], fs: f64, need: usize, what: &'static str) -> Result<(), SignalError> {
    require(fs > 0.0 && fs.is_finite(), "sample rate (Hz)", fs, "above 0")?;
    if x.len() < need {
        return Err(SignalError::TooShort { what, have: x.len(), need });
    }
    match x.iter().position(|v| !v.is_finite()) {
        Some(index) => Err(SignalError::NotFinite { index }),
        None => Ok(()),
    }
}

/// That squares of sums of the samples are numbers, of up to 1e10 samples.
pub(super) fn check_squares(x: &[f64]) -> Result<(), SignalError> {
    let power = x.iter().fold(0.0, |most: f64, v| most.max(v.abs())).log10().floor();
    require(power < 140.0, "power of ten of the largest sample", power, "below 140, as squares overflow")
}

/// An error unless `holds`.
pub(super) fn require(holds: bool, name: &'static str, value: f64, range: &'static str) -> Result<(), SignalError> {
    if holds { Ok(()) } else { Err(SignalError::OutOfRange { name, value, range }) }
}
