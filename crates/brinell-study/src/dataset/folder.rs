//! What lies where in a data set's folder, and whose folder it is.

use crate::campaign::other_kernel;
use crate::dataset::about::{About, ColumnOf, Facts, Held, PartFacts};
use crate::dataset::error::DatasetError;
use brinell::made_by::digest;
use brinell_io::{IoError, RecordFacts, atomic_write, lock, record_facts, sha256_of};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::fs::{File, OpenOptions};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Key of a file's metadata: which campaign it is part of.
pub(crate) const CAMPAIGN: &str = "brinell.campaign";
/// Key of a file's metadata: name of the data set.
pub(crate) const NAME: &str = "brinell.dataset";
/// Key of a file's metadata: number of the file, from 0.
pub(crate) const PART: &str = "brinell.part";

/// Folder of the truth of open runs.
pub(crate) const TRUTH: &str = "truth";
/// Folder of labels and truth of the others.
pub(crate) const HELD_OUT: &str = "held_out";
/// Plan and base of a data set with held-out labels, from its folder.
pub(crate) const SECRET_PATH: &str = "held_out/_plan.json";

/// A data set's folder.
#[derive(Debug, Clone)]
pub(crate) struct Folder {
    pub(crate) root: PathBuf,
}

impl Folder {
    pub(crate) fn new(root: &Path) -> Self {
        Self { root: root.to_owned() }
    }

    pub(crate) fn sidecar(&self) -> PathBuf {
        self.root.join("dataset.json")
    }

    pub(crate) fn part(&self, part: usize) -> PathBuf {
        self.root.join("runs").join(file_name(part))
    }

    /// What belongs to the labels: plan and base, from which anybody could make them. Readers of a folder of Parquet
    /// pass over names with `_`.
    pub(crate) fn secret(&self) -> PathBuf {
        self.root.join(SECRET_PATH)
    }

    pub(crate) fn campaign(&self) -> PathBuf {
        self.root.join("work").join("campaign.json")
    }

    pub(crate) fn facts(&self, part: usize) -> PathBuf {
        self.root.join("work").join(format!("part-{part:05}.json"))
    }

    pub(crate) fn spool(&self, part: usize) -> PathBuf {
        self.root.join("work").join(format!("part-{part:05}"))
    }

    pub(crate) fn row(&self, part: usize, run: usize) -> PathBuf {
        self.spool(part).join(format!("run-{run:07}.row"))
    }

    /// Makes the folder a campaign's, or finds that it is; `mine` is what is known of the campaign before a run.
    ///
    /// # Errors
    /// Where it holds another campaign, or one of another version.
    pub(crate) fn claim(&self, mine: &About) -> Result<(), DatasetError> {
        for folder in ["runs", TRUTH, "work"] {
            make(&self.root.join(folder))?;
        }
        if mine.held_out == Some(Held::Planned(true)) {
            make(&self.root.join(HELD_OUT))?;
        }
        // Many shards may begin at once: whoever is first writes.
        for _ in 0..200 {
            if let Some(theirs) = self.about()? {
                return self.same(mine, &theirs);
            }
            self.parts_are(mine)?;
            match atomic_write(self.campaign(), written(mine)) {
                Err(IoError::Busy { .. }) => std::thread::sleep(Duration::from_millis(50)),
                Err(error) => return Err(error.into()),
                Ok(()) => {}
            }
        }
        Err(DatasetError::Refused(format!(
            "{}: another process is about to begin here and does not; remove {}.partial and try again",
            self.root.display(),
            self.campaign().display()
        )))
    }

    /// `dataset.json`, and whether it is as it was written; `None` where it cannot be read, as before the data set is
    /// finished.
    pub(crate) fn described(&self) -> Result<Option<(About, bool)>, DatasetError> {
        let path = self.sidecar();
        let Ok(bytes) = std::fs::read(&path) else {
            return Ok(None);
        };
        let mut all: Value = self.parsed(&path, &bytes)?;
        let stated = all.as_object_mut().and_then(|all| all.shift_remove(CHECKSUM));
        let is_whole = stated.is_some_and(|stated| stated["sha256"] == digest(&written(&all)));
        let made = About::deserialize(all).map_err(|error| self.unreadable(&path, &error))?;
        Ok(Some((made, is_whole)))
    }

    /// That nothing here tells of a data set.
    pub(crate) fn no_data_set(&self) -> DatasetError {
        DatasetError::Refused(format!(
            "{}: no data set is here (neither dataset.json nor work/campaign.json)",
            self.root.display()
        ))
    }

    /// What the folder says of its campaign; `None` where it has none yet.
    pub(crate) fn about(&self) -> Result<Option<About>, DatasetError> {
        let path = self.campaign();
        let bytes = match std::fs::read(&path) {
            Ok(bytes) => bytes,
            // The name may be a file's.
            Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => return Ok(None),
            Err(error) => return Err(DatasetError::Read { path, error }),
        };
        self.parsed(&path, &bytes).map(Some)
    }

