//! Requests that are not as `messages.md` has them: each is answered with a problem, or as if it were right, and none ends the engine.

use crate::studio::{HEALTHY, SPALL, ask_with};
use brinell_studio::Studio;
use serde_json::{Value, json};

/// One good request of each kind, on a slot that runs.
pub(crate) fn good() -> Vec<Value> {
    let (stroke, bytes) = (json!({ "$": ["f64", 0, 6] }), json!({ "$": ["u8", 0, 48] }));
    let scenario: Value = toml::from_str(HEALTHY).unwrap();
    let verdict = json!({ "damage": [{ "name": "BPFO", "hz": 1.0 }],
        "indicators": [{ "name": "RMS", "value": 1.0, "low": 0.9, "high": 1.1, "freedom": 9 }] });
    vec![
        json!({ "do": "about" }),
        json!({ "do": "example", "name": "circle" }),
        json!({ "do": "normal", "scenario": scenario }),
        json!({ "do": "open", "slot": 0, "toml": format!("{HEALTHY}{SPALL}"), "carry": true }),
        json!({ "do": "tables", "toml": HEALTHY, "bytes": true }),
        json!({ "do": "take", "tables": [{ "name": "t", "bytes": bytes }] }),
        json!({ "do": "advance", "slot": 0, "rows": 9, "steps": 90, "frames": true }),
        json!({ "do": "spectra", "slot": 0, "longest": 4096 }),
        json!({ "do": "verdict", "slot": 0 }),
        json!({ "do": "differ", "a": verdict, "b": verdict }),
        json!({ "do": "indicators", "slot": 0 }),
        json!({ "do": "sound", "slot": 0 }),
        json!({ "do": "damage", "slot": 0 }),
        json!({ "do": "passage", "slot": 0, "defect": 1 }),
        json!({ "do": "outline", "kind": "photo", "bytes": bytes, "name": "a.png", "options": { "mm_per_pixel": 0.02 } }),
        json!({ "do": "outline", "kind": "svg", "bytes": bytes, "name": "a.svg", "options": {} }),
        json!({ "do": "outline", "kind": "depth", "bytes": bytes, "name": "a.csv", "options": {} }),
        json!({ "do": "scratch", "points_mm": stroke, "width_mm": 0.4 }),
        json!({ "do": "brush", "grid": null, "points_mm": stroke, "width_mm": 0.8, "depth_um": 12, "raise": false }),
        json!({ "do": "save", "slot": 0, "format": "csv" }),
        json!({ "do": "listen", "name": "a.csv", "bytes": bytes }),
        json!({ "do": "judge", "name": "a.csv", "bytes": bytes, "channel": "x", "rate_hz": 12000, "unit": "g", "of": HEALTHY,
            "rpm": 1500, "from_s": 0 }),
    ]
}

/// Every request with one of its entries left out, or of another kind, at any depth.
fn malformed(whole: &Value) -> Vec<Value> {
    let others = [
        json!(null),
        json!(true),
        json!(-1),
        json!(0.5),
        json!(1e300),
        json!(u64::MAX),
        json!("x"),
        json!([]),
        json!([[1]]),
        json!({}),
        json!({ "$": ["f64", 0, 3] }),
        json!({ "$": [] }),
    ];
    let mut all: Vec<Value> = others.to_vec();
    match whole {
        Value::Object(entries) => {
            for (key, value) in entries.iter().filter(|(key, _)| *key != "do") {
                let mut without = entries.clone();
                without.remove(key);
                all.push(without.into());
                all.extend(malformed(value).into_iter().map(|other| {
                    let mut changed = entries.clone();
                    changed[key] = other;
                    changed.into()
                }));
            }
        }
        Value::Array(items) => {
            for (at, item) in items.iter().enumerate() {
                all.extend(malformed(item).into_iter().map(|other| {
                    let mut changed = items.clone();
                    changed[at] = other;
                    changed.into()
                }));
            }
        }
        _ => {}
    }
    all
}

#[test]
fn prop_a_malformed_request_is_answered() {
    let points = [-1.0_f64, 0.0, 1.0, 0.5, 2.0, -0.5];
    let bytes: Vec<u8> = points.iter().flat_map(|x| x.to_le_bytes()).collect();
    let mut studio = Studio::new();
    let mut answered = |request: &Value| {
        let answer = ask_with(&mut studio, request.clone(), &bytes).json;
        let problems = answer["problems"].as_array().is_some_and(|all| !all.is_empty());
        assert!(answer["ok"] == true || answer["ok"] == false && problems, "{request}: {answer}");
    };
    for request in good() {
        answered(&json!({ "do": "open", "slot": 0, "toml": format!("{HEALTHY}{SPALL}") }));
        answered(&json!({ "do": "advance", "slot": 0, "rows": 600 }));
        answered(&request);
        malformed(&request).iter().for_each(&mut answered);
    }
}

#[test]
fn regress_options_that_are_no_object_are_a_problem() {
    let mut studio = Studio::new();
    let mut asked = |options: Value| {
        let request = json!({ "do": "outline", "kind": "svg", "bytes": { "$": ["u8", 0, 8] }, "name": "a.svg", "options": options });
        ask_with(&mut studio, request, &[b'x'; 8]).json["problems"][0]["message"].clone()
    };
    for options in [json!([]), json!("x"), json!(7), json!(true)] {
        assert_eq!(asked(options), "\"options\" must be an object");
    }
    assert_ne!(asked(Value::Null), asked(json!([])));
}
