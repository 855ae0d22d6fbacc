//! The command line of `brinell dataset`.

use crate::args::jobs;
use brinell_study::dataset::Shard;
use clap::{Args, Subcommand};
use std::num::NonZeroUsize;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    after_help = "A plan names a base scenario, says which keys vary and how, and which classes there are:\n\n  \
    base = \"machine.toml\"          # from the plan's folder\n  \
    runs = 1000\n  \
    seed = 7\n  \
    design = \"sobol\"               # random | latin-hypercube | sobol\n  \
    licence = \"CC-BY-4.0\"\n  \
    [vary]\n  \
    operation.speed_rpm = { uniform = [900, 3000] }\n  \
    operation.load_n = [0, { choice = [-1000, -3000] }]\n  \
    [[classes]]\n  \
    name = \"healthy\"\n  \
    defects = []\n  \
    [[classes]]\n  \
    name = \"outer\"\n  \
    [[classes.defects]]\n  \
    on = \"outer-raceway\"\n  \
    depth_um = { log = [2, 50] }\n  \
    shape.random = { length_mm = { uniform = [0.5, 4] }, width_mm = { uniform = [0.5, 6] } }\n\n\
    Distributions: uniform = [LOW, HIGH], log = [LOW, HIGH], normal = [MEAN, DEVIATION] (with within or clip = [LOW, HIGH]), whole = [LEAST, \
    LARGEST], choice = [...] (with weights = [...]), grid = [...] or \"FROM:TO:STEP\". Grids are crossed. Random spalls get a seed of their own in \
    each run.\n\n\
    With machines, snapshots and a table [history] in place of runs, each machine has a history: healthy, damaged, failed. `brinell init \
    plan.toml --template histories` writes one.\n\n\
    In the folder:\n  \
    runs/part-00000.parquet    one row a run: signals, what a model may be given, labels\n  \
    truth/part-00000.parquet   of the same rows damage, entries, forces, warnings, scenario\n  \
    dataset.json               geometry, units, rate, licence, columns, checksums; there when all is\n  \
    README.md                  the card: splits, classes, what a simple classifier tells\n  \
    bearing_datasets/          for the Python package bearing-datasets, beside measured data sets\n  \
    held_out/                  labels and truth of the runs that `held_out` sets apart\n  \
    sheet.html                 a few runs of each class to look at: `brinell dataset sheet`\n  \
    work/                      finished runs of unfinished files\n\n\
    The same command resumes where it stopped, and changes nothing that is there. The files' bytes depend on plan, version and commit, kernel \
    (BRINELL_KERNEL) and the system's mathematics library, not on --jobs, --shard or interruptions. In a Slurm array (sbatch --array=1-10): --shard $SLURM_ARRAY_TASK_ID/10. \
    N is a fixed number: of tasks that are submitted again, Slurm counts those alone.\n\n\
    Exit codes: 0 all of the shard is there, 1 Ctrl-C or a full disk stopped it (what is finished is kept), or `verify` or `merge` found something \
    missing or wrong, 2 bad input. A run that fails is a row with its reason, and no failure of the command.\n\n\
    Examples:\n  \
    brinell dataset plan.toml --dry-run\n  \
    brinell dataset plan.toml -o data\n  \
    brinell dataset plan.toml -o data --shard 3/10\n  \
    brinell dataset merge data-1 data-2 data-3 -o data\n  \
    brinell dataset verify data\n  \
    brinell dataset sheet data\n  \
    brinell dataset sheet data --machine 0     one history to failure"
)]
pub(crate) struct DatasetArgs {
    #[command(subcommand)]
    pub(crate) command: Option<DatasetCommand>,
    /// The plan (TOML)
    #[arg(required = true)]
    pub(crate) plan: Option<PathBuf>,
    /// Folder for the data set [default: out/NAME, NAME being the plan's]
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
    /// Only this share of the files, I from 1 to N
    #[arg(long, value_name = "I/N", default_value = "1/1", hide_default_value = true)]
    pub(crate) shard: Shard,
    /// Runs at a time [default: one per core]
    #[arg(short, long, value_name = "N", value_parser = jobs)]
    pub(crate) jobs: Option<NonZeroUsize>,
    /// Print what the plan means and what it costs; run nothing
    #[arg(long)]
    pub(crate) dry_run: bool,
    /// Print what was made as JSON instead of text; with --dry-run the plan and its cost
    #[arg(long)]
    pub(crate) json: bool,
    /// Print nothing but errors
    #[arg(short, long, default_value_if("json", "true", "true"))]
    pub(crate) quiet: bool,
}

#[derive(Debug, Subcommand)]
pub(crate) enum DatasetCommand {
    /// Join folders in which shards of one plan ran apart; each file's checksum is compared with what was written
    Merge(MergeArgs),
    /// Check a data set: every file there, its checksum, its rows, one campaign and one version in all
    Verify(VerifyArgs),
    /// Draw a contact sheet, sheet.html in the folder: of a few runs of each class the labels, the waveform and the
    /// envelope spectrum
    Sheet(SheetArgs),
    /// Print the scenario of one run, as TOML: brinell run simulates it again
    Scenario(ScenarioArgs),
}

#[derive(Debug, Args)]
pub(crate) struct ScenarioArgs {
    /// The data set's folder
    pub(crate) folder: PathBuf,
    /// The run's number in the column run
    pub(crate) run: u64,
}

#[derive(Debug, Args)]
pub(crate) struct MergeArgs {
    /// The folders
    #[arg(required = true, value_name = "FOLDER")]
    pub(crate) folders: Vec<PathBuf>,
    /// Where they are joined: a new folder, or one of them
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: PathBuf,
    /// Print JSON instead of text
    #[arg(long)]
    pub(crate) json: bool,
    /// Print nothing but errors
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Args)]
pub(crate) struct SheetArgs {
    /// The data set's folder
    pub(crate) folder: PathBuf,
    /// Runs of each class at most; with --machine signals of so many snapshots
    #[arg(long, value_name = "N", default_value = "4")]
    pub(crate) runs: NonZeroUsize,
    /// The history of this machine, numbers from 0: machine-K.html with outlines, size, indicators and signals over its life
    #[arg(long, value_name = "K")]
    pub(crate) machine: Option<usize>,
    /// Print nothing but errors
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Args)]
pub(crate) struct VerifyArgs {
    /// The data set's folder
    pub(crate) folder: PathBuf,
    /// Print JSON instead of text
    #[arg(long)]
    pub(crate) json: bool,
    /// Print nothing but errors
    #[arg(short, long)]
    pub(crate) quiet: bool,
}
