//! From a run's results to the report's data: names, units and notes for people.

use crate::page_motion::{cage_orbits, motion, slip_rows, spectrogram};
use crate::say::short;
use brinell::bearing::Kinematics;
use brinell::channel::STIFFNESS_UNIT;
use brinell::defect::Side;
use brinell::observe::load_zone::StaticLoadZone;
use brinell::observe::passes::{Pass, place};
use brinell::observe::{ChannelStatistics, Kind};
use brinell::scenario::{Accuracy, ModelKind, Scenario, Speed};
use brinell::signal::Indicator;
use brinell::simulate::End;
use brinell::summary::Parts;
use brinell_report::{
    Assumption, Estimate, Event, EventKind, Fact, IndicatorRow, IndicatorTable, Marker, MinMax,
    Report, RowLoad, Series, Spectrum, Waveform,
};
use std::f64::consts::TAU;

/// Harmonics of a defect frequency that are marked.
const HARMONICS: usize = 5;
/// Points of a pass that are drawn.
const PASS_POINTS: usize = 600;
/// Indicators that the table shows.
const COLUMNS: [(Indicator, &str); 5] = [
    (Indicator::Rms, "RMS"),
    (Indicator::PeakToPeak, "Peak to peak"),
    (Indicator::CrestFactor, "Crest factor"),
    (Indicator::Kurtosis, "Kurtosis"),
    (Indicator::Skewness, "Skewness"),
];

/// The page's data.
pub(crate) fn report(parts: &Parts) -> Report {
    let scenario = &parts.loaded.scenario;
    let (damage, undrawn_damage) = match crate::damage::all(scenario, None) {
        Ok(all) => (all.into_iter().map(|d| d.view).collect(), None),
        Err(error) => (Vec::new(), Some(error.to_string())),
    };
    Report {
        title: scenario.name.clone(),
        subtitle: subtitle(scenario),
        version: brinell::VERSION.to_owned(),
        partial: match &parts.outcome.end {
            End::Complete => None,
            End::Stopped => Some("the run was stopped before its duration".into()),
            End::Failed(error) => Some(error.to_string()),
        },
        facts: facts(parts),
        waveform: waveform(parts),
        spectrum: spectrum(parts),
        spectrogram: spectrogram(parts, measured(parts)),
        envelope_spectrum: envelope_spectrum(parts),
        markers: markers(parts),
        damage,
        undrawn_damage,
        passes: parts
            .findings
            .passes
            .best()
            .iter()
            .map(|p| pass(parts, p))
            .collect(),
        load_distribution: load_distribution(parts),
        indicators: indicators(parts),
        slip: slip(parts),
        slip_rows: slip_rows(parts),
        cage_orbits: cage_orbits(parts),
        motion: motion(parts),
        audits: audits(parts),
        solver_work: solver_work(parts),
        assumptions: assumptions(parts),
        scenario_toml: parts.loaded.to_toml(),
    }
}

fn axis(parts: &Parts) -> &'static str {
    ["x", "y"][parts.findings.axis]
}

/// What waveform and spectra show.
fn measured(parts: &Parts) -> String {
    format!("Outer ring acceleration, {} (measured)", axis(parts))
}

fn speed(scenario: &Scenario) -> String {
    match &scenario.operation.speed_rpm {
        Speed::Constant(rpm) => format!("{rpm} r/min"),
        Speed::Profile(points) => {
            let ends = |k: usize| points.get(k).map_or(0.0, |p| p[1]);
            format!(
                "{} to {} r/min",
                ends(0),
                ends(points.len().saturating_sub(1))
            )
        }
    }
}

fn subtitle(scenario: &Scenario) -> String {
    let b = &scenario.bearing;
    let bearing = b.preset.clone().unwrap_or_else(|| {
        format!(
            "{} rows of {} rollers, {} mm pitch",
            b.rows, b.rollers_per_row, b.pitch_diameter_mm
        )
    });
    let damage = match scenario.defects.len() {
        0 => "healthy".to_owned(),
        1 => "one defect".to_owned(),
        n => format!("{n} defects"),
    };
    let load = scenario.operation.load_n;
    let model = match scenario.simulation.model {
        ModelKind::Full => "full model",
        ModelKind::Reference => "reference model",
    };
    format!(
        "{bearing}, {damage}, {}, load {} N, {model}",
        speed(scenario),
        short(load[0].hypot(load[1]), 4)
    )
}

