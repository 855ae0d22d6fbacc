//! A run with all that is said of it: what every teller of results, file, page and terminal, is given.

use crate::document::Loaded;
use crate::observe::Findings;
use crate::plausibility::{Beforehand, after};
use crate::simulate::{Outcome, Simulation};

/// A run, before and after.
#[derive(Debug, Clone, Copy)]
pub struct Parts<'a> {
    /// Scenario with provenance and warnings.
    pub loaded: &'a Loaded,
    /// The run as prepared.
    pub simulation: &'a Simulation,
    /// Its outcome.
    pub outcome: &'a Outcome,
    /// What was gathered.
    pub findings: &'a Findings,
    /// What was known before: the static load distribution, and warnings.
    pub beforehand: &'a Beforehand,
    /// What was gathered of the same bearing without its damage, where that was run too.
    pub healthy: Option<&'a Findings>,
}

impl Parts<'_> {
    /// What the reader of the run should know, warnings of the scenario first.
    pub fn warnings(&self) -> Vec<String> {
        let Parts { loaded, simulation, outcome, findings, beforehand, .. } = *self;
        let before = loaded.warnings.iter().chain(&beforehand.warnings);
        before.map(ToString::to_string).chain(after(&loaded.scenario, simulation, outcome, findings)).collect()
    }
}
