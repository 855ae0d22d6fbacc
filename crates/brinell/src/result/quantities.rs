//! A run as named numbers: every indicator of every channel with its interval, defect lines, contact, slip, audits and work.
//!
//! Names are channel and indicator, `sensor_ax.rms`; SI units. A channel's values are instantaneous; what passed the anti-alias
//! filter, and does not say so in its name as `sensor_*` does, is `outer_ax.anti_aliased.rms`. A scenario fixes the list of
//! names; what a run does not have (slip in the lumped model, a defect's frequency in a short run) is there without a value.
//! No wall time is among them: the same scenario gives the same numbers.

use super::impacts::{Impacts, impacts};
use crate::channel::STIFFNESS_UNIT;
use crate::observe::{DefectLine, Findings, Kind};
use crate::scenario::{Scenario, Speed};
use crate::signal::spectrum::{Peak, peak_near};
use crate::signal::{Estimate, Indicator, Interval, LineSearch, RECORD_PEAK, RECORD_PEAK_TO_PEAK};
use crate::simulate::{Outcome, Simulation};

/// One number of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// What it is: `sensor_ax.rms`.
    pub name: String,
    /// SI unit; 1 where it has none.
    pub unit: String,
    /// The value; `None` where there is none, and never infinite or not a number.
    pub value: Option<f64>,
    /// What is known of its scatter.
    pub spread: Spread,
}

/// Whether a number comes with an interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spread {
    /// It never does: a count, an extreme.
    Without,
    /// It does, but not in this run: it is too short to tell.
    Unknown,
    /// 95 % interval of the same quantity; the value lies within it.
    Interval(Interval),
}

impl Quantity {
    fn new(name: impl Into<String>, unit: &str, value: Option<f64>) -> Self {
        Self {
            name: name.into(),
            unit: unit.into(),
            value: value.filter(|x| x.is_finite()),
            spread: Spread::Without,
        }
    }

    fn estimated(name: impl Into<String>, unit: &str, estimate: Option<Estimate>) -> Self {
        let mut quantity = Self::new(name, unit, estimate.map(|e| e.value));
        let interval = estimate.and_then(|e| e.interval);
        quantity.spread = interval.map_or(Spread::Unknown, Spread::Interval);
        quantity
    }

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

/// Least stiffness of a contact over a defect, as the name's last part.
pub const LEAST_STIFFNESS: &str = "least_stiffness";

/// Harmonics of a defect frequency whose level is told.
const HARMONICS: usize = 3;

/// Everything that is told of a run, in a fixed order.
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
    audits(outcome, &mut all);
    all.push(Quantity::new("analysed_from", "s", Some(findings.from)));
    all
}

/// Channel, kind and indicator as one name.
pub(super) fn indicator_name(channel: &str, kind: Kind, indicator: Indicator) -> String {
    quantity_name(channel, kind, indicator.name())
}

fn quantity_name(channel: &str, kind: Kind, what: &str) -> String {
    let filtered = match kind {
        Kind::AntiAliased if !channel.starts_with("sensor_") => ".anti_aliased",
        _ => "",
    };
    format!("{channel}{filtered}.{what}")
}

fn indicators(findings: &Findings, all: &mut Vec<Quantity>) {
    for channel in &findings.channels {
        for indicator in Indicator::ALL {
            let estimate = channel.blocks.estimate(indicator);
            let unit = if indicator.has_unit() {
                channel.unit
            } else {
                "1"
            };
            let name = indicator_name(&channel.name, channel.kind, indicator);
            all.push(Quantity::estimated(name, unit, estimate));
        }
    }
    // The largest of the record grows with its length: no interval.
    for channel in &findings.channels {
        let record = channel.blocks.record();
        for (what, value) in [
            (RECORD_PEAK, record.get(Indicator::Peak)),
            (RECORD_PEAK_TO_PEAK, record.get(Indicator::PeakToPeak)),
        ] {
            let name = quantity_name(&channel.name, channel.kind, what);
            all.push(Quantity::new(name, channel.unit, value));
        }
    }
    let turns = findings.channels.first();
    let turns = turns.map_or(0, |c| c.blocks.revolutions());
    all.push(Quantity::new("analysed_turns", "1", Some(turns as f64)));
}

/// Levels of the envelope spectrum at the defect frequencies and their harmonics, within the share that [`LineSearch`] looks in. Where
/// these shares overlap, as those of BPFO and 2 BSF of a slender bearing do, a line counts for the frequency that it is nearest to.
fn lines(
    scenario: &Scenario,
    simulation: &Simulation,
    findings: &Findings,
    all: &mut Vec<Quantity>,
) {
    let model = simulation.model();
    let constant = matches!(scenario.operation.speed_rpm, Speed::Constant(_));
    let k = model.kinematics(model.rotation.at(0.0).0);
    let (mut names, mut found) = (Vec::new(), Vec::new());
    for (name, frequency) in [("bpfo", k.bpfo), ("bpfi", k.bpfi), ("2bsf", 2.0 * k.bsf)] {
        for n in 1..=HARMONICS {
            let at = frequency * n as f64;
            let envelope = findings.envelope.as_ref().filter(|_| constant && at > 0.0);
            let peak = envelope.and_then(|(e, _)| {
                let tolerance = LineSearch::new(frequency).tolerance;
                peak_near(&e.spectrum, at, tolerance * at)
            });
            names.push(match n {
                1 => format!("envelope.{name}"),
                n => format!("envelope.{name}_x{n}"),
            });
            found.push((at, peak));
        }
    }
    let levels = own_levels(&found).into_iter();
    all.extend(
        names
            .into_iter()
            .zip(levels)
            .map(|(n, level)| Quantity::new(n, "m/s^2", level)),
    );
}

