//! The runs of a calibration: what a point of the unit cube means as a scenario, and what its run answers.

use super::measured::Pattern;
use crate::campaign;
use crate::failure::Failure;
use crate::files::Source;
use crate::progress::Joint;
use brinell::result::{Quantity, RunResult};
use brinell::scenario::Scenario;
use brinell::simulate::{Observer, Simulation};
use brinell_study::calibrate::{Answer, Key, Target, Unfit};
use brinell_study::campaign::{Row, digest, fingerprint};
use brinell_study::runner::{Beside, Ledger, Task, Work};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

/// Scenarios from points.
pub(super) struct FromPoints<'a> {
    pub(super) source: &'a Source,
    pub(super) keys: &'a [Key],
    pub(super) pattern: Option<&'a Pattern>,
}

/// What a point of the unit cube gives the keys.
pub(super) fn settings(keys: &[Key], place: &[f64]) -> Vec<(String, String)> {
    keys.iter().zip(place).map(|(key, unit)| (key.name.clone(), key.text(*unit))).collect()
}

impl FromPoints<'_> {
    /// What is to be run at a point, or why its scenario is bad.
    pub(super) fn task(&self, place: &[f64]) -> Result<Task, String> {
        let settings = settings(self.keys, place);
        let loaded = self.source.load(&settings, true);
        let scenario = loaded.map_err(|failure| crate::sweep::reason(&failure))?.scenario;
        Ok(Task { fingerprint: self.fingerprint(&scenario), ..Task::new(settings, &scenario) })
    }
}

impl Work for FromPoints<'_> {
    type Error = Failure;

    fn scenario(&self, task: &Task) -> Result<Scenario, Failure> {
        Ok(self.source.load(&task.settings, true)?.scenario)
    }

    /// Of the scenario, and of what is taken from its signal.
    fn fingerprint(&self, scenario: &Scenario) -> String {
        let own = fingerprint(scenario);
        match self.pattern {
            Some(pattern) => {
                let signature = pattern.signature.describe();
                digest(&format!("{own} {} {signature}", pattern.channel))
            }
            None => own,
        }
    }

    fn beside(&self, _: &Task, _: &Simulation) -> Option<Box<dyn Beside<Failure> + '_>> {
        Some(Box::new(Sensor { pattern: self.pattern?, signal: Vec::new() }))
    }
}

/// Keeps what a run's sensor reads.
struct Sensor<'a> {
    pattern: &'a Pattern,
    signal: Vec<f64>,
}

impl Observer for Sensor<'_> {
    fn row(&mut self, _: u64, _: &[f64], filtered: &[f64]) -> ControlFlow<()> {
        self.signal.extend(filtered.get(self.pattern.axis));
        ControlFlow::Continue(())
    }
}

impl Beside<Failure> for Sensor<'_> {
    /// The levels from when the run had settled.
    fn finished(self: Box<Self>, finished: &RunResult) -> Result<Vec<Quantity>, Failure> {
        let settled = finished.findings.from * finished.simulation.sample_rate();
        Ok(self.pattern.quantities(self.signal.get(settled.ceil() as usize..).unwrap_or(&[])))
    }
}

/// Answers batches from the journal, and runs what is not there.
pub(super) struct Runs<'a> {
    pub(super) points: FromPoints<'a>,
    pub(super) targets: &'a [Target],
    pub(super) ledger: Ledger,
    pub(super) threads: NonZeroUsize,
    pub(super) joint: Joint,
    pub(super) stop: &'a AtomicBool,
    /// Runs of this call, and what it took from the journal.
    pub(super) done: usize,
    pub(super) before: usize,
    /// What ended the campaign, other than the user.
    pub(super) failure: Option<Failure>,
}

impl Runs<'_> {
    /// For [`brinell_study::calibrate::fit`].
    pub(super) fn ask(&mut self, places: &[Vec<f64>]) -> Result<Vec<Option<Vec<Answer>>>, Unfit> {
        let wanted: Vec<Result<Task, String>> = places.iter().map(|place| self.points.task(place)).collect();
        let mut tasks: Vec<Task> = Vec::new();
        for task in wanted.iter().flatten() {
            if self.ledger.kept.row(&task.fingerprint).is_some() {
                self.before += 1;
                self.joint.done_before(task.duration_s);
            } else if !tasks.iter().any(|t| t.fingerprint == task.fingerprint) {
                tasks.push(task.clone());
            }
        }
        self.done += tasks.len();
        let outcome =
            campaign::run_within(&tasks, &self.points, &mut self.ledger, self.threads, &self.joint, self.stop);
        match outcome {
            Ok(flow) if flow.is_continue() => {}
            Ok(_) => return Err(Unfit::Interrupted),
            Err(failure) => {
                self.failure = Some(failure);
                return Err(Unfit::Interrupted);
            }
        }
        let answer = |task: &Result<Task, String>| {
            let row = self.ledger.kept.row(&task.as_ref().ok()?.fingerprint)?;
            answers(row, self.targets)
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
