//! `diff`: two scenarios key by key, defaults included.

use crate::common::{SHORT, brinell, folder_with, parsed, typed};
use std::fs;

#[test]
fn prop_what_differs_is_reported_with_units_and_defaults() {
    let folder = folder_with("a.toml", SHORT);
    let here = folder.path();
    let b = SHORT
        .replace("speed_rpm = 1500.0", "speed_rpm = \"50 Hz\"")
        .replace("[operation]", "[lubricant]\nviscosity_pa_s = 0.02\n[operation]");
    fs::write(here.join("b.toml"), b).unwrap();
    let told = brinell(here, &["diff", "a.toml", "b.toml"]).exits(0).keeps_quiet().out;
    let lines: Vec<Vec<&str>> = told.lines().map(|l| l.split_whitespace().collect()).collect();
    assert_eq!(lines[0], ["key", "a.toml", "b.toml", "unit"]);
    assert!(lines.contains(&vec!["operation.speed_rpm", "1500", "3000", "r/min"]), "{told}");
    let viscosity = lines.iter().find(|l| l[0] == "lubricant.viscosity_pa_s");
    assert_eq!(viscosity.unwrap()[1..], ["0.01", "(default)", "0.02", "Pa", "s"]);
    assert_eq!(lines.len(), 3, "{told}");
    let json = parsed(&brinell(here, &["diff", "a.toml", "b.toml", "--json"]).exits(0).out);
    let all = json["differences"].as_array().unwrap();
    assert_eq!(all.len(), 2);
    let speed = all.iter().find(|d| d["key"] == "operation.speed_rpm").unwrap();
    assert_eq!((&speed["a"]["value"], &speed["b"]["value"]), (&1500.0.into(), &3000.0.into()));
    assert_eq!((&speed["unit"], &speed["b"]["origin"]), (&"r/min".into(), &"file".into()));
}

#[test]
fn prop_a_written_scenario_is_the_same_run_and_so_is_its_folder() {
    let folder = folder_with("a.toml", SHORT);
    let here = folder.path();
    brinell(here, &typed("run a.toml -o o -q --no-report --signals none")).exits(0);
    brinell(here, &["diff", "a.toml", "o"]).exits(0).says(&["no difference: the same run"]);
    // One more defect: its keys are in one alone.
    let more = format!(
        "{SHORT}\n[[defects]]\non = \"roller\"\nroller = 3\ncenter_deg = 0.0\ndepth_um = 5.0\nshape = {{ circle = {{ diameter_mm = 1.0 }} }}\n"
    );
    fs::write(here.join("b.toml"), more).unwrap();
    let told = brinell(here, &["diff", "a.toml", "b.toml"]).exits(0).out;
    let depth = told.lines().find(|l| l.starts_with("defects.1.depth_um")).unwrap();
    let words: Vec<&str> = depth.split_whitespace().collect();
    assert_eq!(words, ["defects.1.depth_um", "-", "5", "um"]);
    fs::write(here.join("bad.toml"), "x = 1").unwrap();
    brinell(here, &["diff", "a.toml", "bad.toml"]).exits(2).complains(&["bad.toml", "unknown key"]);
    brinell(here, &["diff", "a.toml", "none.toml"]).exits(2).complains(&["cannot read none.toml"]);
}