fn facts(parts: &Parts) -> Vec<Fact> {
    let mut facts = Vec::new();
    let name = format!("measured_a{}", axis(parts));
    let measured = parts
        .findings
        .channels
        .iter()
        .find(|c| c.name == name && c.kind == Kind::AntiAliased);
    if let Some(channel) = measured {
        for (indicator, label) in [
            (Indicator::Rms, "RMS of the outer ring's acceleration"),
            (Indicator::Kurtosis, "Kurtosis"),
        ] {
            let Some(e) = channel.blocks.estimate(indicator) else {
                continue;
            };
            let unit = if indicator.has_unit() {
                channel.unit
            } else {
                ""
            };
            let note = e.interval.map_or("anti-aliased".to_owned(), |i| {
                format!(
                    "anti-aliased; 95 %: {} to {}",
                    short(i.low, 3),
                    short(i.high, 3)
                )
            });
            facts.push(Fact::new(
                label,
                brinell_report::Value::Text(short(e.value, 3)),
                unit,
                note,
            ));
        }
    }
    for line in &parts.findings.lines {
        let defect = &parts.simulation.model().defects[line.defect];
        let value = line
            .found
            .map_or("not found".to_owned(), |f| format!("{:.2}", f.frequency));
        let note = match line.found {
            Some(f) => format!(
                "{} in the envelope, ± {} Hz; pure rolling {:.2} Hz",
                place(defect),
                short(f.uncertainty, 1),
                line.nominal
            ),
            None => format!("{}; pure rolling {:.2} Hz", place(defect), line.nominal),
        };
        facts.push(Fact::new(
            line.name,
            brinell_report::Value::Text(value),
            "Hz",
            note,
        ));
    }
    if let Ok(zone) = parts.statics {
        facts.push(Fact::new(
            "Heaviest contact, static",
            brinell_report::Value::Text(short(zone.largest, 3)),
            "N",
            format!("load zone {:.0}° wide", zone.extent.to_degrees()),
        ));
    }
    facts
}

fn waveform(parts: &Parts) -> Waveform {
    let f = parts.findings;
    let dt = 1.0 / parts.simulation.sample_rate();
    let (first, values) = f.waveform.latest();
    let t0 = first as f64 * dt;
    let (bins, per_bin) = f.waveform.overview();
    let l = &parts.simulation.model().layout;
    Waveform {
        series: Series {
            label: measured(parts),
            unit: "m/s^2".into(),
            t0_s: t0,
            dt_s: dt,
            values,
        },
        overview: Some(MinMax {
            t0_s: 0.0,
            dt_s: per_bin as f64 * dt,
            min: bins.iter().map(|b| b[0]).collect(),
            max: bins.iter().map(|b| b[1]).collect(),
        }),
        events: f
            .passes
            .events
            .iter()
            .filter(|e| e.t >= t0)
            .map(|e| Event {
                t_s: e.t,
                kind: if e.enters {
                    EventKind::Enter
                } else {
                    EventKind::Leave
                },
                label: format!("{}·{:02}", l.row(e.slot) + 1, l.roller(e.slot) + 1),
            })
            .collect(),
    }
}

fn spectrum(parts: &Parts) -> Spectrum {
    let Some(s) = &parts.findings.spectrum else {
        return Spectrum::default();
    };
    Spectrum {
        label: "Acceleration amplitude".into(),
        df_hz: s.frequency_step,
        amplitude: s.amplitude.clone(),
        unit: "m/s^2".into(),
        note: format!(
            "Measured acceleration along {}, peak amplitude, Hann window, {} of {} samples.",
            axis(parts),
            if s.segments == 1 {
                "one segment".to_owned()
            } else {
                format!("mean of {} segments", s.segments)
            },
            s.segment_length
        ),
    }
}

fn envelope_spectrum(parts: &Parts) -> Spectrum {
    let Some((e, band)) = &parts.findings.envelope else {
        return Spectrum::default();
    };
    Spectrum {
        label: "Envelope amplitude".into(),
        df_hz: e.spectrum.frequency_step,
        amplitude: e.spectrum.amplitude.clone(),
        unit: "m/s^2".into(),
        note: format!(
            "Envelope of the measured acceleration between {:.1} and {:.1} kHz.",
            1e-3 * band.low,
            1e-3 * band.high
        ),
    }
}

/// Defect frequencies at constant speed; at a varying speed there are none to mark.
fn markers(parts: &Parts) -> Vec<Marker> {
    let scenario = &parts.loaded.scenario;
    let Speed::Constant(_) = scenario.operation.speed_rpm else {
        return Vec::new();
    };
    let model = parts.simulation.model();
    let k: Kinematics = model.kinematics(model.rotation.at(0.0).0);
    let damaged: Vec<&str> = scenario
        .defects
        .iter()
        .map(|d| k.struck_by(d.on).0)
        .collect();
    // Strikes first, then what modulates them.
    let shaft = model.rotation.at(0.0).0.abs() / TAU;
    ["BPFO", "BPFI", "2 BSF", "FTF", "shaft"]
        .into_iter()
        .filter_map(|name| k.table(shaft).into_iter().find(|row| row.0 == name))
        .map(|(name, frequency_hz, meaning)| Marker {
            label: name.into(),
            meaning: meaning.into(),
            frequency_hz,
            harmonics: HARMONICS,
            present: damaged.contains(&name),
        })
        .collect()
}

