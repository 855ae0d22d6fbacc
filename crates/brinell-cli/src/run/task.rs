//! One run: its scenario read and tried, earlier results that it may replace, and the run with its files.

use super::words::tell;
use super::{healthy, line_loads, spectra, spread};
use crate::args::RunArgs;
use crate::failure::{Failure, print_problems};
use crate::files::{Source, make_folder};
use crate::inputs::Inputs;
use crate::progress::Progress;
use crate::results::{Earlier, REPORT, Results, SCENARIO, SUMMARY, is_of};
use crate::say::{complain, short};
use crate::sweep::duration;
use brinell::document::Loaded;
use brinell::made_by;
use brinell::plausibility::Beforehand;
use brinell::result::Parts;
use brinell::result::{RunResult, finish};
use brinell::simulate::{End, Observer, Simulation};
use brinell::summary;
use brinell_damage::Photo;
use brinell_io::{Format, Metadata, atomic_prepare, run_table};
use brinell_report::Page;
use brinell_study::runner::{Make, Recorder, forecast};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

/// Wall time of a run that is said before it begins, s.
const LONG: f64 = 10.0;

/// A scenario that was read and tried, with what is known of it before it runs.
pub(super) struct Ready {
    pub(super) loaded: Loaded,
    /// What it was read from, to be read again with other values.
    source: Source,
    beforehand: Beforehand,
    /// Wall time that it will take, about.
    seconds: Option<f64>,
    /// The photos that its defects' outlines were read from.
    photos: Vec<Option<Photo>>,
}

/// What one run will be. The model is made anew by the thread that runs it, so that memory goes with the runs in
/// progress.
pub(super) struct Task {
    pub(super) ready: Ready,
    pub(super) folder: PathBuf,
    pub(super) earlier: Earlier,
}

impl Task {
    pub(super) fn duration_s(&self) -> f64 {
        self.ready.loaded.scenario.simulation.duration_s
    }
}

/// Reads and tries a scenario, and says what is worth knowing before it runs, of several by the file's name. What it
/// was read from goes to `inputs`.
pub(super) fn ready(args: &RunArgs, path: &Path, inputs: &mut Inputs) -> Result<Ready, Failure> {
    let source = Source::open(path, &args.set)?;
    let loaded = source.load(&[], args.quiet)?;
    inputs.add_all(&source.inputs());
    let simulation = Simulation::unchecked(&loaded.scenario)?;
    let beforehand = Beforehand::of_run(&loaded.scenario, &simulation);
    let cost = match forecast(&simulation) {
        Err(error) if error.is_bad_input() => return Err(error.into()),
        tried => tried.ok(),
    };
    if !args.quiet {
        if args.scenarios.len() > 1 && !beforehand.warnings.is_empty() {
            complain!("{}:", path.display());
        }
        print_problems("", "", &beforehand.warnings);
        if let Some(cost) = cost.filter(|cost| cost.seconds > LONG) {
            complain!("{}: about {} steps, about {}", path.display(), short(cost.steps, 2), duration(cost.seconds));
        }
    }
    let photos = match args.no_report && args.plots.is_empty() {
        true => Vec::new(),
        false => source.photos(),
    };
    Ok(Ready { photos, loaded, source, beforehand, seconds: cost.map(|cost| cost.seconds) })
}

/// A run that is over, its files written.
pub(super) struct Done {
    pub(super) end: End,
    /// By Ctrl-C.
    pub(super) interrupted: bool,
    /// A few lines on what came out; what matters most first.
    pub(super) printed: Vec<String>,
    /// The text of summary.json.
    pub(super) summary: String,
}

/// Earlier results in `folder` that a run of the scenario may replace.
pub(super) fn earlier(args: &RunArgs, loaded: &Loaded, folder: &Path, inputs: &Inputs) -> Result<Earlier, Failure> {
    Results::RUN.earlier(folder, inputs, args.overwrite, |_| is_of(folder, loaded))
}

/// Runs, and writes everything that was requested into the folder, in place of the earlier results.
pub(super) fn execute(args: &RunArgs, task: &Task, mut progress: Progress, stop: &AtomicBool) -> Result<Done, Failure> {
    let Task { ready: Ready { loaded, source, beforehand, seconds, photos }, folder, earlier } = task;
    let simulation = Simulation::unchecked(&loaded.scenario)?;
    let layout = args.print.layout(&args.plots)?;
    let mut loads = line_loads::requested(args, &simulation, task.duration_s())?;
    make_folder(folder)?;
    let files = files(args, loaded, &simulation, folder);
    let beside = loads.as_mut().map(|loads| loads as &mut dyn Observer);
    // This locks its files: another run into the same folder ends here, before anything is removed.
    let mut at = |t| progress.at(t);
    let mut recorder = Recorder::new(&simulation, &*files, &mut at)?.beside(beside);
    // What a reader needs to make sense of a partial run comes first.
    let mut ready = vec![atomic_prepare(folder.join(SCENARIO), loaded.to_toml())?];

    let (finished, healthy) =
        healthy::beside(args, &loaded.scenario, stop, || finish(loaded.scenario.clone(), simulation, &mut recorder));
    let files = recorder.close(&finished.outcome.end, true);
    let elapsed = progress.elapsed();
    drop(progress);
    ready.extend(files?);
    if let Some(loads) = &loads {
        ready.push(line_loads::ready(loads, folder)?);
    }
    if formats(args).contains(&Format::Parquet) {
        ready.extend(spectra::ready(&finished.findings, folder)?);
    }
    let spread = spread::of(args, (source, loaded), (&finished, *seconds), stop);
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
    let report = (!args.no_report || !args.plots.is_empty())
        .then(|| Page::of_run(&parts, photos, spread.as_ref().map(|spread| &*spread.levels)));
    let pictures = match &report {
        Some(report) if !args.plots.is_empty() => brinell_report::pictures(report, layout),
        _ => Vec::new(),
    };
    let page = report.filter(|_| !args.no_report).map(|report| brinell_report::html(&report));
    let page = page.as_deref().map(|page| (REPORT, page));
    let mut json = (SUMMARY, summary::to_json(&parts));
    if let Some(spread) = &spread {
        json.1["spread"] = spread.to_json();
    }
    let (written, summary) = earlier.publish(ready, json, page, (&pictures, &args.plots))?;
    let printed = tell(&parts, elapsed, spread.as_ref(), &written);
    Ok(Done { printed, end: outcome.end, interrupted, summary })
}

/// Begins the files of signals.
fn files(args: &RunArgs, loaded: &Loaded, simulation: &Simulation, folder: &Path) -> Box<Make> {
    let of = (loaded.to_toml(), Metadata::made_by(brinell::VERSION, made_by::commit()), simulation.sample_rate());
    let (columns, metadata) = run_table(of, simulation.table());
    let (formats, folder) = (formats(args), folder.to_owned());
    Box::new(move || formats.iter().map(|format| format.create(&folder, &columns, &metadata)).collect())
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
