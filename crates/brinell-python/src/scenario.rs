//! A scenario: the text it was read from, and what became of it.

use crate::bad_value::bad_value;
use crate::convert::{document, json_to_python, overrides};
use crate::errors::{ReadError, scenario_error, unreadable};
use brinell::document::{Loaded, Problem, read, read_bytes};
use brinell_damage::resolve_loaded;
use brinell_study::campaign::fingerprint;
use brinell_study::design::unsaid;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// What a scenario was read from, to be read again with other settings.
#[derive(Clone)]
pub(crate) struct Source {
    text: String,
    /// Where paths in it count from.
    folder: PathBuf,
    /// Of the file, where there is one: its lines are worth pointing at.
    file: Option<String>,
    overrides: Vec<(String, String)>,
    /// The scenario with the geometry of its damage files in place, where those may no longer be there.
    resolved: Option<String>,
}

/// A scenario with the words that it earned on the way.
pub(crate) type Read = (Loaded, Vec<String>);

impl Source {
    fn new(text: String, folder: PathBuf, file: Option<String>) -> Self {
        Self { text, folder, file, overrides: Vec::new(), resolved: None }
    }

    /// The source with more overrides; a later one of the same key counts.
    pub(crate) fn with(&self, settings: &[(String, String)]) -> Self {
        let mut other = self.clone();
        other.overrides.extend_from_slice(settings);
        other
    }

    /// Reads and checks, damage files included.
    pub(crate) fn load(&self) -> Result<Read, Vec<Problem>> {
        let lineless = |mut problems: Vec<Problem>| {
            if self.file.is_none() {
                for problem in &mut problems {
                    (problem.line, problem.column, problem.span) = (None, None, None);
                    problem.also.iter_mut().for_each(|(_, place)| *place = None);
                    problem.message = unsaid(&problem.message);
                }
            }
            problems
        };
        let mut loaded = read(&self.text, &self.overrides).map_err(lineless)?;
        loaded.warnings = lineless(loaded.warnings);
        let mut warnings: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
        if let Some(resolved) = &self.resolved {
            let known = read(resolved, &[])?;
            let found = |k: usize, key: &str| {
                let key = format!("defects.{k}.shape.{key}");
                let entry = known.provenance.iter().find(|p| p.assumed && p.key == key)?;
                Some((entry.value.parse::<f64>().ok()?, entry.reason()))
            };
            for (k, known) in known.scenario.defects.into_iter().enumerate() {
                let file = |d: &brinell::scenario::Defect| d.shape.file().map(str::to_owned);
                let table_file = loaded.scenario.defects.get(k).and_then(|d| d.table_file().map(str::to_owned));
                if let Some(file) = table_file {
                    loaded.scenario.defects[k].table = known.table;
                    loaded.table_read_from(k, &file);
                }
                if let Some(file) = loaded.scenario.defects.get(k).and_then(file) {
                    loaded.scenario.defects[k].shape = known.shape;
                    if let Some((level, _)) = found(k, "image.threshold") {
                        loaded.threshold_found(k, level);
                    }
                    if let Some((radius_mm, how)) = found(k, "depth_map.radius_mm") {
                        loaded.radius_found(k, radius_mm, how);
                    }
                    loaded.read_from(k, &file);
                }
            }
            return Ok((loaded, warnings));
        }
        let more = resolve_loaded(&mut loaded, &self.text, &self.overrides, &self.folder);
        let more = more.map_err(lineless)?;
        warnings.extend(more.into_iter().map(|text| format!("warning: {text}")));
        Ok((loaded, warnings))
    }

    pub(crate) fn error(&self, py: Python, problems: Vec<Problem>) -> PyErr {
        let seen = self.file.as_deref().map(|file| (file, &*self.text));
        scenario_error(py, problems, seen)
    }

    fn scenario(self, py: Python) -> PyResult<Scenario> {
        match py.detach(|| self.load()) {
            Ok((loaded, warnings)) => Ok(Scenario { source: self, loaded, warnings }),
            Err(problems) => Err(self.error(py, problems)),
        }
    }
}

/// Everything that a run is: bearing, damage, operation, what to record. Never changes; `changed` makes another.
#[pyclass(frozen, module = "brinell._brinell", name = "Scenario")]
pub(crate) struct Scenario {
    pub(crate) source: Source,
    pub(crate) loaded: Loaded,
    warnings: Vec<String>,
}

