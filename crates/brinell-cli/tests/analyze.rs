//! `brinell analyze`: what it says of signals whose damage is known, and of files that are no signal.

use crate::common::{FS, GIVEN, brinell, column, folder_with, json, normal, typed};
use ::brinell::random::Random;
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::fs;
use tempfile::tempdir;

/// Shaft speed, Hz, at a time: steady, or 20 % faster after the signal's `seconds`.
fn shaft(t: f64, seconds: f64, sweep: f64) -> f64 {
    30.0 * (1.0 + sweep * (t / seconds - 0.5))
}

/// Impacts at 3.5848 a turn, of a height over unit noise; none for 0.
fn signal(seconds: f64, height: f64, sweep: f64) -> Vec<f64> {
    let mut noise = Random::new(7);
    let n = (FS * seconds) as usize;
    let mut x: Vec<f64> = (0..n).map(|_| normal(&mut noise)).collect();
    let mut at = 0.003;
    while height > 0.0 && at < seconds {
        let first = (at * FS).ceil() as usize;
        for (i, value) in x.iter_mut().enumerate().skip(first).take(100) {
            let since = i as f64 / FS - at;
            *value += height * (-since / 8e-4).exp() * (TAU * 3000.0 * since).sin();
        }
        at += (1.0 + 0.005 * normal(&mut noise)) / (3.5848 * shaft(at, seconds, sweep));
    }
    x
}

fn with<'a>(file: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    ["analyze", file].into_iter().chain(GIVEN).chain(more.iter().copied()).collect()
}

#[test]
fn regress_words_and_json_of_outer_race_damage() {
    let folder = tempdir().unwrap();
    column(&folder.path().join("outer.csv"), &signal(2.0, 6.0, 0.0));
    brinell(folder.path(), &with("outer.csv", &["-o", "look"])).exits(0).keeps_quiet().says(&[
        "sample rate 12000 Hz, as given",
        "shaft speed 1800 r/min, from --speed",
        "Outer race damage, clear: BPFO at 107.",
        "of pure rolling), harmonics 1, 2, 3, 4, 5 up to",
        "outer race       BPFO          107.",
        "wrote look/report.html",
    ]);
    let found = json(&folder.path().join("look/analysis.json"));
    assert_eq!(found["verdict"]["damage"][0], "outer_race");
    assert_eq!(found["verdict"]["damage"].as_array().unwrap().len(), 1);
    assert_eq!(found["verdict"]["says"], "damage");
    let family = &found["families"][0];
    assert_eq!((&family["name"], &family["says"]), (&"BPFO".into(), &"damage".into()));
    assert!(family["score"].as_f64().unwrap() > family["limit"].as_f64().unwrap());
    let page = fs::read_to_string(folder.path().join("look/report.html")).unwrap();
    let headline = format!("<h1>Damage: outer race, {}</h1>", found["verdict"]["clarity"].as_str().unwrap());
    for part in [headline.as_str(), "id=\"kurtogram\"", "id=\"envelope\""] {
        assert!(page.contains(part), "{part}");
    }
    assert!(folder.path().join("look/plots/kurtogram.svg").is_file());
}

#[test]
fn regress_words_on_noise() {
    let folder = tempdir().unwrap();
    column(&folder.path().join("noise.csv"), &signal(2.0, 0.0, 0.0));
    brinell(folder.path(), &with("noise.csv", &[])).exits(0).says(&["No damage found.", "nothing"]);
}

#[test]
fn prop_a_speed_that_varies_is_followed() {
    let folder = tempdir().unwrap();
    let seconds = 4.0;
    let x = signal(seconds, 4.0, 0.3);
    let mut text = String::from("acc,speed\n");
    for (i, v) in x.iter().enumerate() {
        let _ = writeln!(text, "{v:.5},{:.3}", 60.0 * shaft(i as f64 / FS, seconds, 0.3));
    }
    fs::write(folder.path().join("ramp.csv"), text).unwrap();
    let given = typed("analyze ramp.csv --channel acc --rate 12000 --unit g --bearing 6205");
    let call = |more: &[&'static str]| {
        let args: Vec<&str> = given.iter().chain(more).copied().collect();
        brinell(folder.path(), &args)
    };
    call(&["--speed-channel", "speed"])
        .exits(0)
        .says(&["so envelopes are taken at equal angles of the shaft", "Outer race damage, very clear: BPFO at 107."]);
    // At the mean speed alone the lines smear over 30 % and are not present.
    let plain = call(&["--speed", "1800"]).exits(0);
    assert!(!plain.out.contains("very clear"), "{}", plain.out);
}

