//! `brinell analyze --together`: records of one machine, one verdict.

use crate::common::{GIVEN, brinell, column, impacts, json, parsed};
use std::fs;
use tempfile::{TempDir, tempdir};

/// `all/` with four records of half a second of one damaged machine.
fn records() -> TempDir {
    let folder = tempdir().unwrap();
    fs::create_dir(folder.path().join("all")).unwrap();
    for (k, part) in impacts(6.0).chunks(6000).enumerate() {
        column(&folder.path().join(format!("all/r{}.csv", k + 1)), part);
    }
    folder
}

fn call<'a>(what: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
    [&["analyze"], what, &["--together"], &GIVEN, more].concat()
}

#[test]
fn regress_a_folder_is_one_verdict() {
    let folder = records();
    let done = brinell(folder.path(), &call(&["all"], &["-o", "look", "--json", "all.json"])).exits(0).says(&[
        "all/r1.csv and 3 more, channel column1: 2.000 s, 24000 samples",
        "4 records of one machine, their evidence averaged: the others are all/r2.csv, all/r3.csv, all/r4.csv",
        "Outer race damage",
        "wrote look/report.html",
    ]);
    assert_eq!(done.out.matches("Outer race damage").count(), 1, "{}", done.out);
    let all = json(&folder.path().join("all.json"));
    assert_eq!(all["verdict"]["damage"][0], "outer_race");
    assert_eq!(all["signal"]["records"], 4);
    assert_eq!(all["signal"]["duration_s"], 2.0);
    let paths: Vec<&str> =
        all["file"]["records"].as_array().unwrap().iter().map(|r| r["path"].as_str().unwrap()).collect();
    assert_eq!(paths, ["all/r1.csv", "all/r2.csv", "all/r3.csv", "all/r4.csv"]);
    let page = fs::read_to_string(folder.path().join("look/report.html")).unwrap();
    assert!(page.contains("all/r4.csv") && page.contains("and 3 more"));
    // Of the same records they give way, of others they do not.
    brinell(folder.path(), &call(&["all"], &["-o", "look"])).exits(0);
    brinell(folder.path(), &call(&["all/r1.csv", "all/r2.csv"], &["-o", "look"]))
        .exits(2)
        .complains(&["holds results of another signal"]);
    // A bearing each.
    let two = brinell(folder.path(), &call(&["all"], &["--bearing", "6203", "--json", "-"])).exits(0);
    let two = parsed(&two.out);
    assert_eq!((&two["leads"], two["file"]["records"].as_array().unwrap().len()), (&"6205".into(), 4));
}

#[test]
fn prop_one_record_is_what_it_is_alone() {
    let folder = records();
    let without = [&["analyze", "all/r1.csv"], &GIVEN[..], &["--json", "-"]].concat();
    let plain = brinell(folder.path(), &without).exits(0);
    let one = brinell(folder.path(), &call(&["all/r1.csv"], &["--json", "-"])).exits(0);
    assert_eq!(plain.out, one.out);
}

#[test]
fn regress_what_is_no_record_of_the_machine_is_refused_by_name() {
    let folder = records();
    let at = |name: &str, values: &[f64]| column(&folder.path().join(name), values);
    let refused = |more: &[&str], words: &[&str]| {
        brinell(folder.path(), &call(&["all/r1.csv"], more)).exits(2).complains(words);
    };
    let other = &impacts(6.0)[3000..9000];
    at("short.csv", &other[..2000]);
    refused(
        &["short.csv"],
        &["short.csv, `column1`: 0.1667 s are 5.00 revolutions", "0.2667 s or more", "however many"],
    );
    at("still.csv", &[1.0; 6000]);
    refused(&["still.csv"], &["still.csv, `column1`: all 6000 samples are 1"]);
    fs::copy(folder.path().join("all/r1.csv"), folder.path().join("twin.csv")).unwrap();
    refused(&["twin.csv"], &["--together: twin.csv", "the same samples as all/r1.csv"]);
    refused(&["all/r2.csv", "--against", "all/r3.csv"], &["--against"]);
    refused(&["all/r2.csv", "--channel", "1", "--channel", "2"], &["--together: 2 channels, expected one"]);
}

/// What each file states of itself.
#[test]
fn regress_rate_unit_and_speed_have_to_agree() {
    let folder = tempdir().unwrap();
    let x = impacts(6.0);
    let put = |name: &str, part: usize, rate: f64, unit: &str, rpm: f64| {
        let rows = x[6000 * part..6000 * (part + 1)].iter().enumerate();
        let lines: Vec<String> = rows.map(|(i, v)| format!("{:.9},{v:.5},{rpm}\n", i as f64 / rate)).collect();
        fs::write(folder.path().join(name), format!("t [s],a [{unit}],speed [r/min]\n{}", lines.concat())).unwrap();
    };
    put("first.csv", 0, 12_000.0, "g", 1800.0);
    put("alike.csv", 1, 12_000.0, "g", 1812.0);
    put("rate.csv", 1, 12_800.0, "g", 1800.0);
    put("unit.csv", 1, 12_000.0, "m/s^2", 1800.0);
    put("speed.csv", 1, 12_000.0, "g", 1850.0);
    let look = |other: &str| {
        let files = ["analyze", "first.csv", other, "--together"];
        let known = ["--channel", "a", "--speed-channel", "speed", "--bearing", "6205"];
        brinell(folder.path(), &[&files[..], &known].concat())
    };
    look("alike.csv").exits(0).says(&["first.csv and 1 more", "shaft speed 1800 r/min"]);
    look("rate.csv").exits(2).complains(&["rate.csv", "sample rate 12800", "expected 12000", "first.csv"]);
    look("unit.csv").exits(2).complains(&["unit.csv", "unit m/s^2, expected g, that of first.csv"]);
    look("speed.csv").exits(2).complains(&[
        "speed.csv",
        "1850.00 r/min, expected 1800.00 r/min",
        "within 2 % (--tolerance)",
    ]);
}
