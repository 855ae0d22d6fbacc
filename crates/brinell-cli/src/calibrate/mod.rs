//! `brinell calibrate`: keys within bounds to targets; the best set, how sure it is, and what the data leave open.

mod args;
mod measured;

use crate::campaign::{self, Terminal};
use crate::failure::{ExitCode, Failure};
use crate::files::make_folder;
use crate::files::{Source, stem};
use crate::results::{Resumed, put};
use crate::say::{self, complain, plural, pretty, say, short, twelve_digits};
use crate::stop::stop_flag;
use crate::sweep::duration;
pub(crate) use args::CalibrateArgs;
use brinell::simulate::Simulation;
use brinell_report::{Page, calibration_undetermined, calibration_verdict, digits_beside, interval_text};
use brinell_study::calibrate::search::latin_hypercube;
use brinell_study::calibrate::{
    CalibrateError, FitPlan, Key, Load, Outcome, Points, Settings, Target, Unfinished, Unfit, bounds, check_keys,
    middle,
};
use brinell_study::campaign::is_inside;
use brinell_study::runner::{JOURNAL, Ledger, Task, estimate};
use serde_json::Value;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

pub(crate) fn calibrate(args: &CalibrateArgs) -> Result<ExitCode, Failure> {
    let begin = Instant::now();
    let (source, plan, warnings) = read(args)?;
    let threads = args.jobs.unwrap_or(brinell::many::threads(usize::MAX));
    let load: &Load<'_> = &|settings| source.variant(settings);
    let points = Points { load, plan: &plan };
    if args.dry_run {
        match args.json {
            true => say::json(&plan_json(&points, &warnings, threads)),
            false => tell_plan(&points, &warnings, threads, None),
        }
        return Ok(ExitCode::SUCCESS);
    }
    let named = || Path::new("out").join(format!("calibrate-{}", stem(&args.scenario)));
    let folder = args.output.clone().unwrap_or_else(named);
    let mut inputs = source.inputs();
    args.measured.iter().for_each(|path| inputs.add(path));
    Resumed::Study.may_write(&folder, &inputs)?;
    make_folder(&folder)?;
    let words = |other: &Value| other_calibration(&folder, other);
    let ledger = campaign::ledger(&folder, &plan.header(), args.extend, words)?;
    if !args.quiet {
        tell_plan(&points, &warnings, threads, Some(&ledger));
    }
    let stop = stop_flag()?;
    let each = plan.middle.scenario.simulation.duration_s;
    let budget = plan.settings.budget;
    let terminal = Terminal::new(budget, each * budget as f64, args.quiet, &stop);
    let found = brinell_study::calibrate::calibrate(&plan, load, ledger, threads, &terminal);
    drop(terminal);
    let outcome = match found {
        Ok(outcome) => outcome,
        Err(Unfinished::Runner(error)) => return Err(error.into()),
        Err(Unfinished::Unfit { unfit: Unfit::Interrupted, .. }) => {
            complain!(
                "interrupted: finished runs are kept in {}; the same command resumes where this one stopped",
                folder.join(JOURNAL).display()
            );
            return Ok(ExitCode::FAILURE);
        }
        Err(Unfinished::Unfit { unfit, reasons }) => {
            complain!("error: {unfit}");
            for reason in reasons {
                complain!("  a run failed: {reason}");
            }
            return Ok(ExitCode::FAILURE);
        }
    };
    let (verdict, undetermined) = (calibration_verdict(&outcome), calibration_undetermined(&outcome));
    let json = outcome.to_json(&verdict, &undetermined);
    let written = write(&outcome, &json, &folder)?;
    if args.json {
        say::json(&json);
    }
    if !args.quiet {
        let seconds = begin.elapsed().as_secs_f64();
        say!("{} in {seconds:.2} s, {} from the journal", plural(outcome.done, "run"), outcome.before);
        for found in &outcome.found {
            say!("  {} = {} {}  {}", found.key.name, short(found.best, 5), found.unit, interval_text(found));
        }
        for sentence in verdict.iter().chain(&undetermined) {
            say!("  {sentence}");
        }
        say::wrote(&written);
        outcome.warnings.iter().for_each(|warning| complain!("{warning}"));
    }
    Ok(ExitCode::SUCCESS)
}

/// Everything that the calibration leaves; the same runs give the same bytes.
fn write(outcome: &Outcome, json: &Value, folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let mut written = vec![outcome.table().write_csv(folder.join("calibrate.csv"))?];
    put(folder, "calibrate.json", &pretty(json), &mut written)?;
    put(folder, "best.toml", &outcome.best.to_toml(), &mut written)?;
    let page = brinell_report::html(&Page::of_outcome(outcome));
    put(folder, "calibrate.html", &page, &mut written)?;
    Ok(written)
}

fn usage(error: &CalibrateError, option: &str) -> Failure {
    Failure::Usage(format!("{option}: {error}"))
}

