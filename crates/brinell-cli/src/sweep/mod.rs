//! `brinell sweep`: keys over lists and ranges, many runs, one table and its plots.

mod args;
mod page;
mod points;
mod table;

use crate::campaign;
use crate::failure::{ExitCode, Failure};
use crate::figures::ready_pictures;
use crate::files::make_folder;
use crate::files::stem;
use crate::results::{Resumed, put};
use crate::say::{self, complain, plural, pretty, say, short};
use crate::stop::stop_flag;
pub(crate) use args::SweepArgs;
use brinell::document::read;
use brinell::made_by;
use brinell::made_by::MadeBy;
use brinell::result::{check_name, names};
use brinell::simulate::Simulation;
use brinell_io::{Metadata, keys};
use brinell_study::campaign::fingerprint;
use brinell_study::runner::{JOURNAL, Kept, State, Task, estimate, to_run};

use page::usual;
use points::{FromSource, Points};
use serde_json::{Value, json};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Instant;
use table::count;

pub(crate) fn sweep(args: &SweepArgs) -> Result<ExitCode, Failure> {
    let begin = Instant::now();
    let threads = |jobs| args.jobs.unwrap_or(brinell::many::threads(jobs));
    let points = Points::read(args, threads(usize::MAX))?;
    let plots = plots(args, &points)?;
    let named = || Path::new("out").join(format!("sweep-{}", stem(&args.scenario)));
    let folder = args.output.clone().unwrap_or_else(named);
    let work = FromSource { source: &points.source, signals: args.keep_signals.then(|| folder.join("signals")) };
    if args.dry_run {
        let kept = Kept::look(&folder)?;
        kept.same_kernel().map_err(|error| Failure::Usage(format!("{}: {error}", folder.display())))?;
        plan(&points, &kept, &work, threads, true);
        let bad = points.read.tasks.iter().enumerate().filter_map(|(k, task)| Some((k, task.as_ref().err()?.as_str())));
        tell_points(&points, "", &bad.collect::<Vec<_>>(), "");
        return Ok(ExitCode::SUCCESS);
    }
    Resumed::Study.may_write(&folder, &points.source.inputs())?;
    spare_signals(&points, &work)?;
    make_folder(&folder)?;
    let header = points.read.header();
    let words = |other: &Value| other_sweep(&folder, other);
    let mut ledger = campaign::ledger(&folder, &header, args.extend, words)?;
    let tasks = plan(&points, &ledger.kept, &work, threads, !args.quiet);
    let threads = threads(tasks.len());
    let stop = stop_flag()?;
    let outcome = campaign::run(&tasks, &work, &mut ledger, threads, args.quiet, &stop)?;

    let states = points.read.states(&ledger.kept);
    let doubts = State::doubts(&states);
    let warnings = [&points.read.warnings[..], &doubts].concat();
    let written = write(args, &points, &states, &plots, &folder, warnings)?;
    let [complete, failed, missing] = ["complete", "failed", "not run"].map(|word| count(&states, word));
    if !args.quiet {
        say!(
            "{} in {:.2} s; {} of {} complete",
            plural(tasks.len() - missing.min(tasks.len()), "run"),
            begin.elapsed().as_secs_f64(),
            complete,
            plural(states.len(), "point")
        );
        say::wrote(&written);
    }
    tell_failures(&points, &states);
    if !args.quiet {
        doubts.iter().for_each(|doubt| complain!("{doubt}"));
    }
    if outcome.is_break() {
        complain!(
            "interrupted: {} kept, {missing} to go; the same command resumes where this one stopped",
            plural(states.len() - missing, "finished point")
        );
    }
    Ok(if failed > 0 || outcome.is_break() { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}

/// That no signals will be written over, or taken for a point's, that are not of the same scenario.
fn spare_signals(points: &Points, work: &FromSource) -> Result<(), Failure> {
    let is_of = |task: &Task, path: &Path| {
        let file = brinell_io::open(path).ok()?;
        let loaded = read(file.metadata().get(keys::SCENARIO)?, &[]).ok()?;
        Some(fingerprint(&loaded.scenario) == task.fingerprint)
    };
    for task in points.read.tasks.iter().flatten() {
        let Some(path) = work.path(&task.fingerprint).filter(|path| path.exists()) else {
            continue;
        };
        if is_of(task, &path) != Some(true) {
            return Err(Failure::Usage(format!(
                "{} would be written over, and no sweep wrote it; move it, or choose another folder with -o",
                path.display()
            )));
        }
    }
    Ok(())
}

/// The runs that are to be made: those of sound points that are not finished, once where settings mean the same. Told,
/// where `printed`.
fn plan(
    points: &Points,
    kept: &Kept,
    work: &FromSource,
    threads: impl Fn(usize) -> NonZeroUsize,
    printed: bool,
) -> Vec<Task> {
    let finished = |task: &Task| {
        let signals = work.path(&task.fingerprint);
        let row = kept.row(&task.fingerprint);
        row.is_some_and(|row| row.result.is_err() || signals.is_none_or(|path| path.exists()))
    };
    let good = || points.read.tasks.iter().flatten();
    let tasks = to_run(good(), finished);
    if printed {
        let before = good().filter(|task| finished(task)).count();
        tell_plan(points, &tasks, before, work, threads(tasks.len()));
        let outdated = |task: &&Task| kept.is_outdated(&task.fingerprint);
        let outdated = good().filter(outdated).count();
        if outdated > 0 {
            say!("  {} of another version of brinell, to be run again", plural(outdated, "finished point"));
        }
    }
    tasks
}

/// What is plotted; a name that no point will have is refused before anything runs.
fn plots(args: &SweepArgs, points: &Points) -> Result<Vec<String>, Failure> {
    // A point without a model is a row with its reason, and says nothing of the others' numbers.
    let names =
        Simulation::planned(&points.example).map_or(Vec::new(), |simulation| names(&points.example, &simulation));
    for name in args.plot.iter().filter(|_| !names.is_empty()) {
        check_name(name, &names).map_err(|error| Failure::Usage(format!("--plot {error}")))?;
    }
    Ok(match &args.plot[..] {
        [] => usual(points, &names),
        chosen => chosen.to_vec(),
    })
}

fn tell_plan(points: &Points, tasks: &[Task], before: usize, work: &FromSource, threads: NonZeroUsize) {
    let axes: Vec<String> = points
        .read
        .grid
        .axes()
        .iter()
        .map(|axis| format!("{} ({})", axis.keys().join(" with "), axis.settings().len()))
        .collect();
    say!("{}: {}", plural(points.read.tasks.len(), "point"), axes.join(" x "));
    for warning in &points.read.warnings {
        complain!("{warning}");
    }
    let bad = points.read.tasks.iter().filter(|task| task.is_err()).count();
    if bad > 0 {
        say!("  {} with a bad scenario, not to be run", plural(bad, "point"));
    }
    if before > 0 {
        say!("  {} finished before", plural(before, "point"));
    }
    if tasks.is_empty() {
        return;
    }
    let simulated: f64 = tasks.iter().map(|task| task.duration_s).sum();
    let cost = estimate(tasks, work, threads).map_or(String::new(), |seconds| format!(", about {}", duration(seconds)));
    say!(
        "  {} to do: {} s simulated, {} at a time{cost}",
        plural(tasks.len(), "run"),
        short(simulated, 3),
        threads.get().min(tasks.len())
    );
}

/// Wall time to one or two digits: no trial knows more.
pub(crate) fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1.0 => "a second".into(),
        s if s < 100.0 => format!("{} s", s.ceil()),
        s if s < 6000.0 => format!("{} min", (s / 60.0).ceil()),
        s => format!("{:.1} h", s / 3600.0),
    }
}

