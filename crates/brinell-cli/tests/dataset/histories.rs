//! Histories: machines that run to failure, row by row, and a page of one.

use super::{brinell, cell, folder_with, list, make, rows, same, text, whole};
use parquet::record::{Field, Row};
use std::fs;

/// Two machines; the base's 1500 r/min for eight turns after the start and more.
const PLAN: &str = r#"name = "lives"
base = "base.toml"
machines = 3
snapshots = 4
seed = 11
runs_per_file = 6

[split]
test = 0.3

[history]
every_h = 100
law = "exponential"
rate = { uniform = [2, 4] }
begins_mm = 1.0
fails_mm = 4.0
life_h = 300.0
begins_at = 0.2
scatter = 0.5

[history.snapshot]
operation.speed_rpm = { uniform = [1400, 1600] }

[vary]
simulation.duration_s = 0.42
simulation.laws = "mechanics"
contact.tables = "coarse"

[[classes]]
name = "outer"
[[classes.defects]]
on = "outer-raceway"
depth_um = 20
shape.random = { length_mm = 2, width_mm = 3 }

[[classes]]
name = "healthy"
share = 0.5
defects = []
"#;

fn number(row: &Row, name: &str) -> Option<f64> {
    match cell(row, name) {
        Field::Double(x) => Some(*x),
        Field::Null => None,
        other => panic!("{name}: {other}"),
    }
}

#[test]
fn prop_a_machine_is_in_one_file_with_the_truth_of_its_life_whatever_the_shards() {
    let folder = folder_with(PLAN);
    let here = folder.path();
    make(here, &["-o", "one", "--dry-run"]).exits(0).says(&[
        "lives: 12 runs in 3 files",
        "3 machines of up to 4 snapshots, one every 100 h, observed until 1 of the life; 3 of them to its end",
        "assumed: exponential with history.rate = 2 to 4, scatter 0.5; from 1 mm to 4 mm, where a machine counts as failed",
        "damage begins at 0.2 of the life, which is 300 h",
        "0 outer: 2 machines, 8 runs",
    ]);
    make(here, &["-o", "one", "-q"]).exits(0);
    for shard in ["2/2", "1/2"] {
        make(here, &["-o", shard.trim_end_matches("/2"), "--shard", shard, "-q"]).exits(0);
    }
    brinell(here, &["dataset", "merge", "1", "2", "-o", "joined", "-q"]).exits(0);
    same(&here.join("one"), &here.join("joined"));
    brinell(here, &["dataset", "verify", "joined"]).exits(0).says(&["3 of 3 files sound, 12 runs with 0 failed"]);

    let files = (0..3).map(|k| rows(&here.join(format!("one/runs/part-{k:05}.parquet"))));
    let mut seen = Vec::new();
    for file in files {
        // Six rows would part the second machine.
        assert_eq!(file.len(), 4);
        assert!(file.iter().all(|row| text(row, "split") == text(&file[0], "split")));
        let machine = whole(&file[0], "machine");
        assert!(file.iter().zip(0..).all(|(row, k)| (whole(row, "machine"), whole(row, "snapshot")) == (machine, k)));
        let fails = text(&file[0], "class").unwrap() == "outer";
        let states: Vec<String> = file.iter().filter_map(|row| text(row, "state")).collect();
        if fails {
            assert_eq!(states, ["healthy", "damaged", "damaged", "failed"]);
            check_life(&file);
        } else {
            assert_eq!(states, ["healthy"; 4]);
            assert!(file.iter().all(|row| number(row, "remaining_life_h").is_none() && *cell(row, "censored") == Field::Bool(true)));
        }
        seen.push(machine);
    }
    seen.sort_unstable();
    assert_eq!(seen, [0, 1, 2]);
    let about = fs::read_to_string(here.join("one/dataset.json")).unwrap();
    for part in [
        "\"machines\": 3",
        "\"assumed\": \"a snapshot every 100 h; length as an exponential function of the running time",
        "\"rows_of_files\"",
        "\"remaining_life_h\"",
    ] {
        assert!(about.contains(part), "{part}");
    }
    let card = fs::read_to_string(here.join("one/README.md")).unwrap();
    assert!(card.contains("**How damage grows is an assumption, and no prediction**") && card.contains("## Histories"));
    for words in ["**No model may be given it.**", "its remainder by the number of classes", "not how many follow"] {
        assert!(card.contains(words), "{words} in {card}");
    }
    let runs = super::rows_of(&here.join("one/runs/part-00000.parquet"));
    for known in ["machine", "snapshot", "time_h", "revolutions"] {
        assert!(runs[0].get_column_iter().any(|(name, _)| name == known), "{known}");
    }
    for truth in ["remaining_life_h", "state", "load_cycles", "life_h", "edge_pressure_mpa", "history.rate"] {
        assert!(super::is_hidden(&runs[0], truth), "{truth}");
    }
    assert!(!about.contains("  edges rounded"), "blanks");
}

