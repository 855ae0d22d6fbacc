//! Why there is nothing to fit.

use crate::campaign::PlanError;
use brinell::result::UnknownName;
use brinell::signal::SignalError;

/// What is wrong with keys, targets or a measured signal.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CalibrateError {
    /// A text that is no key with bounds, or no target; a bound, value or uncertainty that cannot be; what comes twice.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// Nothing to meet.
    #[error("there is no target")]
    NoTarget,
    /// A target that no run has.
    #[error(transparent)]
    Name(#[from] UnknownName),
    /// Too few runs.
    #[error("expected {least} runs or more for {keys} key{}: a start, and two runs a key for its uncertainty", if *.keys == 1 { "" } else { "s" })]
    Budget {
        /// Runs that may be made.
        budget: usize,
        /// Fewest for the keys.
        least: usize,
        /// How many keys.
        keys: usize,
    },
    /// What levels of the model may differ by, per cent.
    #[error("expected more than 0 to 100 per cent")]
    ModelUncertainty(f64),
    /// No axis of the sensor.
    #[error("axis {0}: expected x or y")]
    Axis(String),
    /// A measured signal for a speed that varies.
    #[error("the scenario's speed is not constant, and defect frequencies are looked for at one speed")]
    Speed,
    /// A measured signal in this unit.
    #[error("is in {0}; a calibration takes accelerations")]
    NoAcceleration(String),
    /// A measured signal at another rate.
    #[error("is sampled at {measured} Hz, and the scenario at {simulated} Hz; levels are compared at one rate")]
    Rate {
        /// Of the signal, Hz.
        measured: f64,
        /// Of the scenario, Hz.
        simulated: f64,
    },
    /// A measured signal that is to be met by its events alone, with what was seen of them.
    #[error("there are no two events in each pass to fit to: {0}")]
    NoEvents(String),
    /// A measured signal that says nothing.
    #[error(transparent)]
    Signal(#[from] SignalError),
}
