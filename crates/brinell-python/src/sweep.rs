//! A grid of settings, run side by side, as one table.

use crate::bad_value::bad_value;
use crate::convert::{array, json_to_python, python_to_toml};
use crate::errors::scenario_error;
use crate::kept;
use crate::scenario::Scenario;
use crate::wait::{Watch, attended, threads};
use brinell::document::reading::text_in_unit_of;
use brinell::document::{Problem, on_one_line, one_line};
use brinell::result::Quantity;
use brinell_study::campaign::{Axis, Grid, columns};
use brinell_study::runner::{GridPoints, State};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyString};
use std::path::PathBuf;

/// Runs every combination of the axes, each `(keys, settings)` with a value for each key in every setting. Gives for
/// each point which setting of each axis it has, and why it failed or None; the columns: name, unit, values, NaN
/// where a run has none; and what the points should be warned of. `progress` gets the points done and how many there are. With a `folder`, finished points are
/// in its journal and not run again.
#[pyfunction]
#[expect(clippy::type_complexity, reason = "taken apart by the Python around it")]
pub(crate) fn sweep<'py>(
    py: Python<'py>,
    scenario: &Scenario,
    axes: Vec<(Vec<String>, Vec<Vec<Bound<'py, PyAny>>>)>,
    jobs: Option<isize>,
    progress: Option<Py<PyAny>>,
    folder: Option<PathBuf>,
) -> PyResult<(Vec<Vec<usize>>, Vec<Option<String>>, Bound<'py, PyList>, Vec<String>)> {
    // Said once, and not of every point.
    brinell::kernel::Kernel::chosen().map_err(bad_value)?;
    let axes = axes.into_iter().map(|(keys, settings)| {
        let texts = settings
            .iter()
            .map(|setting| setting.iter().zip(&keys).map(|(value, key)| python_to_toml(key, value)).collect())
            .collect::<PyResult<Vec<Vec<String>>>>()?;
        Axis::new(keys, texts).map_err(bad_value)
    });
    let grid = Grid::new(axes.collect::<PyResult<_>>()?).map_err(bad_value)?;
    let total = grid.points();
    let threads = threads(jobs, total)?;
    let load = |settings: &[(String, String)]| scenario.source.with(settings).load().map(|(loaded, _)| loaded);
    let words = |problems: &Vec<Problem>| on_one_line(problems);
    let read = attended(py, &Watch::default(), || GridPoints::read(grid, threads, load, words), |_, _| Ok(()))?;
    let points = read.map_err(|problems| scenario_error(py, problems, None))?;
    let show = |py: Python<'_>, done: usize| match &progress {
        Some(progress) => progress.call1(py, (done, total)).map(drop),
        None => Ok(()),
    };
    let kept = kept::run(py, (&points, &scenario.source), folder.as_deref(), jobs, show)?;
    let states = points.states(&kept);
    let warnings = [&points.warnings[..], &State::doubts(&states)].concat();
    let runs: Vec<&[Quantity]> = states.iter().map(State::numbers).collect();
    let list = PyList::empty(py);
    for column in columns(&runs) {
        let values = column.values.iter().map(|v| v.unwrap_or(f64::NAN));
        list.append((column.name, column.unit, array(py, values.collect())))?;
    }
    let places = (0..total).map(|k| points.grid.place(k)).collect();
    let reasons = states.iter().map(|state| state.failure().map(one_line)).collect();
    Ok((places, reasons, list, warnings))
}

/// Values of a key in the command's notation, `900:1800:450` or `5,10,20`.
#[pyfunction]
pub(crate) fn values<'py>(py: Python<'py>, key: &str, text: &str) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let axis = Axis::vary(&format!("{key}={text}")).map_err(bad_value)?;
    axis.settings().iter().flatten().map(|text| python_value(py, text)).collect()
}

/// A word that is a value of a key: a quantity as a number in the key's unit, any other word as it is.
#[pyfunction]
pub(crate) fn in_unit<'py>(py: Python<'py>, key: &str, word: &str) -> PyResult<Bound<'py, PyAny>> {
    let number = text_in_unit_of(key, &brinell::document::toml_quote(word));
    number.map_or_else(|| Ok(PyString::new(py, word).into_any()), |number| python_value(py, &number))
}

/// The value that a text in TOML is; a bare word is a string.
fn python_value<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    let toml: Option<serde_json::Value> = toml::from_str(&format!("value = {text}")).ok();
    json_to_python(py, &toml.map_or_else(|| text.into(), |mut table| table["value"].take()))
}
