//! `summary.json`: what a run found, what it cost, what it assumed. SI units unless a key says otherwise.

use crate::accuracy::METHOD;
use crate::document::{Loaded, Provenance};
use crate::kernel::Kernel;
use crate::model::Model;
use crate::observe::load_zone::BINS;
use crate::observe::{Findings, passes};
use crate::plausibility::{Beforehand, after};
use crate::result::fields::{self, Field};
use crate::scenario::{ModelKind, Scenario, Speed};
use crate::signal::{Estimate, Indicator};
use crate::simulate::{End, Outcome, Simulation};
use serde_json::{Map, Value, json};
use std::f64::consts::TAU;

/// Everything that a summary is made of.
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

/// The summary as JSON; the same run gives the same bytes.
pub fn to_json(parts: &Parts) -> Value {
    let Parts { loaded, simulation, outcome, findings, .. } = *parts;
    let scenario = &loaded.scenario;
    let model = simulation.model();
    let mut summary = json!({
        "brinell": crate::VERSION,
        "name": scenario.name,
        "status": status(&outcome.end),
        "simulated": {
            "model": match scenario.simulation.model { ModelKind::Full => "full", ModelKind::Lumped => "lumped", ModelKind::Tilting => "tilting" },
            "accuracy": simulation.accuracy().word(),
            "duration_s": scenario.simulation.duration_s,
            "reached_s": outcome.reached,
            "samples": (fields::SAMPLES.of)(outcome),
            "sample_rate_hz": simulation.sample_rate(),
            "analysed_from_s": (fields::ANALYSED_FROM.of)(findings),
        },
        "laws": laws(scenario),
        "defect_frequencies": frequencies(model, &scenario.operation.speed_rpm),
        "defects": defects(parts),
        "indicators": indicators(findings),
        "slip": slip(findings),
        "load_zone": load_zone(parts),
        "solver": solver(outcome),
        "energy_audit_j": energy(outcome),
        "momentum_audit": { "largest_relative_imbalance": (fields::MOMENTUM_IMBALANCE.of)(outcome) },
        "assumed": loaded.provenance.iter().filter(|p| p.assumed).map(assumption).collect::<Vec<_>>(),
        "warnings": warnings(parts),
    });
    if let Some(sensor) = sensor(parts) {
        summary["sensor"] = sensor;
    }
    if let Some(healthy) = parts.healthy {
        summary["healthy"] = beside(findings, healthy);
    }
    summary
}

/// The set of laws, and the keys that hold something else than it has.
fn laws(scenario: &Scenario) -> Value {
    let in_force = scenario.laws_and_differences();
    let differences = in_force.differences.iter().map(|d| json!({ "key": d.key, "value": d.value, "usual": d.usual }));
    json!({ "set": in_force.laws.word(), "differences": differences.collect::<Vec<_>>() })
}

/// The level beside that of the healthy bearing.
fn beside(findings: &Findings, healthy: &Findings) -> Value {
    let ratio = findings.over_healthy(healthy);
    json!({
        "meaning": "the same scenario without its damage: RMS of the sensor acceleration along the axis that the spectra show, and the damaged bearing's over it",
        "channel": healthy.sensor_name(),
        "unit": "m/s^2",
        "rms": healthy.rms().as_ref().map(estimate),
        "ratio": ratio.map(|r| with_interval(r.value, r.interval)),
    })
}

/// What the sensor did; nothing without one.
fn sensor(parts: &Parts) -> Option<Value> {
    let chain = parts.simulation.sensor()?;
    let noise = chain.noise_rms();
    let channels: Map<String, Value> = parts
        .simulation
        .filtered()
        .iter()
        .zip(&parts.outcome.sensor)
        .map(|(channel, record)| {
            let entry = json!({
                "unit": channel.unit,
                "signal_rms_m_per_s2": record.signal_rms(),
                "noise_rms_m_per_s2": record.noise_rms().filter(|_| noise.is_some()),
                "signal_to_noise_db": record.signal_to_noise_db(),
                "clipped_samples": record.clipped,
            });
            (channel.name.clone(), entry)
        })
        .collect();
    Some(json!({
        "meaning": "signal_rms, noise_rms: before noise and ADC, and of the noise added, from analysed_from_s on; noise_rms_m_per_s2 above the channels is the level asked for; clipped_samples: of all samples",
        "noise_rms_m_per_s2": noise,
        "converter_step_m_per_s2": chain.step(),
        "channels": channels,
    }))
}