/// The unit in the header of a column of speeds converts it; one that is no speed's is refused.
#[test]
fn prop_a_speed_in_another_unit_is_the_same_speed() {
    let folder = tempdir().unwrap();
    let x = signal(2.0, 6.0, 0.0);
    let call = |head: &str, speed: f64| {
        let text: String = x.iter().fold(format!("acc,{head}\n"), |text, v| text + &format!("{v:.5},{speed}\n"));
        fs::write(folder.path().join("rig.csv"), text).unwrap();
        let given = "analyze rig.csv --channel acc --rate 12000 --unit g --bearing 6205 --speed-channel speed";
        brinell(folder.path(), &typed(given))
    };
    for (head, speed, said) in [
        ("speed [Hz]", 30.0, "in Hz"),
        ("speed (1/s)", 30.0, "in 1/s"),
        ("speed_hz", 30.0, "in Hz"),
        ("speed [rad/s]", 30.0 * TAU, "in rad/s"),
        ("speed (RPM)", 1800.0, "in RPM"),
        ("speed", 1800.0, "taken as r/min"),
    ] {
        // One value throughout was set, and is no record: it is believed like one that is given.
        let from = format!("shaft speed 1800 r/min, from the channel `{head}`, {said}, one value throughout");
        call(head, speed).exits(0).says(&[&from, "Outer race damage, clear"]);
    }
    call("speed [m/s]", 30.0)
        .exits(2)
        .complains(&["--speed-channel speed [m/s]: its unit is m/s; expected r/min, rpm, 1/min, Hz, 1/s or rad/s"]);
}

#[test]
fn regress_speeds_are_as_many_as_the_signals_values() {
    let folder = tempdir().unwrap();
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../brinell-io/tests/data/clocks.npz");
    let given = "--channel acc --unit g --bearing 6205 --speed-channel slow";
    let run = brinell(folder.path(), &[&["analyze", data], &typed(given)[..]].concat());
    let words = "--speed-channel slow: it has 150 values and `acc` 300; expected as many, or a sample rate of its own";
    run.exits(2).complains(&[words]);
    let given = "--channel slow --unit g --bearing 6205 --speed 1800";
    let run = brinell(folder.path(), &[&["analyze", data], &typed(given)[..]].concat());
    run.exits(2).complains(&["`time_s` has 300 times and `slow` 150 values; give --rate HZ"]);
}

/// The other holds nothing of the band that the program chose: a band of both is taken in its place, and named.
#[test]
fn prop_the_other_may_be_sampled_more_slowly() {
    let folder = tempdir().unwrap();
    let x = signal(2.0, 6.0, 0.0);
    column(&folder.path().join("fast.csv"), &x);
    let slow: Vec<f64> = x.chunks_exact(4).map(|four| four.iter().sum::<f64>() / 4.0).collect();
    column(&folder.path().join("slow.csv"), &slow);
    let more = ["--against", "slow.csv", "--against-rate", "3000", "-o", "look"];
    brinell(folder.path(), &with("fast.csv", &more))
        .exits(0)
        .says(&["Outer race damage", "1500 Hz, which both sample rates hold; the first signal's band is"]);
    let given = [&more[..], &["--band", "2000", "4000", "--overwrite"]].concat();
    brinell(folder.path(), &with("fast.csv", &given)).exits(2).complains(&["slow.csv", "half the sample rate"]);
}

