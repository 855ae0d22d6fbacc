//! Scenario files of ball bearings: which keys they have, which are refused, what is assumed.

use super::{LI2023, refused, report, with};
use brinell::document::{Loaded, read};
use brinell::model::Model;
use brinell::scenario::{Element, Law};

/// The drive end of the Case Western rig, with nothing that has a default.
const BARE: &str = "\
[bearing]
element = \"ball\"
inner_raceway_diameter_mm = 31.1
outer_raceway_diameter_mm = 46.98
roller_diameter_mm = 7.94
rollers_per_row = 9
[operation]
speed_rpm = 1797.0
load_n = [0.0, -200.0]
[[defects]]
on = \"roller\"
roller = 3
row = 1
depth_um = 280.0
center_deg = 0.0
shape = { circle = { diameter_mm = 0.5 } }
";

#[test]
fn analytic_grooves_lie_a_ball_apart_about_the_pitch_circle() {
    // As sheets of ball bearings have it: pitch circle, balls and their number.
    let circle = BARE
        .replace("inner_raceway_diameter_mm = 31.1\nouter_raceway_diameter_mm = 46.98", "pitch_diameter_mm = 39.04");
    let [whole, of_circle] = [BARE, &circle].map(|text| read(text, &[]).unwrap_or_else(|p| panic!("{}", report(&p))));
    let [whole, of_circle] = [whole, of_circle].map(|loaded| loaded.scenario.bearing);
    for (a, b) in [
        (whole.inner_raceway_diameter_mm, of_circle.inner_raceway_diameter_mm),
        (whole.outer_raceway_diameter_mm, of_circle.outer_raceway_diameter_mm),
        (whole.pitch_diameter_mm, of_circle.pitch_diameter_mm),
    ] {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
    // One of the two does not tell them.
    let alone = circle.replace("pitch_diameter_mm = 39.04\n", "");
    refused(&alone, &[], "bearing.inner_raceway_diameter_mm", "missing");
    // Beside a name they are the name's, and the message says what to do.
    let named = circle.replace("element = \"ball\"", "preset = \"6205\"").replace("39.04", "38.5");
    refused(&named, &[], "bearing.pitch_diameter_mm", "give both, as D_m - d and D_m + d");
}

#[test]
fn regress_defaults_of_balls() {
    let loaded = with(BARE, &[LI2023, ("simulation.geometry", "exact")]).unwrap();
    let s = &loaded.scenario;
    assert_eq!(s.bearing.element, Element::Ball);
    assert_eq!(s.bearing.inner_groove_conformity, Some(0.52));
    assert_eq!(s.bearing.outer_groove_conformity, Some(0.52));
    assert_eq!(s.contact.youngs_modulus_gpa, Some(206.0));
    assert_eq!(s.contact.poisson_ratio, Some(0.3));
    assert_eq!(s.contact.law, Law::HalfSpace);
    assert_eq!(s.contact.exponent, 1.5);
    assert!((s.contact.inner_stiffness / 2.53251e10 - 1.0).abs() < 1e-5);
    assert!((s.contact.outer_stiffness / 2.68371e10 - 1.0).abs() < 1e-5);
    assert!((s.bearing.roller_mass_kg / 0.002057 - 1.0).abs() < 1e-3);
    let assumed = |key: &str| loaded.provenance_of(key).is_some_and(|p| p.assumed);
    assert!(assumed("bearing.inner_groove_conformity") && assumed("contact.inner_stiffness"));
    assert!(loaded.provenance_of("bearing.roller_length_mm").is_none());
    assert!(loaded.provenance_of("contact.exponent").is_none());
}

#[test]
fn regress_what_balls_do_not_have_is_refused() {
    for (key, value) in [
        ("bearing.profile", "logarithmic"),
        ("bearing.width_mm", "15"),
        ("bearing.row_spacing_mm", "0"),
        ("operation.load_offset_mm", "1"),
        ("support.inner_tilt_stiffness_nm_per_rad", "1e3"),
        ("support.outer_tilt_damping_nms_per_rad", "1"),
    ] {
        let words = "has a meaning only where bearing.element is \"roller\"";
        refused(BARE, &[(key, value)], key, words);
    }
    refused(BARE, &[("simulation.model", "tilting")], "simulation.model", "no ends that could tilt");
    let no_meaning = "has a meaning only where bearing.element is \"roller\"";
    refused(BARE, &[("bearing.roller_length_mm", "7.0")], "bearing.roller_length_mm", no_meaning);
    refused(BARE, &[("contact.exponent", "1.5")], "contact.exponent", no_meaning);
    refused(BARE, &[("contact.law", "ecl")], "contact.law", "half-space");
    refused(BARE, &[("bearing.inner_groove_conformity", "0.5")], "bearing.inner_groove_conformity", "> 0.5");
    refused(BARE, &[("bearing.preset", "NU206")], "bearing.element", "NU206 is a roller bearing");
    let balls = with(super::BARE, &[("bearing.outer_groove_conformity", "0.53")]).unwrap_err();
    assert!(report(&balls).contains("has a meaning only where bearing.element is \"ball\""));
    let balls = with(super::BARE, &[LI2023, ("contact.youngs_modulus_gpa", "210")]).unwrap_err();
    assert!(report(&balls).contains("has a meaning only where bearing.element is \"ball\""));
}

#[test]
fn prop_a_written_ball_bearing_checks_the_same() {
    for overrides in [
        &[][..],
        &[("simulation.model", "lumped")],
        &[("simulation.model", "lumped"), ("contact.roller_path", "point")],
        &[LI2023, ("simulation.geometry", "exact"), ("contact.inner_stiffness", "2e10")],
        &[("bearing.clearance_class", "C3"), ("bearing.bore_diameter_mm", "25")],
    ] {
        let loaded = with(BARE, overrides).unwrap_or_else(|p| panic!("{}", report(&p)));
        let again: Loaded =
            read(&loaded.to_toml(), &[]).unwrap_or_else(|p| panic!("{}\n{}", loaded.to_toml(), report(&p)));
        assert_eq!(again.scenario, loaded.scenario);
        assert_eq!(again.warnings, loaded.warnings);
        let assumed = |l: &Loaded| -> Vec<String> {
            let all = l.provenance.iter().filter(|p| p.assumed);
            all.map(|p| p.key.clone()).collect()
        };
        assert_eq!(assumed(&again), assumed(&loaded));
        assert_eq!(again.scenario.problems(), loaded.warnings);
        Model::new(&again.scenario).unwrap();
    }
    let class = with(BARE, &[("bearing.clearance_class", "C3"), ("bearing.bore_diameter_mm", "25")]);
    // 13 to 28 um on the diameter.
    assert_eq!(class.unwrap().scenario.bearing.radial_clearance_um, 10.25);
}

#[test]
fn regress_a_groove_that_cannot_be_is_the_one_error() {
    let problems = with(BARE, &[("bearing.inner_groove_conformity", "4.2")]).unwrap_err();
    assert_eq!(problems.len(), 1, "{}", report(&problems));
}

#[test]
fn analytic_ten_times_the_rating_is_a_pressure_by_the_element() {
    // ISO 76 has 4.2 GPa of balls and 4 GPa of rollers at C0; Q^(1/3) and Q^(1/2).
    let load = [("operation.load_n", "[0, -1e6]")];
    refused(BARE, &load, "operation.load_n", "a contact pressure of 9.05 GPa");
    refused(super::BARE, &load, "operation.load_n", "a contact pressure of 12.6 GPa");
}

#[test]
fn prop_damage_beyond_the_ball_is_refused() {
    // The ball's radius is 3.97 mm, the pit's 0.25 mm.
    let on_ring =
        ("defects.0", "{ on = \"outer-raceway\", depth_um = 280, shape = { circle = { diameter_mm = 0.5 } } }");
    let at = |mm| [on_ring, ("defects.0.axial_offset_mm", mm)];
    for mm in ["4.25", "-6"] {
        refused(BARE, &at(mm), "defects.0.axial_offset_mm", "no ball can touch this damage");
    }
    for mm in ["4.15", "-3"] {
        assert!(with(BARE, &at(mm)).is_ok(), "{mm}");
    }
    // The offset is at fault, and its range is told, of balls and of rollers.
    refused(BARE, &at("9"), "defects.0.axial_offset_mm", "above -4.22 and below 4.22, in mm");
    let wide = "[{ on = \"outer-raceway\", depth_um = 20, axial_offset_mm = 8, shape = { rectangle = { length_mm = 3, width_mm = 4 } } }]";
    let moved = [("defects", wide)];
    refused(super::BARE, &moved, "defects.0.axial_offset_mm", "off the raceway's edge: z from 6 to 10 mm");
    refused(super::BARE, &moved, "defects.0.axial_offset_mm", "above -5 and below 5, in mm");
    let outline = "{ outline = { points_mm = [[0, 4], [1, 4], [0, 5]] } }";
    refused(BARE, &[("defects.0.shape", outline)], "defects.0.shape.outline.points_mm", "into z from -3.97 to 3.97 mm");
    let map = "{ depth_map = { ds_mm = 1, dz_mm = 1, z0_mm = 5, columns = 2, rows = 2, depth_um = [1, 2, 3, 4] } }";
    refused(BARE, &[("defects.0.shape", map)], "defects.0.shape.depth_map.depth_um", "no ball can touch this damage");
}

#[test]
fn prop_damage_may_be_wider_than_the_ball_but_not_than_any_groove() {
    let wide = |mm: &str| {
        with(BARE, &[("defects.0.shape", &format!("{{ rectangle = {{ length_mm = 1.0, width_mm = {mm} }} }}"))])
    };
    assert!(wide("10").is_ok());
    let said = wide("16").unwrap().warnings;
    assert!(said.iter().any(|w| w.message.contains("wider than any groove")), "{said:?}");
    assert!(report(&wide("160").unwrap_err()).contains("wider than any groove"));
}
