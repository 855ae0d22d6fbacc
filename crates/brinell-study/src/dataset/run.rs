//! Runs of a shard, side by side, each on the disk as soon as it is done.

use crate::dataset::campaign::Campaign;
use crate::dataset::error::DatasetError;
use crate::dataset::folder::{Folder, make};
use crate::dataset::simulated::{Run, Short};
use crate::dataset::{Tally, part, sidecar};
use crate::listener::Listener;
use crate::runner::side_by_side;
use brinell_io::{Cell, write_row_file};
use std::collections::HashMap;
use std::fs::File;
use std::num::NonZeroUsize;
use std::path::Path;
use std::str::FromStr;
use std::sync::{Mutex, PoisonError};

/// A share of a campaign: `i/n`, i from 1. Files are dealt out in turn, so that no file's bytes depend on n.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Which one, from 1.
    pub index: usize,
    /// Of how many.
    pub of: usize,
}

impl Shard {
    /// The whole.
    pub const WHOLE: Self = Self { index: 1, of: 1 };

    /// Whether a file is this shard's.
    pub fn has(self, part: usize) -> bool {
        part % self.of == self.index - 1
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| text.trim().parse::<usize>().ok();
        let parts = text.split_once('/').and_then(|(i, n)| Some((number(i)?, number(n)?)));
        match parts {
            Some((index, of)) if (1..=of).contains(&index) => Ok(Self { index, of }),
            Some((0, of)) if of > 0 => Err(format!("shards count from 1: 1/{of} to {of}/{of}")),
            _ => Err("expected I/N, I from 1 to N, for instance 3/10".into()),
        }
    }
}

/// The outcome of a shard.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ShardSummary {
    /// Runs of the shard.
    pub runs: usize,
    /// Of them, done now.
    pub done: usize,
    /// Of them, there already.
    pub before: usize,
    /// Of the shard's finished files, runs that failed.
    pub failed: u64,
    /// Of the shard's finished files, by class, what their user should know.
    pub tally: Tally,
    /// Somebody stopped it.
    pub interrupted: bool,
    /// Whether every file of the whole campaign is there, and `dataset.json` with them.
    pub whole: bool,
}

impl ShardSummary {
    /// What the user of the shard's finished files should know, a sentence each.
    pub fn warnings(&self, campaign: &Campaign) -> Vec<String> {
        let classes: Vec<String> = campaign.plan().classes.iter().map(|class| class.name.clone()).collect();
        self.tally.words(&classes)
    }
}

/// A file whose runs are being done.
struct Open {
    left: usize,
    _lock: File,
}

struct Work<'a> {
    campaign: &'a Campaign,
    folder: &'a Folder,
    listener: &'a dyn Listener,
    open: Mutex<HashMap<usize, Open>>,
}

/// Does what is missing of a shard in `folder`, up to `threads` runs at a time. Call it again to resume where it
/// stopped.
///
/// # Errors
/// Where the folder holds something else, another process is at work on the same runs, or files cannot be written: what
/// was finished stays.
pub fn run(
    campaign: &Campaign,
    folder: impl AsRef<Path>,
    shard: Shard,
    threads: NonZeroUsize,
    listener: &dyn Listener,
) -> Result<ShardSummary, DatasetError> {
    let folder = Folder::new(folder.as_ref());
    campaign.claim(&folder.root)?;
    let mut summary = ShardSummary::default();
    let mut jobs = Vec::new();
    let parts: Vec<usize> = (0..campaign.parts()).filter(|part| shard.has(*part)).collect();
    for part in &parts {
        let runs = campaign.runs_of(*part);
        summary.runs += runs.len();
        if folder.finished(*part)?.is_some() {
            summary.before += runs.len();
            listener.before(runs.len());
            clear(&folder, *part);
        } else {
            jobs.extend(runs.iter().map(|run| (*part, *run)));
        }
    }
    let work = Work { campaign, folder: &folder, listener, open: Mutex::new(HashMap::new()) };
    let flow = side_by_side(
        jobs.len(),
        threads,
        |k| work.one(jobs[k].0, jobs[k].1),
        |_, is_new| {
            *if is_new { &mut summary.done } else { &mut summary.before } += 1;
            Ok(())
        },
    )?;
    summary.interrupted = flow.is_break();
    for part in parts {
        if let Some(facts) = folder.finished(part)? {
            summary.failed += facts.runs.failed.unwrap_or(0);
            summary.tally.join(facts.runs.tally.as_ref());
        }
    }
    summary.whole = sidecar::write(&folder)?;
    Ok(summary)
}

impl Work<'_> {
    /// Whether a run of a file is done now, and not there before; `None` where it was broken off.
    fn one(&self, part: usize, run: usize) -> Result<Option<bool>, DatasetError> {
        self.begin(part)?;
        let is_new = !self.folder.row(part, run).exists();
        if is_new && !self.make(part, run)? {
            return Ok(None);
        }
        if !is_new {
            self.listener.before(1);
        }
        if self.end(part) {
            self.close(part)?;
        }
        Ok(Some(is_new))
    }

    /// Runs `run` and puts its row to the disk, with the reason where it cannot be; false where it was broken off.
    fn make(&self, part: usize, run: usize) -> Result<bool, DatasetError> {
        let campaign = self.campaign;
        let mut made = Run::new(campaign.draws(), run);
        match made.go(campaign.try_scenario(run), campaign.signals(), self.listener) {
            Ok(()) => {}
            Err(Short::Failed(reason)) => made.failed = Some(reason),
            Err(Short::Stopped) => return Ok(false),
        }
        let cells: Vec<Cell> = campaign.columns().iter().map(|column| column.cell(&mut made)).collect();
        write_row_file(self.folder.row(part, run), &cells)?;
        self.listener.ended(run, made.failed.as_deref());
        Ok(true)
    }

    /// Takes a file's runs in hand.
    fn begin(&self, part: usize) -> Result<(), DatasetError> {
        let mut open = self.open.lock().unwrap_or_else(PoisonError::into_inner);
        if let std::collections::hash_map::Entry::Vacant(entry) = open.entry(part) {
            make(&self.folder.spool(part))?;
            entry.insert(Open { _lock: self.folder.lock(part)?, left: self.campaign.runs_of(part).len() });
        }
        Ok(())
    }

    /// One run less; true where it was the last.
    fn end(&self, part: usize) -> bool {
        let mut open = self.open.lock().unwrap_or_else(PoisonError::into_inner);
        open.get_mut(&part).is_some_and(|open| {
            open.left -= 1;
            open.left == 0
        })
    }

    /// All runs of a file are there.
    fn close(&self, part: usize) -> Result<(), DatasetError> {
        while part::write(self.campaign, self.folder, part)?.is_none() {
            // A row that a crashed machine left in pieces.
            let broken = self.campaign.runs_of(part).iter().filter(|run| !self.folder.row(part, **run).exists());
            for run in broken.collect::<Vec<_>>() {
                if !self.make(part, *run)? {
                    return Ok(());
                }
            }
        }
        clear(self.folder, part);
        self.open.lock().unwrap_or_else(PoisonError::into_inner).remove(&part);
        Ok(())
    }
}

/// Removes the single runs of a finished file. Where that fails they are in nobody's way.
fn clear(folder: &Folder, part: usize) {
    let _ = std::fs::remove_dir_all(folder.spool(part));
}
