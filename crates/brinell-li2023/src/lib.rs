//! The experiments of Li et al. (2023), section 4, and what its text says of them, as data; and how a sentence is held against numbers.
//!
//! [`CASES`] are the scenarios, [`STARTS`] the same looked at from t = 0, [`EXPERIMENTS`] group them by figure, [`claims`] are the sentences.
//! [`Numbers`] holds what the cases gave, [`FromStart`] what they need beside a run's findings, and [`judge`] decides a claim by the rules of
//! [`verdict`]. [`VARIANTS`] change one unstated assumption each; [`RANGES`] span what [`draw`] makes whole sets of assumptions of, and
//! [`distance`] says how far such a set stays from the paper's figures.
//!
//! A [`Request`] knows the [`Point`]s to be run, [`Runs`] makes them, and a [`Reproduction`] is what came out: outcomes of the claims, page,
//! tables, and the book's chapter.

#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]

mod believe;
mod book;
mod cases;
mod claim;
mod curve_files;
mod curve_kind;
mod curves;
mod error;
mod figures;
mod judge;
mod numbers;
mod outcome;
mod outline;
mod page;
mod points;
mod ranges;
mod reading;
mod record;
mod reproduction;
mod runs;
mod search;
mod sensitivity;
mod variants;
pub mod verdict;

pub use cases::{
    BASE, CASES, Case, EXPERIMENTS, Experiment, FIGURES, Length, STARTS, case, length_of,
};
pub use claim::{Basis, Check, Claim, Otherwise, Statement, claims};
pub use curve_files::{CaseObserver, CurveFiles};
pub use error::Error;
pub use judge::{Decided, Found, Judged, judge};
pub use numbers::{Number, Numbers, entry_drop};
pub use outcome::Outcome;
pub use outline::Outline;
pub use points::{Point, scenario};
pub use ranges::{RANGES, READ_AS, RECORDS, Range, Values};
pub use reading::{Reading, Record, WINDOWS_MS};
pub use record::FromStart;
pub use reproduction::{Reproduction, Request, write_page};
pub use runs::{Runs, Stage};
pub use search::{Distance, Draw, RMS, SEARCHED, answers, axes, distance, draw, held, targets};
pub use variants::{Aspect, VARIANTS, Variant};
pub use verdict::Verdict;

/// A file of data of this crate.
fn data<T: serde::Deserialize<'static>>(name: &str, text: &'static str) -> T {
    toml::from_str(text).unwrap_or_else(|fault| panic!("{name}: {fault}"))
}
