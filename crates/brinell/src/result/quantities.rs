//! A run as named numbers: every indicator of every channel with its interval, defect lines, contact, slip, audits and
//! work.
//!
//! Names are channel and indicator, `sensor_ax.rms`; SI units. A channel's values are instantaneous; what passed the
//! anti-alias filter, and does not say so in its name as `sensor_*` does, is `outer_ax.anti_aliased.rms`. A scenario
//! fixes the list of names; what a run does not have (slip in the lumped model, a defect's frequency in a short run) is
//! there without a value. No wall time is among them: the same scenario gives the same numbers.

use super::fields::{
    ANALYSED, ANALYSED_TURNS, AUDITS, COURSE, DEFECT, ENTRY_PEAK, EXIT_PEAK, Field, FoundDefect, LINES, LOAD, SLIP,
    WORK, exact, indicator, record,
};
use super::impacts::impacts;
use crate::channel::unit_of_machine;
use crate::did_you_mean::did_you_mean;
use crate::observe::{Findings, Kind};
use crate::scenario::Scenario;
use crate::signal::spectrum::{Peak, peak_near};
use crate::signal::{Estimate, Indicator, Interval, LineSearch};
use crate::simulate::{Outcome, Simulation};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// One number of a run. Files have it by its name, as `{"unit", "value", "low", "high", "freedom"}`: `low` and `high` are the ends of its 95 %
/// interval, null where the run is too short to tell, and not there where the number never has one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Quantity {
    /// What it is: `sensor_ax.rms`.
    #[serde(skip)]
    pub name: String,
    /// SI unit; 1 where it has none.
    pub unit: String,
    /// The value; `None` where there is none, and never infinite or not a number.
    pub value: Option<f64>,
    /// What is known of its scatter.
    #[serde(flatten)]
    pub spread: Spread,
}

/// Whether a number comes with an interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(from = "Ends", into = "Ends")]
pub enum Spread {
    /// It never does: a count, an extreme.
    Without,
    /// It does, but not in this run: it is too short to tell.
    Unknown,
    /// 95 % interval of the same quantity; the value lies within it.
    Interval(Interval),
}

/// [`Spread`] in a file.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
enum Ends {
    Known(Interval),
    Unknown { low: (), high: () },
    Without {},
}

impl From<Ends> for Spread {
    fn from(ends: Ends) -> Self {
        match ends {
            Ends::Known(interval) => Spread::Interval(interval),
            Ends::Unknown { .. } => Spread::Unknown,
            Ends::Without {} => Spread::Without,
        }
    }
}

impl From<Spread> for Ends {
    fn from(spread: Spread) -> Self {
        match spread {
            Spread::Interval(interval) => Ends::Known(interval),
            Spread::Unknown => Ends::Unknown { low: (), high: () },
            Spread::Without => Ends::Without {},
        }
    }
}

impl Quantity {
    /// Value and interval; `None` without a value.
    pub fn estimate(&self) -> Option<Estimate> {
        let interval = match self.spread {
            Spread::Interval(interval) => Some(interval),
            Spread::Without | Spread::Unknown => None,
        };
        self.value.map(|value| Estimate { value, interval })
    }

    /// Ends of the interval, where there is one.
    pub fn interval(&self) -> Option<(f64, f64)> {
        let interval = self.estimate()?.interval?;
        Some((interval.low, interval.high))
    }
}

impl<F> Field<F> {
    /// The number of `subject` (a channel, a defect, a row; empty for the run's own), as estimated.
    fn quantity(&self, subject: &str, estimate: Option<Estimate>) -> Quantity {
        let interval = estimate.and_then(|e| e.interval);
        Quantity {
            name: match subject {
                "" => self.name.to_owned(),
                subject => format!("{subject}.{}", self.name),
            },
            unit: self.unit.to_owned(),
            value: estimate.map(|e| e.value).filter(|x| x.is_finite()),
            spread: match self.estimator.has_interval() {
                true => interval.map_or(Spread::Unknown, Spread::Interval),
                false => Spread::Without,
            },
        }
    }
}

/// Numbers by name, as files have them.
pub fn by_name(quantities: &[Quantity]) -> Map<String, Value> {
    let one = |q: &Quantity| (q.name.clone(), serde_json::to_value(q).unwrap_or_default());
    quantities.iter().map(one).collect()
}

