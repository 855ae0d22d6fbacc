//! What makes the runs of a reproduction and keeps their numbers, from outside: this crate knows neither threads nor a
//! journal.

use crate::{Error, Numbers, Point};
use brinell_study::campaign::Row;
use std::collections::BTreeMap;
use std::ops::ControlFlow;

/// What a batch of runs is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// The cases, and the same under each assumption made otherwise.
    Cases,
    /// A batch of a search for a set of assumptions: one of many.
    Search,
    /// All cases under the best sets of the search.
    Best,
}

/// Makes runs and keeps their numbers.
pub trait Runs {
    /// Why a run could not be made or kept. A run that fails is a row like another.
    type Error: From<Error>;

    /// What is known of a finished run, by the fingerprint of its point's task.
    fn row(&self, fingerprint: &str) -> Option<&Row>;

    /// Makes those of the runs that are not finished, each once; `Break` where that was interrupted.
    ///
    /// # Errors
    /// Where the runs cannot be made or kept.
    fn make(&mut self, points: &[&Point], stage: Stage) -> Result<ControlFlow<()>, Self::Error>;

    /// The searches begin; they look at `sets` sets of assumptions at most.
    fn search_begins(&mut self, sets: usize);
}

/// Numbers of all points that are finished; points of one case are its starts.
pub(crate) fn numbers<'a>(points: impl IntoIterator<Item = &'a Point>, runs: &impl Runs) -> Numbers {
    let mut rows: BTreeMap<&str, Vec<&Row>> = BTreeMap::new();
    for point in points {
        if let Some(row) = runs.row(&point.task.fingerprint) {
            rows.entry(point.case.id).or_default().push(row);
        }
    }
    let mut numbers = Numbers::default();
    for (case, rows) in rows {
        numbers.add(case, &rows);
    }
    numbers
}
