//! What follows from a scenario, as JSON: `brinell check --json` and Python's `derived`.

use super::machine::rpm;
use super::{Derived, DerivedBearing, DerivedMachine};
use crate::bearing::rating::static_rating;
use crate::coefficients::Coefficients;
use crate::lamina::{Distribution, Peak, Rating};
use crate::machine::{Mode, Whirl};
use crate::model::Model;
use crate::plausibility::before;
use crate::pressure::{pressures, static_limit};
use crate::scenario::Scenario;
use crate::statics::StaticLoadZone;
use serde_json::{Map, Value, json};
use std::f64::consts::TAU;

/// Units are in the names. `slices` is `null` where contacts have none; of a static balance that does not exist the
/// warnings tell.
pub fn to_json(s: &Scenario, model: &Model, d: &Derived) -> Value {
    // Without a balance, of the force that there is.
    let pressures = pressures(s, d.statics.as_ref().map_or([d.contact_force; 2], StaticLoadZone::heaviest));
    let warnings = before(s, model, &d.statics);
    let warnings: Vec<String> = warnings.iter().map(ToString::to_string).collect();
    let rating = match &d.statics {
        Ok(_) => Rating::unchecked(s).ok().flatten(),
        Err(_) => None,
    };
    json!({
        "top_speed_rpm": d.top_speed * 60.0 / TAU,
        "frequencies_hz": frequencies(d.kinematics.table(d.top_speed / TAU)),
        "contact_force_n": d.contact_force,
        "inner_contact_stiffness_n_per_m": d.contact_stiffness[0],
        "outer_contact_stiffness_n_per_m": d.contact_stiffness[1],
        "roller_frequency_hz": d.roller_frequency,
        "roller_damping_ratio": d.roller_damping_ratio,
        "inner_support_frequency_hz": d.support_frequencies[0],
        "outer_support_frequency_hz": d.support_frequencies[1],
        "centrifugal_force_n": d.centrifugal_force,
        "roller_period_s": d.roller_period,
        "defect_passes_s": d.defect_passes,
        "longest_step_s": d.longest_step,
        "load_zone": d.statics.as_ref().ok().map(load_zone),
        "support_force_n": d.statics.as_ref().ok().map(|zone| zone.support),
        "sunk_um": d.statics.as_ref().ok().map(|zone| 1e6 * zone.sunk),
        "load_n": model.force_on_loaded_ring(),
        "inner_contact_pressure_mpa": 1e-6 * pressures[0],
        "outer_contact_pressure_mpa": 1e-6 * pressures[1],
        "static_limit_mpa": 1e-6 * static_limit(&s.bearing),
        "static_load_rating_n": static_rating(&s.bearing).load,
        "slices": rating.map(|rating| in_slices(&rating)),
        "warnings": warnings,
    })
}

/// The same of a machine: each bearing as on its own under the load that it carries, and what it carries; natural frequencies at the top speed and
/// critical speeds.
pub fn machine_to_json(scenario: &Scenario, of: &DerivedMachine) -> Value {
    let bearing = |one: &DerivedBearing| {
        let mut json = to_json(&one.scenario, &one.model, &one.derived);
        // Of a machine's channels and loads its own warnings tell.
        json.as_object_mut().and_then(|of| of.remove("warnings"));
        json["force_n"] = json!(one.carried.force);
        json["moment_nm"] = json!(one.carried.moment);
        json["misalignment_mrad"] = json!(one.carried.misalignment.map(|slope| 1e3 * slope));
        let Coefficients { stiffness, damping, .. } = one.coefficients(of.top_speed);
        json["stiffness_n_per_m"] = json!(stiffness);
        json["damping_ns_per_m"] = json!(damping);
        json
    };
    let mode = |mode: Mode| json!({ "frequency_hz": mode.frequency, "damping_ratio": mode.damping_ratio, "whirl": mode.whirl.word() });
    let critical = |(speed, whirl): (f64, Whirl)| json!({ "speed_rpm": rpm(speed), "whirl": whirl.word() });
    json!({
        "name": scenario.name,
        "top_speed_rpm": rpm(of.top_speed),
        "shaft_weight_n": of.weight,
        "bearings": of.bearings.iter().map(bearing).collect::<Vec<_>>(),
        "modes": of.modes(of.top_speed).into_iter().map(mode).collect::<Vec<_>>(),
        "critical_speeds": of.critical_speeds().into_iter().map(critical).collect::<Vec<_>>(),
    })
}

/// What [`StaticLoadZone`] sums up, as `brinell check` prints it; the ends are counter-clockwise from +x.
fn load_zone(zone: &StaticLoadZone) -> Value {
    let ends = zone.arc().map(f64::to_degrees);
    json!({
        "largest_contact_force_n": zone.largest,
        "extent_deg": zone.extent.to_degrees(),
        "ends_deg": (zone.extent > 0.0).then_some(ends),
        "shift_inner_to_outer_um": zone.shift.map(|x| 1e6 * x),
        "stiffness_n_per_m": zone.stiffness,
    })
}

/// Frequencies by names in lower case without spaces: `bpfo`, `2bsf`.
pub fn frequencies(rows: [(&str, f64, &str); 6]) -> Map<String, Value> {
    let rows = rows.into_iter();
    rows.map(|(name, hz, _)| (name.to_lowercase().replace(' ', ""), hz.into())).collect()
}

/// Load, stiffness and life by ISO/TS 16281.
fn in_slices(rating: &Rating) -> Value {
    let scaled = |by: f64, values: &[f64]| values.iter().map(|x| by * x).collect::<Vec<f64>>();
    json!({
        "z_mm": scaled(1e3, &rating.distribution.z),
        "profile_drop_um": scaled(1e6, &rating.distribution.drop),
        "healthy": distribution(&rating.distribution),
        "life_revolutions": rating.life,
    })
}

/// The stiffness is over (x, y, tau_x, tau_y): N/m, N/rad, N m/rad.
fn distribution(d: &Distribution) -> Value {
    json!({
        "largest": d.peak().map(peak),
        "end_slices": d.end_peak().map(peak),
        "inner_from_outer_tilt_urad": d.tilt.map(|tau| 1e6 * tau),
        "largest_roller_tilt_urad": 1e6 * d.roller_tilt,
        "stiffness": d.stiffness,
    })
}

fn peak(peak: Peak) -> Value {
    json!({
        "pressure_mpa": 1e-6 * peak.pressure,
        "raceway": peak.side.word(),
        "row": peak.row + 1,
        "angle_deg": peak.angle.to_degrees(),
        "z_mm": 1e3 * peak.z,
    })
}
