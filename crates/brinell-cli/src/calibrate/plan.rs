//! A calibration before it runs: keys, targets, budget and scenario, all checked.

use super::CalibrateArgs;
use super::measured::{self, Pattern};
use super::runs::{FromPoints, settings};
use crate::failure::Failure;
use crate::files::Source;
use crate::say::{complain, say, short};
use crate::sweep::{duration, plural};
use brinell::document::Loaded;
use brinell::result::{check_name, names};
use brinell::simulate::Simulation;
use brinell_study::calibrate::search::latin_hypercube;
use brinell_study::calibrate::{CalibrateError, Key, Settings, Target, check_keys, check_targets, least_budget};
use brinell_study::campaign::fingerprint;
use brinell_study::runner::{Ledger, Task, estimate};
use serde_json::{Value, json};
use std::num::NonZeroUsize;

/// Runs for each key where no budget is given.
const RUNS_PER_KEY: usize = 30;

/// A calibration before it runs.
pub(super) struct Plan {
    pub(super) source: Source,
    pub(super) keys: Vec<Key>,
    /// Unit of each key.
    pub(super) units: Vec<&'static str>,
    pub(super) targets: Vec<Target>,
    pub(super) pattern: Option<Pattern>,
    pub(super) settings: Settings,
    /// The scenario in the middle of the bounds.
    pub(super) middle: Loaded,
}

fn usage(error: &CalibrateError, option: &str) -> Failure {
    Failure::Usage(format!("{option}: {error}"))
}

impl Plan {
    /// Reads and checks everything, before anything runs.
    pub(super) fn read(args: &CalibrateArgs) -> Result<Self, Failure> {
        let keys: Vec<Key> =
            (args.fit.iter()).map(|text| Key::read(text).map_err(|e| usage(&e, "--fit"))).collect::<Result<_, _>>()?;
        check_keys(&keys).map_err(|e| usage(&e, "--fit"))?;
        let mut targets: Vec<Target> = (args.target.iter())
            .map(|text| Target::read(text).map_err(|e| usage(&e, "--target")))
            .collect::<Result<_, _>>()?;
        let source = Source::open(&args.scenario, &args.set)?;
        let centre = vec![0.5; keys.len()];
        for k in 0..keys.len() {
            for end in [0.0, 1.0] {
                let mut places = centre.clone();
                places[k] = end;
                source.load(&settings(&keys, &places), true)?;
            }
        }
        let middle = source.load(&settings(&keys, &centre), false)?;
        let unit = |key: &Key| middle.provenance_of(&key.name).map_or("", |p| p.unit);
        let units = keys.iter().map(unit).collect();
        let simulation = Simulation::new(&middle.scenario).map_err(Failure::Run)?;
        let names = names(&middle.scenario, &simulation);
        for target in &targets {
            check_name(&target.name, &names).map_err(|error| Failure::Usage(format!("--target {error}")))?;
        }
        let pattern = measured::pattern(args, &middle.scenario, &simulation)?;
        if let Some(pattern) = &pattern {
            // A target that is given outweighs what the signal says of the same number.
            let given = |t: &&Target| !targets.iter().any(|g| g.name == t.name);
            let more: Vec<Target> = pattern.targets.iter().filter(given).cloned().collect();
            targets.extend(more);
        }
        if targets.is_empty() {
            return Err(Failure::Usage(
                "there is nothing to fit to: give --target NAME=VALUE~UNCERTAINTY, or --measured FILE".into(),
            ));
        }
        check_targets(&targets).map_err(|e| usage(&e, "--target"))?;
        let least = least_budget(keys.len());
        let budget = args.budget.unwrap_or(RUNS_PER_KEY * keys.len());
        if budget < least {
            return Err(Failure::Usage(format!(
                "--budget {budget}: expected {least} runs or more for {}: a start, and two runs a key for its uncertainty",
                plural(keys.len(), "key")
            )));
        }
        Ok(Self { settings: Settings { seed: args.seed, budget }, source, keys, units, targets, pattern, middle })
    }

    /// What distinguishes this calibration from others. A larger budget resumes the same one.
    pub(super) fn header(&self) -> Value {
        let keys: Vec<Value> =
            (self.keys.iter()).map(|k| json!({ "key": k.name, "low": k.low, "high": k.high, "log": k.log })).collect();
        let targets: Vec<Value> = (self.targets.iter())
            .map(|t| json!({ "name": t.name, "value": t.value, "standard_uncertainty": t.uncertainty }))
            .collect();
        json!({
            "campaign": "calibrate",
            "keys": keys,
            "targets": targets,
            "seed": self.settings.seed,
            "scenario": fingerprint(&self.middle.scenario),
        })
    }

    pub(super) fn tell(&self, points: &FromPoints, threads: NonZeroUsize, ledger: Option<&Ledger>) {
        say!("{} to {}:", plural(self.keys.len(), "key"), plural(self.targets.len(), "target"));
        for (key, unit) in self.keys.iter().zip(&self.units) {
            let log = if key.log { ", in its logarithm" } else { "" };
            say!("  {} from {:?} to {:?} {unit}{log}", key.name, key.low, key.high);
        }
        if let Some(pattern) = &self.pattern {
            for note in &pattern.notes {
                say!("  {note}");
            }
            for warning in &pattern.warnings {
                complain!("warning: {warning}");
            }
        }
        for target in &self.targets {
            say!("  {} = {} ~ {}", target.name, short(target.value, 5), short(target.uncertainty, 2));
        }
        let budget = self.settings.budget;
        let sample = latin_hypercube(self.settings.seed, self.keys.len(), budget.min(100));
        let tasks: Vec<Task> = sample.iter().filter_map(|p| points.task(p).ok()).collect();
        let scale = budget as f64 / tasks.len().max(1) as f64;
        let cost = estimate(&tasks, points, threads)
            .map_or(String::new(), |seconds| format!(", about {}", duration(scale * seconds)));
        let simulated = self.middle.scenario.simulation.duration_s * budget as f64;
        say!("  up to {}: {} s simulated, {} at a time{cost}", plural(budget, "run"), short(simulated, 3), threads);
        let kept = ledger.map_or(0, |l| l.kept.len());
        if kept > 0 {
            say!("  {} in the journal, not to be run again", plural(kept, "run"));
        }
    }
}
