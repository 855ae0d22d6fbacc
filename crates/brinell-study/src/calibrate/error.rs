//! Why there is nothing to fit.

use crate::campaign::INSIDE;

/// What is wrong with keys or targets.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum CalibrateError {
    /// A text that is no key with bounds, or no target.
    #[error("`{text}`: expected {expected}")]
    Syntax {
        /// The text.
        text: String,
        /// What it should be.
        expected: String,
    },
    /// A bound, value or uncertainty that cannot be.
    #[error("{name} = {value}: {why}\n  allowed: {allowed}")]
    Value {
        /// The key or the target.
        name: String,
        /// The value found.
        value: String,
        /// What is wrong with it.
        why: String,
        /// What would be accepted.
        allowed: String,
    },
    /// One key with two ranges.
    #[error("{0} is to be fitted twice; each key has one range")]
    Twice(String),
    /// Two keys of which one is part of the other.
    #[error("{0} and {1} {INSIDE}")]
    Inside(String, String),
    /// One target with two values.
    #[error("{0} is a target twice; each has one value")]
    TargetTwice(String),
    /// Nothing to fit.
    #[error("no key is to be fitted")]
    NoKey,
    /// Nothing to meet.
    #[error("there is no target")]
    NoTarget,
}
