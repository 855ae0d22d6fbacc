//! Data sets: a plan to files, alone or a share at a time.

use crate::bad_value::{bad_value, from_zero};
use crate::errors::{ReadError, scenario_error, unreadable};
use crate::wait::{Watch, attended, threads, unstoppable};
use brinell_study::dataset::{self, DatasetError, Shard};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

fn failed(py: Python, error: DatasetError) -> PyErr {
    match error {
        DatasetError::Document { name, text, problems } => scenario_error(py, problems, Some((&name, &text))),
        DatasetError::Refused(words) => bad_value(words),
        DatasetError::Read { path, error } => unreadable(&path, &error),
        error @ DatasetError::NoFolder { .. } => ReadError::new_err(error.to_string()),
        DatasetError::Io(error) => ReadError::new_err(error.to_string()),
    }
}

/// The index of one of `count` things, which are called `what`.
fn below(name: &str, index: i128, what: &str, count: usize) -> PyResult<usize> {
    let found = usize::try_from(index).ok().filter(|index| *index < count);
    found.ok_or_else(|| {
        let last = count.saturating_sub(1);
        bad_value(format!("{name} = {index}: no such {what}\n  allowed: 0 to {last}"))
    })
}

/// A plan with its base scenario, and what its author should know.
#[pyclass(frozen, module = "brinell._brinell", name = "Campaign")]
pub(crate) struct Campaign(dataset::Campaign, Vec<String>);

#[pymethods]
impl Campaign {
    /// Of a plan file; with `check`, every run is tried first. Ctrl-C is obeyed, and what is under way then ends on its
    /// own.
    #[staticmethod]
    fn open(py: Python, path: PathBuf, check: bool) -> PyResult<Self> {
        let stop = Arc::new(AtomicBool::new(false));
        let theirs = Arc::clone(&stop);
        let opened = unstoppable(py, move || {
            let campaign = dataset::Campaign::open(&path)?;
            let mut warnings = Vec::new();
            if check {
                let survey = campaign.survey(&theirs);
                campaign.sound(&survey)?;
                warnings = campaign.warnings(&survey);
            }
            Ok(Self(campaign, warnings))
        });
        if opened.is_err() {
            stop.store(true, Ordering::Relaxed);
        }
        opened?.map_err(|error| failed(py, error))
    }

    /// Makes a folder this plan's, or finds that it is.
    fn claim(&self, py: Python, folder: PathBuf) -> PyResult<()> {
        py.detach(|| self.0.claim(folder)).map_err(|error| failed(py, error))
    }

