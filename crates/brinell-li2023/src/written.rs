//! A reproduction as files: the page, the tables of claims, and the book's chapter.

use crate::curve_files::{CurveFiles, make_folder};
use crate::outcome::Claims;
use crate::recorded::{self, Recorded};
use crate::reproduction::Reproduction;
use crate::sensitivity::Sensitivity;
use crate::{BASE, Error, beside, book, outcome, page};
use brinell::made_by::MadeBy;
use brinell::scenario::Scenario;
use brinell_io::atomic_write;
use brinell_report::{DamageView, Page, Picture};
use std::path::{Path, PathBuf};

impl Reproduction {
    /// The page. `plan` gives the view from above of a scenario's first defect.
    pub fn study(&self, files: &CurveFiles, plan: impl Fn(&Scenario) -> Option<DamageView>) -> Page {
        let curves = |id: &str| {
            let point = self.request.points.iter().find(|p| p.case.id == id)?;
            files.curves(&point.task.fingerprint)
        };
        page::study(self, curves, plan)
    }

    /// Writes `claims.csv`, `claims.json` and, with other models, `models.csv`, under other laws, `laws.csv`, into a
    /// folder, which exists.
    ///
    /// # Errors
    /// Where a file cannot be written.
    pub fn write_claims(&self, folder: &Path) -> Result<Vec<PathBuf>, Error> {
        let claims = Claims {
            brinell: brinell::VERSION,
            made_by: MadeBy::now(),
            length: self.request.length.words(),
            starts: self.request.length.starts(),
            base_toml: BASE,
            interval: "95 % of the value, an average over whole revolutions of the inner ring and over the starts; peaks are those of a revolution",
            sensitivity: self.sensitivity.as_ref().map(Sensitivity::json),
            laws: self.beside.is_some().then(|| self.request.laws.word()),
            claims: self.outcomes.iter().map(outcome::judgement).collect(),
        };
        let mut written = outcome::write(&self.outcomes, &claims, folder)?;
        if let Some(models) = &self.models {
            written.push(models.write(folder)?);
        }
        if let Some(all) = &self.beside {
            written.push(beside::write(all, folder)?);
        }
        Ok(written)
    }

    /// Writes the text of the book's chapter, `reproduction.md`, or of `survives.md` under other laws than the paper's:
    /// into the page of that name in the folder above `book`, in place of the text that it holds, and into `book` where
    /// there is no such page. Pictures and, of the whole, the verdicts as they are kept, `verdicts.json`, go to `book`.
    ///
    /// # Errors
    /// Where the folder cannot be made or a file cannot be written.
    pub fn write_book(&self, study: &Page, pictures: &[Picture], book: &Path) -> Result<Vec<PathBuf>, Error> {
        make_folder(book)?;
        let text = book::text(study, self, book);
        let name = if self.beside.is_some() { "survives.md" } else { "reproduction.md" };
        let above = book.parent().unwrap_or(book);
        let page = std::fs::read_to_string(above.join(name)).ok().and_then(|page| book::within(&page, &text));
        let mut written = vec![match page {
            Some(page) => put(above, name, &page)?,
            None => put(book, name, &text)?,
        }];
        if self.beside.is_some() {
            return Ok(written);
        }
        if self.request.whole {
            let all: Vec<Recorded> = self.outcomes.iter().map(Recorded::of).collect();
            written.push(put(book, "verdicts.json", &recorded::text(&all))?);
        }
        for picture in pictures {
            written.push(put(book, &format!("{}.svg", picture.name), &picture.svg())?);
        }
        Ok(written)
    }
}

/// Writes `reproduce.html`, the page, into a folder, which exists.
///
/// # Errors
/// Where the file cannot be written.
pub fn write_page(study: &Page, folder: &Path) -> Result<PathBuf, Error> {
    put(folder, "reproduce.html", &brinell_report::html(study))
}

fn put(folder: &Path, name: &str, text: &str) -> Result<PathBuf, Error> {
    let path = folder.join(name);
    atomic_write(&path, text.as_bytes())?;
    Ok(path)
}
