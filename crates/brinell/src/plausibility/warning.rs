//! A warning, and a number in it.

use crate::document::{Problem, Severity, unit_of_key};

pub(super) fn warning(key: &str, value: String, message: String, allowed: impl Into<String>) -> Problem {
    Problem::new(Severity::Warning, key, message).value(value).allowed(allowed).unit(unit_of_key(key))
}

/// A number in a message.
pub(super) fn short(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let exponent = x.abs().log10().floor() as i32;
    if !(-4..6).contains(&exponent) {
        return format!("{x:.2e}");
    }
    let decimals = (2 - exponent).max(0) as usize;
    format!("{x:.decimals$}")
}
