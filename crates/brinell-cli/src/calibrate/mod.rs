//! `brinell calibrate`: keys within bounds to targets; the best set, how sure it is, and what the data leave open.

mod args;
mod measured;
mod outcome;
mod page;
mod plan;
mod runs;
mod words;

use crate::campaign;
use crate::failure::Failure;
use crate::files::{make_folder, stem};
use crate::progress::Joint;
use crate::results::{Place, Results};
use crate::say::{self, complain, say};
use crate::stop::stop_flag;
use crate::sweep::plural;
pub(crate) use args::CalibrateArgs;
use brinell_study::calibrate::search::latin_hypercube;
use brinell_study::calibrate::{Unfit, fit, start_size};
use brinell_study::runner::JOURNAL;
use outcome::Outcome;
use plan::Plan;
use runs::{FromPoints, Runs};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

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