/// The folder's journal is of something else.
fn other_sweep(folder: &Path, other: &Value) -> String {
    let folder = folder.display();
    let Some(axes) = other["plan"].as_array().filter(|_| other["campaign"] == "sweep") else {
        let kind = other["campaign"].as_str().unwrap_or("something else");
        return format!("{folder}/{JOURNAL} is the journal of {kind}; choose another folder with -o");
    };
    let axis = |axis: &Value| {
        let keys = axis["keys"].as_array().into_iter().flatten();
        let keys: Vec<&str> = keys.filter_map(Value::as_str).collect();
        let count = axis["settings"].as_array().map_or(0, Vec::len);
        format!("{} ({count})", keys.join(" with "))
    };
    let axes: Vec<String> = axes.iter().map(axis).collect();
    format!(
        "{folder} holds another sweep, of {}, or of another base scenario; choose another folder with -o, or go on in it with --extend, \
         which keeps what matches",
        axes.join(" x ")
    )
}

/// Points with the reason of each; `what` became of them, and where the `rest` is.
fn tell_points(points: &Points, what: &str, reasons: &[(usize, &str)], rest: &str) {
    const SHOWN: usize = 10;
    for (k, reason) in reasons.iter().take(SHOWN) {
        let settings = points.read.grid.settings(*k);
        let texts: Vec<String> = settings.iter().map(|(k, v)| format!("{k}={v}")).collect();
        complain!("point {}{what} ({}): {reason}", k + 1, texts.join(", "));
    }
    if reasons.len() > SHOWN {
        complain!("and {} more{rest}", reasons.len() - SHOWN);
    }
}

