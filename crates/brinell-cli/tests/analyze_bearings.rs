//! `brinell analyze` of several bearings of one machine.

use crate::common::{brinell, column, impacts, json};
use std::fs;
use tempfile::{TempDir, tempdir};

/// Impacts on the outer race of a 6205 at 1800 r/min, in noise, as `x.csv`.
fn outer() -> TempDir {
    let folder = tempdir().unwrap();
    column(&folder.path().join("x.csv"), &impacts(6.0));
    folder
}

const SIGNAL: [&str; 8] = ["analyze", "x.csv", "--rate", "12000", "--unit", "g", "--speed", "1800"];

#[test]
fn regress_each_bearing_is_judged_by_itself() {
    let folder = outer();
    // The sound one is named first.
    let both = ["--bearing", "6203-2RS", "--bearing", "6205-2RS", "-o", "look"];
    brinell(folder.path(), &[&SIGNAL[..], &both].concat()).exits(0).says(&[
        "Bearing 1 of 2, 6203-2RS: The lines at 107.",
        "Hz are 6205-2RS's, whose BPFO is called damage: one sensor records both, and of this bearing they say nothing. Cannot tell: the deepest comb of lines lies at 107.",
        "Bearing 2 of 2, 6205-2RS: Outer race damage, clear: BPFO at 107.",
    ]);
    let found = json(&folder.path().join("look/analysis.json"));
    assert_eq!(found["leads"], "6205-2RS");
    assert_eq!(found["bearings"][0]["bearing"], "6203-2RS");
    assert_eq!(found["bearings"][0]["verdict"]["says"], "cannot_tell");
    assert_eq!(found["verdict"]["damage"][0], "outer_race");
    assert_eq!(found["bearings"][1]["verdict"]["damage"][0], "outer_race");
    let page = fs::read_to_string(folder.path().join("look/report.html")).unwrap();
    for part in ["<h2>Bearings</h2>", "6205-2RS: Outer race damage", "cannot tell, lines of 6205-2RS"] {
        assert!(page.contains(part), "{part}");
    }
    // One of them alone has the same verdict.
    let one = ["--bearing", "6205-2RS", "--json", "one.json"];
    brinell(folder.path(), &[&SIGNAL[..], &one].concat()).exits(0);
    let one = json(&folder.path().join("one.json"));
    assert_eq!(one["verdict"], found["bearings"][1]["verdict"]);
}

/// Two names of bearings whose frequencies are the same to 1 %: the lines are either's, and the first one's cannot be
/// told from the other's.
#[test]
fn prop_lines_that_both_explain_are_eithers() {
    let folder = outer();
    let both = ["--bearing", "6205-2RS", "--bearing", "6205", "--json", "r.json"];
    brinell(folder.path(), &[&SIGNAL[..], &both].concat())
        .exits(0)
        .says(&["The lines of BPFO are either bearing's: BPFO of 6205"]);
    let found = json(&folder.path().join("r.json"));
    let lead = found["leads"].as_str().unwrap();
    for bearing in found["bearings"].as_array().unwrap() {
        let beside = bearing["beside"].as_str().unwrap();
        assert!(beside.contains("either bearing's"), "{beside}");
        let second = bearing["bearing"] != lead;
        let named = format!("It may be {lead}'s, which leads");
        assert_eq!(beside.contains(&named), second, "{beside}");
    }
}

#[test]
fn regress_several_bearings_of_several_files_and_what_goes_with_one_only() {
    let folder = outer();
    fs::copy(folder.path().join("x.csv"), folder.path().join("y.csv")).unwrap();
    let both = ["y.csv", "--bearing", "6203-2RS", "--bearing", "6205-2RS"];
    let told = brinell(folder.path(), &[&SIGNAL[..], &both, &["-o", "look"]].concat()).exits(0);
    assert_eq!(told.out.matches("6205-2RS outer race").count(), 2, "{}", told.out);
    assert_eq!(told.out.matches("6203-2RS cannot tell, lines of 6205-2RS").count(), 2, "{}", told.out);
    let page = fs::read_to_string(folder.path().join("look/report.html")).unwrap();
    assert!(page.contains("6203-2RS BPFI") && page.contains("6205-2RS BPFO"));
    let (_, verdicts) = page.split_once("<h2>Verdicts").unwrap();
    for bearing in ["6203-2RS: ", "6205-2RS: "] {
        assert_eq!(verdicts.matches(bearing).count(), 2, "{bearing}");
    }
    let two = [&SIGNAL[..], &both[1..], &["--bpfo", "3.5x"]].concat();
    brinell(folder.path(), &two).exits(2).complains(&["--bearing: expected one bearing with --bpfo"]);
    let beside = ["--against", "y.csv", "--against-rate", "12kHz", "--against-unit", "g", "--json", "two.json"];
    let two = [&SIGNAL[..], &both[1..], &beside].concat();
    brinell(folder.path(), &two).exits(0).says(&["against y.csv"]);
    let found = json(&folder.path().join("two.json"));
    assert!(found["bearings"].as_array().unwrap().iter().all(|b| b["against"]["path"] == "y.csv"));
    let unknown = ["--bearing", "6205-2RS", "--bearing", "9999"];
    brinell(folder.path(), &[&SIGNAL[..], &unknown].concat())
        .exits(2)
        .complains(&["--bearing 9999: no bearing \"9999\"; there are "]);
    for (name, kind) in [
        ("3205", "a double row angular contact ball bearing"),
        ("NA4905", "a needle roller bearing"),
        ("29412", "a spherical roller thrust bearing, whose races are passed Z / 2 times a turn each"),
    ] {
        let told = brinell(folder.path(), &[&SIGNAL[..], &["--bearing", name]].concat()).exits(2);
        let words = format!("none of those known by name is {kind}. For another give what its maker's page tells");
        assert!(told.err.contains(&words) && !told.err.contains("did you mean"), "{}", told.err);
    }
    // Of these types others are known: no other size is suggested.
    for name in ["22210", "30205", "51105", "1206"] {
        let told = brinell(folder.path(), &[&SIGNAL[..], &["--bearing", name]].concat()).exits(2);
        assert!(told.err.contains("--rollers") && !told.err.contains("did you mean"), "{}", told.err);
    }
    let told = brinell(folder.path(), &[&SIGNAL[..], &["--bearing", "7205"]].concat()).exits(2);
    told.complains(&["did you mean 7205-A?"]);
}

#[test]
fn regress_a_scenario_stands_for_its_bearing() {
    let folder = outer();
    fs::write(
        folder.path().join("own.toml"),
        "[bearing]\npreset = \"6205\"\n[operation]\nspeed_rpm = 900\nload_n = [200, 0]\n",
    )
    .unwrap();
    let of = |bearing: &str| {
        let options = ["--bearing", bearing, "--json", "r.json"];
        brinell(folder.path(), &[&SIGNAL[..], &options].concat()).exits(0);
        json(&folder.path().join("r.json"))
    };
    let (own, named) = (of("own.toml"), of("6205"));
    assert_eq!(own["verdict"], named["verdict"]);
    // A file that is not there is said as a file.
    brinell(folder.path(), &[&SIGNAL[..], &["--bearing", "other.toml"]].concat()).exits(2).complains(&["other.toml"]);
}
