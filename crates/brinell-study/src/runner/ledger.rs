//! The journal of a folder.
//!
//! It begins with what it is the journal of, and with which kernel its points are computed; then comes one line a
//! finished point, a [`Row`]. A point counts as finished where a row has the fingerprint of its scenario and the version
//! of this program. Where points are finished, another kernel is refused.

use super::RunnerError;
use crate::campaign::{Row, kernel};
use brinell_io::{IoError, Journal};
use serde_json::Value;
use std::collections::{HashMap, HashSet};
use std::path::Path;

/// Name of the journal within its folder.
pub const JOURNAL: &str = "journal.jsonl";

/// Key of a head: what the journal is of.
const CAMPAIGN: &str = "campaign";
/// Key of a head: the kernel of its points.
const KERNEL: &str = "kernel";

/// The points that a journal holds.
#[derive(Default)]
pub struct Kept {
    rows: HashMap<String, Row>,
    /// Scenarios that another version of this program finished.
    outdated: HashSet<String>,
    /// The journal's latest head; null where there is none.
    head: Value,
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
        let head = lines.iter().rfind(|line| line.get(CAMPAIGN).is_some());
        let mut kept = Self { head: head.cloned().unwrap_or_default(), ..Self::default() };
        for row in lines.iter().filter_map(Row::from_json) {
            if row.version == brinell::VERSION {
                kept.rows.insert(row.scenario.clone(), row);
            } else {
                kept.outdated.insert(row.scenario);
            }
        }
        kept
    }

    /// That this process computes with the kernel of the points that are finished.
    ///
    /// # Errors
    /// Where it does not.
    pub fn same_kernel(&self) -> Result<(), RunnerError> {
        let (theirs, mine) = (self.head[KERNEL].as_str().unwrap_or_default(), kernel());
        if self.rows.is_empty() || theirs.is_empty() || mine.is_empty() || theirs == mine {
            return Ok(());
        }
        let one = match self.head[CAMPAIGN].as_str() {
            Some("sweep") => "sweep",
            Some("calibrate") => "calibration",
            Some("reproduce") => "reproduction",
            _ => "study",
        };
        Err(RunnerError::OtherKernel { one, theirs: theirs.into(), mine })
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
    /// `campaign`, its kind, and whatever tells it from others. The kernel is added. `extend` makes a journal of another
    /// plan of that kind this one's.
    ///
    /// # Errors
    /// Where it is another campaign's or another kernel's, or cannot be written.
    pub fn open(folder: &Path, header: &Value, extend: bool) -> Result<Self, RunnerError> {
        let (mut journal, lines) = Journal::open(folder.join(JOURNAL))?;
        let mut head = header.clone();
        head[KERNEL] = kernel().into();
        let kept = Kept::of(&lines);
        let same_plan = |other: &Value| {
            let mut other = other.clone();
            other[KERNEL] = kernel().into();
            other == head
        };
        match &kept.head {
            Value::Null if lines.is_empty() => {}
            Value::Null => return Err(RunnerError::OtherCampaign(Value::Null)),
            other if other[CAMPAIGN] != head[CAMPAIGN] || !(extend || same_plan(other)) => {
                return Err(RunnerError::OtherCampaign(other.clone()));
            }
            _ => kept.same_kernel()?,
        }
        if kept.head != head {
            journal.append(&head)?;
        }
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
