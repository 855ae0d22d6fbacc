//! The engine behind its messages, as the page asks it.

use brinell::plausibility::Beforehand;
use brinell::result::Parts;
use brinell_studio::{Message, Studio};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

pub(crate) const HEALTHY: &str = "[bearing]\npreset = \"NN3007\"\n[operation]\nspeed_rpm = 1800\nload_n = [300, 0]\n\
    [simulation]\nlaws = \"li2023\"\nduration_s = 0.06\n";
pub(crate) const SPALL: &str = "[[defects]]\non = \"outer-raceway\"\ncenter_deg = 0\ndepth_um = 20\n\
    shape = { rectangle = { length_mm = 3, width_mm = 4 } }\n";

fn ask(studio: &mut Studio, json: Value) -> Message {
    ask_with(studio, json, &[])
}

/// Asks with bytes that `{"$": [kind, 0, n]}` refers to.
pub(crate) fn ask_with(studio: &mut Studio, json: Value, bytes: &[u8]) -> Message {
    let text = json.to_string();
    let mut request = (text.len() as u32).to_le_bytes().to_vec();
    request.extend(text.as_bytes());
    request.resize(request.len().next_multiple_of(8), 0);
    request.extend(bytes);
    Message::read(&studio.ask(&request)).unwrap()
}

fn good(studio: &mut Studio, json: Value) -> Message {
    let answer = ask(studio, json);
    assert_eq!(answer.json["ok"], json!(true), "{}", answer.json);
    answer
}

/// The numbers of an answer that `of` refers to.
fn singles(answer: &Message, of: &Value) -> Vec<f32> {
    let bytes = answer.bytes();
    let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
    let start = (4 + length).next_multiple_of(8);
    let at = |k: usize| of["$"][k].as_u64().unwrap() as usize;
    assert_eq!(of["$"][0], "f32");
    let data = &bytes[start + at(1)..][..4 * at(2)];
    data.as_chunks().0.iter().map(|b| f32::from_le_bytes(*b)).collect()
}

fn run(studio: &mut Studio, rows: u64) -> Vec<f32> {
    run_in(studio, json!({ "do": "advance", "slot": 0, "rows": rows }))
}

fn run_in(studio: &mut Studio, slice: Value) -> Vec<f32> {
    let mut all = Vec::new();
    loop {
        let answer = good(studio, slice.clone());
        assert_eq!(answer.json["first"], json!(all.len()));
        all.extend(singles(&answer, &answer.json["x"]));
        if answer.json["done"] == json!(true) {
            return all;
        }
    }
}

/// Samples of one slice.
fn singles_of(studio: &mut Studio, slice: &Value) -> u64 {
    good(studio, slice.clone()).json["x"]["$"][2].as_u64().unwrap()
}

#[test]
fn prop_a_run_in_slices_is_the_run_of_the_library() {
    let text = format!("{HEALTHY}{SPALL}");
    let scenario = brinell::Scenario::from_toml(&text).unwrap();
    let (result, signals) = brinell::record(&scenario).unwrap();
    let expected: Vec<f32> = signals.get("sensor_ax").unwrap().iter().map(|x| *x as f32).collect();
    for rows in [97, 10_000] {
        let mut studio = Studio::new();
        let opened = good(&mut studio, json!({ "do": "open", "slot": 0, "toml": text })).json;
        assert_eq!(opened["samples"], json!(expected.len()));
        assert_eq!(run(&mut studio, rows), expected);
        let indicators = good(&mut studio, json!({ "do": "indicators", "slot": 0 })).json;
        let all = indicators["quantities"].as_array().unwrap();
        let named = result.quantities();
        assert_eq!(all.len(), named.len());
        for (shown, q) in all.iter().zip(named) {
            assert_eq!((&shown["name"], &shown["value"]), (&json!(q.name), &json!(q.value)));
        }
        assert_eq!(indicators["steps"], json!(result.outcome.work.solver.steps));
    }
    // Cut by the solver's steps too, most slices before their rows and some before a first one.
    let mut studio = Studio::new();
    good(&mut studio, json!({ "do": "open", "slot": 0, "toml": text }));
    let slice = json!({ "do": "advance", "slot": 0, "rows": 10_000, "steps": 1 });
    assert!(singles_of(&mut studio, &slice) < 100);
    good(&mut studio, json!({ "do": "open", "slot": 0, "toml": text }));
    assert_eq!(run_in(&mut studio, slice), expected);
}