    /// What its author should know, where runs were tried.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.1.clone()
    }

    /// Name of the data set.
    #[getter]
    fn name(&self) -> &str {
        &self.0.plan().name
    }

    /// How many runs.
    #[getter]
    fn runs(&self) -> usize {
        self.0.draws().runs()
    }

    /// How many files.
    #[getter]
    fn parts(&self) -> usize {
        self.0.parts()
    }

    /// How many runs a file has.
    fn runs_of(&self, part: i128) -> PyResult<usize> {
        Ok(self.0.runs_of(below("part", part, "file", self.0.parts())?).len())
    }

    /// What tells this campaign from others.
    #[getter]
    fn identity(&self) -> &str {
        self.0.identity()
    }

    /// Name, unit and description of each column of the files.
    fn columns(&self) -> Vec<(String, String, String)> {
        let columns = self.0.columns().iter().map(|c| &c.record.column);
        columns.map(|c| (c.name.clone(), c.unit.clone(), c.description.clone())).collect()
    }

    /// A run's scenario as TOML with every key given, its class, and what it drew.
    fn run(&self, py: Python<'_>, index: i128) -> PyResult<(String, String)> {
        let index = below("run", index, "run", self.0.draws().runs())?;
        let (loaded, _) = self.0.scenario(index).map_err(|error| failed(py, error))?;
        let class = self.0.draws().class(index);
        Ok((loaded.to_toml(), self.0.plan().classes[class].name.clone()))
    }

    /// Every file that the runs are made from: plan, base scenario, files of damage.
    fn files(&self) -> Vec<PathBuf> {
        let (plan, plan_text) = self.0.plan_file();
        let (base, base_text) = self.0.base_file();
        let mut files = vec![plan.to_owned(), base.to_owned()];
        let folder = base.parent().unwrap_or(Path::new(""));
        for text in [plan_text, base_text] {
            let mut names = Vec::new();
            if let Ok(value) = toml::from_str::<serde_json::Value>(text) {
                named(&value, false, &mut names);
            }
            let paths = names.into_iter().filter(|name| Path::new(name).is_relative());
            files.extend(paths.map(|name| folder.join(name)).filter(|p| p.is_file()));
        }
        files.dedup();
        files
    }

    /// Does what is missing of a shard `(i, n)`, i from 1. `progress` gets the runs that are over, and of how many.
    fn make<'py>(
        &self,
        py: Python<'py>,
        folder: PathBuf,
        shard: (i128, i128),
        jobs: Option<isize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let (index, of) = (from_zero("shard[0]", shard.0)?, from_zero("shard[1]", shard.1)?);
        if !(1..=of).contains(&index) {
            return Err(bad_value(format!("shard = ({index}, {of}): expected (I, N), I from 1 to N")));
        }
        let shard = Shard { index, of };
        let parts = (0..self.0.parts()).filter(|part| shard.has(*part));
        let runs: usize = parts.map(|part| self.0.runs_of(part).len()).sum();
        let threads = threads(jobs, runs)?;
        let watch = Watch::default();
        let make = || dataset::run(&self.0, &folder, shard, threads, &watch);
        let tell = |py: Python<'_>, over: usize| match &progress {
            Some(progress) => progress.call1(py, (over, runs)).map(drop),
            None => Ok(()),
        };
        let summary = attended(py, &watch, make, tell)?.map_err(|error| failed(py, error))?;
        let dict = PyDict::new(py);
        dict.set_item("runs", summary.runs)?;
        dict.set_item("done", summary.done)?;
        dict.set_item("before", summary.before)?;
        dict.set_item("failed", summary.failed)?;
        dict.set_item("whole", summary.whole)?;
        dict.set_item("warnings", summary.warnings(&self.0))?;
        Ok(dict)
    }
}

/// Every string under a key `file`, lists of choices included.
fn named(value: &serde_json::Value, under: bool, names: &mut Vec<String>) {
    match value {
        serde_json::Value::String(text) if under => names.push(text.clone()),
        serde_json::Value::Array(items) => items.iter().for_each(|v| named(v, under, names)),
        serde_json::Value::Object(entries) => {
            for (key, value) in entries {
                named(value, under || key == "file", names);
            }
        }
        _ => {}
    }
}

/// Which instructions this process computes with.
#[pyfunction]
pub(crate) fn kernel() -> PyResult<&'static str> {
    let kernel = brinell::kernel::Kernel::chosen().map_err(bad_value)?;
    Ok(kernel.name())
}

/// Joins folders in which shares ran apart; what is still to do, where something is.
#[pyfunction]
pub(crate) fn merge(py: Python<'_>, folders: Vec<PathBuf>, into: PathBuf) -> PyResult<Option<String>> {
    let merged = py.detach(|| dataset::merge(&folders, &into));
    Ok(merged.map_err(|error| failed(py, error))?.lack())
}

/// Checks a data set: files, of how many, rows, failed runs, and everything that is wrong.
#[pyfunction]
pub(crate) fn verify(py: Python<'_>, folder: PathBuf) -> PyResult<(usize, usize, u64, u64, Vec<String>)> {
    let found = py.detach(|| dataset::verify(&folder));
    let found = found.map_err(|error| failed(py, error))?;
    Ok((found.files, found.of, found.rows, found.failed, found.problems))
}
