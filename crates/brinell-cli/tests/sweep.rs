//! Sweeps: the plan, what a killed one costs, that neither threads nor interruptions change a byte, and what happens to
//! bad points.

use crate::common::{
    Call, brinell, command, cut_journal, files, interrupted, json, lines, results, same, typed, with_blocks,
};
use brinell_io::{Cell, open, read_records};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

fn folder() -> TempDir {
    with_blocks("base.toml")
}

const GRID: [&str; 6] =
    ["sweep", "base.toml", "--vary", "operation.speed_rpm=2900,3100", "--vary", "simulation.model=lumped,full"];

fn with<'a>(more: &[&'a str]) -> Vec<&'a str> {
    GRID.iter().chain(more).copied().collect()
}

/// Cells of RFC 4180.
fn csv(path: &Path) -> Vec<Vec<String>> {
    let text = fs::read_to_string(path).unwrap();
    let (mut rows, mut row, mut cell) = (vec![], vec![], String::new());
    let (mut quoted, mut letters) = (false, text.chars().peekable());
    while let Some(c) = letters.next() {
        match c {
            '"' if quoted && letters.peek() == Some(&'"') => {
                letters.next();
                cell.push('"');
            }
            '"' => quoted = !quoted,
            ',' if !quoted => row.push(std::mem::take(&mut cell)),
            '\n' if !quoted => {
                row.push(std::mem::take(&mut cell));
                rows.push(std::mem::take(&mut row));
            }
            c => cell.push(c),
        }
    }
    assert!(row.is_empty() && cell.is_empty(), "the last line is whole");
    rows
}

#[test]
fn prop_what_check_warns_of_is_said_of_the_points_and_on_the_page() {
    let folder = folder();
    let vary = ["sweep", "base.toml", "--vary", "defects.0.center_deg=0,150,180", "-o", "out"];
    let call = |more: &[&str]| brinell(folder.path(), &[&vary, more].concat()).exits(0);
    let parts = [
        "warning: defects.0.center_deg = 150.0 (defect 1): this damage is outside the load zone",
        "(in 2 of 3 points looked at, the first of them point 2)",
    ];
    call(&["--dry-run"]).complains(&parts);
    assert!(!folder.path().join("out").exists());
    call(&[]).complains(&parts);
    let warnings = json(&folder.path().join("out/sweep.json"))["warnings"].clone();
    let page = fs::read_to_string(folder.path().join("out/sweep.html")).unwrap();
    assert!(!page.contains(parts[0]), "the box says that it is a warning");
    for part in parts {
        let shown = part.trim_start_matches("warning: ");
        assert!(warnings[0].as_str().unwrap().contains(part) && page.contains(shown), "{part}");
    }
}

#[test]
fn prop_what_runs_warn_of_is_said_once_with_its_points_and_after_a_resumption_too() {
    let folder = folder();
    let args = typed("sweep base.toml --vary simulation.sample_rate_hz=25600,51200 -o out");
    let told =
        ["parametric work: ", "are of different bandwidths", "(in 2 of 2 points looked at, the first of them point 1)"];
    // The second call runs nothing.
    for _ in 0..2 {
        let call = brinell(folder.path(), &args).exits(0);
        let page = fs::read_to_string(folder.path().join("out/sweep.html")).unwrap();
        let json = json(&folder.path().join("out/sweep.json"))["warnings"].to_string();
        for words in told {
            for text in [&call.err, &page, &json] {
                assert_eq!(text.matches(words).count(), 1, "{words}: {}{json}", call.err);
            }
        }
    }
}

