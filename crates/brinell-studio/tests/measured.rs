//! Measured files, as the page has them looked into and judged.

use crate::studio::ask_with;
use brinell::random::Random;
use brinell_studio::Studio;
use serde_json::{Value, json};

const RATE: f64 = 12_000.0;
/// BPFI of the 6205-2RS, turns of the shaft, and its speed, Hz.
const BPFI: f64 = 5.4152;
const SHAFT: f64 = 1730.0 / 60.0;

/// Impacts of an inner race on noise, for two seconds.
fn signal() -> Vec<f64> {
    let mut random = Random::new(7);
    let mut x: Vec<f64> = (0..24_000).map(|_| 0.1 * random.normal()).collect();
    for k in 1..(2.0 * BPFI * SHAFT) as usize {
        let at = k as f64 / (BPFI * SHAFT);
        let strength = 1.0 + (std::f64::consts::TAU * SHAFT * at).cos();
        for (n, v) in x.iter_mut().enumerate().skip((at * RATE).ceil() as usize).take(60) {
            let t = n as f64 / RATE - at;
            *v += strength * (-800.0 * t).exp() * (std::f64::consts::TAU * 3000.0 * t).sin();
        }
    }
    x
}

fn csv(head: &str, x: &[f64]) -> Vec<u8> {
    let rows: Vec<String> = x.iter().map(f64::to_string).collect();
    format!("{head}\n{}\n", rows.join("\n")).into_bytes()
}

/// 16-bit counts.
fn wav(x: &[f64]) -> Vec<u8> {
    let mut bytes = b"RIFF\0\0\0\0WAVEfmt \x10\0\0\0\x01\0\x01\0".to_vec();
    bytes[4..8].copy_from_slice(&(36 + 2 * x.len() as u32).to_le_bytes());
    bytes.extend((RATE as u32).to_le_bytes());
    bytes.extend((2 * RATE as u32).to_le_bytes());
    bytes.extend(b"\x02\0\x10\0data");
    bytes.extend((2 * x.len() as u32).to_le_bytes());
    bytes.extend(x.iter().flat_map(|v| ((v * 8000.0) as i16).to_le_bytes()));
    bytes
}

fn asked(what: &str, name: &str, bytes: &[u8], more: Value) -> Value {
    let mut request = json!({ "do": what, "name": name, "bytes": { "$": ["u8", 0, bytes.len()] } });
    request.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
    ask_with(&mut Studio::new(), request, bytes).json
}

fn judged(name: &str, bytes: &[u8], more: Value) -> Value {
    let answer = asked("judge", name, bytes, more);
    assert_eq!(answer["ok"], json!(true), "{answer}");
    answer
}

/// What is wrong, in one text.
fn refused(name: &str, bytes: &[u8], more: Value) -> String {
    let answer = asked("judge", name, bytes, more);
    assert_eq!(answer["ok"], json!(false), "{answer}");
    let problems = answer["problems"].as_array().unwrap();
    problems.iter().map(|p| p["message"].as_str().unwrap()).collect::<Vec<_>>().join("\n")
}

fn with(base: &Value, more: Value) -> Value {
    let mut all = base.clone();
    all.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
    all
}

#[test]
fn regress_what_nobody_states_is_asked_for_and_what_was_used_is_said() {
    let bytes = csv("acc", &signal());
    let words = refused("a.csv", &bytes, json!({}));
    for missing in ["no sample rate", "no unit for `acc`; give unit", "no shaft speed", "which bearing?"] {
        assert!(words.contains(missing), "{words}");
    }
    let given = json!({ "rate_hz": RATE, "unit": "g", "rpm": 1730, "bearing": "6205-2RS" });
    let answer = judged("a.csv", &bytes, given);
    assert!(answer["headline"].as_str().unwrap().starts_with("Inner race damage"), "{}", answer["headline"]);
    let used: Vec<&str> = answer["used"].as_array().unwrap().iter().map(|v| v.as_str().unwrap()).collect();
    assert!(used[0].starts_with("bearing: ") && used[0].contains("6205-2RS"), "{used:?}");
    // What the lines say of it, and whether that is used instead.
    assert!(used[1].starts_with("shaft speed 1730 r/min, as given, and ") && used[1].contains("harmonics"), "{used:?}");
    assert_eq!(used[2..4], ["sample rate 12000 Hz, as given", "unit g, as given"]);
    assert_eq!(used[4], "channel acc: 2.000 s, 24000 samples");
    assert_eq!(answer["warnings"], json!([]));
}

