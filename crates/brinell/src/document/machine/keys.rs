//! The keys of a machine beside those of its bearings, once and in order: shaft, seats, housings, sensors.

use super::super::keys::Fallback::{Needed, Required};
use super::super::keys::{Keys, assumed, derived, stated};
use super::super::modes_value::FASTEST_HZ;
use super::super::spec::key;
use crate::scenario::{
    Accelerometer, Coupling, Disc, Machine, MachineHousing, Seat, SensorOn, Shaft, ShaftLoad, Unbalance, Unset,
};
use crate::signal::rounded;
use crate::steel::{DENSITY, POISSONS_RATIO, YOUNGS_MODULUS_GPA};
use brinell_shaft::Part;
use std::f64::consts::TAU;

/// Where a housing is held, at least so far from its middle, mm.
const LEAST_ARM_MM: f64 = 50.0;
/// Where keys of a housing have a meaning.
const RIGID: &str = "the housing has neither modes nor matrices";
const BY_MATRICES: &str = "the housing has matrices";
const DEFAULT_HZ: f64 = 300.0;
const DEFAULT_RATIO: f64 = 0.05;

pub(in super::super) fn machine(k: &mut Keys, m: &mut Machine) {
    k.section(key("shaft", "what the bearings sit on: cylindrical parts along Z"), |k| shaft(k, &mut m.shaft));
    k.tables(key("bearing", "a bearing, with all its keys"), &mut m.seats, Seat::unset, seat);
    let (seats, shaft) = (&m.seats, &m.shaft);
    let mut number = 0;
    k.tables(
        key("housing", "a rigid body on springs, in which outer rings sit"),
        &mut m.housings,
        MachineHousing::unset,
        |k, h| {
            number += 1;
            let within = seats.iter().filter(|seat| seat.housing.is_none_or(|of| of == number)).map(|seat| seat.at_mm);
            housing(k, &within.collect::<Vec<_>>(), h);
        },
    );
    let mut number = 0;
    k.tables(
        key("sensor", "an accelerometer, behind the anti-alias filter"),
        &mut m.sensors,
        Accelerometer::unset,
        |k, s| {
            number += 1;
            sensor(k, (number, shaft), s);
        },
    );
}

fn shaft(k: &mut Keys, s: &mut Shaft) {
    k.key(
        key("stations_mm", "Z of the ends and of every change of the diameter, rising; channels shaft.x1, shaft.y1, ... are its displacements there"),
        Required,
        &mut s.stations_mm,
    );
    k.key(key("diameters_mm", "from each station to the next").above(0.0), Required, &mut s.diameters_mm);
    k.optional(key("bores_mm", "likewise; left out: solid").from(0.0), &mut s.bores_mm);
    const STEEL: &str = "of steel";
    k.key(
        key("youngs_modulus_gpa", "E").above(0.1).to(2000.0),
        assumed(YOUNGS_MODULUS_GPA, STEEL),
        &mut s.youngs_modulus_gpa,
    );
    let shear = rounded(0.5 * s.youngs_modulus_gpa / (1.0 + POISSONS_RATIO), 6);
    k.key(
        key("shear_modulus_gpa", "G").above(0.01).to(2000.0),
        derived(shear, "E / 2.6, Poisson's ratio 0.3"),
        &mut s.shear_modulus_gpa,
    );
    let density = rounded(1e9 * DENSITY, 6);
    k.key(key("density_kg_per_m3", "rho").from(100.0).to(30_000.0), assumed(density, STEEL), &mut s.density_kg_per_m3);
    k.key(key("rigid", "whether it does not bend"), stated(false, "shafts bend"), &mut s.rigid);
    k.key(
        key("band_hz", "its free modes up to here are kept, and six a plane at least, beside what residual vectors of the seats add")
            .from(0.0)
            .to(FASTEST_HZ),
        stated(2000.0, "well above the speed, with residual vectors for what is above"),
        &mut s.band_hz,
    );
    k.key(
        key("damping_ratio", "of each mode that bends").plausible(0.001, 0.02).from(0.0).to(0.95),
        assumed(0.005, "a shaft with what is pressed onto it"),
        &mut s.damping_ratio,
    );
    let density = s.density_kg_per_m3;
    k.tables(
        key("disc", "a rigid body on the shaft: a disc, a rotor, half of a coupling"),
        &mut s.disc,
        Disc::unset,
        |k, d| {
            disc(k, density, d);
        },
    );
    k.tables(key("unbalance", "what pulls round with the shaft"), &mut s.unbalance, Unbalance::unset, |k, u| {
        k.key(key("at_mm", "Z"), Required, &mut u.at_mm);
        k.key(key("size_g_mm", "mass times its distance from the axis").from(0.0), Required, &mut u.size_g_mm);
        k.key(
            key("angle_deg", "where on the shaft, from X at t = 0"),
            stated(0.0, "along X at t = 0"),
            &mut u.angle_deg,
        );
    });
    k.tables(key("load", "a force on the shaft"), &mut s.load, ShaftLoad::unset, |k, l| {
        k.key(key("at_mm", "Z"), Required, &mut l.at_mm);
        k.key(key("force_n", "F = [x, y], after the load's ramp"), Required, &mut l.force_n);
    });
    k.tables(key("coupling", "springs from the shaft to the ground"), &mut s.coupling, Coupling::unset, |k, c| {
        k.key(key("at_mm", "Z"), Required, &mut c.at_mm);
        k.key(
            key("radial_stiffness_n_per_m", "against displacement").from(0.0),
            Required,
            &mut c.radial_stiffness_n_per_m,
        );
        k.key(
            key("tilt_stiffness_nm_per_rad", "against tilt").from(0.0),
            stated(0.0, "free to tilt"),
            &mut c.tilt_stiffness_nm_per_rad,
        );
    });
}