fn pass(parts: &Parts, pass: &Pass) -> brinell_report::Pass {
    let model = parts.simulation.model();
    let l = &model.layout;
    let stride = pass.points.len().div_ceil(PASS_POINTS).max(1);
    let points: Vec<_> = pass.points.iter().step_by(stride).collect();
    let contact = match pass.side {
        Side::Inner => "inner contact",
        Side::Outer => "outer contact",
    };
    brinell_report::Pass {
        title: format!(
            "Roller {} of row {} over defect {} ({})",
            l.roller(pass.slot) + 1,
            l.row(pass.slot) + 1,
            pass.defect + 1,
            place(&model.defects[pass.defect])
        ),
        angle_deg: points.iter().map(|p| p.angle.to_degrees()).collect(),
        length_mm: points.iter().map(|p| 1e3 * p.length).collect(),
        other_length_mm: None,
        stiffness: points.iter().map(|p| p.stiffness).collect(),
        stiffness_unit: if (parts.loaded.scenario.contact.exponent - 10.0 / 9.0).abs() < 1e-9 {
            "N/m^(10/9)".into()
        } else {
            STIFFNESS_UNIT.into()
        },
        force_n: points.iter().map(|p| p.force).collect(),
        contact: contact.into(),
        other_contact: String::new(),
    }
}

fn load_distribution(parts: &Parts) -> Vec<RowLoad> {
    let statics: &[(usize, f64, f64, f64)] = match parts.statics {
        Ok(StaticLoadZone { points, .. }) => points,
        Err(_) => &[],
    };
    let rows = parts.findings.load_zone.rows.iter().enumerate();
    rows.map(|(row, load)| {
        let mut static_points: Vec<(f64, f64)> = statics
            .iter()
            .filter(|p| p.0 == row)
            .map(|p| (p.1.to_degrees(), p.3))
            .collect();
        static_points.sort_by(|a, b| a.0.total_cmp(&b.0));
        RowLoad {
            title: format!("Row {}, outer contact", row + 1),
            angle_deg: brinell_report::bin_centres(load.max.len()),
            mean_n: load.mean(),
            max_n: load.max.clone(),
            static_points,
        }
    })
    .collect()
}

fn indicators(parts: &Parts) -> IndicatorTable {
    let cell = |channel: &ChannelStatistics, indicator: Indicator| {
        let unit = if indicator.has_unit() {
            channel.unit
        } else {
            ""
        };
        match channel.blocks.estimate(indicator) {
            Some(e) => Estimate {
                value: e.value,
                half_width: e.interval.map(|i| 0.5 * (i.high - i.low)),
                unit: unit.into(),
            },
            None => Estimate {
                value: f64::NAN,
                half_width: None,
                unit: unit.into(),
            },
        }
    };
    let mut rows: Vec<IndicatorRow> = parts
        .findings
        .channels
        .iter()
        .filter(|c| c.unit == "m/s^2" && !c.name.starts_with("roller"))
        .map(|c| IndicatorRow {
            channel: c.name.clone(),
            kind: match c.kind {
                Kind::AntiAliased => "measured (anti-aliased)".into(),
                Kind::Instantaneous => "instantaneous".into(),
            },
            cells: COLUMNS.iter().map(|(i, _)| cell(c, *i)).collect(),
        })
        .collect();
    // What a sensor sees comes first.
    rows.sort_by_key(|r| {
        (
            !r.channel.starts_with("measured"),
            r.kind == "instantaneous",
        )
    });
    IndicatorTable {
        columns: COLUMNS.iter().map(|(_, name)| (*name).to_owned()).collect(),
        rows,
        note: format!(
            "From t = {} s on. ± is half the 95 % interval of the mean over blocks of whole revolutions. The anti-alias \
             filter takes away what lies above half the sample rate: instantaneous values hold all of it.",
            short(parts.findings.from, 3)
        ),
    }
}

