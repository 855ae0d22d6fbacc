//! Runs: alone, or many over threads, and what they leave.

use crate::bad_value::bad_value;
use crate::convert::{array, json_to_python};
use crate::errors::run_error;
use crate::scenario::Scenario;
use crate::wait::{PATIENCE, over_threads, threads};
use brinell::Error;
use brinell::channel::{Frame, stiffness_unit};
use brinell::document::on_one_line;
use brinell::many::go_on;
use brinell::observe::passes::{Event, Passes};
use brinell::plausibility::{self, Beforehand};
use brinell::result::Parts;
use brinell::result::{self, RunResult};
use brinell::simulate::{End, Observer, Signals, Simulation, SolverWork};
use brinell::summary;
use brinell_report::{Page, html};
use brinell_study::campaign::{BALANCED, Misses, assumed, count, of_results, run_spread};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use serde_json::Value;
use std::ops::ControlFlow;
use std::sync::OnceLock;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// Keeps every row, and every entry and exit, of which a run's findings keep the latest; asks now and then whether to
/// go on.
struct Recorder<'a, F> {
    signals: Signals,
    passes: Passes,
    events: Vec<Event>,
    go_on: &'a mut F,
}

impl<F: FnMut(f64) -> ControlFlow<()>> Observer for Recorder<'_, F> {
    fn again(&mut self, simulation: &Simulation) -> ControlFlow<()> {
        self.passes = Passes::new(simulation.model());
        self.events.clear();
        self.signals.again(simulation)
    }

    fn step(&mut self, frame: &Frame) {
        self.passes.take(frame, false, false);
        self.events.extend(self.passes.events.drain(..));
    }

    fn row(&mut self, index: u64, row: &[f64], filtered: &[f64]) -> ControlFlow<()> {
        self.signals.row(index, row, filtered)
    }

    fn progress(&mut self, t: f64, _: &SolverWork) -> ControlFlow<()> {
        (self.go_on)(t)
    }
}

/// What a run came to.
enum Ran {
    /// With its channels, entries and exits, and what was known beforehand, where that was asked for.
    Over(Box<RunResult>, Signals, Vec<Event>, Option<Beforehand>),
    /// There is no model, nothing to start from, or no room for the channels.
    Bad(Error),
    /// Not begun.
    LeftOut,
}

/// One run, on the thread that calls; `beforehand`: what was known of it is found here, too.
fn run(scenario: &Scenario, beforehand: bool, mut go_on: impl FnMut(f64) -> ControlFlow<()>) -> Ran {
    let scenario = &scenario.loaded.scenario;
    let begun = Simulation::unchecked(scenario).and_then(|s| Ok((Signals::new(&s)?, s)));
    let (signals, simulation) = match begun {
        Ok(begun) => begun,
        Err(error) => return Ran::Bad(error),
    };
    let passes = Passes::new(simulation.model());
    let mut recorder = Recorder { signals, passes, events: Vec::new(), go_on: &mut go_on };
    let finished = result::finish(scenario.clone(), simulation, &mut recorder);
    let beforehand = beforehand.then(|| Beforehand::of_run(scenario, &finished.simulation));
    Ran::Over(Box::new(finished), recorder.signals, recorder.events, beforehand)
}

impl Ran {
    /// The result; where the run failed or never began, the exception.
    fn result(self, py: Python<'_>, scenario: &Py<Scenario>) -> PyResult<Run> {
        match self {
            Self::Over(finished, signals, events, beforehand) => {
                let end = finished.outcome.end.clone();
                let mut run = Run::new(py, scenario.clone_ref(py), *finished, signals, events)?;
                run.beforehand = beforehand.map_or_else(OnceLock::new, OnceLock::from);
                let End::Failed(error) = end else {
                    return Ok(run);
                };
                let error = run_error(py, &error);
                error.value(py).setattr("partial", Py::new(py, run)?)?;
                Err(error)
            }
            Self::Bad(error) => Err(run_error(py, &error)),
            Self::LeftOut => Err(bad_value("stopped before it began")),
        }
    }
}

/// Runs one scenario. `progress` gets the simulated time reached, s.
#[pyfunction]
#[pyo3(signature = (scenario, progress=None))]
pub(crate) fn simulate(py: Python<'_>, scenario: &Bound<'_, Scenario>, progress: Option<Py<PyAny>>) -> PyResult<Run> {
    let inner = scenario.get();
    let mut raised = None;
    let ran = py.detach(|| {
        let mut last = Instant::now();
        run(inner, true, |t| {
            if last.elapsed() < PATIENCE {
                return ControlFlow::Continue(());
            }
            last = Instant::now();
            let checked = Python::attach(|py| {
                py.check_signals()?;
                if let Some(progress) = &progress {
                    progress.call1(py, (t,))?;
                }
                Ok(())
            });
            match checked {
                Ok(()) => ControlFlow::Continue(()),
                Err(error) => {
                    raised = Some(error);
                    ControlFlow::Break(())
                }
            }
        })
    });
    match raised {
        Some(error) => Err(error),
        None => ran.result(py, scenario.as_unbound()),
    }
}

