//! What can be wrong with a grid of settings, or with what is to be fitted.

/// Points of a plan at most: beyond that, a plan is a slip of the keyboard.
pub(super) const MOST_POINTS: usize = 100_000;

/// Why there is no plan.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PlanError {
    /// A value or a range that cannot be.
    #[error("{key} = {value}: {why}\n  allowed: {allowed}")]
    Value {
        /// The key.
        key: String,
        /// The value found.
        value: String,
        /// What is wrong with it.
        why: String,
        /// What would be accepted.
        allowed: String,
    },
    /// A text that is none, keys that do not go together, too many points: in words.
    #[error("{0}")]
    Refused(String),
}