fn slip(parts: &Parts) -> Vec<Fact> {
    let mut facts = Vec::new();
    let percent = |x: f64| brinell_report::Value::Text(short(100.0 * x, 3));
    for (row, slip) in parts.findings.slip.rows.iter().enumerate() {
        let entries = [
            ("cage", slip.cage(), "behind its pure-rolling speed"),
            (
                "loaded rollers, orbit",
                slip.loaded_orbit(),
                "behind their pure-rolling orbit speed",
            ),
            (
                "loaded rollers, inner contact",
                slip.loaded_surface(),
                "mean |slip| over the raceway's surface speed",
            ),
            (
                "unloaded rollers, orbit",
                slip.unloaded_orbit(),
                "behind their pure-rolling orbit speed",
            ),
        ];
        for (label, value, note) in entries {
            if let Some(value) = value {
                facts.push(Fact::new(
                    format!("Row {}: {label}", row + 1),
                    percent(value),
                    "%",
                    note,
                ));
            }
        }
    }
    facts
}

/// Limits of the audits: beyond them something is wrong with the run.
const MOMENTUM_LIMIT: f64 = 1e-12;
const ENERGY_LIMIT: f64 = 1e-2;

fn audits(parts: &Parts) -> Vec<Fact> {
    let e = &parts.outcome.energy;
    let f = &e.flows;
    let mj = |label: &str, joule: f64, note: &str| {
        Fact::new(
            label,
            brinell_report::Value::Text(short(1e3 * joule, 4)),
            "mJ",
            note,
        )
    };
    let mut facts = Vec::new();
    if let Some(x) = parts.outcome.momentum_imbalance {
        let value = brinell_report::Value::Text(short(x, 2));
        let note =
            "largest force without a reaction, relative to all forces; round-off is about 1e-15";
        facts.push(Fact::new("Momentum imbalance", value, "", note).judged(x < MOMENTUM_LIMIT));
    }
    let relative = e.residual().abs() / e.turnover().max(f64::MIN_POSITIVE);
    facts.push(
        mj(
            "Energy residual",
            e.residual(),
            "change less everything booked: the integrator's error",
        )
        .judged(relative < ENERGY_LIMIT),
    );
    facts.push(mj(
        "Change of energy held",
        e.last.total() - e.initial.total(),
        "kinetic, elastic and gravity",
    ));
    facts.push(mj(
        "Input by the drive",
        f.drive,
        "through the friction of the inner raceway",
    ));
    facts.push(mj("Input by the load", f.load, ""));
    facts.push(mj("Guidance film", f.film, "net work on the bodies"));
    facts.push(mj("Dissipated in contact damping", f.contact, ""));
    facts.push(mj("Dissipated in raceway friction", f.friction, ""));
    facts.push(mj(
        "Dissipated in pockets",
        f.pocket + f.pocket_friction,
        "damping and friction",
    ));
    facts.push(mj("Dissipated in supports", f.support, ""));
    facts.push(mj("Dissipated in drag", f.drag, ""));
    facts.push(mj(
        "Parametric work of defects",
        e.parametric,
        "stiffness that changes under a roller; no body pays for it in the paper's model",
    ));
    facts.push(mj(
        "Centred levers",
        f.lever,
        "contact forces act through the bearing's centre, as in the paper",
    ));
    facts
}

fn solver_work(parts: &Parts) -> Vec<Fact> {
    let w = &parts.outcome.work;
    let count = |label: &str, n: u64, note: &str| {
        Fact::new(label, brinell_report::Value::Text(n.to_string()), "", note)
    };
    let accuracy = match parts.loaded.scenario.simulation.accuracy {
        Accuracy::Standard => "standard",
        Accuracy::Reference => "reference",
    };
    vec![
        Fact::new(
            "Accuracy",
            accuracy,
            "",
            "Bogacki-Shampine 3(2), adaptive, dense output",
        ),
        count("Steps", w.solver.steps, ""),
        count("Rejected steps", w.solver.rejections, ""),
        count("Right-hand sides", w.solver.evaluations, "for steps"),
        count(
            "Right-hand sides for samples",
            w.sample_evaluations,
            "at eight times the sample rate",
        ),
        count("Contacts opened or closed", w.contact_switches, ""),
        count("Pockets opened or closed", w.pocket_switches, ""),
        count("Contacts onto or off damage", w.damage_switches, ""),
    ]
}

fn assumptions(parts: &Parts) -> Vec<Assumption> {
    let mut sheet: Vec<Assumption> = parts
        .loaded
        .provenance
        .iter()
        .map(|p| Assumption {
            key: p.key.clone(),
            value: brinell_report::Value::Text(p.value.clone()),
            unit: p.unit.to_owned(),
            source: p.reason(),
            estimated: p.assumed,
        })
        .collect();
    sheet.sort_by_key(|a| !a.estimated);
    sheet
}
