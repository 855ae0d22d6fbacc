//! `brinell analyze`: units, sensitivities and full scales; severity.

use crate::common::{FS, brinell, column, json};
use ::brinell::random::Random;
use std::f64::consts::TAU;
use std::fs;
use std::path::Path;
use tempfile::tempdir;

/// What says the shaft's speed and the bearing.
const MACHINE: [&str; 4] = ["--speed", "1800", "--bearing", "6205"];

/// A tone of 2 g at 160 Hz in a little noise, g.
fn tone(seconds: f64) -> Vec<f64> {
    let mut noise = Random::new(3);
    (0..(FS * seconds) as usize)
        .map(|i| 2.0 * (TAU * 160.0 * i as f64 / FS).sin() + 0.1 * (noise.part() - 0.5))
        .collect()
}

/// One channel of whole numbers of 16 bits, or of floats of 32.
fn wav(path: &Path, values: &[f64], whole: bool) {
    let (tag, width) = if whole { (1u16, 2u16) } else { (3, 4) };
    let data: Vec<u8> = (values.iter())
        .flat_map(|v| match whole {
            true => (v.round() as i16).to_le_bytes().to_vec(),
            false => (*v as f32).to_le_bytes().to_vec(),
        })
        .collect();
    let mut bytes = b"RIFF".to_vec();
    bytes.extend((36 + data.len() as u32).to_le_bytes());
    bytes.extend(b"WAVEfmt ");
    bytes.extend(16u32.to_le_bytes());
    bytes.extend([tag, 1].map(u16::to_le_bytes).concat());
    bytes.extend((FS as u32).to_le_bytes());
    bytes.extend((FS as u32 * u32::from(width)).to_le_bytes());
    bytes.extend([width, 8 * width].map(u16::to_le_bytes).concat());
    bytes.extend(b"data");
    bytes.extend((data.len() as u32).to_le_bytes());
    bytes.extend(data);
    fs::write(path, bytes).unwrap();
}

/// RMS and unit of what a call finds.
fn rms(folder: &Path, file: &str, more: &[&str]) -> (f64, String) {
    let args = [&["analyze", file][..], &MACHINE, more, &["--json", "r.json"]].concat();
    brinell(folder, &args).exits(0);
    let found = json(&folder.join("r.json"));
    let rms = &found["indicators"]["rms"];
    (rms["value"].as_f64().unwrap(), rms["unit"].as_str().unwrap().to_owned())
}

/// The same vibration in g, in volts, in mV, in counts of 16 bits and in parts of a full scale.
#[test]
fn analytic_a_vibration_is_the_same_in_every_form() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let x = tone(1.0);
    let times = |factor: f64| -> Vec<f64> { x.iter().map(|v| factor * v).collect() };
    column(&at("g.csv"), &x);
    column(&at("volt.csv"), &times(0.1));
    // 100 mV/g into +-5 V.
    wav(&at("whole.wav"), &times(0.1 / 5.0 * 32_768.0), true);
    wav(&at("part.wav"), &times(0.1 / 5.0), false);
    wav(&at("g.wav"), &times(0.1), false);
    let (truth, _) = rms(folder.path(), "g.csv", &["--rate", "12000", "--unit", "g"]);
    assert!((truth / 2f64.sqrt() - 1.0).abs() < 1e-3, "{truth}");
    let volt = ["--rate", "12000", "--unit", "V", "--sensitivity"];
    let scale = ["--full-scale", "5V", "--sensitivity"];
    for (file, more, name, factor) in [
        ("volt.csv", [&volt[..], &["100mV/g"]].concat(), "g", 1.0),
        ("volt.csv", [&volt[..], &["0.1V/(m/s2)"]].concat(), "m/s^2", 1.0),
        ("volt.csv", [&volt[..], &["50 mV/(mm/s)"]].concat(), "mm/s", 2.0),
        ("whole.wav", [&scale[..], &["100mV/g"]].concat(), "g", 1.0),
        ("whole.wav", vec!["--full-scale", "50g"], "g", 1.0),
        ("part.wav", [&scale[..], &["100mV/g"]].concat(), "g", 1.0),
        ("g.wav", vec!["--full-scale", "10g"], "g", 1.0),
    ] {
        let (found, unit) = rms(folder.path(), file, &more);
        assert_eq!(unit, name);
        // A count is 1.5 mg.
        let off = (found / (factor * truth) - 1.0).abs();
        assert!(off < 1e-4, "{file} {more:?}: {found} for {truth}");
    }
    let words = [&["analyze", "whole.wav"][..], &MACHINE, &scale, &["100mV/g"]].concat();
    brinell(folder.path(), &words).exits(0).says(&[
        "full scale 5 V, as given: 1 in the file (int16) is 0.0001526 V",
        "sensitivity 100 mV/g, as given: the signal is in g",
    ]);
}

