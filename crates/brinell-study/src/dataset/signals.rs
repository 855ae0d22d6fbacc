//! Which signals the runs of a plan have: each in one unit.

use crate::design::Draws;
use brinell::channel::{Channel, matches, sensor_channels};
use brinell::scenario::Scenario;
use brinell_io::Column;

/// Runs whose sensor is looked at, where the plan draws of it.
const LOOKED: usize = 1000;
/// Where the sensor's own channel points, where that differs between runs.
const ALONG_ITS_OWN: &str = "acceleration that the sensor reads along sensor.direction_deg after the anti-alias filter";
/// Between what one and what another run says of a channel.
const ELSE: &str = "; in some runs ";

/// Channels of runs, and which run had each first.
#[derive(Default)]
pub(crate) struct Signals {
    pub(crate) columns: Vec<Column>,
    /// Of each column: the run.
    first: Vec<usize>,
    /// The first channel that is in two units, and why that cannot be.
    pub(crate) clash: Option<(String, String)>,
}

impl Signals {
    /// Adds the channels of a run.
    pub(crate) fn take<'a>(&mut self, channels: impl Iterator<Item = &'a Channel>, draws: &Draws, run: usize) {
        for channel in channels {
            let Some(k) = self.columns.iter().position(|c| c.name == channel.name) else {
                self.columns.push(Column::new(&channel.name, channel.unit, &channel.description));
                self.first.push(run);
                continue;
            };
            let column = &mut self.columns[k];
            if column.unit != channel.unit && self.clash.is_none() {
                let of = |run: usize| format!("run {run} (class {:?})", draws.plan().classes[draws.class(run)].name);
                let why = format!(
                    "in {} in {} and in {} in {}: a column has one unit; give sensor.sensitivity_mv_per_m_per_s2 in all runs or in none",
                    column.unit,
                    of(self.first[k]),
                    channel.unit,
                    of(run)
                );
                self.clash = Some((channel.name.clone(), why));
            }
            column.description = of_both(&column.name, &column.description, &channel.description);
        }
    }

    /// Adds the sensor's channels of further runs, where the plan draws of the sensor. No static balance is needed for
    /// that.
    pub(crate) fn take_sensors(&mut self, draws: &Draws, base: &str) {
        let is_sensor = |key: &str| key == "sensor" || key.starts_with("sensor.");
        if !draws.parameters().iter().any(|p| is_sensor(&p.key)) {
            return;
        }
        for run in 0..LOOKED.min(draws.runs()) {
            if let Ok((loaded, _)) = draws.scenario(base, run) {
                let channels = recorded(&loaded.scenario);
                self.take(channels.iter(), draws, run);
            }
        }
    }
}

/// The sensor's channels that a scenario records.
fn recorded(scenario: &Scenario) -> Vec<Channel> {
    let mut channels = sensor_channels(&scenario.sensor);
    channels.retain(|c| scenario.simulation.record.iter().any(|pattern| matches(pattern, &c.name)));
    channels
}

/// What holds of a channel in both of two runs.
fn of_both(name: &str, known: &str, other: &str) -> String {
    if known == other || known == ALONG_ITS_OWN || known.contains(ELSE) {
        return known.into();
    }
    match name {
        "sensor_out" => ALONG_ITS_OWN.into(),
        _ => format!("{known}{ELSE}{other}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_what_differs_between_runs_is_not_said_of_one() {
        let degrees =
            |x: &str| format!("acceleration that the sensor reads along {x} degrees after the anti-alias filter");
        assert_eq!(of_both("sensor_out", &degrees("45"), &degrees("45")), degrees("45"));
        assert_eq!(of_both("sensor_out", &degrees("45"), &degrees("90")), ALONG_ITS_OWN);
        assert_eq!(of_both("sensor_out", ALONG_ITS_OWN, &degrees("90")), ALONG_ITS_OWN);
        let both = of_both("sensor_ax", "of the ring", "of the sensor");
        assert_eq!(both, "of the ring; in some runs of the sensor");
        assert_eq!(of_both("sensor_ax", &both, "of the sensor"), both);
    }
}
