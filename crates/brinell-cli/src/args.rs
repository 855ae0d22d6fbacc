//! The command line. Its help teaches.

use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Vibration of rolling bearings with real damage, from first principles.
///
/// Describe a bearing, its damage and its operation in one TOML file; get the vibration that a sensor would see, with
/// spectra, indicators, load distribution and an honest list of everything that was assumed.
#[derive(Debug, Parser)]
#[command(
    name = "brinell",
    version,
    after_help = "First steps:\n  \
        brinell init bearing.toml           write a commented scenario to edit\n  \
        brinell check bearing.toml          see what it means before it runs\n  \
        brinell run bearing.toml -o out     simulate; then open out/report.html\n\n\
        Exit codes: 0 done, 1 the run failed, 2 bad input, 130 interrupted (what was computed is kept)."
)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Simulate a scenario: signals, summary.json and a self-contained report.html
    Run(RunArgs),
    /// Validate a scenario and print what follows from it, without running
    Check(CheckArgs),
    /// Write a commented scenario to start from (the paper's NN3007 with a rectangular defect)
    Init(InitArgs),
    /// List the catalogue's bearings, or show one with the source of every number
    Bearing {
        #[command(subcommand)]
        command: BearingCommand,
    },
    /// Print the defect frequencies of a catalogue bearing, a geometry or a scenario
    Frequencies(FrequenciesArgs),
    /// Print the JSON Schema of scenario files, for editors and generators
    Schema,
}

/// Scenario and overrides.
#[derive(Debug, Args)]
pub(crate) struct ScenarioArgs {
    /// The scenario (TOML); `-` reads standard input
    pub(crate) scenario: PathBuf,
    /// Override any key: `--set operation.speed_rpm=3000`, `--set defects.0.depth_um=40`; a bare word is a string
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) set: Vec<String>,
}

#[derive(Debug, Args)]
#[command(after_help = "Results in the folder:\n  \
    signals.parquet or .csv   the recorded channels, SI units, names as in the documentation\n  \
    summary.json              indicators with intervals, frequencies, slip, load zone, audits, assumptions\n  \
    report.html               pictures and tables, one file, no network\n  \
    scenario.toml             the scenario with every default filled in\n\n\
    Ctrl-C ends the run cleanly: what was computed is kept and marked partial.")]
pub(crate) struct RunArgs {
    #[command(flatten)]
    pub(crate) scenario: ScenarioArgs,
    /// Folder for the results [default: out/NAME, NAME being the scenario's]
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
    /// Signal files to write, separated by commas
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "parquet",
        value_name = "FORMAT"
    )]
    pub(crate) signals: Vec<SignalFormat>,
    /// Also write each picture of the report into FOLDER/plots, as files of these formats
    #[arg(long, value_delimiter = ',', value_name = "FORMAT")]
    pub(crate) plots: Vec<PlotFormat>,
    /// Skip report.html
    #[arg(long)]
    pub(crate) no_report: bool,
    /// Print nothing but errors
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

/// Formats of signal files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum SignalFormat {
    /// A header line of channel names, then numbers
    Csv,
    /// Apache Parquet, with units and scenario in its metadata
    Parquet,
    /// No signal file
    None,
}

/// Formats of pictures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum PlotFormat {
    /// Vector drawing
    Svg,
    /// Pixels, twice the drawing's size
    Png,
}

#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(crate) scenario: ScenarioArgs,
    /// Also list every value that nobody stated, and why it is what it is
    #[arg(short, long)]
    pub(crate) assumptions: bool,
}

#[derive(Debug, Args)]
pub(crate) struct InitArgs {
    /// File to write; standard output where left out
    pub(crate) file: Option<PathBuf>,
    /// Overwrite an existing file
    #[arg(long)]
    pub(crate) force: bool,
}

#[derive(Debug, Subcommand)]
pub(crate) enum BearingCommand {
    /// List the catalogue
    List,
    /// Show one bearing with the source of every number
    Show {
        /// Catalogue name, such as NN3007
        name: String,
    },
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    brinell frequencies NN3007 --speed 1800\n  \
    brinell frequencies scenario.toml\n  \
    brinell frequencies --pitch 39 --roller 7.5 --rollers 13 --speed 1500")]
pub(crate) struct FrequenciesArgs {
    /// A catalogue name or a scenario file (`-` reads standard input)
    pub(crate) bearing: Option<String>,
    /// Shaft speed, r/min [default: the scenario's, or 60 so that Hz are orders]
    #[arg(long, value_name = "RPM", allow_negative_numbers = true)]
    pub(crate) speed: Option<f64>,
    /// Pitch diameter, mm
    #[arg(
        long,
        value_name = "MM",
        conflicts_with = "bearing",
        allow_negative_numbers = true
    )]
    pub(crate) pitch: Option<f64>,
    /// Roller diameter, mm
    #[arg(
        long,
        value_name = "MM",
        conflicts_with = "bearing",
        allow_negative_numbers = true
    )]
    pub(crate) roller: Option<f64>,
    /// Rollers in a row
    #[arg(
        long,
        value_name = "Z",
        conflicts_with = "bearing",
        allow_negative_numbers = true
    )]
    pub(crate) rollers: Option<usize>,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}