fn tell_failures(points: &Points, states: &[State]) {
    let failed = states.iter().enumerate().filter_map(|(k, s)| Some((k, s.failure()?)));
    let failed: Vec<_> = failed.collect();
    tell_points(points, " failed", &failed, ": see sweep.csv");
    if !failed.is_empty() {
        complain!("{} of {} failed", failed.len(), plural(states.len(), "point"));
    }
}

/// Everything that the sweep leaves; the same points give the same bytes.
fn write(
    args: &SweepArgs,
    points: &Points,
    states: &[State],
    plots: &[String],
    folder: &Path,
    warnings: Vec<String>,
) -> Result<Vec<PathBuf>, Failure> {
    let table = table::table(points, states, args.keep_signals);
    let metadata = Metadata::made_by(brinell::VERSION, made_by::commit()).with(keys::SCENARIO, points.source.text());
    let mut written =
        vec![table.write_csv(folder.join("sweep.csv"))?, table.write_parquet(folder.join("sweep.parquet"), &metadata)?];
    let count = |word: &str| count(states, word);
    let columns: serde_json::Map<String, Value> =
        table.columns.iter().map(|c| (c.name.clone(), c.unit.as_str().into())).collect();
    let overrides: serde_json::Map<String, Value> =
        points.source.overrides().iter().map(|(key, value)| (key.clone(), value.as_str().into())).collect();
    let json = json!({
        "brinell": brinell::VERSION,
        "made_by": MadeBy::now(),
        "plan": points.read.header()["plan"],
        "warnings": warnings,
        "points": { "complete": count("complete"), "failed": count("failed"), "not_run": count("not run") },
        "interval": "95 % of the value, an average over whole revolutions of the inner ring; peaks are those of a revolution",
        "units": columns,
        "base": { "toml": points.source.text(), "set": overrides },
    });
    if args.json {
        let mut shown = json.clone();
        shown["rows"] = table::rows(&table).into();
        say::json(&shown);
    }
    put(folder, "sweep.json", &pretty(&json), &mut written)?;
    let report = page::report(points, states, plots, warnings);
    put(folder, "sweep.html", &brinell_report::html(&report), &mut written)?;
    if !args.plots.is_empty() {
        let layout = args.print.layout(&args.plots)?;
        let pictures = brinell_report::pictures(&report, layout);
        for file in ready_pictures(&pictures, &args.plots, folder)? {
            written.push(file.publish()?);
        }
    }
    Ok(written)
}