#[test]
fn prop_neither_threads_nor_a_cut_journal_change_a_byte() {
    let folder = folder();
    let out = |name: &str| folder.path().join(name);
    brinell(folder.path(), &with(&["-o", "one", "--jobs", "1"]))
        .exits(0)
        .says(&[
            "4 points: operation.speed_rpm (2) x simulation.model (2)",
            "4 runs to do: 0.720 s simulated, 1 at a time, about",
            "4 of 4 points complete",
        ])
        .complains(&["(in 4 of 4 points looked at, the first of them point 1)"]);
    brinell(folder.path(), &with(&["-o", "two", "--jobs", "2", "-q"])).exits(0).keeps_quiet();
    same(&out("one"), &out("two"));
    assert_eq!(
        results(&out("one")).into_iter().map(|f| f.0).collect::<Vec<_>>(),
        ["sweep.csv", "sweep.html", "sweep.json", "sweep.parquet"]
    );

    // The header and two points are whole, the third was being written.
    assert_eq!(lines(&out("two").join("journal.jsonl")), 5);
    cut_journal(&out("two"), 3, &out("cut"));
    brinell(folder.path(), &with(&["-o", "cut"]))
        .exits(0)
        .says(&["2 points finished before", "2 runs to do", "4 of 4 points complete"])
        .complains(&["parametric work", "(in 4 of 4 points looked at, the first of them point 1)"]);
    same(&out("one"), &out("cut"));

    // Once more: nothing is left to do.
    brinell(folder.path(), &with(&["-o", "cut"])).exits(0).says(&["4 points finished before", "0 runs in"]);
    same(&out("one"), &out("cut"));
}

#[test]
fn prop_csv_and_parquet_hold_the_same_table() {
    let folder = folder();
    brinell(folder.path(), &with(&["-o", "out", "-q"])).exits(0);
    let out = folder.path().join("out");
    let rows = csv(&out.join("sweep.csv"));
    let names: Vec<&str> = rows[0].iter().map(String::as_str).collect();
    assert_eq!(names[..5], ["point", "operation.speed_rpm", "simulation.model", "status", "reason"]);
    let table = read_records(out.join("sweep.parquet"), &names, |_| true).unwrap();
    assert_eq!((rows.len(), table.len()), (5, 4));
    for (texts, cells) in rows[1..].iter().zip(&table) {
        for (text, cell) in texts.iter().zip(cells) {
            match cell {
                Cell::Number(x) => assert_eq!(text.parse::<f64>().unwrap().to_bits(), x.to_bits()),
                Cell::Words(words) => assert_eq!(text, words),
                empty => assert!(text.is_empty() && *empty == Cell::Empty, "{text} {empty:?}"),
            }
        }
    }
    let cell = |row: usize, name: &str| {
        let k = names.iter().position(|n| *n == name);
        rows[row][k.unwrap_or_else(|| panic!("no column {name}"))].clone()
    };
    assert_eq!(cell(1, "operation.speed_rpm"), "2900.0");
    assert_eq!(cell(2, "simulation.model"), "full");
    for row in 1..=4 {
        assert_eq!(cell(row, "status"), "complete");
        let number = |name: &str| cell(row, name).parse::<f64>().unwrap();
        assert!(number("sensor_ax.rms.low") < number("sensor_ax.rms.high"));
        assert!(number("sensor_ax.peak_to_peak") > number("sensor_ax.rms"));
        // 2 of 8.8 mm lie bare in the rectangle of 4 mm: the rest of the line carries.
        assert!((number("defect1.least_contact_length") - 4.8e-3).abs() < 1e-12);
        assert!(number("work.steps") > 0.0);
    }
    let bpfo = json(&out.join("sweep.json"))["units"]["envelope.bpfo"].clone();
    assert_eq!(bpfo, "m/s^2");
}

#[test]
fn regress_a_bad_point_is_a_row_and_the_others_run() {
    let folder = folder();
    let args = typed("sweep base.toml --vary defects.0.depth_um=10,-1,20 --set simulation.model=lumped -o out");
    brinell(folder.path(), &args)
        .exits(1)
        .says(&["3 points", "1 point with a bad scenario", "2 of 3 points complete"])
        .complains(&["point 2 failed (defects.0.depth_um=-1): ", "allowed: ", "1 of 3 points failed"]);
    let rows = csv(&folder.path().join("out/sweep.csv"));
    let column = |name: &str| rows[0].iter().position(|n| n == name).unwrap();
    let status: Vec<&str> = rows[1..].iter().map(|r| r[column("status")].as_str()).collect();
    assert_eq!(status, ["complete", "failed", "complete"]);
    assert!(rows[2][column("reason")].contains("defects.0.depth_um = -1"));
    assert_eq!(rows[2][column("sensor_ax.rms")], "");
    // Names may break after their points on a phone.
    let page = fs::read_to_string(folder.path().join("out/sweep.html")).unwrap().replace("<wbr>", "");
    assert!(page.contains("Points that failed") && page.contains("2: defects.0.depth_um = -1"));
    // What is said of the plots.
    assert!(page.contains("class=\"lead\">RMS of sensor_ax: from ") && page.contains("Crosses on the axis: no value."));
}

