//! `summary.json`: what a run found, what it cost, what it assumed. SI units unless a key says otherwise.

use crate::accuracy::METHOD;
use crate::channel::Channel;
use crate::defect::{Defect, Defects, SIDES, Side};
use crate::document::{Loaded, Provenance};
use crate::kernel::Kernel;
use crate::model::Model;
use crate::observe::load_zone::BINS;
use crate::observe::slip::RowSlip;
use crate::observe::{Drift, Findings, passes};
use crate::plausibility::{self, Beforehand};
use crate::result::fields::{self, Field};
use crate::scenario::{Accuracy, ModelKind, Scenario, Speed};
use crate::sensor::{Chain, ChannelRecord};
use crate::signal::{self, Estimate, Indicator};
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
            "accuracy": match scenario.simulation.accuracy { Accuracy::Standard => "standard", Accuracy::Reference => "reference" },
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

/// Which sensor channels went beyond the ADC's full scale, or stayed within one of its steps, in words.
#[doc(hidden)]
pub fn converted(simulation: &Simulation, outcome: &Outcome) -> Vec<String> {
    let step = simulation.sensor().and_then(Chain::step).unwrap_or(f64::NAN);
    // Four digits.
    let step: f64 = format!("{step:.3e}").parse().unwrap_or(step);
    let words = |(channel, record): (&Channel, &ChannelRecord)| {
        let (name, rows) = (&channel.name, outcome.rows);
        if record.is_constant() && record.clipped == 0 {
            return Some(format!(
                "all {rows} samples of {name} are one value: the ADC's step of {step} m/s^2 is larger than the signal; give sensor.converter_bits \
                 more bits or a smaller range"
            ));
        }
        (record.clipped > 0).then(|| {
            format!("{} of {rows} samples of {name} are beyond the ADC's range and are clipped", record.clipped)
        })
    };
    simulation.filtered().iter().zip(&outcome.sensor).filter_map(words).collect()
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
    before.map(ToString::to_string).chain(afterwards(&loaded.scenario, simulation, outcome, findings)).collect()
}

/// What a run shows that its reader should know; what kind of warning it is stands before the colon.
#[doc(hidden)]
pub fn afterwards(scenario: &Scenario, simulation: &Simulation, outcome: &Outcome, findings: &Findings) -> Vec<String> {
    [converted(simulation, outcome), unsettled(findings), doubtful(scenario, simulation, outcome, findings)].concat()
}

/// What a run shows that its scenario or the model should not: in words.
#[doc(hidden)]
pub fn doubtful(scenario: &Scenario, simulation: &Simulation, outcome: &Outcome, findings: &Findings) -> Vec<String> {
    let sunk = sunk_too_deep(simulation.model(), findings);
    [strayed(scenario, findings), skidding(scenario, findings), sunk, plausibility::after(scenario, &outcome.energy)]
        .concat()
}

/// Slip of a cage beyond which elements skid rather than roll: bearings whose load drives them slip by a few per cent.
const SKIDDING: f64 = 0.5;

/// Cages that stand still or nearly so while elements are loaded, in words.
fn skidding(scenario: &Scenario, findings: &Findings) -> Vec<String> {
    let words = |(k, row): (usize, &RowSlip)| {
        let (cage, element) = (row.cage()?.value, scenario.bearing.element.word());
        let loaded = row.loaded_surface()?.value;
        (cage > SKIDDING).then(|| {
            format!(
                "skidding: the cage of row {} turned at {:.0} % of its pure-rolling speed on average, and loaded {element}s slipped over {:.0} % of the inner \
                 raceway's way: friction does not drive them. BPFO, BPFI and FTF are far from pure rolling, and raceways would be smeared. Look at \
                 operation.load_n, the friction and lubricant keys (lubricant.drag_coefficient) and the cage's clearances",
                k + 1,
                100.0 * (1.0 - cage),
                100.0 * loaded,
            )
        })
    };
    findings.slip.rows.iter().enumerate().filter_map(words).collect()
}

/// Shares of a damage's depth, and of the deformation (the accuracy of tables), by which a contact may sink deeper than the damage is.
const DEEPER: [f64; 2] = [0.1, 0.01];

