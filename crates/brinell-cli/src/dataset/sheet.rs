//! `brinell dataset sheet`: a few runs of each class on a page, or one machine's history.

use super::args::SheetArgs;
use crate::failure::Failure;
use crate::say::{plural, say};
use brinell_io::atomic_write;
use brinell_report::{Page, html};
use brinell_study::dataset::{history, sheet};
use std::process::ExitCode;

/// Beside the data set's card.
const FILE: &str = "sheet.html";

pub(super) fn draw(args: &SheetArgs) -> Result<ExitCode, Failure> {
    let (page, file, what) = match args.machine {
        None => {
            let found = sheet(&args.folder, args.runs.get())?;
            let shown = found.classes.iter().map(|class| class.shown.len()).sum();
            (Page::of_sheet(found), FILE.to_owned(), plural(shown, "run"))
        }
        Some(machine) => {
            let found = history(&args.folder, machine, args.runs.get())?;
            let shown = plural(found.snapshots.len(), "snapshot");
            (Page::of_history(found), format!("machine-{machine}.html"), shown)
        }
    };
    let path = args.folder.join(file);
    atomic_write(&path, html(&page))?;
    if !args.quiet {
        say!("{}: {what}", path.display());
    }
    Ok(ExitCode::SUCCESS)
}
