//! What can be wrong with a grid of settings.

/// Points of a plan at most: beyond that, a plan is a slip of the keyboard.
pub(super) const MOST_POINTS: usize = 100_000;

/// Why there is no plan.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PlanError {
    /// A text that is no axis.
    #[error("`{text}`: expected {expected}")]
    Syntax {
        /// The text.
        text: String,
        /// What it should be.
        expected: String,
    },
    /// A value or a range that cannot be.
    #[error("{key} = {value}: {why}\n  allowed: {allowed}")]
    Value {
        /// The key that varies.
        key: String,
        /// The value found.
        value: String,
        /// What is wrong with it.
        why: String,
        /// What would be accepted.
        allowed: String,
    },
    /// Two keys that do not go together.
    #[error("{first} and {second} {why}")]
    Keys {
        /// One key.
        first: String,
        /// The other.
        second: String,
        /// What is wrong with them.
        why: String,
    },
    /// One key on two axes.
    #[error("{0} varies twice; each key varies in one place")]
    Twice(String),
    /// More points than 100 000.
    #[error("{points} points\n  allowed: 1 to {MOST_POINTS} points")]
    TooMany {
        /// Points requested.
        points: u128,
    },
}
