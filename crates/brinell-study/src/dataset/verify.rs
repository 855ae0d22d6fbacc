//! A data set's folder compared with what it says of itself.

use crate::campaign::DIFFER;
use crate::dataset::about::{About, Facts, Held, Sources};
use crate::dataset::card::CROISSANT;
use crate::dataset::error::DatasetError;
use crate::dataset::folder::{
    CAMPAIGN, Folder, HELD_OUT, KERNEL, PART, SECRET_PATH, TRUTH, file_name, number_of, truth_path,
};
use brinell_io::{keys, record_facts, sha256_of};
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
    let (described, planned) = (folder.described(), folder.about());
    // Of a description that is damaged the other one tells what it is of.
    let problems = [described.as_ref().err(), planned.as_ref().err()];
    let problems = problems.into_iter().flatten().map(ToString::to_string).collect();
    let (described, planned) = match (described, planned) {
        (described, Ok(Some(planned))) => (described.map_err(drop), planned),
        (Ok(Some(described)), _) => (Ok(Some(described.clone())), described.0),
        (Err(error), _) | (_, Err(error)) => return Err(error),
        (Ok(None), Ok(None)) => return Err(folder.no_data_set()),
    };
    let mut found = Verified { problems, ..Verified::default() };
    let unfinished = match &described {
        Ok(None) => Some("dataset.json is missing: the data set is not finished"),
        Ok(Some((made, _))) if (&made.campaign, &made.brinell) != (&planned.campaign, &planned.brinell) => {
            Some("dataset.json is of another campaign or version than work/campaign.json")
        }
        Ok(Some((_, false))) => Some("dataset.json: its checksum is another than when it was written"),
        Ok(Some((_, true))) | Err(()) => None,
    };
    found.problems.extend(unfinished.map(ToOwned::to_owned));
    let made = described.ok().flatten().map(|(made, _)| made);
    found.of = made.as_ref().map_or_else(|| planned.rows_of_files().len(), |made| made.listed().len());
    let set = Set { folder: &folder, made: made.unwrap_or_default(), planned };
    set.files(&mut found)?;
    set.strangers(&mut found)?;
    set.card(&mut found)?;
    set.truth(&mut found)?;
    set.labels(&mut found)?;
    Ok(found)
}

/// A data set's folder and what it says of itself.
struct Set<'a> {
    folder: &'a Folder,
    /// `dataset.json`, empty where it is missing.
    made: About,
    planned: About,
}

impl Set<'_> {
    fn files(&self, found: &mut Verified) -> Result<(), DatasetError> {
        let with_runs = self.planned.columns.iter().filter(|column| column.table != TRUTH);
        let columns: Vec<&str> = with_runs.map(|column| &*column.name).collect();
        let parts = self.planned.rows_of_files();
        let mut kernel = self.planned.kernel.clone();
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
        say(get(CAMPAIGN) != Some(&*self.planned.campaign), "of another campaign");
        let (version, theirs) = (&*self.planned.brinell, get(keys::VERSION));
        say(theirs != Some(version), &format!("of brinell {}, the others of {version}", theirs.unwrap_or("?")));
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
            say(sha256_of(&path)? != recorded.sha256, "its checksum is another than when it was written");
            found.failed += recorded.failed.unwrap_or(0);
        }
        found.rows += facts.rows;
        found.files += usize::from(found.problems.len() == before);
        Ok(())
    }

    /// What is written down of a file.
    fn recorded(&self, part: usize) -> Option<Facts> {
        let listed = self.made.listed().get(part).cloned();
        listed.or_else(|| Some(self.folder.recorded(part)?.runs))
    }

    fn strangers(&self, found: &mut Verified) -> Result<(), DatasetError> {
        for folder in ["runs", TRUTH] {
            for path in self.folder.all_in(folder)? {
                let name = path.file_name().unwrap_or_default();
                let name = name.to_string_lossy().into_owned();
                // A file that another process is about to finish is none yet.
                let whole = name.strip_suffix(".partial").unwrap_or(&name);
                if number_of(whole).is_none_or(|part| part >= found.of) {
                    let stranger = format!("{folder}/{name}: no file of this data set");
                    found.problems.push(stranger);
                }
            }
        }
        Ok(())
    }

    fn card(&self, found: &mut Verified) -> Result<(), DatasetError> {
        match self.made.card.as_ref().filter(|card| card.path == CROISSANT) {
            Some(card) if self.folder.root.join(CROISSANT).exists() => self.unchanged(&card.path, &card.sha256, found),
            Some(_) => {
                found.absent.push(format!("{CROISSANT} is not here"));
                Ok(())
            }
            None => Ok(()),
        }
    }

    /// The truth of open runs may have been taken elsewhere, all of it: what is here is checked.
    fn truth(&self, found: &mut Verified) -> Result<(), DatasetError> {
        let recorded = (0..self.planned.rows_of_files().len()).filter_map(|part| self.folder.recorded(part)?.truth);
        let mut truth = self.made.truth.clone();
        if truth.is_empty() {
            truth = recorded.filter(|facts| !facts.path.starts_with(HELD_OUT)).collect();
        }
        let is_here = |facts: &Facts| self.folder.root.join(&facts.path).exists();
        if !truth.is_empty() && !truth.iter().any(is_here) {
            found.absent.push(format!("{TRUTH}/ is not here"));
            return Ok(());
        }
        for facts in &truth {
            if is_here(facts) {
                self.unchanged(&facts.path, &facts.sha256, found)?;
            } else {
                found.problems.push(missing(&facts.path));
            }
        }
        Ok(())
    }

    /// Held-out labels may have been taken elsewhere, all of them: those that are here are checked, and what they are
    /// made from.
    fn labels(&self, found: &mut Verified) -> Result<(), DatasetError> {
        let plan = match &self.made.held_out {
            Some(Held::Made { plan, .. }) => Some(plan),
            _ => None,
        };
        let secret = std::fs::read(self.folder.secret()).ok();
        let secret: Sources = secret.and_then(|bytes| serde_json::from_slice(&bytes).ok()).unwrap_or_default();
        let there = |path: &str| self.folder.root.join(path).exists();
        let parts = self.planned.rows_of_files().len();
        let are_here = (0..parts).any(|part| there(&truth_path(part, true))) || there(SECRET_PATH);
        if plan.is_some() && !are_here {
            found.absent.push("labels are not here".into());
        }
        if !are_here {
            return Ok(());
        }
        let files = secret.files.iter().flatten().map(|file| (&*file.path, &*file.sha256));
        for (path, sha256) in files.chain(plan.map(|plan| (&*plan.path, &*plan.sha256))) {
            if there(path) {
                self.unchanged(path, sha256, found)?;
                continue;
            }
            found.problems.push(missing(path));
        }
        Ok(())
    }

    fn unchanged(&self, path: &str, recorded: &str, found: &mut Verified) -> Result<(), DatasetError> {
        if sha256_of(self.folder.root.join(path))? != recorded {
            found.problems.push(format!("{path}: its checksum is another than when it was written"));
        }
        Ok(())
    }
}

/// That a file beside those of the runs is missing, and what makes it again.
fn missing(path: &str) -> String {
    let remedy = match path == SECRET_PATH {
        false => "remove the file of that name in runs/ as well, and both are made again",
        true => "the plan's own command writes it again",
    };
    format!("{path} is missing, and others are here: {remedy}")
}
