//! The customer's report: two pages of A4 about one machine, for readers who are no analysts; as HTML and as PDF.
//!
//! The pages are laid out once, as pictures ([`pages`]), which both files hold: the text of one is that of the other.

mod content;
mod document;
mod flow;
mod kind;
mod pages;
mod words;

use crate::analysis::AnalysisReport;
use crate::data::Tone;
use crate::tables::Table;
use brinell::analysis::{Component, Verdict, Zone};
pub use content::JudgedOf;
pub use document::GENERATOR;
pub use kind::DamageKind;

/// What stands above the report, as it was given; empty where it was not.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Heading {
    /// Its title.
    pub title: String,
    /// The machine.
    pub machine: String,
    /// The measuring point.
    pub point: String,
    /// When the record was taken, and how that is known.
    pub date: String,
    /// Who wrote it.
    pub author: String,
    /// What the author adds; may be empty.
    pub remark: String,
    /// The kind of damage that somebody has seen.
    pub kind: Option<DamageKind>,
}

/// The vibration of the machine as a whole.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Whole {
    /// RMS velocity, mm/s.
    pub velocity: Option<f64>,
    /// Its zone of ISO 20816-3.
    pub zone: Option<Zone>,
    /// Both in a sentence, or why they are not known.
    pub words: String,
}

/// One signal and what is found in it, without its samples.
#[derive(Clone, Debug)]
pub struct Judged {
    /// The channel's name.
    pub channel: String,
    /// Whether a simulation made it, and no machine was measured.
    pub simulated: bool,
    /// The bearing's name, or where its frequencies come from.
    pub bearing: String,
    /// Of each bearing that was asked about its name, and what is found of it in a word or two.
    pub bearings: Vec<(String, String)>,
    /// The shaft's speed and where it comes from.
    pub speed: String,
    /// What it amounts to.
    pub verdict: Verdict,
    /// How much the evidence of the damage that leads says: `very clear`, `clear`, `weak`.
    pub clarity: &'static str,
    /// Why it is not very clear, as the end of a sentence, where there is damage and it is not.
    pub less_than_very_clear: Option<&'static str>,
    /// Whether a record of the speed or the shaft's own lines confirm it.
    pub speed_is_confirmed: bool,
    /// The damaged parts, the one that leads first.
    pub parts: Vec<Component>,
    /// Score of that, by which signals are compared.
    pub score: Option<f64>,
    /// What the verdict rests on, or what is open, in a sentence.
    pub reason: String,
    /// The machine as a whole, by this signal.
    pub whole: Whole,
    /// Whether the record is as long and as finely sampled as is asked for: sixty turns of the shaft, 10 kHz.
    pub is_ample: bool,
    /// What tells how bad the damage itself is: sentences that begin with a word and a colon.
    pub severity: Vec<String>,
    /// What is found at each defect frequency.
    pub evidence: Table,
    /// Levels with their intervals.
    pub levels: Table,
    /// How it was done, in three sentences.
    pub method: String,
    /// Where it comes from: label and words.
    pub provenance: Vec<(String, String)>,
    /// The verdict in the program's words, the curves, and what deserves attention.
    pub report: AnalysisReport,
}

/// A signal without a result: its name, and why.
pub type NotJudged = (String, String);

/// The customer's report.
#[derive(Clone, Debug)]
pub struct CustomerReport {
    /// What stands above it.
    pub heading: Heading,
    /// The signal that leads.
    pub lead: Judged,
    /// The machine as a whole, by the signal in which it vibrates most.
    pub whole: Whole,
    /// Of several signals or bearings a row each.
    pub all: Table,
    /// The version of the program.
    pub version: String,
}

impl Judged {
    /// Whether no bearing was given: then there is no frequency to show evidence at.
    pub(crate) fn has_no_bearing(&self) -> bool {
        self.evidence.rows.is_empty()
    }

    /// Good, bad or neither.
    pub(crate) fn tone(&self) -> Tone {
        match self.verdict {
            Verdict::Damage if self.clarity == "weak" => Tone::Open,
            Verdict::Damage => Tone::Bad,
            Verdict::CannotTell => Tone::Open,
            Verdict::NothingFound => Tone::Good,
        }
    }
}