/// `density` is the shaft's, kg/m^3.
fn disc(k: &mut Keys, density: f64, d: &mut Disc) {
    k.key(key("at_mm", "Z of its middle"), Required, &mut d.at_mm);
    k.optional(key("diameter_mm", "of a disc that its size gives the mass of").above(0.0), &mut d.diameter_mm);
    k.optional(key("width_mm", "along the axis, likewise").above(0.0), &mut d.width_mm);
    k.optional(key("bore_mm", "likewise; left out: solid").from(0.0), &mut d.bore_mm);
    let metres = |mm: Option<f64>| mm.map(|mm| 1e-3 * mm);
    let cylinder = metres(d.width_mm).zip(metres(d.diameter_mm)).map(|(length, outer_diameter)| {
        let inner_diameter = metres(d.bore_mm).unwrap_or(0.0);
        brinell_shaft::Disc::of_cylinder(0.0, &Part { length, outer_diameter, inner_diameter }, density)
    });
    let of = |value: fn(&brinell_shaft::Disc) -> f64| {
        let value = cylinder.as_ref().map(|cylinder| rounded(value(cylinder), 6));
        value
            .map_or(Needed("or diameter_mm and width_mm"), |value| derived(value, "a cylinder of the shaft's material"))
    };
    k.key(key("mass_kg", "or diameter_mm and width_mm").above(0.0), of(|c| c.mass), &mut d.mass_kg);
    k.key(
        key("polar_inertia_kg_m2", "about the axis; likewise").from(0.0),
        of(|c| c.polar_inertia),
        &mut d.polar_inertia_kg_m2,
    );
    k.key(
        key("diametral_inertia_kg_m2", "about a diameter; likewise").from(0.0),
        of(|c| c.diametral_inertia),
        &mut d.diametral_inertia_kg_m2,
    );
}

fn seat(k: &mut Keys, s: &mut Seat) {
    k.key(key("at_mm", "Z of its middle on the shaft"), Required, &mut s.at_mm);
    k.optional(
        key("housing", "number of the [[housing]] that its outer ring sits in; left out: in the only one; without any on `support`").from(1.0),
        &mut s.housing,
    );
    k.key(
        key("offset_um", "[x, y], by how much its seat is off the line through the seats"),
        stated([0.0; 2], "in line"),
        &mut s.offset_um,
    );
    k.key(
        key("misalignment_mrad", "[x, y], by how much its seat is tilted: slopes of its axis in (X, Z) and (Y, Z)"),
        stated([0.0; 2], "in line"),
        &mut s.misalignment_mrad,
    );
    k.optional(
        key("fit_stiffness_n_per_m", "of the outer ring in its housing; left out: it sits there rigidly").above(0.0),
        &mut s.fit_stiffness_n_per_m,
    );
    let has_fit = s.fit_stiffness_n_per_m.is_some();
    k.key_where(
        key("fit_damping_ns_per_m", "of the same").from(0.0),
        (has_fit, "fit_stiffness_n_per_m is given"),
        stated(0.0, "none"),
        &mut s.fit_damping_ns_per_m,
    );
    if !has_fit {
        s.fit_damping_ns_per_m = 0.0;
    }
}

