//! The experiments of Li et al. (2023), section 4, and what its text says of them, as data; and how a sentence is held against numbers.
//! Knows no files and runs nothing.
//!
//! [`CASES`] are the scenarios, [`EXPERIMENTS`] group them by figure, [`claims`] are the sentences. [`Numbers`] holds what the cases gave,
//! and [`judge`] decides a claim from them by the rules of [`verdict`]. [`VARIANTS`] change one unstated assumption each; [`RANGES`] span what
//! [`draw`] makes whole sets of assumptions of, and [`distance`] says how far such a set stays from the paper's figures.

mod assumptions;
mod cases;
mod claims;
mod judge;
mod numbers;
mod search;
pub mod verdict;

pub use assumptions::{Aspect, RANGES, Range, VARIANTS, Values, Variant};
pub use cases::{BASE, CASES, Case, EXPERIMENTS, Experiment, FIGURES, Length, case};
pub use claims::claims;
pub use judge::{Check, Claim, Found, Judged, Statement, judge};
pub use numbers::{Number, Numbers, entry_drop};
pub use search::{Distance, Draw, SEARCHED, answers, axes, distance, draw, held, targets};
pub use verdict::Verdict;
