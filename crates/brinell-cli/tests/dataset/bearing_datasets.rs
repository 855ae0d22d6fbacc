//! The files with which the Python package bearing-datasets builds a data set. What it makes of them is held against the
//! Parquet files in validation/readers/check_bearing_datasets.py.

use super::{PLAN, SECRET, brinell, folder_with, json, make};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// The plan's facts in `dataset.yaml`: one key a line, each value a string of JSON.
fn fact(folder: &Path, key: &str) -> String {
    let text = fs::read_to_string(folder.join("bearing_datasets/dataset.yaml")).unwrap();
    let line =
        text.lines().find_map(|line| line.strip_prefix(&format!("{key}: "))).unwrap_or_else(|| panic!("{key}: {text}"));
    serde_json::from_str::<Value>(line).unwrap().as_str().unwrap().to_owned()
}

#[test]
fn prop_a_finished_data_set_tells_bearing_datasets_what_it_is() {
    let folder = folder_with(PLAN);
    let out = folder.path().join("out");
    make(folder.path(), &["-o", "out", "--shard", "1/2", "-q"]).exits(0);
    assert!(!out.join("bearing_datasets").exists());
    make(folder.path(), &["-o", "out", "--shard", "2/2", "-q"]).exits(0);
    let version = json(&out.join("dataset.json"))["brinell"].as_str().unwrap().to_owned();
    assert_eq!(fact(&out, "name"), "test");
    assert_eq!(fact(&out, "title"), format!("test (simulated by brinell {version})"));
    assert_eq!(fact(&out, "license"), "CC0-1.0");
    let description = fact(&out, "description");
    for words in ["Simulated, not measured: 7 runs", "signal_start_s", "truth/"] {
        assert!(description.contains(words), "{words}: {description}");
    }
    assert!(!description.contains("held_out") && !description.contains("assumption"), "{description}");
    // Whom to cite is what `brinell cite` says.
    let (citation, told) = (fact(&out, "citation"), brinell(folder.path(), &["cite"]).exits(0).out);
    let of_told = |key: &str| -> Vec<String> {
        let lines = told.lines().filter_map(|line| line.trim().strip_prefix(key)?.trim_start().strip_prefix("= {"));
        lines.map(|rest| rest.trim_end_matches([',', '}']).to_owned()).collect()
    };
    let facts = [of_told("title"), of_told("doi"), of_told("version"), of_told("year"), of_told("journal")].concat();
    assert_eq!(facts.len(), 7, "{told}");
    for fact in facts {
        assert!(citation.contains(&fact), "{fact}: {citation}");
    }
    // Every note is on a column that the builder gives, or on one of the format's.
    let builder = fs::read_to_string(out.join("bearing_datasets/builder.py")).unwrap();
    let yaml = fs::read_to_string(out.join("bearing_datasets/dataset.yaml")).unwrap();
    let notes = yaml.split_once("\ncolumns:\n").unwrap().1.lines();
    let noted: Vec<&str> =
        notes.filter_map(|line| line.strip_prefix("  ")?.split_once(':').map(|(name, _)| name)).collect();
    assert!(noted.len() > 20 && noted.iter().all(|name| builder.contains(&format!("\"{name}\""))), "{noted:?}");

    // What its author went on with stays, and nothing of it is a fault.
    fs::write(out.join("bearing_datasets/dataset.yaml"), "name: mine\n").unwrap();
    make(folder.path(), &["-o", "out", "-q"]).exits(0);
    assert_eq!(fs::read_to_string(out.join("bearing_datasets/dataset.yaml")).unwrap(), "name: mine\n");
    brinell(folder.path(), &["dataset", "verify", "out"]).exits(0).keeps_quiet();
}

#[test]
fn prop_a_name_becomes_one_that_a_folder_may_have() {
    for (name, wanted) in [
        (r#"NU 206: \"spalls\""#, "NU_206_spalls"),
        ("6205-spalls", "set_6205_spalls"),
        (r"../\u0085Prüfstand\u2028é\n", "Pr_fstand"),
        ("軸受", "dataset"),
    ] {
        let plan =
            PLAN.replace("name = \"test\"", &format!("name = \"{name}\"")).replace("licence = \"CC0-1.0\"\n", "");
        let folder = folder_with(&plan.replace("runs = 7", "runs = 2"));
        make(folder.path(), &["-o", "out", "-q"]).exits(0);
        let out = folder.path().join("out");
        assert_eq!(fact(&out, "name"), wanted, "{name}");
        assert!(fact(&out, "license").starts_with("unspecified"));
        // YAML's readers refuse what is not printable, and break lines at more than one character.
        let yaml = fs::read_to_string(out.join("bearing_datasets/dataset.yaml")).unwrap();
        let odd = |c: char| c != '\n' && (c.is_control() || "\u{2028}\u{2029}\u{feff}".contains(c));
        assert!(!yaml.contains(odd), "{yaml:?}");
    }
}

#[test]
fn prop_nothing_that_bearing_datasets_reads_depends_on_held_out_labels() {
    let held = |secret: &str| {
        let plan = PLAN.replace("runs = 7", &format!("runs = 7\nheld_out = 0.5\nsecret = \"{secret}\""));
        let folder = folder_with(&plan);
        make(folder.path(), &["-o", "out", "-q"]).exits(0);
        let out = folder.path().join("out/bearing_datasets");
        ["dataset.yaml", "builder.py", "files.lock.json"].map(|name| fs::read_to_string(out.join(name)).unwrap())
    };
    let (one, other) = (held(SECRET), held(&SECRET.replace('9', "8")));
    assert_eq!(one, other);
    assert!(one[0].contains("split held_out are not published") && !one[1].contains("held_out/"), "{}", one[0]);
}
