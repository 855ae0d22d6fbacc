//! Of a run's page, the machine: its bearings, sensors, natural frequencies, Campbell diagram.

use crate::data::Along;
use crate::number::short;
use crate::overlay::{OverlaidCurve, Overlay, Vertical};
use crate::page::{Chapter, Piece};
use crate::tables::Table;
use brinell::derived::{DerivedBearing, DerivedMachine};
use brinell::machine::{Mode, Whirl};
use brinell::result::Parts;
use brinell::scenario::{Machine, Scenario};
use brinell::signal::Indicator;
use std::f64::consts::TAU;

/// Speeds of the diagram, and its lines.
const SPEEDS: usize = 40;
const LINES: usize = 8;
/// How far beyond the top speed it goes.
const BEYOND: f64 = 1.5;
/// Or beyond the first critical speed, where that is not farther than so many times the top speed.
const FAR: f64 = 8.0;

/// `None` of a bearing on its own.
pub(super) fn chapter(parts: &Parts) -> Option<Chapter> {
    let scenario = &parts.loaded.scenario;
    let machine = scenario.machine.as_ref()?;
    let mut pieces = Vec::new();
    match DerivedMachine::new(scenario, parts.simulation) {
        Ok(derived) => {
            pieces.push(Piece::Table(bearings(scenario, machine, &derived)));
            pieces.push(Piece::Table(sensors(parts)));
            pieces.push(campbell(&derived));
            pieces.push(Piece::Table(critical(&derived)));
        }
        Err(error) => pieces.push(Piece::Alert("The machine has no static balance.", error.to_string())),
    }
    Some(Chapter::new("machine", "Machine", "Machine", pieces))
}

fn bearings(scenario: &Scenario, machine: &Machine, derived: &DerivedMachine) -> Table {
    let row = |(k, one): (usize, &DerivedBearing)| {
        let b = &one.scenario.bearing;
        let [x, y] = one.carried.force;
        let [along, up] = one.carried.misalignment.map(|slope| 1e3 * slope);
        let stiffness = one.coefficients(derived.top_speed).stiffness;
        vec![
            format!("{}", k + 1),
            b.preset.clone().unwrap_or_else(|| format!("{} mm pitch", b.pitch_diameter_mm)),
            short(machine.seats[k].at_mm, 4),
            match one.scenario.defects.len() {
                0 => "none".into(),
                n => format!("{n}"),
            },
            short(x.hypot(y), 3),
            short(along.hypot(up), 2),
            short(stiffness[0][0], 3),
            short(stiffness[1][1], 3),
        ]
    };
    let observed = if scenario.defects.is_empty() { "" } else { ", the first that is damaged" };
    Table::new(
        "Bearings",
        ["Bearing", "Type", "#Z, mm", "Defects", "#Carries, N", "#Misaligned, mrad", "#k_xx, N/m", "#k_yy, N/m"],
        derived.bearings.iter().enumerate().map(row),
        format!(
            "In static balance under the full load. What this page says of contacts, cage and passes is of bearing {}{observed}.",
            machine.lead + 1
        ),
    )
}

fn sensors(parts: &Parts) -> Table {
    let of = parts.findings.channels.iter().filter(|c| parts.simulation.is_sensor(&c.name));
    let row = |c: &brinell::observe::ChannelStatistics| {
        let of = |indicator| c.blocks.estimate(indicator).map_or("-".into(), |e| short(e.value, 3));
        vec![c.name.clone(), of(Indicator::Rms), of(Indicator::PeakToPeak), of(Indicator::Kurtosis)]
    };
    let note = format!("Waveform and spectra of this page are of {}.", parts.findings.sensor);
    Table::new("Sensors", ["Channel", "#RMS, m/s^2", "#Peak to peak of a turn, m/s^2", "#Kurtosis"], of.map(row), note)
}

fn critical(derived: &DerivedMachine) -> Table {
    let row = |(speed, whirl): (f64, Whirl)| vec![whirl.word().into(), short(60.0 * speed / TAU, 5)];
    let speeds = derived.critical_speeds();
    let note = "Without damping, on the bearings\u{2019} stiffness at their load and at the top speed.";
    Table::new("Critical speeds", ["Whirl", "#Critical speed, r/min"], speeds.into_iter().take(LINES).map(row), note)
}

/// Natural frequencies over the speed, with the line of one a turn.
fn campbell(derived: &DerivedMachine) -> Piece {
    let critical = derived.critical_speeds().first().map_or(0.0, |(speed, _)| *speed);
    let near = if critical < FAR * derived.top_speed { critical } else { 0.0 };
    let step = BEYOND * derived.top_speed.max(near) / (SPEEDS - 1) as f64;
    let speeds: Vec<f64> = (0..SPEEDS).map(|k| k as f64 * step).collect();
    let along = || Along::Even { first: 0.0, step: 60.0 * step / TAU };
    let line = |modes: Vec<Option<Mode>>| {
        let forward = modes.iter().flatten().filter(|mode| mode.whirl == Whirl::Forward).count();
        OverlaidCurve {
            of: usize::from(2 * forward < modes.iter().flatten().count()),
            along: along(),
            values: modes.into_iter().map(|mode| mode.map_or(f64::NAN, |mode| mode.frequency)).collect(),
        }
    };
    let mut curves: Vec<OverlaidCurve> = derived.campbell(&speeds, LINES).into_iter().map(line).collect();
    let once = speeds.iter().map(|speed| speed / TAU).collect();
    curves.push(OverlaidCurve { of: 2, along: along(), values: once });
    let overlay = Overlay {
        title: "Campbell diagram".into(),
        vertical: Vertical::FromZero,
        note: "Damped natural frequencies of the shaft on its bearings and housings, which are as stiff as at the load that they carry at rest and at each \
               speed. Where the line of one a turn meets one of them, unbalance excites it."
            .into(),
        ..Overlay::new("campbell", ("Speed", "r/min"), ("Natural frequency", "Hz"), curves)
    };
    Piece::Curves(overlay, ["forward", "backward", "one a turn"].map(String::from).to_vec())
}