#[test]
fn prop_an_edit_changes_the_signal_without_a_new_start() {
    let mut studio = Studio::new();
    good(&mut studio, json!({ "do": "open", "slot": 0, "toml": HEALTHY }));
    let quiet = run(&mut studio, 256);
    let text = format!("{HEALTHY}{SPALL}");
    let opened = good(&mut studio, json!({ "do": "open", "slot": 0, "toml": text, "carry": true })).json;
    assert_eq!((&opened["carried"], &opened["live"]), (&json!(true), &json!(true)));
    let before = ask(&mut studio, json!({ "do": "spectra", "slot": 0, "longest": 4096 })).json;
    assert_eq!(before["samples"], json!(0));
    let mut damaged = Vec::new();
    for _ in 0..64 {
        let answer = good(&mut studio, json!({ "do": "advance", "slot": 0, "rows": 256, "frames": true }));
        damaged.extend(singles(&answer, &answer.json["x"]));
        let frames = &answer.json["frames"];
        assert_eq!(frames["count"], json!(32));
        let rows = frames["rows"].as_array().unwrap();
        let orbit = singles(&answer, &rows[1]["orbit"]);
        assert_eq!(orbit.len(), 32 * 19);
        // Neighbours of a row are a pitch apart, but for the pockets' clearance.
        let apart = (orbit[1] - orbit[0]).rem_euclid(std::f32::consts::TAU);
        assert!((apart - std::f32::consts::TAU / 19.0).abs() < 0.02, "{apart}");
    }
    let rms = |x: &[f32]| (x.iter().map(|v| v * v).sum::<f32>() / x.len() as f32).sqrt();
    assert!(rms(&damaged) > 1.5 * rms(&quiet[quiet.len() / 2..]));
    let spectra = good(&mut studio, json!({ "do": "spectra", "slot": 0, "longest": 16384 })).json;
    assert_eq!(spectra["samples"], json!(16384));
    let bpfo = &spectra["lines"][0];
    assert_eq!((&bpfo["name"], &bpfo["defect"]), (&json!("BPFO"), &json!(1)));
    let (hz, nominal) = (bpfo["hz"].as_f64().unwrap(), bpfo["nominal_hz"].as_f64().unwrap());
    assert!((hz / nominal - 1.0).abs() < 0.02, "{hz} {nominal}");
    let sound = good(&mut studio, json!({ "do": "sound", "slot": 0 }));
    let heard = singles(&sound, &sound.json["x"]);
    assert!(heard.iter().all(|v| v.abs() <= 1.0) && heard.len() > 800);
    let faster = text.replace("1800", "1500");
    let opened = good(&mut studio, json!({ "do": "open", "slot": 0, "toml": faster, "carry": true })).json;
    assert_eq!((&opened["carried"], &opened["rpm"]), (&json!(true), &json!(1500.0)));
    let other = text.replace("NN3007", "NU206");
    let opened = good(&mut studio, json!({ "do": "open", "slot": 0, "toml": other, "carry": true })).json;
    assert_eq!((&opened["carried"], &opened["live"]), (&json!(false), &json!(false)));
}

