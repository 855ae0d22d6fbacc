//! The runs of a calibration: what a point of the unit cube means as a scenario, and what its run answers.

use super::fit::start_size;
use super::plan::settings;
use super::search::latin_hypercube;
use super::{Answer, FitPlan, Pattern, Target, Unfit};
use crate::campaign::{Row, fingerprint};
use crate::listener::Listener;
use crate::runner::{Beside, Ledger, RunnerError, Task, Work, run};
use brinell::document::Loaded;
use brinell::made_by::digest;
use brinell::result::{Quantity, RunResult};
use brinell::scenario::Scenario;
use brinell::simulate::{Observer, Simulation};
use std::collections::HashSet;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;

/// Reads the scenario with settings over it, or says on one line why there is none.
pub type Load<'a> = dyn Fn(&[(String, String)]) -> Result<Loaded, String> + Sync + 'a;

/// Why a calibration has no outcome.
#[derive(Debug, thiserror::Error)]
pub enum Unfinished {
    /// Files cannot be read or written.
    #[error(transparent)]
    Runner(#[from] RunnerError),
    /// The runs say nothing, or somebody stopped them.
    #[error("{unfit}")]
    Unfit {
        /// Which of these.
        unfit: Unfit,
        /// Why the first runs failed that did.
        reasons: Vec<String>,
    },
}

/// Scenarios from points.
pub struct Points<'a> {
    /// The scenario.
    pub load: &'a Load<'a>,
    /// What is fitted.
    pub plan: &'a FitPlan,
}

impl Points<'_> {
    /// What is to be run at a point, or why its scenario is bad.
    pub fn task(&self, place: &[f64]) -> Result<Task, String> {
        let settings = settings(&self.plan.keys, place);
        let scenario = (self.load)(&settings)?.scenario;
        Ok(Task { fingerprint: self.fingerprint(&scenario), ..Task::new(settings, &scenario) })
    }
}

impl Work for Points<'_> {
    type Error = RunnerError;

    fn scenario(&self, task: &Task) -> Result<Scenario, RunnerError> {
        (self.load)(&task.settings).map(|loaded| loaded.scenario).map_err(|_| RunnerError::Changed)
    }

    /// Of the scenario, and of what is taken from its signal.
    fn fingerprint(&self, scenario: &Scenario) -> String {
        let own = fingerprint(scenario);
        match &self.plan.pattern {
            Some(pattern) => digest(&format!("{own} {}", pattern.describe())),
            None => own,
        }
    }

    fn beside(&self, _: &Task, _: &Simulation) -> Option<Box<dyn Beside<RunnerError> + '_>> {
        Some(Box::new(Sensor { pattern: self.plan.pattern.as_ref()?, signal: Vec::new() }))
    }
}

/// Keeps what a run's sensor reads.
struct Sensor<'a> {
    pattern: &'a Pattern,
    signal: Vec<f64>,
}

impl Observer for Sensor<'_> {
    fn again(&mut self, _: &Simulation) -> ControlFlow<()> {
        self.signal.clear();
        ControlFlow::Continue(())
    }

    fn row(&mut self, _: u64, _: &[f64], filtered: &[f64]) -> ControlFlow<()> {
        self.signal.extend(filtered.get(self.pattern.axis));
        ControlFlow::Continue(())
    }
}

impl Beside<RunnerError> for Sensor<'_> {
    /// What its signal says from when the run had settled.
    fn finished(self: Box<Self>, finished: &RunResult) -> Result<Vec<Quantity>, RunnerError> {
        let settled = finished.findings.from * finished.simulation.sample_rate();
        let signal = self.signal.get(settled.ceil() as usize..).unwrap_or(&[]);
        Ok(self.pattern.quantities(signal, &finished.simulation))
    }
}

