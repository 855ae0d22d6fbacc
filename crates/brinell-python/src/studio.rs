//! The studio's engine, and the files of its page.

use brinell_studio::SharedStudio;
use brinell_studio_page::PAGE;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyList};

/// Bearings that run while their scenario is edited: A and B.
#[pyclass(frozen, module = "brinell._brinell")]
pub(crate) struct StudioEngine {
    studio: SharedStudio,
}

#[pymethods]
impl StudioEngine {
    /// Without a bearing.
    #[new]
    fn new() -> Self {
        Self { studio: SharedStudio::default() }
    }

    /// Answers one message; `messages.md` of `crates/brinell-studio` says what they hold.
    fn ask<'py>(&self, py: Python<'py>, request: &[u8]) -> Bound<'py, PyBytes> {
        let answer = py.detach(|| self.studio.ask(request));
        PyBytes::new(py, &answer)
    }
}

/// Files of the page: path, type, content. The first is the page itself.
#[pyfunction]
pub(crate) fn studio_page(py: Python<'_>) -> PyResult<Bound<'_, PyList>> {
    let files = PAGE.iter();
    PyList::new(py, files.map(|(name, kind, bytes)| (*name, *kind, PyBytes::new(py, bytes))))
}
