//! The measurement chain on runs: what it changes, what it leaves alone, and that it repeats.

use crate::common::read_li2023 as read;
use crate::common::{Rows, simulate};
use brinell::document::{Problem, Severity};
use brinell::many::each;
use brinell::scenario::{NoiseColour, PathMode, Scenario, Sensor};
use brinell::signal::decimate::{ATTENUATION_DB, PASSBAND, STOPBAND, kaiser_lowpass};
use brinell::simulate::Simulation;
use std::num::NonZeroUsize;

fn short() -> Scenario {
    let mut s = crate::common::cases::rectangle();
    s.simulation.duration_s = 0.06;
    s.simulation.record = ["outer_a*", "sensor_*"].map(String::from).to_vec();
    s
}

fn everything() -> Sensor {
    Sensor {
        direction_deg: Some(60.0),
        sensitivity_mv_per_m_per_s2: Some(10.2),
        mounting_resonance_hz: Some(30_000.0),
        mounting_damping_ratio: 0.02,
        low_cut_hz: Some(1.0),
        high_cut_hz: Some(9_000.0),
        noise_rms_m_per_s2: Some(0.7),
        noise_colour: NoiseColour::Pink,
        noise_corner_hz: 1.0,
        noise_seed: 3,
        converter_bits: Some(12),
        converter_range_m_per_s2: Some(60.0),
        path: vec![PathMode { frequency_hz: 3_000.0, damping_ratio: 0.05, gain: 0.8 }],
        ..Sensor::off()
    }
}

fn bits(rows: &Rows, name: &str) -> Vec<u64> {
    rows.column(name).iter().map(|x| x.to_bits()).collect()
}

fn with(sensor: Sensor) -> Scenario {
    Scenario { sensor, ..short() }
}

#[test]
fn prop_a_direction_alone_leaves_the_other_channels_as_they_are() {
    let (plain, off) = simulate(&short());
    assert!(off.sensor.is_empty());
    let direction = Sensor { direction_deg: Some(60.0), ..Sensor::off() };
    let (turned, outcome) = simulate(&with(direction));
    for name in ["outer_ax", "outer_ay", "sensor_ax", "sensor_ay"] {
        assert_eq!(bits(&plain, name), bits(&turned, name), "{name}");
    }
    let (sin, cos) = 60f64.to_radians().sin_cos();
    let [x, y, own] = ["sensor_ax", "sensor_ay", "sensor_out"].map(|n| turned.column(n));
    let largest = x.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    for k in 0..own.len() {
        assert!((own[k] - cos * x[k] - sin * y[k]).abs() < 1e-12 * largest);
    }
    assert_eq!(outcome.sensor.len(), 3);
    assert!(outcome.sensor.iter().all(|record| record.clipped == 0));
}

#[test]
fn prop_the_bearing_does_not_feel_the_sensor() {
    let (plain, before) = simulate(&short());
    let (sensed, after) = simulate(&with(everything()));
    assert_eq!(before.work, after.work);
    assert_eq!(bits(&plain, "outer_ax"), bits(&sensed, "outer_ax"));
    assert_ne!(bits(&plain, "sensor_ax"), bits(&sensed, "sensor_ax"));
    // 12 bits over 60 m/s^2; the impacts go beyond.
    let step = 60.0 / 2048.0;
    let x = sensed.column("sensor_ax");
    assert!(x.iter().all(|v| (v / step).fract() == 0.0));
    let ends = x.iter().filter(|v| **v == -60.0 || **v == 60.0 - step);
    assert!(after.sensor[0].clipped > 0 && ends.count() as u64 >= after.sensor[0].clipped);
    let own = sensed.column("sensor_out");
    let largest = own.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    assert!(largest <= 10.2 * 60.0 && largest > 60.0, "{largest} mV");
    // Statistics begin half-way through the 60 ms, at the latest.
    assert_eq!(after.sensor[0].counted, 769);
}

#[test]
fn prop_noise_repeats_whatever_runs_beside() {
    let seeds = [3, 3, 4];
    let rows = |jobs: usize| -> Vec<Vec<u64>> {
        let scenarios: Vec<Scenario> = seeds.map(|noise_seed| with(Sensor { noise_seed, ..everything() })).to_vec();
        let mut all = vec![Vec::new(); seeds.len()];
        each(
            scenarios.len(),
            NonZeroUsize::new(jobs).unwrap(),
            |k| bits(&simulate(&scenarios[k]).0, "sensor_ay"),
            |k, bits| all[k] = bits,
        );
        all
    };
    let one = rows(1);
    assert_eq!(one, rows(3));
    assert_eq!(one[0], one[1]);
    assert_ne!(one[0], one[2]);
}

