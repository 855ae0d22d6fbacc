//! The folder of a run's results: whose results lie there already, and which files of them have to go.
//!
//! `summary.json` lists the files of its run under `files`. A new run removes what an earlier one listed, so that every result in a folder is of
//! one run. Nothing else is ever removed.

use crate::failure::Failure;
use brinell::document::read;
use brinell::scenario::Scenario;
use brinell_io::{Format, read_text};
use serde_json::Value;
use std::path::{Component, Path, PathBuf};

pub(super) const SCENARIO: &str = "scenario.toml";
pub(super) const SUMMARY: &str = "summary.json";
pub(super) const REPORT: &str = "report.html";
/// Folder of the pictures.
pub(crate) const PLOTS: &str = "plots";

/// Names of results right in the folder.
fn names() -> impl Iterator<Item = &'static str> {
    let signals = Format::ALL.into_iter().map(Format::file_name);
    [SCENARIO, SUMMARY, REPORT].into_iter().chain(signals)
}

/// The earlier results of a folder, which a new run replaces.
#[derive(Debug, Default)]
pub(super) struct Earlier {
    folder: PathBuf,
    /// Names below the folder.
    files: Vec<String>,
}

impl Earlier {
    /// What lies in `folder`; nothing is changed. `writes` are the names that the run will write whatever happens.
    ///
    /// # Errors
    /// Where results of another scenario lie there and `overwrite` was not asked for, or files with a result's name that no summary lists.
    pub(super) fn find(
        folder: &Path,
        scenario: &Scenario,
        overwrite: bool,
        writes: &[&str],
    ) -> Result<Self, Failure> {
        let there: Vec<&str> = names()
            .filter(|name| {
                let there = folder.join(name).symlink_metadata();
                there.is_ok_and(|there| !there.is_dir())
            })
            .collect();
        let files = listed(folder, &there);
        let unlisted = there
            .iter()
            .filter(|name| **name != SCENARIO && !files.iter().any(|file| file == *name));
        let unlisted: Vec<&str> = unlisted.copied().collect();
        let at = folder.display();
        if !there.is_empty() && !overwrite && !holds(folder, scenario) {
            return Err(Failure::Usage(format!(
                "{at} holds results of another scenario ({}); choose another folder with -o, or replace them with --overwrite",
                there.join(", ")
            )));
        }
        if !unlisted.is_empty() && !overwrite {
            return Err(Failure::Usage(format!(
                "{at} holds {}, and no {SUMMARY} there lists them as a run's; choose another folder with -o, or replace them with --overwrite",
                unlisted.join(", ")
            )));
        }
        let stays: Vec<&str> = unlisted
            .into_iter()
            .filter(|name| !writes.contains(name))
            .collect();
        if !stays.is_empty() {
            return Err(Failure::Usage(format!(
                "{at} holds {}, which this run does not write and no {SUMMARY} there lists as a run's: a reader would take it for this \
                 run's. Move it, or choose another folder with -o",
                stays.join(", ")
            )));
        }
        Ok(Self {
            folder: folder.to_owned(),
            files,
        })
    }

    /// Removes them. The scenario stays until the new one takes its place.
    pub(super) fn remove(&self) -> Result<(), Failure> {
        for name in self.files.iter().filter(|name| *name != SCENARIO) {
            let path = self.folder.join(name);
            match std::fs::remove_file(&path) {
                Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                    return Err(Failure::Usage(format!(
                        "cannot remove {}, of an earlier run: {error}",
                        path.display()
                    )));
                }
                _ => {}
            }
        }
        // Unless something else lies there.
        let _ = std::fs::remove_dir(self.folder.join(PLOTS));
        Ok(())
    }
}

/// Files below `folder` that its summary lists, as far as they can be a run's.
fn listed(folder: &Path, there: &[&str]) -> Vec<String> {
    let text = std::fs::File::open(folder.join(SUMMARY)).and_then(read_text);
    let Ok(summary) = serde_json::from_slice::<Value>(&text.unwrap_or_default()) else {
        return Vec::new();
    };
    let is_ours = |name: &&str| names().any(|n| n == *name) || is_picture(name);
    match summary["files"].as_array() {
        Some(files) => {
            let files = files.iter().filter_map(Value::as_str);
            files.filter(is_ours).map(str::to_owned).collect()
        }
        // Written before summaries listed files.
        None if summary["brinell"].is_string() && summary["simulated"].is_object() => {
            there.iter().map(|name| (*name).to_owned()).collect()
        }
        None => Vec::new(),
    }
}

fn is_picture(name: &str) -> bool {
    let path = Path::new(name);
    let parts: Vec<Component<'_>> = path.components().collect();
    let ending = path.extension().and_then(|ending| ending.to_str());
    matches!(parts[..], [Component::Normal(folder), Component::Normal(_)] if folder == PLOTS)
        && matches!(ending, Some("svg" | "png"))
}

/// Whether the folder's scenario is this one, all values the same.
fn holds(folder: &Path, scenario: &Scenario) -> bool {
    let Ok(bytes) = std::fs::File::open(folder.join(SCENARIO)).and_then(read_text) else {
        return false;
    };
    let text = String::from_utf8_lossy(&bytes);
    read(&text, &[]).is_ok_and(|loaded| loaded.scenario == *scenario)
}
