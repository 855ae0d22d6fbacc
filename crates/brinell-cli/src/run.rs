//! `brinell run`.

mod healthy;
mod line_loads;
mod many;
mod spectra;

use crate::args::RunArgs;
use crate::failure::{Failure, INTERRUPTED, print_problems};
use crate::files::Source;
use crate::files::{self, make_folder};
use crate::inputs::Inputs;
use crate::progress::{Progress, Shown};
use crate::results::{Earlier, Place, REPORT, Results, SCENARIO, SUMMARY, is_of, is_written};
use crate::say::{complain, document, one_line, say, short};
use crate::stop::stop_flag;
use brinell::document::Loaded;
use brinell::observe::{DefectLine, Findings, Kind};
use brinell::plausibility::{self, Beforehand};
use brinell::result::{RunResult, fields, finish};
use brinell::signal::Indicator;
use brinell::simulate::{End, Observer, Simulation};
use brinell::summary::{self, Parts};
use brinell_damage::Photo;
use brinell_io::{Format, SignalWriter, atomic_prepare};
use brinell_report::Report;
use brinell_studio::signal_table;
use brinell_study::runner::Recorder;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

pub(crate) fn run(args: &RunArgs) -> Result<ExitCode, Failure> {
    args.print.layout(&args.plots)?;
    let [path] = &args.scenarios[..] else {
        let alone = match (args.open, args.json) {
            (true, _) => "--open shows the report",
            (_, true) => "--json prints the summary.json",
            _ => return many::run(args),
        };
        return Err(Failure::Usage(format!("{alone} of one scenario; here are {}", args.scenarios.len())));
    };
    let mut inputs = Inputs::default();
    let ready = ready(args, path, &mut inputs)?;
    let named = || Path::new("out").join(safe_name(&ready.loaded.scenario.name));
    let folder = args.output.clone().unwrap_or_else(named);
    let task = Task { earlier: earlier(args, &ready.loaded, &folder, &inputs)?, ready, folder };
    let progress = Progress::new(task.duration_s(), args.quiet);
    let stop = stop_flag()?;
    let done = execute(args, &task, progress, &stop)?;
    if args.json {
        document(done.summary.trim_end());
    }
    if !args.quiet {
        for line in &done.printed {
            say!("{line}");
        }
    }
    if args.open
        && let Err(words) = crate::open::show(&task.folder.join(REPORT))
    {
        complain!("warning: {words}");
    }
    match done.end {
        End::Failed(error) => Err(Failure::Run(error)),
        End::Stopped if done.interrupted => Ok(ExitCode::from(INTERRUPTED)),
        _ => Ok(ExitCode::SUCCESS),
    }
}

/// A scenario that was read and tried, with what is known of it before it runs.
struct Ready {
    loaded: Loaded,
    beforehand: Beforehand,
    /// The photos that its defects' outlines were read from.
    photos: Vec<Option<Photo>>,
}

/// What one run will be. The model is made anew by the thread that runs it, so that memory goes with the runs in
/// progress.
struct Task {
    ready: Ready,
    folder: PathBuf,
    earlier: Earlier,
}

impl Task {
    fn duration_s(&self) -> f64 {
        self.ready.loaded.scenario.simulation.duration_s
    }
}

/// Reads and tries a scenario, and says what is worth knowing before it runs, of several by the file's name. What it
/// was read from goes to `inputs`.
fn ready(args: &RunArgs, path: &Path, inputs: &mut Inputs) -> Result<Ready, Failure> {
    let source = Source::open(path, &args.set)?;
    let loaded = source.load(&[], args.quiet)?;
    inputs.add_all(&source.inputs());
    let simulation = Simulation::new(&loaded.scenario).map_err(Failure::Run)?;
    let beforehand = Beforehand::of(&loaded.scenario, simulation.model());
    let name = |is_said: bool| {
        if args.scenarios.len() > 1 && is_said {
            complain!("{}:", path.display());
        }
    };
    if !args.quiet {
        name(!beforehand.warnings.is_empty());
        print_problems("", "", &beforehand.warnings);
        name(!simulation.idle_patterns().is_empty());
        files::warn_idle(simulation.idle_patterns());
    }
    let photos = match args.no_report && args.plots.is_empty() {
        true => Vec::new(),
        false => source.photos(),
    };
    Ok(Ready { photos, loaded, beforehand })
}

/// A run that is over, its files written.
struct Done {
    end: End,
    /// By Ctrl-C.
    interrupted: bool,
    /// A few lines on what came out; what matters most first.
    printed: Vec<String>,
    /// The text of summary.json.
    summary: String,
}

