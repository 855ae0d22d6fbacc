//! A reproduction from its request to its files: which runs it needs, what they decide, and what is written of that.

use crate::beside::{self, Joined};
use crate::models::{OtherRuns, OtherVerdicts};
use crate::outcome::Outcome;
use crate::request::Request;
use crate::runs::numbers;
use crate::sensitivity::{Plan, Sensitivity};
use crate::{Numbers, Point, Runs, Stage, claims, judge};
use brinell::scenario::Laws;
use std::ops::ControlFlow;

/// What came out of a [`Request`].
pub struct Reproduction {
    pub(crate) request: Request,
    pub(crate) numbers: Numbers,
    pub(crate) sensitivity: Option<Sensitivity>,
    pub(crate) models: Option<OtherVerdicts>,
    /// Under other laws than the paper's: the claims beside what is kept of the paper's.
    pub(crate) beside: Option<Vec<Joined>>,
    /// The claims that it decides, in the paper's order.
    pub outcomes: Vec<Outcome>,
    /// Case and reason of each run that failed.
    pub failures: Vec<(String, String)>,
    /// Whether runs are missing because they were interrupted.
    pub interrupted: bool,
}

impl Reproduction {
    /// Has all runs made, and decides the claims.
    ///
    /// # Errors
    /// Those of `runs`.
    pub fn run<R: Runs>(request: Request, runs: &mut R) -> Result<Self, R::Error> {
        let plan = request.plan.as_ref();
        let varied = plan.into_iter().flat_map(Plan::points);
        let others = request.models.iter().flat_map(OtherRuns::points);
        let points = request.starts().chain(&request.defaults).chain(varied).chain(others);
        let points: Vec<&Point> = points.collect();
        let mut flow = runs.make(&points, Stage::Cases)?;
        let mut sensitivity = None;
        if let (Some(plan), ControlFlow::Continue(())) = (plan, flow) {
            sensitivity = plan.run(runs)?;
            if sensitivity.is_none() {
                flow = ControlFlow::Break(());
            }
        }
        Ok(Self::decided(request, runs, sensitivity, flow.is_break()))
    }

    fn decided(request: Request, runs: &impl Runs, sensitivity: Option<Sensitivity>, interrupted: bool) -> Self {
        let numbers = numbers(request.starts(), runs);
        let has = |id: &str| request.points.iter().any(|p| p.case.id == id);
        let outcomes = claims().enumerate().filter_map(|(place, claim)| {
            let cases = claim.cases();
            // What cannot be checked belongs to the whole.
            // Contact by effective length is the paper's law: under others nothing goes in that could be found again.
            let by_law = request.laws != Laws::Li2023 && !claim.counts();
            let wanted = !by_law && cases.iter().all(|id| has(id)) && (request.whole || !cases.is_empty());
            let judged = judge(claim, &numbers);
            let flips = sensitivity.as_ref().map_or(Vec::new(), |s| s.flips(place));
            let unchanged = sensitivity.as_ref().and_then(|s| s.unchanged(place));
            wanted.then_some(Outcome { claim, judged, flips, unchanged })
        });
        let failures = request.starts().chain(&request.defaults).filter_map(|point| {
            let row = runs.row(&point.task.fingerprint)?;
            let reason = row.result.as_ref().err()?;
            Some((point.case.label.to_owned(), reason.clone()))
        });
        let outcomes: Vec<Outcome> = outcomes.collect();
        let models = request.models.as_ref();
        Self {
            models: models.map(|others| others.verdicts(&outcomes, runs)),
            beside: match request.laws {
                Laws::Li2023 => None,
                Laws::Mechanics => Some(beside::join(&outcomes, &self::numbers(&request.defaults, runs))),
            },
            outcomes,
            failures: failures.collect(),
            request,
            numbers,
            sensitivity,
            interrupted,
        }
    }

    /// What the search for a set of assumptions found, in a sentence or two, where there was one.
    pub fn search_result(&self) -> Option<String> {
        self.sensitivity.as_ref().map(Sensitivity::found)
    }

    /// What other laws change, in a sentence, where the request is under others than the paper's.
    pub fn laws_result(&self) -> Option<String> {
        self.beside.as_deref().map(beside::found)
    }

    /// A claim's verdict, "depends" where an assumption turns it; under other laws than the paper's what becomes of it.
    pub fn words(&self, outcome: &Outcome) -> String {
        let joined = self.beside.iter().flatten().find(|joined| joined.claim.id == outcome.claim.id);
        match joined {
            Some(joined) => format!("{} ({})", outcome.words(), joined.change().words()),
            None => outcome.words().into(),
        }
    }

    /// What tilting changes, in a sentence, where that was requested.
    pub fn tilting_result(&self) -> Option<String> {
        self.models.as_ref().map(OtherVerdicts::found)
    }
}
