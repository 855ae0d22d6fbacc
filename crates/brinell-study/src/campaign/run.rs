//! Scenarios from start to findings, side by side.

use brinell::many;
use brinell::simulate::Progress;
use brinell::{Error, RunResult, Scenario, simulate_with};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;

/// Runs scenarios side by side, up to `threads` at a time; each result in the place of its scenario. `progress` gets
/// which scenario has reached which time, s, from the thread that runs it. Results are those of each run alone, bit for
/// bit, and all are held until the last is there.
pub fn run_all(
    scenarios: &[Scenario],
    threads: NonZeroUsize,
    progress: impl Fn(usize, f64) -> ControlFlow<()> + Sync,
) -> Vec<Result<RunResult, Error>> {
    many::map(scenarios.len(), threads, |k| simulate_with(&scenarios[k], &mut Progress(|t| progress(k, t))))
}
