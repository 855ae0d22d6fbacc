//! The signal library against SciPy. `validation/scipy/README.md` says how the goldens in `signal/` are made.

use brinell_signal::distribution::{chi_square_quantile, chi_square_tail, f_tail};
use brinell_signal::integrate::{Motion, velocity};
use brinell_signal::{
    Band, Detrend, Indicator, Moments, Rotation, Segments, Window, envelope, kurtogram, psd, spectrogram,
};
use serde_json::Value;

fn golden(name: &str) -> Value {
    let path = format!("{}/tests/signal/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
    serde_json::from_str(&text).unwrap_or_else(|e| panic!("{path}: {e}"))
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("an array").iter().map(number).collect()
}

fn rows(value: &Value) -> Vec<Vec<f64>> {
    value.as_array().expect("an array").iter().map(numbers).collect()
}

fn input(name: &str) -> (Vec<f64>, f64) {
    let inputs = golden("inputs");
    (numbers(&inputs[name]), number(&inputs["fs"]))
}

fn window(name: &Value) -> Window {
    match name.as_str() {
        Some("rectangular") => Window::Rectangular,
        Some("hann") => Window::Hann,
        Some("hamming") => Window::Hamming,
        Some("blackman-harris") => Window::BlackmanHarris,
        Some("flat-top") => Window::FlatTop,
        other => panic!("no window {other:?}"),
    }
}

/// Largest difference over the largest value.
#[track_caller]
fn assert_close(ours: &[f64], theirs: &[f64], tolerance: f64) {
    assert_eq!(ours.len(), theirs.len());
    let scale = theirs.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let worst = (ours.iter().zip(theirs)).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
    assert!(worst <= tolerance * scale, "{worst:e} of {scale:e}");
}

#[test]
fn xval_windows() {
    let golden = golden("windows");
    for (name, w) in golden.as_object().expect("an object") {
        if name != "made_by" {
            let window = window(&Value::from(name.as_str()));
            // Blackman-Harris and the flat top end in differences of numbers near one.
            assert_close(&window.periodic(24), &numbers(&w["periodic"]), 1e-15);
            assert_close(&window.symmetric(25), &numbers(&w["symmetric"]), 1e-15);
        }
    }
}

#[test]
fn xval_distributions() {
    let golden = golden("distributions");
    for r in rows(&golden["chi_square_tail"]) {
        assert!((chi_square_tail(r[0], r[1]) / r[2] - 1.0).abs() < 1e-10, "{r:?}");
    }
    for r in rows(&golden["f_tail"]) {
        assert!((f_tail(r[0], r[1], r[2]) / r[3] - 1.0).abs() < 1e-10, "{r:?}");
    }
    for r in rows(&golden["chi_square_quantile"]) {
        assert!((chi_square_quantile(r[0], r[1]) / r[2] - 1.0).abs() < 1e-10, "{r:?}");
    }
}

#[test]
fn xval_welch_and_spectrogram() {
    let ((x, fs), golden) = (input("x"), golden("spectra"));
    for case in golden["welch"].as_array().expect("cases") {
        let segments = Segments {
            length: number(&case["length"]) as usize,
            overlap: number(&case["overlap"]),
            window: window(&case["window"]),
            detrend: match case["detrend"].as_str() {
                Some("constant") => Detrend::Mean,
                Some("linear") => Detrend::Linear,
                _ => Detrend::None,
            },
        };
        let s = psd(&x, fs, &segments).unwrap();
        assert_close(&s.density, &numbers(&case["density"]), 1e-13);
        // SciPy's spectrum is a mean square: half our amplitude squared except at the ends.
        let last = s.amplitude.len() - 1;
        let ends = |k: usize| k == 0 || (k == last && segments.length.is_multiple_of(2));
        let mean_square: Vec<f64> =
            (s.amplitude.iter().enumerate()).map(|(k, a)| a * a * if ends(k) { 1.0 } else { 0.5 }).collect();
        assert_close(&mean_square, &numbers(&case["mean_square"]), 1e-13);
    }
    let theirs = &golden["spectrogram"];
    let segments = Segments { overlap: number(&theirs["overlap"]), ..Segments::of(number(&theirs["length"]) as usize) };
    let s = spectrogram(&x, fs, &segments).unwrap();
    assert_eq!(s.frames(), number(&theirs["frames"]) as usize);
    assert_eq!(s.first_time, number(&theirs["first_time"]));
    assert!((s.time_step - number(&theirs["time_step"])).abs() < 1e-15);
    let kept: Vec<f64> = (numbers(&theirs["kept"]).iter()).flat_map(|i| s.frame(*i as usize).to_vec()).collect();
    assert_close(&kept, &rows(&theirs["density"]).concat(), 1e-13);
}

#[test]
fn xval_envelope() {
    let ((x, fs), golden) = (input("x"), golden("envelope"));
    let band = Band::between(number(&golden["low"]), number(&golden["high"]));
    let ours = envelope(&x, fs, band).unwrap();
    assert_close(&ours, &numbers(&golden["envelope"]), 1e-13);
}

#[test]
fn xval_velocity() {
    let ((x, fs), golden) = (input("x"), golden("velocity"));
    let every_second = |v: Vec<f64>| -> Vec<f64> { v.into_iter().step_by(2).collect() };
    let band = Band::between(number(&golden["low"]), number(&golden["high"]));
    let transform = every_second(velocity(&x, fs, Motion::Acceleration, band, |_| x.len()).unwrap());
    assert_close(&transform, &numbers(&golden["transform"]), 1e-12);
}

#[test]
fn xval_indicators() {
    let ((x, _), golden) = (input("x"), golden("indicators"));
    let mut moments = Moments::new();
    x.iter().for_each(|v| moments.push(*v));
    for indicator in Indicator::ALL {
        let (ours, theirs) = (moments.get(indicator).unwrap(), number(&golden[indicator.name()]));
        assert!((ours / theirs - 1.0).abs() < 1e-12, "{}", indicator.name());
    }
}

#[test]
fn xval_kurtogram() {
    let ((x, fs), golden) = (input("long"), golden("kurtogram"));
    let map = kurtogram(&x, fs, number(&golden["depth"]) as usize).unwrap();
    let theirs = rows(&golden["levels"]);
    assert_eq!(map.levels.len(), theirs.len());
    for (ours, theirs) in map.levels.iter().zip(&theirs) {
        assert_close(&ours.kurtosis, theirs, 1e-11);
    }
    // The impacts ring at 500 Hz.
    let best = map.best(100.0).unwrap();
    assert!(best.band.low <= 500.0 && best.band.high >= 500.0, "{best:?}");
}

#[test]
fn xval_angle_from_pulses() {
    let golden = golden("order");
    let pulses: Vec<(f64, f64)> = rows(&golden["pulses"]).iter().map(|r| (r[0], r[1])).collect();
    let rotation = Rotation::from_angles(&pulses).unwrap();
    let (angle, speed): (Vec<f64>, Vec<f64>) = (numbers(&golden["t"]).iter()).map(|t| rotation.at(*t)).unzip();
    assert_close(&angle, &numbers(&golden["angle"]), 1e-13);
    assert_close(&speed, &numbers(&golden["speed"]), 1e-12);
}