#[test]
fn regress_a_speed_in_the_file_is_offered_and_taken() {
    let bytes = include_bytes!("../../brinell-io/tests/data/cwru_v5.mat");
    let heard = asked("listen", "x.mat", bytes, json!({}));
    let channel = &heard["channels"][0];
    let place = channel["rpm_from"].as_str().unwrap();
    assert!(place.starts_with("the variable `X") && place.ends_with("RPM` in the file, taken as r/min"), "{channel}");
    assert!(channel["rpm"].as_f64().unwrap() > 1000.0 && channel["rate_hz"].is_null(), "{channel}");
}

/// The page's own bearing is taken where it is chosen, and under its own name.
#[test]
fn prop_the_bearing_of_the_page_is_taken_where_it_is_chosen() {
    let bytes = csv("acc [m/s^2]", &signal());
    let toml = "[bearing]\npreset = \"NN3007\"\n[operation]\nspeed_rpm = 1800\nload_n = [300, 0]\n";
    let answer = judged("a.csv", &bytes, json!({ "rate_hz": RATE, "rpm": 1730, "of": toml }));
    assert_eq!(answer["used"][0], "bearing: that of this page, NN3007");
}

#[test]
fn regress_a_wav_states_no_unit_and_counts_are_no_acceleration() {
    let bytes = wav(&signal());
    let base = json!({ "rpm": 1730, "bearing": "6205-2RS" });
    let words = refused("a.wav", &bytes, base.clone());
    assert!(words.starts_with("a WAV states no unit; give full scale, such as full scale 10g"), "{words}");
    let words = refused("a.wav", &bytes, with(&base, json!({ "unit": "g" })));
    assert!(words.contains("the numbers of this WAV are counts of an ADC (int16, full scale 32768)"), "{words}");
    let given = with(&base, json!({ "full_scale": "5V", "sensitivity": "100mV/g" }));
    let answer = judged("a.wav", &bytes, given);
    let words = answer["levels"][0].as_str().unwrap();
    let rms: f64 = words.strip_prefix("rms ").and_then(|w| w.strip_suffix(" g")).unwrap().parse().unwrap();
    let x = signal();
    let own = (x.iter().map(|v| v * v).sum::<f64>() / x.len() as f64).sqrt();
    // 8000 counts are one of the signal's, and a full scale of 32768 is 5 V or 50 g; whole revolutions.
    let expected = own * 8000.0 / 32_768.0 * 50.0;
    assert!((rms / expected - 1.0).abs() < 0.01, "{rms} {expected}");
    assert!(answer["levels"][1].as_str().unwrap().starts_with("peak "));
    let csv = csv("acc", &x);
    for (given, said) in [
        (json!({ "unit": "furlong" }), "unit furlong: no unit is called `furlong`; known are m/s^2"),
        (json!({ "full_scale": "10g" }), "only a WAV's numbers are parts of a full scale"),
        (json!({ "unit": "g", "full_scale": "10g" }), "not both"),
        (json!({ "unit": "g", "sensitivity": "100mV/g" }), "expected a signal that is a voltage, and `acc` is in g"),
        (json!({ "unit": "g", "rpm": 0 }), "shaft speed 0 r/min"),
        (json!({ "unit": "g", "rate_hz": -1 }), "sample rate -1"),
        (json!({ "unit": "g", "bearing": "62O5x" }), "no bearing"),
    ] {
        let words = refused("a.csv", &csv, with(&with(&base, json!({ "rate_hz": RATE })), given));
        assert!(words.contains(said), "{words}");
    }
}