/// Words for how a run ended.
#[doc(hidden)]
pub fn status(end: &End) -> Value {
    match end {
        End::Complete => json!({ "complete": true }),
        End::Stopped => json!({ "complete": false, "reason": "stopped before its duration" }),
        End::Failed(error) => json!({ "complete": false, "reason": error.to_string() }),
    }
}

/// What the run's reader should know, warnings of the scenario first.
#[doc(hidden)]
pub fn warnings(parts: &Parts) -> Vec<String> {
    let Parts { loaded, simulation, outcome, findings, beforehand, .. } = *parts;
    let before = loaded.warnings.iter().chain(&beforehand.warnings);
    before.map(ToString::to_string).chain(after(&loaded.scenario, simulation, outcome, findings)).collect()
}

fn assumption(p: &Provenance) -> Value {
    json!({ "key": p.key, "value": p.value, "unit": p.unit, "why": p.reason(), "plausible": p.plausible })
}

fn frequencies(model: &Model, speed: &Speed) -> Value {
    let per_turn = model.kinematics(TAU);
    let orders = json!({
        "ftf": per_turn.ftf, "bpfo": per_turn.bpfo, "bpfi": per_turn.bpfi, "bsf": per_turn.bsf, "2bsf": 2.0 * per_turn.bsf,
    });
    match speed {
        Speed::Constant(rpm) => {
            let k = model.kinematics(model.rotation.at(0.0).0);
            json!({
                "hz": {
                    "shaft": rpm.abs() / 60.0, "ftf": k.ftf, "bpfo": k.bpfo, "bpfi": k.bpfi, "bsf": k.bsf, "2bsf": 2.0 * k.bsf,
                },
                "per_shaft_turn": orders,
            })
        }
        Speed::Profile(_) => json!({ "hz": null, "per_shaft_turn": orders }),
    }
}

fn defects(parts: &Parts) -> Value {
    let model = parts.simulation.model();
    let defects = model.defects.iter().enumerate().map(|(index, d)| {
        let (first, last) = d.shape.arc();
        let line = parts.findings.lines.iter().find(|l| l.defect == index);
        json!({
            "at": passes::place(d),
            "center_deg": d.center.to_degrees(),
            "length_mm": 1e3 * (last - first),
            "area_mm2": 1e6 * d.shape.area(),
            "arc_deg": ((last - first) / d.radius).to_degrees(),
            "frequency": line.map(|l| json!({
                "name": l.name,
                "pure_rolling_hz": l.nominal,
                "found_hz": l.found.map(|f| f.frequency),
                "too_short": l.too_short,
                "low_hz": l.interval.map(|i| i.low),
                "high_hz": l.interval.map(|i| i.high),
                "uncertainty_hz": l.interval.map(|i| i.standard_uncertainty()),
                "resolution_hz": l.found.map(|f| f.resolution),
            })),
        })
    });
    defects.collect()
}

fn estimate(e: &Estimate) -> Value {
    with_interval(e.value, e.interval.map(|i| (i.low, i.high)))
}

/// A number and the 95 % interval of its long-run value, as every file of results has it.
#[doc(hidden)]
pub fn with_interval(value: impl Into<Option<f64>>, interval: Option<(f64, f64)>) -> Value {
    let value = value.into();
    match interval {
        Some((low, high)) => json!({ "value": value, "low": low, "high": high }),
        None => json!({ "value": value }),
    }
}

fn indicators(findings: &Findings) -> Value {
    let mut channels = Map::new();
    for channel in &findings.channels {
        let mut values: Map<String, Value> = Indicator::ALL
            .into_iter()
            .filter_map(|i| Some((i.name().to_owned(), estimate(&channel.blocks.estimate(i)?))))
            .collect();
        let record = channel.blocks.record();
        for field in fields::record(channel.unit) {
            values.extend(record.get(field.of).map(|x| (field.name.to_owned(), x.into())));
        }
        let entry = channels.entry(channel.name.clone()).or_insert_with(|| json!({ "unit": channel.unit }));
        entry[channel.kind.name()] = values.into();
    }
    json!({
        "meaning": "value, and low to high, its 95 % interval, scatter only: what is assumed is not in it; of averages over whole revolutions of the inner ring; peaks are those of a revolution, record_* those of the whole record",
        "revolutions": (fields::ANALYSED_TURNS.of)(findings) as u64,
        "channels": channels,
    })
}

