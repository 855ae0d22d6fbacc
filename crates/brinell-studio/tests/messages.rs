//! `messages.md` against the engine: every request is described, and every entry of every answer is named.

use crate::malformed::good;
use crate::studio::{HEALTHY, SPALL, ask_with};
use brinell_studio::Studio;
use serde_json::{Value, json};
use std::collections::BTreeSet;

const MESSAGES: &str = include_str!("../messages.md");

/// Entries whose own are keys of scenarios, described elsewhere.
const SCENARIOS: [&str; 4] = ["scenario", "all", "schema", "shape"];

/// Names of the requests in the table.
fn described() -> BTreeSet<&'static str> {
    MESSAGES.lines().filter_map(|line| line.strip_prefix("| `")?.split('`').next()).collect()
}

fn names<'a>(value: &'a Value, found: &mut BTreeSet<&'a str>) {
    match value {
        Value::Object(entries) => {
            for (name, value) in entries {
                found.insert(name);
                if !SCENARIOS.contains(&name.as_str()) {
                    names(value, found);
                }
            }
        }
        Value::Array(items) => items.iter().for_each(|item| names(item, found)),
        _ => {}
    }
}

#[test]
fn prop_every_request_is_described_and_every_one_described_is_answered() {
    let arms =
        include_str!("../src/studio.rs").lines().filter_map(|line| line.trim().strip_prefix('"')?.split_once("\" =>"));
    let answered: BTreeSet<&str> = arms.map(|(name, _)| name).collect();
    assert_eq!(described(), answered);
    let asked: Vec<Value> = good();
    let asked: BTreeSet<&str> = asked.iter().filter_map(|request| request["do"].as_str()).collect();
    assert_eq!(asked, answered);
}

#[test]
fn prop_every_entry_of_an_answer_is_named() {
    let words: BTreeSet<&str> = MESSAGES.split(|c: char| !c.is_alphanumeric() && c != '_' && c != '$').collect();
    let points = [-1.0_f64, 0.0, 1.0, 0.5, 2.0, -0.5];
    let stroke: Vec<u8> = points.iter().flat_map(|x| x.to_le_bytes()).collect();
    let table: String = (0..4000).map(|k| format!("{}\n", (0.7 * f64::from(k)).sin())).collect();
    let mut complete = BTreeSet::new();
    // Of a run that goes on, and of one that is over.
    for rows in [600, 20_000] {
        let mut studio = Studio::new();
        let run = json!({ "do": "open", "slot": 0, "toml": format!("{HEALTHY}{SPALL}").replace("0.06", "0.4") });
        ask_with(&mut studio, run, &[]);
        ask_with(&mut studio, json!({ "do": "advance", "slot": 0, "rows": rows }), &[]);
        for mut request in good() {
            let file = ["listen", "judge"].iter().any(|name| request["do"] == *name);
            if file {
                request["bytes"] = json!({ "$": ["u8", 0, table.len()] });
                request.as_object_mut().unwrap().remove("channel");
            }
            // Another bearing is opened and goes on beside the one that has run.
            if ["open", "advance"].iter().any(|name| request["do"] == *name) {
                request["slot"] = 1.into();
            }
            let answer = ask_with(&mut studio, request.clone(), if file { table.as_bytes() } else { &stroke }).json;
            if answer["ok"] == true {
                complete.extend(request["do"].as_str().map(str::to_owned));
            }
            let mut found = BTreeSet::new();
            names(&answer, &mut found);
            let missing: Vec<&&str> = found.iter().filter(|name| !words.contains(**name)).collect();
            assert!(missing.is_empty(), "messages.md does not name {missing:?} of the answer to {request}");
        }
    }
    // What needs a file of its own: `tests/studio.rs` asks `outline` with one, `page/tests` hand tables over.
    let without: Vec<&str> = described().into_iter().filter(|name| !complete.contains(*name)).collect();
    assert_eq!(without, ["outline", "take"]);
}
