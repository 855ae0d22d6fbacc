//! Exceptions, with the words of the command.

use crate::convert::json_to_python;
use brinell::Error as Failure;
use brinell::document::{Problem, Severity, render_diagnostics};
use pyo3::exceptions::{PyMemoryError, PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use serde_json::json;
use std::path::Path;

pyo3::create_exception!(
    brinell,
    ScenarioError,
    PyValueError,
    "A scenario that cannot run. ``problems`` lists what is wrong: key, value, message, allowed, unit, line."
);
pyo3::create_exception!(
    brinell,
    RunError,
    PyRuntimeError,
    "A run that failed. ``partial`` holds what was computed until then, a `Result`."
);
pyo3::create_exception!(brinell, ReadError, PyOSError, "A file that cannot be read or written.");
pyo3::create_exception!(brinell, SignalError, PyValueError, "A signal that cannot be analysed as asked.");

/// A file that could not be opened, as the command says it.
pub(crate) fn unreadable(path: &Path, error: &std::io::Error) -> PyErr {
    ReadError::new_err(format!("cannot read {}: {}", path.display(), brinell_io::why_unread(error)))
}

/// What is wrong with a scenario; `seen` is the name and text of a file that its author can look at.
pub(crate) fn scenario_error(py: Python, problems: Vec<Problem>, seen: Option<(&str, &str)>) -> PyErr {
    let words = match seen {
        Some((name, text)) => render_diagnostics(name, text, &problems),
        None => {
            let texts: Vec<String> = problems.iter().map(ToString::to_string).collect();
            texts.join("\n")
        }
    };
    let list: Vec<_> = problems
        .iter()
        .map(|p| {
            json!({
                "severity": match p.severity { Severity::Error => "error", Severity::Warning => "warning" },
                "key": p.key, "value": p.value, "message": p.message, "allowed": p.allowed,
                "unit": p.unit, "line": p.line, "column": p.column,
            })
        })
        .collect();
    match json_to_python(py, &list.into()) {
        Ok(list) => with(py, ScenarioError::new_err(words), "problems", list.unbind()),
        Err(other) => other,
    }
}

/// A scenario that makes no model is a bad one; anything else is a run that failed, or too large a one.
pub(crate) fn run_error(py: Python, failure: &Failure) -> PyErr {
    match failure {
        Failure::TooLarge { .. } => PyMemoryError::new_err(failure.to_string()),
        _ if failure.is_bad_input() => {
            let empty = pyo3::types::PyList::empty(py).into_any().unbind();
            with(py, ScenarioError::new_err(failure.to_string()), "problems", empty)
        }
        _ => failed_run(py, failure.to_string()),
    }
}

/// A run that failed and left nothing.
pub(crate) fn failed_run(py: Python, words: String) -> PyErr {
    with(py, RunError::new_err(words), "partial", py.None())
}

fn with(py: Python, error: PyErr, name: &str, value: Py<PyAny>) -> PyErr {
    match error.value(py).setattr(name, value) {
        Ok(()) => error,
        Err(other) => other,
    }
}