fn slip(findings: &Findings) -> Value {
    let rows = findings.slip.rows.iter().map(|row| {
        let mut values = Map::new();
        let mut intervals = Map::new();
        for (name, field) in [
            ("cage", fields::CAGE_SLIP),
            ("loaded_rollers_orbit", fields::LOADED_ORBIT_SLIP),
            ("loaded_rollers_surface", fields::LOADED_SURFACE_SLIP),
            ("unloaded_rollers_orbit", fields::UNLOADED_ORBIT_SLIP),
        ] {
            let estimate = (field.of)(row);
            let interval = estimate.and_then(|e| e.interval);
            values.insert(name.into(), json!(estimate.map(|e| e.value)));
            intervals.insert(name.into(), json!(interval.map(|i| [i.low, i.high])));
        }
        values.insert("intervals_95".into(), intervals.into());
        Value::from(values)
    });
    json!({
        "meaning": "shares of the way in pure rolling, over whole turns of the analysed time; a roller is loaded where both raceways press it",
        "rows": rows.collect::<Vec<_>>(),
    })
}

fn load_zone(parts: &Parts) -> Value {
    let rows = parts.findings.load_zone.rows.iter().map(|row| json!({ "mean_n": row.mean(), "max_n": row.max }));
    let centers: Vec<f64> = (0..BINS).map(|k| (k as f64 + 0.5) * 360.0 / BINS as f64).collect();
    let statics = parts.beforehand.statics.as_ref().ok().map(|z| {
        json!({
            "largest_contact_force_n": z.largest,
            "extent_deg": z.extent.to_degrees(),
            "shift_inner_to_outer_um": z.shift.map(|x| 1e6 * x),
            "stiffness_n_per_m": z.stiffness,
            "support_force_n": z.support,
            "sunk_um": 1e6 * z.sunk,
        })
    });
    json!({ "static": statics, "bin_centers_deg": centers, "outer_contacts_by_row": rows.collect::<Vec<_>>() })
}

fn solver(outcome: &Outcome) -> Value {
    let count = |field: Field<fn(&Outcome) -> u64>| (field.of)(outcome);
    json!({
        "method": METHOD,
        "kernel": Kernel::in_use().name(),
        "steps": count(fields::STEPS),
        "rejections": count(fields::REJECTIONS),
        "right_hand_sides": count(fields::RIGHT_HAND_SIDES),
        "right_hand_sides_for_samples": count(fields::SAMPLE_RIGHT_HAND_SIDES),
        "force_switches": {
            "contacts": count(fields::CONTACT_SWITCHES), "pockets": count(fields::POCKET_SWITCHES), "defect_edges": count(fields::DAMAGE_SWITCHES),
        },
    })
}

fn energy(outcome: &Outcome) -> Value {
    let e = &outcome.energy;
    let f = &e.flows;
    let held = |e: &crate::model::Energy| {
        json!({
            "kinetic": e.kinetic, "contacts": e.contacts, "cage_contacts": e.cage, "supports": e.supports, "gravity": e.gravity,
        })
    };
    json!({
        "held_at_start": held(&e.initial),
        "held_at_end": held(&e.last),
        "input": { "drive": f.drive, "load": f.load, "guidance_film": f.film },
        "dissipated": {
            "contact_damping": f.contact, "raceway_friction": f.friction, "rolling_resistance": f.rolling, "pocket_damping": f.pocket,
            "pocket_friction": f.pocket_friction, "land_damping": f.land, "supports": f.support, "drag": f.drag,
        },
        "parametric_work_of_defects": (fields::PARAMETRIC_ENERGY.of)(outcome),
        "centred_levers": f.lever,
        "residual": (fields::ENERGY_RESIDUAL.of)(outcome),
        "residual_over_turnover": (fields::RELATIVE_RESIDUAL.of)(outcome),
    })
}