#[test]
fn regress_scales_that_say_nothing_are_refused() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    column(&at("x.csv"), &tone(0.5));
    wav(&at("x.wav"), &tone(0.5), true);
    for (file, more, part) in [
        (
            "x.csv",
            &["--unit", "V", "--sensitivity", "100"][..],
            "--sensitivity `100`: expected a sensor's output for one unit of vibration, with both units, such as 100mV/g",
        ),
        (
            "x.csv",
            &["--unit", "g", "--sensitivity", "100mV/g"],
            "--sensitivity 100mV/g: expected a signal that is a voltage, and `column1` is in g",
        ),
        ("x.csv", &["--unit", "counts", "--sensitivity", "100mV/g"], "is in counts; is it --unit V?"),
        (
            "x.csv",
            &["--sensitivity", "100mV/g"],
            "the file states no unit for `column1`; give --unit, such as --unit V",
        ),
        ("x.csv", &["--full-scale", "5V"], "--full-scale 5V: only a WAV's numbers are parts of a full scale"),
        (
            "x.wav",
            &["--full-scale", "5"],
            "--full-scale `5`: expected what the largest number means, with its unit, such as 5V",
        ),
        ("x.wav", &["--unit", "V"], "--unit V: the numbers of this WAV are counts of an ADC (int16, full scale 32768)"),
        (
            "x.wav",
            &["--unit", "counts", "--sensitivity", "100mV/g"],
            "is in counts; give --full-scale, such as --full-scale 5V, in place of the unit",
        ),
        ("x.wav", &[], "a WAV states no unit; give --full-scale, such as --full-scale 10g"),
    ] {
        let rate: &[&str] = if file == "x.csv" { &["--rate", "12000"] } else { &[] };
        let args = [&["analyze", file][..], &MACHINE, rate, more].concat();
        brinell(folder.path(), &args).exits(2).complains(&[part]);
    }
}

/// 2 g at 160 Hz are 13.797 mm/s RMS, in JSON and, with the zone, on the console.
#[test]
fn analytic_velocity_and_zone_of_a_tone() {
    let folder = tempdir().unwrap();
    column(&folder.path().join("x.csv"), &tone(2.0));
    let call = |more: &[&str]| {
        let args = [&["analyze", "x.csv", "--rate", "12000"][..], &MACHINE, more].concat();
        brinell(folder.path(), &args)
    };
    let with_class = ["--unit", "g", "--machine-class", "2-rigid", "-o", "look"];
    call(&with_class).exits(0).says(&[
        "velocity RMS 10 to 1000 Hz 13.",
        "zone D, above 4.5 mm/s: severe enough to damage the machine; of vibration as a whole: early damage of a bearing hardly shows in it (group 2, rigid support; ISO 20816-3",
        "above 15 kW at 120 to 30000 r/min",
        "envelope RMS ",
    ]);
    let found = &json(&folder.path().join("look/analysis.json"))["severity"];
    let velocity = found["velocity_rms_10_1000_hz"]["value"].as_f64().unwrap();
    let expected = 1e3 * 2.0 * 9.80665 / (TAU * 160.0) / 2f64.sqrt();
    // The noise adds 0.006 mm/s, in power.
    assert!((velocity / expected - 1.0).abs() < 1e-3, "{velocity}");
    assert_eq!(found["iso_20816_3"]["zone"], "D");
    assert!(found["band_shown"]["envelope_rms"]["value"].as_f64().unwrap() > 0.0);
    let page = fs::read_to_string(folder.path().join("look/report.html")).unwrap();
    assert!(page.contains("RMS velocity, 10 to 1000 Hz") && page.contains("zone D"));

    call(&["--unit", "V", "--machine-class", "1-flexible"]).exits(0).says(&[
        "velocity RMS 10 to 1000 Hz not known, as a signal in V is neither an acceleration nor a velocity",
        "zone not known, without a velocity",
    ]);
    call(&["--unit", "g", "--duration", "0.9"]).exits(0).says(&["not known, as 0.900 s are too short for 10 Hz"]);
    call(&["--unit", "g", "--machine-class", "3"]).exits(2).complains(&["1-rigid, 1-flexible, 2-rigid, 2-flexible"]);
}

#[test]
fn prop_rate_and_speed_take_a_unit() {
    let folder = tempdir().unwrap();
    column(&folder.path().join("x.csv"), &tone(2.0));
    let call = |rate: &str, speed: &str| {
        let args = ["analyze", "x.csv", "--unit", "g", "--bearing", "6205", "--rate", rate, "--speed", speed];
        brinell(folder.path(), &[&args[..], &["--json", "-"]].concat())
    };
    let plain = call("12000", "1800").exits(0).out;
    for (rate, speed) in [("12kHz", "30Hz"), ("12 kHz", "30 Hz"), ("1.2e4", "1800rpm"), (" 12000 ", "1800 r/min")] {
        assert_eq!(call(rate, speed).exits(0).out, plain, "{rate} {speed}");
    }
    for bad in ["12kx", "12k", "kHz", "12 s", "1,2kHz", ""] {
        call(bad, "1800").exits(2).complains(&[&format!(
            "invalid value '{bad}' for '--rate <HZ>': expected more than 0 Hz, as 12000 or 12kHz"
        )]);
    }
    call("0 kHz", "1800").exits(2).complains(&["--rate 0: expected more than 0 Hz"]);
    call("12000", "30 kg").exits(2).complains(&["'--speed <RPM>': expected a speed in r/min other than 0"]);
}