/// Runs scenarios side by side. `deliver` gets each index with its result, or with the exception that there is instead.
/// Gives what they should be warned of, each kind once.
#[pyfunction]
pub(crate) fn simulate_many(
    py: Python<'_>,
    scenarios: Vec<Py<Scenario>>,
    jobs: Option<isize>,
    deliver: Py<PyAny>,
) -> PyResult<Vec<String>> {
    let (mut before, mut after, mut looked) = (Vec::new(), Vec::new(), 0);
    over_threads(
        py,
        scenarios.len(),
        jobs,
        |k, stop| {
            if go_on(stop).is_break() {
                return Ran::LeftOut;
            }
            run(scenarios[k].get(), k < BALANCED, |_| go_on(stop))
        },
        |py, k, ran| {
            if let Ran::Over(finished, _, _, known) = &ran {
                let RunResult { scenario, simulation, outcome, findings } = &**finished;
                after.push((k, plausibility::after(scenario, simulation, outcome, findings)));
                looked += usize::from(known.is_some());
                let known = known.iter().flat_map(|known| &known.warnings);
                before.extend(known.map(|problem| (k, problem.clone())));
            }
            match ran.result(py, &scenarios[k]) {
                Ok(run) => deliver.call1(py, (k, run))?,
                Err(error) => deliver.call1(py, (k, error))?,
            };
            Ok(())
        },
    )?;
    // In the order of the scenarios, whichever ended first.
    before.sort_by_key(|(k, _)| *k);
    after.sort_by_key(|(k, _)| *k);
    let name = |k| format!("scenarios[{k}]");
    let mut kinds: Vec<Misses> = Vec::new();
    before.into_iter().for_each(|(k, problem)| count(&mut kinds, problem, k));
    let before = kinds.iter().map(|miss| miss.words(looked, "run", name(miss.run)));
    Ok(before.chain(of_results(after, "run", name)).collect())
}

/// A run that is over.
#[pyclass(frozen, module = "brinell._brinell", name = "Run")]
pub(crate) struct Run {
    pub(crate) scenario: Py<Scenario>,
    pub(crate) finished: RunResult,
    signals: Py<PyDict>,
    events: Vec<Event>,
    /// What was known before it ran; found when it is asked for.
    beforehand: OnceLock<Beforehand>,
}

impl Run {
    fn new(
        py: Python<'_>,
        scenario: Py<Scenario>,
        finished: RunResult,
        signals: Signals,
        events: Vec<Event>,
    ) -> PyResult<Self> {
        let dict = PyDict::new(py);
        for (name, column) in signals {
            dict.set_item(name, array(py, column))?;
        }
        Ok(Self { signals: dict.unbind(), scenario, finished, events, beforehand: OnceLock::new() })
    }

    /// Everything that summary and page are made of.
    fn with_parts<T: Send>(&self, py: Python<'_>, healthy: Option<&Self>, of: impl FnOnce(&Parts) -> T + Send) -> T {
        let loaded = &self.scenario.get().loaded;
        let healthy = healthy.map(|run| &run.finished.findings);
        py.detach(|| {
            let simulation = &self.finished.simulation;
            of(&Parts {
                loaded,
                simulation,
                outcome: &self.finished.outcome,
                findings: &self.finished.findings,
                beforehand: self.beforehand.get_or_init(|| Beforehand::of_run(&loaded.scenario, simulation)),
                healthy,
            })
        })
    }
}

#[pymethods]
impl Run {
    /// What was run.
    #[getter]
    fn scenario(&self, py: Python<'_>) -> Py<Scenario> {
        self.scenario.clone_ref(py)
    }

    /// Time and channels by name.
    #[getter]
    fn signals(&self, py: Python<'_>) -> Py<PyDict> {
        self.signals.clone_ref(py)
    }

    /// Name, unit and description of each, time first.
    fn channels(&self) -> Vec<(String, String, String)> {
        let text = |name: &str, unit: &str, about: &str| (name.into(), unit.into(), about.into());
        let channels = self.finished.simulation.channels().iter();
        std::iter::once(text("t", "s", "time")).chain(channels.map(|c| text(&c.name, c.unit, &c.description))).collect()
    }

    /// Samples a second.
    #[getter]
    fn rate_hz(&self) -> f64 {
        self.finished.simulation.sample_rate()
    }

    /// Whether it reached its duration.
    #[getter]
    fn complete(&self) -> bool {
        self.finished.outcome.end == End::Complete
    }

