//! A written scenario says of its values what its source said: which are assumed, and why.

use brinell::document::{Loaded, Origin, read, template};

use super::{BARE, good, report, with};

/// Key, value and reason of what is assumed.
fn assumed(loaded: &Loaded) -> Vec<(String, String, String)> {
    let entries = loaded.provenance.iter().filter(|p| p.assumed);
    entries.map(|p| (p.key.clone(), p.value.clone(), p.reason())).collect()
}

#[test]
fn prop_a_written_scenario_has_the_assumptions_of_its_source() {
    let preset = "bearing.preset = \"NN3007\"\noperation = { speed_rpm = 1800.0, load_n = [300.0, 0.0], load_on = \"outer-ring\" }\n";
    for source in [BARE, preset, &template()] {
        let loaded = good(source);
        let before = assumed(&loaded);
        assert!(before.len() >= 10, "{before:?}");
        let text = loaded.to_toml();
        let again = good(&text);
        assert_eq!(assumed(&again), before);
        assert_eq!(again.scenario, loaded.scenario);
        // Written again, it is the same text: comments, reasons and all.
        assert_eq!(again.to_toml(), text);
    }
}

#[test]
fn prop_a_scenario_without_assumptions_has_no_section_for_them() {
    let loaded = good(BARE);
    let bare = loaded.scenario.to_toml();
    assert!(!bare.contains("provenance"));
    assert!(assumed(&good(&bare)).is_empty());
    // The values come first and are the same lines, but for comments.
    let values = |text: &str| -> Vec<String> {
        let lines = text.lines().map(|line| line.split("  #").next().unwrap());
        lines.map(|line| line.trim_end().to_owned()).collect()
    };
    let (whole, bare) = (values(&loaded.to_toml()), values(&bare));
    assert_eq!(whole[..bare.len()], bare);
}

#[test]
fn regress_a_value_that_is_changed_or_overridden_is_its_authors() {
    const KEY: &str = "cage.mass_kg";
    let text = good(BARE).to_toml();
    let of = |loaded: &Loaded| loaded.provenance_of(KEY).unwrap().clone();
    let mass = of(&good(&text));
    assert!(mass.assumed && matches!(mass.origin, Origin::Recorded(_)));
    let line = text.lines().find(|l| l.starts_with("mass_kg = ")).unwrap();
    let edited = good(&text.replacen(line, "mass_kg = 0.02", 1));
    assert_eq!((of(&edited).origin, of(&edited).assumed), (Origin::File, false));
    assert!(!edited.to_toml().contains(&format!("key = \"{KEY}\"")));
    // An override is stated, even where it states the value that was assumed.
    for value in ["0.02", &mass.value] {
        let set = with(&text, &[(KEY, value)]).unwrap();
        assert_eq!((of(&set).origin, of(&set).assumed), (Origin::Override, false));
        assert_eq!(assumed(&set).len(), assumed(&good(BARE)).len() - 1);
    }
    // A line that is taken out is assumed once more, for the reason of its default.
    let without = good(&text.replacen(line, "", 1));
    assert!(of(&without).assumed && matches!(of(&without).origin, Origin::Derived(_)));
}

#[test]
fn regress_entries_of_what_is_not_there_say_nothing_and_bad_ones_are_refused() {
    let with_entries = |entries: &str| read(&format!("{BARE}\n[provenance]\nassumed = [{entries}]\n"), &[]);
    // A defect that was taken out of the file.
    let gone = "{ key = \"defects.3.depth_um\", value = 1.0, reason = \"default\" }";
    assert_eq!(assumed(&with_entries(gone).unwrap()), assumed(&good(BARE)));
    for (entries, parts) in [
        (
            "{ key = \"cage.mass\", value = 1.0, reason = \"x\" }",
            "\"cage.mass\" is no key of a scenario; did you mean `mass_kg`?",
        ),
        ("{ key = \"cage.mass_kg\", reason = \"x\" }", "missing: `value`"),
        ("{ key = \"cage.mass_kg\", value = 1.0, why = \"x\" }", "unknown key `why`"),
        ("{ key = 3, value = 1.0, reason = \"x\" }", "`key` must be a string"),
        ("3", "expected a table, found a whole number"),
        (
            "{ key = \"cage.mass_kg\", value = 1.0, reason = \"x\" }, { key = \"cage.mass_kg\", value = 1.0, reason = \"x\" }",
            "\"cage.mass_kg\" is here twice",
        ),
    ] {
        let problems = with_entries(entries).unwrap_err();
        let text = report(&problems);
        assert!(text.contains(parts) && text.contains("provenance.assumed"), "{text}");
        assert!(problems.iter().all(|p| p.line.is_some()), "{text}");
    }
    let unknown = read(&format!("{BARE}\n[provenance]\nassume = []\n"), &[]).unwrap_err();
    assert!(report(&unknown).contains("did you mean `assumed`?"), "{}", report(&unknown));
}
