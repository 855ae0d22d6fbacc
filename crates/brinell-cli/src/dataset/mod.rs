//! `brinell dataset`: a plan to thousands of labelled signals.

mod args;
mod plan;
mod sheet;

use crate::campaign::Terminal;
use crate::failure::{ExitCode, Failure};
use crate::files::safe_name;
use crate::inputs::Inputs;
use crate::results::Resumed;
use crate::say::{self, complain, document, plural, say};
use crate::stop::stop_flag;
pub(crate) use args::DatasetArgs;
use args::{DatasetCommand, MergeArgs, VerifyArgs};
use brinell::signal::objects;
use brinell_study::dataset::{Campaign, DatasetError, Merged, ShardSummary, merge, run, scenario_of, verify};
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// Failed runs that are printed.
const SHOWN: usize = 10;

impl From<DatasetError> for Failure {
    fn from(error: DatasetError) -> Self {
        match error {
            DatasetError::Document { name, text, problems } => Self::Scenario { name, text, problems },
            DatasetError::Refused(message) => Self::Usage(message),
            DatasetError::Read { path, error } => Self::Read(path, error),
            error @ DatasetError::NoFolder { .. } => Self::Usage(error.to_string()),
            DatasetError::Io(error) => Self::Write(error),
        }
    }
}

pub(crate) fn dataset(args: &DatasetArgs) -> Result<ExitCode, Failure> {
    match (&args.command, &args.plan) {
        (Some(DatasetCommand::Merge(args)), _) => join(args),
        (Some(DatasetCommand::Verify(args)), _) => check(args),
        (Some(DatasetCommand::Sheet(args)), _) => sheet::draw(args),
        (Some(DatasetCommand::Scenario(args)), _) => {
            document(scenario_of(&args.folder, args.run)?.trim_end());
            Ok(ExitCode::SUCCESS)
        }
        (None, Some(plan)) => make(args, plan),
        (None, None) => Err(Failure::Usage("give a plan, for instance `brinell dataset plan.toml`".into())),
    }
}

fn make(args: &DatasetArgs, path: &Path) -> Result<ExitCode, Failure> {
    let begin = Instant::now();
    let campaign = Campaign::open(path)?;
    let name = safe_name(&campaign.plan().name);
    let folder = args.output.clone().unwrap_or_else(|| Path::new("out").join(name));
    let mut inputs = Inputs::default();
    for (path, _) in [campaign.plan_file(), campaign.base_file()] {
        inputs.add(path);
    }
    Resumed::DataSet.may_write(&folder, &inputs)?;
    let parts = (0..campaign.parts()).filter(|part| args.shard.has(*part));
    let runs: usize = parts.map(|part| campaign.runs_of(part).len()).sum();
    if runs == 0 && !args.quiet {
        let files = plural(campaign.parts(), "file");
        complain!(
            "warning: --shard: this shard is empty, as the plan has {files} in all; smaller files: runs_per_file"
        );
    }
    let threads = args.jobs.unwrap_or(brinell::many::threads(runs));
    // A folder that was begun has seen this plan looked over.
    let begun = folder.join("work").join("campaign.json").exists();
    if args.dry_run || !begun {
        let survey = campaign.survey(&AtomicBool::new(false));
        plan::tell(&campaign, &survey, runs, threads, args);
        campaign.sound(&survey)?;
        if args.dry_run && args.json {
            say::json(&plan::json(&campaign, &survey, runs, threads));
        }
    }
    if args.dry_run {
        return Ok(ExitCode::SUCCESS);
    }
    let stop = stop_flag()?;
    let duration = campaign.scenario(0).map_or(1.0, |(l, _)| l.scenario.simulation.duration_s);
    let terminal = Terminal::new(runs, duration * runs as f64, args.quiet, &stop);
    let shard = run(&campaign, &folder, args.shard, threads, &terminal);
    let failures = terminal.failures();
    tell_failures(&failures);
    let shard = shard?;
    let left = shard.runs - shard.done - shard.before;
    let heed = shard.warnings(&campaign);
    if args.json {
        say::json(&summary(&shard, left, &folder, &failures, &heed));
    }
    if !args.quiet {
        tell(&shard, left, &folder, begin.elapsed().as_secs_f64());
        if shard.whole {
            plan::tell_splits(&campaign);
        }
        heed.iter().for_each(|words| complain!("warning: {words}"));
    }
    if shard.interrupted {
        complain!("interrupted: {left} to go; the same command resumes where this one stopped");
        return Ok(ExitCode::FAILURE);
    }
    Ok(ExitCode::SUCCESS)
}

