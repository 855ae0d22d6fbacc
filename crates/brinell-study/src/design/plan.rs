//! A plan: its runs, what varies in them, and how they are divided.

mod history;
mod keys;
mod problems;

use super::history::History;
use super::template::Template;
use brinell::document::reading::Choice;

pub(super) use keys::keys;

/// How runs are spread over what their distributions span.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Design {
    /// Each run for itself.
    #[default]
    Random,
    /// Of the n runs of a class one in each n-th part of every distribution.
    LatinHypercube,
    /// A Sobol sequence for each class.
    Sobol,
}

/// What to do about a run whose values do not make a scenario.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum OutOfRange {
    /// Refuse the plan.
    #[default]
    Refuse,
    /// Draw again until they do: what comes out are the distributions, given that they fit.
    Redraw,
    /// Keep the run as a failed one, with the reason.
    Fail,
}

impl Choice for Design {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        ("random", Self::Random, "each run for itself"),
        ("latin-hypercube", Self::LatinHypercube, "one run of a class in each slice"),
        ("sobol", Self::Sobol, "a Sobol sequence for each class"),
    ];
}

impl Choice for OutOfRange {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        ("refuse", Self::Refuse, "refuse the plan"),
        ("redraw", Self::Redraw, "draw the run again"),
        ("fail", Self::Fail, "keep the run as a failed one"),
    ];
}

impl Design {
    /// As the plan says it.
    pub fn word(self) -> &'static str {
        Choice::word(self)
    }
}

/// Runs of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct Class {
    /// Its label.
    pub name: String,
    /// Its share of the runs, relative to the others'.
    pub share: f64,
    /// Keys that vary in this class.
    pub(super) vary: Template,
    /// The list of defects in place of the base's; `None` leaves those.
    pub(super) defects: Option<Template>,
    /// Of a base that is a machine: which bearing has them, from 1; the others have none.
    pub(super) bearing: Option<usize>,
}

/// How runs whose labels are open are divided for training, validation and test.
#[derive(Debug, Clone, PartialEq)]
pub struct Split {
    /// Share for validation.
    pub validation: f64,
    /// Share for the test.
    pub test: f64,
    /// Keys that make groups: runs that are alike in all of them stay together. `None`: every drawn key of bearing and
    /// operation; empty: each run is a group.
    pub by: Option<Vec<String>>,
    /// Severities that are for the test alone, whatever the group.
    pub severity: Option<HeldSeverity>,
}

/// A range of severities that nothing is trained with.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldSeverity {
    /// Drawn keys; a run has a severity of the range where any of them has.
    pub keys: Vec<String>,
    /// Least and largest, both of them in the range; in the keys' unit.
    pub range: [f64; 2],
}

/// A campaign of runs, as its file says it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Plan {
    /// Name of the data set.
    pub name: String,
    /// File of the base scenario, from the plan's folder.
    pub base: String,
    /// How many runs; with histories machines times snapshots, which is the most that there can be.
    pub runs: usize,
    /// Machines that each have a history, where runs are snapshots of machines.
    pub history: Option<History>,
    /// Which ones: another seed draws others.
    pub seed: u64,
    /// How they are spread.
    pub design: Design,
    /// What to do about values that do not fit.
    pub out_of_range: OutOfRange,
    /// Rows of a Parquet file.
    pub runs_per_file: usize,
    /// Under which terms the data may be used, in the author's words; an SPDX identifier is best.
    pub licence: String,
    /// Share of the runs whose labels lie apart.
    pub held_out: f64,
    /// What decides which runs these are and everything that they draw: hexadecimal digits drawn at random; empty where
    /// nothing is held out.
    pub secret: String,
    /// How the runs whose labels are open are divided; `None`: not at all.
    pub split: Option<Split>,
    /// Channels to keep, as `simulation.record` names them.
    pub signals: Vec<String>,
    /// Keys that vary in every class.
    pub(super) vary: Template,
    /// The classes; never empty.
    pub classes: Vec<Class>,
}

impl HeldSeverity {
    /// Whether any of a run's values lies in the range.
    pub(super) fn holds(&self, values: &[f64]) -> bool {
        let [low, high] = self.range;
        values.iter().any(|x| (low..=high).contains(x))
    }
}

impl Plan {
    /// Whether labels are held out.
    pub fn holds_out(&self) -> bool {
        self.held_out > 0.0
    }

    /// What draws its class and is for training or for the test as a whole: a run, or a machine with all its snapshots.
    pub(super) fn units(&self) -> usize {
        self.history.as_ref().map_or(self.runs, |history| history.machines)
    }

    /// What one such is called.
    pub(super) fn unit(&self) -> &'static str {
        if self.history.is_some() { "machine" } else { "run" }
    }

    fn templates(&self) -> impl Iterator<Item = (String, &Template)> {
        let classes = self.classes.iter().enumerate();
        let own = classes.map(|(k, class)| (format!("classes.{k}.vary"), &class.vary));
        let snapshot = self.history.iter().map(|history| ("history.snapshot".to_owned(), &history.snapshot));
        std::iter::once(("vary".to_owned(), &self.vary)).chain(own).chain(snapshot)
    }
}