/// What [`by_name`] gave; `None` where it is not that.
pub fn named(written: &Map<String, Value>) -> Option<Vec<Quantity>> {
    let one = |(name, number): (&String, &Value)| {
        Some(Quantity { name: name.clone(), ..Quantity::deserialize(number).ok()? })
    };
    written.iter().map(one).collect()
}

/// Every number that is reported of a run, in a fixed order.
pub fn quantities(
    scenario: &Scenario,
    simulation: &Simulation,
    outcome: &Outcome,
    findings: &Findings,
) -> Vec<Quantity> {
    let mut all = Vec::new();
    indicators(findings, &mut all);
    lines(scenario, simulation, findings, &mut all);
    defects(simulation, findings, &mut all);
    rows(findings, &mut all);
    let audit = |f: &Field<fn(&Outcome) -> _>| f.quantity("audit", exact((f.of)(outcome)));
    all.extend(AUDITS.iter().map(audit));
    let work = |f: &Field<fn(&Outcome) -> u64>| f.quantity("work", exact(Some((f.of)(outcome) as f64)));
    all.extend(WORK.iter().map(work));
    // The turns stand with the averages.
    all.extend(ANALYSED.iter().filter(|f| f.name != ANALYSED_TURNS.name).map(|f| analysed(f, findings)));
    all.extend(COURSE.iter().map(|f| f.quantity("", exact((f.of)(outcome)))));
    all
}

fn analysed(field: &Field<fn(&Findings) -> f64>, findings: &Findings) -> Quantity {
    field.quantity("", exact(Some((field.of)(findings))))
}

fn of_kind(channel: &str, kind: Kind) -> String {
    let filtered = match kind {
        Kind::AntiAliased if !is_of_sensor(channel) => ".anti_aliased",
        _ => "",
    };
    format!("{channel}{filtered}")
}

fn indicators(findings: &Findings, all: &mut Vec<Quantity>) {
    for channel in &findings.channels {
        let of = of_kind(&channel.name, channel.kind);
        all.extend(Indicator::ALL.map(|i| indicator(i, channel.unit).quantity(&of, channel.blocks.estimate(i))));
    }
    for channel in &findings.channels {
        let of = of_kind(&channel.name, channel.kind);
        let values = channel.blocks.record();
        all.extend(record(channel.unit).map(|f| f.quantity(&of, exact(values.get(f.of)))));
    }
    all.push(analysed(&ANALYSED_TURNS, findings));
}

/// Levels of the envelope spectrum at the defect frequencies of the cage's mean slip and their harmonics, within the share
/// that [`LineSearch`] looks in. Where these shares overlap, as those of BPFO and 2 BSF of a slender bearing do, a line
/// counts for the frequency that it is nearest to.
fn lines(scenario: &Scenario, simulation: &Simulation, findings: &Findings, all: &mut Vec<Quantity>) {
    let model = simulation.model();
    let constant = scenario.operation.speed_rpm.constant().is_some();
    let slips: Vec<f64> = findings.slip.rows.iter().filter_map(|row| Some(row.cage()?.value)).collect();
    let slip = slips.iter().sum::<f64>() / slips.len().max(1) as f64;
    let k = model.kinematics(model.rotation.at(0.0).0).with_cage_slip(slip);
    let found = LINES.iter().map(|line| {
        let (frequency, n) = ((line.of.0)(&k), line.of.1);
        let at = frequency * f64::from(n);
        let envelope = findings.envelope.as_ref().filter(|_| constant && at > 0.0);
        let peak = envelope.and_then(|(e, _)| {
            let tolerance = LineSearch::new(frequency).tolerance;
            peak_near(&e.spectrum, at, tolerance * at)
        });
        (at, peak)
    });
    let found: Vec<_> = found.collect();
    let levels = LINES.iter().zip(own_levels(&found));
    all.extend(levels.map(|(line, level)| line.quantity("envelope", exact(level))));
}

/// Height of the line found at each frequency, Hz; none where another frequency has the same line and lies nearer to
/// it.
fn own_levels(found: &[(f64, Option<Peak>)]) -> Vec<Option<f64>> {
    let away = |at: f64, peak: &Peak| (peak.frequency / at - 1.0).abs();
    let own = |(at, peak): &(f64, Option<Peak>)| {
        let peak = peak.as_ref()?;
        let taken = found.iter().any(|(other, theirs)| {
            let same = theirs.as_ref().is_some_and(|t| t.frequency == peak.frequency);
            same && away(*other, peak) < away(*at, peak)
        });
        (!taken).then_some(peak.amplitude)
    };
    found.iter().map(own).collect()
}

