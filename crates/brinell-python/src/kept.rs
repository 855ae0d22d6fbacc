//! A sweep with a journal: points that are finished are in its folder, and are not run again.

use crate::errors::{ReadError, bad_value};
use crate::run::{PATIENCE, over_threads, threads};
use crate::scenario::Source;
use crate::sweep::Numbers;
use brinell::document::{on_one_line, one_line};
use brinell::many::go_on;
use brinell::scenario::Scenario;
use brinell_study::campaign::{Plan, fingerprint};
use brinell_study::listener::{Listener, RunListener};
use brinell_study::runner::{self, Ledger, RunnerError, Task, Work};
use pyo3::prelude::*;
use std::collections::HashSet;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};

/// Scenarios of points, from the one that they change.
struct Points<'a>(&'a Source);

impl Work for Points<'_> {
    type Error = RunnerError;

    fn scenario(&self, task: &Task) -> Result<Scenario, RunnerError> {
        let loaded = self.0.with(&task.settings).load();
        loaded.map(|(loaded, _)| loaded.scenario).map_err(|_| RunnerError::Changed)
    }
}

/// Tells of each run that is on the disk; stops all at a flag.
struct Heard<'a> {
    stop: &'a AtomicBool,
    ended: Sender<()>,
}

impl Listener for Heard<'_> {
    fn begin(&self, _: usize, _: f64) -> Box<dyn RunListener + '_> {
        Box::new(Going(self.stop))
    }

    fn ended(&self, _: usize, _: Option<&str>) {
        // Nobody hears what comes after an error.
        let _ = self.ended.send(());
    }
}

struct Going<'a>(&'a AtomicBool);

impl RunListener for Going<'_> {
    fn at(&mut self, _: f64) -> ControlFlow<()> {
        go_on(self.0)
    }
}

fn refused(folder: &Path, error: RunnerError) -> PyErr {
    match error {
        RunnerError::Io(error) => ReadError::new_err(error.to_string()),
        error => bad_value(format!("{}: {error}", folder.display())),
    }
}

/// Of each point its numbers, or why there are none.
pub(crate) fn run(
    py: Python<'_>,
    (plan, source): (&Plan, &Source),
    folder: &Path,
    jobs: Option<isize>,
    mut progress: impl FnMut(Python<'_>, usize) -> PyResult<()> + Send,
) -> PyResult<Vec<Numbers>> {
    let mut points = vec![Err(String::new()); plan.points()];
    over_threads(
        py,
        plan.points(),
        jobs,
        |k, _| task(plan.settings(k), source),
        |_, k, task| {
            points[k] = task;
            Ok(())
        },
    )?;
    let prints = points.iter().map(|p| p.as_ref().ok().map(|t| &*t.fingerprint));
    std::fs::create_dir_all(folder)
        .map_err(|error| ReadError::new_err(format!("cannot make {}: {error}", folder.display())))?;
    let ledger = Ledger::open(folder, &plan.header(prints), false);
    let mut ledger = ledger.map_err(|error| refused(folder, error))?;
    let mut seen = HashSet::new();
    let good = points.iter().flatten();
    let tasks: Vec<Task> =
        good.filter(|t| ledger.kept.row(&t.fingerprint).is_none() && seen.insert(&t.fingerprint)).cloned().collect();
    let threads = threads(jobs, tasks.len())?;
    let mut done = plan.points() - tasks.len();
    progress(py, done)?;
    let stop = AtomicBool::new(false);
    let mut outcome = Ok(());
    py.detach(|| {
        let (ended, hears) = channel();
        let heard = Heard { stop: &stop, ended };
        std::thread::scope(|scope| {
            let (tasks, ledger) = (&tasks, &mut ledger);
            let runs = scope.spawn(move || runner::run(tasks, &Points(source), ledger, threads, &heard));
            loop {
                let next = hears.recv_timeout(PATIENCE);
                if next == Err(RecvTimeoutError::Disconnected) {
                    break;
                }
                done += usize::from(next.is_ok());
                if outcome.is_ok() {
                    outcome = Python::attach(|py| {
                        py.check_signals()?;
                        next.map_or(Ok(()), |()| progress(py, done))
                    });
                    stop.store(outcome.is_err(), Ordering::Relaxed);
                }
            }
            let ended = runs.join();
            if let (Ok(()), Ok(Err(error))) = (&outcome, ended) {
                outcome = Err(refused(folder, error));
            }
        });
    });
    outcome?;
    let result = |point: Result<Task, String>| {
        let row = ledger.kept.row(&point?.fingerprint).ok_or("not run")?;
        row.result.clone().map_err(|reason| one_line(&reason))
    };
    Ok(points.into_iter().map(result).collect())
}

/// A point as a task, or what is wrong with its scenario.
fn task(settings: Vec<(String, String)>, source: &Source) -> Result<Task, String> {
    let loaded = source.with(&settings).load();
    let (loaded, _) = loaded.map_err(|problems| on_one_line(&problems))?;
    Ok(Task { fingerprint: fingerprint(&loaded.scenario), duration_s: loaded.scenario.simulation.duration_s, settings })
}
