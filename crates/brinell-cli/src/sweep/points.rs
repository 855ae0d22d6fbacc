//! The points of a sweep, each read and checked before any runs.

use super::SweepArgs;
use crate::failure::Failure;
use crate::files::Source;
use crate::files::make_folder;
use brinell::document::{on_one_line, one_line};
use brinell::scenario::Scenario;
use brinell::simulate::Simulation;
use brinell_io::{ParquetWriter, SignalWriter};
use brinell_studio::signal_table;
use brinell_study::campaign::{Axis, Beforehand, Known, Plan, of_points};
use brinell_study::runner::{Task, Work};
use serde_json::Value;
use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

/// A sweep before it runs.
pub(super) struct Points {
    pub(super) source: Source,
    pub(super) plan: Plan,
    /// Of each point: what to run, or why its scenario is bad.
    pub(super) tasks: Vec<Result<Task, String>>,
    /// Unit of each varied key, as the file format states it.
    pub(super) units: BTreeMap<String, &'static str>,
    /// What the author should know before the points run.
    pub(super) warnings: Vec<String>,
    /// The first good point.
    pub(super) example: Scenario,
}

/// The plan of the command line.
fn plan(args: &SweepArgs) -> Result<Plan, Failure> {
    let usage = |option: &str, error: brinell_study::campaign::PlanError| Failure::Usage(format!("{option}: {error}"));
    let vary = args.vary.iter().map(|text| Axis::vary(text).map_err(|e| usage("--vary", e)));
    let together = args.together.iter().map(|text| Axis::together(text).map_err(|e| usage("--together", e)));
    let axes = vary.chain(together).collect::<Result<Vec<_>, _>>()?;
    if axes.is_empty() {
        return Err(Failure::Usage(
            "nothing varies: give --vary KEY=VALUES, for instance --vary operation.speed_rpm=1000:5000:500".into(),
        ));
    }
    Plan::new(axes).map_err(|error| usage("the sweep", error))
}

/// What is known of one point.
struct Checked {
    task: Task,
    units: Vec<(String, &'static str)>,
    known: Known,
}

impl Points {
    /// Reads every point. A point that is bad is a row of the table; where all are, the input is.
    pub(super) fn read(args: &SweepArgs, threads: NonZeroUsize) -> Result<Self, Failure> {
        let plan = plan(args)?;
        let source = Source::open(&args.scenario, &args.set)?;
        for (key, value) in source.overrides() {
            let hides =
                |varied: &&str| key.strip_prefix(varied).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
            if let Some(varied) = plan.keys().find(hides) {
                return Err(Failure::Usage(format!(
                    "--set {key}={value}: every point gives {varied} another value; leave out the one or the other"
                )));
            }
        }
        let known = Beforehand::default();
        let mut checked: Vec<Option<Result<Checked, Failure>>> = Vec::new();
        checked.resize_with(plan.points(), || None);
        brinell::many::each(
            plan.points(),
            threads,
            |k| check(&source, plan.settings(k), k, &known),
            |k, result| checked[k] = Some(result),
        );
        let (mut units, mut tasks, mut first, mut before) = (BTreeMap::new(), Vec::new(), None, Vec::new());
        for result in checked.into_iter().flatten() {
            tasks.push(match result {
                Ok(checked) => {
                    units.extend(checked.units);
                    before.push(Some(checked.known));
                    Ok(checked.task)
                }
                Err(failure) => {
                    let reason = reason(&failure);
                    first.get_or_insert(failure);
                    before.push(None);
                    Err(reason)
                }
            });
        }
        let Some(first_good) = tasks.iter().position(Result::is_ok) else {
            return Err(first.unwrap_or_else(|| Failure::Usage("the sweep has no points".into())));
        };
        let warnings = of_points(before.iter().map(Option::as_ref));
        let example = source.load(&plan.settings(first_good), true)?.scenario;
        Ok(Self { source, plan, tasks, units, warnings, example })
    }

    /// What distinguishes this sweep from others: the plan, and the scenarios of its points.
    pub(super) fn header(&self) -> Value {
        let tasks = self.tasks.iter();
        let prints = tasks.map(|task| task.as_ref().ok().map(|t| &*t.fingerprint));
        self.plan.header(prints)
    }
}

fn check(source: &Source, settings: Vec<(String, String)>, k: usize, known: &Beforehand) -> Result<Checked, Failure> {
    let loaded = source.load(&settings, true)?;
    let unit = |(key, _): &(String, String)| {
        let entry = loaded.provenance_of(key)?;
        Some((key.clone(), entry.unit))
    };
    Ok(Checked {
        units: settings.iter().filter_map(unit).collect(),
        known: known.point(k, &loaded),
        task: Task::new(settings, &loaded.scenario),
    })
}

/// A failure on one line.
pub(crate) fn reason(failure: &Failure) -> String {
    match failure {
        Failure::Scenario { problems, .. } => on_one_line(problems),
        other => one_line(&other.to_string()),
    }
}

/// Runs points from their source, and keeps their signals where that is requested.
pub(super) struct FromSource<'a> {
    pub(super) source: &'a Source,
    pub(super) signals: Option<PathBuf>,
}

/// A point's file of signals within its folder: the same point has the same name in every sweep.
pub(super) fn signal_file(fingerprint: &str) -> String {
    format!("{}.parquet", &fingerprint[..fingerprint.len().min(16)])
}

impl FromSource<'_> {
    pub(super) fn path(&self, fingerprint: &str) -> Option<PathBuf> {
        let folder = self.signals.as_deref().map(Path::to_owned)?;
        Some(folder.join(signal_file(fingerprint)))
    }
}

impl Work for FromSource<'_> {
    type Error = Failure;

    fn scenario(&self, task: &Task) -> Result<Scenario, Failure> {
        Ok(self.source.load(&task.settings, true)?.scenario)
    }

    fn signals(&self, task: &Task, simulation: &Simulation) -> Result<Option<Box<dyn SignalWriter>>, Failure> {
        let (Some(folder), Some(path)) = (&self.signals, self.path(&task.fingerprint)) else {
            return Ok(None);
        };
        make_folder(folder)?;
        let text = self.source.load(&task.settings, true)?.to_toml();
        let (columns, metadata) = signal_table(text, simulation);
        let writer = ParquetWriter::create(path, &columns, &metadata)?;
        Ok(Some(Box::new(writer)))
    }
}
