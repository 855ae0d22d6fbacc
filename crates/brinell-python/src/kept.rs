//! Journals: a sweep or a calibration keeps what is finished in its folder, and does not run it again.

use crate::bad_value::bad_value;
use crate::errors::ReadError;
use crate::scenario::Source;
use crate::wait::{Watch, attended, threads};
use brinell::document::one_line;
use brinell::result::Quantity;
use brinell::scenario::Scenario;
use brinell_study::campaign::Plan;
use brinell_study::runner::{self, Ledger, RunnerError, Task, Work, to_run};
use pyo3::prelude::*;
use serde_json::Value;
use std::path::Path;

/// A point's numbers with what they should be warned of, or why there are none.
pub(crate) type Ran = Result<(Vec<Quantity>, Vec<String>), String>;

/// Scenarios of points, from the one that they change.
struct Points<'a>(&'a Source);

impl Work for Points<'_> {
    type Error = RunnerError;

    fn scenario(&self, task: &Task) -> Result<Scenario, RunnerError> {
        let loaded = self.0.with(&task.settings).load();
        loaded.map(|(loaded, _)| loaded.scenario).map_err(|_| RunnerError::Changed)
    }
}

pub(crate) fn refused(folder: Option<&Path>, error: RunnerError) -> PyErr {
    match (error, folder) {
        (RunnerError::Io(error), _) => ReadError::new_err(error.to_string()),
        (error, Some(folder)) => bad_value(format!("{}: {error}", folder.display())),
        (error, None) => bad_value(error),
    }
}

/// A folder's journal, opened or begun; without a folder, of this call alone.
pub(crate) fn ledger(folder: Option<&Path>, header: &Value) -> PyResult<Ledger> {
    let Some(folder) = folder else {
        return Ok(Ledger::default());
    };
    std::fs::create_dir_all(folder)
        .map_err(|error| ReadError::new_err(format!("cannot make {}: {error}", folder.display())))?;
    Ledger::open(folder, header, false).map_err(|error| refused(Some(folder), error))
}

/// Of each point its numbers, or why there are none; with a `folder` none is run again that is in its journal.
pub(crate) fn run(
    py: Python<'_>,
    (plan, source): (&Plan, &Source),
    points: Vec<Result<Task, String>>,
    folder: Option<&Path>,
    jobs: Option<isize>,
    mut progress: impl FnMut(Python<'_>, usize) -> PyResult<()> + Send,
) -> PyResult<Vec<Ran>> {
    let prints = points.iter().map(|p| p.as_ref().ok().map(|t| &*t.fingerprint));
    let mut ledger = ledger(folder, &plan.header(prints))?;
    let tasks = to_run(points.iter().flatten(), |task| ledger.kept.row(&task.fingerprint).is_some());
    let threads = threads(jobs, tasks.len())?;
    let mut done = plan.points() - tasks.len();
    progress(py, done)?;
    let (before, watch) = (done, Watch::default());
    let runs = || runner::run(&tasks, &Points(source), &mut ledger, threads, &watch);
    let tell = |py: Python<'_>, over: usize| {
        (done..before + over).try_for_each(|_| {
            done += 1;
            progress(py, done)
        })
    };
    attended(py, &watch, runs, tell)?.map(drop).map_err(|error| refused(folder, error))?;
    let result = |point: Result<Task, String>| {
        let row = ledger.kept.row(&point?.fingerprint).ok_or("not run")?;
        let numbers = row.result.clone().map_err(|reason| one_line(&reason))?;
        Ok((numbers, row.warnings.clone()))
    };
    Ok(points.into_iter().map(result).collect())
}
