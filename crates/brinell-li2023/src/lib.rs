//! The experiments of Li et al. (2023), section 4, and what its text says of them, as data; and how a sentence is held against numbers.
//!
//! [`CASES`] are the scenarios, [`STARTS`] the same looked at from t = 0, [`EXPERIMENTS`] group them by figure, [`claims`] are the sentences.
//! [`Numbers`] holds what the cases gave, [`FromStart`] what they need beside a run's findings, and [`judge`] decides a claim by the rules of
//! [`verdict`]. [`VARIANTS`] change one unstated assumption each; [`RANGES`] span what [`draw`] makes whole sets of assumptions of, and
//! [`distance`] says how far such a set stays from the paper's figures.

mod cases;
mod claim;
mod claims;
mod judge;
mod numbers;
mod outline;
mod ranges;
mod reading;
mod record;
mod search;
mod variants;
pub mod verdict;

pub use cases::{
    BASE, CASES, Case, EXPERIMENTS, Experiment, FIGURES, Length, STARTS, case, length_of,
};
pub use claim::{Basis, Check, Claim, Otherwise, Statement};
pub use claims::claims;
pub use judge::{Decided, Found, Judged, judge};
pub use numbers::{Number, Numbers, entry_drop};
pub use outline::Outline;
pub use ranges::{RANGES, READ_AS, RECORDS, Range, Values};
pub use reading::{Reading, Record, WINDOWS_MS};
pub use record::FromStart;
pub use search::{Distance, Draw, RMS, SEARCHED, answers, axes, distance, draw, held, targets};
pub use variants::{Aspect, VARIANTS, Variant};
pub use verdict::Verdict;