fn tell_failures(failures: &[(usize, String)]) {
    for (run, reason) in failures.iter().take(SHOWN) {
        complain!("run {run} failed: {}", reason.lines().next().unwrap_or(""));
    }
    if failures.len() > SHOWN {
        complain!("and {} more: see the column `reason`", failures.len() - SHOWN);
    }
}

objects! {
    /// What `generate` did.
    Ran {
        folder: String, complete: bool, shard: Runs, interrupted: bool, failures: Vec<Failed>, warnings: Vec<String>,
    }
    /// Runs of the shard.
    Runs { runs: usize, done: usize, before: usize, to_go: usize }
    /// Why a run has no result.
    Failed { run: usize, reason: String }
    /// What `merge` did.
    Joined<'a> { folder: String, files: &'a Merged }
    /// What `check` found.
    Verified<'a> { folder: String, files: Files, runs: Rows, absent: &'a [String], problems: &'a [String] }
    /// Files that are there and whole, of all.
    Files { sound: usize, of: usize }
    /// Runs of those.
    Rows { complete: u64, failed: u64 }
}

/// What [`tell`] and [`tell_failures`] say, as JSON.
fn summary(shard: &ShardSummary, left: usize, folder: &Path, failures: &[(usize, String)], heed: &[String]) -> Ran {
    let failures = failures.iter().map(|(run, reason)| Failed { run: *run, reason: reason.clone() });
    Ran {
        folder: folder.display().to_string(),
        complete: shard.whole,
        shard: Runs { runs: shard.runs, done: shard.done, before: shard.before, to_go: left },
        interrupted: shard.interrupted,
        failures: failures.collect(),
        warnings: heed.to_vec(),
    }
}

/// How many runs are there, and whether the data set is complete.
fn tell(shard: &ShardSummary, left: usize, folder: &Path, seconds: f64) {
    let before = match shard.before {
        0 => String::new(),
        n => format!(", {n} there before"),
    };
    say!(
        "{} in {:.2} s{before}; {} of {} of this shard are there",
        plural(shard.done, "run"),
        seconds,
        shard.runs - left,
        shard.runs
    );
    if shard.whole {
        say!("  complete: {}", folder.join("dataset.json").display());
    } else if left == 0 {
        say!("  other shards are to come; `brinell dataset merge` joins folders, where they ran apart");
    }
}

fn join(args: &MergeArgs) -> Result<ExitCode, Failure> {
    Resumed::DataSet.may_write(&args.output, &Inputs::default())?;
    let merged = merge(&args.folders, &args.output)?;
    if args.json {
        say::json(&Joined { folder: args.output.display().to_string(), files: &merged });
    } else if !args.quiet {
        say!("{}: {} brought, {} there before", args.output.display(), plural(merged.brought, "file"), merged.before);
    }
    let Some(lack) = merged.lack() else {
        return Ok(ExitCode::SUCCESS);
    };
    complain!("{lack}");
    Ok(ExitCode::FAILURE)
}

fn check(args: &VerifyArgs) -> Result<ExitCode, Failure> {
    let found = verify(&args.folder)?;
    if args.json {
        say::json(&Verified {
            folder: args.folder.display().to_string(),
            files: Files { sound: found.files, of: found.of },
            runs: Rows { complete: found.rows - found.failed, failed: found.failed },
            absent: &found.absent,
            problems: &found.problems,
        });
    } else if !args.quiet {
        let absent = found.absent.iter().map(|words| format!("; {words}"));
        let absent: String = absent.collect();
        say!(
            "{}: {} of {} sound, {} with {} failed{absent}",
            args.folder.display(),
            found.files,
            plural(found.of, "file"),
            plural(found.rows as usize, "run"),
            found.failed
        );
    }
    for problem in &found.problems {
        complain!("{problem}");
    }
    if !found.problems.is_empty() {
        complain!("remove what is damaged: the plan's own command makes again what is missing, with the same bytes");
    }
    Ok(match found.problems.is_empty() {
        true => ExitCode::SUCCESS,
        false => ExitCode::FAILURE,
    })
}
