//! A run with all that is said of it: what every teller of results, file, page and terminal, is given.

use crate::document::Loaded;
use crate::observe::{ChannelStatistics, Findings, Kind};
use crate::plausibility::{Beforehand, after};
use crate::signal::Estimate;
use crate::signal::ratio::Ratio;
use crate::simulate::{Outcome, Simulation};

/// A run, before and after.
#[derive(Debug, Clone, Copy)]
pub struct Parts<'a> {
    /// Scenario with provenance and warnings.
    pub loaded: &'a Loaded,
    /// The run as prepared.
    pub simulation: &'a Simulation,
    /// Its outcome.
    pub outcome: &'a Outcome,
    /// What was gathered.
    pub findings: &'a Findings,
    /// What was known before: the static load distribution, and warnings.
    pub beforehand: &'a Beforehand,
    /// What was gathered of the same bearing without its damage, where that was run too.
    pub healthy: Option<&'a Findings>,
}

impl Parts<'_> {
    /// What the reader of the run should know, warnings of the scenario first.
    pub fn warnings(&self) -> Vec<String> {
        let Parts { loaded, simulation, outcome, findings, beforehand, .. } = *self;
        let before = loaded.warnings.iter().chain(&beforehand.warnings);
        before.map(ToString::to_string).chain(after(&loaded.scenario, simulation, outcome, findings)).collect()
    }

    /// What the sensor reads, by axis, in the order of the channels.
    pub fn read(&self) -> impl Iterator<Item = &ChannelStatistics> {
        self.findings.channels.iter().filter(|channel| {
            let is_read = self.simulation.is_sensor(&channel.name) || channel.name == self.findings.sensor;
            is_read && channel.kind == Kind::AntiAliased
        })
    }

    /// RMS of an anti-aliased channel without the damage, in its unit, and how many times that it is with it; last why, where it is less:
    /// empty, or after a colon. Else a reader looks for a mistake.
    pub fn beside_healthy(&self, channel: &str) -> Option<(Estimate, Ratio, &'static str)> {
        let healthy = self.healthy?;
        let (rms, ratio) = (healthy.rms_of(channel)?, self.findings.over_healthy_of(healthy, channel)?);
        let why =
            if ratio.value < 1.0 { ": here the load that passes from roller to roller counts for more" } else { "" };
        Some((rms, ratio, why))
    }
}
