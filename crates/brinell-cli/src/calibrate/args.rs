//! The command line of `brinell calibrate`.

use crate::analyze::signal_args::SignalArgs;
use crate::args::jobs;
use brinell_io::FileKind;
use clap::Args;
use std::num::NonZeroUsize;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(
    after_help = "A key is fitted within its bounds: KEY=LOW:HIGH, or KEY=LOW:HIGH:log where it is searched in its logarithm.\n\n\
    A target is a number of a run with its standard uncertainty (one sigma), in its unit or in per cent: NAME=VALUE~UNCERTAINTY. Names are those of \
    the columns of `brinell sweep`: sensor_ax.rms, envelope.bpfo, defect1.frequency, row1.cage_slip, ... SI units. \
    Extremes, such as row1.largest_outer_force, scatter too, though a run cannot say by how much: give them an uncertainty that covers it.\n\n\
    A measured signal (--measured) becomes targets itself: its octave levels and its envelope spectrum's at the first five harmonics of each \
    defect's frequency, in decibels; RMS and kurtosis; the defects' frequencies where they are significant; and how far apart the two events of each pass are where that is clear. --model-uncertainty is \
    what a model may differ by from a machine in all but the two last, and is added to what the signal's own scatter says. Its rate must be the scenario's.\n\n\
    The search: a quarter of the runs is spread over the bounds (Latin hypercube), a fifth follows a particle swarm, the rest goes downhill \
    from the best places (Levenberg and Marquardt); two to four runs a key are kept for the Jacobian at the best point. Differences are taken over a \
    tenth of a key's range; over a fifth where runs are uncertain themselves, and up to two fifths where a key's effect is not significant against that: impacts amplify round-off, so that an \
    RMS is uncertain by a per cent, which finer differences would take for a slope. Residuals weigh with the target's uncertainty and the runs' own together.\n\n\
    95 % intervals are about the best run. None is given where the targets are not met, where linear least squares expects the best value outside it, or where a run far outside \
    meets the targets as well. A search may end in the wrong one of several hollows: intervals of another --seed that do not overlap show it.\n\n\
    Files in the folder:\n  \
    best.toml        the scenario with the best values; `brinell run` takes it\n  \
    calibrate.json   values with 95 % intervals, correlations, what the data do not determine, residuals\n  \
    calibrate.csv    a row a run: keys, status, chi-square, the targets' numbers and residuals\n  \
    calibrate.html   the same as a page; one file, no network\n  \
    journal.jsonl    finished runs, each on the disk when it is done\n\n\
    The same command again resumes where it stopped, with the same outcome as if it had not; with a larger --budget finished runs count again. \
    The outcome does not depend on --jobs.\n\n\
    Exit codes: 0 done, whether the targets are met or not, 1 Ctrl-C stopped it (what is finished is kept) or no run came to its end, 2 bad input.\n\n\
    Examples:\n  \
    brinell calibrate base.toml --fit bearing.radial_clearance_um=2:20 --fit support.outer_stiffness_n_per_m=1e5:1e7:log \\\n    \
    --target sensor_ax.rms=30.4~1.0 --target defect1.frequency=250.2~0.5 -o out/cal --seed 1 --budget 60\n  \
    brinell calibrate base.toml --fit operation.speed_rpm=1750:1850 --measured rig.mat --channel DE --unit g"
)]
pub(crate) struct CalibrateArgs {
    /// The scenario whose keys are fitted (TOML); `-` reads standard input
    pub(crate) scenario: PathBuf,
    /// A key to fit, with its bounds; several are fitted together
    #[arg(long, value_name = "KEY=LOW:HIGH[:log]", required = true)]
    pub(crate) fit: Vec<String>,
    /// A number that a run is to have, with its standard uncertainty
    #[arg(long, value_name = "NAME=VALUE~UNCERTAINTY")]
    pub(crate) target: Vec<String>,
    /// Override any key, in every run
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) set: Vec<String>,
    #[arg(long, value_name = "FILE|FOLDER", help = format!("A measured acceleration to fit to: {}; or the folder of a run", FileKind::known()))]
    pub(crate) measured: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) signal: SignalArgs,
    /// Sensor's axis in the simulation: x or y [default: the axis nearer the load]
    #[arg(long, value_name = "x|y", requires = "measured")]
    pub(crate) axis: Option<String>,
    /// Standard uncertainty of the model's levels against a machine's [default: 5]
    #[arg(long, value_name = "PERCENT", requires = "measured", allow_negative_numbers = true)]
    pub(crate) model_uncertainty: Option<f64>,
    /// Fit to the spacing of the two events of each pass alone, from which the damage's length follows, and not to levels, which the way to the sensor changes
    #[arg(long, requires = "measured")]
    pub(crate) events_only: bool,
    /// Runs at most [default: 30 a key]
    #[arg(short, long, value_name = "N")]
    pub(crate) budget: Option<usize>,
    /// Random seed of the points that are tried
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) seed: u64,
    /// Runs at a time [default: one per core]
    #[arg(short, long, value_name = "N", value_parser = jobs)]
    pub(crate) jobs: Option<NonZeroUsize>,
    /// Folder for the results [default: out/calibrate-STEM, STEM being the scenario's file name without ending]
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
    /// Resume in a folder that holds another calibration; runs of the same scenario count
    #[arg(long)]
    pub(crate) extend: bool,
    /// Print the plan and what it costs; run nothing
    #[arg(long)]
    pub(crate) dry_run: bool,
    /// Print the numbers of calibrate.json as JSON instead of text; with --dry-run those of the plan
    #[arg(long)]
    pub(crate) json: bool,
    /// Print nothing but errors
    #[arg(short, long, default_value_if("json", "true", "true"))]
    pub(crate) quiet: bool,
}
