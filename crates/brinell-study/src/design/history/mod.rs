//! Histories of a plan: damage that begins and grows over a machine's life, in snapshots.
//!
//! A [`History`] is the plan's `[history]`; a [`Snapshot`] is what a machine is at one time of its life, and
//! [`grown`](Snapshot::grown) the damage that it then has. The law of growth is an assumption: nothing here predicts.

mod grown;
mod law;
mod outline;
mod snapshot;
mod varied;

use super::distribution::Distribution;
use super::template::Template;
use brinell::document::reading::Choice;

pub(super) use grown::{Turning, only_defect};
pub use law::Law;
pub use outline::Edge;
pub use snapshot::{Snapshot, State};
pub(super) use snapshot::{is_to_the_end, times};
pub use varied::Varied;
pub(super) use varied::short;

/// `[history]` of a plan, with how many machines there are.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    /// How many.
    pub machines: usize,
    /// Snapshots of each, at most.
    pub snapshots: usize,
    /// Running time between snapshots, h.
    pub every_h: Varied,
    /// How the length grows.
    pub law: Law,
    /// The law's one parameter.
    pub steepness: Varied,
    /// Length at which damage begins, mm.
    pub begins_mm: Varied,
    /// Length at which the machine counts as failed, mm.
    pub fails_mm: Varied,
    /// Running time until then, h.
    pub life_h: Varied,
    /// Share of the life at which damage begins.
    pub begins_at: Varied,
    /// Share of the life at which the machine is seen for the last time.
    pub observed: Varied,
    /// Standard deviation of the logarithm of the increments.
    pub scatter: f64,
    /// Which edge moves.
    pub edge: Edge,
    /// Power of the length that the depth follows.
    pub depth_exponent: f64,
    /// Most width, mm; `None`: as far as rolling elements reach.
    pub widest_mm: Option<f64>,
    /// Keys that are drawn anew at each snapshot.
    pub(super) snapshot: Template,
}

impl History {
    /// What is drawn once for each machine: key and what it is drawn from.
    pub(super) fn drawn(&self) -> [(&'static str, &Varied); 7] {
        [
            ("history.every_h", &self.every_h),
            ("history.begins_mm", &self.begins_mm),
            ("history.fails_mm", &self.fails_mm),
            ("history.life_h", &self.life_h),
            ("history.begins_at", &self.begins_at),
            ("history.observed", &self.observed),
            (self.law.parameter(), &self.steepness),
        ]
    }

    /// Distributions of a machine's life, by key.
    pub(super) fn distributions<'a>(&'a self, all: &mut Vec<(String, &'a Distribution)>) {
        for (key, value) in self.drawn() {
            if let Varied::Drawn(distribution) = value {
                all.push((key.to_owned(), distribution));
            }
        }
    }

    /// What the data set's card says is assumed.
    pub fn assumptions(&self) -> String {
        let cap = self.widest_mm.map_or("as far as rolling elements reach".to_owned(), |mm| format!("up to {mm} mm"));
        format!(
            "a snapshot every {} h; {} of the running time with {} = {}, from {} mm, where damage begins (at a share of {} of the life), to {} mm, at which a machine counts \
             as failed; life until then {} h; scatter {} (standard deviation of the logarithm of its increments); {}; the width follows in proportion {cap}, \
             the depth as the length to the power {}; observed until a share of {} of the life",
            self.every_h,
            self.law.words(),
            self.law.parameter(),
            self.steepness,
            self.begins_mm,
            self.begins_at,
            self.fails_mm,
            self.life_h,
            self.scatter,
            self.edge.words(),
            self.depth_exponent,
            self.observed
        )
    }

    /// What the author of a plan should know.
    pub(super) fn notes(&self, holds_out: bool) -> Vec<String> {
        let mut notes = Vec::new();
        if self.scatter == 0.0 && self.machines > 1 {
            notes.push(format!(
                "history.scatter = 0: the lengths of all {} machines follow the law to the last digit, so that a few of them tell the remaining life exactly; \
                 history.scatter = 0.5 makes increments that differ by a factor of 1.6",
                self.machines
            ));
        }
        if holds_out && self.observed == Varied::Fixed(1.0) {
            notes.push(
                "history.observed = 1 with held_out: the last row of a machine that is run to failure has its life as time_h, which tells the remaining life at \
                 the rows before; history.observed = { uniform = [0.3, 1] } ends most machines' rows before, and fewer `snapshots` end them \
                 at a time that has nothing to do with the life"
                    .to_owned(),
            );
        }
        notes
    }
}

impl Edge {
    fn words(self) -> &'static str {
        match self {
            Self::Trailing => "the edge that rolling elements meet first stays, the trailing one moves",
            Self::Leading => "the trailing edge stays, the one that rolling elements meet first moves",
            Self::Both => "both edges move",
        }
    }
}

impl Choice for Edge {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        ("trailing", Self::Trailing, "the one that rolling elements leave"),
        ("leading", Self::Leading, "the one that they meet first"),
        ("both", Self::Both, "both, about the shape's middle"),
    ];
}
