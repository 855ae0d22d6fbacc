//! A warning, and a number in it.

use crate::document::{Problem, unit_of_key};
use crate::signal;

/// How the warning of a bearing without load begins.
pub(super) const NO_LOAD: &str = "there is neither load nor weight";
/// Share of the load beyond which a weight that is left out is worth a warning.
pub(super) const WEIGHT_SHARE: f64 = 0.1;

pub(super) fn warning(key: &str, value: String, message: String, allowed: impl Into<String>) -> Problem {
    Problem::warning(key, message).value(value).allowed(allowed).unit(unit_of_key(key))
}

/// A number in a message.
pub(super) fn short(x: f64) -> String {
    signal::short(x, 3)
}
