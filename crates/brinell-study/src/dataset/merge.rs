//! Folders in which shards of one campaign ran apart, joined in one.

use crate::dataset::about::{Facts, PartFacts};
use crate::dataset::error::DatasetError;
use crate::dataset::folder::{Folder, make, written};
use crate::dataset::sidecar;
use brinell_io::{atomic_copy, atomic_write, sha256_of};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// What came of joining.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Merged {
    /// Files that were brought in.
    pub brought: usize,
    /// Files that were there already.
    pub before: usize,
    /// Numbers of files that no folder has.
    pub missing: Vec<usize>,
}

impl Merged {
    /// What is still to do, in words; `None` where every file is there.
    pub fn lack(&self) -> Option<String> {
        /// Numbers that are printed.
        const SHOWN: usize = 10;
        let first: Vec<String> = self.missing.iter().take(SHOWN).map(ToString::to_string).collect();
        let (count, more) = (self.missing.len(), self.missing.len() > SHOWN);
        (count > 0).then(|| {
            format!(
                "incomplete: {count} file{} in none of the folders (part {}{}); run their shards again",
                if count == 1 { "" } else { "s" },
                first.join(", "),
                if more { ", ..." } else { "" }
            )
        })
    }
}

/// Brings the finished files of `from` into `into`, which may be one of them, or new, and writes `dataset.json` where
/// all are there then. A file that is there already stays; where two folders have it, both must be the same.
///
/// # Errors
/// Where a folder is none of a data set, or of another campaign or version; where a file is not what its checksum says.
pub fn merge(from: &[PathBuf], into: &Path) -> Result<Merged, DatasetError> {
    let target = Folder::new(into);
    let mut about = target.about()?;
    // All folders are looked at before anything is changed.
    for path in from {
        let folder = Folder::new(path);
        let Some(theirs) = folder.about()? else {
            return Err(DatasetError::Refused(format!(
                "{}: no data set is here ({} is missing)",
                path.display(),
                folder.campaign().display()
            )));
        };
        match &about {
            Some(about) => folder.same(about, &theirs)?,
            None => about = Some(theirs),
        }
    }
    let Some(about) = about else {
        return Err(DatasetError::Refused("no folders to merge".into()));
    };
    for name in ["runs", "work"] {
        make(&into.join(name))?;
    }
    if target.about()?.is_none() {
        atomic_write(target.campaign(), written(&about))?;
    }
    let mut merged = Merged::default();
    for part in 0..about.rows_of_files().len() {
        let mut there = target.finished(part)?;
        merged.before += usize::from(there.is_some());
        for path in from {
            let folder = Folder::new(path);
            let Some(theirs) = folder.finished(part)? else {
                continue;
            };
            match &there {
                Some(mine) if *mine != theirs => {
                    return Err(DatasetError::Refused(format!(
                        "{} and {} differ, and should be the same file: one of them is damaged, or was made with another mathematics library",
                        target.part(part).display(),
                        folder.part(part).display()
                    )));
                }
                Some(_) => {}
                None => {
                    bring(&folder, &target, part, &theirs)?;
                    merged.brought += 1;
                    there = Some(theirs);
                }
            }
        }
        if there.is_none() {
            merged.missing.push(part);
        }
    }
    sidecar::write(&target)?;
    Ok(merged)
}

fn bring(from: &Folder, to: &Folder, part: usize, facts: &PartFacts) -> Result<(), DatasetError> {
    let copy = |from: PathBuf, to: PathBuf, facts: &Facts| -> Result<(), DatasetError> {
        if sha256_of(&from)? != facts.sha256 {
            return Err(DatasetError::Refused(format!(
                "{}: damaged: its checksum is another than when it was written",
                from.display()
            )));
        }
        Ok(atomic_copy(from, to)?)
    };
    if let Some(truth) = &facts.truth {
        let there = to.root.join(&truth.path);
        there.parent().map_or(Ok(()), make)?;
        copy(from.root.join(&truth.path), there, truth)?;
    }
    copy(from.part(part), to.part(part), &facts.runs)?;
    to.write_facts(part, facts)
}
