//! The points of a sweep, each read and checked before any runs.

use super::SweepArgs;
use crate::failure::Failure;
use crate::files::Source;
use crate::files::make_folder;
use brinell::made_by;
use brinell::scenario::Scenario;
use brinell::simulate::Simulation;
use brinell_io::{Metadata, ParquetWriter, run_table};
use brinell_study::campaign::{Axis, Grid, is_inside};
use brinell_study::runner::{GridPoints, Make, Task, Work};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

/// A sweep before it runs.
pub(super) struct Points {
    pub(super) source: Source,
    pub(super) read: GridPoints,
    /// The first good point.
    pub(super) example: Scenario,
}

/// The grid of the command line.
fn grid(args: &SweepArgs) -> Result<Grid, Failure> {
    let usage = |option: &str, error: brinell_study::campaign::PlanError| Failure::Usage(format!("{option}: {error}"));
    let vary = args.vary.iter().map(|text| Axis::vary(text).map_err(|e| usage("--vary", e)));
    let together = args.together.iter().map(|text| Axis::together(text).map_err(|e| usage("--together", e)));
    let axes = vary.chain(together).collect::<Result<Vec<_>, _>>()?;
    if axes.is_empty() {
        return Err(Failure::Usage(
            "nothing varies: give --vary KEY=VALUES, for instance --vary operation.speed_rpm=1000:5000:500".into(),
        ));
    }
    Grid::new(axes).map_err(|error| usage("the sweep", error))
}

impl Points {
    /// Reads every point. A point that is bad is a row of the table; where all are, the input is.
    pub(super) fn read(args: &SweepArgs, threads: NonZeroUsize) -> Result<Self, Failure> {
        let grid = grid(args)?;
        let source = Source::open(&args.scenario, &args.set)?;
        for (key, value) in source.overrides() {
            if let Some(varied) = grid.keys().find(|varied| is_inside(key, varied)) {
                return Err(Failure::Usage(format!(
                    "--set {key}={value}: every point gives {varied} another value; leave out the one or the other"
                )));
            }
        }
        let read = GridPoints::read(grid, threads, |settings| source.load(settings, true), Failure::on_one_line)?;
        let first_good = read.tasks.iter().position(Result::is_ok).unwrap_or(0);
        let example = source.load(&read.grid.settings(first_good), true)?.scenario;
        Ok(Self { source, read, example })
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

    fn signals(&self, task: &Task, simulation: &Simulation) -> Result<Box<Make>, Failure> {
        let (Some(folder), Some(path)) = (&self.signals, self.path(&task.fingerprint)) else {
            return Ok(Box::new(|| Ok(Vec::new())));
        };
        make_folder(folder)?;
        let text = self.source.load(&task.settings, true)?.to_toml();
        let of = (text, Metadata::made_by(brinell::VERSION, made_by::commit()), simulation.sample_rate());
        let (columns, metadata) = run_table(of, simulation.table());
        Ok(Box::new(move || Ok(vec![Box::new(ParquetWriter::create(&path, &columns, &metadata)?)])))
    }
}
