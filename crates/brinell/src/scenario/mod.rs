//! Scenario files: one TOML file is the whole truth of a run.

mod types;

pub use types::*;
