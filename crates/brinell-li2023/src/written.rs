//! A reproduction as files: the page, the tables of claims, and the book's chapter.

use crate::curve_files::{CurveFiles, make_folder};
use crate::reproduction::Reproduction;
use crate::{BASE, Error, book, outcome, page};
use brinell::scenario::Scenario;
use brinell_io::atomic_write;
use brinell_report::{DamageView, Picture, Study};
use serde_json::json;
use std::path::{Path, PathBuf};

impl Reproduction {
    /// The page. `plan` gives the view from above of a scenario's first defect.
    pub fn study(&self, files: &CurveFiles, plan: impl Fn(&Scenario) -> Option<DamageView>) -> Study {
        let curves = |id: &str| {
            let point = self.request.points.iter().find(|p| p.case.id == id)?;
            files.curves(&point.task.fingerprint)
        };
        page::study(self, curves, plan)
    }

    /// Writes `claims.csv`, `claims.json` and, with other models, `models.csv` into a folder, which exists.
    ///
    /// # Errors
    /// Where a file cannot be written.
    pub fn write_claims(&self, folder: &Path) -> Result<Vec<PathBuf>, Error> {
        let mut header = json!({
            "brinell": brinell::VERSION, "length": self.request.length.words(), "starts": self.request.length.starts(), "base_toml": BASE,
            "interval": "95 % of the value, an average over whole revolutions of the inner ring and over the starts; peaks are those of a revolution",
        });
        if let Some(sensitivity) = &self.sensitivity {
            header["sensitivity"] = sensitivity.json();
        }
        let mut written = outcome::write(&self.outcomes, &header, folder)?;
        if let Some(models) = &self.models {
            written.push(models.write(folder)?);
        }
        Ok(written)
    }

    /// Writes `reproduction.md`, the book's chapter, and its pictures into the folder `book`.
    ///
    /// # Errors
    /// Where the folder cannot be made or a file cannot be written.
    pub fn write_book(&self, study: &Study, pictures: &[Picture], book: &Path) -> Result<Vec<PathBuf>, Error> {
        make_folder(book)?;
        let text = book::text(study, self, book);
        let mut written = vec![put(book, "reproduction.md", &text)?];
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
pub fn write_page(study: &Study, folder: &Path) -> Result<PathBuf, Error> {
    put(folder, "reproduce.html", &brinell_report::study_html(study))
}

fn put(folder: &Path, name: &str, text: &str) -> Result<PathBuf, Error> {
    let path = folder.join(name);
    atomic_write(&path, text.as_bytes())?;
    Ok(path)
}
