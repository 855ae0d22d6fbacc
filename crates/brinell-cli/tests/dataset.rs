//! Data sets: the same bytes whatever the threads, the shards and the interruptions; what is there stays; what does not fit is told.

mod common;

use brinell_io::record_facts;
use common::{Call, SHORT, brinell, command, files, json};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::{Field, Row};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant, SystemTime};
use tempfile::{TempDir, tempdir};

const PLAN: &str = r#"name = "test"
base = "base.toml"
runs = 7
seed = 11
runs_per_file = 3
licence = "CC0-1.0"

[vary]
operation.speed_rpm = { uniform = [1400, 1600] }

[[classes]]
name = "healthy"
defects = []

[[classes]]
name = "outer"
[[classes.defects]]
on = "outer-raceway"
depth_um = { log = [5, 20] }
shape.random = { length_mm = { uniform = [1, 3] }, width_mm = 4 }
"#;

const SECRET: &str = "9f86d081884c7d659a2feaa0c55ad015";

fn folder_with(plan: &str) -> TempDir {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("base.toml"), SHORT).unwrap();
    fs::write(folder.path().join("plan.toml"), plan).unwrap();
    folder
}

fn make(folder: &Path, more: &[&str]) -> Call {
    brinell(folder, &[&["dataset", "plan.toml"], more].concat())
}

fn contents(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let names = files(folder).into_iter();
    names
        .map(|name| (name.clone(), fs::read(folder.join(name)).unwrap()))
        .collect()
}

#[track_caller]
fn same(a: &Path, b: &Path) {
    let (a, b) = (contents(a), contents(b));
    let names = |all: &[(String, Vec<u8>)]| all.iter().map(|f| f.0.clone()).collect::<Vec<_>>();
    assert_eq!(names(&a), names(&b));
    for ((name, a), (_, b)) in a.iter().zip(&b) {
        assert!(a == b, "{name} differs");
    }
}

fn rows(path: &Path) -> Vec<Row> {
    let reader = SerializedFileReader::new(fs::File::open(path).unwrap()).unwrap();
    reader
        .get_row_iter(None)
        .unwrap()
        .map(Result::unwrap)
        .collect()
}

fn cell<'a>(row: &'a Row, name: &str) -> &'a Field {
    row.get_column_iter()
        .find(|(n, _)| *n == name)
        .unwrap_or_else(|| panic!("{name}"))
        .1
}

fn text(row: &Row, name: &str) -> Option<String> {
    match cell(row, name) {
        Field::Str(text) => Some(text.clone()),
        Field::Null => None,
        other => panic!("{name}: {other}"),
    }
}

fn list(row: &Row, name: &str) -> Option<Vec<f64>> {
    let number = |field: &Field| match field {
        Field::Float(x) => f64::from(*x),
        Field::Double(x) => *x,
        Field::Long(x) => *x as f64,
        other => panic!("{name}: {other}"),
    };
    match cell(row, name) {
        Field::ListInternal(list) => Some(list.elements().iter().map(number).collect()),
        Field::Null => None,
        other => panic!("{name}: {other}"),
    }
}

