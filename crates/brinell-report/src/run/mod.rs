//! From a run's results to its page: names, units and notes for people.

pub mod chapters;
mod contacts;
mod healthy;
mod lead;
mod machine;
mod motion;
mod orders;
mod sensor;
mod signals;
mod tables;

use crate::data::Signals;
use crate::frame::THINNED;
use crate::number::{plural, short};
use crate::page::Page;
use brinell::made_by::MadeBy;
use brinell::plausibility::observed;
use brinell::result::Parts;
use brinell::scenario::{Bearing, ModelKind, Scenario, Speed};
use brinell::simulate::End;
use brinell_damage::Photo;
use brinell_study::campaign::Level;
use contacts::{load_distribution, pass};
use motion::{cage_orbits, motion, slip_rows, spectrogram};
pub use signals::defect_markers;
pub(crate) use signals::{RINGS_BEFORE, found_markers};
use signals::{envelope_spectrum, indicators, sensor_label, spectrum, waveform};
use std::sync::Arc;
use tables::{audits, facts, slip, solver_work};

impl Page {
    /// The page of a run: `report.html` of `brinell run`. Damage that makes no model is not drawn, and the page says why.
    /// `photos` belong to the defects in their order; `spread` says what assumed values do to the levels.
    pub fn of_run(parts: &Parts, photos: &[Option<Photo>], spread: Option<&[Level]>) -> Self {
        let scenario = &parts.loaded.scenario;
        let damage = crate::defects::damage_of(scenario, None).map_err(|error| error.to_string());
        let lead = lead::lead(parts, damage.as_deref().unwrap_or_default(), spread.unwrap_or_default());
        let mut views = damage.map(|all| all.into_iter().map(|d| d.view).collect::<Vec<_>>());
        for (view, photo) in views.iter_mut().flatten().zip(photos) {
            view.photo.clone_from(photo);
        }
        let signals = Arc::new(of_signals(parts));
        let mut all = chapters::signals(&signals);
        all.extend(machine::chapter(parts));
        all.push(chapters::spectrogram(spectrogram(parts, sensor_label(parts))));
        all.extend(chapters::sensor(sensor::view(parts)));
        let passes = parts.findings.passes.best();
        all.extend([
            chapters::damage(views),
            chapters::passes(passes.iter().map(|p| pass(parts, p)).collect()),
            chapters::load(load_distribution(parts), crate::defects::along_roller(&observed(scenario))),
            chapters::motion(motion(parts)),
            chapters::orbit(cage_orbits(parts)),
            chapters::indicators(&indicators(parts, spread.is_some())),
            chapters::slip(&slip(parts), slip_rows(parts)),
        ]);
        all.extend(spread.map(chapters::spread));
        all.push(chapters::assumptions(&parts.loaded.provenance, spread.is_some()));
        all.extend(chapters::appendices(&audits(parts), &solver_work(parts), &parts.loaded.to_toml()));
        all.push(chapters::headline(&signals));
        Self {
            title: if scenario.name.is_empty() { "Bearing vibration".into() } else { scenario.name.clone() },
            subtitle: subtitle(scenario),
            version: MadeBy::of_scenario(&parts.loaded.to_toml()).to_string(),
            partial: match &parts.outcome.end {
                End::Complete => None,
                End::Stopped => Some("the run was stopped before its duration".into()),
                End::Failed(error) => Some(error.to_string()),
            },
            lead,
            warnings: parts.warnings(),
            facts: facts(parts, spread.unwrap_or_default()),
            chapters: all,
            ..Self::simulated()
        }
    }

    /// An empty page of a run, which moves.
    pub fn simulated() -> Self {
        Self { footer: THINNED.into(), script: include_str!("../script/motion.js"), ..Self::default() }
    }
}

fn of_signals(parts: &Parts) -> Signals {
    let scenario = &parts.loaded.scenario;
    let (envelope_orders, order_markers) = orders::orders(parts, parts.findings);
    Signals {
        title: scenario.name.clone(),
        subtitle: subtitle(scenario),
        healthy: healthy::healthy(parts, &envelope_orders),
        waveform: waveform(parts),
        spectrum: spectrum(parts),
        envelope_spectrum: envelope_spectrum(parts),
        envelope_orders,
        order_markers,
        markers: found_markers(scenario, parts.simulation.model(), &parts.findings.lines),
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
    let name = |b: &Bearing| {
        b.preset.clone().unwrap_or_else(|| {
            format!(
                "{} of {} {}s, {} mm pitch",
                plural(b.rows, "row"),
                b.rollers_per_row,
                b.element.word(),
                b.pitch_diameter_mm
            )
        })
    };
    let bearing = match &scenario.machine {
        None => name(&scenario.bearing),
        Some(machine) => {
            let all: Vec<String> = machine.each(scenario).map(|(_, alone)| name(&alone.bearing)).collect();
            format!("a shaft on {}", all.join(" and "))
        }
    };
    let of = scenario.machine.as_ref().map_or(String::new(), |machine| format!(" of bearing {}", machine.lead + 1));
    let damage = match scenario.defects.len() {
        0 => "healthy".to_owned(),
        1 => format!("one defect{of}"),
        n => format!("{n} defects{of}"),
    };
    let load = scenario.operation.load_n;
    let model = match scenario.simulation.model {
        ModelKind::Full => "full model",
        ModelKind::Lumped => "lumped model",
        ModelKind::Tilting => "tilting model",
    };
    let load = match scenario.machine {
        Some(_) => String::new(),
        None => format!("load {} N, ", short(load[0].hypot(load[1]), 4)),
    };
    format!("{bearing}, {damage}, {}, {load}{model}", speed(scenario))
}