#[test]
fn regress_everything_that_is_wrong_with_a_record_is_said() {
    let given = json!({ "rate_hz": RATE, "unit": "g", "rpm": 1730, "bearing": "6205-2RS" });
    let warned = |bytes: &[u8]| -> Vec<String> {
        let answer = judged("a.csv", bytes, given.clone());
        answer["warnings"].as_array().unwrap().iter().map(|v| v.as_str().unwrap().to_owned()).collect()
    };
    let mut struck = signal();
    struck[12_000] = 400.0;
    let said = warned(&csv("acc", &struck));
    assert!(matches!(&said[..], [one] if one.contains("lie in one revolution, from 0.97")), "{said:?}");
    let mut off = signal();
    off[9_000..].fill(0.0);
    let said = warned(&csv("acc", &off));
    assert!(said.iter().any(|w| w.contains("hold one value")), "{said:?}");
    let clipped: Vec<f64> = signal().iter().map(|v| v.clamp(-0.3, 0.3)).collect();
    let said = warned(&csv("acc [mg]", &clipped));
    assert_eq!(said[0], "unit g was taken, but the file says mg");
    assert!(said[1].contains("clipped, or coarsely quantised"), "{said:?}");
    let twice = [&signal()[..], &signal()[..]].concat();
    let said = warned(&csv("acc", &twice));
    assert_eq!(said, ["of 4.000 s the record repeats the same 2.000 s: these alone are judged"]);
    let timed: Vec<String> =
        signal().iter().enumerate().map(|(k, v)| format!("{},{v}", k as f64 / (2.0 * RATE))).collect();
    let timed = format!("time [s],acc\n{}\n", timed.join("\n"));
    let answer = judged("a.csv", timed.as_bytes(), with(&given, json!({ "channel": "acc" })));
    let said = json!(["the sample rate 12000 Hz was taken, but the column `time [s]` says 24000 Hz"]);
    assert_eq!(answer["warnings"], said);
}

#[test]
fn prop_a_column_of_times_is_no_signal() {
    let names = |text: &str| asked("listen", "a.csv", text.as_bytes(), json!({}));
    let both = names("time [s],acc\n0.0,1\n0.1,2\n0.2,4\n");
    let listed: Vec<&str> = both["channels"].as_array().unwrap().iter().map(|c| c["name"].as_str().unwrap()).collect();
    assert_eq!(listed, ["acc"]);
    // A gap: that there is no rate is said with the reason.
    let gap = names("time [s],acc\n0.0,1\n0.1,2\n0.2,4\n0.3,5\n0.9,6\n1.0,7\n");
    assert_eq!(gap["channels"][0]["rate_hz"], Value::Null);
    let why = gap["channels"][0]["rate_missing"].as_str().unwrap();
    assert!(why.starts_with("no sample rate follows from `time [s]`: "), "{why}");
    assert_eq!(both["channels"][0]["rate_missing"], Value::Null);
    assert_eq!(names("time [s]\n0.0\n0.1\n0.2\n")["ok"], json!(false));
    // Each channel has the times to its left, and times without a unit give no rate.
    let pairs = names("time_s,A,time_s,B\n0.0,1,0.0,4\n0.1,2,0.5,5\n0.2,3,1.0,7\n");
    let rates: Vec<&Value> = pairs["channels"].as_array().unwrap().iter().map(|c| &c["rate_hz"]).collect();
    assert_eq!(rates, [10.0, 2.0]);
    assert_eq!(pairs["channels"][1]["samples"], 3);
    let bare = names("t,acc\n0.0,1\n0.1,2\n0.2,4\n");
    let why = bare["channels"][0]["rate_missing"].as_str().unwrap();
    assert_eq!(why, "the file states no sample rate, and no unit for its times in `t`; give the sample rate in Hz");
}