#[test]
fn prop_neither_threads_nor_shards_nor_a_second_call_change_a_byte() {
    let folder = folder_with(PLAN);
    let at = |name: &str| folder.path().join(name);
    make(folder.path(), &["-o", "one", "-j", "1"])
        .exits(0)
        .says(&[
            "test: 7 runs in 3 files, design random, seed 11",
            "0 healthy: 4 runs",
            "7 runs in",
            "whole: one/dataset.json",
        ])
        .keeps_quiet();
    make(folder.path(), &["-o", "two", "-j", "2", "-q"])
        .exits(0)
        .keeps_quiet();
    same(&at("one"), &at("two"));
    for shard in ["3/3", "1/3", "2/3"] {
        make(folder.path(), &["-o", "three", "--shard", shard, "-q"]).exits(0);
        assert_eq!(at("three/dataset.json").exists(), shard == "2/3");
    }
    same(&at("one"), &at("three"));
    // In folders of their own, merged; then twice.
    for shard in ["1/2", "2/2"] {
        make(
            folder.path(),
            &["-o", &shard.replace('/', "-"), "--shard", shard, "-q"],
        )
        .exits(0);
    }
    brinell(folder.path(), &["dataset", "merge", "1-2", "-o", "joined"])
        .exits(1)
        .complains(&["not whole: 1 file in none of the folders (part 1)"]);
    brinell(
        folder.path(),
        &["dataset", "merge", "1-2", "2-2", "-o", "joined"],
    )
    .exits(0)
    .says(&["joined: 1 file brought, 2 there before"]);
    same(&at("one"), &at("joined"));
    brinell(folder.path(), &["dataset", "verify", "joined"])
        .exits(0)
        .says(&["3 of 3 files sound, 7 runs with 0 failed"])
        .keeps_quiet();

    // Again: nothing is touched.
    let times = |folder: &Path| -> Vec<SystemTime> {
        files(folder)
            .iter()
            .map(|f| fs::metadata(folder.join(f)).unwrap().modified().unwrap())
            .collect()
    };
    let before = times(&at("one"));
    make(folder.path(), &["-o", "one"])
        .exits(0)
        .says(&["0 runs in", "7 there before"]);
    assert_eq!(times(&at("one")), before);
    // A file that went missing comes back as it was.
    fs::remove_file(at("one").join("runs/part-00001.parquet")).unwrap();
    make(folder.path(), &["-o", "one"])
        .exits(0)
        .says(&["3 runs in", "4 there before"]);
    same(&at("one"), &at("two"));
}

#[test]
fn prop_a_row_is_the_run_that_its_scenario_gives() {
    let folder = folder_with(PLAN);
    make(folder.path(), &["-o", "out", "-q"]).exits(0);
    let all: Vec<Row> = (0..3)
        .flat_map(|k| rows(&folder.path().join(format!("out/runs/part-0000{k}.parquet"))))
        .collect();
    for (run, row) in all.iter().enumerate() {
        assert_eq!(cell(row, "run"), &Field::Long(run as i64));
        let outer = run % 2 == 1;
        assert_eq!(
            text(row, "class").as_deref(),
            Some(if outer { "outer" } else { "healthy" })
        );
        assert_eq!(
            list(row, "defect_depth_um").unwrap().len(),
            usize::from(outer)
        );
        let entries = list(row, "entry_t_s").unwrap();
        assert_eq!(entries.is_empty(), !outer, "{run}");
        assert!(entries.is_sorted() && entries.iter().all(|t| (0.0..0.03).contains(t)));
        assert_eq!(list(row, "entry_force_n").unwrap().len(), entries.len());
    }
    // The row's own scenario, run by itself, gives the same signal.
    let row = &all[3];
    fs::write(
        folder.path().join("again.toml"),
        text(row, "scenario").unwrap(),
    )
    .unwrap();
    brinell(
        folder.path(),
        &["run", "again.toml", "-o", "again", "--no-report", "-q"],
    )
    .exits(0);
    let again = brinell_io::read_parquet(folder.path().join("again/signals.parquet")).unwrap();
    let whole = again.column("measured_ax").unwrap();
    // All but the sample at the run's end: 0.02 s at 25.6 kHz are 512.
    assert_eq!(whole.len(), 513);
    let expected: Vec<f64> = whole[..512].iter().map(|x| f64::from(*x as f32)).collect();
    assert_eq!(list(row, "measured_ax").unwrap(), expected);
    let about = json(&folder.path().join("out/dataset.json"));
    assert_eq!(about["licence"], "CC0-1.0");
    assert_eq!(about["rate"]["sample_rate_hz"], 25600.0);
    assert_eq!(about["runs"]["complete"], 7);
    let unit = about["columns"]
        .as_array()
        .unwrap()
        .iter()
        .find(|c| c["name"] == "measured_ax")
        .unwrap();
    assert_eq!(unit["unit"], "m/s^2");
}