#[test]
fn regress_what_no_point_can_run_with_is_bad_input() {
    let folder = folder();
    let call = |more: &[&str]| {
        let args: Vec<&str> = ["sweep", "base.toml"].iter().chain(more).copied().collect();
        brinell(folder.path(), &args).exits(2)
    };
    call(&[]).complains(&["nothing varies: give --vary KEY=VALUES"]);
    call(&["--vary", "operation.speed_rmp=1,2"]).complains(&["operation.speed_rmp", "speed_rpm"]);
    call(&["--vary", "operation.speed_rpm=1000:500:100"]).complains(&[
        "--vary: operation.speed_rpm = 1000:500:100: the range's step leads away from its end; a step of -100 would reach it",
    ]);
    let depths = ["--vary", "defects.0.depth_um=10,20", "--set"];
    call(&[&depths[..], &["defects.0.depth_um=5"]].concat())
        .complains(&["--set defects.0.depth_um=5: every point gives defects.0.depth_um another value"]);
    call(&["--vary", "operation={speed_rpm=900},{speed_rpm=950}", "--set", "operation.speed_rpm=1000"])
        .complains(&["--set operation.speed_rpm=1000: every point gives operation another value"]);
    call(&["--vary", "bearing.radial_clearance_um=5,10", "--plot", "sensor_ax.rsm"])
        .complains(&["--plot sensor_ax.rsm: no such number"]);
    assert!(!folder.path().join("out").exists());
}

#[test]
fn regress_another_sweep_is_refused_unless_extended() {
    let folder = folder();
    let sweep = |values: &str, more: &[&str]| {
        let vary = format!("operation.speed_rpm={values}");
        let mut args = vec!["sweep", "base.toml", "--vary", &vary, "-o", "out"];
        args.extend(["--set", "simulation.model=lumped"]);
        args.extend(more);
        brinell(folder.path(), &args)
    };
    sweep("2900,3000", &[]).exits(0);
    let before = results(&folder.path().join("out"));
    sweep("2900,3000,3100", &[]).exits(2).complains(&[
        "out holds another sweep, of operation.speed_rpm (2), or of another base scenario; choose another folder",
        "--extend",
    ]);
    assert!(before == results(&folder.path().join("out")), "nothing is touched");
    sweep("2900,3000,3100", &["--extend"]).exits(0).says(&[
        "2 points finished before",
        "1 run to do",
        "3 of 3 points complete",
    ]);
    // The extended one is now the folder's.
    sweep("2900,3000,3100", &[]).exits(0).says(&["3 points finished before"]);
    // A damaged line: what is to be done is said, and does it.
    let journal = folder.path().join("out/journal.jsonl");
    let sound = fs::read_to_string(&journal).unwrap();
    let mut lines: Vec<&str> = sound.lines().collect();
    lines[1] = "{\"point\":";
    fs::write(&journal, lines.join("\n") + "\n").unwrap();
    let cure = "remove the line, and what it holds is made again";
    sweep("2900,3000,3100", &[]).exits(2).complains(&["journal.jsonl: line 2 is no line of a journal", cure]);
    lines.remove(1);
    fs::write(&journal, lines.join("\n") + "\n").unwrap();
    sweep("2900,3000,3100", &[]).exits(0).says(&["2 points finished before"]);
    fs::write(&journal, sound).unwrap();
    // Another base, the same plan.
    sweep("2900,3000,3100", &["--set", "defects.0.depth_um=5"]).exits(2).complains(&["another base scenario"]);
    // A journal of something else.
    fs::write(&journal, "{\"campaign\":\"calibration\"}\n").unwrap();
    sweep("2900,3000,3100", &["--extend"])
        .exits(2)
        .complains(&["is the journal of calibration; choose another folder"]);
    fs::write(&journal, "[1]\n").unwrap();
    sweep("2900,3000,3100", &[]).exits(2).complains(&["is the journal of something else"]);
}

