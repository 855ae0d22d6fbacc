//! `summary.json`: what a run found, what it cost, what it assumed. SI units unless a key says otherwise.

use crate::accuracy::METHOD;
use crate::bearing::kinematics::Kinematics;
use crate::document::{Difference, Provenance};
use crate::kernel::Kernel;
use crate::made_by::MadeBy;
use crate::model::{self, Model};
use crate::observe::load_zone::{BINS, RowLoad};
use crate::observe::{Findings, passes};
use crate::result::{Parts, Quantity, by_name, fields, quantities};
use crate::scenario::{Choice, Scenario, Speed};
use crate::signal::Estimate;
use crate::signal::ratio::Ratio;
use crate::simulate::{End, Outcome};
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Version of the form of `summary.json`; one where a key was taken away or means something else.
pub const FORM: u32 = 2;

/// The file, in its order.
#[derive(Debug, Serialize, JsonSchema)]
struct Summary<'a> {
    form: u32,
    brinell: &'static str,
    made_by: MadeBy,
    name: &'a str,
    status: Status,
    simulated: Simulated,
    laws: Laws,
    defect_frequencies: Frequencies,
    defects: Vec<DefectPlace>,
    /// By name, as in `sweep.csv`, data sets and Python.
    #[schemars(schema_with = "numbers")]
    quantities: Map<String, Value>,
    load_zone: LoadZone,
    solver: Solver,
    energy_audit_j: EnergyAudit,
    assumed: Vec<Assumption<'a>>,
    warnings: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sensor: Option<Sensor>,
    #[serde(skip_serializing_if = "Option::is_none")]
    healthy: Option<Healthy>,
}

/// The summary as JSON; the same run gives the same bytes, but for the date.
pub fn to_json(parts: &Parts) -> Value {
    let Parts { loaded, simulation, outcome, findings, .. } = *parts;
    let scenario = &loaded.scenario;
    let summary = Summary {
        form: FORM,
        brinell: crate::VERSION,
        made_by: MadeBy::of_scenario(&loaded.to_toml()),
        name: &scenario.name,
        status: status(&outcome.end),
        simulated: Simulated {
            model: scenario.simulation.model.word(),
            accuracy: simulation.accuracy().word(),
            duration_s: scenario.simulation.duration_s,
            sample_rate_hz: simulation.sample_rate(),
        },
        laws: laws(scenario),
        defect_frequencies: frequencies(simulation.model(), &scenario.operation.speed_rpm),
        defects: defects(parts),
        quantities: by_name(&quantities(scenario, simulation, outcome, findings)),
        load_zone: load_zone(parts),
        solver: Solver { method: METHOD, kernel: Kernel::in_use().name() },
        energy_audit_j: energy(outcome),
        assumed: loaded.provenance.iter().filter(|p| p.assumed).map(assumption).collect(),
        warnings: parts.warnings(),
        sensor: sensor(parts),
        healthy: parts.healthy.map(|healthy| beside(findings, healthy)),
    };
    serde_json::to_value(summary).unwrap_or_default()
}

/// The schema of [`to_json`].
pub fn json_schema() -> Value {
    schemars::schema_for!(Summary).to_value()
}

/// Every number that a run may have, by the form of its name.
fn numbers(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let of = generator.subschema_for::<Quantity>();
    let forms = fields::forms().map(|(form, unit, meaning)| {
        let mut schema = serde_json::json!({ "allOf": [of], "description": meaning });
        if let Some(unit) = unit {
            schema["properties"] = serde_json::json!({ "unit": { "const": unit } });
        }
        (form, schema)
    });
    let forms: Map<String, Value> = forms.collect();
    schemars::json_schema!({ "type": "object", "patternProperties": forms, "additionalProperties": false })
}

/// How a run ended.
#[derive(Debug, Serialize, JsonSchema)]
struct Status {
    complete: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
}

/// Words for how a run ended.
fn status(end: &End) -> Status {
    let reason = match end {
        End::Complete => None,
        End::Stopped => Some("stopped before its duration".into()),
        End::Failed(error) => Some(error.to_string()),
    };
    Status { complete: reason.is_none(), reason }
}

#[derive(Debug, Serialize, JsonSchema)]
struct Simulated {
    model: &'static str,
    accuracy: &'static str,
    duration_s: f64,
    sample_rate_hz: f64,
}

/// The set of laws, and the keys that hold something else than it has.
#[derive(Debug, Serialize, JsonSchema)]
struct Laws {
    set: &'static str,
    differences: Vec<Difference>,
}