#[test]
fn regress_files_that_are_no_signal() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let x = signal(2.0, 0.0, 0.0);
    fs::write(at("empty.csv"), "").unwrap();
    column(&at("constant.csv"), &vec![1.5; 20_000]);
    let mut holes = x.clone();
    holes[100] = f64::NAN;
    holes[4000] = f64::NAN;
    column(&at("holes.csv"), &holes);
    fs::write(at("text.mat"), "no matrix\n".repeat(100)).unwrap();
    let pairs: String = x.iter().fold("a,b\n".into(), |text, v| text + &format!("{v:.4},{v:.4}\n"));
    fs::write(at("two.csv"), pairs).unwrap();
    for (file, parts) in [
        ("empty.csv", &["empty.csv: the file is empty"][..]),
        ("constant.csv", &["all 20000 samples are 1.5: a constant is no vibration"]),
        (
            "holes.csv",
            &["2 of 24000 samples are missing or infinite, the first at sample 101", "on line 101 it is `NaN`"],
        ),
        ("text.mat", &["named like MATLAB, but the content is text"]),
        ("two.csv", &["several channels may be the signal; choose one with --channel: a, b"]),
        ("missing.csv", &["missing.csv: cannot read"]),
    ] {
        brinell(folder.path(), &with(file, &[])).exits(2).complains(parts);
    }
}

#[test]
fn regress_what_the_other_file_does_not_say_has_options_of_its_own() {
    let folder = tempdir().unwrap();
    for name in ["x.csv", "y.csv"] {
        column(&folder.path().join(name), &signal(1.0, 0.0, 0.0));
    }
    fs::copy(folder.path().join("y.csv"), folder.path().join("y.txt")).unwrap();
    let over = |other: &str, more: &[&str]| {
        let against = [&["--against", other][..], more].concat();
        brinell(folder.path(), &with("x.csv", &against))
    };
    over("y.txt", &[]).exits(2).complains(&[
        "y.txt: 2 things have to be given:",
        "the file states no sample rate; give --against-rate HZ",
        "give --against-unit, such as --against-unit g",
    ]);
    // Of the same format they are the first signal's, and that is said.
    over("y.csv", &[]).exits(0).says(&[
        "sample rate 12000 Hz, as the first signal's",
        "unit g, as the first signal's; else give --against-unit",
    ]);
    over("y.csv", &[])
        .complains(&["warning: --against y.csv: no sample rate is stated: the first signal's 12000 Hz was taken"]);
    over("y.csv", &["--against-rate", "6000"]).exits(0).says(&["sample rate 6000 Hz, as given"]);
    // After a sensitivity the first signal's unit is none of the file's.
    let volts = ["--rate", "12000", "--unit", "V", "--sensitivity", "100mV/g", "--speed", "1800", "--bearing", "6205"];
    brinell(folder.path(), &[&["analyze", "x.csv", "--against", "y.csv"][..], &volts].concat())
        .exits(2)
        .complains(&["y.csv: 2 things have to be given:"]);
    over("y.csv", &["--against-rate", "12000", "--against-unit", "furlong"])
        .exits(2)
        .complains(&["--against-unit furlong: no unit is called `furlong`"]);
    over("y.csv", &["--against-rate", "12000", "--against-unit", "g"]).exits(0).says(&["this over the other"]);
    brinell(folder.path(), &with("x.csv", &["--band", "1000", "1010"]))
        .exits(2)
        .complains(&["is 10.0 Hz wide", "Hz or more, for two harmonics"]);
    brinell(folder.path(), &with("x.csv", &["--band", "1000", "7000"]))
        .exits(2)
        .complains(&["ends at 7000 Hz: expected at most 6000 Hz, half the sample rate"]);
}

