//! From a run's results to the report's data: names, units and notes for people.

mod contacts;
mod healthy;
mod lead;
mod motion;
mod orders;
mod page;
mod sensor;
mod signals;
mod tables;

use crate::Report;
use crate::number::short;
use brinell::result::Parts;
use brinell::scenario::{ModelKind, Scenario, Speed};
use brinell::simulate::End;
use contacts::{load_distribution, pass};
use motion::{cage_orbits, motion, slip_rows, spectrogram};
pub use signals::defect_markers;
pub(crate) use signals::found_markers;
use signals::{envelope_spectrum, indicators, sensor_label, spectrum, waveform};
use tables::{audits, facts, slip, solver_work};

impl Report {
    /// What the page of a run shows: `report.html` of `brinell run`. Damage that makes no model is not drawn, and the
    /// page says why.
    pub fn of_run(parts: &Parts) -> Self {
        let scenario = &parts.loaded.scenario;
        let (damage, undrawn_damage) = match crate::defects::damage_of(scenario, None) {
            Ok(all) => (all, None),
            Err(error) => (Vec::new(), Some(error.to_string())),
        };
        let (envelope_orders, order_markers) = orders::orders(parts, parts.findings);
        Self {
            title: scenario.name.clone(),
            subtitle: subtitle(scenario),
            lead: lead::lead(parts, &damage),
            version: brinell::VERSION.to_owned(),
            partial: match &parts.outcome.end {
                End::Complete => None,
                End::Stopped => Some("the run was stopped before its duration".into()),
                End::Failed(error) => Some(error.to_string()),
            },
            warnings: parts.warnings(),
            facts: facts(parts),
            healthy: healthy::healthy(parts, &envelope_orders),
            waveform: waveform(parts),
            spectrum: spectrum(parts),
            spectrogram: spectrogram(parts, sensor_label(parts)),
            envelope_spectrum: envelope_spectrum(parts),
            envelope_orders,
            order_markers,
            markers: found_markers(scenario, parts.simulation.model(), &parts.findings.lines),
            damage: damage.into_iter().map(|d| d.view).collect(),
            undrawn_damage,
            passes: parts.findings.passes.best().iter().map(|p| pass(parts, p)).collect(),
            load_distribution: load_distribution(parts),
            along: crate::defects::along_roller(scenario),
            indicators: indicators(parts),
            slip: slip(parts),
            slip_rows: slip_rows(parts),
            cage_orbits: cage_orbits(parts),
            sensor: sensor::view(parts),
            motion: motion(parts),
            audits: audits(parts),
            solver_work: solver_work(parts),
            assumptions: parts.loaded.provenance.clone(),
            spread: None,
            scenario_toml: parts.loaded.to_toml(),
        }
    }
}

fn speed(scenario: &Scenario) -> String {
    match &scenario.operation.speed_rpm {
        Speed::Constant(rpm) => format!("{rpm} r/min"),
        Speed::Profile(points) => {
            let ends = |k: usize| points.get(k).map_or(0.0, |p| p[1]);
            format!("{} to {} r/min", ends(0), ends(points.len().saturating_sub(1)))
        }
    }
}

fn subtitle(scenario: &Scenario) -> String {
    let b = &scenario.bearing;
    let bearing = b.preset.clone().unwrap_or_else(|| {
        format!("{} rows of {} {}s, {} mm pitch", b.rows, b.rollers_per_row, b.element.word(), b.pitch_diameter_mm)
    });
    let damage = match scenario.defects.len() {
        0 => "healthy".to_owned(),
        1 => "one defect".to_owned(),
        n => format!("{n} defects"),
    };
    let load = scenario.operation.load_n;
    let model = match scenario.simulation.model {
        ModelKind::Full => "full model",
        ModelKind::Lumped => "lumped model",
        ModelKind::Tilting => "tilting model",
    };
    format!("{bearing}, {damage}, {}, load {} N, {model}", speed(scenario), short(load[0].hypot(load[1]), 4))
}