/// Earlier results in `folder` that a run of the scenario may replace.
fn earlier(args: &RunArgs, loaded: &Loaded, folder: &Path, inputs: &Inputs) -> Result<Earlier, Failure> {
    let mut writes: Vec<&str> = formats(args).into_iter().map(Format::file_name).collect();
    writes.push(SUMMARY);
    if writes.contains(&Format::Parquet.file_name()) {
        writes.push(spectra::FILE);
    }
    if !args.line_loads.is_empty() {
        writes.push(line_loads::FILE);
    }
    if !args.no_report {
        writes.push(REPORT);
    }
    let writes: Vec<String> = writes.into_iter().map(str::to_owned).collect();
    let place = Place { kind: Results::Run, folder, inputs };
    let earlier = place.earlier(args.overwrite, &writes, |_| is_of(folder, &loaded.scenario))?;
    if !args.overwrite && !is_written(folder, &loaded.to_toml()) {
        return Err(Failure::Usage(format!(
            "{} holds a {SCENARIO} that brinell did not write in this form; choose another folder with -o, or replace it with --overwrite",
            folder.display()
        )));
    }
    Ok(earlier)
}

/// Runs, and writes everything that was requested into the folder, in place of the earlier results.
fn execute(args: &RunArgs, task: &Task, progress: Progress, stop: &AtomicBool) -> Result<Done, Failure> {
    let Task { ready: Ready { loaded, beforehand, photos }, folder, earlier } = task;
    let simulation = Simulation::new(&loaded.scenario).map_err(Failure::Run)?;
    let layout = args.print.layout(&args.plots)?;
    let mut loads = line_loads::requested(args, &simulation, task.duration_s())?;
    make_folder(folder)?;
    // These lock their files: another run into the same folder ends here, before anything is removed.
    let writers = writers(args, loaded, &simulation, folder)?;
    // What a reader needs to make sense of a partial run comes first.
    let mut ready = vec![atomic_prepare(folder.join(SCENARIO), loaded.to_toml())?];

    let mut shown = Shown::new(progress, stop);
    let beside = loads.as_mut().map(|loads| loads as &mut dyn Observer);
    let mut recorder = Recorder::new(&simulation, writers, &mut shown).beside(beside);
    let (finished, healthy) =
        healthy::beside(args, &loaded.scenario, stop, || finish(loaded.scenario.clone(), simulation, &mut recorder));
    let files = recorder.close(&finished.outcome.end, true);
    let elapsed = shown.elapsed();
    drop(shown);
    ready.extend(files?);
    if let Some(loads) = &loads {
        ready.push(line_loads::ready(loads, folder)?);
    }
    if formats(args).contains(&Format::Parquet) {
        ready.extend(spectra::ready(&finished.findings, folder)?);
    }
    let RunResult { simulation, outcome, findings, .. } = finished;
    let interrupted = stop.load(Ordering::Relaxed) && outcome.end == End::Stopped;
    let parts = Parts {
        loaded,
        simulation: &simulation,
        outcome: &outcome,
        findings: &findings,
        beforehand,
        healthy: healthy.as_ref(),
    };
    let report = (!args.no_report || !args.plots.is_empty()).then(|| report(&parts, photos));
    let pictures = match &report {
        Some(report) if !args.plots.is_empty() => brinell_report::pictures(report, layout),
        _ => Vec::new(),
    };
    let page = report.filter(|_| !args.no_report).map(|report| brinell_report::html(&report));
    let page = page.as_deref().map(|page| (REPORT, page));
    let json = (SUMMARY, summary::to_json(&parts));
    let (written, summary) = earlier.publish(ready, json, page, (&pictures, &args.plots))?;
    Ok(Done { printed: tell(&parts, elapsed, &written), end: outcome.end, interrupted, summary })
}

fn report(parts: &Parts, photos: &[Option<Photo>]) -> Report {
    let mut report = Report::of_run(parts);
    for (view, photo) in report.damage.iter_mut().zip(photos) {
        view.photo = photo.clone();
    }
    report
}

/// A name is free text; a folder's is not.
pub(crate) fn safe_name(name: &str) -> String {
    let safe = |c: char| {
        if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' }
    };
    let name: String = name.chars().map(safe).collect();
    match name.trim_matches('.') {
        "" => "run".into(),
        name => name.into(),
    }
}

