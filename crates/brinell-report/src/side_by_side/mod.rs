//! A comparison of runs as its page shows it. `curves.rs` draws the runs over each other, `headline.rs` says which
//! numbers matter most.

mod content;
mod curves;
mod headline;

pub use content::{beforehand, doubts};
pub use headline::{Headline, compared_headline};