#[test]
fn prop_a_bad_scenario_is_reported_in_the_librarys_words_and_the_last_good_one_runs_on() {
    let mut studio = Studio::new();
    good(&mut studio, json!({ "do": "open", "slot": 0, "toml": HEALTHY }));
    let wide = format!("{HEALTHY}{}", SPALL.replace("width_mm = 4", "width_mm = 90"));
    let answer = ask(&mut studio, json!({ "do": "open", "slot": 0, "toml": wide, "carry": true })).json;
    assert_eq!(answer["ok"], json!(false));
    let problem = &answer["problems"][0];
    assert!(problem["key"].as_str().unwrap().starts_with("defects[1]"), "{problem}");
    assert!(problem["message"].as_str().unwrap().contains("90"), "{problem}");
    assert_eq!(problem["line"], json!(13));
    good(&mut studio, json!({ "do": "advance", "slot": 0, "rows": 10 }));
    for wrong in [
        json!({ "do": "advance", "slot": 1 }),
        json!({ "do": "advance", "slot": 7 }),
        json!({ "do": "fly" }),
        json!({ "do": "open", "slot": 0 }),
        json!({ "do": "open", "slot": 0, "toml": "not = [toml" }),
        json!({ "do": "passage", "slot": 0, "defect": 3 }),
        json!({ "do": "sound", "slot": 0 }),
        json!({ "do": "scratch", "width_mm": 1 }),
        json!({ "do": "outline", "kind": "photo", "bytes": { "$": ["u8", 0, 9] } }),
        json!([]),
        json!(null),
    ] {
        let answer = ask(&mut studio, wrong.clone()).json;
        assert_eq!(answer["ok"], json!(false), "{wrong}");
        assert!(answer["problems"][0]["message"].is_string(), "{wrong}");
    }
    let noise: Vec<u8> = (0..64).map(|k| (k * 37 % 251) as u8).collect();
    assert_eq!(Message::read(&studio.ask(&noise)).unwrap().json["ok"], json!(false));
}

#[test]
fn prop_what_is_drawn_is_a_shape_that_a_scenario_takes() {
    let mut studio = Studio::new();
    let points = [-1.0_f64, 0.0, 1.0, 0.5, 2.0, -0.5];
    let bytes: Vec<u8> = points.iter().flat_map(|x| x.to_le_bytes()).collect();
    let stroke = json!({ "$": ["f64", 0, 6] });
    let scratch = json!({ "do": "scratch", "points_mm": stroke, "width_mm": 0.4 });
    let drawn = ask_with(&mut studio, scratch, &bytes).json;
    assert!((drawn["length_mm"].as_f64().unwrap() - 3.4).abs() < 0.02, "{drawn}");
    let brush = json!({ "do": "brush", "grid": null, "points_mm": stroke, "width_mm": 0.8, "depth_um": 12 });
    let first = ask_with(&mut studio, brush, &bytes).json;
    let again = json!({ "do": "brush", "grid": first["shape"], "points_mm": stroke, "width_mm": 0.8, "depth_um": 5 });
    let deeper = ask_with(&mut studio, again, &bytes).json;
    let base: Value = toml::from_str(HEALTHY).unwrap();
    for (shape, deepest) in [(&drawn["shape"], 15.0), (&first["shape"], 12.0), (&deeper["shape"], 17.0)] {
        let mut scenario = base.clone();
        scenario["defects"] = json!([{ "on": "outer-raceway", "center_deg": 0, "depth_um": 15, "shape": shape }]);
        let opened = good(&mut studio, json!({ "do": "open", "slot": 0, "scenario": scenario })).json;
        let reread = good(&mut studio, json!({ "do": "normal", "toml": opened["toml"] })).json;
        assert_eq!(reread["toml"], opened["toml"]);
        let damage = good(&mut studio, json!({ "do": "damage", "slot": 0 }));
        let one = &damage.json["defects"][0];
        assert!((one["deepest_um"].as_f64().unwrap() - deepest).abs() < 0.1, "{one}");
        assert!(!one["polygons_mm"].as_array().unwrap().is_empty());
        let passage = good(&mut studio, json!({ "do": "passage", "slot": 0, "defect": 1 }));
        let force = singles(&passage, &passage.json["force_n"]);
        let healthy = passage.json["healthy_n"].as_f64().unwrap() as f32;
        assert!((force[0] / healthy - 1.0).abs() < 1e-4);
        assert!(force.iter().any(|f| *f < 0.95 * healthy));
    }
}

