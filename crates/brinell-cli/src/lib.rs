//! The `brinell` command as a function: reads arguments and files, prints, and writes results; what is computed is the
//! libraries'.

#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]

mod analyze;
mod args;
mod calibrate;
mod campaign;
mod check;
mod cite;
mod cli;
mod coefficients;
mod compare;
mod confined;
mod dataset;
mod defect;
mod diff;
mod failure;
mod figures;
mod files;
mod hint;
mod init;
mod inputs;
mod look_up;
mod mcp;
mod open;
mod progress;
mod reproduce;
mod results;
mod run;
mod say;
mod shell;
mod stop;
mod studio;
mod sweep;
mod version;

use brinell::kernel::Kernel;
use brinell::made_by;
use clap::{CommandFactory, Parser};
use cli::{Cli, Command};
use failure::{ExitCode, Failure};
use std::ffi::OsString;
use std::sync::OnceLock;
pub use version::COMMIT;

/// Runs the command with these arguments, the first of which is the program's name, and prints to the process's
/// standard output and error.
///
/// Exit codes: 0 done, 1 the run failed or a result could not be written, 2 the input is bad, 130 a run interrupted
/// (what was computed is kept; an interrupted sweep, comparison or data set ends with 1).
///
/// It is for a process of its own: it raises that process's limit of open files to what the system allows, ignores
/// SIGXFSZ, and some commands listen for Ctrl-C, the second of which ends the process.
pub fn run(args: impl IntoIterator<Item = OsString>) -> u8 {
    if let Some(commit) = COMMIT {
        made_by::built_from(commit);
    }
    hear_of_full_files();
    brinell_damage::keep_tables();
    allow_open_files();
    let args: Vec<OsString> = args.into_iter().collect();
    let code = match Cli::try_parse_from(&args) {
        Ok(cli) => code_of(chosen_kernel().and_then(|()| run_command(cli.command))),
        Err(mut words) if words.use_stderr() => {
            hint::suggest(&mut words, &args);
            let _ = words.print();
            ExitCode::BAD_INPUT
        }
        // Help, or the version.
        Err(words) => {
            say::note(words.print());
            ExitCode::SUCCESS
        }
    };
    match say::arrived() {
        Err(error) if code == ExitCode::SUCCESS => code_of(Err(Failure::Output(error))).0,
        Err(error) => {
            Failure::Output(error).print();
            code.0
        }
        Ok(()) => code.0,
    }
}

static STARTED_BY: OnceLock<Vec<OsString>> = OnceLock::new();

/// Says how this command is started again where the process's program is another, such as Python: a program and its first words. The first
/// call counts.
pub fn started_by(words: Vec<OsString>) {
    let _ = STARTED_BY.set(words);
}

/// How this command is started again.
fn program() -> std::io::Result<Vec<OsString>> {
    match STARTED_BY.get() {
        Some(words) => Ok(words.clone()),
        None => Ok(vec![std::env::current_exe()?.into()]),
    }
}

fn code_of(result: Result<ExitCode, Failure>) -> ExitCode {
    result.unwrap_or_else(|failure| {
        failure.print();
        failure.code()
    })
}

fn chosen_kernel() -> Result<(), Failure> {
    let kernel = Kernel::chosen();
    kernel.map(drop).map_err(|error| Failure::Usage(error.to_string()))
}

/// A file that grows beyond the limit on files (`ulimit -f`) is an error of its writer, which removes what is there of
/// it; unasked, the process would be killed.
fn hear_of_full_files() {
    #[cfg(unix)]
    // SAFETY: to ignore a signal runs no code.
    unsafe {
        libc::signal(libc::SIGXFSZ, libc::SIG_IGN);
    }
}

/// As many open files as the system lets a process ask for: new results are held open, all of them, until they are
/// complete.
fn allow_open_files() {
    #[cfg(unix)]
    // SAFETY: both calls read and write `limit` alone, which outlives them.
    unsafe {
        let mut limit = std::mem::zeroed::<libc::rlimit>();
        if libc::getrlimit(libc::RLIMIT_NOFILE, &raw mut limit) == 0 {
            limit.rlim_cur = limit.rlim_max;
            libc::setrlimit(libc::RLIMIT_NOFILE, &raw const limit);
        }
    }
}

fn run_command(command: Command) -> Result<ExitCode, Failure> {
    match command {
        Command::Run(args) => run::run(&args),
        Command::Check(args) => check::check(&args),
        Command::Init(args) => init::init(&args),
        Command::Bearing { command } => look_up::bearing(&command),
        Command::Frequencies(args) => look_up::frequencies(&args),
        Command::Defect { command } => defect::defect(&command),
        Command::Coefficients(args) => coefficients::run(&args),
        Command::Analyze(args) => analyze::analyze(&args),
        Command::Sweep(args) => sweep::sweep(&args),
        Command::Calibrate(args) => calibrate::calibrate(&args),
        Command::Compare(args) => compare::compare(&args),
        Command::Reproduce(args) => reproduce::reproduce(&args),
        Command::Dataset(args) => dataset::dataset(&args),
        Command::Studio(args) => studio::studio(&args),
        Command::Mcp(args) => mcp::mcp(&Cli::command(), &args),
        Command::Schema(args) => look_up::schema(&args),
        Command::Diff(args) => diff::diff(&args),
        Command::Open(args) => open::open(&args),
        Command::Cite => cite::cite(),
        Command::Completions(args) => shell::completions(Cli::command(), &args),
        Command::Man(args) => shell::man(Cli::command(), &args),
    }
}
