//! Runs side by side.

use crate::bad_value::bad_value;
use crate::convert::{json_to_python, table};
use crate::run::Run;
use brinell::result::RunResult;
use brinell::simulate::End;
use brinell_report::{Page, beforehand, doubts, html};
use brinell_study::campaign::{self, Compared, Side, check_labels, sides_json, sides_table};
use pyo3::prelude::*;
use pyo3::types::PyList;

/// That runs of these names can be laid side by side, before any runs.
#[pyfunction]
pub(crate) fn check_names(names: Vec<String>) -> PyResult<()> {
    check_labels(&names).map_err(bad_value)
}

/// Every number of several runs, and its ratio to that of the first.
#[pyclass(frozen, module = "brinell._brinell")]
pub(crate) struct Comparison {
    sides: Vec<Side>,
    runs: Vec<Py<Run>>,
    compared: Vec<Compared>,
}

#[pymethods]
impl Comparison {
    /// Of runs by name, which came to their end.
    #[new]
    fn new(py: Python<'_>, runs: Vec<(String, Py<Run>)>) -> PyResult<Self> {
        let (names, runs): (Vec<String>, Vec<Py<Run>>) = runs.into_iter().unzip();
        check_names(names.clone())?;
        let partial = |run: &Py<Run>| run.get().finished.outcome.end != End::Complete;
        if let Some(k) = runs.iter().position(partial) {
            return Err(bad_value(format!("{}: the run did not come to its end", names[k])));
        }
        let side = |(label, run): (String, &Py<Run>)| Side { label, loaded: run.get().scenario.get().loaded.clone() };
        let sides = names.into_iter().zip(&runs).map(side).collect();
        let all = results(&runs);
        let compared = py.detach(|| campaign::compare(&all));
        Ok(Self { sides, runs, compared })
    }

    /// Columns of `compare.csv`: name, unit, cells.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        table(py, &sides_table(&self.sides, &self.compared, &[]))
    }

    /// What `compare.json` holds.
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        json_to_python(py, &sides_json(&self.sides, &self.compared, &self.warnings(&results(&self.runs))))
    }

    /// What `compare.html` holds.
    fn to_html(&self, py: Python<'_>) -> String {
        let all = results(&self.runs);
        py.detach(|| html(&Page::of_runs(&self.sides, &all, &self.compared, &[], self.warnings(&all))))
    }
}

impl Comparison {
    fn warnings(&self, runs: &[&RunResult]) -> Vec<String> {
        [beforehand(&self.sides), doubts(&self.sides, runs)].concat()
    }
}

fn results(runs: &[Py<Run>]) -> Vec<&RunResult> {
    runs.iter().map(|run| &run.get().finished).collect()
}
