//! What a data set's folder says of itself: before its runs (`work/campaign.json`), of each finished file
//! (`work/part-00000.json`), and when all files are there (`dataset.json`). What is missing in a file reads as empty.

use crate::dataset::tally::Tally;
use serde::{Deserialize, Serialize};

/// A data set: before its runs, or with its files.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct About {
    pub(crate) name: String,
    pub(crate) schema: String,
    pub(crate) brinell: String,
    /// Of the program that began it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) commit: Option<String>,
    /// What tells it from others.
    pub(crate) campaign: String,
    pub(crate) kernel: Option<String>,
    pub(crate) licence: Option<String>,
    pub(crate) runs: Runs,
    pub(crate) runs_per_file: u64,
    pub(crate) files: Files,
    /// Of the truth of open runs.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) truth: Vec<Facts>,
    pub(crate) splits: Vec<Split>,
    pub(crate) classes: Vec<Class>,
    pub(crate) design: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) histories: Option<Histories>,
    pub(crate) rate: Rate,
    pub(crate) units: String,
    pub(crate) frame: String,
    pub(crate) columns: Vec<ColumnOf>,
    pub(crate) geometry: Geometry,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) held_out: Option<Held>,
    /// Where labels are held out; with plan and seed anybody could make them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) secret: Option<Sources>,
    /// Where they are not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) sources: Option<Sources>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) card: Option<Sum>,
}

/// How many runs there are; and what became of them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub(crate) enum Runs {
    #[default]
    Unknown,
    Planned(u64),
    Made {
        total: u64,
        complete: u64,
        failed: u64,
    },
}

/// How many files there are; and which.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub(crate) enum Files {
    #[default]
    Unknown,
    Planned(usize),
    Made(Vec<Facts>),
}

/// Whether labels are held out; and what they are made from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub(crate) enum Held {
    Planned(bool),
    Made { plan: Sum, meaning: String },
}

impl About {
    /// What made it, as pages say it behind the program's name.
    pub(crate) fn made_by(&self) -> String {
        let commit = self.commit.iter().map(|commit| format!(", commit {commit}"));
        let kernel = self.kernel.iter().map(|kernel| format!(", kernel {kernel}"));
        std::iter::once(self.brinell.clone()).chain(commit).chain(kernel).collect()
    }

    /// Its files, where they are there.
    pub(crate) fn listed(&self) -> &[Facts] {
        match &self.files {
            Files::Made(files) => files,
            _ => &[],
        }
    }

    /// Runs that it has altogether.
    pub(crate) fn total(&self) -> u64 {
        self.splits.iter().map(|split| split.runs).sum()
    }

    /// Split and rows of each file, in order.
    pub(crate) fn rows_of_files(&self) -> Vec<(String, u64)> {
        let each = self.runs_per_file.max(1);
        let of_split = |split: &Split| -> Vec<(String, u64)> {
            let runs = split.runs;
            let rows = match split.rows_of_files.is_empty() {
                true => (0..runs.div_ceil(each)).map(|k| each.min(runs - k * each)).collect(),
                false => split.rows_of_files.clone(),
            };
            rows.into_iter().map(|rows| (split.name.clone(), rows)).collect()
        };
        self.splits.iter().flat_map(of_split).collect()
    }
}

/// What runs are for: how many runs and files, and, where that reveals no label, of each class those that [`Tally`]
/// counts.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Split {
    pub(crate) name: String,
    pub(crate) runs: u64,
    pub(crate) files: usize,
    /// Of machines with histories: rows of each file.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) rows_of_files: Vec<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) runs_of_classes: Option<Vec<u64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) failed: Option<u64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) failed_of_classes: Vec<u64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) clipped_of_classes: Vec<u64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) constant_of_classes: Vec<u64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) warned_of_classes: Vec<u64>,
}

impl Split {
    /// Adds a finished file of it.
    pub(crate) fn add(&mut self, facts: &Facts) {
        *self.failed.get_or_insert(0) += facts.failed.unwrap_or(0);
        let mut tally = self.tally();
        tally.join(facts.tally.as_ref());
        // The plan has the runs.
        Tally {
            failed: self.failed_of_classes,
            clipped: self.clipped_of_classes,
            constant: self.constant_of_classes,
            warned: self.warned_of_classes,
            ..
        } = tally;
    }

    /// What is counted of its runs.
    pub(crate) fn tally(&self) -> Tally {
        Tally {
            runs: self.runs_of_classes.clone().unwrap_or_default(),
            failed: self.failed_of_classes.clone(),
            clipped: self.clipped_of_classes.clone(),
            constant: self.constant_of_classes.clone(),
            warned: self.warned_of_classes.clone(),
        }
    }
}

/// A class with its runs; of a data set with held-out labels with those that are open.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Class {
    pub(crate) name: String,
    pub(crate) label: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) open_runs: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) runs: Option<usize>,
}

/// Machines that run to failure, and what of it is assumed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Histories {
    pub(crate) machines: u64,
    /// Of a machine at most.
    pub(crate) snapshots: u64,
    pub(crate) assumed: String,
}

#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Rate {
    pub(crate) sample_rate_hz: Option<f64>,
    pub(crate) duration_s: Option<f64>,
    pub(crate) meaning: String,
}

/// A column of the files.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct ColumnOf {
    pub(crate) name: String,
    #[serde(rename = "type")]
    pub(crate) kind: String,
    pub(crate) unit: String,
    pub(crate) description: String,
    /// `runs` or `truth`.
    pub(crate) table: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) held_out: Option<bool>,
}

impl ColumnOf {
    pub(crate) fn is_signal(&self) -> bool {
        self.kind == "list<float>"
    }
}

#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Geometry {
    pub(crate) meaning: String,
    pub(crate) keys: Vec<GeometryKey>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct GeometryKey {
    pub(crate) key: String,
    pub(crate) value: Option<String>,
    pub(crate) unit: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) why: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) assumed: Option<bool>,
}

/// What a data set is made from.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Sources {
    pub(crate) plan: String,
    pub(crate) base: String,
    pub(crate) seed: u64,
    pub(crate) to_repeat: String,
    /// Of labels that are held out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) files: Option<Vec<Facts>>,
}

/// A file with its checksum.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Sum {
    pub(crate) path: String,
    pub(crate) sha256: String,
}

/// A finished file of the data set: what is written down of it, and its entry in a description.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Facts {
    /// Of runs in a description alone.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(crate) path: String,
    pub(crate) rows: u64,
    /// Of runs; of labels a description does not say it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) failed: Option<u64>,
    pub(crate) bytes: u64,
    pub(crate) sha256: String,
    /// By class; none where labels are held out, and in a description.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) tally: Option<Tally>,
    /// In a description, of runs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) split: Option<String>,
}

/// The file of runs of a part, and that of their truth; none where it was taken elsewhere before it was written down.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct PartFacts {
    pub(crate) runs: Facts,
    pub(crate) truth: Option<Facts>,
}
