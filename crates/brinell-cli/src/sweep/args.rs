//! The command line of `brinell sweep`.

use crate::args::jobs;
use crate::figures::PlotFormat;
use crate::figures::Print;
use clap::Args;
use std::num::NonZeroUsize;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(
    after_help = "VALUES are a list (5,10,20), a range (1000:5000:500 is FROM:TO:STEP; TO is in it where a step reaches it), or both mixed. Each value is TOML; a bare word \
    is a string. Several --vary make a grid, the last one changing fastest.\n\n\
    Files in the folder:\n  \
    sweep.csv, sweep.parquet   a row a point: keys, status, reason, every indicator with its interval, lines, slip, audits, work; SI units\n  \
    sweep.html                 plots against the varied key with intervals, and the table; one file, no network\n  \
    sweep.json                 the plan, warnings, the kernel, the base scenario, the columns' units\n  \
    journal.jsonl              finished points, each on the disk when it is done\n  \
    signals/                   with --keep-signals: FINGERPRINT.parquet a point\n\n\
    The same command again resumes where it stopped: finished points of the same scenario and the same version of brinell are not run \
    again; those that another kernel (BRINELL_KERNEL) computed are refused. A point that fails is a row with its reason. The table's bytes depend on base scenario, \
    plan, version, kernel and the system's mathematics library, not on --jobs or interruptions.\n\n\
    Exit codes: 0 every point is done, 1 a point failed or Ctrl-C stopped the sweep (what is finished is kept), 2 bad input.\n\n\
    Examples:\n  \
    brinell sweep base.toml --vary operation.speed_rpm=1000:5000:500 --vary bearing.radial_clearance_um=5,10,20 -o out/sweep\n  \
    brinell sweep base.toml --vary operation.speed_rpm=1000:5000:1000 --vary simulation.model=full,lumped --set simulation.laws=li2023\n  \
    brinell sweep base.toml --together 'operation.speed_rpm=1000,2000; operation.load_n=[300,0],[600,0]'\n  \
    brinell sweep base.toml --vary 'defects.0.shape={rectangle={length_mm=3,width_mm=4}},{circle={diameter_mm=3.9}}'"
)]
pub(crate) struct SweepArgs {
    /// The scenario that the points vary (TOML); `-` reads standard input
    pub(crate) scenario: PathBuf,
    /// A key and its values; several make a grid
    #[arg(long, value_name = "KEY=VALUES")]
    pub(crate) vary: Vec<String>,
    /// Keys that change together, one value of each to a point
    #[arg(long, value_name = "KEY=VALUES; KEY=VALUES")]
    pub(crate) together: Vec<String>,
    /// Override any key, in every point
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) set: Vec<String>,
    /// Folder for the results [default: out/sweep-STEM, STEM being the scenario's file name without ending]
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
    /// Runs at a time [default: one per core]
    #[arg(short, long, value_name = "N", value_parser = jobs)]
    pub(crate) jobs: Option<NonZeroUsize>,
    /// Indicators to plot, such as sensor_ax.rms or envelope.bpfo [default: RMS, peak to peak and kurtosis of the
    /// sensor's acceleration along the load, the envelope's lines of damaged surfaces, RMS of both rings]
    #[arg(long, value_name = "NAME", num_args = 1.., value_delimiter = ',')]
    pub(crate) plot: Vec<String>,
    /// Also write each plot into FOLDER/plots, as files of these formats, and its curves as CSV into FOLDER/curves
    #[arg(long, value_delimiter = ',', value_name = "FORMAT")]
    pub(crate) plots: Vec<PlotFormat>,
    #[command(flatten)]
    pub(crate) print: Print,
    /// Keep the recorded channels of each point, as Parquet
    #[arg(long)]
    pub(crate) keep_signals: bool,
    /// Resume in a folder that holds another sweep; what matches is kept, and the table becomes this sweep's
    #[arg(long)]
    pub(crate) extend: bool,
    /// Print the plan and what it costs; run nothing
    #[arg(long)]
    pub(crate) dry_run: bool,
    /// Print sweep.json and the table's rows as JSON instead of text
    #[arg(long, conflicts_with = "dry_run")]
    pub(crate) json: bool,
    /// Print nothing but errors
    #[arg(short, long, default_value_if("json", "true", "true"))]
    pub(crate) quiet: bool,
}