/// Reads and checks everything, before anything runs. What deserves attention comes with it.
fn read(args: &CalibrateArgs) -> Result<(Source, Arc<FitPlan>, Vec<String>), Failure> {
    let keys: Vec<Key> =
        (args.fit.iter()).map(|text| Key::read(text).map_err(|e| usage(&e, "--fit"))).collect::<Result<_, _>>()?;
    check_keys(&keys).map_err(|e| usage(&e, "--fit"))?;
    let targets: Vec<Target> = (args.target.iter())
        .map(|text| Target::read(text).map_err(|e| usage(&e, "--target")))
        .collect::<Result<_, _>>()?;
    let source = Source::open(&args.scenario, &args.set)?;
    for (key, value) in source.overrides() {
        // The speed that a measured signal is looked at with, where it is fitted.
        let is_of_signal = args.measured.is_some() && key == "operation.speed_rpm";
        if let Some(fitted) = keys.iter().find(|fitted| !is_of_signal && is_inside(key, &fitted.name)) {
            return Err(Failure::Usage(format!(
                "--set {key}={value}: every run gives {} another value, as --fit says; leave out the one or the other",
                fitted.name
            )));
        }
    }
    for settings in bounds(&keys) {
        source.load(&settings, true)?;
    }
    let middle = source.load(&middle(&keys), false)?;
    let simulation = Simulation::unchecked(&middle.scenario)?;
    let pattern = measured::pattern(args, (&source, &keys), (&middle.scenario, &simulation))?;
    let (pattern, warnings) = pattern.map_or((None, Vec::new()), |(pattern, warnings)| (Some(pattern), warnings));
    let plan = FitPlan::new(keys, targets, pattern, middle, &simulation, args.seed, args.budget);
    let plan = plan.map_err(|error| match &error {
        CalibrateError::Name(_) => Failure::Usage(format!("--target {error}")),
        CalibrateError::Budget { budget, .. } => Failure::Usage(format!("--budget {budget}: {error}")),
        CalibrateError::NoTarget => Failure::Usage(
            "there is nothing to fit to: give --target NAME=VALUE~UNCERTAINTY, or --measured FILE".into(),
        ),
        _ => usage(&error, "--target"),
    })?;
    Ok((source, Arc::new(plan), warnings))
}

fn tell_plan(points: &Points, warnings: &[String], threads: NonZeroUsize, ledger: Option<&Ledger>) {
    let plan = points.plan;
    say!("{} to {}:", plural(plan.keys.len(), "key"), plural(plan.targets.len(), "target"));
    for (key, unit) in plan.keys.iter().zip(&plan.units) {
        let log = if key.log { ", in its logarithm" } else { "" };
        say!("  {} from {:?} to {:?} {unit}{log}", key.name, key.low, key.high);
    }
    for note in plan.pattern.iter().flat_map(|pattern| &pattern.notes) {
        say!("  {note}");
    }
    for warning in warnings {
        complain!("warning: {warning}");
    }
    for (target, unit) in plan.targets.iter().zip(&plan.target_units) {
        let value = short(target.value, digits_beside(target.value, target.uncertainty));
        say!("  {}", format!("{} = {value} ~ {} {unit}", target.name, short(target.uncertainty, 2)).trim_end());
    }
    let budget = plan.settings.budget;
    let cost = wall_s(points, threads).map_or(String::new(), |seconds| format!(", about {}", duration(seconds)));
    let simulated = simulated_s(plan);
    say!("  up to {}: {} s simulated, {} at a time{cost}", plural(budget, "run"), short(simulated, 3), threads);
    let kept = ledger.map_or(0, |l| l.kept.len());
    if kept > 0 {
        say!("  {} in the journal, not to be run again", plural(kept, "run"));
    }
}

/// The same as JSON.
fn plan_json(points: &Points, warnings: &[String], threads: NonZeroUsize) -> Value {
    let plan = points.plan;
    let mut json = plan.header();
    let of_keys = plan.units.iter().enumerate().map(|(k, unit)| ("keys", k, *unit));
    let of_targets = plan.target_units.iter().enumerate().map(|(k, unit)| ("targets", k, unit.as_str()));
    for (list, k, unit) in of_keys.chain(of_targets) {
        json[list][k]["unit"] = unit.into();
    }
    json["notes"] = plan.pattern.iter().flat_map(|pattern| pattern.notes.clone()).collect();
    json["runs"] = plan.settings.budget.into();
    json["simulated_s"] = twelve_digits(simulated_s(plan)).into();
    json["at_a_time"] = threads.get().into();
    json["wall_s"] = wall_s(points, threads).map(f64::ceil).into();
    json["warnings"] = warnings.into();
    json
}

/// What all runs simulate, s.
fn simulated_s(plan: &FitPlan) -> f64 {
    plan.middle.scenario.simulation.duration_s * plan.settings.budget as f64
}

/// What they take, s; `None` where no trial ran.
fn wall_s(points: &Points, threads: NonZeroUsize) -> Option<f64> {
    let Settings { seed, budget } = points.plan.settings;
    let sample = latin_hypercube(seed, points.plan.keys.len(), budget.min(100));
    let tasks: Vec<Task> = sample.iter().filter_map(|p| points.task(p).ok()).collect();
    let scale = budget as f64 / tasks.len().max(1) as f64;
    estimate(&tasks, points, threads).map(|seconds| scale * seconds)
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