#[cfg(unix)]
#[test]
fn prop_kill_9_loses_no_finished_run() {
    let folder = folder_with(
        &PLAN
            .replace("runs = 7", "runs = 40")
            .replace("runs_per_file = 3", "runs_per_file = 16"),
    );
    let args = ["dataset", "plan.toml", "-o", "out", "-q", "-j", "2"];
    make(folder.path(), &["-o", "whole", "-q"]).exits(0);
    let out = folder.path().join("out");
    // Runs that are on the disk, in a file or waiting for one.
    let finished = || -> BTreeSet<usize> {
        let names = if out.exists() {
            files(&out)
        } else {
            Vec::new()
        };
        let runs = names.iter().flat_map(|name| {
            let number = |rest: &str, end| rest.strip_suffix(end)?.parse::<usize>().ok();
            let of_file = name
                .strip_prefix("runs/part-")
                .and_then(|rest| number(rest, ".parquet"));
            let one = name
                .split_once("/run-")
                .and_then(|(_, rest)| number(rest, ".row"));
            let file = of_file.map(|k| 16 * k..(16 * k + 16).min(40));
            file.into_iter().flatten().chain(one)
        });
        runs.collect()
    };
    // Killed again and again, each time after some more runs.
    let mut before = BTreeSet::new();
    for wanted in [3, 11, 20] {
        let mut child = command(folder.path(), &args).spawn().unwrap();
        let begin = Instant::now();
        while finished().len() < wanted {
            assert!(
                begin.elapsed() < Duration::from_secs(60),
                "no run is finished"
            );
            std::thread::sleep(Duration::from_millis(2));
        }
        child.kill().unwrap();
        child.wait().unwrap();
        let now = finished();
        assert!(now.is_superset(&before), "{now:?} after {before:?}");
        before = now;
    }
    assert!((20..40).contains(&before.len()), "{}", before.len());
    let left = 40 - before.len();
    make(folder.path(), &["-o", "out"]).exits(0).says(&[
        &format!("{left} runs in"),
        &format!("{} there before", before.len()),
    ]);
    same(&folder.path().join("whole"), &out);
}

#[test]
fn prop_a_row_in_pieces_is_run_again() {
    let folder = folder_with(PLAN);
    make(folder.path(), &["-o", "whole", "-q"]).exits(0);
    // As a machine that lost power may leave it: the name, and not the bytes.
    let spool = folder.path().join("out/work/part-00001");
    fs::create_dir_all(&spool).unwrap();
    fs::write(spool.join("run-0000004.row"), b"brnrow01").unwrap();
    make(folder.path(), &["-o", "out", "-q"]).exits(0);
    same(&folder.path().join("whole"), &folder.path().join("out"));
}

#[test]
fn prop_what_was_changed_after_it_was_written_is_told() {
    let folder = folder_with(PLAN);
    let out = folder.path().join("out");
    make(folder.path(), &["-o", "out", "-q"]).exits(0);
    let sidecar = fs::read_to_string(out.join("dataset.json")).unwrap();
    for (was, is) in [("CC0-1.0", "MIT"), ("\"healthy\"", "\"outer2\"")] {
        fs::write(out.join("dataset.json"), sidecar.replacen(was, is, 1)).unwrap();
        brinell(folder.path(), &["dataset", "verify", "out"])
            .exits(1)
            .complains(&["dataset.json: its checksum is another than when it was written"]);
    }
    fs::write(out.join("dataset.json"), &sidecar).unwrap();
    // The card as well, which its reader may do without; and what is nobody's among the runs.
    let card = fs::read_to_string(out.join("croissant.json")).unwrap();
    fs::write(out.join("croissant.json"), card.replacen("test", "tess", 1)).unwrap();
    fs::write(out.join("runs/notes.txt"), "mine").unwrap();
    brinell(folder.path(), &["dataset", "verify", "out"])
        .exits(1)
        .complains(&[
            "croissant.json: its checksum is another than when it was written",
            "runs/notes.txt: no file of this data set",
        ]);
    fs::remove_file(out.join("croissant.json")).unwrap();
    fs::remove_file(out.join("runs/notes.txt")).unwrap();
    brinell(folder.path(), &["dataset", "verify", "out"])
        .exits(0)
        .says(&["; croissant.json is not here"])
        .keeps_quiet();
    fs::write(out.join("croissant.json"), &card).unwrap();
    // A file that was cut short is found by whoever goes on.
    let file = out.join("runs/part-00001.parquet");
    let whole = fs::read(&file).unwrap();
    fs::write(&file, &whole[..whole.len() / 2]).unwrap();
    make(folder.path(), &["-o", "out"]).exits(2).complains(&[
        "runs/part-00001.parquet: ",
        "one of them is damaged; remove both",
    ]);
    fs::remove_file(&file).unwrap();
    fs::remove_file(out.join("work/part-00001.json")).unwrap();
    make(folder.path(), &["-o", "out", "-q"]).exits(0);
    assert!(fs::read(&file).unwrap() == whole);
    assert_eq!(
        fs::read_to_string(out.join("dataset.json")).unwrap(),
        sidecar
    );
}

