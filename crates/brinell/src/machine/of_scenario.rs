//! The plan of the machine that a scenario describes.

use super::plan::{Housing, HousingMode, OnShaft, Plan, PlanError, Shaft};
use super::{Machine, Material, Part, Spring};
use crate::analysis::STANDARD_GRAVITY;
use crate::document::Problem;
use crate::error::Error;
use crate::model::{Model, Support};
use crate::scenario::{self, HousingModes, Scenario, SensorOn};
use brinell_shaft::normal_modes;
use std::f64::consts::TAU;

/// The machine of a scenario that has one, and the models of its bearings in the file's order.
///
/// # Errors
/// Where it makes none: [`Scenario::problems`](crate::Scenario::problems) says so too.
pub(crate) fn machine(of: &scenario::Machine, models: Vec<Model>) -> Result<Machine, Error> {
    if let Some(k) = of.housings.iter().position(|housing| matches!(housing.modes, Some(HousingModes::File(_)))) {
        let message = "the file with its modes has not been read";
        return Err(vec![Problem::error(format!("housing.{k}.modes"), message)].into());
    }
    plan(of, models).machine().map_err(|error: PlanError| vec![Problem::error("shaft", error.to_string())].into())
}

/// Fastest mode of a housing's matrices that is kept, Hz.
const FASTEST_HZ: f64 = 2e4;

/// The bearings of a scenario's machine as they are to be made models of: each alone, with the load on its inner ring that it carries in balance,
/// unbalance at the top speed on top, for which tables of damage are made; and with waves of its own. The load is not to act again:
/// [`unloaded`].
pub(crate) fn bearings(scenario: &Scenario, of: &scenario::Machine) -> Result<Vec<Scenario>, Error> {
    let mut alone = scenario.bearings();
    for (k, bearing) in alone.iter_mut().enumerate() {
        bearing.simulation.seed = bearing.simulation.seed.wrapping_add(WAVES_APART.wrapping_mul(k as u64));
    }
    if alone.iter().all(|bearing| bearing.defects.is_empty()) {
        return Ok(alone);
    }
    let planned = alone.iter().map(Model::planned).collect::<Result<Vec<_>, _>>()?;
    let top_speed = planned[0].rotation.max_speed();
    let whirling: f64 = of.shaft.unbalance.iter().map(|u| 1e-6 * u.size_g_mm * top_speed * top_speed).sum();
    let made = machine(of, planned)?;
    let gravity = scenario.operation.gravity_m_per_s2;
    let carried: Vec<[f64; 2]> = match made.balance() {
        Ok(balance) => balance.bearings.iter().map(|carried| carried.force).collect(),
        // All of it, to be sure: a run says what it finds.
        Err(_) => {
            let weight = made.shaft_weight() / STANDARD_GRAVITY;
            let sum =
                |axis: usize| of.shaft.load.iter().map(|load| load.force_n[axis]).sum::<f64>() + weight * gravity[axis];
            vec![[sum(0), sum(1)]; alone.len()]
        }
    };
    for (bearing, [x, y]) in alone.iter_mut().zip(carried) {
        let size = x.hypot(y);
        bearing.operation.load_n =
            if size > 0.0 { [x, y].map(|f| f * (1.0 + whirling / size)) } else { [0.0, -whirling] };
    }
    Ok(alone)
}

/// A model without the load that it was made for.
pub(crate) fn unloaded(mut model: Model) -> Model {
    model.load.full = [0.0; 2];
    model
}

/// What the seeds of waves differ by from bearing to bearing.
const WAVES_APART: u64 = 0x9E37_79B9_7F4A_7C15;