    fn parsed<T: DeserializeOwned>(&self, path: &Path, bytes: &[u8]) -> Result<T, DatasetError> {
        serde_json::from_slice(bytes).map_err(|error| self.unreadable(path, &error))
    }

    /// That a description is no JSON, and what mends it.
    fn unreadable(&self, path: &Path, error: &serde_json::Error) -> DatasetError {
        let name = path.strip_prefix(&self.root).unwrap_or(path).display();
        DatasetError::Refused(format!(
            "{}: damaged ({error}); remove {name}, and the plan's own command, with the same version and kernel, writes it again",
            path.display()
        ))
    }

    /// Whether two campaigns are the same, with words for what to do where they are not.
    pub(crate) fn same(&self, mine: &About, theirs: &About) -> Result<(), DatasetError> {
        let at = self.root.display();
        let refused = |words: String| Err(DatasetError::Refused(words));
        if mine.brinell != theirs.brinell {
            return refused(format!(
                "{at} holds runs of brinell {}, and this is {}: one data set has one version; finish it with that version, or choose another \
                 folder",
                theirs.brinell, mine.brinell
            ));
        }
        if mine.campaign != theirs.campaign {
            let runs = match theirs.total() {
                0 => String::new(),
                runs => format!(" with {runs} runs"),
            };
            return refused(format!(
                "{at} holds another campaign, {:?}{runs} (plan, seed, base scenario or a file of damage differ); choose another folder",
                theirs.name
            ));
        }
        let names = |columns: &[ColumnOf]| columns.iter().map(|column| column.name.clone()).collect::<Vec<_>>();
        if !theirs.columns.is_empty() && names(&mine.columns) != names(&theirs.columns) {
            return refused(format!(
                "{at} holds runs with other columns, made by another build of brinell {}; finish it with that build, or choose another folder",
                mine.brinell
            ));
        }
        match (&mine.kernel, &theirs.kernel) {
            (Some(mine), Some(theirs)) if mine != theirs => refused(other_kernel(at, "data set", theirs, mine)),
            _ => Ok(()),
        }
    }

    /// Files of runs without a word on whose they are: their own metadata decides.
    fn parts_are(&self, mine: &About) -> Result<(), DatasetError> {
        for part in self.parts_there()? {
            let facts = record_facts(&part)?;
            let get = |key: &str| facts.metadata.get(key).unwrap_or("?").to_owned();
            let theirs = About {
                campaign: get(CAMPAIGN),
                brinell: get(brinell_io::keys::VERSION),
                name: get(NAME),
                kernel: facts.metadata.get(KERNEL).map(ToOwned::to_owned),
                ..About::default()
            };
            self.same(mine, &theirs)?;
        }
        Ok(())
    }

    /// Every Parquet file among the runs, in order.
    pub(crate) fn parts_there(&self) -> Result<Vec<PathBuf>, DatasetError> {
        let mut parts = self.all_in("runs")?;
        parts.retain(|p| p.extension().is_some_and(|e| e == "parquet"));
        Ok(parts)
    }

    /// Everything in one of its folders, in order.
    pub(crate) fn all_in(&self, folder: &str) -> Result<Vec<PathBuf>, DatasetError> {
        let path = self.root.join(folder);
        let entries = match std::fs::read_dir(&path) {
            Ok(entries) => entries,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
            Err(error) => return Err(DatasetError::Read { path, error }),
        };
        let names = entries.filter_map(|entry| Some(entry.ok()?.path()));
        let mut names: Vec<PathBuf> = names.collect();
        names.sort();
        Ok(names)
    }

    /// What is known of a file that is finished; `None` where it is not. A file without a checksum is read for one.
    ///
    /// # Errors
    /// Where a file has not the length that it was written with, or what is known of it was changed.
    pub(crate) fn finished(&self, part: usize) -> Result<Option<PartFacts>, DatasetError> {
        let path = self.part(part);
        if !path.exists() {
            return Ok(None);
        }
        if let Some(facts) = self.recorded(part) {
            self.are_lengths(part, &facts)?;
            return Ok(Some(facts));
        }
        let truth = [false, true].map(|are_held_out| truth_path(part, are_held_out));
        let truth = truth.into_iter().find(|path| self.root.join(path).exists());
        let of = |truth: String| -> Result<Facts, DatasetError> {
            let facts = file_facts(&self.root.join(&truth))?;
            // By class and failure the runs are counted.
            Ok(Facts { path: truth, failed: None, tally: None, ..facts })
        };
        let facts = PartFacts { runs: file_facts(&path)?, truth: truth.map(of).transpose()? };
        self.write_facts(part, &facts)?;
        Ok(Some(facts))
    }