#[test]
fn prop_a_failed_run_is_a_row_with_its_reason() {
    // Values that make no scenario, in two runs of six.
    let plan = PLAN.replace("runs = 7", "runs = 6").replace(
        "[vary]",
        "out_of_range = \"fail\"\n[vary]\nlubricant.viscosity_pa_s = { grid = [0.01, -1.0, 0.02] }",
    );
    let folder = folder_with(&plan);
    make(folder.path(), &["-o", "out"])
        .exits(0)
        .says(&[
            "2 of 6 runs looked at draw values that make no scenario: kept as failed",
            "6 runs in",
        ])
        .complains(&[
            "2 of 6 runs, such as run 2: lubricant.viscosity_pa_s = -1.0: out of range; allowed: >= 0 Pa s",
            "failed: lubricant.viscosity_pa_s = -1.0: out of range",
        ]);
    let all: Vec<Row> = (0..2)
        .flat_map(|k| rows(&folder.path().join(format!("out/runs/part-0000{k}.parquet"))))
        .collect();
    let failed: Vec<&Row> = all
        .iter()
        .filter(|row| text(row, "status").as_deref() == Some("failed"))
        .collect();
    assert_eq!(failed.len(), 2);
    for row in failed {
        assert!(text(row, "reason").unwrap().contains("out of range"));
        assert_eq!(cell(row, "lubricant.viscosity_pa_s"), &Field::Double(-1.0));
        assert_eq!(
            (list(row, "measured_ax"), list(row, "entry_t_s")),
            (None, None)
        );
        assert!(text(row, "class").is_some() && text(row, "settings").unwrap().contains("-1.0"));
    }
    brinell(folder.path(), &["dataset", "verify", "out"])
        .exits(0)
        .says(&["6 runs with 2 failed"]);
    // A scenario that is sound, and has nothing to start from.
    let loose = "vary.simulation.start = \"equilibrium\"\nvary.support = { inner_stiffness_n_per_m = 0.0, outer_stiffness_n_per_m = 0.0 }";
    let plan = PLAN.replace("name = \"outer\"", &format!("name = \"outer\"\n{loose}"));
    let folder = folder_with(&plan.replace("runs = 7", "runs = 2"));
    make(folder.path(), &["-o", "out"]).exits(0);
    let row = &rows(&folder.path().join("out/runs/part-00000.parquet"))[1];
    assert_eq!(text(row, "status").as_deref(), Some("failed"));
    let reason = text(row, "reason").unwrap();
    assert!(reason.contains("no static balance") && !reason.contains('\n'));
    assert!(text(row, "scenario").is_some() && list(row, "measured_ax").is_none());
    // Nothing to start from in any run.
    let plan = PLAN.replace("[vary]", &format!("[vary]\n{}", loose.replace("vary.", "")));
    let folder = folder_with(&plan);
    make(folder.path(), &["-o", "out"]).exits(2).complains(&[
        "none of the first runs can begin; run 0: start = \"equilibrium\": no static balance",
    ]);
}

