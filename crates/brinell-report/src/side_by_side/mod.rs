//! A comparison of runs as its page shows it. `curves.rs` draws the runs over each other.

mod content;
mod curves;

pub use content::{beforehand, compared_headline, doubts};
