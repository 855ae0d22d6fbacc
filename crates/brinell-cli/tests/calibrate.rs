//! Calibrations: known keys come back from brinell's own runs, nothing depends on threads or interruptions, and what is
//! wrong is said.

use crate::common::{brinell, cut_journal, files, interrupted, json, lines, same, typed, with_blocks};
use serde_json::Value;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

fn folder() -> TempDir {
    with_blocks("base.toml")
}

fn call<'a>(more: &[&'a str]) -> Vec<&'a str> {
    ["calibrate", "base.toml"].iter().chain(more).copied().collect()
}

/// Numbers of a run of the base with a setting, from a sweep of one point.
fn truth(folder: &Path, setting: &str, more: &[&str]) -> Value {
    let args = ["sweep", "base.toml", "--vary", setting, "-o", "truth", "-q"];
    let args = [&args, more].concat();
    brinell(folder, &args).exits(0).keeps_quiet();
    let journal = fs::read_to_string(folder.join("truth/journal.jsonl")).unwrap();
    let row = journal.lines().nth(1).unwrap();
    serde_json::from_str::<Value>(row).unwrap()["values"].clone()
}

/// A target that the truth has, as an option.
fn target(truth: &Value, name: &str, uncertainty: &str) -> String {
    format!("--target {name}={:?}~{uncertainty}", truth[name]["value"].as_f64().unwrap())
}

#[test]
fn prop_a_known_speed_comes_back() {
    let folder = folder();
    let truth = truth(folder.path(), "operation.speed_rpm=2950", &[]);
    let frequency = target(&truth, "defect1.pure_rolling_frequency", "0.1%");
    let rms = target(&truth, "sensor_ax.rms", "5%");
    let args = format!("--fit operation.speed_rpm=2500:3500 {frequency} {rms} --budget 20 -o cal");
    brinell(folder.path(), &call(&typed(&args)))
        .exits(0)
        .says(&["1 key to 2 targets", "up to 20 runs", "wrote cal/best.toml"])
        .complains(&["warning: parametric work: ", " runs looked at, the first of them run 1)"]);
    let cal = folder.path().join("cal");
    assert_eq!(files(&cal), ["best.toml", "calibrate.csv", "calibrate.html", "calibrate.json", "journal.jsonl"]);
    let found = json(&cal.join("calibrate.json"));
    let speed = &found["keys"][0];
    assert_eq!(speed["determined"], true, "{found:#}");
    // Three standard uncertainties of the target.
    let off = speed["value"].as_f64().unwrap() / 2950.0 - 1.0;
    assert!(off.abs() < 3e-3, "{speed}");
    // The best scenario is one that is sound.
    brinell(&cal, &["check", "best.toml"]).exits(0);
}

#[test]
fn prop_two_known_keys_come_back_within_their_intervals() {
    let folder = folder();
    // Of a run with both keys off the middle of their ranges.
    let truth = truth(folder.path(), "operation.speed_rpm=2950", &["--set", "operation.load_n=[410.0,0.0]"]);
    let frequency = target(&truth, "defect1.pure_rolling_frequency", "0.1%");
    let force = target(&truth, "row1.largest_outer_force", "2%");
    let rms = target(&truth, "sensor_ax.rms", "5%");
    let fit = "--fit operation.speed_rpm=2500:3500 --fit operation.load_n.0=200:800";
    let args = format!("{fit} {frequency} {force} {rms} --budget 40 -o cal");
    brinell(folder.path(), &call(&typed(&args))).exits(0).says(&[
        "2 keys to 3 targets",
        "operation.load_n.0 from 200.0 to 800.0 N",
        "The targets are met",
        "Every key is determined",
    ]);
    let found = json(&folder.path().join("cal/calibrate.json"));
    for (k, known) in [2950.0, 410.0].into_iter().enumerate() {
        let [low, high] = ["low", "high"].map(|end| found["keys"][k][end].as_f64().unwrap());
        assert!(low < known && known < high, "{found:#}");
    }
}

