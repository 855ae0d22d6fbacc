//! `brinell analyze --size`: how long the damage is.

use crate::common::{brinell, json};
use serde_json::Value;
use std::fs;
use std::path::Path;
use tempfile::{TempDir, tempdir};

/// A bearing with rectangular damage of this length, at 1800 r/min, its sensor behind two resonances and with noise; 0.5 mm is none to be told.
fn run(bearing: &str, on: &str, load: u32, length: f64) -> TempDir {
    let folder = tempdir().unwrap();
    let text = format!(
        "[bearing]\npreset = \"{bearing}\"\n[operation]\nspeed_rpm = 1800\nload_n = [0, -{load}]\nload_on = \"inner-ring\"\n\
         [[defects]]\non = \"{on}\"\ndepth_um = 100\nshape.rectangle = {{ length_mm = {length}, width_mm = 6 }}\n\
         [contact]\ntables = \"coarse\"\n\
         [sensor]\nnoise_rms_m_per_s2 = 0.5\npath = [{{ frequency_hz = 2900, gain = 1 }}, {{ frequency_hz = 6100, gain = -0.6 }}]\n\
         [simulation]\nduration_s = 1.2\nsample_rate_hz = 25600\nstart = \"equilibrium\"\nrecord = [\"sensor_ay\"]\n"
    );
    fs::write(folder.path().join("it.toml"), text).unwrap();
    let more = ["-o", "out", "--signals", "csv", "--no-report", "--no-healthy", "-q"];
    brinell(folder.path(), &[&["run", "it.toml"], &more[..]].concat()).exits(0);
    fs::rename(folder.path().join("out/signals.csv"), folder.path().join("x.csv")).unwrap();
    folder
}

fn size(folder: &Path, of_bearing: &[&str]) -> Value {
    let given = [
        "analyze",
        "x.csv",
        "--channel",
        "sensor_ay",
        "--unit",
        "m/s^2",
        "--rate",
        "25600",
        "--speed",
        "1800rpm",
        "--size",
        "--json",
        "a.json",
    ];
    brinell(folder, &[&given[..], of_bearing].concat()).exits(0);
    json(&folder.join("a.json"))
}

#[test]
fn prop_the_interval_holds_the_length_of_damage_that_was_simulated() {
    for (bearing, on, load, length) in [("6205", "outer-raceway", 900, 3.0), ("NU206", "inner-raceway", 3000, 2.5)] {
        let folder = run(bearing, on, load, length);
        let found = size(folder.path(), &["--bearing", bearing]);
        let of = &found["size"]["length_mm"];
        let [low, value, high] = ["low", "value", "high"].map(|end| of[end].as_f64().unwrap_or(f64::NAN));
        assert!(low < length && length < high, "{bearing} {on}: {found}");
        assert!((value / length - 1.0).abs() < 0.15, "{bearing} {on}: {found}");
        let text = found["verdict"]["text"].as_str().unwrap();
        assert!(text.contains("mm along the rolling direction, 95 % of simulated damage within"), "{text}");
    }
}

#[test]
fn prop_what_cannot_be_told_has_its_reason() {
    let folder = run("6205", "outer-raceway", 900, 0.5);
    for (given, reason) in [
        (&["--bearing", "6205"][..], "one event stands out, and not the two of entry and exit"),
        (&["--bpfo", "3.585x", "--bpfi", "5.415x"], "--rollers, --pitch, --diameter"),
        (&["--bearing", "NU206"], "the verdict names no damaged race or element"),
    ] {
        let found = size(folder.path(), given);
        assert_eq!(found["size"]["length_mm"], Value::Null, "{given:?}: {found}");
        let why = found["size"]["reason"].as_str().unwrap();
        assert!(why.contains(reason), "{given:?}: {why}");
    }
}