#[test]
fn prop_a_sweep_has_one_kernel() {
    let folder = folder();
    let sweep = |kernel: &str, values: &str, more: &[&str]| -> Call {
        let vary = format!("operation.speed_rpm={values}");
        let args = ["sweep", "base.toml", "--vary", &vary, "-o", "out", "--set", "simulation.model=lumped"];
        let mut command = command(folder.path(), &[&args, more].concat());
        command.env("BRINELL_KERNEL", kernel).output().unwrap().into()
    };
    sweep("portable", "2900,3000", &[]).exits(0);
    assert_eq!(json(&folder.path().join("out/sweep.json"))["made_by"]["kernel"], "portable");
    let before = fs::read(folder.path().join("out/journal.jsonl")).unwrap();
    for (values, more) in
        [("2900,3000", &[][..]), ("2900,3000,3100", &["--extend"]), ("2900,3000,3100", &["--extend", "--dry-run"])]
    {
        sweep("plain", values, more).exits(2).complains(&[
            "out: the folder holds runs of the kernel portable, and these are of plain: runs differ wholly between kernels",
            "so one sweep has one kernel; set BRINELL_KERNEL=portable",
        ]);
    }
    assert!(before == fs::read(folder.path().join("out/journal.jsonl")).unwrap(), "nothing is touched");
    sweep("portable", "2900,3000,3100", &["--extend"]).exits(0).says(&["2 points finished before"]);
    // Of a journal without points any kernel may go on.
    cut_journal(&folder.path().join("out"), 1, &folder.path().join("cut"));
    fs::remove_dir_all(folder.path().join("out")).unwrap();
    fs::rename(folder.path().join("cut"), folder.path().join("out")).unwrap();
    sweep("plain", "2900,3000", &[]).exits(0).says(&["2 runs to do"]);
    sweep("portable", "2900,3000", &[]).exits(2).complains(&["of the kernel plain"]);
}

#[test]
fn prop_values_with_a_unit_are_numbers_of_the_keys_unit() {
    let folder = folder();
    let args = ["sweep", "base.toml", "--vary", "operation.speed_rpm=50 Hz,3100,'55 Hz'", "-o", "out"];
    brinell(folder.path(), &[&args[..], &["--set", "simulation.model=lumped", "-q"]].concat()).exits(0);
    let rows = csv(&folder.path().join("out/sweep.csv"));
    assert_eq!([&rows[1][1], &rows[2][1], &rows[3][1]], ["3000.0", "3100.0", "3300.0"]);
    let table = open(folder.path().join("out/sweep.parquet")).unwrap();
    let speed = table.channels().iter().find(|c| c.name == "operation.speed_rpm").unwrap();
    assert_eq!(speed.unit.as_deref(), Some("r/min"));
    let args = ["sweep", "base.toml", "--vary", "operation.speed_rpm=50 Hz,3000"];
    brinell(folder.path(), &args).exits(2).complains(&["operation.speed_rpm = 3000: comes twice"]);
    let args = ["sweep", "base.toml", "--vary", "operation.speed_rpm=50 Hz,20 mm", "--dry-run"];
    brinell(folder.path(), &args)
        .exits(0)
        .says(&["1 point with a bad scenario"])
        .complains(&["point 2 (operation.speed_rpm=20 mm): ", "does not convert to r/min"]);
}

