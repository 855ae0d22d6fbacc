//! The command line of `brinell reproduce`.

use crate::args::jobs;
use crate::figures::PlotFormat;
use crate::figures::Print;
use brinell_li2023::FIGURES;
use clap::Args;
use clap::builder::PossibleValue;
use std::num::NonZeroUsize;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(after_help = "Files in the folder:\n  \
    reproduce.html       the claims and the figures; one file, no network\n  \
    claims.csv, claims.json   each statement with its verdict, numbers and intervals\n  \
    models.csv           with --model: each claim's verdict by each model\n  \
    laws.csv             with --laws mechanics: each statement under the paper's laws, under these, and with their default values\n  \
    plots/               with --plots\n  \
    journal.jsonl        finished runs, each on the disk when it is done; curves/ beside it holds what pictures need of them\n\n\
    The same command again resumes where it stopped; runs of the same scenario and the same version of brinell are not run again, so \
    --figure, --quick and --sensitivity share what they have in common. Files depend on the options alone, not on --jobs or \
    interruptions.\n\n\
    Exit codes: 0 every run is done (whatever the verdicts), 1 a run failed or Ctrl-C stopped it (what is finished is kept), 2 bad input.\n\n\
    Examples:\n  \
    brinell reproduce --quick\n  \
    brinell reproduce --figure 18\n  \
    brinell reproduce --sensitivity --book docs/src/reproduction")]
pub(crate) struct ReproduceArgs {
    /// Only these figures of the paper, 8 to 20 [default: all]
    #[arg(long, value_name = "N", value_delimiter = ',', value_parser = figure)]
    pub(crate) figure: Vec<u32>,
    /// Shorter runs, wider intervals
    #[arg(long)]
    pub(crate) quick: bool,
    /// Also vary what the paper does not state or what is taken otherwise, one at a time, and search over 1000 sets of assumptions for
    /// those that agree best
    #[arg(long, conflicts_with = "figure")]
    pub(crate) sensitivity: bool,
    /// Also make every case with this model, and in slices, and show the verdicts side by side
    #[arg(long, value_name = "MODEL", value_parser = [PossibleValue::new("tilting").help("Rollers and rings tilt")])]
    pub(crate) model: Option<String>,
    /// Laws that every case is made under; with mechanics, the program's default ones, what the paper's laws gave is put
    /// beside
    #[arg(long, value_name = "LAWS", default_value = "li2023", value_parser = [
        PossibleValue::new("li2023").help("The paper's"),
        PossibleValue::new("mechanics").help("Exact geometry, damage as on elastic steel, and the default values of this set")
    ])]
    pub(crate) laws: String,
    /// Turns of the shaft whose statistics count, of every run [default: 240, with --quick 40]
    #[arg(long, value_name = "N", conflicts_with = "quick", value_parser = turns)]
    pub(crate) turns: Option<u32>,
    /// Folder for the results
    #[arg(short, long, value_name = "FOLDER", default_value = "out/reproduce")]
    pub(crate) output: PathBuf,
    /// Runs at a time [default: one per core]
    #[arg(short, long, value_name = "N", value_parser = jobs)]
    pub(crate) jobs: Option<NonZeroUsize>,
    /// Also write each picture into FOLDER/plots, as files of these formats
    #[arg(long, value_delimiter = ',', value_name = "FORMAT")]
    pub(crate) plots: Vec<PlotFormat>,
    #[command(flatten)]
    pub(crate) print: Print,
    /// Also write reproduction.md and its pictures (SVG), with --laws mechanics survives.md, into this folder; a page of
    /// that name in the folder above that holds the text already takes it instead
    #[arg(long, value_name = "FOLDER")]
    pub(crate) book: Option<PathBuf>,
    /// Print the numbers of claims.json as JSON instead of text
    #[arg(long)]
    pub(crate) json: bool,
    /// Print nothing but errors
    #[arg(short, long, default_value_if("json", "true", "true"))]
    pub(crate) quiet: bool,
}

fn figure(text: &str) -> Result<u32, String> {
    let allowed = || format!("allowed: {} to {}, the figures of section 4", FIGURES.start(), FIGURES.end());
    let number: u32 = text.parse().map_err(|_| allowed())?;
    if FIGURES.contains(&number) { Ok(number) } else { Err(allowed()) }
}

fn turns(text: &str) -> Result<u32, String> {
    let number = text.trim().parse().ok().filter(|turns| (3..=100_000).contains(turns));
    number.ok_or("expected a whole number of turns of the shaft, 3 to 100000, as 240".into())
}