fn laws(scenario: &Scenario) -> Laws {
    let in_force = scenario.laws_and_differences();
    Laws { set: in_force.laws.word(), differences: in_force.differences }
}

/// Of pure rolling.
#[derive(Debug, Serialize, JsonSchema)]
struct Frequencies {
    /// Of the shaft and of each part; none where the speed varies.
    hz: Option<Orders>,
    per_shaft_turn: Orders,
}

#[derive(Debug, Serialize, JsonSchema)]
struct Orders {
    #[serde(skip_serializing_if = "Option::is_none")]
    shaft: Option<f64>,
    ftf: f64,
    bpfo: f64,
    bpfi: f64,
    bsf: f64,
    #[serde(rename = "2bsf")]
    twice_bsf: f64,
}

fn frequencies(model: &Model, speed: &Speed) -> Frequencies {
    let of = |k: Kinematics, shaft: Option<f64>| Orders {
        shaft,
        ftf: k.ftf,
        bpfo: k.bpfo,
        bpfi: k.bpfi,
        bsf: k.bsf,
        twice_bsf: 2.0 * k.bsf,
    };
    let hz = speed.constant().map(|rpm| of(model.kinematics(model.rotation.at(0.0).0), Some(rpm.abs() / 60.0)));
    Frequencies { hz, per_shaft_turn: of(model.kinematics(TAU), None) }
}

/// Where a defect is, how large, and what its line in the envelope is called; what was found of it is under `defectN.` of the
/// quantities.
#[derive(Debug, Serialize, JsonSchema)]
struct DefectPlace {
    at: String,
    on: &'static str,
    row: usize,
    center_deg: f64,
    length_mm: f64,
    area_mm2: f64,
    arc_deg: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<Line>,
}

#[derive(Debug, Serialize, JsonSchema)]
struct Line {
    name: &'static str,
    resolution_hz: Option<f64>,
    too_short: Option<String>,
}

fn defects(parts: &Parts) -> Vec<DefectPlace> {
    let model = parts.simulation.model();
    let stated = &parts.loaded.scenario.defects;
    let defects = model.defects.iter().zip(stated).enumerate().map(|(index, (d, of))| {
        let (first, last) = d.shape.arc();
        let line = parts.findings.lines.iter().find(|l| l.defect == index);
        DefectPlace {
            at: passes::place(d),
            on: of.on.word(),
            row: of.row,
            center_deg: d.center.to_degrees(),
            length_mm: 1e3 * (last - first),
            area_mm2: 1e6 * d.area(),
            arc_deg: ((last - first) / d.radius).to_degrees(),
            line: line.map(|l| Line {
                name: l.name,
                resolution_hz: l.found.map(|f| f.resolution),
                too_short: l.too_short.clone(),
            }),
        }
    });
    defects.collect()
}

/// Force of the outer contacts over the place in the bearing.
#[derive(Debug, Serialize, JsonSchema)]
struct LoadZone {
    r#static: Option<StaticBalance>,
    bin_centers_deg: Vec<f64>,
    outer_contacts_by_row: Vec<RowForces>,
}

#[derive(Debug, Serialize, JsonSchema)]
struct StaticBalance {
    largest_contact_force_n: f64,
    extent_deg: f64,
    shift_inner_to_outer_um: [f64; 2],
    stiffness_n_per_m: [[f64; 2]; 2],
    support_force_n: f64,
    sunk_um: f64,
}

#[derive(Debug, Serialize, JsonSchema)]
struct RowForces {
    mean_n: Vec<f64>,
    max_n: Vec<f64>,
}

fn load_zone(parts: &Parts) -> LoadZone {
    let of_row = |row: &RowLoad| RowForces { mean_n: row.mean(), max_n: row.max.clone() };
    LoadZone {
        r#static: parts.beforehand.statics.as_ref().ok().map(|z| StaticBalance {
            largest_contact_force_n: z.largest,
            extent_deg: z.extent.to_degrees(),
            shift_inner_to_outer_um: z.shift.map(|x| 1e6 * x),
            stiffness_n_per_m: z.stiffness,
            support_force_n: z.support,
            sunk_um: 1e6 * z.sunk,
        }),
        bin_centers_deg: (0..BINS).map(|k| (k as f64 + 0.5) * 360.0 / BINS as f64).collect(),
        outer_contacts_by_row: parts.findings.load_zone.rows.iter().map(of_row).collect(),
    }
}