#[test]
fn prop_held_out_labels_lie_apart() {
    let folder = folder_with(&PLAN.replace(
        "runs = 7",
        &format!("runs = 12\nheld_out = 0.5\nsecret = \"{SECRET}\""),
    ));
    make(folder.path(), &["-o", "out"])
        .exits(0)
        .says(&["labels of "]);
    let out = folder.path().join("out");
    let secret = ["class", "label", "settings", "scenario", "reason"];
    let mut apart = 0;
    let about = json(&out.join("dataset.json"));
    let parts = about["files"].as_array().unwrap();
    for (part, file) in parts.iter().enumerate() {
        let open = rows(&out.join(format!("runs/part-0000{part}.parquet")));
        let labels = out.join(format!("held_out/part-0000{part}.parquet"));
        // Runs of a file are for one thing.
        assert_eq!(labels.exists(), file["split"] == "held-out");
        assert!(
            open.iter()
                .all(|row| text(row, "split").as_deref() == file["split"].as_str())
        );
        let held = if labels.exists() {
            rows(&labels)
        } else {
            Vec::new()
        };
        let mut held = held.iter();
        for row in &open {
            let is_held = text(row, "split").as_deref() == Some("held-out");
            for name in secret {
                assert!(!is_held || cell(row, name) == &Field::Null, "{name} shows");
            }
            for name in [
                "entry_t_s",
                "defect_on",
                "largest_contact_force_n",
                "defects.0.depth_um",
                "solver_steps",
            ] {
                assert!(!is_held || cell(row, name) == &Field::Null, "{name} shows");
            }
            // What a sensor knows stays.
            assert_eq!(list(row, "measured_ax").unwrap().len(), 512);
            assert!(matches!(cell(row, "operation.speed_rpm"), Field::Double(_)));
            assert!(matches!(cell(row, "bpfo_hz"), Field::Double(_)));
            if is_held {
                let label = held.next().unwrap();
                assert_eq!(cell(label, "run"), cell(row, "run"));
                assert!(text(label, "class").is_some() && list(label, "entry_t_s").is_some());
                apart += 1;
            }
        }
        assert!(held.next().is_none());
    }
    assert!((1..12).contains(&apart), "{apart}");
    let sidecar = fs::read_to_string(out.join("dataset.json")).unwrap();
    // Nor does anything else that is published give them away: plan and secret would.
    for name in files(&out)
        .iter()
        .filter(|name| !name.starts_with("held_out") && !name.starts_with("work"))
    {
        let bytes = fs::read(out.join(name)).unwrap();
        let has = |words: &str| bytes.windows(words.len()).any(|w| w == words.as_bytes());
        assert!(
            !has(SECRET) && !has("depth_um = {") && !has("\"seed\""),
            "{name}"
        );
    }
    assert!(
        fs::read_to_string(out.join("held_out/_plan.json"))
            .unwrap()
            .contains("\"seed\": 11")
    );
    // How many bytes the labels take would tell too: a damaged run has more.
    assert!(
        about["held_out"].get("files").is_none(),
        "{}",
        about["held_out"]
    );
    for (part, file) in parts.iter().enumerate() {
        if file["split"] == "held-out" {
            let labels = fs::read(out.join(format!("held_out/part-0000{part}.parquet"))).unwrap();
            assert!(!sidecar.contains(&format!(" {}", labels.len())), "{part}");
        }
    }
    // The classes' numbers are those of the runs whose labels anybody sees.
    let classes = json(&out.join("dataset.json"))["classes"].clone();
    let counted = classes
        .as_array()
        .unwrap()
        .iter()
        .map(|c| c["open_runs"].as_u64().unwrap());
    assert_eq!(counted.sum::<u64>(), 12 - apart);
    brinell(folder.path(), &["dataset", "verify", "out"]).exits(0);
    // What the labels are made from is checked as well; and one file of labels may not be missing where others are here.
    let secret = fs::read(out.join("held_out/_plan.json")).unwrap();
    fs::write(out.join("held_out/_plan.json"), "").unwrap();
    brinell(folder.path(), &["dataset", "verify", "out"])
        .exits(1)
        .complains(&["held_out/_plan.json: its checksum is another than when it was written"]);
    fs::write(out.join("held_out/_plan.json"), secret).unwrap();
    let last = format!("held_out/part-0000{}.parquet", parts.len() - 1);
    fs::remove_file(out.join(&last)).unwrap();
    brinell(folder.path(), &["dataset", "verify", "out"])
        .exits(1)
        .complains(&[&format!("{last} is missing, and others are here")]);
    // All labels may be elsewhere.
    fs::remove_dir_all(out.join("held_out")).unwrap();
    brinell(folder.path(), &["dataset", "verify", "out"])
        .exits(0)
        .says(&["; labels are not here"]);
}