#[test]
fn prop_neither_threads_nor_interruptions_change_a_byte() {
    let folder = folder();
    let truth = truth(folder.path(), "operation.speed_rpm=2900", &[]);
    let frequency = target(&truth, "defect1.pure_rolling_frequency", "0.2");
    let rest = "--target sensor_ax.rms=30~10% --budget 14 --set simulation.duration_s=0.06";
    let given = format!("--fit operation.speed_rpm=2500:3500 {frequency} {rest}");
    let args = |out: &'static str, jobs: &'static str| call(&[&typed(&given)[..], &["-o", out, "-j", jobs]].concat());
    let run = |out, jobs| brinell(folder.path(), &args(out, jobs)).exits(0);
    run("one", "1");
    run("three", "3");
    let out = |name: &str| folder.path().join(name);
    same(&out("one"), &out("three"));
    // The header and four runs are whole, the fifth was being written.
    cut_journal(&out("three"), 5, &out("cut"));
    run("cut", "2").says(&["4 runs in the journal"]);
    same(&out("one"), &out("cut"));
    run("cut", "2").says(&["0 runs in"]);
    same(&out("one"), &out("cut"));
    // Ctrl-C after the first runs.
    let journal = out("broken").join("journal.jsonl");
    interrupted(folder.path(), &args("broken", "1"), &journal, 3)
        .exits(1)
        .complains(&["interrupted: finished runs are kept in broken"]);
    assert!((3..15).contains(&lines(&journal)));
    run("broken", "2");
    same(&out("one"), &out("broken"));
}

#[test]
fn prop_a_measured_signal_is_met_by_the_run_that_made_it() {
    let folder = folder();
    let args = typed("run base.toml --set operation.speed_rpm=3300 --no-report -q -o rig");
    brinell(folder.path(), &args).exits(0);
    let args = call(&typed("--fit operation.speed_rpm=2700:3700 --measured rig --budget 20 -o cal"));
    brinell(folder.path(), &args).exits(0).says(&["against sensor_ax", "signature.octave_5120_10240_hz"]);
    let found = json(&folder.path().join("cal/calibrate.json"));
    assert!(found["chi_square"].is_number(), "{found:#}");
    let columns = fs::read_to_string(folder.path().join("cal/calibrate.csv")).unwrap();
    assert!(columns.contains("signature.octave_5120_10240_hz.residual"));
}

#[test]
fn prop_a_measured_signals_levels_do_not_depend_on_the_bounds_of_the_speed() {
    let folder = folder();
    let own = "--set simulation.duration_s=1 --set operation.speed_rpm=3300";
    brinell(folder.path(), &typed(&format!("run base.toml {own} --no-report --no-healthy -q -o rig"))).exits(0);
    let targets = |bounds: &str| -> Vec<String> {
        let args = format!("{own} --fit operation.speed_rpm={bounds} --measured rig -o cal --dry-run");
        let done = brinell(folder.path(), &call(&typed(&args))).exits(0);
        done.out.lines().filter(|line| line.contains(" ~ ")).map(str::to_owned).collect()
    };
    let near = targets("3250:3350");
    assert!(near.iter().any(|line| line.contains("defect1.frequency")), "{near:#?}");
    assert_eq!(near, targets("2900:4100"));
}

