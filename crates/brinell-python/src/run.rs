//! Runs: alone, or many over threads, and what they leave.

use crate::bad_value::bad_value;
use crate::convert::{array, json_to_python};
use crate::errors::run_error;
use crate::scenario::Scenario;
use brinell::Error;
use brinell::many::go_on;
use brinell::plausibility::Beforehand;
use brinell::result::{self, RunResult};
use brinell::simulate::{End, Observer, Signals, Simulation, SolverWork};
use brinell::summary::{self, Parts};
use brinell_report::{Report, html};
use brinell_study::listener::{Listener, RunListener};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use serde_json::json;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel, sync_channel};
use std::time::{Duration, Instant};

/// How long Python may have to wait for an answer to Ctrl-C.
pub(crate) const PATIENCE: Duration = Duration::from_millis(50);

/// Keeps every row; asks now and then whether to go on.
struct Recorder<'a, F> {
    signals: Signals,
    go_on: &'a mut F,
}

impl<F: FnMut(f64) -> ControlFlow<()>> Observer for Recorder<'_, F> {
    fn row(&mut self, index: u64, row: &[f64], filtered: &[f64]) -> ControlFlow<()> {
        self.signals.row(index, row, filtered)
    }

    fn progress(&mut self, t: f64, _: &SolverWork) -> ControlFlow<()> {
        (self.go_on)(t)
    }
}

/// What a run came to.
enum Ran {
    Over(Box<RunResult>, Signals),
    /// There is no model, nothing to start from, or no room for the channels.
    Bad(Error),
    /// Not begun.
    LeftOut,
}

/// One run, on the thread that calls.
fn run(scenario: &Scenario, mut go_on: impl FnMut(f64) -> ControlFlow<()>) -> Ran {
    let scenario = &scenario.loaded.scenario;
    let begun = Simulation::new(scenario).and_then(|s| Ok((Signals::new(&s)?, s)));
    let (signals, simulation) = match begun {
        Ok(begun) => begun,
        Err(error) => return Ran::Bad(error),
    };
    let mut recorder = Recorder { signals, go_on: &mut go_on };
    let finished = result::finish(scenario.clone(), simulation, &mut recorder);
    Ran::Over(Box::new(finished), recorder.signals)
}

