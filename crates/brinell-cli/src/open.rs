//! `brinell open`, and `run --open`: a page of results in the browser.

use crate::failure::{ExitCode, Failure};
use crate::results::PAGES;
use crate::say::say;
use clap::Args;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// How long the system's opener may take to say that it cannot. One that still runs has the page.
const PATIENCE: Duration = Duration::from_millis(1500);

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    brinell open out/rectangle              its report.html\n  \
    brinell open out/sweep/sweep.html")]
pub(crate) struct OpenArgs {
    /// A folder of results, or a page
    #[arg(value_name = "FOLDER_OR_PAGE")]
    place: PathBuf,
}

pub(crate) fn open(args: &OpenArgs) -> Result<ExitCode, Failure> {
    let page = page_of(&args.place)?;
    show(&page).map_err(Failure::NotOpened)?;
    say!("opened {}", page.display());
    Ok(ExitCode::SUCCESS)
}

/// The page itself, or that of a folder of results. Never a link: whose folder it is may have it name anything, and the
/// system starts what it is given.
fn page_of(place: &Path) -> Result<PathBuf, Failure> {
    let there = place.metadata();
    let there = there.map_err(|error| Failure::Read(place.to_owned(), error))?;
    let page = if there.is_dir() {
        let page = PAGES.iter().map(|name| place.join(name)).find(|p| p.is_file());
        page.ok_or_else(|| {
            Failure::Usage(format!("{} holds no page of results: none of {}", place.display(), PAGES.join(", ")))
        })?
    } else {
        place.to_owned()
    };
    let ending = page.extension().unwrap_or_default();
    if ending != "html" && ending != "htm" {
        return Err(Failure::Usage(format!(
            "{} is no page: expected a folder of results or an .html file",
            page.display()
        )));
    }
    match page.read_link() {
        Ok(target) => Err(Failure::Usage(format!(
            "{} is a link, to {}; links are not opened: give the page that it names",
            page.display(),
            target.display()
        ))),
        Err(_) => Ok(page),
    }
}

/// Hands a page to the system's opener.
///
/// # Errors
/// In words, where there is none or it refuses.
pub(crate) fn show(page: &Path) -> Result<(), String> {
    let whole = page.canonicalize().unwrap_or_else(|_| page.to_owned());
    // What the openers say of themselves (exit statuses) helps nobody.
    open::that_detached_with_timeout(&whole, PATIENCE).map_err(|_| {
        format!(
            "nothing on this system opened the page, as where there is no browser or no desktop; it is one file: open it in a \
             browser, here or on the machine that you copy it to: {}",
            whole.display()
        )
    })
}