/// Height of the line found at each frequency, Hz; none where another frequency has the same line and lies nearer to it.
fn own_levels(found: &[(f64, Option<Peak>)]) -> Vec<Option<f64>> {
    let away = |at: f64, peak: &Peak| (peak.frequency / at - 1.0).abs();
    let own = |(at, peak): &(f64, Option<Peak>)| {
        let peak = peak.as_ref()?;
        let taken = found.iter().any(|(other, theirs)| {
            let same = theirs
                .as_ref()
                .is_some_and(|t| t.frequency == peak.frequency);
            same && away(*other, peak) < away(*at, peak)
        });
        (!taken).then_some(peak.amplitude)
    };
    found.iter().map(own).collect()
}

/// `defect1.entry_peak` or `defect1.exit_peak`.
pub(super) fn impact_name(impacts: &Impacts) -> String {
    let what = if impacts.enters { "entry" } else { "exit" };
    format!("defect{}.{what}_peak", impacts.defect + 1)
}

fn defects(simulation: &Simulation, findings: &Findings, all: &mut Vec<Quantity>) {
    let passes = findings.passes.best();
    for index in 0..simulation.model().defects.len() {
        let line = findings.lines.iter().find(|l| l.defect == index);
        let named = |name: &str| format!("defect{}.{name}", index + 1);
        let rate = line.and_then(DefectLine::estimate);
        all.push(Quantity::estimated(named("frequency"), "Hz", rate));
        let nominal = line.map(|l| l.nominal);
        all.push(Quantity::new(
            named("pure_rolling_frequency"),
            "Hz",
            nominal,
        ));
        let pass = passes.iter().find(|p| p.defect == index);
        let least = |of: fn(&crate::observe::passes::PassPoint) -> f64| {
            pass.and_then(|p| p.points.iter().map(of).min_by(f64::total_cmp))
        };
        all.push(Quantity::new(
            named("least_contact_length"),
            "m",
            least(|p| p.length),
        ));
        all.push(Quantity::new(
            named(LEAST_STIFFNESS),
            STIFFNESS_UNIT,
            least(|p| p.stiffness),
        ));
        all.push(Quantity::new(
            named("peak_force"),
            "N",
            pass.map(|p| p.peak),
        ));
    }
    for one in impacts(simulation, findings) {
        all.push(Quantity::estimated(impact_name(&one), "m/s^2", one.peak));
    }
}

fn rows(findings: &Findings, all: &mut Vec<Quantity>) {
    for (row, slip) in findings.slip.rows.iter().enumerate() {
        for (name, estimate) in [
            ("cage_slip", slip.cage()),
            ("loaded_orbit_slip", slip.loaded_orbit()),
            ("loaded_surface_slip", slip.loaded_surface()),
            ("unloaded_orbit_slip", slip.unloaded_orbit()),
        ] {
            let name = format!("row{}.{name}", row + 1);
            all.push(Quantity::estimated(name, "1", estimate));
        }
    }
    for (row, load) in findings.load_zone.rows.iter().enumerate() {
        let largest = load.max.iter().copied().max_by(f64::total_cmp);
        let name = format!("row{}.largest_outer_force", row + 1);
        all.push(Quantity::new(name, "N", largest));
    }
}

fn audits(outcome: &Outcome, all: &mut Vec<Quantity>) {
    let energy = &outcome.energy;
    let turnover = energy.turnover();
    let relative = (turnover > 0.0).then(|| energy.residual() / turnover);
    all.push(Quantity::new(
        "audit.energy_residual",
        "J",
        Some(energy.residual()),
    ));
    all.push(Quantity::new(
        "audit.energy_residual_over_turnover",
        "1",
        relative,
    ));
    all.push(Quantity::new(
        "audit.momentum_imbalance",
        "1",
        outcome.momentum_imbalance,
    ));
    let work = &outcome.work;
    for (name, count) in [
        ("steps", work.solver.steps),
        ("rejections", work.solver.rejections),
        ("right_hand_sides", work.solver.evaluations),
        ("right_hand_sides_for_samples", work.sample_evaluations),
        ("contact_switches", work.contact_switches),
        ("pocket_switches", work.pocket_switches),
        ("damage_switches", work.damage_switches),
        ("samples", outcome.rows),
    ] {
        all.push(Quantity::new(
            format!("work.{name}"),
            "1",
            Some(count as f64),
        ));
    }
}

/// The names that runs of a scenario have, before any runs: what a plot may ask for.
pub fn names(scenario: &Scenario, simulation: &Simulation) -> Vec<String> {
    let findings = crate::observe::Watch::new(scenario, simulation).finish(simulation);
    let outcome = Outcome {
        end: crate::simulate::End::Stopped,
        rows: 0,
        t: 0.0,
        work: crate::simulate::SolverWork::default(),
        energy: crate::simulate::EnergyAudit::default(),
        momentum_imbalance: None,
        sensor: Vec::new(),
    };
    let all = quantities(scenario, simulation, &outcome, &findings);
    all.into_iter().map(|q| q.name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_line_counts_for_one_frequency() {
        let peak = |frequency: f64| {
            let amplitude = 2.0;
            Some(Peak {
                frequency,
                amplitude,
            })
        };
        // The NN3007 at 1800 r/min with 1.7 % of slip: its one line lies within 2 % of both BPFO and 2 BSF.
        let found = [
            (250.1, peak(245.9)),
            (319.9, None),
            (241.3, peak(245.9)),
            (482.6, peak(480.0)),
        ];
        assert_eq!(own_levels(&found), [Some(2.0), None, None, Some(2.0)]);
    }
}
