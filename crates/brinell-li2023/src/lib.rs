//! The experiments of Li et al. (2023), section 4, and what its text says of them, as data; and how a sentence is
//! compared with numbers.
//!
//! A [`Request`] knows the [`Point`]s to be run, [`Runs`] makes them, and a [`Reproduction`] is what came out: outcomes
//! of the claims, page, tables, and the book's chapter.

#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]

mod believe;
mod beside;
mod book;
mod cases;
mod claim;
mod curve_files;
mod curve_kind;
mod curves;
mod error;
mod figures;
mod judge;
mod models;
mod numbers;
mod outcome;
mod outline;
mod page;
mod points;
mod ranges;
mod reading;
mod record;
mod recorded;
mod reproduction;
mod request;
mod runs;
mod search;
mod sensitivity;
mod survives;
mod variants;
mod verdict;
mod written;

pub use cases::BASE;
#[doc(hidden)]
pub use cases::{FIGURES, Length};
#[doc(hidden)]
pub use curve_files::{CaseObserver, CurveFiles};
pub use error::Error;
pub use points::{Point, scenario};
pub use reproduction::Reproduction;
pub use request::Request;
pub use runs::{Runs, Stage};
pub use written::write_page;

pub(crate) use cases::{CASES, Case, EXPERIMENTS, Experiment, case, length_of};
pub(crate) use claim::{Basis, Claim, claims};
pub(crate) use judge::{Found, Judged, judge};
pub(crate) use numbers::{Numbers, entry_drop};
pub(crate) use outline::Outline;
pub(crate) use ranges::{RANGES, READ_AS, RECORDS, Values};
pub(crate) use reading::{Reading, Record};
pub(crate) use record::FromStart;
pub(crate) use search::{Distance, Draw, FREQUENCY, RMS, SEARCHED, answers, axes, distance, draw, held, targets};
pub(crate) use variants::{VARIANTS, Variant};
pub(crate) use verdict::Verdict;

/// A file of data of this crate.
fn data<T: serde::Deserialize<'static>>(name: &str, text: &'static str) -> T {
    toml::from_str(text).unwrap_or_else(|fault| panic!("{name}: {fault}"))
}