/// What `machine` makes it of.
pub(crate) fn plan(of: &scenario::Machine, models: Vec<Model>) -> Plan {
    let s = &of.shaft;
    let first = s.stations_mm.first().copied().unwrap_or(0.0);
    // Sums of parts have a last digit of their own.
    let length: f64 = s.stations_mm.windows(2).map(|ends| 1e-3 * (ends[1] - ends[0])).sum();
    let at = |mm: f64| {
        let z = 1e-3 * (mm - first);
        if (z - length).abs() < 1e-9 { length } else { z }
    };
    let bore = |k: usize| s.bores_mm.as_ref().and_then(|bores| bores.get(k)).map_or(0.0, |mm| 1e-3 * mm);
    let parts = s.stations_mm.windows(2).zip(&s.diameters_mm).enumerate();
    let parts = parts.map(|(k, (ends, diameter))| Part {
        length: 1e-3 * (ends[1] - ends[0]),
        outer_diameter: 1e-3 * diameter,
        inner_diameter: bore(k),
    });
    let material = Material {
        youngs_modulus: 1e9 * s.youngs_modulus_gpa,
        shear_modulus: 1e9 * s.shear_modulus_gpa,
        density: s.density_kg_per_m3,
    };
    let disc = |disc: &scenario::Disc| brinell_shaft::Disc {
        at: at(disc.at_mm),
        mass: disc.mass_kg,
        diametral_inertia: disc.diametral_inertia_kg_m2,
        polar_inertia: disc.polar_inertia_kg_m2,
    };
    let spring = |c: &scenario::Coupling| Spring {
        at: at(c.at_mm),
        radial: c.radial_stiffness_n_per_m,
        tilt: c.tilt_stiffness_nm_per_rad,
    };
    let sensor = |of: &scenario::Accelerometer| (of.name.clone(), at(of.at_mm), of.direction_deg.to_radians());
    let on_shaft = of.sensors.iter().filter(|of| of.on == SensorOn::Shaft).map(sensor);
    let shaft = Shaft {
        parts: parts.collect(),
        discs: s.disc.iter().map(disc).collect(),
        couplings: s.coupling.iter().map(spring).collect(),
        loads: s.load.iter().map(|load| (at(load.at_mm), load.force_n)).collect(),
        unbalances: s.unbalance.iter().map(|u| (at(u.at_mm), 1e-6 * u.size_g_mm, u.angle_deg.to_radians())).collect(),
        looked_at: s.stations_mm.iter().enumerate().map(|(k, z)| ((k + 1).to_string(), at(*z))).collect(),
        sensors: on_shaft.collect(),
        material,
        band: s.band_hz,
        damping_ratio: s.damping_ratio,
        is_rigid: s.rigid,
    };
    let housing = |(k, h): (usize, &scenario::MachineHousing)| Housing {
        at: at(h.at_mm),
        mass: h.mass_kg,
        inertia: h.inertia_kg_m2,
        support: Support { stiffness: h.stiffness_n_per_m, damping: h.damping_ns_per_m },
        tilt_support: Support { stiffness: h.tilt_stiffness_nm_per_rad, damping: h.tilt_damping_nms_per_rad },
        sensors: of.sensors_on(k).map(sensor).collect(),
        modes: modes_of(h, of.bearings_in(k).len(), of.sensors_on(k).count()),
    };
    let bearing = |(seat, model): (&scenario::Seat, Model)| OnShaft {
        model,
        at: at(seat.at_mm),
        housing: of.housing_of(seat.housing),
        offset: seat.offset_um.map(|um| 1e-6 * um),
        misalignment: seat.misalignment_mrad.map(|mrad| 1e-3 * mrad),
        fit: seat.fit_stiffness_n_per_m.map(|stiffness| Support { stiffness, damping: seat.fit_damping_ns_per_m }),
    };
    Plan {
        shaft,
        bearings: of.seats.iter().zip(models).map(bearing).collect(),
        housings: of.housings.iter().enumerate().map(housing).collect(),
    }
}

/// Modes of a housing, those of its matrices up to the fastest that a run follows; none of a rigid one.
fn modes_of(housing: &scenario::MachineHousing, seats: usize, sensors: usize) -> Vec<HousingMode> {
    if let Some(HousingModes::Read(modes)) = &housing.modes {
        let mode = |mode: &scenario::HousingMode| HousingMode {
            frequency: TAU * mode.frequency_hz,
            damping_ratio: mode.damping_ratio,
            seats: mode.seats.clone(),
            sensors: mode.sensors.clone(),
        };
        return modes.iter().map(mode).collect();
    }
    let matrices = housing.mass_matrix_kg.as_ref().zip(housing.stiffness_matrix_n_per_m.as_ref());
    let modes = matrices.and_then(|(mass, stiffness)| normal_modes(mass, stiffness)).unwrap_or_default();
    let mode = |(frequency, shape): (f64, Vec<f64>)| HousingMode {
        frequency,
        damping_ratio: housing.damping_ratio,
        seats: shape.chunks_exact(2).take(seats).map(|pair| [pair[0], pair[1]]).collect(),
        sensors: shape[2 * seats..][..sensors].to_vec(),
    };
    modes.into_iter().filter(|(frequency, _)| *frequency <= TAU * FASTEST_HZ).map(mode).collect()
}
