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

#[test]
fn analytic_a_stiffness_or_mass_in_another_unit_is_said() {
    const BALL: &str = "[bearing]\nelement = \"ball\"\ninner_raceway_diameter_mm = 52.291\nouter_raceway_diameter_mm = 77.706\nroller_diameter_mm = 12.7\n\
                        rollers_per_row = 9\n[operation]\nspeed_rpm = 1800\nload_n = [0, -8900]\n";
    let told = |text: &str, key: &str, value: f64| -> Vec<String> {
        let loaded = with(text, &[(key, &format!("{value:?}"))]).unwrap();
        loaded.warnings.iter().filter(|w| w.key == key).map(ToString::to_string).collect()
    };
    let derived = |text: &str, key: &str| -> f64 { good(text).provenance_of(key).unwrap().value.parse().unwrap() };
    for (text, n) in [(BALL, 1.5), (BARE, 10.0 / 9.0)] {
        for key in ["contact.inner_stiffness", "contact.outer_stiffness"] {
            let geometry = derived(text, key);
            for fits in [0.11, 1.0, 9.0] {
                assert_eq!(told(text, key, fits * geometry), Vec::<String>::new(), "{key}");
            }
            let in_mm = told(text, key, geometry / 1e3_f64.powf(n));
            assert!(in_mm.len() == 1 && in_mm[0].contains("in N/mm^n instead of N/m^n?"), "{in_mm:?}");
            let other = told(text, key, 11.0 * geometry);
            assert!(
                other.len() == 1 && other[0].contains("11 times the ") && !other[0].contains("N/mm^n"),
                "{other:?}"
            );
        }
        let key = "bearing.roller_mass_kg";
        let steel = derived(text, key);
        // Silicon nitride has 0.41 of the mass.
        assert_eq!(told(text, key, 0.41 * steel), Vec::<String>::new());
        let in_g = told(text, key, 1e3 * steel);
        assert!(in_g.len() == 1 && in_g[0].contains("in g instead of kg?"), "{in_g:?}");
    }
    assert_eq!(told(BARE, "friction.raceway_coefficient", 0.8), Vec::<String>::new());
    assert!(told(BARE, "friction.raceway_coefficient", 5.0)[0].contains("dry steel on steel"));
}

#[test]
fn prop_no_preset_is_taken_for_another_unit() {
    for entry in brinell::bearing::catalogue::all() {
        let text =
            format!("[bearing]\npreset = \"{}\"\n[operation]\nspeed_rpm = 1500\nload_n = [100, 0]\n", entry.name);
        let Ok(loaded) = with(&text, &[]) else {
            continue;
        };
        let suspected = loaded.warnings.iter().filter(|w| w.key.contains("stiffness") || w.key.contains("mass"));
        assert_eq!(suspected.count(), 0, "{}", entry.name);
    }
}
