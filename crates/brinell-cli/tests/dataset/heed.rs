//! What would mislead a user of the signals is said: units, clipping, repeats, kernels.

use super::{PLAN, cell, command, files, folder_with, json, list, make, rows};
use crate::common::Call;
use parquet::record::{Field, Row};
use std::fs;
use std::path::Path;

/// [`PLAN`] with the sensor's own channel as its signal, and more keys that vary.
fn with_sensor(vary: &str) -> String {
    PLAN.replace("[vary]", &format!("signals = [\"sensor_out\"]\n[vary]\n{vary}"))
}

fn all_rows(out: &Path) -> Vec<Row> {
    files(&out.join("runs")).iter().flat_map(|name| rows(&out.join("runs").join(name))).collect()
}

#[test]
fn regress_a_channel_has_one_unit_in_all_runs() {
    let choice =
        "sensor = { choice = [{ direction_deg = 90 }, { direction_deg = 90, sensitivity_mv_per_m_per_s2 = 10.2 }] }";
    let folder = folder_with(&with_sensor(choice));
    make(folder.path(), &["-o", "out"]).exits(2).complains(&[
        "plan.toml:",
        "signals = \"sensor_out\": in ",
        " in run 0 (class \"healthy\") and in ",
        "a column has one unit",
    ]);
    assert!(!folder.path().join("out").exists());
    // So where it is a class that sets it.
    let of_class = "vary.sensor = { direction_deg = 90, sensitivity_mv_per_m_per_s2 = 10.2 }";
    let plan = with_sensor("").replace("name = \"outer\"", &format!("name = \"outer\"\n{of_class}"));
    let plan = plan.replace("defects = []", "defects = []\nvary.sensor = { direction_deg = 90 }");
    make(folder_with(&plan).path(), &["--dry-run"])
        .exits(2)
        .complains(&["in m/s^2 in run 0 (class \"healthy\") and in mV in run 1 (class \"outer\")"]);
}

#[test]
fn regress_a_direction_that_varies_is_said_by_its_key() {
    let folder = folder_with(&with_sensor("sensor.direction_deg = { grid = [0, 45, 90] }"));
    make(folder.path(), &["-o", "out", "-q"]).exits(0);
    let about = json(&folder.path().join("out/dataset.json"));
    let column = about["columns"].as_array().unwrap().iter().find(|c| c["name"] == "sensor_out").unwrap();
    let words = "acceleration that the sensor reads along sensor.direction_deg after the anti-alias filter";
    assert_eq!(column["description"], words);
    assert!(fs::read_to_string(folder.path().join("out/croissant.json")).unwrap().contains(words));
}

#[test]
fn prop_runs_that_are_clipped_or_constant_are_counted_by_class() {
    let plan = with_sensor(
        "sensor.direction_deg = 0\nsensor.converter_bits = 8\nsensor.converter_range_m_per_s2 = { grid = [0.5, 1e7] }",
    );
    let folder = folder_with(&plan);
    let made = make(folder.path(), &["-o", "out"]).exits(0);
    let out = folder.path().join("out");
    let (mut clipped, mut constant) = ([0, 0], [0, 0]);
    for row in all_rows(&out) {
        let Field::Long(label) = cell(&row, "label") else { panic!("a label") };
        let Field::Long(count) = cell(&row, "clipped_samples") else { panic!("a count") };
        let x = list(&row, "sensor_out").unwrap();
        let range = cell(&row, "sensor.converter_range_m_per_s2") == &Field::Double(0.5);
        // Ends of the codes: a sample there may be one that just fits.
        let ends = x.iter().filter(|v| **v == -0.5 || **v == 0.5 - 0.5 / 128.0).count() as i64;
        assert!(*count <= ends + 1 && (*count > 0) == range, "{count} clipped, {ends} at the ends");
        let is_constant = x.iter().all(|v| *v == x[0]);
        assert_eq!(is_constant, !range);
        clipped[*label as usize] += usize::from(*count > 0);
        constant[*label as usize] += usize::from(is_constant);
    }
    let of = |counts: [usize; 2], what: &str| {
        format!("{} of 7 runs {what} (healthy {} of 4, outer {} of 3): ", counts[0] + counts[1], counts[0], counts[1])
    };
    let told = [
        of(clipped, "have samples beyond the ADC's range, which are clipped"),
        of(constant, "have a signal that is one value throughout"),
    ];
    let card = fs::read_to_string(out.join("README.md")).unwrap();
    for words in &told {
        assert!(made.err.contains(&format!("warning: {words}")), "{words} in {made:#?}");
        assert!(card.contains(words.as_str()), "{words} in {card}");
    }
    let split = json(&out.join("dataset.json"))["splits"][0].clone();
    assert_eq!(split["clipped_of_classes"], serde_json::json!(clipped));
    assert_eq!(split["constant_of_classes"], serde_json::json!(constant));
}

#[test]
fn prop_runs_that_draw_nothing_that_differs_are_warned_of() {
    let alike = PLAN
        .replace("{ uniform = [1400, 1600] }", "{ choice = [1400, 1600] }")
        .replace("{ log = [5, 20] }", "10")
        .replace("[vary]", "[split]\ntest = 0.4\nby = []\n[vary]");
    // A random shape has a seed of its own in each run, so the healthy ones repeat alone.
    let folder = folder_with(&alike.replace("runs = 7", "runs = 20"));
    let told = make(folder.path(), &["--dry-run"]).exits(0);
    let told = told.complains(&[
        "warning: 10 of 20 runs looked at have the scenario of another run, such as run ",
        "(2 scenarios in all)",
        "several splits",
    ]);
    assert!(told.err.contains("their signals are the same to the bit"));
    let other = make(folder_with(PLAN).path(), &["--dry-run"]).exits(0);
    assert!(!other.err.contains("of another run"), "{other:?}");
}

#[test]
fn prop_a_data_set_has_one_kernel() {
    let folder = folder_with(PLAN);
    let at = |name: &str| folder.path().join(name);
    let call = |kernel: &str, args: &[&str]| -> Call {
        let mut command = command(folder.path(), args);
        command.env("BRINELL_KERNEL", kernel).output().unwrap().into()
    };
    let shard = |kernel: &str, out: &str, shard: &str| {
        call(kernel, &["dataset", "plan.toml", "-o", out, "--shard", shard, "-q"])
    };
    shard("portable", "one", "1/2").exits(0);
    shard("plain", "one", "2/2")
        .exits(2)
        .complains(&["one holds runs of the kernel portable, and these are of plain", "set BRINELL_KERNEL=portable"]);
    shard("plain", "two", "2/2").exits(0);
    call("portable", &["dataset", "merge", "one", "two", "-o", "all"])
        .exits(2)
        .complains(&["two holds runs of the kernel plain, and these are of portable"]);
    assert!(!at("all").exists());
    // Brought together by hand.
    fs::copy(at("two/runs/part-00001.parquet"), at("one/runs/part-00001.parquet")).unwrap();
    fs::copy(at("two/work/part-00001.json"), at("one/work/part-00001.json")).unwrap();
    shard("portable", "one", "1/1").exits(0);
    call("plain", &["dataset", "verify", "one"])
        .exits(1)
        .complains(&["runs/part-00001.parquet: computed with the kernel plain, the data set with portable"]);
}

#[cfg(unix)]
#[test]
fn regress_a_folder_that_cannot_be_made_is_refused() {
    let folder = folder_with(PLAN);
    fs::write(folder.path().join("file"), "").unwrap();
    for out in ["file", "file/in"] {
        make(folder.path(), &["-o", out, "-q"]).exits(2).complains(&["cannot make the folder file"]);
    }
}