/// A stroke that is taken back leaves nothing, and one shallower than the numbers' digits makes nothing.
#[test]
fn prop_a_stroke_taken_back_leaves_no_damage() {
    let mut studio = Studio::new();
    let bytes: Vec<u8> = [-0.6_f64, 0.0, 0.6, 0.0].iter().flat_map(|x| x.to_le_bytes()).collect();
    let mut brush = |grid: &Value, depth: f64, raise: bool| {
        let stroke = json!({ "$": ["f64", 0, 4] });
        let request = json!({ "do": "brush", "grid": grid, "points_mm": stroke, "width_mm": 0.8, "depth_um": depth, "raise": raise });
        ask_with(&mut studio, request, &bytes).json
    };
    let drawn = brush(&Value::Null, 10.0, false);
    assert_eq!(drawn["ok"], true, "{drawn}");
    for (grid, depth, raise) in [(&drawn["shape"], 10.0, true), (&Value::Null, 1e-4, false)] {
        let refused = brush(grid, depth, raise);
        assert!(refused["ok"] == false && refused.to_string().contains("nothing is left"), "{refused}");
    }
}

/// Along a profile the ends of a roller do not touch, and damage takes from what does.
#[test]
fn regress_length_under_a_profile_is_what_touches() {
    let mut studio = Studio::new();
    let text = format!(
        "{}[contact]\nslices = 100\n{SPALL}",
        HEALTHY.replace("NN3007", "NU206").replace("li2023", "mechanics")
    );
    good(&mut studio, json!({ "do": "open", "slot": 0, "toml": text }));
    let passage = good(&mut studio, json!({ "do": "passage", "slot": 0, "defect": 1 }));
    let lengths = singles(&passage, &passage.json["length_mm"]);
    let whole = passage.json["width_mm"].as_f64().unwrap() as f32;
    let least = lengths.iter().fold(f32::MAX, |m, x| m.min(*x));
    assert!(lengths[0] < 0.99 * whole, "{} of {whole}", lengths[0]);
    assert!(lengths[0] - least > 1.0, "{} {least}", lengths[0]);
}

/// A package holds no file from outside its folder, and links do not survive every checkout.
#[test]
fn regress_examples_are_copies_of_the_repositorys() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut copies = 0;
    for file in fs::read_dir(root.join("examples")).unwrap() {
        let name = file.unwrap().file_name();
        let read = |folder: &str| fs::read(root.join(folder).join(&name)).unwrap();
        assert!(read("examples") == read("../../examples"), "{name:?}");
        copies += 1;
    }
    assert_eq!(copies, 14);
}

#[test]
fn prop_every_example_opens_and_the_photo_is_read() {
    let mut studio = Studio::new();
    let about = good(&mut studio, json!({ "do": "about" })).json;
    assert!(about["bearings"].as_array().unwrap().len() > 15);
    for example in about["examples"].as_array().unwrap() {
        assert!(!example["words"].as_str().unwrap().is_empty(), "{}", example["name"]);
        let text = good(&mut studio, json!({ "do": "example", "name": example["name"] })).json;
        let opened = good(&mut studio, json!({ "do": "open", "slot": 0, "toml": text["toml"] })).json;
        assert!(opened["orders"]["BPFO"].as_f64().unwrap() > 1.0);
        if example["name"] == "photo" {
            let damage = good(&mut studio, json!({ "do": "damage", "slot": 0 })).json;
            let area = damage["defects"][0]["area_mm2"].as_f64().unwrap();
            assert!((area - 8.92).abs() < 0.05, "{area}");
        }
    }
    let png = include_bytes!("../../../examples/photo-spall.png");
    let asked = json!({ "do": "outline", "kind": "photo", "name": "photo-spall.png", "bytes": { "$": ["u8", 0, png.len()] },
        "options": { "mm_per_pixel": 0.02, "rolling_direction": "right" } });
    let answer = ask_with(&mut studio, asked, png);
    let outline = &answer.json;
    let area = outline["area_mm2"].as_f64().unwrap();
    assert!((area - 8.92).abs() < 0.05, "{outline}");
    // The same outline in pixels of the photo, by the shoelace formula.
    let rings = outline["rings_px"].as_array().unwrap();
    let pixels: f64 = rings.iter().map(|ring| shoelace(&singles(&answer, ring))).sum();
    assert!((0.02_f64.powi(2) * pixels.abs() / area - 1.0).abs() < 1e-3, "{pixels} pixels for {area} mm^2");
}