/// Elements that sank deeper into damage than it is deep: its table goes on straight beyond its last deformation, as if there were no floor.
/// In words.
fn sunk_too_deep(model: &Model, findings: &Findings) -> Vec<String> {
    if model.tilt.is_some() {
        return Vec::new();
    }
    // Damage near each other is one surface with one table.
    let deepest = |of: &Defect, side: Side| {
        Defects::beside(&model.defects, of, side).iter().map(Defect::deepest).fold(0.0, f64::max)
    };
    let words = |(k, defect): (usize, &Defect)| {
        let (side, table) = SIDES.into_iter().find_map(|side| Some((side, defect.table(side)?)))?;
        let (sunk, depth, last) = (findings.passes.extremes(k)?.sunk, deepest(defect, side), table.last_delta());
        let um = |x: f64| signal::short(1e6 * x, 3);
        (sunk > (1.0 + DEEPER[0]) * depth + DEEPER[1] * last).then(|| {
            format!(
                "sunk too deep: at defect {} contacts yielded by {} um more than healthy ones, and the damage is {} um deep: its table ends at a deformation \
                 of {} um and goes on straight, beneath the floor. Forces there are too small: the load at rest (operation.load_n), which tables are \
                 made for, is far below that of the motion",
                k + 1,
                um(sunk),
                um(depth),
                um(last),
            )
        })
    };
    model.defects.iter().enumerate().filter_map(words).collect()
}

/// Mean distance of a cage from its land's centre, over the clearance, beyond which its stop is too soft: at the
/// defaults cages of small bearings lie 1.0 to 1.1 times the clearance away.
const STRAYED: f64 = 1.2;

/// Cages that push their soft stop far beyond their clearance, in words.
#[doc(hidden)]
pub fn strayed(scenario: &Scenario, findings: &Findings) -> Vec<String> {
    let (orbit, cage) = (&findings.cage_orbit, &scenario.cage);
    let words = |row: usize| {
        let (count, sum) = orbit.points(row).fold((0.0, 0.0), |(n, sum), (_, [x, y])| (n + 1.0, sum + x.hypot(y)));
        let distance = 1e3 * sum / count;
        (distance > STRAYED * cage.guide_clearance_mm).then(|| {
            format!(
                "cage beyond its clearance: the centre of the cage of row {} lay {distance:.3} mm from its land's in its last turns, on average, and \
                 cage.guide_clearance_mm is {:.3}: cage.land_stiffness_n_per_m, {:.1e} N/m, is too soft for its {:.2} kg, and BPFO and slip shift with \
                 it; steel on steel is 1e7, with a cage.land_damping_ns_per_m of 20 to 200, on which the cage strikes, and levels and kurtosis rise",
                row + 1,
                cage.guide_clearance_mm,
                cage.land_stiffness_n_per_m,
                cage.mass_kg,
            )
        })
    };
    (0..orbit.rows()).filter_map(words).collect()
}

/// What had not settled when statistics began, in words.
#[doc(hidden)]
pub fn unsettled(findings: &Findings) -> Vec<String> {
    let change = |x: f64| format!("{:.1} % {}", 100.0 * x.abs(), if x > 0.0 { "higher" } else { "lower" });
    let words = findings.drifts.iter().map(|drift| match drift {
        Drift::CageSlip(row, by) => format!(
            "not settled: the cage of row {} was {:.2} % of its pure-rolling speed {} in the first fifth of the analysed time than in its last half; \
             averages and their intervals hold part of the start: simulate longer",
            row + 1,
            100.0 * by.abs(),
            if *by > 0.0 { "slower" } else { "faster" },
        ),
        Drift::Level(channel, by) => format!(
            "not settled: the RMS of {channel} was {} in the first fifth of the analysed time than in its last half; averages and their intervals \
             hold part of the start: simulate longer",
            change(*by),
        ),
    });
    words.collect()
}

fn assumption(p: &Provenance) -> Value {
    json!({ "key": p.key, "value": p.value, "unit": p.unit, "why": p.reason() })
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
        "meaning": "value, and low to high, its 95 % interval, of averages over whole revolutions of the inner ring; peaks are those of a revolution, record_* those of the whole record",
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
