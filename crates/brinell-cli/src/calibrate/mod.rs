//! `brinell calibrate`: keys within bounds to targets; the best set, how sure it is, and what the data leave open.

mod args;
mod measured;
mod outcome;
mod page;
mod runs;
mod words;

use crate::campaign;
use crate::failure::Failure;
use crate::files::make_folder;
use crate::files::{Source, stem};
use crate::progress::Joint;
use crate::results::{Place, Results};
use crate::say::{self, complain, plural, say, short};
use crate::stop::stop_flag;
use crate::sweep::duration;
pub(crate) use args::CalibrateArgs;
use brinell::document::Loaded;
use brinell::result::{check_name, names};
use brinell::simulate::Simulation;
use brinell_study::calibrate::search::latin_hypercube;
use brinell_study::calibrate::{
    CalibrateError, Key, Settings, Target, Unfit, check_keys, check_targets, fit, least_budget, start_size,
};
use brinell_study::campaign::fingerprint;
use brinell_study::runner::{JOURNAL, Ledger, Task, estimate};
use measured::Pattern;
use outcome::Outcome;
use runs::{FromPoints, Runs, settings};
use serde_json::{Value, json};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// Runs for each key where no budget is given.
const RUNS_PER_KEY: usize = 30;

/// A calibration before it runs.
struct Plan {
    source: Source,
    keys: Vec<Key>,
    /// Unit of each key.
    units: Vec<&'static str>,
    targets: Vec<Target>,
    pattern: Option<Pattern>,
    settings: Settings,
    /// The scenario in the middle of the bounds.
    middle: Loaded,
}

pub(crate) fn calibrate(args: &CalibrateArgs) -> Result<ExitCode, Failure> {
    let begin = Instant::now();
    let plan = Plan::read(args)?;
    let threads = args.jobs.unwrap_or(brinell::many::threads(usize::MAX));
    let points = FromPoints { source: &plan.source, keys: &plan.keys, pattern: plan.pattern.as_ref() };
    if args.dry_run {
        plan.tell(&points, threads, None);
        return Ok(ExitCode::SUCCESS);
    }
    let named = || Path::new("out").join(format!("calibrate-{}", stem(&args.scenario)));
    let folder = args.output.clone().unwrap_or_else(named);
    let mut inputs = plan.source.inputs();
    args.measured.iter().for_each(|path| inputs.add(path));
    let place = Place { kind: Results::Calibration, folder: &folder, inputs: &inputs };
    place.alone()?;
    make_folder(&folder)?;
    let words = |other: &Value| other_calibration(&folder, other);
    let ledger = campaign::ledger(&folder, &plan.header(), args.extend, words)?;
    if !args.quiet {
        plan.tell(&points, threads, Some(&ledger));
    }
    let stop = stop_flag()?;
    let each = plan.middle.scenario.simulation.duration_s;
    let total = each * plan.settings.budget as f64;
    let mut runs = Runs {
        points,
        targets: &plan.targets,
        ledger,
        threads,
        joint: Joint::new(plan.settings.budget, total, args.quiet),
        stop: &stop,
        done: 0,
        before: 0,
        failure: None,
    };
    let mut ask = |places: &[Vec<f64>]| runs.ask(places);
    let found = fit(plan.keys.len(), &plan.targets, plan.settings, &mut ask);
    runs.joint.clear();
    if let Some(failure) = runs.failure.take() {
        return Err(failure);
    }
    let found = match found {
        Ok(found) => found,
        Err(Unfit::Interrupted) => {
            complain!(
                "interrupted: finished runs are kept in {}; the same command resumes where this one stopped",
                folder.join(JOURNAL).display()
            );
            return Ok(ExitCode::FAILURE);
        }
        Err(error) => {
            complain!("error: {error}");
            tell_reasons(&runs, &plan);
            return Ok(ExitCode::FAILURE);
        }
    };
    let outcome = Outcome::new(&plan, &runs, found)?;
    let written = outcome.write(&folder)?;
    if args.json {
        say::json(&outcome.json());
    }
    if !args.quiet {
        tell(&runs, &outcome, &written, begin);
    }
    Ok(ExitCode::SUCCESS)
}

fn tell(runs: &Runs, outcome: &Outcome, written: &[PathBuf], begin: Instant) {
    say!("{} in {:.2} s, {} from the journal", plural(runs.done, "run"), begin.elapsed().as_secs_f64(), runs.before);
    outcome.tell();
    say::wrote(written);
}

fn usage(error: &CalibrateError, option: &str) -> Failure {
    Failure::Usage(format!("{option}: {error}"))
}

impl Plan {
    /// Reads and checks everything, before anything runs.
    fn read(args: &CalibrateArgs) -> Result<Self, Failure> {
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
    fn header(&self) -> Value {
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

    fn tell(&self, points: &FromPoints, threads: NonZeroUsize, ledger: Option<&Ledger>) {
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

/// The folder's journal is of something else.
fn other_calibration(folder: &Path, other: &Value) -> String {
    let folder = folder.display();
    if other["campaign"] != "calibrate" {
        let kind = other["campaign"].as_str().unwrap_or("something else");
        return format!("{folder}/{JOURNAL} is the journal of {kind}; choose another folder with -o");
    }
    let keys = other["keys"].as_array().into_iter().flatten();
    let keys: Vec<&str> = keys.filter_map(|k| k["key"].as_str()).collect();
    format!(
        "{folder} holds another calibration, of {}, with other bounds, targets, seed or base scenario; choose another folder with -o, or go on in \
         it with --extend, where runs of the same scenario count",
        keys.join(", ")
    )
}

/// Why the first runs failed.
fn tell_reasons(runs: &Runs, plan: &Plan) {
    const SHOWN: usize = 3;
    let size = plan.settings.budget;
    let mut reasons: Vec<String> = Vec::new();
    // The start lies in the journal or was never a scenario; its points follow from the seed.
    for place in latin_hypercube(plan.settings.seed, plan.keys.len(), start_size(plan.keys.len(), size)) {
        if let Err(reason) = runs.row(&place)
            && !reasons.contains(&reason)
            && reasons.len() < SHOWN
        {
            complain!("  a run failed: {reason}");
            reasons.push(reason);
        }
    }
}