#[test]
fn regress_what_the_file_does_not_say_is_requested() {
    let folder = tempdir().unwrap();
    column(&folder.path().join("x.csv"), &signal(1.0, 0.0, 0.0));
    let all = [
        "the file states no sample rate; give --rate HZ",
        "the file states no unit for",
        "the file states no shaft speed",
        "which bearing? Give --bearing NAME",
    ];
    brinell(folder.path(), &["analyze", "x.csv"])
        .exits(2)
        .complains(&["x.csv: 4 things have to be given:"])
        .complains(&all);
    for (args, part) in [
        (
            &["--unit", "g", "--speed", "1800", "--bearing", "6205"][..],
            "x.csv: the file states no sample rate; give --rate HZ",
        ),
        (&["--rate", "12000", "--unit", "furlong"], "--unit furlong: no unit is called `furlong`; known are m/s^2"),
        (&["--rate", "12000", "--unit", "g", "--speed", "1800"], "x.csv: which bearing? Give --bearing NAME"),
        (&["--rate", "-1", "--unit", "g"], "--rate -1: expected more than 0 Hz"),
        (
            &["--rate", "12000", "--unit", "g", "--speed", "0"],
            "shaft speed 0 r/min, from --speed: expected a speed other than 0",
        ),
        (
            &["--rate", "500", "--unit", "g", "--speed", "1800", "--bearing", "6205"],
            "sampled at 500 Hz the signal holds nothing above 250.0 Hz",
        ),
        (
            &["--rate", "12000", "--unit", "g", "--speed", "1800", "--bearing", "9999"],
            "--bearing 9999: no bearing \"9999\"; there are ",
        ),
    ] {
        let all: Vec<&str> = ["analyze", "x.csv"].into_iter().chain(args.iter().copied()).collect();
        brinell(folder.path(), &all).exits(2).complains(&[part]);
    }
}

#[test]
fn regress_which_of_two_channels_is_asked_with_all_the_rest() {
    let folder = folder_with("two.csv", "a,b\n1,2\n2,3\n");
    brinell(folder.path(), &["analyze", "two.csv", "--rate", "12000"]).exits(2).complains(&[
        "two.csv: 4 things have to be given:",
        "choose one with --channel: a, b",
        "the file states no unit for",
    ]);
}

/// A unit in brackets or at the end of the name.
#[test]
fn regress_the_rate_follows_from_times_whose_name_has_a_unit() {
    let folder = tempdir().unwrap();
    for (name, scale) in [("Time [ms]", 1e3), ("time_ms", 1e3), ("t_s", 1.0)] {
        let mut text = format!("{name},acc [g]\n");
        for (i, v) in signal(1.0, 0.0, 0.0).iter().enumerate() {
            let _ = writeln!(text, "{:.7},{v:.4}", scale * i as f64 / FS);
        }
        fs::write(folder.path().join("times.csv"), text).unwrap();
        let given = ["analyze", "times.csv", "--speed", "1800", "--bearing"];
        brinell(folder.path(), &[&given[..], &["6205"]].concat())
            .exits(0)
            .says(&[&format!("sample rate 12000 Hz, from the times in `{name}`")]);
    }
}

#[test]
fn regress_uneven_times_are_reported_with_their_worst_step() {
    let folder = tempdir().unwrap();
    let mut text = String::from("time [s],acc [g]\n");
    for (i, v) in signal(1.0, 0.0, 0.0).iter().enumerate() {
        let gap = if i < 3000 { 0.0 } else { 0.5 };
        let _ = writeln!(text, "{:.6},{v:.4}", i as f64 / FS + gap);
    }
    fs::write(folder.path().join("gap.csv"), text).unwrap();
    let call = |more: &[&'static str]| {
        let given = ["analyze", "gap.csv", "--speed", "1800", "--bearing", "6205"];
        brinell(folder.path(), &[&given[..], more].concat())
    };
    let why = "its steps are uneven (0.50008 after 3000 values, where 8.3";
    call(&[]).exits(2).complains(&["no sample rate follows from `time [s]`", why]);
    call(&[]).complains(&[
        "; that step is from line 3001 (`time [s]` 0.249917; `acc [g]` ",
        ") to line 3002 (`time [s]` 0.750000; `acc [g]` ",
    ]);
    call(&["--rate", "12000"])
        .exits(0)
        .complains(&["warning: --rate 12000 Hz was taken, but the times in `time [s]` give no rate", why]);
}