fn defects(simulation: &Simulation, findings: &Findings, all: &mut Vec<Quantity>) {
    let named = |index: usize| format!("defect{}", index + 1);
    for index in 0..simulation.model().defects.len() {
        let found = FoundDefect {
            line: findings.lines.iter().find(|l| l.defect == index),
            extremes: findings.passes.extremes(index),
        };
        let one = |f: &Field<fn(&FoundDefect) -> _>| f.quantity(&named(index), (f.of)(&found));
        all.extend(DEFECT.iter().map(one));
    }
    all.extend(impacts(simulation, findings).iter().map(|impacts| {
        let field = if impacts.enters { ENTRY_PEAK } else { EXIT_PEAK };
        field.quantity(&named(impacts.defect), (field.of)(impacts))
    }));
}

fn rows(findings: &Findings, all: &mut Vec<Quantity>) {
    let named = |row: usize| format!("row{}", row + 1);
    for (row, slip) in findings.slip.rows.iter().enumerate() {
        all.extend(SLIP.iter().map(|f| f.quantity(&named(row), (f.of)(slip))));
    }
    for (row, load) in findings.load_zone.rows.iter().enumerate() {
        let one = |f: &Field<fn(&_) -> _>| f.quantity(&named(row), exact((f.of)(load)));
        all.extend(LOAD.iter().map(one));
    }
}

/// The numbers that runs of a scenario have, before any runs: their names and units count, not their values.
pub fn listed(scenario: &Scenario, simulation: &Simulation) -> Vec<Quantity> {
    let findings = crate::observe::Watch::new(scenario, simulation).finish(simulation);
    let outcome = Outcome {
        refined: None,
        end: crate::simulate::End::Stopped,
        rows: 0,
        t: 0.0,
        reached: 0.0,
        work: crate::simulate::SolverWork::default(),
        energy: crate::simulate::EnergyAudit::default(),
        momentum_imbalance: None,
        sensor: Vec::new(),
    };
    quantities(scenario, simulation, &outcome, &findings)
}

/// The names of [`listed()`]: what a plot may ask for.
pub fn names(scenario: &Scenario, simulation: &Simulation) -> Vec<String> {
    listed(scenario, simulation).into_iter().map(|q| q.name).collect()
}

/// A name that no run of a scenario has.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{name}: no such number of a run{}\n  allowed: the columns of `brinell sweep`, such as {}", .near.as_ref().map_or(String::new(), |n| format!("; did you mean `{n}`?")), .such_as.join(", "))]
pub struct UnknownName {
    /// The name.
    pub name: String,
    /// The nearest that there is, if any is near.
    pub near: Option<String>,
    /// Others that are much alike, or usual ones.
    pub such_as: Vec<String>,
}

/// Whether `name` is one of `names`, which [`names()`] gives.
///
/// # Errors
/// Where it is not.
pub fn check_name(name: &str, names: &[String]) -> Result<(), UnknownName> {
    if names.iter().any(|n| n == name) {
        return Ok(());
    }
    let part = name.split('.').next_back().unwrap_or(name);
    let alike = names.iter().filter(|n| n.ends_with(part) || n.starts_with(name));
    let mut such_as: Vec<String> = alike.take(8).cloned().collect();
    if such_as.is_empty() {
        such_as = ["sensor_ax.rms", "envelope.bpfo", "row1.cage_slip"].map(str::to_owned).into();
    }
    let near = did_you_mean(name, names.iter().map(String::as_str));
    Err(UnknownName { name: name.to_owned(), near: near.map(str::to_owned), such_as })
}

/// Whether a channel is a sensor's, which says by its name that it passed the filter: `sensor_ax`, and a machine's `housing1.drive_end`.
fn is_of_sensor(channel: &str) -> bool {
    channel.starts_with("sensor_") || unit_of_machine(channel).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_line_counts_for_one_frequency() {
        let peak = |frequency: f64| {
            let amplitude = 2.0;
            Some(Peak { frequency, amplitude })
        };
        // The NN3007 at 1800 r/min with 1.7 % of slip: its one line lies within 2 % of both BPFO and 2 BSF.
        let found = [(250.1, peak(245.9)), (319.9, None), (241.3, peak(245.9)), (482.6, peak(480.0))];
        assert_eq!(own_levels(&found), [Some(2.0), None, None, Some(2.0)]);
    }
}
