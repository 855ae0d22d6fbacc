//! brinell for Python.
use pyo3::prelude::*;

#[pymodule]
fn _brinell(_m: &Bound<'_, PyModule>) -> PyResult<()> {
    Ok(())
}
