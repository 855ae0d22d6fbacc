//! The verdict on a run, beside the same bearing without its damage.

use crate::result::record;
use crate::scenario::Scenario;
use brinell_signal::analysis::{Analysis, Component, analyze};

/// A run's own signal.
#[derive(Clone, Copy, Debug)]
pub struct Stretch<'a> {
    /// Its channel.
    pub channel: &'a str,
    /// Where it begins in the run, s.
    pub from_s: f64,
    /// Factor from its unit to the channel's.
    pub to_si: f64,
}

/// Judges the outer race again where damage of it was called: the scenario is run without its damage, which takes as
/// long as the run did, and what passing rollers show there is no damage ([`Analysis::beside_healthy_run`]). Without
/// damage in the scenario nothing is run. Where the healthy bearing does not run, or has no such channel, the verdict
/// stays as it is.
pub fn beside_healthy(analysis: &mut Analysis, scenario: &Scenario, stretch: Stretch<'_>) {
    if !analysis.causes().any(|f| f.component == Component::OuterRace) {
        return;
    }
    if scenario.bearings().iter().all(|bearing| bearing.defects.is_empty()) {
        analysis.beside_healthy_run(None);
    } else if let Some(healthy) = healthy(analysis, scenario, stretch) {
        analysis.beside_healthy_run(Some(&healthy));
    }
}

/// The same stretch of the healthy bearing's run, analysed alike.
fn healthy(analysis: &Analysis, scenario: &Scenario, stretch: Stretch<'_>) -> Option<Analysis> {
    let mut healthy = scenario.without_damage();
    healthy.simulation.record = vec![stretch.channel.to_owned()];
    let first = (stretch.from_s * analysis.sample_rate).round() as usize;
    let end = first + analysis.samples;
    let duration = &mut healthy.simulation.duration_s;
    *duration = duration.min((end + 1) as f64 / analysis.sample_rate);
    let (_, signals) = record(&healthy).ok().filter(|(_, s)| s.rate_hz() == analysis.sample_rate)?;
    let y = signals.get(stretch.channel)?.get(first..end)?;
    let y: Vec<f64> = y.iter().map(|v| v / stretch.to_si).collect();
    analyze(&y, analysis.sample_rate, &analysis.options).ok()
}
