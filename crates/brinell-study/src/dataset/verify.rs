//! A data set's folder compared with what it says of itself.

use crate::dataset::card::CROISSANT;
use crate::dataset::error::DatasetError;
use crate::dataset::folder::{CAMPAIGN, Folder, PART, SECRET_PATH, file_name};
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

/// Checks every file: that it is there, its checksum, its rows, and that campaign, version and columns are the same in all.
///
/// # Errors
/// Where there is no data set, or it cannot be read at all.
pub fn verify(path: impl AsRef<Path>) -> Result<Verified, DatasetError> {
    let folder = Folder::new(path.as_ref());
    let sidecar = match std::fs::read(folder.sidecar()) {
        Ok(bytes) => serde_json::from_slice::<Value>(&bytes).map_err(|error| {
            DatasetError::Refused(format!("{}: {error}", folder.sidecar().display()))
        })?,
        Err(_) => Value::Null,
    };
    let about = match folder.about()? {
        Some(about) => about,
        None if sidecar.is_object() => sidecar.clone(),
        None => {
            return Err(DatasetError::Refused(format!(
                "{}: no data set is here (neither dataset.json nor work/campaign.json)",
                folder.root.display()
            )));
        }
    };
    let listed = sidecar["files"].as_array();
    let mut found = Verified {
        of: listed.map_or(about["files"].as_u64().unwrap_or(0) as usize, Vec::len),
        ..Verified::default()
    };
    if !sidecar.is_object() {
        found
            .problems
            .push("dataset.json is missing: the data set is not finished".into());
    } else if about["campaign"] != sidecar["campaign"] || about["brinell"] != sidecar["brinell"] {
        found
            .problems
            .push("dataset.json is of another campaign or version than work/campaign.json".into());
    } else if is_whole(&sidecar) != Some(true) {
        found
            .problems
            .push("dataset.json: its checksum is another than when it was written".into());
    }
    let columns: Vec<&str> = about["columns"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(|c| c["name"].as_str())
        .collect();
    let parts = files_of(&about);
    for part in 0..found.of {
        let path = folder.part(part);
        let name = format!("runs/{}", file_name(part));
        if !path.exists() {
            found.problems.push(format!("{name} is missing"));
            continue;
        }
        let before = found.problems.len();
        let facts = match record_facts(&path) {
            Ok(facts) => facts,
            Err(error) => {
                found.problems.push(error.to_string());
                continue;
            }
        };
        let mut say = |wrong: bool, what: &str| {
            if wrong {
                found.problems.push(format!("{name}: {what}"));
            }
        };
        let get = |key: &str| facts.metadata.get(key);
        let version = about["brinell"].as_str();
        say(
            get(CAMPAIGN) != about["campaign"].as_str(),
            "of another campaign",
        );
        let theirs = get(keys::VERSION);
        say(
            theirs != version,
            &format!(
                "of brinell {}, the others of {}",
                theirs.unwrap_or("?"),
                version.unwrap_or("?")
            ),
        );
        say(
            get(PART) != Some(part.to_string().as_str()),
            "another file under this name",
        );
        say(
            facts.columns != columns,
            "other columns than the data set's",
        );
        let expected = parts.get(part).map_or(0, |(_, rows)| *rows);
        say(
            facts.rows != expected,
            &format!("{} rows instead of {expected}", facts.rows),
        );
        let told = match listed {
            Some(files) => files.get(part).cloned(),
            None => std::fs::read(folder.facts(part))
                .ok()
                .and_then(|b| serde_json::from_slice::<Value>(&b).ok())
                .map(|f| f["runs"].clone()),
        };
        if let Some(told) = told {
            say(
                Some(sha256_of(&path)?.as_str()) != told["sha256"].as_str(),
                "its checksum is another than when it was written",
            );
            found.failed += told["failed"].as_u64().unwrap_or(0);
        }
        found.rows += facts.rows;
        found.files += usize::from(found.problems.len() == before);
    }
    for path in folder.all_there()? {
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        // A file that another process is about to finish is none yet.
        let whole = name.strip_suffix(".partial").unwrap_or(&name);
        if !(0..found.of).any(|part| whole == file_name(part)) {
            found
                .problems
                .push(format!("runs/{name}: no file of this data set"));
        }
    }
    if let (Some(path), Some(told)) = (
        sidecar[CARD]["path"]
            .as_str()
            .filter(|path| *path == CROISSANT),
        sidecar[CARD]["sha256"].as_str(),
    ) {
        let card = folder.root.join(path);
        if !card.exists() {
            found.absent.push(format!("{path} is not here"));
        } else if sha256_of(&card)? != told {
            found.problems.push(format!(
                "{path}: its checksum is another than when it was written"
            ));
        }
    }
    // The labels may have been taken elsewhere, all of them: those that are here are checked, and what they are made from.
    let plan = &sidecar["held_out"]["plan"];
    let secret: Value = std::fs::read(folder.secret())
        .ok()
        .and_then(|bytes| serde_json::from_slice(&bytes).ok())
        .unwrap_or_default();
    let files = secret["files"].as_array().into_iter().flatten();
    let apart: Vec<(&str, &Value)> = files
        .chain([plan])
        .filter_map(|entry| Some((entry["path"].as_str()?, &entry["sha256"])))
        .collect();
    let there = |path: &str| folder.root.join(path).exists();
    let mut labels = (0..parts.len()).map(|part| folder.held_out(part));
    let are_here = labels.any(|path| path.exists()) || there(SECRET_PATH);
    if plan.is_object() && !are_here {
        found.absent.push("labels are not here".into());
    }
    for (path, told) in apart.into_iter().filter(|_| are_here) {
        if !there(path) {
            let labels = path != SECRET_PATH;
            let remedy = if labels {
                "remove the file of that name in runs/ as well, and both are made again"
            } else {
                "the plan's own command writes it again"
            };
            found
                .problems
                .push(format!("{path} is missing, and others are here: {remedy}"));
        } else if Some(sha256_of(folder.root.join(path))?.as_str()) != told.as_str() {
            found.problems.push(format!(
                "{path}: its checksum is another than when it was written"
            ));
        }
    }
    Ok(found)
}
