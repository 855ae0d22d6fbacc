//! A data set's folder compared with what it says of itself.

use crate::campaign::DIFFER;
use crate::dataset::card::CROISSANT;
use crate::dataset::error::DatasetError;
use crate::dataset::folder::{CAMPAIGN, Folder, KERNEL, KERNEL_OF, PART, SECRET_PATH, file_name, number_of};
use crate::dataset::sidecar::{CARD, files_of, is_whole};
use brinell_io::{keys, record_facts, sha256_of};
use serde_json::Value;
use std::path::Path;

/// What was found.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Verified {
    /// Files that are there and sound.
    pub files: usize,
    /// Their rows.
    pub rows: u64,
    /// Of them, failed runs.
    pub failed: u64,
    /// Files that the campaign has altogether.
    pub of: usize,
    /// What may lie elsewhere and is not here, in words.
    pub absent: Vec<String>,
    /// Everything that is not as it should be, one line each.
    pub problems: Vec<String>,
}

/// Checks every file: that it is there, its checksum, its rows, and that campaign, version and columns are the same in
/// all.
///
/// # Errors
/// Where there is no data set, or it cannot be read at all.
pub fn verify(path: impl AsRef<Path>) -> Result<Verified, DatasetError> {
    let folder = Folder::new(path.as_ref());
    let (sidecar, about) = (folder.described(), folder.about());
    // Of a description that is damaged the other one tells what it is of.
    let problems = [sidecar.as_ref().err(), about.as_ref().err()].into_iter().flatten().map(ToString::to_string);
    let problems: Vec<String> = problems.collect();
    let (sidecar, about) = match (sidecar, about) {
        (sidecar, Ok(Some(about))) => (sidecar.ok(), about),
        (Ok(sidecar), _) if sidecar.is_object() => (Some(sidecar.clone()), sidecar),
        (Err(error), _) | (_, Err(error)) => return Err(error),
        (Ok(_), Ok(None)) => return Err(folder.no_data_set()),
    };
    let is_damaged = sidecar.is_none();
    let sidecar = sidecar.unwrap_or_default();
    let mut found = Verified {
        problems,
        of: match sidecar["files"].as_array() {
            Some(listed) => listed.len(),
            None => about["files"].as_u64().unwrap_or(0) as usize,
        },
        ..Verified::default()
    };
    let set = Set { folder: &folder, sidecar: &sidecar, about: &about };
    if !is_damaged {
        set.sidecar(&mut found);
    }
    set.files(&mut found)?;
    set.strangers(&mut found)?;
    set.card(&mut found)?;
    set.labels(&mut found)?;
    Ok(found)
}

/// A data set's folder and what it says of itself.
struct Set<'a> {
    folder: &'a Folder,
    /// `dataset.json`, null where it is missing.
    sidecar: &'a Value,
    /// The campaign.
    about: &'a Value,
}