#[test]
fn regress_points_of_another_version_are_run_again() {
    let folder = folder();
    let args = typed("sweep base.toml --vary operation.speed_rpm=2900,3000 --set simulation.model=lumped -o out");
    brinell(folder.path(), &args).exits(0);
    let journal = folder.path().join("out/journal.jsonl");
    let text = fs::read_to_string(&journal).unwrap();
    let mine = format!("\"brinell\":\"{}\"", env!("CARGO_PKG_VERSION"));
    let older = text.replacen(&mine, "\"brinell\":\"0.0.1\"", 1);
    assert_ne!(text, older);
    fs::write(&journal, older).unwrap();
    brinell(folder.path(), &args).exits(0).says(&[
        "1 point finished before",
        "1 run to do",
        "1 finished point of another version",
    ]);
}

#[test]
fn regress_signals_are_kept_on_request_and_a_dry_run_leaves_nothing() {
    let folder = folder();
    let args = |more: &[&'static str]| {
        let mut args = vec!["sweep", "base.toml", "--together"];
        args.push("operation.speed_rpm=2900,3000; operation.load_n=[300,0],[0,400]");
        args.extend(["--set", "simulation.model=lumped", "-o", "out"]);
        args.extend(more);
        args
    };
    brinell(folder.path(), &args(&["--dry-run"]))
        .exits(0)
        .says(&["2 points: operation.speed_rpm with operation.load_n (2)", "2 runs to do"]);
    assert!(!folder.path().join("out").exists());
    brinell(folder.path(), &args(&["--plots", "svg"])).exits(0);
    let out = folder.path().join("out");
    assert!(files(&out).contains(&"plots/sensor_ax.rms.svg".to_owned()));
    assert!(!out.join("signals").exists());
    let journal = fs::read(out.join("journal.jsonl")).unwrap();
    brinell(folder.path(), &args(&["--dry-run"])).exits(0).says(&["2 points finished before"]);
    assert!(journal == fs::read(out.join("journal.jsonl")).unwrap());
    // Signals were not kept: requested now, the points run again.
    brinell(folder.path(), &args(&["--keep-signals"])).exits(0).says(&["2 runs to do"]);
    let names = read_records(out.join("sweep.parquet"), &["signals"], |_| true).unwrap();
    let words = |row: &Vec<Cell>| match &row[..] {
        [Cell::Words(name)] => name.clone(),
        other => panic!("{other:?}"),
    };
    let names: Vec<String> = names.iter().map(words).collect();
    for name in &names {
        let mut signals = brinell_io::open(out.join(name)).unwrap();
        assert_eq!(signals.read("sensor_ax").unwrap().len(), 4609);
    }
    assert_eq!(names.len(), 2);
    brinell(folder.path(), &args(&["--keep-signals"])).exits(0).says(&["2 points finished before"]);
    // Signals that the sweep did not write are not written over.
    let signals = out.join(&names[0]);
    fs::write(&signals, "mine").unwrap();
    brinell(folder.path(), &args(&["--keep-signals"])).exits(2).complains(&["no sweep wrote it", "signals/", "-o"]);
    assert_eq!(fs::read(&signals).unwrap(), b"mine");
}

#[cfg(unix)]
#[test]
fn regress_ctrl_c_keeps_what_is_finished_and_the_same_command_goes_on() {
    let folder = folder();
    let args =
        typed("sweep base.toml --vary operation.speed_rpm=2000:3000:10 --set simulation.model=lumped -o out -j 1");
    let journal = folder.path().join("out/journal.jsonl");
    let call = interrupted(folder.path(), &args, &journal, 3);
    call.exits(1).complains(&["interrupted: ", "to go; the same command resumes where this one stopped"]);
    let done = lines(&journal) - 1;
    assert!((2..101).contains(&done));
    let rows = csv(&folder.path().join("out/sweep.csv"));
    assert_eq!(rows.len(), 102);
    let status = rows[0].iter().position(|n| n == "status").unwrap();
    assert_eq!(rows.iter().filter(|r| r[status] == "complete").count(), done);
    let page = fs::read_to_string(folder.path().join("out/sweep.html")).unwrap();
    assert!(page.contains("This sweep is incomplete."));
}