/// Area within x, y, x, y, ...; that of a hole has the other sign.
fn shoelace(ring: &[f32]) -> f64 {
    let points = ring.as_chunks::<2>().0;
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(p, q)| 0.5 * f64::from(p[0] * q[1] - q[0] * p[1])).sum()
}

/// Of each bearing the load that `brinell init` would state.
#[test]
fn prop_every_bearing_is_offered_with_a_load_that_fits_it() {
    let about = good(&mut Studio::new(), json!({ "do": "about" })).json;
    for bearing in about["bearings"].as_array().unwrap() {
        let name = bearing["name"].as_str().unwrap();
        let of = brinell::Scenario::of_bearing(name, 1500.0, [1.0, 0.0]).unwrap().bearing;
        let share = bearing["load_n"].as_f64().unwrap() / brinell::bearing::rating::static_rating(&of).load;
        assert!((0.06..0.15).contains(&share), "{name}: {share}");
    }
}

#[test]
fn prop_a_run_is_saved_as_the_command_saves_it_and_judged_when_it_is_read_again() {
    let mut studio = Studio::new();
    let text = format!("{HEALTHY}{SPALL}").replace("0.06", "0.5");
    good(&mut studio, json!({ "do": "open", "slot": 0, "toml": text }));
    let save = |format: &str| json!({ "do": "save", "slot": 0, "format": format });
    assert_eq!(ask(&mut studio, save("csv")).json["ok"], json!(false), "before its end");
    run(&mut studio, 5000);
    let octets = |answer: &Message| answer.arrays.octets(&answer.json["bytes"]).unwrap().to_vec();
    let csv = octets(&good(&mut studio, save("csv")));
    let scenario = brinell::Scenario::from_toml(&text).unwrap();
    let (_, signals) = brinell::record(&scenario).unwrap();
    let lines: Vec<&str> = std::str::from_utf8(&csv).unwrap().lines().collect();
    assert_eq!(lines[0], signals.names().join(","));
    assert_eq!(lines.len() - 1, signals.get("t").unwrap().len());
    let expected: Vec<f64> = signals.names().iter().map(|n| signals.get(n).unwrap()[700]).collect();
    let found: Vec<f64> = lines[701].split(',').map(|x| x.parse().unwrap()).collect();
    assert_eq!(found, expected);
    for format in ["npz", "wav"] {
        let bytes = octets(&good(&mut studio, save(format)));
        let name = format!("run.{format}");
        let reference = json!({ "$": ["u8", 0, bytes.len()] });
        let listen = json!({ "do": "listen", "name": name, "bytes": reference });
        let heard = ask_with(&mut studio, listen, &bytes).json;
        let channels = heard["channels"].as_array().unwrap();
        assert!(channels.iter().any(|c| c["name"] == "sensor_ax"), "{heard}");
        let mut judge = json!({ "do": "judge", "name": name, "bytes": reference, "channel": "sensor_ax" });
        let judged = ask_with(&mut studio, judge.clone(), &bytes);
        let headline = judged.json["headline"].as_str().unwrap();
        assert!(headline.starts_with("Outer race damage"), "{headline}");
        // Both carry the scenario.
        let from_s = scenario.settled_s();
        assert_eq!(heard["run"]["from_s"], json!(from_s), "{heard}");
        assert_eq!(judged.json["from_s"], json!(from_s));
        let count = |answer: &Message| singles(answer, &answer.json["x"]).len();
        let skipped = (from_s * 25600.0).round() as usize;
        assert_eq!(count(&judged) + skipped, lines.len() - 1);
        judge["from_s"] = json!(0.1);
        let later = ask_with(&mut studio, judge.clone(), &bytes);
        assert_eq!(count(&later) + 2560, lines.len() - 1);
        judge["from_s"] = json!(2.0);
        let beyond = ask_with(&mut studio, judge, &bytes).json;
        assert_eq!(beyond["ok"], json!(false));
    }
}