#[test]
fn regress_distributions_that_leave_a_range_are_refused_with_how_often() {
    let plan = PLAN
        .replace(
            "[vary]",
            "[vary]\nlubricant.viscosity_pa_s = { grid = [0.01, -1.0, 0.02] }",
        )
        .replace("runs = 7", "runs = 6");
    let folder = folder_with(&plan);
    make(folder.path(), &["-o", "out"]).exits(2).complains(&[
        "lubricant.viscosity_pa_s = -1.0: out of range (in 2 of 6 runs, such as run 2)",
        "out_of_range = \"redraw\"",
        "allowed: >= 0 Pa s",
        "plan.toml:9:",
        "grid = [0.01, -1.0, 0.02]",
    ]);
    assert!(!folder.path().join("out").exists());
    // The first run may be one of those.
    let folder = folder_with(&plan.replace("[0.01, -1.0, 0.02]", "[-1.0, 0.01, 0.02]"));
    make(folder.path(), &["-o", "out"]).exits(2).complains(&[
        "lubricant.viscosity_pa_s = -1.0: out of range (in 2 of 6 runs, such as run 0)",
        "plan.toml:9:",
    ]);
    // All of them.
    let folder = folder_with(&plan.replace("{ grid = [0.01, -1.0, 0.02] }", "-1.0"));
    make(folder.path(), &["-o", "out"]).exits(2).complains(&[
        "lubricant.viscosity_pa_s = -1.0: out of range (in 6 of 6 runs, such as run 0)\n  allowed: >= 0 Pa s\n",
        "plan.toml:9:",
    ]);
    // A grid is not drawn again: the plan is impossible.
    let folder = folder_with(&plan.replace("[vary]", "out_of_range = \"redraw\"\n[vary]"));
    make(folder.path(), &["-o", "out"])
        .exits(2)
        .complains(&["1000 further draws did not fit either"]);
}

#[test]
fn regress_bad_input_is_told() {
    for (from, to, parts) in [
        (
            "speed_rpm",
            "sped_rpm",
            vec![
                "operation.sped_rpm",
                "did you mean `speed_rpm`?",
                "plan.toml:9:",
            ],
        ),
        (
            "base.toml",
            "no.toml",
            vec!["base = \"no.toml\": cannot read no.toml", "plan.toml:2:"],
        ),
        (
            "runs = 7",
            "runs = 7\nsignals = [\"outer_zz\"]",
            vec![
                "signals = \"outer_zz\": no channel of the first runs has such a name",
                "plan.toml:4:",
            ],
        ),
        (
            "runs = 7",
            "runs = 7\nsignals = [\"measured_ax\", \"outer_zz\"]",
            vec!["signals = \"outer_zz\": no channel of the first runs has such a name"],
        ),
        (
            "uniform = [1400",
            "unifrom = [1400",
            vec![
                "operation.speed_rpm.unifrom = ",
                "allowed: a value, or { uniform | log | normal | whole | choice | grid = ... }",
                "plan.toml:9:",
            ],
        ),
        (
            "uniform = [1400, 1600]",
            "uniform = [1400]",
            vec![
                "vary.operation.speed_rpm = { uniform = [1400] }: expected two numbers, found 1 of them",
            ],
        ),
        (
            "\"outer-raceway\"",
            "\"outer\"",
            vec![
                "defects.0.on = \"outer\": unknown word; did you mean \"outer-raceway\"? (in 3 of 7 runs, such as run 1)",
                "plan.toml:18:",
            ],
        ),
        (
            "uniform = [1400, 1600]",
            "uniform = [1600, 1400]",
            vec!["the ends are reversed", "plan.toml:9:"],
        ),
        (
            "seed = 11",
            "seed = -1",
            vec!["seed = -1: out of range", "plan.toml:4:"],
        ),
    ] {
        let folder = folder_with(&PLAN.replacen(from, to, 1));
        make(folder.path(), &["-o", "out"])
            .exits(2)
            .complains(&parts);
        assert!(!folder.path().join("out").exists());
    }
    let folder = folder_with(PLAN);
    for (args, part) in [
        (vec!["--shard", "0/4"], "shards count from 1: 1/4 to 4/4"),
        (vec!["--shard", "5/4"], "expected I/N"),
    ] {
        make(folder.path(), &args).exits(2).complains(&[part]);
    }
    brinell(folder.path(), &["dataset", "verify", "."])
        .exits(2)
        .complains(&["no data set is here"]);
    brinell(folder.path(), &["dataset", "merge", ".", "-o", "x"])
        .exits(2)
        .complains(&["no data set is here"]);
    assert!(!folder.path().join("x").exists());
}

