//! The exception of an argument that is wrong.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::fmt::Display;

/// `python` has no errors for what a user gets wrong: these are its own, in the command's words.
pub(crate) fn bad_value(words: impl Display) -> PyErr {
    PyValueError::new_err(words.to_string())
}

/// A whole number from 0 as Rust has it; `name` is what users call it.
pub(crate) fn from_zero<T: TryFrom<i128>>(name: &str, value: i128) -> PyResult<T> {
    T::try_from(value).map_err(|_| {
        let allowed = if value < 0 { "0 or more" } else { "less" };
        bad_value(format!("{name} = {value}\n  allowed: {allowed}"))
    })
}
