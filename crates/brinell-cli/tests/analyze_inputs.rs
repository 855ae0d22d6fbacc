//! `brinell analyze`: tachometers, short records, words among numbers, and what else files of instruments hold.

use crate::common::{FS, brinell, column, impacts, json, typed};
use std::fmt::Write;
use std::fs;
use std::path::Path;
use tempfile::tempdir;

/// A signal beside a second channel, given by the sample's number.
fn beside(path: &Path, x: &[f64], name: &str, other: impl Fn(usize) -> f64) {
    let mut text = format!("acc,{name}\n");
    for (i, v) in x.iter().enumerate() {
        writeln!(text, "{v:.5},{}", other(i)).unwrap();
    }
    fs::write(path, text).unwrap();
}

/// 30 turns a second: the signals of these tests.
const RATE: &str = "--rate 12000 --unit g --bearing 6205";

#[test]
fn analytic_a_tachometer_gives_the_speed() {
    let folder = tempdir().unwrap();
    let x = impacts(6.0);
    for a_turn in [1.0, 8.0] {
        let pulse = |i: usize| 5.0 * f64::from(u8::from((a_turn * 30.0 * i as f64 / FS).fract() < 0.2));
        beside(&folder.path().join("tacho.csv"), &x, "tach", pulse);
        let args = format!("analyze tacho.csv --channel acc {RATE} --tacho tach --pulses {a_turn}");
        let call = brinell(folder.path(), &typed(&args)).exits(0);
        call.says(&["shaft speed 1800", "the mean of the channel `tach`, ", " a turn"]);
    }
    let args = format!("analyze tacho.csv --channel acc {RATE} --speed-channel tach");
    brinell(folder.path(), &typed(&args))
        .exits(2)
        .complains(&["--speed-channel tach: it holds pulses, not speeds in r/min; give --tacho tach"]);
    let args = format!("analyze tacho.csv --channel acc {RATE} --tacho acc");
    brinell(folder.path(), &typed(&args)).exits(2).complains(&["--tacho acc: its "]);
}

/// A speed that rises is followed by its pulses as by a channel of speeds.
#[test]
fn xval_pulses_are_followed_as_a_speed_channel() {
    let folder = tempdir().unwrap();
    let x = impacts(6.0);
    let hz = |i: usize| 30.0 + 2.0 * i as f64 / FS;
    let turns = |i: usize| {
        let t = i as f64 / FS;
        30.0 * t + t * t
    };
    let pulse = |i: usize| f64::from(u8::from((4.0 * turns(i)).fract() < 0.5));
    beside(&folder.path().join("tacho.csv"), &x, "tach", pulse);
    beside(&folder.path().join("speed.csv"), &x, "rpm", |i| 60.0 * hz(i));
    let mut found = Vec::new();
    for (file, given) in [("tacho.csv", "--tacho tach --pulses 4"), ("speed.csv", "--speed-channel rpm")] {
        let args = format!("analyze {file} --channel acc {RATE} {given} --json r.json");
        brinell(folder.path(), &typed(&args)).exits(0).says(&["so envelopes are taken at equal angles of the shaft"]);
        found.push(json(&folder.path().join("r.json")));
    }
    let speed = |k: usize| found[k]["shaft"]["given_hz"].as_f64().unwrap();
    assert!((speed(0) / speed(1) - 1.0).abs() < 2e-3, "{} {}", speed(0), speed(1));
    let score = |k: usize| found[k]["families"][0]["score"].as_f64().unwrap();
    assert!((score(0) - score(1)).abs() < 0.1 * score(1).abs() + 0.3, "{} {}", score(0), score(1));
}

#[test]
fn analytic_short_records_have_levels_and_no_verdict() {
    let folder = tempdir().unwrap();
    let x = impacts(6.0);
    for (k, name) in ["a.csv", "b.csv"].into_iter().enumerate() {
        column(&folder.path().join(name), &x[1200 * k..1200 * (k + 1)]);
    }
    let given = format!("{RATE} --speed 1800");
    let words = "Too short for a verdict: 0.1000 s are 3.00 revolutions of the shaft; it takes 0.2667 s or more";
    let both = brinell(folder.path(), &typed(&format!("analyze a.csv b.csv {given} --json r.json -o look"))).exits(0);
    both.says(&["too short", "a.csv and 1 more: ", words]);
    let found = json(&folder.path().join("r.json"));
    let record = &found["records"][1];
    let part = &x[1200..2400];
    let mean = part.iter().sum::<f64>() / 1200.0;
    let rms = (part.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / 1200.0).sqrt();
    let said = record["indicators"]["rms"]["value"].as_f64().unwrap();
    assert!((said / rms - 1.0).abs() < 1e-3, "{said} {rms}");
    assert_eq!(
        (record["verdict"]["says"].as_str(), record["signal"]["samples"].as_u64()),
        (Some("too_short"), Some(1200))
    );
    let alone = format!("analyze a.csv {given} --json alone.json");
    brinell(folder.path(), &typed(&alone)).exits(0).says(&["too short", words]);
    assert_eq!(json(&folder.path().join("alone.json"))["verdict"]["says"].as_str(), Some("too_short"));
    // A speed that may be in Hz is doubted first.
    column(&folder.path().join("c.csv"), &x[..12_000]);
    brinell(folder.path(), &typed(&format!("analyze c.csv {RATE} --speed 30")))
        .exits(2)
        .complains(&["a speed in Hz is written 30.00Hz"]);
}

#[test]
fn prop_a_word_among_the_numbers_is_refused_and_may_be_skipped() {
    let folder = tempdir().unwrap();
    let mut lines: Vec<String> = impacts(6.0).iter().map(|v| format!("{v:.5}")).collect();
    lines[1200] = "Overload".into();
    lines.push("End of record 7".into());
    fs::write(folder.path().join("x.csv"), format!("acc\n{}\n", lines.join("\n"))).unwrap();
    let given = format!("analyze x.csv {RATE} --speed 1800");
    brinell(folder.path(), &typed(&given)).exits(2).complains(&[
        "line 1202",
        "`Overload` is not a number",
        "--duration 0.1 takes what is before it, --start 0.10008333333333333 what follows",
    ]);
    brinell(folder.path(), &typed(&format!("{given} --start 0.2 --duration 1")))
        .exits(0)
        .complains(&["that lies beyond the stretch which is analysed"])
        .says(&["1.000 s, 12000 samples"]);
}

/// cos 15 degrees in the textbook's formulas: 9 balls of 7.94 mm on 39.04 mm at 1500 r/min.
#[test]
fn analytic_a_bearing_by_name_takes_a_contact_angle() {
    let folder = tempdir().unwrap();
    for name in ["6205", "--bearing 6205"] {
        let call = brinell(folder.path(), &typed(&format!("frequencies {name} --contact-angle 15 --speed 1500")));
        call.exits(0).says(&["90.3993 Hz", "contact angle 15 degrees, as given"]);
    }
    let args = "frequencies --bearing 6205 --contact-angle 95 --speed 1500";
    brinell(folder.path(), &typed(args)).exits(2).complains(&["--contact-angle 95: expected 0 to below 90 degrees"]);
    column(&folder.path().join("x.csv"), &impacts(6.0));
    let args = format!("analyze x.csv {RATE} --speed 1800 --contact-angle 15");
    brinell(folder.path(), &typed(&args)).exits(0).says(&["contact angle 15 degrees, as given"]);
}
