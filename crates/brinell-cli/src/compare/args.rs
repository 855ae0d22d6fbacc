//! The command line of `brinell compare`.

use crate::args::jobs;
use crate::figures::PlotFormat;
use crate::figures::Print;
use clap::Args;
use std::num::NonZeroUsize;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(
    after_help = "The first scenario is the baseline: every ratio is of another run to it. A variant is the baseline with some keys changed.\n\n\
    Files in the folder:\n  \
    compare.html   signals, spectra, envelope spectra, contact length and stiffness over the defect, entries and exits, ratios; one file\n  \
    compare.csv, compare.parquet   a row a number: value and interval in each run, and its ratio to the baseline\n  \
    compare.json   the same with the scenarios\n\n\
    A ratio is that of the two values printed. Its interval follows from theirs: ln(a/b) +- t sqrt(s_a^2 + s_b^2), s being the standard errors \
    of ln(a) and ln(b), t Student's with Welch's degrees of freedom. It supposes runs that scatter independently. There is none where an \
    interval of a or b is missing or reaches zero.\n\n\
    Exit codes: 0 done, 1 a run failed or was interrupted (nothing is written), 2 bad input.\n\n\
    Examples:\n  \
    brinell compare actual.toml simplified.toml -o out/compare\n  \
    brinell compare base.toml --variant lumped:simulation.model=lumped --set simulation.laws=li2023\n  \
    brinell compare base.toml --variant 'paper:simulation.laws=li2023; contact.roller_path=envelope' --variant tight:simulation.accuracy=reference"
)]
pub(crate) struct CompareArgs {
    /// The scenarios (TOML), or folders with the results of runs, the first of them the baseline
    #[arg(required = true, value_name = "SCENARIO")]
    pub(crate) scenarios: Vec<PathBuf>,
    /// The baseline with some keys changed, under a name
    #[arg(long, value_name = "NAME:KEY=VALUE; KEY=VALUE")]
    pub(crate) variant: Vec<String>,
    /// Override any key, in all of them
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) set: Vec<String>,
    /// Also run every value that both sides assume at both ends of its plausible range, in both at once, and say which
    /// ratios stay on one side of 1: some 30 runs a side
    #[arg(long)]
    pub(crate) spread: bool,
    /// Folder for the results [default: out/compare-STEM, STEM being the baseline's file name without ending]
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
    /// Runs at a time [default: one per core]
    #[arg(short, long, value_name = "N", value_parser = jobs)]
    pub(crate) jobs: Option<NonZeroUsize>,
    /// Also write each plot into FOLDER/plots, as files of these formats, and its curves as CSV into FOLDER/curves
    #[arg(long, value_delimiter = ',', value_name = "FORMAT")]
    pub(crate) plots: Vec<PlotFormat>,
    #[command(flatten)]
    pub(crate) print: Print,
    /// Replace the results of other scenarios or another command in the folder, all of them
    #[arg(long)]
    pub(crate) overwrite: bool,
    /// Print the numbers of compare.json as JSON instead of text
    #[arg(long)]
    pub(crate) json: bool,
    /// Print nothing but errors
    #[arg(short, long, default_value_if("json", "true", "true"))]
    pub(crate) quiet: bool,
}
