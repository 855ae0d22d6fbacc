//! The journal of a folder.
//!
//! It begins with what it is the journal of; then comes one line a finished point, a [`Row`]. A point counts as
//! finished where a row has the fingerprint of its scenario and the version of this program.

use super::RunnerError;
use crate::campaign::Row;
use brinell_io::{IoError, Journal};
use serde_json::Value;
use std::collections::{HashMap, HashSet};
use std::path::Path;

/// Name of the journal within its folder.
pub const JOURNAL: &str = "journal.jsonl";

/// The points that a journal holds.
#[derive(Default)]
pub struct Kept {
    rows: HashMap<String, Row>,
    /// Scenarios that another version of this program finished.
    outdated: HashSet<String>,
}

impl Kept {
    /// What is in a folder's journal, which stays as it is; nothing where there is none.
    ///
    /// # Errors
    /// Where it cannot be read.
    pub fn look(folder: &Path) -> Result<Self, IoError> {
        Ok(Self::of(&Journal::read(folder.join(JOURNAL))?))
    }

    fn of(lines: &[Value]) -> Self {
        let mut kept = Self::default();
        for row in lines.iter().filter_map(Row::from_json) {
            if row.version == brinell::VERSION {
                kept.rows.insert(row.scenario.clone(), row);
            } else {
                kept.outdated.insert(row.scenario);
            }
        }
        kept
    }

    /// The row of a scenario that is finished.
    pub fn row(&self, fingerprint: &str) -> Option<&Row> {
        self.rows.get(fingerprint)
    }

    /// How many scenarios are finished.
    #[expect(clippy::len_without_is_empty, reason = "nobody asks")]
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether a scenario is finished, but by another version of this program.
    pub fn is_outdated(&self, fingerprint: &str) -> bool {
        self.outdated.contains(fingerprint) && !self.rows.contains_key(fingerprint)
    }
}

/// A folder's journal, open for more, and the points that are finished. The default is one without a folder, which is
/// forgotten with the process.
#[derive(Default)]
pub struct Ledger {
    journal: Option<Journal>,
    /// The points that are finished.
    pub kept: Kept,
}

impl Ledger {
    /// Opens the journal of `folder`, which exists, for the campaign that `header` describes: an object with
    /// `campaign`, its kind, and whatever tells it from others. `extend` makes a journal of another plan of that kind
    /// this one's.
    ///
    /// # Errors
    /// Where it is another campaign's, or cannot be written.
    pub fn open(folder: &Path, header: &Value, extend: bool) -> Result<Self, RunnerError> {
        let (mut journal, lines) = Journal::open(folder.join(JOURNAL))?;
        let is_header = |line: &&Value| line.get("campaign").is_some();
        let latest = lines.iter().rfind(is_header);
        match latest {
            Some(other) if other["campaign"] != header["campaign"] => {
                return Err(RunnerError::OtherCampaign(other.clone()));
            }
            Some(other) if other != header && !extend => {
                return Err(RunnerError::OtherCampaign(other.clone()));
            }
            Some(other) if other == header => {}
            None if !lines.is_empty() => return Err(RunnerError::OtherCampaign(Value::Null)),
            _ => journal.append(header)?,
        }
        let kept = Kept::of(&lines);
        Ok(Self { journal: Some(journal), kept })
    }

    pub(super) fn add(&mut self, row: Row) -> Result<(), RunnerError> {
        if let Some(journal) = &mut self.journal {
            journal.append(&row.to_json())?;
        }
        self.kept.rows.insert(row.scenario.clone(), row);
        Ok(())
    }
}
