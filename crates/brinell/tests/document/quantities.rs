//! Strings with a unit in the place of numbers.

use brinell::document::Origin;
use brinell::scenario::Speed;

use super::{BARE, good, refused, with};

#[test]
fn prop_a_quantity_is_the_same_scenario_as_its_number() {
    let numbers = "[[defects]]\non = \"outer-raceway\"\ncenter_deg = 90\ndepth_um = 20\nshape = { rectangle = { length_mm = 3, width_mm = 4 } }\n";
    let units = "[[defects]]\non = \"outer-raceway\"\ncenter_deg = \"0.25 r\"\ndepth_um = \"0.02 mm\"\nshape = { rectangle = { length_mm = \"0.3 cm\", width_mm = \"4000 um\" } }\n";
    let plain = good(&format!("{BARE}{numbers}"));
    let text =
        BARE.replace("1800.0", "\"30 Hz\"").replace("[300.0, 0.0]", "[\"0.3 kN\", 0]").replace("43.0", "\"4.3 cm\"");
    let loaded = good(&format!("{text}{units}"));
    assert_eq!(loaded.scenario, plain.scenario);
    assert_eq!(loaded.warnings, plain.warnings);
    // Written as numbers, and the author's as before.
    assert_eq!(loaded.to_toml(), plain.to_toml());
    let speed = loaded.provenance_of("operation.speed_rpm").unwrap();
    assert_eq!((speed.value.as_str(), &speed.origin), ("1800.0", &Origin::File));
}

#[test]
fn prop_overrides_and_profiles_take_units() {
    let of = |value: &str| {
        let loaded = with(BARE, &[("operation.speed_rpm", value)]).unwrap();
        loaded.scenario.operation.speed_rpm
    };
    for value in ["25 Hz", "25Hz", "\"25 Hz\"", "1500 rpm", "0.025 kHz"] {
        assert_eq!(of(value), Speed::Constant(1500.0), "{value}");
    }
    let profile = of("[[0, \"0 Hz\"], [\"400 ms\", \"30 Hz\"]]");
    assert_eq!(profile, Speed::Profile(vec![[0.0, 0.0], [0.4, 1800.0]]));
    let load = with(BARE, &[("operation.load_n", "[\"2 kN\", 0]")]).unwrap();
    assert_eq!(load.scenario.operation.load_n, [2000.0, 0.0]);
}

#[test]
fn prop_a_quantity_that_does_not_fit_is_refused_with_units_that_do() {
    let speed = "operation.speed_rpm";
    for (key, value, words) in [
        (speed, "2 kN", "\"kN\" does not convert to r/min"),
        (speed, "2 kN", "a string with a unit: r/min, rpm, Hz, kHz, rad/s"),
        (speed, "\"25\"", "no unit: a string needs one; without quotes the number is in r/min"),
        (speed, "25 furlongs", "unknown unit \"furlongs\""),
        ("operation.load_n", "[\"2 mm\", 0]", "\"mm\" does not convert to N"),
        ("bearing.roller_diameter_mm", "-6 mm", "out of range"),
        // Keys without a unit, or with one that has no other.
        ("bearing.rollers_per_row", "19 mm", "expected a whole number"),
        ("contact.exponent", "1 mm", "expected a number, found a string"),
        ("contact.inner_stiffness", "1 N/m", "expected a number in N/m^n, found a string"),
    ] {
        refused(BARE, &[(key, value)], key, words);
    }
}