#[test]
fn regress_another_campaign_another_version_and_damage_are_found() {
    let folder = folder_with(PLAN);
    let at = |name: &str| folder.path().join(name);
    make(folder.path(), &["-o", "out", "-q"]).exits(0);
    // Comments and order are no other campaign, another seed is.
    fs::write(at("plan.toml"), format!("# a comment\n{PLAN}")).unwrap();
    make(folder.path(), &["-o", "out", "-q"])
        .exits(0)
        .keeps_quiet();
    fs::write(at("plan.toml"), PLAN.replace("seed = 11", "seed = 12")).unwrap();
    let before = contents(&at("out"));
    make(folder.path(), &["-o", "out"])
        .exits(2)
        .complains(&["out holds another campaign, \"test\" with 7 runs"]);
    make(folder.path(), &["-o", "other", "-q"]).exits(0);
    brinell(
        folder.path(),
        &["dataset", "merge", "out", "other", "-o", "x"],
    )
    .exits(2)
    .complains(&["other holds another campaign"]);
    // The same where the folder has nothing but the files.
    fs::rename(at("out/work"), at("work")).unwrap();
    make(folder.path(), &["-o", "out"])
        .exits(2)
        .complains(&["out holds another campaign"]);
    fs::remove_dir_all(at("out/work")).unwrap();
    fs::rename(at("work"), at("out/work")).unwrap();
    assert!(before == contents(&at("out")));
    fs::write(at("plan.toml"), PLAN).unwrap();

    // Another version.
    let mine = at("out/work/campaign.json");
    let text = fs::read_to_string(&mine).unwrap();
    let version = env!("CARGO_PKG_VERSION");
    fs::write(
        &mine,
        text.replace(
            &format!("\"brinell\": \"{version}\""),
            "\"brinell\": \"0.0.9\"",
        ),
    )
    .unwrap();
    make(folder.path(), &["-o", "out"]).exits(2).complains(&[
        "out holds runs of brinell 0.0.9, and this is ",
        "one data set has one version",
    ]);
    brinell(folder.path(), &["dataset", "verify", "out"])
        .exits(1)
        .complains(&["runs/part-00000.parquet: of brinell"]);
    fs::write(&mine, &text).unwrap();
    brinell(folder.path(), &["dataset", "verify", "out"]).exits(0);

    // A file of the other campaign among these, a damaged one, one too many, one missing.
    let part = |k: usize| at("out").join(format!("runs/part-0000{k}.parquet"));
    assert_eq!(record_facts(part(0)).unwrap().rows, 3);
    fs::copy(at("other/runs/part-00001.parquet"), part(1)).unwrap();
    let mut bytes = fs::read(part(2)).unwrap();
    bytes[100] ^= 1;
    fs::write(part(2), &bytes).unwrap();
    fs::copy(part(0), part(7)).unwrap();
    fs::remove_file(part(0)).unwrap();
    brinell(folder.path(), &["dataset", "verify", "out"])
        .exits(1)
        .complains(&[
            "runs/part-00000.parquet is missing",
            "runs/part-00001.parquet: of another campaign",
            "runs/part-00002.parquet: its checksum is another than when it was written",
            "runs/part-00007.parquet: no file of this data set",
        ]);
}

#[test]
fn regress_a_dry_run_tells_and_writes_nothing() {
    let folder = folder_with(PLAN);
    make(folder.path(), &["--dry-run", "--shard", "1/2"])
        .exits(0)
        .says(&[
            "0 healthy: 4 runs",
            "1 outer: 3 runs",
            "varies: operation.speed_rpm, defects.0.depth_um, defects.0.shape.random.length_mm",
            "signals: measured_ax, measured_ay",
            "4 runs of this shard: 0.0800 s simulated",
        ]);
    assert_eq!(files(folder.path()), ["base.toml", "plan.toml"]);
}