/// Of a machine that fails: what rows say of its life hangs together.
fn check_life(file: &[Row]) {
    let of = |name: &str| file.iter().map(|row| number(row, name).unwrap()).collect::<Vec<f64>>();
    assert_eq!(of("time_h"), [0.0, 100.0, 200.0, 300.0]);
    assert_eq!(of("remaining_life_h"), [300.0, 200.0, 100.0, 0.0]);
    assert_eq!(of("damage_begins_h"), [60.0; 4]);
    // Each snapshot's speed holds from the one before it; damage has run for 40 h of the first 100.
    let (turns, passes, damaged) = (of("revolutions"), of("load_cycles"), of("load_cycles_damaged"));
    for (k, row) in file.iter().enumerate().skip(1) {
        let speed = number(row, "speed_rpm").unwrap();
        assert!((turns[k] - turns[k - 1] - 6000.0 * speed).abs() <= 1.0);
        let each = number(row, "bpfo_hz").unwrap() / (speed / 60.0);
        assert!((passes[k] / (turns[k] * each) - 1.0).abs() < 1e-6);
        let hours = if k == 1 { 0.4 } else { 1.0 };
        assert!(((damaged[k] - damaged[k - 1]) / (hours * (passes[k] - passes[k - 1])) - 1.0).abs() < 1e-6);
        let outline = ["outline_s_mm", "outline_z_mm"].map(|name| list(row, name).unwrap());
        assert!(outline[0].len() > 10 && outline[0].len() == outline[1].len());
        let span = outline[0].iter().fold(f64::NEG_INFINITY, |a, b| a.max(*b))
            - outline[0].iter().fold(f64::INFINITY, |a, b| a.min(*b));
        assert!((span - list(row, "defect_length_mm").unwrap()[0]).abs() < 1e-5);
        // At a sharp edge the pressure is higher than that of the sound contact.
        assert!(number(row, "edge_pressure_mpa").unwrap() > list(row, "sound_pressure_mpa").unwrap()[1]);
        assert!(!list(row, "entry_t_s").unwrap().is_empty());
    }
    assert_eq!(list(&file[3], "defect_length_mm").unwrap()[0], 4.0);
    assert!(list(&file[0], "outline_s_mm").unwrap().is_empty() && number(&file[0], "edge_pressure_mpa").is_none());
}

#[test]
fn regress_what_a_history_is_not_is_refused_at_its_line() {
    let folder = folder_with(&PLAN.replace("fails_mm = 4.0", "fails_mm = 0.5"));
    make(folder.path(), &["-o", "out"])
        .exits(2)
        .complains(&["history.fails_mm = 0.5: damage begins with up to 1 mm", "plan.toml:16:"]);
    let folder = folder_with(&PLAN.replace("duration_s = 0.42", "duration_s = 0.3"));
    make(folder.path(), &["-o", "out"]).exits(2).complains(&[
        "simulation.duration_s = 0.3: a snapshot of 5.53 turns of the shaft from the end of its start on at the slowest speed, 1400 r/min (in 12 of 12 runs",
        "allowed: >= 0.406 s: 8 turns after the start",
        "plan.toml:25:",
    ]);
    let folder = folder_with(&PLAN.replace("scatter = 0.5", "scatter = 0.0"));
    make(folder.path(), &["--dry-run"])
        .exits(0)
        .complains(&["warning: history.scatter = 0: the lengths of all 3 machines follow the law"]);
    let folder = folder_with(&PLAN.replace("scatter = 0.5", "observed = 0.1"));
    make(folder.path(), &["--dry-run"]).exits(0).complains(&["[history] grows nothing: no snapshot has damage"]);
    let folder = folder_with(&PLAN.replace("depth_um = 20", "depth_um = 0"));
    make(folder.path(), &["--dry-run"])
        .exits(2)
        .complains(&["no length or no depth", "allowed: a shape with a length, and depth_um above 0"]);
    let folder = folder_with(&PLAN.replace("fails_mm = 4.0", "fails_mm = 400"));
    let call = make(folder.path(), &["--dry-run"]).exits(2).complains(&[
        "history.fails_mm = 400: damage of this length goes once around the outer raceway (in 6 of 12 runs",
        "plan.toml:16:",
    ]);
    assert!(!call.err.contains("give narrower distributions"), "{call:#?}");
    let folder = folder_with(&PLAN.replace("fails_mm = 4.0", "fails_mm = { uniform = [4, 400] }"));
    make(folder.path(), &["--dry-run"])
        .exits(2)
        .complains(&["goes once around", "give narrower distributions, or `out_of_range = \"fail\"`"]);
    let of_machine = PLAN.replace("seed = 11", "seed = 11\nsignals = [\"*\"]");
    let folder = folder_with(&of_machine.replace("name = \"outer\"\n", "name = \"outer\"\nbearing = 7\n"));
    fs::write(folder.path().join("base.toml"), include_str!("../../src/init/machine.toml")).unwrap();
    make(folder.path(), &["--dry-run"]).exits(2).complains(&[
        "classes.0.bearing = 7: the base has 2 bearings",
        "allowed: 1 to 2",
        "plan.toml:32:",
    ]);
    let folder = folder_with(&PLAN.replace("machines = 3\n", ""));
    make(folder.path(), &["--dry-run"])
        .exits(2)
        .complains(&["history.rate = { uniform = [2, 4] }: has a meaning only where `machines` is given"]);
    let folder = folder_with(super::PLAN);
    make(folder.path(), &["-o", "out", "-q"]).exits(0);
    brinell(folder.path(), &["dataset", "sheet", "out", "--machine", "0"])
        .exits(2)
        .complains(&["out: its runs are no histories of machines"]);
}

