//! Scenarios from start to findings, side by side.

use crate::listener::Listener;
use brinell::many;
use brinell::simulate::Progress;
use brinell::{Error, RunResult, Scenario, simulate_with};
use std::num::NonZeroUsize;

/// Runs scenarios side by side, up to `threads` at a time; each result in the place of its scenario. `listener` hears
/// of each as it begins. Results are those of each run alone, bit for bit, and all are held until the last is there.
pub fn run_all(
    scenarios: &[Scenario],
    threads: NonZeroUsize,
    listener: &dyn Listener,
) -> Vec<Result<RunResult, Error>> {
    many::map(scenarios.len(), threads, |k| {
        let hearer = listener.begin(k, scenarios[k].simulation.duration_s);
        simulate_with(&scenarios[k], &mut Progress(hearer))
    })
}