#[derive(Debug, Serialize, JsonSchema)]
struct Solver {
    method: &'static str,
    kernel: &'static str,
}

/// Every entry of the audit; what is left is the quantity `audit.energy_residual`.
#[derive(Debug, Serialize, JsonSchema)]
struct EnergyAudit {
    held_at_start: Held,
    held_at_end: Held,
    input: Input,
    dissipated: Dissipated,
    parametric_work_of_defects: f64,
    centred_levers: f64,
}

#[derive(Debug, Serialize, JsonSchema)]
struct Held {
    kinetic: f64,
    contacts: f64,
    cage_contacts: f64,
    supports: f64,
    gravity: f64,
}

fn held(e: &model::Energy) -> Held {
    Held { kinetic: e.kinetic, contacts: e.contacts, cage_contacts: e.cage, supports: e.supports, gravity: e.gravity }
}

#[derive(Debug, Serialize, JsonSchema)]
struct Input {
    drive: f64,
    load: f64,
    guidance_film: f64,
}

#[derive(Debug, Serialize, JsonSchema)]
struct Dissipated {
    contact_damping: f64,
    raceway_friction: f64,
    rolling_resistance: f64,
    pocket_damping: f64,
    pocket_friction: f64,
    land_damping: f64,
    supports: f64,
    drag: f64,
}

fn energy(outcome: &Outcome) -> EnergyAudit {
    let e = &outcome.energy;
    let f = &e.flows;
    EnergyAudit {
        held_at_start: held(&e.initial),
        held_at_end: held(&e.last),
        input: Input { drive: f.drive, load: f.load, guidance_film: f.film },
        dissipated: Dissipated {
            contact_damping: f.contact,
            raceway_friction: f.friction,
            rolling_resistance: f.rolling,
            pocket_damping: f.pocket,
            pocket_friction: f.pocket_friction,
            land_damping: f.land,
            supports: f.support,
            drag: f.drag,
        },
        parametric_work_of_defects: e.parametric,
        centred_levers: f.lever,
    }
}

/// A value that no source states.
#[derive(Debug, Serialize, JsonSchema)]
struct Assumption<'a> {
    key: &'a str,
    value: &'a str,
    unit: &'static str,
    why: String,
    plausible: Option<[f64; 2]>,
}

fn assumption(p: &Provenance) -> Assumption<'_> {
    Assumption { key: &p.key, value: &p.value, unit: p.unit, why: p.reason(), plausible: p.plausible }
}

/// What the sensor did: of the signal before noise and ADC, and of the noise added, from `analysed_from` on; clipped samples of the
/// whole record.
#[derive(Debug, Serialize, JsonSchema)]
struct Sensor {
    /// The level asked for.
    noise_rms_m_per_s2: Option<f64>,
    converter_step_m_per_s2: Option<f64>,
    channels: BTreeMap<String, SensorChannel>,
}

#[derive(Debug, Serialize, JsonSchema)]
struct SensorChannel {
    unit: &'static str,
    signal_rms_m_per_s2: Option<f64>,
    noise_rms_m_per_s2: Option<f64>,
    signal_to_noise_db: Option<f64>,
    clipped_samples: u64,
}

fn sensor(parts: &Parts) -> Option<Sensor> {
    let chain = parts.simulation.sensor()?;
    let noise = chain.noise_rms();
    let channels = parts.simulation.filtered().iter().zip(&parts.outcome.sensor).map(|(channel, record)| {
        let of = SensorChannel {
            unit: channel.unit,
            signal_rms_m_per_s2: record.signal_rms(),
            noise_rms_m_per_s2: record.noise_rms().filter(|_| noise.is_some()),
            signal_to_noise_db: record.signal_to_noise_db(),
            clipped_samples: record.clipped,
        };
        (channel.name.clone(), of)
    });
    Some(Sensor { noise_rms_m_per_s2: noise, converter_step_m_per_s2: chain.step(), channels: channels.collect() })
}

/// The level beside that of the same scenario without its damage: RMS of the sensor acceleration along the axis that the spectra
/// show, and that of the damaged bearing over it.
#[derive(Debug, Serialize, JsonSchema)]
struct Healthy {
    channel: String,
    unit: &'static str,
    rms: Option<Estimate>,
    ratio: Option<Ratio>,
}

fn beside(findings: &Findings, healthy: &Findings) -> Healthy {
    Healthy {
        channel: healthy.sensor.clone(),
        unit: "m/s^2",
        rms: healthy.rms(),
        ratio: findings.over_healthy(healthy),
    }
}