#[pymethods]
impl Scenario {
    /// Of a file.
    #[staticmethod]
    #[pyo3(signature = (path, settings=None))]
    fn read(py: Python, path: PathBuf, settings: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let bytes = std::fs::File::open(&path).and_then(brinell_io::read_text);
        let bytes = bytes.map_err(|error| unreadable(&path, &error))?;
        let file = path.display().to_string();
        let text = match String::from_utf8(bytes) {
            Ok(text) => text,
            Err(error) => {
                let problems = read_bytes(error.as_bytes(), &[]).err().unwrap_or_default();
                let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
                return Err(scenario_error(py, problems, Some((&file, &text))));
            }
        };
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let source = Source::new(text, folder, Some(file));
        with(source, settings)?.scenario(py)
    }

    /// Of a text; paths in it count from `folder`.
    #[staticmethod]
    #[pyo3(signature = (text, settings=None, folder=PathBuf::new()))]
    fn parse(py: Python, text: String, settings: Option<&Bound<'_, PyDict>>, folder: PathBuf) -> PyResult<Self> {
        let source = Source::new(text, folder, Some("text".into()));
        with(source, settings)?.scenario(py)
    }

    /// Of sections given as dicts.
    #[staticmethod]
    fn build(py: Python, sections: &Bound<'_, PyDict>) -> PyResult<Self> {
        Source::new(document(sections)?, PathBuf::new(), None).scenario(py)
    }

    /// What `state` gave.
    #[staticmethod]
    fn restore(
        py: Python,
        text: String,
        folder: PathBuf,
        file: Option<String>,
        overrides: Vec<(String, String)>,
        resolved: Option<String>,
    ) -> PyResult<Self> {
        let source = Source { text, folder, file, overrides, resolved };
        source.scenario(py)
    }

    /// Everything that `restore` needs, without the files of damage.
    #[expect(clippy::type_complexity, reason = "a tuple for pickle")]
    fn state(&self) -> (String, PathBuf, Option<String>, Vec<(String, String)>, Option<String>) {
        let s = &self.source;
        let from_files = read(&s.text, &s.overrides).is_ok_and(|loaded| {
            let mut defects = loaded.scenario.defects.iter();
            defects.any(|d| d.shape.file().is_some() || d.table_file().is_some())
        });
        (
            s.text.clone(),
            s.folder.clone(),
            s.file.clone(),
            s.overrides.clone(),
            from_files.then(|| self.loaded.to_toml()),
        )
    }

    /// The same with other values: dotted paths to values.
    fn changed(&self, py: Python, settings: &Bound<'_, PyDict>) -> PyResult<Self> {
        let mut source = self.source.with(&overrides(settings)?);
        // Another file may be named now.
        source.resolved = None;
        source.scenario(py)
    }

    /// The scenario's name.
    #[getter]
    fn name(&self) -> &str {
        &self.loaded.scenario.name
    }

    /// TOML with every default filled in and assumed values marked, as a run's `scenario.toml`.
    #[getter]
    fn toml(&self) -> String {
        self.loaded.to_toml()
    }

    /// Writes [`Scenario::toml`] into a file, whole or not at all.
    fn write(&self, path: PathBuf) -> PyResult<()> {
        brinell_io::atomic_write(path, self.loaded.to_toml()).map_err(|error| ReadError::new_err(error.to_string()))
    }

    /// What its author should know.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.warnings.clone()
    }

    /// Assumed values: dicts of key, value, unit and why.
    #[getter]
    fn assumed<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let assumed = self.loaded.provenance.iter().filter(|p| p.assumed);
        let list: Vec<Value> =
            assumed.map(|p| json!({ "key": p.key, "value": p.value, "unit": p.unit, "why": p.reason() })).collect();
        json_to_python(py, &list.into())
    }

    /// SHA-256 of what it means, in hexadecimal.
    #[getter]
    fn fingerprint(&self) -> String {
        fingerprint(&self.loaded.scenario)
    }

    /// Every key's value, in the file's units.
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let text = self.loaded.scenario.to_toml();
        let value: Value = toml::from_str(&text).map_err(bad_value)?;
        json_to_python(py, &value)
    }
}

fn with(source: Source, settings: Option<&Bound<'_, PyDict>>) -> PyResult<Source> {
    match settings {
        Some(settings) => Ok(source.with(&overrides(settings)?)),
        None => Ok(source),
    }
}

/// The catalogue: name and title of each bearing.
#[pyfunction]
pub(crate) fn bearings<'py>(py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
    let entries = brinell::bearing::catalogue::all().iter();
    PyList::new(py, entries.map(|e| (e.name.as_str(), e.title.as_str())))
}

/// JSON Schema of the scenario file, or of a data set's plan, as text.
#[pyfunction]
pub(crate) fn schema(plan: bool) -> String {
    let schema = match plan {
        true => brinell_study::design::plan_schema(),
        false => brinell::document::json_schema(),
    };
    schema.to_string()
}

/// A scenario to begin from, commented.
#[pyfunction]
pub(crate) fn template() -> String {
    brinell::document::template()
}