#[test]
fn prop_the_length_of_damage_comes_back_from_its_events_whatever_the_way_to_the_sensor() {
    let folder = folder();
    let at = "defects.0.shape.rectangle.length_mm";
    let own = "--set simulation.duration_s=0.6 --set operation.speed_rpm=2000 --set defects.0.depth_um=40";
    let path = "--set sensor.path=[{frequency_hz=2700.0,damping_ratio=0.04,gain=-0.6}]";
    brinell(
        folder.path(),
        &typed(&format!("run base.toml {own} {path} --set {at}=3.1 --no-report --no-healthy -q -o rig")),
    )
    .exits(0);
    let fit = format!("{own} --fit {at}=1.5:4.5 --measured rig -o cal --budget 14");
    brinell(folder.path(), &call(&typed(&format!("{fit} --events-only")))).exits(0).says(&[
        "1 key to 1 target:",
        "signature.event_spacing_bpfo = ",
        "The targets are met",
    ]);
    let found = json(&folder.path().join("cal/calibrate.json"));
    let [low, high] = ["low", "high"].map(|end| found["keys"][0][end].as_f64().unwrap());
    assert!(low < 3.1 && 3.1 < high && high - low < 0.6, "{found:#}");
    assert_eq!(found["targets"][0]["unit"], "s");
    // Damage as short as the contact has one event.
    brinell(folder.path(), &typed(&format!("run base.toml {own} --set {at}=0.1 --no-report --no-healthy -q -o short")))
        .exits(0);
    let short = format!("{own} --fit {at}=1.5:4.5 --measured short --events-only -o none");
    brinell(folder.path(), &call(&typed(&short)))
        .exits(2)
        .complains(&["there are no two events in each pass to fit to: no second event is clear"]);
}

#[test]
fn prop_targets_out_of_reach_are_reported_and_so_is_a_key_without_effect() {
    let folder = folder();
    let args = call(&typed(
        "--fit operation.speed_rpm=2900:3100 --fit cage.guide_width_mm=5:7 --target defect1.pure_rolling_frequency=500~1 --budget 14 --set simulation.duration_s=0.04 -o cal",
    ));
    brinell(folder.path(), &args).exits(0).says(&[
        "The targets are not met by the runs made: chi-square",
        "defect1.pure_rolling_frequency:",
        "standard uncertainties too low",
        "operation.speed_rpm: the best value is on its upper bound",
        "cage.guide_width_mm: not determined; the data say nothing of it",
    ]);
    let found = json(&folder.path().join("cal/calibrate.json"));
    assert_eq!(found["met"], false);
    let page = fs::read_to_string(folder.path().join("cal/calibrate.html")).unwrap();
    assert!(page.contains("The targets are not met by the runs made.") && !page.contains("Runs that failed"));
    assert_eq!(found["keys"][1]["determined"], false);
    assert_eq!(found["keys"][1]["low"], Value::Null);
}

#[test]
fn regress_runs_that_fail_are_rows() {
    let folder = folder();
    // Each bound is good with the middle of the other; in a corner the damage is wider than ten rollers.
    let args = call(&typed(
        "--fit bearing.roller_length_mm=6:17 --fit defects.0.shape.rectangle.width_mm=3:115 --target sensor_ax.rms=30~1 --budget 40 --set simulation.duration_s=0.02 -o cal",
    ));
    brinell(folder.path(), &args).exits(0);
    let cal = folder.path().join("cal");
    let failed = json(&cal.join("calibrate.json"))["runs"]["failed"].as_u64();
    assert!(failed > Some(0), "{failed:?}");
    let table = fs::read_to_string(cal.join("calibrate.csv")).unwrap();
    let rows = table.lines().filter(|line| line.contains("failed")).count();
    assert_eq!(Some(rows as u64), failed);
    assert!(table.contains("width_mm"), "{table}");
    let page = fs::read_to_string(cal.join("calibrate.html")).unwrap();
    assert!(page.contains("Runs that failed"));
}