impl Set<'_> {
    fn sidecar(&self, found: &mut Verified) {
        let (sidecar, about) = (self.sidecar, self.about);
        let problem = if !sidecar.is_object() {
            "dataset.json is missing: the data set is not finished"
        } else if about["campaign"] != sidecar["campaign"] || about["brinell"] != sidecar["brinell"] {
            "dataset.json is of another campaign or version than work/campaign.json"
        } else if is_whole(sidecar) != Some(true) {
            "dataset.json: its checksum is another than when it was written"
        } else {
            return;
        };
        found.problems.push(problem.into());
    }

    fn files(&self, found: &mut Verified) -> Result<(), DatasetError> {
        let columns = self.about["columns"].as_array().into_iter().flatten();
        let columns: Vec<&str> = columns.filter_map(|c| c["name"].as_str()).collect();
        let parts = files_of(self.about);
        let mut kernel = self.about[KERNEL_OF].as_str().map(ToOwned::to_owned);
        for part in 0..found.of {
            let rows = parts.get(part).map_or(0, |(_, rows)| *rows);
            self.file(part, &columns, rows, &mut kernel, found)?;
        }
        Ok(())
    }

    /// One file, which should hold `columns` and so many `rows`, computed with the instructions `kernel`.
    fn file(
        &self,
        part: usize,
        columns: &[&str],
        rows: u64,
        kernel: &mut Option<String>,
        found: &mut Verified,
    ) -> Result<(), DatasetError> {
        let path = self.folder.part(part);
        let name = format!("runs/{}", file_name(part));
        if !path.exists() {
            found.problems.push(format!("{name} is missing"));
            return Ok(());
        }
        let before = found.problems.len();
        let facts = match record_facts(&path) {
            Ok(facts) => facts,
            Err(error) => {
                found.problems.push(error.to_string());
                return Ok(());
            }
        };
        let mut say = |wrong: bool, what: &str| {
            if wrong {
                found.problems.push(format!("{name}: {what}"));
            }
        };
        let get = |key: &str| facts.metadata.get(key);
        let ours = self.about["campaign"].as_str();
        say(get(CAMPAIGN) != ours, "of another campaign");
        let (version, theirs) = (self.about["brinell"].as_str(), get(keys::VERSION));
        let word = |version: Option<&str>| version.unwrap_or("?").to_owned();
        let other = format!("of brinell {}, the others of {}", word(theirs), word(version));
        say(theirs != version, &other);
        let theirs = get(KERNEL).unwrap_or("?");
        let ours = kernel.get_or_insert_with(|| theirs.to_owned());
        let mixed = format!("computed with the kernel {theirs}, the data set with {ours}: {DIFFER}");
        say(theirs != ours, &mixed);
        let other_part = get(PART) != Some(part.to_string().as_str());
        say(other_part, "another file under this name");
        say(facts.columns != columns, "other columns than the data set's");
        let count = format!("{} rows instead of {rows}", facts.rows);
        say(facts.rows != rows, &count);
        if let Some(recorded) = self.recorded(part) {
            let changed = Some(sha256_of(&path)?.as_str()) != recorded["sha256"].as_str();
            say(changed, "its checksum is another than when it was written");
            found.failed += recorded["failed"].as_u64().unwrap_or(0);
        }
        found.rows += facts.rows;
        found.files += usize::from(found.problems.len() == before);
        Ok(())
    }

    /// What is written down of a file.
    fn recorded(&self, part: usize) -> Option<Value> {
        if let Some(files) = self.sidecar["files"].as_array() {
            return files.get(part).cloned();
        }
        let bytes = std::fs::read(self.folder.facts(part)).ok()?;
        let facts: Value = serde_json::from_slice(&bytes).ok()?;
        Some(facts["runs"].clone())
    }

    fn strangers(&self, found: &mut Verified) -> Result<(), DatasetError> {
        for path in self.folder.all_there()? {
            let name = path.file_name().unwrap_or_default();
            let name = name.to_string_lossy().into_owned();
            // A file that another process is about to finish is none yet.
            let whole = name.strip_suffix(".partial").unwrap_or(&name);
            if number_of(whole).is_none_or(|part| part >= found.of) {
                let stranger = format!("runs/{name}: no file of this data set");
                found.problems.push(stranger);
            }
        }
        Ok(())
    }

    fn card(&self, found: &mut Verified) -> Result<(), DatasetError> {
        let card = &self.sidecar[CARD];
        let path = card["path"].as_str().filter(|path| *path == CROISSANT);
        if let (Some(path), Some(recorded)) = (path, card["sha256"].as_str()) {
            if !self.folder.root.join(path).exists() {
                found.absent.push(format!("{path} is not here"));
            } else {
                self.unchanged(path, Some(recorded), found)?;
            }
        }
        Ok(())
    }

    /// Held-out labels may have been taken elsewhere, all of them: those that are here are checked, and what they are
    /// made from.
    fn labels(&self, found: &mut Verified) -> Result<(), DatasetError> {
        let plan = &self.sidecar["held_out"]["plan"];
        let secret: Value = std::fs::read(self.folder.secret())
            .ok()
            .and_then(|bytes| serde_json::from_slice(&bytes).ok())
            .unwrap_or_default();
        let there = |path: &str| self.folder.root.join(path).exists();
        let parts = files_of(self.about).len();
        let mut labels = (0..parts).map(|part| self.folder.held_out(part));
        let are_here = labels.any(|path| path.exists()) || there(SECRET_PATH);
        if plan.is_object() && !are_here {
            found.absent.push("labels are not here".into());
        }
        if !are_here {
            return Ok(());
        }
        let files = secret["files"].as_array().into_iter().flatten();
        for entry in files.chain([plan]) {
            let Some(path) = entry["path"].as_str() else {
                continue;
            };
            if there(path) {
                self.unchanged(path, entry["sha256"].as_str(), found)?;
                continue;
            }
            let remedy = match path == SECRET_PATH {
                false => "remove the file of that name in runs/ as well, and both are made again",
                true => "the plan's own command writes it again",
            };
            found.problems.push(format!("{path} is missing, and others are here: {remedy}"));
        }
        Ok(())
    }

    fn unchanged(&self, path: &str, recorded: Option<&str>, found: &mut Verified) -> Result<(), DatasetError> {
        if Some(sha256_of(self.folder.root.join(path))?.as_str()) != recorded {
            found.problems.push(format!("{path}: its checksum is another than when it was written"));
        }
        Ok(())
    }
}
