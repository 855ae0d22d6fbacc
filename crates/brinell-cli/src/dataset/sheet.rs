//! `brinell dataset sheet`: a few runs of each class on a page.

use super::args::SheetArgs;
use crate::failure::Failure;
use crate::say::{plural, say};
use brinell_io::atomic_write;
use brinell_report::{Page, html};
use brinell_study::dataset::sheet;
use std::process::ExitCode;

/// Beside the data set's card.
const FILE: &str = "sheet.html";

pub(super) fn draw(args: &SheetArgs) -> Result<ExitCode, Failure> {
    let found = sheet(&args.folder, args.runs.get())?;
    let path = args.folder.join(FILE);
    let shown = found.classes.iter().map(|class| class.shown.len()).sum();
    atomic_write(&path, html(&Page::of_sheet(found)))?;
    if !args.quiet {
        say!("{}: {}", path.display(), plural(shown, "run"));
    }
    Ok(ExitCode::SUCCESS)
}
