//! Names of bearings, quantities with units and JSON, over the commands that take them.

use crate::common::{SHORT, brinell, folder_with, json, parsed, with_blocks};
use serde_json::Value;
use std::fs;
use tempfile::tempdir;

#[test]
fn prop_every_command_finds_bearings_however_they_are_written() {
    let folder = tempdir().unwrap();
    let here = folder.path();
    for (name, found) in [
        ("NU 206 ECP", "NU206"),
        ("nu206", "NU206"),
        ("SKF NU-206 ECP", "NU206"),
        ("6205 2RSH/C3", "6205"),
        ("62052RS", "6205"),
        ("SKF 6205", "6205"),
        ("6205 SKF", "6205"),
        ("FAG 6205", "6205"),
    ] {
        let shown = brinell(here, &["bearing", "show", name]).exits(0).out;
        assert!(shown.starts_with(&format!("{found}: ")), "{shown}");
        // To the last digit.
        let frequencies = |name: &str| brinell(here, &["frequencies", name]).exits(0).says(&["BPFO"]).out;
        assert_eq!(frequencies(name), frequencies(found));
        fs::write(
            here.join("s.toml"),
            SHORT
                .replace("NU206", name)
                .replace("profile = \"straight\"", "")
                .replace("length_mm = 2.0, width_mm = 4.0", "length_mm = 1.0, width_mm = 1.0"),
        )
        .unwrap();
        brinell(here, &["check", "s.toml"]).exits(0).says(&[&format!("{found}: 1 row")]);
        brinell(here, &["init", "--bearing", name]).exits(0).says(&[found]);
    }
    for args in [
        &["bearing", "show", "NU2O6"][..],
        &["frequencies", "NU2O6"],
        &["init", "--bearing", "NU2O6"],
        &["check", "s.toml", "--set", "bearing.preset=NU260"],
    ] {
        let call = brinell(here, args).exits(2);
        assert!(call.err.contains("did you mean") && call.err.contains("NU206"), "{call:?}");
    }
}

#[test]
fn lit_the_class_of_clearance_in_a_name_is_used() {
    // ISO 5753-1, deep groove, bore over 24 to 30 mm: C3 is 13 to 28 um on the diameter.
    let folder = tempdir().unwrap();
    let here = folder.path();
    let text = SHORT
        .replace("profile = \"straight\"", "")
        .replace("NU206", "6205-2RSH/C3")
        .replace("width_mm = 4.0", "width_mm = 2.0");
    fs::write(here.join("s.toml"), &text).unwrap();
    brinell(here, &["check", "s.toml", "-a"]).exits(0).says(&[
        "10.25 um on one side, 20.5 um on the diameter",
        "bearing.radial_clearance_um = 10.25 um  (derived: the class of clearance in the bearing's name",
    ]);
    // What the file says outranks the name.
    let own = text.replace("[operation]", "radial_clearance_um = 3.0\n[operation]");
    fs::write(here.join("s.toml"), own).unwrap();
    brinell(here, &["check", "s.toml"]).exits(0).says(&["3 um on one side"]);
}

#[test]
fn lit_bearing_show_gives_the_clearance_of_the_class_in_the_name() {
    let folder = tempdir().unwrap();
    let show = |more: &[&str]| {
        let args = [&["bearing", "show"], more].concat();
        brinell(folder.path(), &args).exits(0).keeps_quiet().out
    };
    // ISO 5753-1: C3 of ball bearings is 13 to 28 um on the diameter for a bore of 25 mm; a quarter of the sum is on
    // one side.
    let told = parsed(&show(&["6205-2RS/C3", "--json"]));
    assert_eq!(told["clearance_class"], "C3");
    let clearance = &told["numbers"]["bearing.radial_clearance_um"];
    assert_eq!(clearance["value"], 10.25);
    let text = show(&["6205-2RS/C3"]);
    let line = |text: &str, of: &str| {
        let found = text.lines().find(|l| l.contains(of));
        found.unwrap_or_default().to_owned()
    };
    assert!(line(&text, "bearing.radial_clearance_um").contains(" 10.25  estimated: C3 in the name"));
    assert!(line(&text, "clearance_C3").ends_with("(this bearing, as its name says)"));
    let plain = show(&["6205"]);
    assert!(!plain.contains("in the name") && !plain.contains("this bearing"), "{plain}");
    assert!(parsed(&show(&["6205", "--json"]))["clearance_class"].is_null());
}

