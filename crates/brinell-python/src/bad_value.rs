//! The exception of an argument that is wrong.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::fmt::Display;

/// `python` has no errors for what a user gets wrong: these are its own, in the command's words.
pub(crate) fn bad_value(words: impl Display) -> PyErr {
    PyValueError::new_err(words.to_string())
}