#[test]
fn prop_two_verdicts_are_held_against_each_other() {
    let mut studio = Studio::new();
    let mut verdict = |text: String| {
        let text = text.replace("0.06", "0.5");
        let open = json!({ "do": "open", "slot": 0, "toml": text });
        let opened = good(&mut studio, open).json;
        let settled = opened["settled_s"].as_f64().unwrap();
        assert!(settled > 1.0 / 30.0 && settled < 0.25, "{settled}");
        run(&mut studio, 5000);
        good(&mut studio, json!({ "do": "verdict", "slot": 0 })).json
    };
    let healthy = verdict(HEALTHY.to_owned());
    let damaged = verdict(format!("{HEALTHY}{SPALL}"));
    let answer = good(&mut studio, json!({ "do": "differ", "a": healthy, "b": damaged })).json;
    let headline = answer["headline"].as_str().unwrap();
    assert!(headline.starts_with("B against A: damage at BPFO in B alone; RMS × "), "{headline}");
    let rms = &answer["ratios"][0];
    assert!(rms["apart"] == json!(true) && rms["low"].as_f64().unwrap() > 2.0, "{rms}");
    let without = json!({ "do": "differ", "a": healthy });
    assert_eq!(ask(&mut studio, without).json["ok"], json!(false));
}

#[test]
fn regress_a_file_of_an_examples_name_is_not_the_examples_file() {
    let mut studio = Studio::new();
    for (name, file) in [("photo", "photo-spall.png"), ("scan", "scan.csv")] {
        let text = fs::read_to_string(Path::new("../../examples").join(name).with_extension("toml")).unwrap();
        for request in ["open", "normal"] {
            let answer = ask(&mut studio, json!({ "do": request, "slot": 0, "toml": text })).json;
            let words = format!("defect 1: {file} is not here; drop the file on the raceway");
            assert_eq!(answer["problems"][0]["message"], json!(words), "{answer}");
        }
    }
}

#[test]
fn regress_a_whole_run_warns_of_its_result_as_the_command_does() {
    // The spall does parametric work.
    let text = format!("{HEALTHY}{SPALL}").replace("0.06", "0.2");
    let loaded = &brinell::document::read(&text, &[]).unwrap();
    let (result, _) = brinell::record(&loaded.scenario).unwrap();
    let (simulation, outcome, findings) = (&result.simulation, &result.outcome, &result.findings);
    let beforehand = &Beforehand::of(&loaded.scenario, simulation.model());
    let of_command = Parts { loaded, simulation, outcome, findings, beforehand, healthy: None }.warnings();
    assert!(of_command.iter().any(|words| words.starts_with("parametric work")), "{of_command:?}");
    let mut studio = Studio::new();
    let opened = good(&mut studio, json!({ "do": "open", "slot": 0, "toml": text })).json;
    run(&mut studio, 10_000);
    let shown = good(&mut studio, json!({ "do": "indicators", "slot": 0 })).json;
    let all = [opened["warnings"].as_array().unwrap().as_slice(), shown["warnings"].as_array().unwrap()].concat();
    assert_eq!(all, of_command);
}