#[test]
fn prop_damage_off_the_middle_has_its_outline_and_its_pressure_in_one_frame() {
    let shape = "shape.random = { length_mm = 2, width_mm = 3 }";
    let plan = PLAN.replace(shape, "axial_offset_mm = 1.5\nshape.rectangle = { length_mm = 2, width_mm = 0.5 }");
    let folder = folder_with(&plan.replace("machines = 3", "machines = 1").replace("[split]\ntest = 0.3\n", ""));
    let here = folder.path();
    make(here, &["-o", "out", "-q"]).exits(0);
    let mut seen = 0;
    for row in rows(&here.join("out/runs/part-00000.parquet")).iter().skip(1) {
        let (z, at) = (list(row, "outline_z_mm").unwrap(), list(row, "edge_pressure_at_mm").unwrap());
        let ends = [z.iter().fold(f64::INFINITY, |a, b| a.min(*b)), z.iter().fold(f64::NEG_INFINITY, |a, b| a.max(*b))];
        assert!((ends[0] + ends[1] - 3.0).abs() < 1e-5, "{ends:?}");
        assert!(ends[0] - 0.15 < at[1] && at[1] < ends[1] + 0.15, "{at:?} for {ends:?}");
        seen += 1;
    }
    assert_eq!(seen, 3);
}

#[test]
fn prop_a_page_shows_one_history() {
    let folder = folder_with(&PLAN.replace("machines = 3", "machines = 1").replace("[split]\ntest = 0.3\n", ""));
    let here = folder.path();
    make(here, &["-o", "out", "-q"]).exits(0);
    brinell(here, &["dataset", "sheet", "out", "--machine", "0", "--runs", "2"])
        .exits(0)
        .says(&["out/machine-0.html: 4 snapshots. Length: told in ", " of 3 snapshots with damage; "]);
    let page = fs::read_to_string(here.join("out/machine-0.html")).unwrap();
    for part in [
        "lives: machine 0",
        "1 healthy, 2 damaged, 1 failed",
        "Damage over life",
        "Remaining life",
        "Kurtosis",
        "300 h, failed",
        " of 3 snapshots with damage; ",
    ] {
        assert!(page.contains(part), "{part}");
    }
    assert_eq!(page.matches("<strong>run ").count(), 2, "signals of two snapshots");
    brinell(here, &["dataset", "sheet", "out", "--machine", "1"])
        .exits(2)
        .complains(&["no rows of machine 1; machines of this data set are 0 to 0"]);
}

#[test]
fn prop_of_a_held_out_machine_no_row_tells_its_life() {
    let held = format!("held_out = 0.5\nsecret = \"{}\"\n[history]", super::SECRET);
    let plan = PLAN.replace("[split]\ntest = 0.3\n", "").replace("machines = 3", "machines = 4");
    let folder =
        folder_with(&plan.replace("[history]\n", &format!("{held}\n")).replace("snapshots = 4", "snapshots = 2"));
    let here = folder.path();
    make(here, &["-o", "out", "-q"]).exits(0);
    let mut apart = Vec::new();
    for k in 0.. {
        let path = here.join(format!("out/runs/part-{k:05}.parquet"));
        if !path.exists() {
            break;
        }
        apart.extend(rows(&path).into_iter().filter(|row| text(row, "split").unwrap() == "held_out"));
    }
    assert!(!apart.is_empty() && apart.len() % 2 == 0, "whole machines: {}", apart.len());
    for row in &apart {
        assert!(whole(row, "machine") >= 0 && number(row, "time_h").is_some());
        for truth in
            ["state", "life_h", "remaining_life_h", "life_share", "censored", "damage_begins_h", "outline_s_mm"]
        {
            assert!(super::is_hidden(row, truth), "{truth}");
        }
        assert!(number(row, "revolutions").is_some());
        for truth in ["load_cycles", "edge_pressure_mpa", "defect_length_mm", "history.rate"] {
            assert!(super::is_hidden(row, truth), "{truth}");
        }
    }
}
