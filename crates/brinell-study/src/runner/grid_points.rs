//! A grid with its points: each read before any runs, and what became of each.

use super::{Kept, Task};
use crate::campaign::{Beforehand, Grid, Row, of_points, of_results};
use brinell::document::Loaded;
use brinell::result::Quantity;
use serde_json::Value;
use std::collections::BTreeMap;
use std::num::NonZeroUsize;

/// A grid, and what is known of its points before they run.
#[derive(Debug)]
pub struct GridPoints {
    /// What is varied.
    pub grid: Grid,
    /// Of each point: what to run, or why its scenario is bad.
    pub tasks: Vec<Result<Task, String>>,
    /// Unit of each varied key, as the file format states it.
    pub units: BTreeMap<String, &'static str>,
    /// What the author should know before the points run.
    pub warnings: Vec<String>,
}

/// What became of a point: its row, or why it failed; `None` where it has not run.
#[derive(Debug, Clone, Copy)]
pub struct State<'a>(Option<Result<&'a Row, &'a str>>);

impl<'a> State<'a> {
    /// complete, failed or not run.
    pub fn word(&self) -> &'static str {
        match self.0 {
            Some(Ok(_)) => "complete",
            Some(Err(_)) => "failed",
            None => "not run",
        }
    }

    /// The row of a point that is complete.
    pub fn row(&self) -> Option<&'a Row> {
        self.0.and_then(Result::ok)
    }

    /// Its numbers; none where it is not complete.
    pub fn numbers(&self) -> &'a [Quantity] {
        self.row().and_then(|row| row.result.as_deref().ok()).unwrap_or_default()
    }

    /// Why a point failed.
    pub fn failure(&self) -> Option<&'a str> {
        self.0.and_then(Result::err)
    }

    /// What results should be warned of: each kind of problem once.
    pub fn doubts(states: &[Self]) -> Vec<String> {
        let of = |(k, state): (usize, &Self)| Some((k, state.row()?.warnings.clone()));
        of_results(states.iter().enumerate().filter_map(of), "point", |k| k + 1)
    }
}

impl GridPoints {
    /// Reads every point, up to `threads` at a time: `load` gives the scenario of settings, `words` say why one is bad.
    ///
    /// # Errors
    /// Where all are bad: what is wrong with the first.
    pub fn read<E: Send>(
        grid: Grid,
        threads: NonZeroUsize,
        load: impl Fn(&[(String, String)]) -> Result<Loaded, E> + Sync,
        words: impl Fn(&E) -> String,
    ) -> Result<Self, E> {
        let known = Beforehand::default();
        let points = brinell::many::map(grid.points(), threads, |k| {
            let settings = grid.settings(k);
            let loaded = load(&settings)?;
            let unit = |(key, _): &(String, String)| Some((key.clone(), loaded.provenance_of(key)?.unit));
            let units: Vec<_> = settings.iter().filter_map(unit).collect();
            Ok((units, known.point(k, &loaded), Task::new(settings, &loaded.scenario)))
        });
        let all_bad = points.iter().all(Result::is_err);
        let (mut units, mut tasks, mut before) = (BTreeMap::new(), Vec::new(), Vec::new());
        for point in points {
            match point {
                Ok((of_point, known, task)) => {
                    units.extend(of_point);
                    before.push(Some(known));
                    tasks.push(Ok(task));
                }
                Err(error) if all_bad => return Err(error),
                Err(error) => {
                    before.push(None);
                    tasks.push(Err(words(&error)));
                }
            }
        }
        let warnings = of_points(before.iter().map(Option::as_ref));
        Ok(Self { grid, tasks, units, warnings })
    }

    /// Head of a sweep's journal, which tells it from others: the grid, and the scenarios of its points.
    pub fn header(&self) -> Value {
        self.grid.header(self.tasks.iter().map(|task| task.as_ref().ok().map(|task| &*task.fingerprint)))
    }

    /// The state of every point.
    pub fn states<'a>(&'a self, kept: &'a Kept) -> Vec<State<'a>> {
        let one = |task: &'a Result<Task, String>| match task {
            Err(reason) => State(Some(Err(reason))),
            Ok(task) => {
                let row = kept.row(&task.fingerprint);
                State(row.map(|row| row.result.as_ref().map(|_| row).map_err(String::as_str)))
            }
        };
        self.tasks.iter().map(one).collect()
    }
}