#[test]
fn regress_bad_input_is_reported_with_key_value_and_range() {
    let folder = folder();
    let good = ["--fit", "operation.speed_rpm=2900:3100"];
    let refuse = |more: &[&str], parts: &[&str]| {
        brinell(folder.path(), &call(more)).exits(2).complains(parts);
    };
    refuse(&[], &["--fit"]);
    refuse(&good, &["there is nothing to fit to: give --target NAME=VALUE~UNCERTAINTY, or --measured FILE"]);
    let with = |more: &[&'static str]| [&good[..], more].concat();
    let reversed = "--fit: operation.speed_rpm = 3100:2900: the bounds are reversed; 2900.0:3100.0 is meant";
    for (fit, parts) in [
        ("operation.speed_rmp=1:2", &["operation.speed_rmp", "speed_rpm"][..]),
        ("operation.speed_rpm=3100:2900", &[reversed]),
        ("bearing.roller_diameter_mm=-3:8", &["bearing.roller_diameter_mm", "-3", "mm"]),
        ("name=1:2", &["name"]),
    ] {
        refuse(&["--fit", fit, "--target", "sensor_ax.rms=30~1"], parts);
    }
    refuse(
        &with(&["--target", "sensor_ax.rmss=30~1"]),
        &["--target sensor_ax.rmss: no such number of a run", "allowed: the columns of `brinell sweep`, such as"],
    );
    refuse(
        &with(&["--target", "sensor_ax.rms=30"]),
        &["--target: sensor_ax.rms = 30: no standard uncertainty is given"],
    );
    refuse(
        &with(&["--target", "row1.largest_outer_force=-3~1"]),
        &["--target: row1.largest_outer_force = -3.0: a number of this kind is never below 0", "allowed: 0 or more"],
    );
    refuse(
        &with(&["--target", "sensor_ax.rms=30~1", "--budget", "3"]),
        &["--budget 3: expected 6 runs or more for 1 key"],
    );
    refuse(&with(&["--measured", "nowhere.csv"]), &["nowhere.csv"]);
    refuse(&with(&["--rate", "25600", "--target", "sensor_ax.rms=30~1"]), &["give --measured FILE"]);
    let target = ["--target", "sensor_ax.rms=30~1"];
    let set = ["--set", "operation.speed_rpm=3000"];
    refuse(&with(&[&target[..], &set].concat()), &["--set operation.speed_rpm=3000: every run gives", "as --fit says"]);
    refuse(&with(&["--target", "sensor_ax.rms=-20~5%"]), &["sensor_ax.rms = -20.0", "allowed: 0 or more"]);
    for percent in ["500", "-5"] {
        refuse(&with(&[&target[..], &["--model-uncertainty", percent]].concat()), &["--measured <FILE|FOLDER>"]);
    }
    fs::write(folder.path().join("file"), "").unwrap();
    refuse(&with(&[&target[..], &["-o", "file"]].concat()), &["cannot make the folder file: file is a file"]);
    fs::remove_file(folder.path().join("file")).unwrap();
    fs::write(folder.path().join("rig.csv"), "t,a\n0,1\n0.001,2\n0.002,1\n0.003,3\n").unwrap();
    let rig = with(&["--measured", "rig.csv", "--channel", "a", "--unit", "m/s^2"]);
    let rated = [&rig[..], &["--rate", "1000"]].concat();
    refuse(&rated, &["is sampled at 1000 Hz, and the scenario at 25600 Hz", "--set simulation.sample_rate_hz=1000.0"]);
    let unit = with(&["--measured", "rig.csv", "--channel", "a", "--unit", "V", "--rate", "25600"]);
    refuse(&unit, &["a calibration takes accelerations"]);
    assert!(files(folder.path()).len() == 2, "nothing is written");
    let plan = with(&["--target", "sensor_ax.rms=30~1", "--dry-run"]);
    brinell(folder.path(), &call(&plan))
        .exits(0)
        .says(&["1 key to 1 target", "up to 30 runs"])
        .says(&["  sensor_ax.rms = 30.0 ~ 1.0 m/s^2\n"]);
    let plan = brinell(folder.path(), &call(&[&plan[..], &["--json"]].concat())).exits(0).keeps_quiet();
    let plan: serde_json::Value = serde_json::from_str(&plan.out).unwrap();
    assert_eq!(plan["keys"][0]["key"], "operation.speed_rpm", "{plan}");
    assert_eq!((&plan["targets"][0]["name"], &plan["targets"][0]["value"]), (&"sensor_ax.rms".into(), &30.0.into()));
    assert_eq!((&plan["runs"], &plan["warnings"]), (&30.into(), &serde_json::json!([])));
}
