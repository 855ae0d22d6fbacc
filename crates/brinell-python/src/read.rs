//! Measured signals from files.

use crate::bad_value::bad_value;
use crate::convert::array;
use crate::errors::ReadError;
use brinell_io::{Channel, IoError, SignalFile};
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
        let words = |error: IoError| error.to_string();
        let mut file = brinell_io::open(&path).map_err(words)?;
        let (name, about) = match channel {
            Some(text) => file.named(&text).map_err(|why| format!("channel {text}: {why}"))?,
            None => only_signal(&file).map(|c| (c.name.clone(), c.clone())).map_err(words)?,
        };
        let rate = rate_of(&mut file, &about).map_err(words)?;
        let values = file.read(&name).map_err(words)?;
        Ok((name, values, (rate, about.unit)))
    });
    let (name, values, (rate, unit)) = read.map_err(|words: String| ReadError::new_err(words))?;
    if values.is_empty() {
        return Err(bad_value(format!("{}: `{name}` holds no values", path.display())));
    }
    let dict = PyDict::new(py);
    dict.set_item("channel", name)?;
    dict.set_item("values", array(py, values))?;
    dict.set_item("rate_hz", rate)?;
    dict.set_item("unit", unit)?;
    Ok(dict)
}

/// The only channel that is no times, as the command takes it.
fn only_signal(file: &SignalFile) -> Result<&Channel, IoError> {
    let signals = || file.channels().iter().filter(|c| c.may_be_signal() && !c.is_time() && !c.is_matrix());
    match (signals().next(), signals().nth(1)) {
        (Some(only), None) => Ok(only),
        _ => file.only_signal(),
    }
}

/// The rate that the file states, or that its times give, Hz.
fn rate_of(file: &mut SignalFile, channel: &Channel) -> Result<Option<f64>, IoError> {
    if let Some((hz, _)) = channel.stated_rate() {
        return Ok(Some(hz));
    }
    let time = file.times_of(channel).ok().flatten();
    match time.and_then(|time| Some((time.seconds_in_unit()?, time.name))) {
        Some((seconds, name)) => Ok(file.rate_of(&name, seconds)?.ok()),
        None => Ok(None),
    }
}
