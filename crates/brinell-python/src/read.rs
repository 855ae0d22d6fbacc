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
        let words = |error: brinell_io::IoError| error.to_string();
        let mut file = brinell_io::open(&path).map_err(words)?;
        let (name, about) = match channel {
            Some(text) => file.named(&text).map_err(|why| format!("channel {text}: {why}"))?,
            None => file.only_signal().map(|c| (c.name.clone(), c.clone())).map_err(words)?,
        };
        let values = file.read(&name).map_err(words)?;
        Ok((name, values, about))
    });
    let (name, values, about) = read.map_err(|words: String| ReadError::new_err(words))?;
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