    /// What its reader should know, as in [`Run::summary`].
    fn warnings(&self, py: Python<'_>) -> Vec<String> {
        self.with_parts(py, None, |parts| parts.warnings())
    }

    /// What `summary.json` holds.
    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        json_to_python(py, &self.with_parts(py, None, summary::to_json))
    }

    /// What `report.html` holds; a run without the damage is drawn behind.
    #[pyo3(signature = (healthy=None))]
    fn to_html(&self, py: Python<'_>, healthy: Option<&Self>) -> String {
        self.with_parts(py, healthy, |parts| html(&Page::of_run(parts, &[], None)))
    }

    /// What `summary.json` holds under `spread`: the assumed values at both ends of their plausible ranges, `jobs` runs at a time.
    #[pyo3(signature = (jobs=None))]
    fn spread<'py>(&self, py: Python<'py>, jobs: Option<isize>) -> PyResult<Bound<'py, PyAny>> {
        if self.finished.outcome.end != End::Complete {
            return Err(bad_value("the run did not come to its end, and its levels are those of a part"));
        }
        let (scenario, base) = (self.scenario.get(), self.finished.quantities());
        let keys = assumed(&scenario.loaded.provenance);
        let threads = threads(jobs, 2 * keys.len())?;
        let load = |key: &str, value: f64| {
            let read = scenario.source.with(&[(key.to_owned(), value.to_string())]).load();
            read.map(|(loaded, _)| loaded.scenario).map_err(|problems| on_one_line(&problems))
        };
        let mut found = None;
        let run = |_, stop: &AtomicBool| run_spread(keys.clone(), &base, load, threads, stop);
        over_threads(py, 1, None, run, |_, _, spread| {
            found = spread;
            Ok(())
        })?;
        json_to_python(py, &found.map_or(Value::Null, |spread| spread.to_json()))
    }

    /// Averaged spectrum of the sensor acceleration: channel, distance of bins (Hz), amplitudes, densities. None of a
    /// run too short.
    fn spectrum<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(spectrum) = &self.finished.findings.spectrum else {
            return Ok(None);
        };
        let dict = crate::signal::spectrum_dict(py, spectrum.clone())?;
        dict.set_item("channel", &self.finished.findings.sensor)?;
        Ok(Some(dict))
    }

    /// Averaged spectrum of its envelope, with band and mean.
    fn envelope<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some((envelope, band)) = &self.finished.findings.envelope else {
            return Ok(None);
        };
        let dict = crate::signal::spectrum_dict(py, envelope.spectrum.clone())?;
        dict.set_item("channel", &self.finished.findings.sensor)?;
        dict.set_item("band_hz", (band.low, band.high))?;
        dict.set_item("mean", envelope.mean)?;
        Ok(Some(dict))
    }

    /// Instants of defect entry and exit.
    fn events<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let events = &self.events;
        let layout = &self.finished.simulation.model().layout;
        let dict = PyDict::new(py);
        dict.set_item("t", array(py, events.iter().map(|e| e.t).collect()))?;
        let whole = |of: &dyn Fn(&Event) -> usize| {
            let values: Vec<i64> = events.iter().map(|e| of(e) as i64).collect();
            numpy::IntoPyArray::into_pyarray(values, py)
        };
        dict.set_item("defect", whole(&|e| e.defect + 1))?;
        dict.set_item("row", whole(&|e| layout.row(e.slot) + 1))?;
        dict.set_item("roller", whole(&|e| layout.roller(e.slot) + 1))?;
        let enters: Vec<bool> = events.iter().map(|e| e.enters).collect();
        dict.set_item("enters", numpy::IntoPyArray::into_pyarray(enters, py))?;
        Ok(dict)
    }

    /// The pass over each defect in which the contact force was greatest.
    fn passes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let layout = &self.finished.simulation.model().layout;
        let list = PyList::empty(py);
        for pass in self.finished.findings.passes.best() {
            let dict = PyDict::new(py);
            dict.set_item("defect", pass.defect + 1)?;
            dict.set_item("row", layout.row(pass.slot) + 1)?;
            dict.set_item("roller", layout.roller(pass.slot) + 1)?;
            dict.set_item("stiffness_unit", stiffness_unit(self.finished.scenario.contact.exponent))?;
            let column = |name: &str, of: fn(&brinell::observe::passes::PassPoint) -> f64| {
                dict.set_item(name, array(py, pass.points.iter().map(of).collect()))
            };
            column("t", |p| p.t)?;
            column("angle_deg", |p| p.angle.to_degrees())?;
            column("effective_length_mm", |p| 1e3 * p.length)?;
            column("stiffness", |p| p.stiffness)?;
            column("force_n", |p| p.force)?;
            list.append(dict)?;
        }
        Ok(list)
    }
}
