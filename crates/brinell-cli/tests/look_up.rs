//! The commands that look things up: `frequencies`, `bearing`, `schema`.

use crate::common::{SHORT, brinell, brinell_reading, folder_with, parsed, typed};
use tempfile::tempdir;

/// NN3007, pure rolling at 1800 r/min, Hz.
const SECTION_13: [(&str, f64); 4] = [("bpfo", 250.102), ("bpfi", 319.898), ("ftf", 13.163), ("bsf", 120.663)];

fn call(args: &[&str]) -> crate::common::Call {
    brinell(tempdir().unwrap().path(), args)
}

#[test]
fn analytic_frequencies_of_the_papers_bearing() {
    let text = call(&["frequencies", "NN3007", "--speed", "1800"]).exits(0).keeps_quiet().out;
    let by_numbers = typed("frequencies --pitch 49 --diameter 6 --rollers 19 --speed 1800 --json");
    let catalogued = call(&["frequencies", "nn3007", "--speed", "1800", "--json"]).exits(0);
    let [catalogued, given] = [catalogued, call(&by_numbers).exits(0)].map(|c| parsed(&c.out));
    for (name, hz) in SECTION_13 {
        let line = text
            .lines()
            .find(|l| l.trim_start().starts_with(&name.to_uppercase()))
            .unwrap_or_else(|| panic!("no {name} in {text}"));
        let printed: f64 = line.split_whitespace().nth(1).unwrap().parse().unwrap();
        for found in [&catalogued, &given] {
            let found = found[format!("{name}_hz")].as_f64().unwrap();
            // Half of the last digit, there of section 13, here of the terminal.
            assert!((found - hz).abs() <= 5e-4, "{name}: {found}");
            assert!((found - printed).abs() <= 5.1e-5, "{name}: {printed} printed, {found} in JSON");
        }
    }
    assert_eq!(catalogued["speed_rpm"], 1800.0);
    let [once, twice] = ["bsf_hz", "2bsf_hz"].map(|name| catalogued[name].as_f64().unwrap());
    assert_eq!(twice, 2.0 * once);
}

#[test]
fn prop_frequencies_are_orders_without_a_speed_and_know_no_sense_of_rotation() {
    let json = |args: &[&str]| {
        let args = [&["frequencies", "NU206", "--json"], args].concat();
        parsed(&call(&args).exits(0).out)
    };
    let (order, forth, back) = (json(&[]), json(&["--speed", "1500"]), json(&["--speed", "-1500"]));
    assert_eq!(order["shaft_hz"], 1.0);
    for name in ["ftf_hz", "bpfo_hz", "bpfi_hz", "bsf_hz"] {
        let [order, forth, back] = [&order, &forth, &back].map(|v| v[name].as_f64().unwrap());
        assert!((forth - 25.0 * order).abs() < 1e-12 * forth, "{name}");
        assert_eq!(forth, back, "{name}");
    }
}

/// As `analyze` takes them.
#[test]
fn regress_frequencies_take_a_name_an_angle_and_a_speed_in_hz() {
    let named = typed("frequencies ZA-2115 --speed 2000 --json");
    let same = typed("frequencies --bearing ZA-2115 --speed 33.333333333333336Hz --json");
    let inches =
        typed("frequencies --rollers 16 --pitch 2.815in --diameter 0.331in --contact-angle 15.17 --speed 2000 --json");
    for key in ["bpfo_hz", "bpfi_hz", "bsf_hz", "ftf_hz"] {
        let [named, same, inches] =
            [&named, &same, &inches].map(|args| parsed(&call(args).exits(0).out)[key].as_f64().unwrap());
        assert!((same / named - 1.0).abs() < 1e-9 && (inches / named - 1.0).abs() < 1e-3, "{key}");
    }
}

#[test]
fn regress_frequencies_of_a_scenario_use_its_speed() {
    let folder = folder_with("s", SHORT);
    let read = brinell(folder.path(), &["frequencies", "s"]).exits(0).says(&["Pure rolling at 1500 r/min"]);
    let piped = brinell_reading(folder.path(), &["frequencies", "-"], SHORT.as_bytes()).exits(0);
    assert_eq!(read.out.replace("the scenario s", "the scenario -"), piped.out);
}

#[test]
fn regress_frequencies_tell_that_a_maker_in_front_chooses_nothing() {
    let words = "their number or size is estimated";
    let another = "those of NACHI give 10 of 16.669 mm";
    call(&["frequencies", "NACHI 6213"]).exits(0).says(&[words, another, "may differ between makers"]);
    let json = parsed(&call(&["frequencies", "NACHI 6213", "--json"]).exits(0).out);
    assert!(json["source"].as_str().unwrap().contains(another), "{json}");
}

