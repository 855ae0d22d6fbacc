//! The plan of the machine that a scenario describes.

use super::plan::{Housing, OnShaft, Plan, PlanError, Shaft};
use super::{Machine, Material, Part, Spring};
use crate::document::Problem;
use crate::error::Error;
use crate::model::{Model, Support};
use crate::scenario::{self, SensorOn};

/// The machine of a scenario that has one, and the models of its bearings in the file's order.
///
/// # Errors
/// Where it makes none: [`Scenario::problems`](crate::Scenario::problems) says so too.
pub(crate) fn machine(of: &scenario::Machine, models: Vec<Model>) -> Result<Machine, Error> {
    plan(of, models).machine().map_err(|error: PlanError| vec![Problem::error("shaft", error.to_string())].into())
}

/// What `machine` makes it of.
pub(crate) fn plan(of: &scenario::Machine, models: Vec<Model>) -> Plan {
    let s = &of.shaft;
    let first = s.stations_mm.first().copied().unwrap_or(0.0);
    let at = |mm: f64| 1e-3 * (mm - first);
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
    let housing = |(k, h): (usize, &scenario::RigidHousing)| {
        let within = of
            .sensors
            .iter()
            .filter(|of_one| of_one.on == SensorOn::Housing && of.housing_of(of_one.housing) == Some(k));
        Housing {
            at: at(h.at_mm),
            mass: h.mass_kg,
            inertia: h.inertia_kg_m2,
            support: Support { stiffness: h.stiffness_n_per_m, damping: h.damping_ns_per_m },
            tilt_support: Support { stiffness: h.tilt_stiffness_nm_per_rad, damping: h.tilt_damping_nms_per_rad },
            sensors: within.map(sensor).collect(),
        }
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
