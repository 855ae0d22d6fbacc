//! The three ways to give the clearance, and what is said of one that cannot be meant.

use brinell::bearing::clearance::bore_diameter_mm;
use brinell::document::{Loaded, Origin, Problem, Severity, json_schema, read, template};
use serde_json::json;

use super::{BARE, report, with};

/// A preset with lines of its own in `[bearing]`.
fn nu206(lines: &str) -> Result<Loaded, Vec<Problem>> {
    let text = format!("[bearing]\npreset = \"NU206\"\n{lines}\n[operation]\nspeed_rpm = 1500\nload_n = [1000, 0]\n");
    read(&text, &[])
}

fn clearance(loaded: &Loaded) -> f64 {
    loaded.scenario.bearing.radial_clearance_um
}

#[test]
fn lit_every_way_to_give_the_clearance_means_the_same_gap() {
    // ISO 5753-1, bore over 24 to 30 mm: CN 20 to 45, C3 35 to 60 um on the diameter; half of the middle on one side.
    for (line, gap) in [
        ("", 16.25),
        ("clearance_class = \"CN\"", 16.25),
        ("clearance_class = \"C2\"", 6.25),
        ("clearance_class = \"C3\"", 23.75),
        ("clearance_class = \"C5\"", 41.25),
        ("diametral_clearance_um = 32.5", 16.25),
        ("diametral_clearance_um = -8", -4.0),
        ("radial_clearance_um = 16.25", 16.25),
        // A bore of one's own outranks the preset's.
        ("bore_diameter_mm = 35\nclearance_class = \"CN\"", 18.75),
    ] {
        let loaded = nu206(line).unwrap_or_else(|p| panic!("{line}: {}", report(&p)));
        assert_eq!(clearance(&loaded), gap, "{line}");
        assert!(loaded.warnings.is_empty(), "{}", report(&loaded.warnings));
    }
    let bare = [("bearing.bore_diameter_mm", "35"), ("bearing.clearance_class", "C3")];
    assert_eq!(clearance(&with(BARE, &bare).unwrap()), 28.75);
}

#[test]
fn regress_a_class_is_an_assumption_and_a_measure_is_none() {
    let of = |loaded: &Loaded, key: &str| {
        let found = loaded.provenance.iter().find(|p| p.key == key);
        found.unwrap_or_else(|| panic!("{key}")).clone()
    };
    const KEY: &str = "bearing.radial_clearance_um";
    let class = of(&nu206("clearance_class = \"C3\"").unwrap(), KEY);
    assert!(class.assumed && class.reason().contains("ISO 5753-1"));
    let diametral = nu206("diametral_clearance_um = 30").unwrap();
    assert!(!of(&diametral, KEY).assumed);
    assert!(matches!(of(&diametral, KEY).origin, Origin::Derived(_)));
    assert_eq!(of(&diametral, "bearing.diametral_clearance_um").origin, Origin::File);
    // The resolved file holds one of the three, and the bore where it was given.
    for line in ["diametral_clearance_um = 30", "clearance_class = \"C4\"", "bore_diameter_mm = 28.5"] {
        let loaded = nu206(line).unwrap();
        let again = read(&loaded.to_toml(), &[]).unwrap_or_else(|p| panic!("{}", report(&p)));
        assert_eq!(again.scenario, loaded.scenario, "{line}");
        assert_eq!(bore_diameter_mm(&again.scenario.bearing), Some(if line.starts_with("bore") { 28.5 } else { 30.0 }));
    }
}

#[test]
fn regress_a_clearance_that_cannot_be_is_refused_with_its_key() {
    let two = "radial_clearance_um = 5\ndiametral_clearance_um = 10";
    for (text, key, words, line) in [
        (nu206(two), "bearing.diametral_clearance_um", "given twice", Some(4)),
        (
            nu206("clearance_class = \"C3\"\ndiametral_clearance_um = 10"),
            "bearing.clearance_class",
            "given twice",
            Some(3),
        ),
        (
            with(BARE, &[("bearing.clearance_class", "CN")]),
            "bearing.clearance_class",
            "a class needs the bore: give bearing.bore_diameter_mm",
            None,
        ),
        (
            with(
                BARE,
                &[
                    ("bearing.inner_raceway_diameter_mm", "1200"),
                    ("bearing.outer_raceway_diameter_mm", "1300"),
                    ("bearing.roller_diameter_mm", "50"),
                    ("bearing.bore_diameter_mm", "1100"),
                    ("bearing.clearance_class", "CN"),
                ],
            ),
            "bearing.bore_diameter_mm",
            "no class for this bore",
            None,
        ),
        (nu206("clearance_class = \"c3\""), "bearing.clearance_class", "unknown word; did you mean \"C3\"", Some(3)),
        (nu206("bore_diameter_mm = 0"), "bearing.bore_diameter_mm", "out of range", Some(3)),
        (nu206("diametral_clearance_um = 2000"), "bearing.diametral_clearance_um", "out of proportion", Some(3)),
    ] {
        let problems = text.expect_err(words);
        let problem = &problems[0];
        let errors = problems.iter().filter(|p| p.severity == Severity::Error);
        assert_eq!(errors.count(), 1, "{}", report(&problems));
        assert_eq!(problem.key, key, "{problem}");
        assert_eq!(problem.line, line, "{problem}");
        assert!(problem.to_string().contains(words), "{problem}");
    }
}

#[test]
fn regress_a_clearance_in_the_wrong_unit_is_warned_of() {
    for (line, words, allowed) in [
        ("radial_clearance_um = 0.02", Some("in mm instead of um?"), ">= 0.2"),
        ("diametral_clearance_um = 0.03", Some("in mm instead of um?"), ">= 0.4"),
        // C5 ends at 95 um on the diameter.
        ("radial_clearance_um = 48", Some("its largest class, C5, ends at 95 um"), "<= 47.5 um"),
        ("diametral_clearance_um = 96", Some("its largest class, C5, ends at 95 um"), "<= 95 um"),
        ("radial_clearance_um = 0", None, ""),
        ("radial_clearance_um = -3", None, ""),
        ("radial_clearance_um = 47.5", None, ""),
    ] {
        let loaded = nu206(line).unwrap_or_else(|p| panic!("{line}: {}", report(&p)));
        let told = report(&loaded.warnings);
        match words {
            Some(words) => {
                assert!(loaded.warnings.len() == 1 && told.contains(words) && told.contains(allowed), "{line}: {told}")
            }
            None => assert_eq!(told, "", "{line}"),
        }
    }
}

#[test]
fn regress_schema_and_template_know_the_ways() {
    let bearing = &json_schema()["properties"]["bearing"]["properties"];
    let classes = bearing["clearance_class"]["oneOf"].as_array().unwrap();
    let mut names: Vec<_> = classes.iter().map(|c| c["const"].clone()).collect();
    names.sort_by_key(ToString::to_string);
    assert_eq!(names, ["C2", "C3", "C4", "C5", "CN"].map(|n| json!(n)));
    assert_eq!(bearing["diametral_clearance_um"]["x-unit"], "um");
    for key in ["bore_diameter_mm", "diametral_clearance_um", "clearance_class"] {
        assert!(template().contains(&format!("# {key}: ")), "{key}");
    }
}
