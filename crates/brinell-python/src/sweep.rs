//! A grid of settings, run side by side, as one table.

use crate::bad_value::bad_value;
use crate::convert::{array, json_to_python, python_to_toml};
use crate::errors::scenario_error;
use crate::kept::{self, Numbers};
use crate::scenario::{Scenario, Source};
use crate::wait::over_threads;
use brinell::document::{on_one_line, one_line};
use brinell::result::Quantity;
use brinell::simulate::Progress;
use brinell::simulate_with;
use brinell_study::campaign::{Axis, Plan, columns};
use pyo3::prelude::*;
use pyo3::types::PyList;
use std::path::PathBuf;

/// Runs every combination of the axes, each `(keys, settings)` with a value for each key in every setting. Gives for
/// each point which setting of each axis it has, and why it failed or None; and the columns: name, unit, values, NaN
/// where a run has none. `progress` gets the points done and how many there are. With a `folder`, finished points are
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
) -> PyResult<(Vec<Vec<usize>>, Vec<Option<String>>, Bound<'py, PyList>)> {
    // Said once, and not of every point.
    brinell::kernel::Kernel::chosen().map_err(bad_value)?;
    let axes = axes.into_iter().map(|(keys, settings)| {
        let texts = settings
            .iter()
            .map(|setting| setting.iter().map(python_to_toml).collect())
            .collect::<PyResult<Vec<Vec<String>>>>()?;
        Axis::new(keys, texts).map_err(bad_value)
    });
    let plan = Plan::new(axes.collect::<PyResult<_>>()?).map_err(bad_value)?;
    let total = plan.points();
    // A point that is bad is a row; where all are, the input is.
    let first_of_bad = || {
        let problems = |k: usize| scenario.source.with(&plan.settings(k)).load().err();
        let first = problems(0)?;
        (1..total).all(|k| problems(k).is_some()).then_some(first)
    };
    if let Some(problems) = py.detach(first_of_bad) {
        return Err(scenario_error(py, problems, None));
    }
    let show = |py: Python<'_>, done: usize| match &progress {
        Some(progress) => progress.call1(py, (done, total)).map(drop),
        None => Ok(()),
    };
    let results = match folder {
        Some(folder) => kept::run(py, (&plan, &scenario.source), &folder, jobs, show)?,
        None => in_memory(py, (&plan, &scenario.source), jobs, show)?,
    };
    let runs: Vec<&[Quantity]> = results.iter().map(|r| r.as_deref().unwrap_or_default()).collect();
    let list = PyList::empty(py);
    for column in columns(&runs) {
        let values = column.values.iter().map(|v| v.unwrap_or(f64::NAN));
        list.append((column.name, column.unit, array(py, values.collect())))?;
    }
    let places = (0..plan.points()).map(|k| plan.place(k)).collect();
    let reasons = results.iter().map(|r| r.as_ref().err().cloned()).collect();
    Ok((places, reasons, list))
}

/// Values of a key in the command's notation, `900:1800:450` or `5,10,20`.
#[pyfunction]
pub(crate) fn values<'py>(py: Python<'py>, key: &str, text: &str) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let axis = Axis::vary(&format!("{key}={text}")).map_err(bad_value)?;
    let value = |text: &String| {
        let toml: Option<serde_json::Value> = toml::from_str(&format!("value = {text}")).ok();
        // A bare word is a string.
        json_to_python(py, &toml.map_or_else(|| text.as_str().into(), |mut table| table["value"].take()))
    };
    axis.settings().iter().flatten().map(value).collect()
}

/// Of each point its numbers, or why there are none.
fn in_memory(
    py: Python<'_>,
    (plan, source): (&Plan, &Source),
    jobs: Option<isize>,
    mut progress: impl FnMut(Python<'_>, usize) -> PyResult<()> + Send,
) -> PyResult<Vec<Numbers>> {
    let mut results = vec![Err("not run".into()); plan.points()];
    let mut done = 0;
    over_threads(
        py,
        plan.points(),
        jobs,
        |k, stop| {
            let (loaded, _) = source.with(&plan.settings(k)).load().map_err(|problems| on_one_line(&problems))?;
            let mut progress = Progress(|_| brinell::many::go_on(stop));
            match simulate_with(&loaded.scenario, &mut progress) {
                Ok(result) => Ok(result.quantities()),
                Err(error) => Err(one_line(&error.to_string())),
            }
        },
        |py, k, result| {
            results[k] = result;
            done += 1;
            progress(py, done)
        },
    )?;
    Ok(results)
}