/// What a run's files say of it: every format in its folder, and alone as far as it carries the scenario; a speed that
/// varies is followed.
#[test]
fn regress_a_run_is_known_whatever_its_format() {
    let folder = tempdir().unwrap();
    let run = |name: &str, more: &[&'static str]| {
        let out = format!("out/{name}");
        let set = ["--set", "simulation.duration_s=0.4", "--set", "simulation.laws=li2023", "-o", &out];
        brinell(folder.path(), &[&["run", "s.toml", "--no-report"], &set[..], more].concat()).exits(0);
    };
    brinell(folder.path(), &["init", "s.toml"]).exits(0);
    run("steady", &["--signals", "csv,parquet,mat,npz,uff58,wav"]);
    for ending in ["csv", "parquet", "mat", "npz", "uff", "wav"] {
        let file = format!("out/steady/signals.{ending}");
        let words = "shaft speed 1800 r/min, from the scenario of the run in the file";
        brinell(folder.path(), &["analyze", &file]).exits(0).says(&[words]);
        if !["csv", "uff"].contains(&ending) {
            let alone = format!("alone.{ending}");
            fs::copy(folder.path().join(file), folder.path().join(&alone)).unwrap();
            brinell(folder.path(), &["analyze", &alone]).exits(0).says(&[words]);
        }
    }
    run("ramp", &["--set", "operation.speed_rpm=[[0.0, 1600.0], [0.4, 2000.0]]"]);
    brinell(folder.path(), &["analyze", "out/ramp"])
        .exits(0)
        .says(&["from the scenario of the run in the file: 1656.6 to 2000.0, so envelopes are taken at equal angles"]);
}

#[test]
fn regress_pictures_in_the_formats_requested() {
    let folder = tempdir().unwrap();
    column(&folder.path().join("x.csv"), &signal(1.0, 0.0, 0.0));
    brinell(folder.path(), &with("x.csv", &["-o", "look", "--plots", "svg,png"])).exits(0);
    for name in ["waveform", "close-up", "spectrum", "kurtogram", "envelope-spectrum"] {
        for ending in ["svg", "png"] {
            assert!(folder.path().join(format!("look/plots/{name}.{ending}")).is_file(), "{name}.{ending}");
        }
    }
}

/// Another file's contents are not replaced without a word; an earlier analysis is.
#[test]
fn regress_json_replaces_nothing_but_an_analysis() {
    let folder = tempdir().unwrap();
    column(&folder.path().join("now.csv"), &signal(2.0, 6.0, 0.0));
    for (name, text) in [("other.csv", "1\n2\n"), ("summary.json", "{\"brinell\": \"0.1.0\", \"indicators\": {}}")] {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        let refused = brinell(folder.path(), &with("now.csv", &["--json", name]));
        refused.exits(2).complains(&["no analysis of brinell's is there"]);
        assert_eq!(std::fs::read_to_string(path).unwrap(), text);
    }
    for _ in 0..2 {
        brinell(folder.path(), &with("now.csv", &["--json", "a.json"])).exits(0);
    }
}

#[test]
fn regress_a_healthy_record_changes_the_verdict() {
    let folder = tempdir().unwrap();
    column(&folder.path().join("now.csv"), &signal(2.0, 6.0, 0.0));
    column(&folder.path().join("before.csv"), &signal(2.0, 0.0, 0.0));
    let over = |before: &str, more: &[&'static str]| {
        let mut args = with("now.csv", &["--against", before]);
        args.extend(["--against-rate", "12000", "--against-unit", "g"]);
        args.extend(more);
        brinell(folder.path(), &args)
    };
    over("before.csv", &["--healthy"]).exits(0).says(&["Outer race damage, clear", "this over the other"]);
    over("now.csv", &["--healthy"])
        .exits(0)
        .says(&["Cannot tell: lines of BPFO would be damage, and the record given as healthy has them as well."]);
    over("now.csv", &[]).exits(0).says(&["Outer race damage, clear"]);
}
