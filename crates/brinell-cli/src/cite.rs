//! `brinell cite`: what to cite, as BibTeX.

use crate::failure::{ExitCode, Failure};
use crate::say::document;

pub(crate) fn cite() -> Result<ExitCode, Failure> {
    document(&brinell::cite::bibtex());
    Ok(ExitCode::SUCCESS)
}
