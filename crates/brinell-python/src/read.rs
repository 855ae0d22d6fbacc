//! Measured signals from files.

use crate::bad_value::bad_value;
use crate::convert::array;
use crate::errors::ReadError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;

/// One channel of a file: values, and the rate and unit that the file states.
#[pyfunction]
pub(crate) fn read_signal<'py>(
    py: Python<'py>,
    path: PathBuf,
    channel: Option<String>,
) -> PyResult<Bound<'py, PyDict>> {
    let read = py.detach(|| {
        let mut file = brinell_io::open(&path)?;
        let name = match channel {
            Some(name) => name,
            None => file.only_signal()?.name.clone(),
        };
        let values = file.read(&name)?;
        let about = file.channels().iter().find(|c| c.name == name).cloned();
        Ok((name, values, about.unwrap_or_default()))
    });
    let (name, values, about) = read.map_err(|error: brinell_io::IoError| ReadError::new_err(error.to_string()))?;
    if values.is_empty() {
        return Err(bad_value(format!("{}: `{name}` holds no values", path.display())));
    }
    let dict = PyDict::new(py);
    dict.set_item("channel", name)?;
    dict.set_item("values", array(py, values))?;
    dict.set_item("rate_hz", about.rate.map(|rate| rate.hz))?;
    dict.set_item("unit", about.unit)?;
    Ok(dict)
}