/// `within`: where its bearings are, mm.
fn housing(k: &mut Keys, within: &[f64], h: &mut MachineHousing) {
    k.optional(
        key("modes", "in place of a rigid body: frequency, damping and shapes at seats and sensors, of modal mass 1 kg and without outer rings; or a CSV file's name"),
        &mut h.modes,
    );
    k.optional(
        key(
            "mass_matrix_kg",
            "in place of these: M of x and y of each seat, of each sensor along its direction, and of anything else",
        ),
        &mut h.mass_matrix_kg,
    );
    k.optional(key("stiffness_matrix_n_per_m", "K of the same"), &mut h.stiffness_matrix_n_per_m);
    let by_matrices = h.modes.is_none() && (h.mass_matrix_kg.is_some() || h.stiffness_matrix_n_per_m.is_some());
    k.key_where(
        key("damping_ratio", "of the modes of these matrices").plausible(0.005, 0.05).from(0.0).to(0.95),
        (by_matrices, BY_MATRICES),
        assumed(0.02, "cast iron on bolts"),
        &mut h.damping_ratio,
    );
    let rigid = (h.is_rigid(), RIGID);
    let [low, high] = [f64::min, f64::max].map(|of| within.iter().copied().reduce(of).unwrap_or(f64::NAN));
    k.key_where(
        key("at_mm", "Z of its centre of mass"),
        rigid,
        derived(0.5 * (low + high), "in the middle of its bearings"),
        &mut h.at_mm,
    );
    k.key_where(key("mass_kg", "without the outer rings in it").above(0.0), rigid, Required, &mut h.mass_kg);
    // What could not be read raises no objection.
    let arm = 1e-3 * LEAST_ARM_MM.max(0.5 * (high - low));
    let square = rounded(arm * arm, 6);
    let over = |value: f64| rounded(value, 6);
    k.key_where(
        key("inertia_kg_m2", "about X and Y through its centre of mass").plausible_times(0.3, 3.0).above(0.0),
        rigid,
        derived(over(h.mass_kg * square), "its mass at the outermost of its bearings, 50 mm from the middle at least"),
        &mut h.inertia_kg_m2,
    );
    k.key_where(
        key("stiffness_n_per_m", "of what holds it").plausible_times(0.1, 10.0).above(0.0),
        rigid,
        derived(over(h.mass_kg * (TAU * DEFAULT_HZ).powi(2)), "a first resonance at 300 Hz: measure it"),
        &mut h.stiffness_n_per_m,
    );
    k.key_where(
        key("damping_ns_per_m", "of the same").plausible_times(0.2, 3.0).from(0.0),
        rigid,
        derived(over(2.0 * DEFAULT_RATIO * (h.stiffness_n_per_m * h.mass_kg).sqrt()), "5 % of critical damping"),
        &mut h.damping_ns_per_m,
    );
    const FEET: &str = "of springs and dampers under the outermost of its bearings, 50 mm from the middle at least";
    k.key_where(
        key("tilt_stiffness_nm_per_rad", "against tilt").plausible_times(0.3, 3.0).above(0.0),
        rigid,
        derived(over(h.stiffness_n_per_m * square), FEET),
        &mut h.tilt_stiffness_nm_per_rad,
    );
    k.key_where(
        key("tilt_damping_nms_per_rad", "of the same").plausible_times(0.3, 3.0).from(0.0),
        rigid,
        derived(over(h.damping_ns_per_m * square), FEET),
        &mut h.tilt_damping_nms_per_rad,
    );
    // A key without a meaning holds nothing, so that a scenario equals the one that it reads back to.
    if !rigid.0 {
        for value in [
            &mut h.at_mm,
            &mut h.mass_kg,
            &mut h.inertia_kg_m2,
            &mut h.stiffness_n_per_m,
            &mut h.damping_ns_per_m,
            &mut h.tilt_stiffness_nm_per_rad,
            &mut h.tilt_damping_nms_per_rad,
        ] {
            *value = 0.0;
        }
    }
    if !by_matrices {
        h.damping_ratio = 0.0;
    }
}

fn sensor(k: &mut Keys, (number, shaft): (usize, &Shaft), s: &mut Accelerometer) {
    k.key(
        key("name", "its channel is housing1.NAME or shaft.NAME"),
        stated(format!("sensor{number}"), "by its number"),
        &mut s.name,
    );
    k.key(key("on", "what it sits on"), stated(SensorOn::Housing, "where sensors are"), &mut s.on);
    k.optional(key("housing", "number of the [[housing]]; left out: the only one").from(1.0), &mut s.housing);
    let stations = &shaft.stations_mm;
    let middle = stations.first().zip(stations.last()).map_or(f64::NAN, |(first, last)| 0.5 * (first + last));
    k.key(key("at_mm", "Z"), derived(middle, "the middle of the shaft"), &mut s.at_mm);
    k.key(
        key("direction_deg", "of its axis, counter-clockwise from +X"),
        assumed(90.0, "upright"),
        &mut s.direction_deg,
    );
}