/// Answers batches from the journal, and runs what is not there.
pub(super) struct Runs<'a> {
    pub(super) points: Points<'a>,
    pub(super) ledger: Ledger,
    pub(super) threads: NonZeroUsize,
    pub(super) listener: &'a dyn Listener,
    /// Fingerprints of the runs of this call.
    pub(super) own: HashSet<String>,
    /// How often this call took from the journal what an earlier one had run.
    pub(super) before: usize,
    /// What ended the campaign, other than the user.
    pub(super) failure: Option<RunnerError>,
}

impl Runs<'_> {
    /// For [`fit`].
    pub(super) fn ask(&mut self, places: &[Vec<f64>]) -> Result<Vec<Option<Vec<Answer>>>, Unfit> {
        let wanted: Vec<Result<Task, String>> = places.iter().map(|place| self.points.task(place)).collect();
        let mut tasks: Vec<Task> = Vec::new();
        for task in wanted.iter().flatten() {
            if self.ledger.kept.row(&task.fingerprint).is_some() {
                // A place that is asked for again has a part of the budget, and is one more of what is over.
                self.listener.before(1);
                if !self.own.contains(&task.fingerprint) {
                    self.before += 1;
                }
            } else if !tasks.iter().any(|t| t.fingerprint == task.fingerprint) {
                tasks.push(task.clone());
            }
        }
        self.own.extend(tasks.iter().map(|task| task.fingerprint.clone()));
        match run(&tasks, &self.points, &mut self.ledger, self.threads, self.listener) {
            Ok(flow) if flow.is_continue() => {}
            Ok(_) => return Err(Unfit::Interrupted),
            Err(failure) => {
                self.failure = Some(failure);
                return Err(Unfit::Interrupted);
            }
        }
        let answer = |task: &Result<Task, String>| {
            let row = self.ledger.kept.row(&task.as_ref().ok()?.fingerprint)?;
            answers(row, &self.points.plan.targets)
        };
        Ok(wanted.iter().map(answer).collect())
    }

    /// The row of a point, or why it has none.
    pub(super) fn row(&self, place: &[f64]) -> Result<&Row, String> {
        let task = self.points.task(place)?;
        let row = self.ledger.kept.row(&task.fingerprint).ok_or("not run")?;
        match &row.result {
            Ok(_) => Ok(row),
            Err(reason) => Err(reason.clone()),
        }
    }

    /// The scenario of a point.
    pub(super) fn scenario(&self, place: &[f64]) -> Result<Loaded, RunnerError> {
        let settings = settings(&self.points.plan.keys, place);
        (self.points.load)(&settings).map_err(|_| RunnerError::Changed)
    }

    /// Why the first runs failed.
    pub(super) fn reasons(&self) -> Vec<String> {
        const SHOWN: usize = 3;
        let (keys, settings) = (self.points.plan.keys.len(), self.points.plan.settings);
        let mut reasons: Vec<String> = Vec::new();
        // The start lies in the journal or was never a scenario; its points follow from the seed.
        for place in latin_hypercube(settings.seed, keys, start_size(keys, settings.budget)) {
            if let Err(reason) = self.row(&place)
                && !reasons.contains(&reason)
                && reasons.len() < SHOWN
            {
                reasons.push(reason);
            }
        }
        reasons
    }
}

/// What a row says of the targets; `None` where its run failed.
fn answers(row: &Row, targets: &[Target]) -> Option<Vec<Answer>> {
    row.result.as_ref().ok()?;
    let one = |target: &Target| {
        let quantity = row.quantity(&target.name);
        Answer { value: quantity.and_then(|q| q.value), uncertainty: quantity.map_or(0.0, own_uncertainty) }
    };
    Some(targets.iter().map(one).collect())
}

/// Standard uncertainty of a run's number: half its 95 % interval over 1.96.
pub(super) fn own_uncertainty(quantity: &Quantity) -> f64 {
    let interval = quantity.estimate().and_then(|e| e.interval);
    interval.map_or(0.0, |i| i.standard_uncertainty())
}