fn writers(
    args: &RunArgs,
    loaded: &Loaded,
    simulation: &Simulation,
    folder: &Path,
) -> Result<Vec<Box<dyn SignalWriter>>, Failure> {
    let (columns, metadata) = signal_table(loaded.to_toml(), simulation);
    let make = |format: Format| format.create(folder, &columns, &metadata).map_err(Failure::from);
    formats(args).into_iter().map(make).collect()
}

/// Formats of signals that are requested, each once.
fn formats(args: &RunArgs) -> Vec<Format> {
    let mut formats: Vec<Format> = Vec::new();
    for format in args.signals.iter().flatten() {
        if !formats.contains(format) {
            formats.push(*format);
        }
    }
    formats
}

/// A few lines on what came out.
fn tell(parts: &Parts, elapsed: f64, written: &[PathBuf]) -> Vec<String> {
    let mut printed = Vec::new();
    let Parts { outcome, findings, loaded, .. } = *parts;
    let reached = outcome.reached;
    match &outcome.end {
        End::Complete => {}
        End::Stopped => printed.push(format!("Interrupted: the results are partial, up to t = {reached:.4} s.")),
        End::Failed(_) => printed.push(format!("Failed: the results are partial, up to t = {reached:.4} s.")),
    }
    printed.push(format!(
        "{}: {} s simulated in {elapsed:.2} s ({:.2} x real time), {} steps, {} right-hand sides",
        one_line(&loaded.scenario.name),
        short(reached, 4),
        reached / elapsed,
        (fields::STEPS.of)(outcome),
        (fields::RIGHT_HAND_SIDES.of)(outcome),
    ));
    printed.extend(sensor_lines(findings));
    printed.extend(healthy_line(parts));
    let heed = summary::clipped(parts).into_iter().chain(summary::unsettled(findings));
    printed.extend(heed.map(|words| format!("  {words}")));
    printed.extend(findings.lines.iter().map(defect_line));
    let part = (fields::RELATIVE_RESIDUAL.of)(outcome);
    printed.push(format!(
        "  energy audit closes to {} of the turnover, momentum to {}",
        part.map_or("-".into(), |x| short(x.abs(), 1)),
        (fields::MOMENTUM_IMBALANCE.of)(outcome).map_or("(rigid mount)".into(), |x| short(x, 1)),
    ));
    let after = plausibility::after(&loaded.scenario, &outcome.energy);
    printed.extend(after.into_iter().map(|words| format!("warning: {words}")));
    for path in written {
        printed.push(format!("  wrote {}", path.display()));
    }
    printed
}

/// What the sensor read, a line for each of its channels.
fn sensor_lines(findings: &Findings) -> Vec<String> {
    let mut printed = Vec::new();
    for channel in &findings.channels {
        if channel.kind != Kind::AntiAliased || !channel.name.starts_with("sensor_") {
            continue;
        }
        let Some(rms) = channel.blocks.estimate(Indicator::Rms) else {
            continue;
        };
        let interval =
            rms.interval.map_or(String::new(), |i| format!(" (95 %: {} to {})", short(i.low, 3), short(i.high, 3)));
        let other = |i: Indicator| channel.blocks.estimate(i).map_or("-".into(), |e| short(e.value, 3));
        printed.push(format!(
            "  {}: RMS {}{interval} {}, peak to peak {} a revolution, kurtosis {}",
            channel.name,
            short(rms.value, 3),
            channel.unit,
            other(Indicator::PeakToPeak),
            other(Indicator::Kurtosis),
        ));
    }
    printed
}

/// The level beside the healthy bearing's.
fn healthy_line(parts: &Parts) -> Option<String> {
    let healthy = parts.healthy?;
    let (rms, ratio) = (healthy.rms()?, parts.findings.over_healthy(healthy)?);
    let interval =
        ratio.interval.map_or(String::new(), |(low, high)| format!(" (95 %: {} to {})", short(low, 3), short(high, 3)));
    Some(format!(
        "  {} without the damage: RMS {} m/s^2; with it {} x that{interval}",
        healthy.sensor_name(),
        short(rms.value, 3),
        short(ratio.value, 3),
    ))
}

/// What the envelope has of a defect.
fn defect_line(line: &DefectLine) -> String {
    let found = line.found.map_or("not found in the envelope".into(), |f| {
        let interval = line.interval.map_or(String::new(), |i| format!(" (95 %: {:.2} to {:.2})", i.low, i.high));
        format!("{:.2} Hz{interval} in the envelope", f.frequency)
    });
    format!("  defect {}: {} {found}; pure rolling {:.2} Hz", line.defect + 1, line.name, line.nominal)
}