#[test]
fn analytic_noise_has_the_ratio_requested() {
    // A ratio to the run's own level, which a first run tells.
    let quiet = Sensor { high_cut_hz: Some(10_000.0), ..Sensor::off() };
    let (clean, outcome) = simulate(&with(quiet.clone()));
    let level = outcome.sensor[0].signal_rms().unwrap();
    let noisy = Sensor { noise_snr_db: Some(6.0), noise_reference_rms_m_per_s2: level, ..quiet };
    let (sensed, outcome) = simulate(&with(noisy));
    assert_eq!(outcome.sensor[0].signal_rms(), Some(level));
    let (a, b) = (clean.column("sensor_ax"), sensed.column("sensor_ax"));
    let n = a.len() as f64;
    let power = a.iter().zip(b).map(|(a, b)| (b - a).powi(2)).sum::<f64>() / n;
    let db = 10.0 * (level * level / power).log10();
    // The variance of n normal numbers strays by sqrt(2 / n) of itself: 0.16 dB here.
    assert!((db - 6.0).abs() < 4.0 * 10.0 / 10f64.ln() * (2.0 / n).sqrt(), "{db} dB");
}

#[test]
fn regress_channels_and_units_say_what_the_sensor_gives() {
    let simulation = Simulation::new(&with(everything())).unwrap();
    let told: Vec<(&str, &str)> = simulation
        .channels()
        .iter()
        .filter(|c| c.name.starts_with("sensor"))
        .map(|c| (c.name.as_str(), c.unit))
        .collect();
    assert_eq!(told, [("sensor_ax", "m/s^2"), ("sensor_ay", "m/s^2"), ("sensor_out", "mV")]);
    assert!(Simulation::new(&short()).unwrap().sensor().is_none());
}

const FILE: &str = "\
[bearing]
preset = \"NN3007\"
[operation]
speed_rpm = 1800.0
load_n = [300.0, 0.0]
[sensor]
";

fn refused(keys: &str) -> Vec<Problem> {
    read(&format!("{FILE}{keys}\n"), &[]).expect_err(keys)
}

#[test]
fn regress_bad_sensors_are_named_with_line_and_remedy() {
    let cases = [
        ("mounting_resonance_hz = 200e3", "sensor.mounting_resonance_hz", "above the Nyquist frequency", "< 102400 Hz"),
        ("mounting_resonance_hz = 0.1", "sensor.mounting_resonance_hz", "too slow", ">= 0.256 Hz"),
        (
            "mounting_damping_ratio = 0.1",
            "sensor.mounting_damping_ratio",
            "only where mounting_resonance_hz is given",
            "",
        ),
        ("high_cut_hz = -1", "sensor.high_cut_hz", "out of range", "> 0"),
        ("noise_rms_m_per_s2 = -1", "sensor.noise_rms_m_per_s2", "out of range", ">= 0"),
        ("noise_seed = 3", "sensor.noise_seed", "only where noise_rms_m_per_s2 or noise_snr_db", ""),
        ("noise_snr_db = 20", "sensor.noise_reference_rms_m_per_s2", "missing", ""),
        ("converter_bits = 16", "sensor.converter_bits", "range, which is not given", "converter_range_mv"),
        ("converter_range_m_per_s2 = 16", "sensor.converter_range_m_per_s2", "without an ADC", "converter_bits"),
        ("converter_bits = 64", "sensor.converter_bits", "out of range", "2 to 32"),
        ("direction_dge = 3", "sensor.direction_dge", "did you mean `direction_deg`", ""),
        (
            "path = [{ frequency_hz = 300e3, gain = 1 }]",
            "sensor.path.0.frequency_hz",
            "above the Nyquist frequency",
            "< 102400 Hz",
        ),
        ("path = [{ frequency_hz = 300.0 }]", "sensor.path.0.gain", "missing", ""),
        ("path = 3", "sensor.path", "[[sensor.path]]", ""),
    ];
    for (text, key, message, allowed) in cases {
        let problems = refused(text);
        let problem = problems.iter().find(|p| p.key == key).unwrap_or_else(|| panic!("{text}: {problems:?}"));
        let shown = problem.to_string();
        assert_eq!(problem.severity, Severity::Error, "{shown}");
        assert!(problem.line.is_some_and(|line| line == 6 || line == 7), "{shown}");
        assert!(shown.contains(message) && shown.contains(allowed), "{shown}");
    }
    for (text, key) in [
        ("low_cut_hz = 9\nhigh_cut_hz = 8", "sensor.low_cut_hz"),
        ("low_cut_hz = 13e3", "sensor.low_cut_hz"),
        ("noise_rms_m_per_s2 = 1\nnoise_snr_db = 3\nnoise_reference_rms_m_per_s2 = 1", "sensor.noise_snr_db"),
        ("noise_rms_m_per_s2 = 1\nnoise_colour = \"pink\"\nnoise_corner_hz = 20e3", "sensor.noise_corner_hz"),
        ("converter_bits = 8\nconverter_range_mv = 3", "sensor.converter_range_mv"),
        (
            "converter_bits = 8\nconverter_range_mv = 3\nconverter_range_m_per_s2 = 3\nsensitivity_mv_per_m_per_s2 = 1",
            "sensor.converter_range_mv",
        ),
    ] {
        let problems = refused(text);
        assert!(problems.iter().any(|p| p.key == key), "{text}: {problems:?}");
    }
    let warned = read(&format!("{FILE}sensitivity_mv_per_m_per_s2 = 10\n"), &[]).unwrap();
    assert!(warned.warnings.iter().any(|w| w.to_string().contains("changes nothing")));
}

