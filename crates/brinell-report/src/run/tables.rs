//! Of a run's page, its tables and tiles: headline numbers, slip, audits, the solver's work, assumptions.

use super::healthy;
use crate::Fact;
use crate::number::short;
use brinell::accuracy::METHOD;
use brinell::observe::passes::place;
use brinell::observe::{ChannelStatistics, DefectLine};
use brinell::result::Parts;
use brinell::result::fields::{self, Field};
use brinell::signal::Indicator;
use brinell::signal::decimate::PASSBAND;
use brinell::simulate::Outcome;
use brinell_study::campaign::Level;

/// `spread`: what assumed values do to the levels, where that was looked at.
pub(super) fn facts(parts: &Parts, spread: &[Level]) -> Vec<Fact> {
    let mut facts = Vec::new();
    let band_khz = 1e-3 * PASSBAND * parts.loaded.scenario.simulation.sample_rate_hz;
    if let Some(channel) = parts.findings.of_sensor() {
        for (indicator, label) in [
            (
                Indicator::Rms,
                match parts.simulation.sensor() {
                    _ if parts.loaded.scenario.machine.is_some() => "RMS of the acceleration at the sensor",
                    Some(_) => "RMS of the acceleration at the sensor",
                    None => "RMS of the outer ring's acceleration",
                },
            ),
            (Indicator::Kurtosis, "Kurtosis"),
        ] {
            let Some(e) = channel.blocks.estimate(indicator) else {
                continue;
            };
            let unit = indicator.unit(channel.unit);
            let mut note = format!("0 to {} kHz", short(band_khz, 3));
            if let Some(i) = e.interval {
                note += &format!("; 95 %, scatter only: {} to {}", short(i.low, 3), short(i.high, 3));
            }
            let level = spread.iter().find(|level| level.name == format!("{}.{}", channel.name, indicator.name()));
            match level.map(|level| level.band) {
                Some([low, high]) => note += &format!("; {} to {} by what is assumed", short(low, 3), short(high, 3)),
                None if indicator == Indicator::Rms => note += "; what is assumed may change it severalfold: --spread",
                None => {}
            }
            facts.push(Fact::new(label, short(e.value, 3), unit, note));
        }
    }
    facts.extend(healthy_fact(parts));
    facts.extend(parts.findings.lines.iter().map(|line| line_fact(parts, line)));
    if let Ok(zone) = &parts.beforehand.statics {
        facts.push(Fact::new(
            "Heaviest contact, static",
            short(zone.largest, 3),
            "N",
            format!(
                "{}load zone {:.0}° wide",
                if parts.simulation.model().defects.is_empty() { "" } else { "with the damage; " },
                zone.extent.to_degrees()
            ),
        ));
    }
    facts
}

/// The level of the healthy bearing.
fn healthy_fact(parts: &Parts) -> Option<Fact> {
    let rms = parts.healthy?.rms()?;
    let times = healthy::times(parts).map_or(String::new(), |(words, interval)| {
        let interval = match interval.is_empty() {
            true => interval,
            false => format!(" ({interval})"),
        };
        format!("; damaged {words}{interval}{}", healthy::smooth(parts))
    });
    let other_axis = |channel: &ChannelStatistics| {
        let (rms, ratio, why) = parts.beside_healthy(&channel.name)?;
        let (rms, ratio) = (short(rms.value, 3), short(ratio.value, 2));
        Some(format!("; {} {rms} m/s², damaged {ratio} times that{why}", channel.name))
    };
    let others: String =
        parts.read().filter(|channel| channel.name != parts.findings.sensor).filter_map(other_axis).collect();
    Some(Fact::new(
        if parts.loaded.scenario.machine.is_some() {
            "RMS of the healthy machine"
        } else {
            "RMS of the healthy bearing"
        },
        short(rms.value, 3),
        "m/s^2",
        format!("the same scenario without its damage{times}{others}"),
    ))
}

/// A defect's frequency.
fn line_fact(parts: &Parts, line: &DefectLine) -> Fact {
    let defect = &parts.simulation.model().defects[line.defect];
    let missing = if line.too_short.is_some() { "not looked for" } else { "not found" };
    let value = line.found.map_or(missing.to_owned(), |f| format!("{:.2}", f.frequency));
    let note = match line.found {
        Some(_) => format!(
            "{} in the envelope; {}pure rolling {:.2} Hz",
            place(defect),
            line.interval.map_or(String::new(), |i| format!("95 %: {:.2} to {:.2} Hz; ", i.low, i.high)),
            line.nominal
        ),
        None => {
            let why = line.too_short.as_ref().map_or(String::new(), |why| format!("{why}; "));
            format!("{}; {why}pure rolling {:.2} Hz", place(defect), line.nominal)
        }
    };
    let unit = line.found.map_or("", |_| "Hz");
    Fact::new(line.name, value, unit, note)
}