#[test]
fn regress_frequencies_refuse_what_makes_no_bearing() {
    for (args, parts) in [
        (&[][..], &["brinell bearing list", "--pitch"][..]),
        (
            &["NN3008"],
            &[
                "no bearing \"NN3008\"",
                "did you mean NN3007?",
                "There are NN3007, ",
                "`brinell bearing list` shows all",
            ],
        ),
        (&["missing.toml"], &["cannot read missing.toml"]),
        (&["NN3007", "--speed", "0"], &["--speed 0", "r/min"]),
        (&["NN3007", "--speed", "nan"], &["--speed", "r/min"]),
        (&["NN3007", "--pitch", "49"], &["--pitch"]),
        (&["--pitch", "49"], &["--rollers, --pitch and --diameter describe a bearing together"]),
        (&["--bearing", "NN3007", "--pitch", "49"], &["--bearing", "--pitch"]),
        (&["--pitch", "49", "--diameter", "-6", "--rollers", "19"], &["--diameter -6", "0 < diameter < pitch in mm"]),
        (&["--pitch", "49", "--diameter", "60", "--rollers", "19"], &["--diameter 60", "in mm"]),
        (&["--pitch", "49", "--diameter", "6", "--rollers", "2"], &["--rollers 2", "3 or more elements"]),
        (&["--pitch", "49", "--diameter", "6", "--rollers", "2.5"], &["expected a whole number of rolling elements"]),
        (&["--pitch", "39", "--diameter", "7.5", "--rollers", "17"], &["--rollers 17", "up to 16 have room"]),
    ] {
        let call = call(&[&["frequencies"], args].concat()).exits(2).complains(parts);
        assert_eq!(call.out, "");
    }
}

#[test]
fn regress_bearings_are_listed_and_shown_with_their_sources() {
    let list = call(&["bearing", "list"]).exits(0).keeps_quiet().out;
    let names: Vec<&str> =
        list.lines().take_while(|line| !line.is_empty()).map(|line| line.split(' ').next().unwrap()).collect();
    assert!(names.contains(&"NN3007") && names.len() >= 5, "{names:?}");
    for name in names {
        let shown = call(&["bearing", "show", name]).exits(0).keeps_quiet().out;
        let mut lines = shown.lines();
        assert!(lines.next().unwrap().starts_with(&format!("{name}: ")));
        let ends: Vec<usize> = lines
            .map(|line| {
                let words: Vec<&str> = line.split_whitespace().collect();
                assert!(words.len() > 2, "no source: {line}");
                let value = line.find(&format!(" {}  ", words[1])).unwrap();
                value + words[1].len()
            })
            .collect();
        assert!(ends.len() > 8, "{shown}");
        assert!(ends.iter().all(|end| *end == ends[0]), "not aligned:\n{shown}");
    }
    call(&["bearing", "show", "NN307"]).exits(2).complains(&["no bearing \"NN307\"", "did you mean NN3007?"]);
    // The name alone is shown too.
    assert_eq!(
        call(&["bearing", "NU", "206", "--json"]).exits(0).out,
        call(&["bearing", "show", "NU206", "--json"]).exits(0).out
    );
    call(&["bearing", "NN307"]).exits(2).complains(&["did you mean NN3007?"]);
}

#[test]
fn regress_every_listed_bearing_is_known_to_frequencies_and_show() {
    let list = call(&["bearing", "list"]).exits(0).out;
    let blocks: Vec<&str> = list.split("\n\n").collect();
    let of_data_sets: Vec<&str> = blocks[1].lines().skip(1).map(|line| line.split(' ').next().unwrap()).collect();
    assert!(of_data_sets.contains(&"ZA-2115"), "{list}");
    for name in of_data_sets {
        let shown = call(&["bearing", "show", name]).exits(0).says(&[name]).out;
        assert!(["pitch_diameter_mm", "bpfo_order"].iter().any(|row| shown.contains(row)), "{shown}");
        call(&["frequencies", name]).exits(0).keeps_quiet();
    }
    // The data set prints 3.5848; the option's earlier name is still understood.
    let json = parsed(&call(&["frequencies", "6205", "--json"]).exits(0).out);
    assert!((json["bpfo_hz"].as_f64().unwrap() - 3.5848).abs() < 1e-4);
    let numbers = |diameter: &str| {
        let args = ["frequencies", "--pitch", "39", diameter, "7.5", "--rollers", "13"];
        call(&args).exits(0).out
    };
    assert_eq!(numbers("--diameter"), numbers("--roller"));
}

#[test]
fn regress_the_schema_of_plans_has_their_keys_and_those_of_scenarios() {
    let schema = parsed(&call(&["schema", "--plan"]).exits(0).keeps_quiet().out);
    assert_eq!(schema["title"], "brinell plan");
    assert_eq!(schema["required"], serde_json::json!(["base"]));
    assert_eq!(schema["oneOf"][0]["required"], serde_json::json!(["runs"]));
    assert!(schema["properties"]["history"]["properties"]["fails_mm"].is_object());
    let speed = "/$defs/vary/properties/operation/anyOf/0/properties/speed_rpm/anyOf/1/$ref";
    assert_eq!(schema.pointer(speed).unwrap(), "#/$defs/distribution");
}

#[test]
fn regress_the_schema_is_a_json_schema() {
    let schema = parsed(&call(&["schema"]).exits(0).keeps_quiet().out);
    assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    let sections = schema["properties"].as_object().unwrap();
    for section in
        ["name", "bearing", "cage", "contact", "friction", "lubricant", "support", "operation", "defects", "simulation"]
    {
        assert!(sections.contains_key(section), "{section}");
    }
}
