//! The command line as a whole: every command and whose arguments it takes.

use crate::args::{BearingCommand, CheckArgs, DefectCommand, FrequenciesArgs, RunArgs, SchemaArgs};
use clap::{Parser, Subcommand};
use std::any::TypeId;

/// Vibration of rolling bearings with real damage, from first principles.
///
/// Describe a bearing, its damage and its operation in one TOML file; get the vibration that a sensor would see, with
/// spectra, indicators, load distribution and an honest list of everything that was assumed.
#[derive(Debug, Parser)]
#[command(
    name = "brinell",
    version,
    long_version = crate::version::long(),
    mut_subcommands = with_negative_numbers,
    after_help = "First steps:\n  \
        brinell init bearing.toml           write a scenario to edit\n  \
        brinell check bearing.toml          see what it means before it runs\n  \
        brinell run bearing.toml -o out     simulate\n  \
        brinell open out                    look at the report in a browser\n\n\
        Exit codes: 0 done, 1 the run failed or a result could not be written (to standard output included), 2 bad input, 130 a run interrupted (what was computed is kept; an \
        interrupted sweep, comparison or data set ends with 1)."
)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// Where a number is expected, `-1` is a number and not an unknown option. The check of its range then says what is
/// allowed.
fn with_negative_numbers(command: clap::Command) -> clap::Command {
    let command = command.mut_args(|arg| match arg.get_value_parser().type_id() == TypeId::of::<f64>() {
        true => arg.allow_negative_numbers(true),
        false => arg,
    });
    command.mut_subcommands(with_negative_numbers)
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Simulate scenarios: signals, summary.json and a self-contained report.html of each
    Run(RunArgs),
    /// Validate a scenario and print what follows from it, without running
    Check(CheckArgs),
    /// Write a scenario to start from: a bearing and what is to be simulated of it
    Init(crate::init::InitArgs),
    /// List the bearings known by name, or show one with the source of every number
    Bearing {
        #[command(subcommand)]
        command: BearingCommand,
    },
    /// Print the defect frequencies of a bearing by name, a geometry or a scenario
    Frequencies(FrequenciesArgs),
    /// See damage before it is simulated; convert, simplify, fit or draw it at random
    Defect {
        #[command(subcommand)]
        command: DefectCommand,
    },
    /// Write a bearing's stiffness and damping over speed and load, and its damage's force, for rotor programs such as ROSS
    Coefficients(crate::coefficients::CoefficientsArgs),
    /// Say what a measured signal shows: which component's damage, how sure; or compare it with a simulated one
    Analyze(Box<crate::analyze::AnalyzeArgs>),
    /// Vary keys over lists and ranges, many runs in parallel, one table and plots; resumes where it stopped
    Sweep(crate::sweep::SweepArgs),
    /// Compare scenarios: signals, spectra, contact over the defect, impacts, ratios with intervals
    Compare(crate::compare::CompareArgs),
    /// Say what differs between two scenarios, key by key, defaults included; nothing is run
    Diff(crate::diff::DiffArgs),
    /// Run the experiments of Li et al. (2023) and compare each of the paper's sentences with them
    Reproduce(crate::reproduce::ReproduceArgs),
    /// Fit keys within bounds to targets or a measured signal; says how sure the values are, and which the data leave
    /// open
    Calibrate(Box<crate::calibrate::CalibrateArgs>),
    /// Make a data set of thousands of labelled signals from a plan; merge and verify data sets
    Dataset(Box<crate::dataset::DatasetArgs>),
    /// Draw damage on a running bearing and hear it: a page on this machine with the engine behind it
    Studio(crate::studio::StudioArgs),
    /// Offer frequencies, check, run, analyze and sweep to an AI agent as tools, within one folder, by the Model Context Protocol
    Mcp(crate::mcp::McpArgs),
    /// Print the JSON Schema of scenario files, or of a data set's plans, for editors and generators
    Schema(SchemaArgs),
    /// Open a page of results in the browser
    Open(crate::open::OpenArgs),
    /// Print what to cite, as BibTeX: the program and the paper whose model it implements
    Cite,
    /// Print the script that completes this command's words in a shell
    Completions(crate::shell::CompletionsArgs),
    /// Write the manual pages of this command and its subcommands into a folder
    Man(crate::shell::ManArgs),
}
