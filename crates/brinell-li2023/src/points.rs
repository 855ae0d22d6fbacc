//! Cases as runs to be made.

use crate::{BASE, Case, Error, Length, Outline, length_of};
use brinell::document;
use brinell::scenario::Scenario;
use brinell_study::runner::Task;

/// A case under assumptions, ready to run.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// The case.
    pub case: &'static Case,
    /// Its run; settings are everything that is set over [`BASE`].
    pub task: Task,
}

impl Point {
    /// A case with `more` settings below its own, its irregular defect in a reading of Eq. (27). What it sets itself,
    /// its shape or its load, stays.
    pub(crate) fn new(
        case: &'static Case,
        more: &[(String, String)],
        outline: Outline,
        length: Length,
    ) -> Result<Self, Error> {
        let mut settings = case.over(more, outline);
        let duration = length_of(case, length).duration_s(case.rpm);
        settings.push(("simulation.duration_s".into(), format!("{duration:?}")));
        let scenario = scenario(&settings)?;
        Ok(Self { case, task: Task::new(settings, &scenario) })
    }
}

/// Cases under the same assumptions.
pub(crate) fn points(
    cases: impl IntoIterator<Item = &'static Case>,
    more: &[(String, String)],
    outline: Outline,
    length: Length,
) -> Result<Vec<Point>, Error> {
    cases.into_iter().map(|case| Point::new(case, more, outline, length)).collect()
}

/// The scenario that settings over [`BASE`] make.
///
/// # Errors
/// Where a setting is not one that a scenario allows.
pub fn scenario(settings: &[(String, String)]) -> Result<Scenario, Error> {
    let loaded = document::read(BASE, settings).map_err(Error::Scenario)?;
    Ok(loaded.scenario)
}
