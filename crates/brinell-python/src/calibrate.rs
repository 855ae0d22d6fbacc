//! Keys of a scenario fitted to numbers that are known.

use crate::bad_value::{bad_value, from_zero};
use crate::convert::{Samples, json_to_python, slice, table};
use crate::errors::{SignalError, failed_run, run_error};
use crate::kept::{ledger, refused};
use crate::scenario::Scenario;
use crate::wait::{Watch, attended, threads};
use brinell::analysis::Unit;
use brinell::document::on_one_line;
use brinell::simulate::Simulation;
use brinell_report::{Page, calibration_undetermined, calibration_verdict, html};
use brinell_study::calibrate::{
    self as study, CalibrateError, FitPlan, Key, Load, Measured, Outcome, Pattern, Target, Unfinished, bounds,
    check_keys, middle,
};
use pyo3::prelude::*;
use pyo3::types::PyList;
use std::path::PathBuf;
use std::sync::Arc;

/// What a calibration found.
#[pyclass(frozen, module = "brinell._brinell")]
pub(crate) struct Calibration(Outcome);

#[pymethods]
impl Calibration {
    /// Columns of `calibrate.csv`: name, unit, cells.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        table(py, &self.0.table())
    }

    /// What `calibrate.json` holds.
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (verdict, undetermined) = (calibration_verdict(&self.0), calibration_undetermined(&self.0));
        json_to_python(py, &self.0.to_json(&verdict, &undetermined))
    }

    /// What `calibrate.html` holds.
    fn to_html(&self, py: Python<'_>) -> String {
        py.detach(|| html(&Page::of_outcome(&self.0)))
    }
}

/// What is wrong, with the argument that it is about.
fn wrong(argument: &str, error: CalibrateError) -> PyErr {
    match &error {
        CalibrateError::Signal(error) => SignalError::new_err(format!("measured: {error}")),
        CalibrateError::ModelUncertainty(percent) => {
            bad_value(format!("model_uncertainty_percent = {percent}: {error}"))
        }
        CalibrateError::Budget { budget, .. } => bad_value(format!("budget = {budget}: {error}")),
        CalibrateError::NoTarget => bad_value("there is nothing to fit to: give targets, or a measured signal"),
        CalibrateError::Axis(_) => bad_value(error),
        CalibrateError::NoAcceleration(_) | CalibrateError::Rate { .. } => bad_value(format!("{argument} {error}")),
        _ => bad_value(format!("{argument}: {error}")),
    }
}

/// Fits keys, each `(path, low, high, log)`, to targets, each `(name, value, standard uncertainty)`, and to a measured
/// signal with `(rate in Hz, unit, axis, per cent that the model may differ by, whether to its events alone)`. `progress` gets the runs that are
/// over, and of how many at most. With a `folder`, finished runs are in its journal and not made again.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "keywords, given by the Python around it")]
pub(crate) fn calibrate<'py>(
    py: Python<'py>,
    scenario: &Scenario,
    fit: Vec<(String, f64, f64, bool)>,
    targets: Vec<(String, f64, f64)>,
    measured: Option<Samples<'py>>,
    signal: (f64, String, Option<String>, f64, bool),
    seed: i128,
    budget: Option<i128>,
    jobs: Option<isize>,
    progress: Option<Py<PyAny>>,
    folder: Option<PathBuf>,
) -> PyResult<Calibration> {
    // Said once, and not of every point.
    brinell::kernel::Kernel::chosen().map_err(bad_value)?;
    let threads = threads(jobs, usize::MAX)?;
    let seed = from_zero("seed", seed)?;
    let budget = budget.map(|budget| from_zero("budget", budget)).transpose()?;
    // By the command's own readers, whose words are known.
    let key = |(name, low, high, log): &(String, f64, f64, bool)| {
        Key::read(&format!("{name}={low:?}:{high:?}{}", if *log { ":log" } else { "" }))
    };
    let keys = fit.iter().map(key).collect::<Result<Vec<_>, _>>().map_err(|error| wrong("fit", error))?;
    check_keys(&keys).map_err(|error| wrong("fit", error))?;
    let target = |(name, value, sigma): &(String, f64, f64)| Target::read(&format!("{name}={value:?}~{sigma:?}"));
    let targets = targets.iter().map(target).collect::<Result<Vec<_>, _>>().map_err(|error| wrong("targets", error))?;
    let source = &scenario.source;
    let read = |settings: &[(String, String)]| match py.detach(|| source.with(settings).load()) {
        Ok((loaded, _)) => Ok(loaded),
        Err(problems) => Err(source.error(py, problems)),
    };
    for settings in bounds(&keys) {
        read(&settings)?;
    }
    let middle = read(&middle(&keys))?;
    let simulation = py.detach(|| Simulation::unchecked(&middle.scenario)).map_err(|error| run_error(py, &error))?;
    let pattern = measured.map(|x| {
        let own = read(&[])?;
        let (rate, unit, axis, percent) = (signal.0, Unit::of(&signal.1), signal.2.as_deref(), signal.3);
        let measured = Measured { x: &slice(&x), rate, unit: &unit };
        let pattern = py
            .detach(|| Pattern::new(&measured, (&own.scenario, &keys), (&middle.scenario, &simulation), axis, percent));
        let only = |pattern: Pattern| if signal.4 { pattern.events_only() } else { Ok(pattern) };
        let mut pattern = pattern.and_then(only).map_err(|error| wrong("measured", error))?;
        pattern.notes.push(format!("{} samples at {rate} Hz, against {}", measured.x.len(), pattern.channel));
        Ok::<_, PyErr>(pattern)
    });
    let pattern = pattern.transpose()?;
    let plan = py.detach(|| FitPlan::new(keys, targets, pattern, middle, &simulation, seed, budget));
    let plan = Arc::new(plan.map_err(|error| wrong("targets", error))?);
    let ledger = ledger(folder.as_deref(), &plan.header())?;
    let load: &Load<'_> = &|settings| {
        let loaded = source.with(settings).load();
        loaded.map(|(loaded, _)| loaded).map_err(|problems| on_one_line(&problems))
    };
    let watch = Watch::default();
    let tell = |py: Python<'_>, over: usize| match &progress {
        Some(progress) => progress.call1(py, (over, plan.settings.budget)).map(drop),
        None => Ok(()),
    };
    let found = attended(py, &watch, || study::calibrate(&plan, load, ledger, threads, &watch), tell)?;
    found.map(Calibration).map_err(|error| match error {
        Unfinished::Runner(error) => refused(folder.as_deref(), error),
        Unfinished::Unfit { unfit, reasons } => {
            failed_run(py, [vec![unfit.to_string()], reasons].concat().join("\n  "))
        }
    })
}