#[test]
fn prop_a_scenario_without_a_sensor_does_not_mention_one() {
    let loaded = read(FILE, &[]).unwrap();
    assert_eq!(loaded.scenario.sensor, Sensor::off());
    // But for the channels that every run has.
    let text = loaded.to_toml().replace("\"sensor_*\"", "");
    assert!(!text.contains("sensor"), "{text}");
    assert!(loaded.provenance.iter().all(|p| !p.key.starts_with("sensor")));
    // What is not given of a chain that is there is on the assumption sheet.
    let text = format!(
        "{FILE}mounting_resonance_hz = 9e3\nnoise_rms_m_per_s2 = 1.0\n[[sensor.path]]\nfrequency_hz = 700.0\ngain = 1.0\n"
    );
    let loaded = read(&text, &[]).unwrap();
    let assumed: Vec<&str> =
        loaded.provenance.iter().filter(|p| p.assumed && p.key.starts_with("sensor")).map(|p| p.key.as_str()).collect();
    assert_eq!(assumed, ["sensor.mounting_damping_ratio", "sensor.noise_colour", "sensor.path.0.damping_ratio"]);
    assert_eq!(read(&loaded.to_toml(), &[]).unwrap().scenario, loaded.scenario);
}

/// A logger at a low rate holds what one at a high rate does, filtered: nothing folds.
#[test]
fn prop_a_lower_rate_holds_the_same_below_its_band() {
    let mut s = short();
    s.simulation.sample_rate_hz = 51_200.0;
    let (fast, _) = simulate(&s);
    s.simulation.sample_rate_hz = 6_400.0;
    let (slow, _) = simulate(&s);
    let taps = kaiser_lowpass(PASSBAND / 8.0, STOPBAND / 8.0, ATTENUATION_DB);
    for name in ["sensor_ax", "sensor_ay"] {
        let (exact, found) = (fast.column(name), slow.column(name));
        // Beyond the response of the filters to the ends.
        let inner = 40..found.len() - 40;
        let filtered =
            |k: usize| -> f64 { taps.iter().zip(&exact[8 * k - taps.len() / 2..]).map(|(h, x)| h * x).sum() };
        let exact: Vec<f64> = inner.clone().map(filtered).collect();
        let norm = |x: &mut dyn Iterator<Item = f64>| x.map(|v| v * v).sum::<f64>().sqrt();
        let all = norm(&mut exact.iter().copied());
        let off = norm(&mut inner.zip(&exact).map(|(k, x)| found[k] - x));
        println!("{name}: {:.2e} of {all:.3e}", off / all);
        // The two passbands end at 0.4 and the transition is theirs alike; ripple and what folds are below.
        assert!(off < 5e-3 * all, "{name}: {off:e} of {all:e}");
    }
}
