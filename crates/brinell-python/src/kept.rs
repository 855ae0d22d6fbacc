//! Journals: a sweep or a calibration keeps what is finished in its folder, and does not run it again.

use crate::bad_value::bad_value;
use crate::errors::ReadError;
use crate::scenario::Source;
use crate::wait::{Watch, attended, threads};
use brinell::scenario::Scenario;
use brinell_study::runner::{self, GridPoints, Kept, Ledger, RunnerError, Task, Work, to_run};
use pyo3::prelude::*;
use serde_json::Value;
use std::path::Path;

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

/// Makes the runs of the points that are not done; with a `folder` none is run again that is in its journal. Gives the
/// journal's points.
pub(crate) fn run(
    py: Python<'_>,
    (points, source): (&GridPoints, &Source),
    folder: Option<&Path>,
    jobs: Option<isize>,
    mut progress: impl FnMut(Python<'_>, usize) -> PyResult<()> + Send,
) -> PyResult<Kept> {
    let mut ledger = ledger(folder, &points.header())?;
    let tasks = to_run(points.tasks.iter().flatten(), |task| ledger.kept.row(&task.fingerprint).is_some());
    let threads = threads(jobs, tasks.len())?;
    let mut done = points.tasks.len() - tasks.len();
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
    Ok(ledger.kept)
}