impl Ran {
    /// The result; where the run failed or never began, the exception.
    fn result(self, py: Python<'_>, scenario: &Py<Scenario>) -> PyResult<Run> {
        match self {
            Self::Over(finished, signals) => {
                let end = finished.outcome.end.clone();
                let run = Run::new(py, scenario.clone_ref(py), *finished, signals)?;
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
        run(inner, |t| {
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

/// Runs at a time, of `count` in all: as requested, or one a core.
pub(crate) fn threads(jobs: Option<isize>, count: usize) -> PyResult<NonZeroUsize> {
    let Some(jobs) = jobs else {
        return Ok(brinell::many::threads(count));
    };
    let jobs_or_none = usize::try_from(jobs).ok().and_then(NonZeroUsize::new);
    jobs_or_none.ok_or_else(|| bad_value(format!("jobs = {jobs}: runs at a time\n  allowed: 1 or more")))
}

/// Does `job` for every index below `count` on threads of its own, and hands each result to `deliver` on this one, with
/// Python's lock. Signals are noticed meanwhile. An error of `deliver`, or a signal's, stops the rest: jobs see the
/// flag.
pub(crate) fn over_threads<T: Send>(
    py: Python<'_>,
    count: usize,
    jobs: Option<isize>,
    job: impl Fn(usize, &AtomicBool) -> T + Sync,
    mut deliver: impl FnMut(Python<'_>, usize, T) -> PyResult<()> + Send,
) -> PyResult<()> {
    let threads = threads(jobs, count)?;
    let stop = AtomicBool::new(false);
    py.detach(|| {
        std::thread::scope(|scope| {
            let (results, arrived) = sync_channel(threads.get());
            let (stop, job) = (&stop, &job);
            scope.spawn(move || {
                brinell::many::each(
                    count,
                    threads,
                    |k| job(k, stop),
                    // Nobody hears what comes after an error.
                    |k, result| drop(results.send((k, result))),
                );
            });
            let mut outcome = Ok(());
            loop {
                let next = match arrived.recv_timeout(PATIENCE) {
                    Ok(next) => Some(next),
                    Err(RecvTimeoutError::Timeout) => None,
                    Err(RecvTimeoutError::Disconnected) => return outcome,
                };
                if outcome.is_err() {
                    continue;
                }
                outcome = Python::attach(|py| {
                    py.check_signals()?;
                    next.map_or(Ok(()), |(k, result)| deliver(py, k, result))
                });
                stop.store(outcome.is_err(), Ordering::Relaxed);
            }
        })
    })
}

/// What the threads of a study and the thread that waits for them share.
#[derive(Default)]
pub(crate) struct Watch {
    pub(crate) stop: AtomicBool,
    over: AtomicUsize,
}

impl Listener for Watch {
    fn begin(&self, _: usize, _: f64) -> Box<dyn RunListener + '_> {
        Box::new(&self.stop)
    }

    fn before(&self, runs: usize) {
        self.over.fetch_add(runs, Ordering::Relaxed);
    }

    fn ended(&self, _: usize, _: Option<&str>) {
        self.over.fetch_add(1, Ordering::Relaxed);
    }
}

/// Does `job` on a thread of its own and waits for it, without Python's lock. Signals are noticed meanwhile, and `tell`
/// gets how many runs are over, whenever more are. An error of `tell`, or a signal's, sets the flag, and is given when
/// the job has ended.
pub(crate) fn attended<T: Send>(
    py: Python<'_>,
    watch: &Watch,
    job: impl FnOnce() -> T + Send,
    mut tell: impl FnMut(Python<'_>, usize) -> PyResult<()> + Send,
) -> PyResult<T> {
    py.detach(|| {
        std::thread::scope(|scope| {
            let (ended, waiting) = channel();
            let job = scope.spawn(move || {
                let result = job();
                // The thread that waits is there as long as this one.
                let _ = ended.send(());
                result
            });
            let (mut outcome, mut shown) = (Ok(()), 0);
            loop {
                let is_over = waiting.recv_timeout(PATIENCE) != Err(RecvTimeoutError::Timeout);
                let now = watch.over.load(Ordering::Relaxed);
                if outcome.is_ok() {
                    outcome = Python::attach(|py| {
                        py.check_signals()?;
                        if now > shown { tell(py, now) } else { Ok(()) }
                    });
                    watch.stop.store(outcome.is_err(), Ordering::Relaxed);
                }
                shown = now;
                if is_over {
                    break;
                }
            }
            let result = job.join().map_err(|_| bad_value("the runs ended without a word"));
            outcome.and(result)
        })
    })
}

/// Runs scenarios side by side. `deliver` gets each index with its result, or with the exception that there is instead.
#[pyfunction]
pub(crate) fn simulate_many(
    py: Python<'_>,
    scenarios: Vec<Py<Scenario>>,
    jobs: Option<isize>,
    deliver: Py<PyAny>,
) -> PyResult<()> {
    over_threads(
        py,
        scenarios.len(),
        jobs,
        |k, stop| {
            if go_on(stop).is_break() {
                return Ran::LeftOut;
            }
            run(scenarios[k].get(), |_| go_on(stop))
        },
        |py, k, ran| {
            match ran.result(py, &scenarios[k]) {
                Ok(run) => deliver.call1(py, (k, run))?,
                Err(error) => deliver.call1(py, (k, error))?,
            };
            Ok(())
        },
    )
}

/// A run that is over.
#[pyclass(frozen, module = "brinell._brinell", name = "Run")]
pub(crate) struct Run {
    pub(crate) scenario: Py<Scenario>,
    pub(crate) finished: RunResult,
    signals: Py<PyDict>,
}

impl Run {
    fn new(py: Python<'_>, scenario: Py<Scenario>, finished: RunResult, signals: Signals) -> PyResult<Self> {
        let dict = PyDict::new(py);
        for (name, column) in signals {
            dict.set_item(name, array(py, column))?;
        }
        Ok(Self { signals: dict.unbind(), scenario, finished })
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
                beforehand: &Beforehand::of(&loaded.scenario, simulation.model()),
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

    /// What `summary.json` holds.
    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        json_to_python(py, &self.with_parts(py, None, summary::to_json))
    }

    /// What `report.html` holds; a run without the damage is drawn behind.
    #[pyo3(signature = (healthy=None))]
    fn to_html(&self, py: Python<'_>, healthy: Option<&Self>) -> String {
        self.with_parts(py, healthy, |parts| html(&Report::of_run(parts)))
    }

    /// Every number of the run: name, unit, value, low and high end.
    #[expect(clippy::type_complexity, reason = "a row of a table")]
    fn quantities(&self) -> Vec<(String, String, Option<f64>, Option<f64>, Option<f64>)> {
        let all = self.finished.quantities().into_iter();
        all.map(|q| {
            let ends = q.interval();
            (q.name, q.unit, q.value, ends.map(|i| i.0), ends.map(|i| i.1))
        })
        .collect()
    }

    /// Averaged spectrum of the sensor acceleration: channel, distance of bins (Hz), amplitudes, densities. None of a
    /// run too short.
    fn spectrum<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(spectrum) = &self.finished.findings.spectrum else {
            return Ok(None);
        };
        let dict = crate::signal::spectrum_dict(py, spectrum.clone())?;
        dict.set_item("channel", self.finished.findings.sensor_name())?;
        Ok(Some(dict))
    }

    /// Averaged spectrum of its envelope, with band and mean.
    fn envelope<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some((envelope, band)) = &self.finished.findings.envelope else {
            return Ok(None);
        };
        let dict = crate::signal::spectrum_dict(py, envelope.spectrum.clone())?;
        dict.set_item("channel", self.finished.findings.sensor_name())?;
        dict.set_item("band_hz", (band.low, band.high))?;
        dict.set_item("mean", envelope.mean)?;
        Ok(Some(dict))
    }

    /// Instants of defect entry and exit, the latest 4096.
    fn events<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let events = &self.finished.findings.passes.events;
        let layout = &self.finished.simulation.model().layout;
        let dict = PyDict::new(py);
        dict.set_item("t", array(py, events.iter().map(|e| e.t).collect()))?;
        let whole = |of: &dyn Fn(&brinell::observe::passes::Event) -> usize| {
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

    /// Surface, row and centre of each defect, and the frequency of its impacts in pure rolling.
    fn defects<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let list: Vec<_> = self
            .finished
            .scenario
            .defects
            .iter()
            .enumerate()
            .map(|(k, d)| {
                let line = self.finished.findings.lines.iter().find(|l| l.defect == k);
                json!({
                    "on": d.on.word(),
                    "row": d.row,
                    "center_deg": d.center_deg,
                    "frequency": line.map(|l| l.name),
                    "pure_rolling_hz": line.map(|l| l.nominal),
                    "found_hz": line.and_then(|l| l.found).map(|f| f.frequency),
                    "too_short": line.and_then(|l| l.too_short.as_ref()),
                })
            })
            .collect();
        json_to_python(py, &list.into())
    }
}
