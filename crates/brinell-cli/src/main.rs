//! The `brinell` command: thin, everything it does is the library's.
//!
//! Exit codes: 0 done, 1 the run failed, 2 the input is bad, 130 interrupted (what was computed is kept).

mod analyze;
mod args;
mod calibrate;
mod campaign;
mod check;
mod compare;
mod damage;
mod dataset;
mod defect;
mod failure;
mod files;
mod look_up;
mod page;
mod plan;
mod progress;
mod recorder;
mod reproduce;
mod run;
mod say;
mod sweep;

use args::{Cli, Command};
use brinell::kernel::Kernel;
use clap::Parser;
use failure::Failure;
use std::process::ExitCode;

fn main() -> ExitCode {
    let cli = Cli::parse();
    let result = match Kernel::chosen() {
        Ok(_) => run_command(cli.command),
        Err(error) => Err(Failure::Usage(error.to_string())),
    };
    match result {
        Ok(code) => code,
        Err(failure) => {
            failure.print();
            failure.code()
        }
    }
}

fn run_command(command: Command) -> Result<ExitCode, Failure> {
    match command {
        Command::Run(args) => run::run(&args),
        Command::Check(args) => check::check(&args),
        Command::Init(args) => look_up::init(&args),
        Command::Bearing { command } => look_up::bearing(&command),
        Command::Frequencies(args) => look_up::frequencies(&args),
        Command::Defect { command } => defect::defect(&command),
        Command::Analyze(args) => analyze::analyze(&args),
        Command::Sweep(args) => sweep::sweep(&args),
        Command::Calibrate(args) => calibrate::calibrate(&args),
        Command::Compare(args) => compare::side_by_side(&args),
        Command::Reproduce(args) => reproduce::reproduce(&args),
        Command::Dataset(args) => dataset::dataset(&args),
        Command::Schema => look_up::schema(),
    }
}
