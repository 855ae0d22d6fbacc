//! The `brinell` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    brinell_cli::run(std::env::args_os()).into()
}
