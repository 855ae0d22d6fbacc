//! The `brinell` command of a wheel.

use pyo3::prelude::*;
use std::ffi::OsString;

/// Runs the command with these arguments, the first of which is the program's name; its exit code. `again` are the words that start this
/// very command again. For a process of its own.
#[pyfunction]
pub(crate) fn command(py: Python<'_>, args: Vec<OsString>, again: Vec<OsString>) -> u8 {
    brinell_cli::started_by(again);
    py.detach(|| brinell_cli::run(args))
}
