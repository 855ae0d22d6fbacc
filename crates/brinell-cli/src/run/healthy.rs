//! The same scenario without its damage, run beside it: what the page draws in grey.

use crate::args::RunArgs;
use brinell::many::go_on;
use brinell::observe::Findings;
use brinell::result::{RunResult, simulate_with};
use brinell::scenario::Scenario;
use brinell::simulate::{End, Progress};
use std::sync::atomic::AtomicBool;

/// Runs `damaged`, and the healthy bearing on another thread, where there is damage and somewhere to show it. It is
/// dropped where either did not come to its end.
pub(super) fn beside(
    args: &RunArgs,
    scenario: &Scenario,
    stop: &AtomicBool,
    damaged: impl FnOnce() -> RunResult,
) -> (RunResult, Option<Findings>) {
    let shown = !args.no_report || !args.plots.is_empty() || args.json;
    if scenario.defects.is_empty() || args.no_healthy || !shown {
        return (damaged(), None);
    }
    let mut healthy = scenario.without_damage();
    // Nothing but what the sensor reads is kept of it.
    healthy.simulation.record.clear();
    std::thread::scope(|scope| {
        let healthy = scope.spawn(|| simulate_with(&healthy, &mut Progress(|_| go_on(stop))).ok());
        let damaged = damaged();
        let healthy = healthy.join().ok().flatten();
        let whole = damaged.outcome.end == End::Complete;
        (damaged, healthy.filter(|_| whole).map(|run| run.findings))
    })
}
