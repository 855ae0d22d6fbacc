//! `brinell analyze --bearing unknown`, and the bearings that have what it finds.

use crate::common::{brinell, column, impacts, json};
use std::fs;
use tempfile::tempdir;

const SIGNAL: [&str; 8] = ["analyze", "x.csv", "--rate", "12000", "--unit", "g", "--speed", "1800"];
const UNKNOWN: [&str; 2] = ["--bearing", "unknown"];

#[test]
fn regress_without_a_bearing_the_comb_and_who_has_it_are_named() {
    let folder = tempdir().unwrap();
    // On the outer race of a 6205.
    column(&folder.path().join("x.csv"), &impacts(6.0));
    let call = |more: &[&str]| brinell(folder.path(), &[&SIGNAL[..], more].concat());
    call(&[]).exits(2).complains(&["which bearing?", "--bearing unknown seeks without one"]);
    let out = call(&[&UNKNOWN[..], &["-o", "look", "--pdf", "customer.pdf"]].concat())
        .exits(0)
        .says(&[
            "Cannot tell which part: no bearing is given. A comb of lines (one and its multiples) lies at 107.",
            "Known by name with such a frequency, within 2 %: ",
            "6205 (BPFO 3.585)",
        ])
        .out;
    // There is no frequency to show anything at.
    assert!(!out.contains("Assessment"), "{out}");
    let found = json(&folder.path().join("look/analysis.json"));
    assert_eq!(found["verdict"]["says"], "cannot_tell");
    let order = found["elsewhere"]["order"].as_f64().unwrap();
    assert!((order / 3.585 - 1.0).abs() < 0.01, "{order}");
    let page = fs::read_to_string(folder.path().join("look/report.html")).unwrap();
    assert!(!page.contains("Defect frequencies</h2>"));
    // With a frequency it is an analysis of that.
    call(&[&UNKNOWN[..], &["--bpfo", "3.585x"]].concat()).exits(0).says(&["Outer race damage"]);
    call(&[&UNKNOWN[..], &["--bearing", "6205"]].concat())
        .exits(2)
        .complains(&["--bearing unknown: expected it alone"]);
}

#[test]
fn regress_bearings_are_found_by_their_frequencies() {
    let folder = tempdir().unwrap();
    let list = |more: &[&str]| brinell(folder.path(), &[&["bearing", "list"], more].concat());
    let one = list(&["--order", "3.595"]).exits(0).says(&["6205     BPFO    3.585 (+0.28 %)"]).out;
    let both = list(&["--order", "3.595", "--order", "4.71"]).exits(0).says(&["2 BSF   4.71"]).out;
    assert!(both.lines().count() < one.lines().count(), "{both}");
    list(&["--order", "3.595", "--order", "150"]).exits(0).says(&["No bearing known by name"]);
    list(&["--order", "107.4Hz"]).exits(2);
    list(&["--order", "0.4"]).exits(2).complains(&["--order 0.4: expected 1 to 200"]);
    let all = serde_json::from_str::<serde_json::Value>(&list(&["--order", "3.595", "--json"]).exits(0).out).unwrap();
    assert!(all.as_array().unwrap().iter().all(|one| one["frequencies"].is_object()), "{all}");
}
