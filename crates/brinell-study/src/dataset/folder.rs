//! What lies where in a data set's folder, and whose folder it is.

use crate::campaign::other_kernel;
use crate::dataset::error::DatasetError;
use brinell_io::{IoError, Metadata, RecordFacts, atomic_write, lock, record_facts, sha256_of};
use serde_json::{Value, json};
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

    pub(crate) fn held_out(&self, part: usize) -> PathBuf {
        self.root.join("held_out").join(file_name(part))
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
    pub(crate) fn claim(&self, mine: &Value) -> Result<(), DatasetError> {
        for folder in ["runs", "work"] {
            make(&self.root.join(folder))?;
        }
        if mine["held_out"] == true {
            make(&self.root.join("held_out"))?;
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

    /// `dataset.json`; null where it cannot be read, as before the data set is finished.
    pub(crate) fn described(&self) -> Result<Value, DatasetError> {
        let path = self.sidecar();
        std::fs::read(&path).map_or(Ok(Value::Null), |bytes| {
            serde_json::from_slice(&bytes).map_err(|error| self.unreadable(&path, &error))
        })
    }

    /// That nothing here tells of a data set.
    pub(crate) fn no_data_set(&self) -> DatasetError {
        DatasetError::Refused(format!(
            "{}: no data set is here (neither dataset.json nor work/campaign.json)",
            self.root.display()
        ))
    }

    /// What the folder says of its campaign; `None` where it has none yet.
    pub(crate) fn about(&self) -> Result<Option<Value>, DatasetError> {
        let path = self.campaign();
        let bytes = match std::fs::read(&path) {
            Ok(bytes) => bytes,
            // The name may be a file's.
            Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => return Ok(None),
            Err(error) => return Err(DatasetError::Read { path, error }),
        };
        serde_json::from_slice(&bytes).map(Some).map_err(|error| self.unreadable(&path, &error))
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
    pub(crate) fn same(&self, mine: &Value, theirs: &Value) -> Result<(), DatasetError> {
        let text = |value: &Value, key: &str| value[key].as_str().unwrap_or("?").to_owned();
        let at = self.root.display();
        if text(mine, "brinell") != text(theirs, "brinell") {
            return Err(DatasetError::Refused(format!(
                "{at} holds runs of brinell {}, and this is {}: one data set has one version; finish it with that version, or choose another \
                 folder",
                text(theirs, "brinell"),
                text(mine, "brinell")
            )));
        }
        if mine["campaign"] != theirs["campaign"] {
            return Err(DatasetError::Refused(format!(
                "{at} holds another campaign, {:?} with {} runs (plan, seed, base scenario or a file of damage differ); choose another folder",
                text(theirs, "name"),
                theirs["runs"]
            )));
        }
        let columns = |about: &Value| -> Vec<String> {
            about["columns"].as_array().into_iter().flatten().map(|column| text(column, "name")).collect()
        };
        if theirs["columns"].is_array() && columns(mine) != columns(theirs) {
            return Err(DatasetError::Refused(format!(
                "{at} holds runs with other columns, made by another build of brinell {}; finish it with that build, or choose another folder",
                text(mine, "brinell")
            )));
        }
        let kernels = [mine, theirs].map(|about| about[KERNEL_OF].as_str());
        if let [Some(mine), Some(theirs)] = kernels
            && mine != theirs
        {
            return Err(DatasetError::Refused(other_kernel(at, "data set", theirs, mine)));
        }
        Ok(())
    }

    /// Files of runs without a word on whose they are: their own metadata decides.
    fn parts_are(&self, mine: &Value) -> Result<(), DatasetError> {
        for part in self.parts_there()? {
            let facts = record_facts(&part)?;
            let theirs = json!({
                "campaign": facts.metadata.get(CAMPAIGN),
                "brinell": facts.metadata.get(brinell_io::keys::VERSION),
                "name": facts.metadata.get(NAME),
                KERNEL_OF: facts.metadata.get(KERNEL),
                "runs": "?",
            });
            self.same(mine, &theirs)?;
        }
        Ok(())
    }

    /// Every Parquet file among the runs, in order.
    pub(crate) fn parts_there(&self) -> Result<Vec<PathBuf>, DatasetError> {
        let mut parts = self.all_there()?;
        parts.retain(|p| p.extension().is_some_and(|e| e == "parquet"));
        Ok(parts)
    }

    /// Everything among the runs, in order.
    pub(crate) fn all_there(&self) -> Result<Vec<PathBuf>, DatasetError> {
        let path = self.root.join("runs");
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
    pub(crate) fn finished(&self, part: usize) -> Result<Option<Value>, DatasetError> {
        let path = self.part(part);
        if !path.exists() {
            return Ok(None);
        }
        let recorded: Option<Value> =
            std::fs::read(self.facts(part)).ok().and_then(|b| serde_json::from_slice(&b).ok());
        if let Some(facts) = recorded {
            self.are_lengths(part, &facts)?;
            return Ok(Some(facts));
        }
        let held_out = self.held_out(part);
        let facts = json!({
            "runs": self.file_facts(&path)?,
            "held_out": if held_out.exists() { self.file_facts(&held_out)? } else { Value::Null },
        });
        self.write_facts(part, &facts)?;
        Ok(Some(facts))
    }

    /// That the files of a part have the lengths that were written.
    fn are_lengths(&self, part: usize, facts: &Value) -> Result<(), DatasetError> {
        let labels = facts["held_out"].is_object();
        let runs = (self.part(part), &facts["runs"]);
        let labels = labels.then(|| (self.held_out(part), &facts["held_out"]));
        for (path, recorded) in std::iter::once(runs).chain(labels) {
            // Labels may have been taken elsewhere.
            let Ok(found) = std::fs::metadata(&path) else {
                continue;
            };
            if Some(found.len()) != recorded["bytes"].as_u64() {
                return Err(DatasetError::Refused(format!(
                    "{}: {} bytes, and {} says {}: one of them is damaged; remove both, and the same command makes them again",
                    path.display(),
                    found.len(),
                    self.facts(part).display(),
                    recorded["bytes"]
                )));
            }
        }
        Ok(())
    }

    pub(crate) fn write_facts(&self, part: usize, facts: &Value) -> Result<(), DatasetError> {
        Ok(atomic_write(self.facts(part), facts.to_string() + "\n")?)
    }

    fn file_facts(&self, path: &Path) -> Result<Value, DatasetError> {
        let RecordFacts { rows, metadata, .. } = record_facts(path)?;
        let bytes = std::fs::metadata(path).map_err(|error| DatasetError::Read { path: path.to_owned(), error })?;
        let tally = metadata.get(TALLY).and_then(|text| serde_json::from_str(text).ok()).unwrap_or_default();
        Ok(facts_of(rows, failed_of(&metadata), bytes.len(), &sha256_of(path)?, tally))
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

/// Key of a file's metadata: how many of its runs failed.
pub(crate) const FAILED: &str = "brinell.failed_runs";

fn failed_of(metadata: &Metadata) -> u64 {
    metadata.get(FAILED).and_then(|text| text.parse().ok()).unwrap_or(0)
}

/// Key of a file's metadata: the instructions that its runs were computed with.
pub(crate) const KERNEL: &str = "brinell.kernel";
/// The same in what a folder says of itself.
pub(crate) const KERNEL_OF: &str = "kernel";
/// Key of a file's metadata: its [`Tally`](super::Tally); none where labels are held out.
pub(crate) const TALLY: &str = "brinell.tally";

pub(crate) fn facts_of(rows: u64, failed: u64, bytes: u64, sha256: &str, tally: Value) -> Value {
    let mut facts = json!({ "rows": rows, "failed": failed, "bytes": bytes, "sha256": sha256 });
    if tally.is_object() {
        facts["tally"] = tally;
    }
    facts
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
pub(crate) fn written(value: &Value) -> String {
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