    /// What is written down of a part.
    pub(crate) fn recorded(&self, part: usize) -> Option<PartFacts> {
        serde_json::from_slice(&std::fs::read(self.facts(part)).ok()?).ok()
    }

    /// That the files of a part have the lengths that were written.
    fn are_lengths(&self, part: usize, facts: &PartFacts) -> Result<(), DatasetError> {
        let truth = facts.truth.iter().map(|facts| (self.root.join(&facts.path), facts));
        for (path, recorded) in std::iter::once((self.part(part), &facts.runs)).chain(truth) {
            // The truth may have been taken elsewhere.
            let Ok(found) = std::fs::metadata(&path) else {
                continue;
            };
            if found.len() != recorded.bytes {
                return Err(DatasetError::Refused(format!(
                    "{}: {} bytes, and {} says {}: one of them is damaged; remove both, and the same command makes them again",
                    path.display(),
                    found.len(),
                    self.facts(part).display(),
                    recorded.bytes
                )));
            }
        }
        Ok(())
    }

    pub(crate) fn write_facts(&self, part: usize, facts: &PartFacts) -> Result<(), DatasetError> {
        Ok(atomic_write(self.facts(part), serde_json::to_string(facts).unwrap_or_default() + "\n")?)
    }

    /// Holds a file's runs to oneself for as long as what comes back lives, on file systems that have locks.
    ///
    /// # Errors
    /// Where somebody else holds them.
    pub(crate) fn lock(&self, part: usize) -> Result<File, DatasetError> {
        let path = self.spool(part).join("lock");
        // Not emptied: it may be a link to a file that is somebody's.
        let file = OpenOptions::new().write(true).create(true).truncate(false).open(&path);
        let file = file.map_err(|source| IoError::Write { path: path.clone(), source })?;
        match lock(&file, &path) {
            Ok(_) => Ok(file),
            Err(IoError::Busy { .. }) => Err(DatasetError::Refused(format!(
                "{}: another process is at work on the same runs; wait for it, or give each process a --shard of its own",
                self.spool(part).display()
            ))),
            Err(error) => Err(error.into()),
        }
    }
}

/// What a file says of itself, where nothing is written down of it.
fn file_facts(path: &Path) -> Result<Facts, DatasetError> {
    let RecordFacts { rows, metadata, .. } = record_facts(path)?;
    let bytes = std::fs::metadata(path).map_err(|error| DatasetError::Read { path: path.to_owned(), error })?.len();
    let failed = metadata.get(FAILED).and_then(|text| text.parse().ok()).unwrap_or(0);
    let tally = metadata.get(TALLY).and_then(|text| serde_json::from_str(text).ok());
    Ok(Facts { rows, failed: Some(failed), bytes, sha256: sha256_of(path)?, tally, ..Facts::default() })
}

/// Key of a file's metadata: how many of its runs failed.
pub(crate) const FAILED: &str = "brinell.failed_runs";
/// Key of a file's metadata: the instructions that its runs were computed with.
pub(crate) const KERNEL: &str = "brinell.kernel";
/// Key of a file's metadata: its [`Tally`](super::Tally); none where labels are held out.
pub(crate) const TALLY: &str = "brinell.tally";
/// Key of the checksum of `dataset.json`.
pub(crate) const CHECKSUM: &str = "checksum";

/// The file of truth beside that of a part's runs, in the data set's folder.
pub(crate) fn truth_path(part: usize, are_held_out: bool) -> String {
    format!("{}/{}", if are_held_out { HELD_OUT } else { TRUTH }, file_name(part))
}

pub(crate) fn file_name(part: usize) -> String {
    format!("part-{part:05}.parquet")
}

/// The number of a file; none where its name is another than [`file_name`] gives.
pub(crate) fn number_of(name: &str) -> Option<usize> {
    let digits = name.strip_prefix("part-")?.strip_suffix(".parquet")?;
    digits.parse().ok().filter(|part| file_name(*part) == name)
}

pub(crate) fn make(folder: &Path) -> Result<(), DatasetError> {
    std::fs::create_dir_all(folder).map_err(|error| {
        let path = folder.to_owned();
        match error.kind() {
            ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
                IoError::NotPermitted { path, source: error }.into()
            }
            _ => DatasetError::NoFolder { path, error },
        }
    })
}

/// JSON as the folder's files hold it.
pub(crate) fn written(value: &impl Serialize) -> String {
    serde_json::to_string_pretty(value).unwrap_or_default() + "\n"
}

/// Writes a file; what is there with the same content stays.
pub(crate) fn put(path: &Path, text: &str) -> Result<(), DatasetError> {
    if std::fs::read(path).is_ok_and(|there| there == text.as_bytes()) {
        return Ok(());
    }
    match atomic_write(path, text) {
        // Another shard that ended at the same time writes the same.
        Err(IoError::Busy { .. }) | Ok(()) => Ok(()),
        Err(error) => Err(error.into()),
    }
}
