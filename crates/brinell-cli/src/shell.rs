//! `brinell completions` and `brinell man`: what a shell and `man` need, made from the definitions of the command line.

use crate::failure::{ExitCode, Failure};
use crate::files::make_folder;
use crate::say::{document, say};
use brinell_io::atomic_write;
use clap::{Args, Command};
use clap_complete::Shell;
use clap_mangen::Man;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
#[command(after_help = "Where a script goes:\n  \
    bash        brinell completions bash > ~/.local/share/bash-completion/completions/brinell\n  \
    zsh         brinell completions zsh > DIR/_brinell, with a DIR of $fpath\n  \
    fish        brinell completions fish > ~/.config/fish/completions/brinell.fish\n  \
    PowerShell  brinell completions powershell >> $PROFILE")]
pub(crate) struct CompletionsArgs {
    /// The shell
    shell: Shell,
}

#[derive(Debug, Args)]
#[command(
    after_help = "A page for each command: brinell.1, brinell-run.1 and so on, in place of those that are there.\n\n\
    Example: brinell man ~/.local/share/man/man1, then: man brinell-run"
)]
pub(crate) struct ManArgs {
    /// Folder for the pages
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

pub(crate) fn completions(mut command: Command, args: &CompletionsArgs) -> Result<ExitCode, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut command, "brinell", &mut script);
    document(String::from_utf8_lossy(&script).trim_end());
    Ok(ExitCode::SUCCESS)
}

pub(crate) fn man(command: Command, args: &ManArgs) -> Result<ExitCode, Failure> {
    make_folder(&args.folder)?;
    // Without the lines on this machine's kernel.
    let mut command = command.disable_help_subcommand(true).long_version(None::<&'static str>);
    command.build();
    let count = pages(&command, &args.folder)?;
    say!("wrote {count} pages into {}", args.folder.display());
    Ok(ExitCode::SUCCESS)
}

/// Writes the pages of a command and of those below it, and says how many they are.
fn pages(command: &Command, folder: &Path) -> Result<usize, Failure> {
    let mut count = 1;
    for below in command.get_subcommands() {
        count += pages(below, folder)?;
    }
    let page = Man::new(command.clone());
    let mut text = Vec::new();
    page.render(&mut text).map_err(|error| Failure::Usage(format!("{}: {error}", page.get_filename())))?;
    atomic_write(folder.join(page.get_filename()), &text)?;
    Ok(count)
}