#[test]
fn prop_json_is_what_the_files_hold() {
    let folder = with_blocks("s.toml");
    let here = folder.path();
    let run = ["run", "s.toml", "-o", "o", "--no-report", "--json"];
    let told = parsed(&brinell(here, &run).exits(0).keeps_quiet().out);
    assert_eq!(told, json(&here.join("o/summary.json")));
    fs::copy(here.join("s.toml"), here.join("t.toml")).unwrap();
    let variant = "deep:defects.0.depth_um=40";
    let compare = ["compare", "s.toml", "--variant", variant, "-o", "c", "--json"];
    let told = parsed(&brinell(here, &compare).exits(0).keeps_quiet().out);
    assert_eq!(told, json(&here.join("c/compare.json")));
    let both = ["run", "s.toml", "t.toml", "--json"];
    brinell(here, &both).exits(2).complains(&["of one scenario; here are 2"]);
    let preview = ["defect", "preview", "s.toml", "-o", "p", "--json"];
    let told = parsed(&brinell(here, &preview).exits(0).keeps_quiet().out);
    assert_eq!(told, json(&here.join("p/preview.json")));
}

#[test]
fn prop_a_sweep_as_json_has_the_rows_of_its_table() {
    let folder = with_blocks("s.toml");
    let here = folder.path();
    let vary = "defects.0.depth_um=10,20";
    let sweep = ["sweep", "s.toml", "--vary", vary, "-o", "w", "--json"];
    let mut told = parsed(&brinell(here, &sweep).exits(0).keeps_quiet().out);
    let rows = told.as_object_mut().unwrap().remove("rows").unwrap();
    assert_eq!(told, json(&here.join("w/sweep.json")));
    let text = fs::read_to_string(here.join("w/sweep.csv")).unwrap();
    let mut lines = text.lines();
    let column = |name: &str| {
        let mut head = text.lines().next().unwrap().split(',');
        head.position(|n| n == name).unwrap()
    };
    let rms = column("sensor_ax.rms");
    assert_eq!(rows.as_array().unwrap().len(), lines.by_ref().skip(1).count());
    for (row, line) in rows.as_array().unwrap().iter().zip(text.lines().skip(1)) {
        let printed: f64 = line.split(',').nth(rms).unwrap().parse().unwrap();
        assert_eq!(row["sensor_ax.rms"], printed);
        assert_eq!(row["status"], "complete");
    }
    assert_eq!(rows[1]["defects.0.depth_um"], 20.0);
}

#[test]
fn prop_a_fit_as_json_has_the_numbers_of_the_text() {
    let folder = with_blocks("s.toml");
    let fit = |more: &[&str]| {
        let args = [&["defect", "fit", "s.toml", "--order", "3"], more].concat();
        brinell(folder.path(), &args).exits(0).out
    };
    let (text, told) = (fit(&[]), parsed(&fit(&["--json"])));
    let segments = told["segments"].as_array().unwrap();
    assert_eq!(segments.len(), 6);
    let widths = text.lines().filter_map(|l| l.strip_prefix("  width "));
    for (segment, line) in segments.iter().zip(widths) {
        for (c, printed) in segment["width_mm"].as_array().unwrap().iter().zip(line.split(' ')) {
            assert_eq!(format!("{:.6e}", c.as_f64().unwrap()), printed);
        }
    }
}

#[test]
fn prop_bearings_as_json_have_every_number_with_its_source() {
    let folder = tempdir().unwrap();
    let here = folder.path();
    let list = parsed(&brinell(here, &["bearing", "list", "--json"]).exits(0).out);
    let list = list.as_array().unwrap();
    let catalogued = list.iter().filter(|b| b["kind"] == "catalogue").count();
    assert!(catalogued >= 40, "{catalogued}");
    let rated = |b: &&Value| b["dynamic_load_rating_n"].is_number() && b["static_load_rating_n"].is_number();
    assert!(list.iter().filter(rated).count() >= 40);
    let shown = parsed(&brinell(here, &["bearing", "show", "N 206", "--json"]).exits(0).out);
    // SKF General catalogue: N 206 ECP has E = 55.5 mm, C = 44 kN, C0 = 36.5 kN.
    let outer = &shown["numbers"]["bearing.outer_raceway_diameter_mm"];
    assert_eq!((&outer["value"], &outer["estimated"]), (&55.5.into(), &false.into()));
    assert!(outer["source"].as_str().unwrap().contains("E of N 206 ECP"));
    assert_eq!(shown["dynamic_load_rating_n"], 44000.0);
    assert_eq!(shown["static_load_rating_n"], 36500.0);
    assert_eq!(shown["diametral_clearance_um"]["C3"], serde_json::json!([35.0, 60.0]));
    let counted = &shown["numbers"]["bearing.rollers_per_row"];
    assert_eq!(counted["estimated"], true, "{counted}");
}

#[test]
fn prop_a_letter_o_in_a_size_is_taken_for_the_digit() {
    for (name, meant) in [("62O5", "6205"), ("nu 2o6 ECP", "NU206"), ("NN3OO7", "NN3007")] {
        let folder = folder_with("s.toml", &SHORT.replace("NU206", name));
        let here = folder.path();
        let hint = format!("did you mean {meant}?");
        brinell(here, &["bearing", "show", name]).exits(2).complains(&[&hint]);
        let hint = format!("not in the catalogue; did you mean \"{meant}\"?");
        brinell(here, &["check", "s.toml"]).exits(2).complains(&["line 4", &hint, "`brinell bearing list` shows all"]);
    }
}