pub(super) fn slip(parts: &Parts) -> Vec<Fact> {
    let mut facts = Vec::new();
    let percent = |x: f64| short(100.0 * x, 3);
    for (row, slip) in parts.findings.slip.rows.iter().enumerate() {
        let entries = [
            ("cage", fields::CAGE_SLIP, "behind its pure-rolling speed"),
            ("loaded rolling elements, orbit", fields::LOADED_ORBIT_SLIP, "behind their pure-rolling orbit speed"),
            (
                "loaded rolling elements, inner contact",
                fields::LOADED_SURFACE_SLIP,
                "mean |slip| over the raceway's surface speed",
            ),
            ("unloaded rolling elements, orbit", fields::UNLOADED_ORBIT_SLIP, "behind their pure-rolling orbit speed"),
        ];
        for (label, field, note) in entries {
            if let Some(estimate) = (field.of)(slip) {
                let interval = estimate.interval.map_or(String::new(), |i| {
                    format!("; 95 %: {} to {} %", short(100.0 * i.low, 3), short(100.0 * i.high, 3))
                });
                facts.push(Fact::new(
                    format!("Row {}: {label}", row + 1),
                    percent(estimate.value),
                    "%",
                    format!("{note}{interval}"),
                ));
            }
        }
    }
    facts
}

/// Limits of the audits: beyond them something is wrong with the run.
const MOMENTUM_LIMIT: f64 = 1e-12;
const ENERGY_LIMIT: f64 = 1e-2;

pub(super) fn audits(parts: &Parts) -> Vec<Fact> {
    let e = &parts.outcome.energy;
    let f = &e.flows;
    let mj = |label: &str, joule: f64, note: &str| Fact::new(label, short(1e3 * joule, 4), "mJ", note);
    let mut facts = Vec::new();
    if let Some(x) = (fields::MOMENTUM_IMBALANCE.of)(parts.outcome) {
        let value = short(x, 2);
        let note = "largest force or torque without a reaction, relative to all; round-off is about 1e-15";
        facts.push(Fact::new("Momentum imbalance", value, "", note).judged(x < MOMENTUM_LIMIT));
    }
    // Where nothing moved, no residual is left over.
    let relative = (fields::RELATIVE_RESIDUAL.of)(parts.outcome);
    facts.push(
        mj("Energy residual", e.residual(), "change less everything booked: the integrator's error")
            .judged(relative.is_none_or(|x| x.abs() < ENERGY_LIMIT)),
    );
    facts.push(mj("Change of energy held", e.last.total() - e.initial.total(), "kinetic, elastic and gravity"));
    facts.push(mj("Input by the drive", f.drive, "through the friction of the inner raceway"));
    facts.push(mj("Input by the load", f.load, ""));
    facts.push(mj("Guidance film", f.film, "net work on the bodies"));
    facts.push(mj("Dissipated in contact damping", f.contact, ""));
    facts.push(mj("Dissipated in raceway friction", f.friction, ""));
    facts.push(mj("Dissipated in rolling resistance", f.rolling, ""));
    facts.push(mj("Dissipated in pockets", f.pocket + f.pocket_friction, "damping and friction"));
    facts.push(mj("Dissipated at the cages' lands", f.land, "damping where a cage touches its guiding ring"));
    facts.push(mj("Dissipated in supports", f.support, ""));
    facts.push(mj("Dissipated in drag", f.drag, ""));
    if e.parametric != 0.0 {
        let note = "energy error of the paper's contact law: stiffness that changes under a rolling element";
        facts.push(mj("Parametric work of defects", e.parametric, note));
    }
    if f.lever != 0.0 {
        facts.push(mj("Centred levers", f.lever, "contact forces act through the bearing's centre, as in the paper"));
    }
    facts
}

pub(super) fn solver_work(parts: &Parts) -> Vec<Fact> {
    let count = |label: &str, field: Field<fn(&Outcome) -> u64>, note: &str| {
        let n = (field.of)(parts.outcome).to_string();
        Fact::new(label, n, "", note)
    };
    let accuracy = parts.simulation.accuracy().word();
    vec![
        Fact::new("Accuracy", accuracy, "", METHOD),
        count("Steps", fields::STEPS, ""),
        count("Rejected steps", fields::REJECTIONS, ""),
        count("Right-hand sides", fields::RIGHT_HAND_SIDES, "for steps"),
        count(
            "Right-hand sides for samples",
            fields::SAMPLE_RIGHT_HAND_SIDES,
            "one a sample of the instantaneous channels",
        ),
        count("Contacts opened or closed", fields::CONTACT_SWITCHES, ""),
        count("Pockets opened or closed", fields::POCKET_SWITCHES, ""),
        count("Contacts onto or off damage", fields::DAMAGE_SWITCHES, ""),
    ]
}
