//! What is found in a signal, and its verdict in words.

use super::measured::{Measured, Rest};
use brinell::analysis::{Analysis, Comparison, Component, Levels};
use brinell::scenario::Surface;
use brinell::signal::VelocityBands;

/// Everything that words, JSON and page are made of.
pub(super) struct Diagnosis {
    pub(super) measured: Measured,
    /// What lies beyond the stretch, where the signal is longer than one analysis takes.
    pub(super) rest: Option<Rest>,
    pub(super) analysis: Analysis,
    /// Where the speed comes from.
    pub(super) speed: String,
    /// The bearing's name, where one was given.
    pub(super) name: String,
    /// Where the defect frequencies come from.
    pub(super) bearing: String,
    /// What is to be said in view of the machine's other bearings.
    pub(super) beside: Option<String>,
    /// The other bearing whose lines these are, where they are no frequency of this one.
    pub(super) lines_of: Option<String>,
    /// The end of a long signal.
    pub(super) last: Option<Analysis>,
    pub(super) velocity: Option<VelocityBands>,
    pub(super) levels: Levels,
    pub(super) against: Option<Against>,
}

impl Diagnosis {
    /// The verdict, and what is to be said beside it.
    pub(super) fn verdict_text(&self) -> String {
        let mut said = vec![self.analysis.verdict()];
        // What answers the question comes first.
        let at = if self.lines_of.is_some() { 0 } else { 1 };
        said.splice(at..at, self.beside.clone());
        said.extend(self.contradicted());
        said.join(" ")
    }

    /// The damaged parts in a word or two each, or what is said instead.
    pub(super) fn called(&self) -> String {
        let whose = self.lines_of.as_ref().map(|name| format!(", lines of {name}"));
        brinell_report::called(&self.analysis) + &whose.unwrap_or_default()
    }

    /// That parts are named which the run that made the signal had no damage on: the verdict itself knows nothing of
    /// it.
    fn contradicted(&self) -> Option<String> {
        let run = self.measured.scenario.as_deref()?;
        let is_damaged = |component: Component| {
            let on = |surface: Surface| match component {
                Component::OuterRace => surface == Surface::OuterRaceway,
                Component::InnerRace => surface == Surface::InnerRaceway,
                Component::Element => matches!(surface, Surface::Roller(_)),
                Component::Cage => false,
            };
            run.scenario.defects.iter().any(|d| on(d.on))
        };
        let mut wrong: Vec<&str> =
            (self.analysis.causes()).filter(|f| !is_damaged(f.component)).map(|f| f.component.words()).collect();
        wrong.dedup();
        (!wrong.is_empty()).then(|| {
            format!("Wrong: in the run that made the signal nothing was damaged on the {}.", wrong.join(" and the "))
        })
    }
}

/// What the signal is laid over, in the signal's unit.
pub(super) struct Against {
    pub(super) measured: Measured,
    pub(super) analysis: Analysis,
    pub(super) comparison: Comparison,
}
