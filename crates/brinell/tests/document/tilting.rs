//! Scenario files with profiles and tilts: defaults, what is refused, and what has no effect.

use super::{LI2023, good, refused, with};
use brinell::scenario::{Law, ModelKind, RollerProfile};

const BARE: &str = "\
[bearing]
preset = \"NN3007\"
[operation]
speed_rpm = 1800.0
load_n = [300.0, 0.0]
";

#[test]
fn regress_defaults_of_what_tilts() {
    let text = format!("{BARE}[simulation]\nmodel = \"tilting\"\n");
    let loaded = good(&text);
    let s = &loaded.scenario;
    assert_eq!(s.simulation.model, ModelKind::Tilting);
    assert_eq!(s.contact.law, Law::HalfSpace);
    assert_eq!(s.bearing.profile, RollerProfile::Straight);
    // The catalogue's, 1.5 L, k R_m^2 and c R_m^2.
    assert_eq!(s.bearing.width_mm, 20.0);
    assert!((s.bearing.row_spacing_mm - 9.0).abs() < 1e-12);
    let lever = 0.0245f64.powi(2);
    let support = &s.support;
    for (tilt, own) in [
        (support.inner_tilt_stiffness_nm_per_rad, support.inner_stiffness_n_per_m),
        (support.outer_tilt_damping_nms_per_rad, support.outer_damping_ns_per_m),
    ] {
        assert!((tilt / (own * lever) - 1.0).abs() < 1e-12);
    }
    let assumed = |key: &str| loaded.provenance_of(key).is_some_and(|p| p.assumed);
    assert!(!assumed("bearing.width_mm") && assumed("support.outer_tilt_stiffness_nm_per_rad"));
}

#[test]
fn regress_what_has_no_slices_has_no_profile_and_no_tilt() {
    let tilts = ("simulation.model", "tilting");
    let profile = ("bearing.profile", "logarithmic");
    let ecl = ("contact.law", "ecl");
    refused(BARE, &[tilts, ecl], "contact.law", "needs slices");
    refused(BARE, &[tilts, ("contact.slices", "1")], "contact.slices", "2 to 10000");
    refused(BARE, &[profile, ecl], "bearing.profile", "needs slices");
    let lumped = ("simulation.model", "lumped");
    refused(BARE, &[profile, lumped], "bearing.profile", "no profile");
    // With a profile alone the law is half-space.
    let loaded = with(BARE, &[LI2023, profile]).unwrap();
    assert_eq!(loaded.scenario.contact.law, Law::HalfSpace);
}

#[test]
fn regress_profiles_that_make_no_sense() {
    let table = |text: &'static str| ("bearing.profile", text);
    let far = table("{ z_mm = [-3, 3], drop_um = [500, 500] }");
    refused(BARE, &[far], "bearing.profile", "no slice ever touches");
    let falls = table("{ z_mm = [3, -3], drop_um = [0, 0] }");
    refused(BARE, &[falls], "bearing.profile.z_mm", "does not rise");
    let uneven = table("{ z_mm = [-3, 3], drop_um = [0] }");
    refused(BARE, &[uneven], "bearing.profile", "one drop for each z");
    let unknown = table("barrel");
    refused(BARE, &[unknown], "bearing.profile", "logarithmic");
}

#[test]
fn regress_keys_of_tilting_have_no_effect_in_the_plane() {
    let loaded = with(BARE, &[("operation.load_offset_mm", "2")]).unwrap();
    let said: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    assert!(said.iter().any(|w| w.contains("load_offset_mm") && w.contains("no effect")), "{said:?}");
}
