//! What a row says of its run, and where held-out labels lie.

use super::{
    PLAN, SECRET, brinell, cell, files, folder_with, is_hidden, json, list, make, parsed, rows, rows_of, text,
};
use brinell_study::dataset::sheet;
use parquet::record::{Field, Row};
use std::fs;

#[test]
fn prop_a_row_is_the_run_that_its_scenario_gives() {
    let folder = folder_with(PLAN);
    make(folder.path(), &["-o", "out", "-q"]).exits(0);
    let all: Vec<Row> =
        (0..3).flat_map(|k| rows(&folder.path().join(format!("out/runs/part-0000{k}.parquet")))).collect();
    for (run, row) in all.iter().enumerate() {
        assert_eq!(cell(row, "run"), &Field::Long(run as i64));
        let outer = run % 2 == 1;
        assert_eq!(text(row, "class").as_deref(), Some(if outer { "outer" } else { "healthy" }));
        assert_eq!(list(row, "defect_depth_um").unwrap().len(), usize::from(outer));
        let entries = list(row, "entry_t_s").unwrap();
        assert_eq!(entries.is_empty(), !outer, "{run}");
        assert!(entries.is_sorted() && entries.iter().all(|t| (0.0..0.03).contains(t)));
        assert_eq!(list(row, "entry_force_n").unwrap().len(), entries.len());
        // The first roller is on the damage at the start, and leaves it without an entry.
        let exits = list(row, "exit_t_s").unwrap();
        assert!(!outer || exits[0] < entries[0], "{run}: {exits:?} {entries:?}");
    }
    // The row's own scenario, run by itself, gives the same signal.
    let row = &all[3];
    let printed = brinell(folder.path(), &["dataset", "scenario", "out", "3"]).exits(0).keeps_quiet().out;
    assert_eq!(printed.trim_end(), text(row, "scenario").unwrap().trim_end());
    let none = brinell(folder.path(), &["dataset", "scenario", "out", "7"]).exits(2);
    none.complains(&["out: no run 7; it has 7 runs, numbered from 0"]);
    fs::write(folder.path().join("again.toml"), printed).unwrap();
    brinell(folder.path(), &["run", "again.toml", "-o", "again", "--no-report", "-q"]).exits(0);
    let mut again = brinell_io::open(folder.path().join("again/signals.parquet")).unwrap();
    let whole = again.read("sensor_ax").unwrap();
    // All but the sample at the run's end: 0.02 s at 25.6 kHz are 512.
    assert_eq!(whole.len(), 513);
    let expected: Vec<f64> = whole[..512].iter().map(|x| f64::from(*x as f32)).collect();
    assert_eq!(list(row, "sensor_ax").unwrap(), expected);
    // And warns of the same.
    let Field::ListInternal(warnings) = cell(row, "warnings") else { panic!("no list") };
    let warnings = warnings.elements().iter().map(|words| match words {
        Field::Str(words) => words.as_str(),
        other => panic!("{other}"),
    });
    let warnings: Vec<&str> = warnings.collect();
    assert!(!warnings.is_empty());
    assert_eq!(json(&folder.path().join("again/summary.json"))["warnings"], serde_json::json!(warnings));
    let about = json(&folder.path().join("out/dataset.json"));
    assert_eq!(about["licence"], "CC0-1.0");
    assert_eq!(about["rate"]["sample_rate_hz"], 25600.0);
    assert_eq!(about["runs"]["complete"], 7);
    let unit = about["columns"].as_array().unwrap().iter().find(|c| c["name"] == "sensor_ax").unwrap();
    assert_eq!(unit["unit"], "m/s^2");
}

#[test]
fn prop_beside_the_signals_nothing_but_the_label_tells_the_label() {
    let folder = folder_with(PLAN);
    make(folder.path(), &["-o", "out", "-q"]).exits(0);
    let out = folder.path().join("out");
    let names = |path: &str| -> Vec<String> {
        rows_of(&out.join(path))[0].get_column_iter().map(|(name, _)| name.clone()).collect()
    };
    let known = "run split status sensor_ax sensor_ay sample_rate_hz duration_s analysed_from_s bearing rows rollers_per_row speed_rpm load_n \
                 ftf_hz bpfo_hz bpfi_hz bsf_hz operation.speed_rpm class label reason";
    assert_eq!(names("runs/part-00000.parquet"), known.split_whitespace().collect::<Vec<_>>());
    let truth = names("truth/part-00000.parquet");
    assert_eq!(truth[0], "run");
    for name in ["warnings", "audit_energy_parametric_j", "defects.0.depth_um", "defect_on", "entry_t_s", "scenario"] {
        assert!(truth.iter().any(|column| column == name), "{name}");
    }
    let about = json(&out.join("dataset.json"));
    for (table, file) in [("runs", "runs/part-00000.parquet"), ("truth", "truth/part-00000.parquet")] {
        let columns = about["columns"].as_array().unwrap().iter().filter(|c| c["table"] == table || c["name"] == "run");
        let columns: Vec<&str> = columns.map(|c| c["name"].as_str().unwrap()).collect();
        assert_eq!(columns, names(file), "{table}");
    }
    // What may lie elsewhere may do so as a whole, and a file of it is checked as others are.
    let part = out.join("truth/part-00001.parquet");
    let bytes = fs::read(&part).unwrap();
    fs::write(&part, [&bytes[..bytes.len() - 1], b"?"].concat()).unwrap();
    brinell(folder.path(), &["dataset", "verify", "out"])
        .exits(1)
        .complains(&["truth/part-00001.parquet: its checksum is another than when it was written"]);
    fs::remove_file(&part).unwrap();
    brinell(folder.path(), &["dataset", "verify", "out"]).exits(1).complains(&[
        "truth/part-00001.parquet is missing, and others are here: remove the file of that name in runs/",
    ]);
    fs::remove_dir_all(out.join("truth")).unwrap();
    brinell(folder.path(), &["dataset", "verify", "out"]).exits(0).says(&["truth/ is not here"]);
    // And the sheet does without.
    brinell(folder.path(), &["dataset", "sheet", "out", "-q"]).exits(0);
}

#[test]
fn prop_the_card_says_how_hard_the_runs_are_to_tell_apart() {
    let plan = PLAN
        .replace("runs = 7", "runs = 24")
        .replace("[vary]", "[vary]\nsimulation.duration_s = 0.4\nsensor.noise_rms_m_per_s2 = 0.2");
    let folder = folder_with(&plan.replace("log = [5, 20]", "log = [20, 60]"));
    make(folder.path(), &["-o", "out", "-q"]).exits(0);
    let card = fs::read_to_string(folder.path().join("out/README.md")).unwrap();
    let (_, section) = card.split_once("\n## Baselines\n").unwrap();
    for words in
        ["`sensor_ax`", "Each of 5 parts", "| none: guessing | 50 % |", "| features | right | 95 % | healthy | outer |"]
    {
        assert!(section.contains(words), "{words} in {section}");
    }
    // Deep damage in little noise: by the envelope's lines more are told than three standard deviations beyond guessing.
    let line = section.lines().find(|line| line.starts_with("| envelope")).unwrap();
    let share: f64 = line.split('|').nth(2).unwrap().trim().trim_end_matches(" %").parse().unwrap();
    assert!(share > 81.0 && line.contains(" of 12 |"), "{line}");
    // Too few to learn from: that is said.
    let folder = folder_with(PLAN);
    make(folder.path(), &["-o", "out", "-q"]).exits(0);
    let card = fs::read_to_string(folder.path().join("out/README.md")).unwrap();
    assert!(card.ends_with("\n## Baselines\n\nToo few runs: each class needs 5 to learn from.\n"), "{card}");
}

#[test]
fn prop_a_failed_run_is_a_row_with_its_reason() {
    // Values that make no scenario, in two runs of six.
    let plan = PLAN
        .replace("runs = 7", "runs = 6")
        .replace("[vary]", "out_of_range = \"fail\"\n[vary]\nlubricant.viscosity_pa_s = { grid = [0.01, -1.0, 0.02] }");
    let folder = folder_with(&plan);
    make(folder.path(), &["-o", "out"])
        .exits(0)
        .says(&["2 of 6 runs looked at draw values that make no scenario: kept as failed", "6 runs in"])
        .complains(&[
            "2 of 6 runs, such as run 2: lubricant.viscosity_pa_s = -1.0: out of range; allowed: >= 0 Pa s",
            "failed: lubricant.viscosity_pa_s = -1.0: out of range",
        ]);
    let all: Vec<Row> =
        (0..2).flat_map(|k| rows(&folder.path().join(format!("out/runs/part-0000{k}.parquet")))).collect();
    let failed: Vec<&Row> = all.iter().filter(|row| text(row, "status").as_deref() == Some("failed")).collect();
    assert_eq!(failed.len(), 2);
    for row in failed {
        assert!(text(row, "reason").unwrap().contains("out of range"));
        assert_eq!(cell(row, "lubricant.viscosity_pa_s"), &Field::Double(-1.0));
        assert_eq!((list(row, "sensor_ax"), list(row, "entry_t_s")), (None, None));
        assert!(text(row, "class").is_some() && text(row, "settings").unwrap().contains("-1.0"));
    }
    brinell(folder.path(), &["dataset", "verify", "out"]).exits(0).says(&["6 runs with 2 failed"]);
    // The card counts signals, and beside them what has none.
    let card = fs::read_to_string(folder.path().join("out/README.md")).unwrap();
    for words in ["| train | failed, no signal |", "| train | 4 | 2 |", "2 of 6 runs have failed, without a signal ("] {
        assert!(card.contains(words), "{words} in {card}");
    }
    // A scenario that is sound, and has nothing to start from.
    let loose = "vary.simulation.start = \"equilibrium\"\nvary.support = { inner_stiffness_n_per_m = 0.0, outer_stiffness_n_per_m = 0.0 }";
    let plan = PLAN.replace("name = \"outer\"", &format!("name = \"outer\"\n{loose}"));
    let folder = folder_with(&plan.replace("runs = 7", "runs = 2"));
    make(folder.path(), &["-o", "out"]).exits(0);
    let row = &rows(&folder.path().join("out/runs/part-00000.parquet"))[1];
    assert_eq!(text(row, "status").as_deref(), Some("failed"));
    let reason = text(row, "reason").unwrap();
    assert!(reason.contains("no static balance") && !reason.contains('\n'));
    assert!(text(row, "scenario").is_some() && list(row, "sensor_ax").is_none());
    // Nothing to start from in any run.
    let plan = PLAN.replace("[vary]", &format!("[vary]\n{}", loose.replace("vary.", "")));
    let folder = folder_with(&plan);
    make(folder.path(), &["-o", "out"])
        .exits(2)
        .complains(&["none of the first runs can begin; run 0: start = \"equilibrium\": no static balance"]);
}

#[test]
fn prop_a_contact_sheet_shows_runs_of_each_class_and_none_that_is_held_out() {
    let folder = folder_with(&PLAN.replace("runs = 7", &format!("runs = 12\nheld_out = 0.4\nsecret = \"{SECRET}\"")));
    make(folder.path(), &["-o", "out"]).exits(0);
    let out = folder.path().join("out");
    brinell(folder.path(), &["dataset", "sheet", "out", "--runs", "2"]).exits(0).says(&["sheet.html: 4 runs"]);
    let page = fs::read_to_string(out.join("sheet.html")).unwrap();
    let mut shown = [0, 0];
    for part in fs::read_dir(out.join("runs")).unwrap() {
        for row in rows(&part.unwrap().path()) {
            let run = cell(&row, "run").to_string();
            if !page.contains(&format!("<strong>run {run}</strong>")) {
                continue;
            }
            let class = text(&row, "class").expect("a label that is open");
            shown[usize::from(class == "outer")] += 1;
            let Field::Double(rpm) = cell(&row, "speed_rpm") else {
                panic!("a speed");
            };
            assert!(page.contains(&format!("{rpm:.0} r/min")), "run {run}");
        }
    }
    assert_eq!(shown, [2, 2]);
    // What is said of the signal is of the time that the ground truth is of.
    let all: Vec<Row> = files(&out.join("runs")).iter().flat_map(|name| rows(&out.join("runs").join(name))).collect();
    for run in sheet(&out, 2).unwrap().classes.into_iter().flat_map(|class| class.shown) {
        let row = all.iter().find(|row| cell(row, "run") == &Field::Long(run.run)).unwrap();
        assert_eq!(cell(row, "analysed_from_s"), &Field::Double(run.analysed_from_s));
        let signal = list(row, "sensor_ax").unwrap();
        let x = &signal[(run.analysed_from_s / run.dt_s).round() as usize..];
        let mean = x.iter().sum::<f64>() / x.len() as f64;
        let square = x.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / x.len() as f64;
        // Only the order of the sums may differ.
        assert!((run.rms - square.sqrt()).abs() < 1e-12 * run.rms, "run {}", run.run);
    }
    assert!(page.contains("both from 0.01 s on"));
    // A waveform and a spectrum each.
    assert_eq!(page.matches("<svg").count(), 8);
    for words in ["healthy · label 0", "outer · label 1", "outer-raceway at"] {
        assert!(page.contains(words), "{words}");
    }
    brinell(folder.path(), &["dataset", "verify", "out"]).exits(0);
    std::fs::create_dir(folder.path().join("empty")).unwrap();
    brinell(folder.path(), &["dataset", "sheet", "empty"]).exits(2).complains(&["no data set is here"]);
}

#[test]
fn prop_held_out_labels_lie_apart() {
    let folder = folder_with(&PLAN.replace("runs = 7", &format!("runs = 12\nheld_out = 0.5\nsecret = \"{SECRET}\"")));
    make(folder.path(), &["-o", "out"]).exits(0).says(&["labels of "]);
    let out = folder.path().join("out");
    let secret = ["class", "label", "settings", "scenario", "reason"];
    let mut apart = 0;
    let about = json(&out.join("dataset.json"));
    let parts = about["files"].as_array().unwrap();
    for (part, file) in parts.iter().enumerate() {
        let open = rows(&out.join(format!("runs/part-0000{part}.parquet")));
        let labels = out.join(format!("held_out/part-0000{part}.parquet"));
        // Runs of a file are for one thing.
        assert_eq!(labels.exists(), file["split"] == "held_out");
        assert_eq!(out.join(format!("truth/part-0000{part}.parquet")).exists(), !labels.exists());
        assert!(open.iter().all(|row| text(row, "split").as_deref() == file["split"].as_str()));
        let held = if labels.exists() { rows_of(&labels) } else { Vec::new() };
        let mut held = held.iter();
        for row in &open {
            let is_held = text(row, "split").as_deref() == Some("held_out");
            for name in secret {
                assert_eq!(is_hidden(row, name), is_held || name == "reason", "{name}");
            }
            for name in ["entry_t_s", "defect_on", "largest_contact_force_n", "work_steps", "warnings"] {
                assert_eq!(is_hidden(row, name), is_held, "{name}");
            }
            assert!(!is_held || is_hidden(row, "defects.0.depth_um"));
            // What a sensor knows stays.
            assert_eq!(list(row, "sensor_ax").unwrap().len(), 512);
            assert!(matches!(cell(row, "operation.speed_rpm"), Field::Double(_)));
            assert!(matches!(cell(row, "bpfo_hz"), Field::Double(_)));
            assert!(matches!(cell(row, "analysed_from_s"), Field::Double(_)));
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
    for name in files(&out).iter().filter(|name| !name.starts_with("held_out") && !name.starts_with("work")) {
        let bytes = fs::read(out.join(name)).unwrap();
        let has = |words: &str| bytes.windows(words.len()).any(|w| w == words.as_bytes());
        assert!(!has(SECRET) && !has("depth_um = {") && !has("\"seed\""), "{name}");
    }
    assert!(fs::read_to_string(out.join("held_out/_plan.json")).unwrap().contains("\"seed\": 11"));
    // How many bytes the labels take would tell too: a damaged run has more.
    assert!(about["held_out"].get("files").is_none(), "{}", about["held_out"]);
    for (part, file) in parts.iter().enumerate() {
        if file["split"] == "held_out" {
            let labels = fs::read(out.join(format!("held_out/part-0000{part}.parquet"))).unwrap();
            assert!(!sidecar.contains(&format!(" {}", labels.len())), "{part}");
        }
    }
    // The classes' numbers are those of the runs whose labels anybody sees.
    let classes = json(&out.join("dataset.json"))["classes"].clone();
    let counted = classes.as_array().unwrap().iter().map(|c| c["open_runs"].as_u64().unwrap());
    assert_eq!(counted.sum::<u64>(), 12 - apart);
    brinell(folder.path(), &["dataset", "verify", "out"]).exits(0);
    // What the labels are made from is checked as well; and one file of labels may not be missing where others are
    // here.
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
    brinell(folder.path(), &["dataset", "verify", "out"]).exits(0).says(&["; labels are not here"]);
}

#[test]
fn prop_what_a_data_set_is_and_what_was_made_are_reported_as_json() {
    let folder = folder_with(PLAN);
    let here = folder.path();
    let told = |args: &[&str]| parsed(&brinell(here, args).exits(0).out);
    let plan = told(&["dataset", "plan.toml", "--dry-run", "--json"]);
    assert_eq!((&plan["runs"], &plan["files"]), (&7.into(), &3.into()));
    assert_eq!(plan["classes"][0], serde_json::json!({ "label": 0, "name": "healthy", "runs": 4 }));
    assert_eq!(plan["shard"]["simulated_s"], 0.14);
    let made = told(&["dataset", "plan.toml", "-o", "d", "--json"]);
    assert_eq!((&made["complete"], &made["shard"]["done"]), (&true.into(), &7.into()));
    let again = told(&["dataset", "plan.toml", "-o", "d", "--json"]);
    assert_eq!((&again["shard"]["before"], &again["shard"]["done"]), (&7.into(), &0.into()));
    let verified = told(&["dataset", "verify", "d", "--json"]);
    assert_eq!(verified["files"], serde_json::json!({ "sound": 3, "of": 3 }));
    assert_eq!(verified["problems"], serde_json::json!([]));
    let merged = told(&["dataset", "merge", "d", "-o", "all", "--json"]);
    assert_eq!(merged["files"]["brought"], 3);
}

#[test]
fn prop_classes_are_counted_by_split_and_a_missing_one_is_said() {
    let folder = folder_with(&PLAN.replace("[vary]", "[split]\ntest = 0.1\nby = []\n[vary]"));
    let table = ["  class      train     test\n  healthy        ", "\n  outer          "];
    // One run of seven for the test: of one class.
    let lacks = "warning: the split test has no run of class \"";
    make(folder.path(), &["-o", "out", "--dry-run"]).exits(0).says(&table).complains(&[lacks]);
    let made = make(folder.path(), &["-o", "out"]).exits(0).says(&table).complains(&[lacks]);
    assert_eq!(made.out.matches(table[0]).count(), 2, "before the runs and after them");
    let out = folder.path().join("out");
    let splits = json(&out.join("dataset.json"))["splits"].clone();
    let mut counted = [[0, 0], [0, 0]];
    for name in files(&out.join("runs")) {
        for row in rows(&out.join("runs").join(name)) {
            let part = usize::from(text(&row, "split").unwrap() == "test");
            counted[part][usize::from(text(&row, "class").unwrap() == "outer")] += 1;
        }
    }
    for (part, classes) in counted.iter().enumerate() {
        assert_eq!(splits[part]["runs_of_classes"], serde_json::json!(classes));
    }
    let card = fs::read_to_string(out.join("README.md")).unwrap();
    let [[a, b], [c, d]] = counted;
    let shown = format!(
        "| class | label | train | test |\n| --- | --- | --- | --- |\n| healthy | 0 | {a} | {c} |\n| outer | 1 | {b} | {d} |\n"
    );
    assert!(card.contains(&shown), "{card}");
    // Of labels that are held out no count is published.
    let held = PLAN.replace("runs = 7", &format!("runs = 12\nheld_out = 0.4\nsecret = \"{SECRET}\""));
    let folder = folder_with(&held);
    make(folder.path(), &["-o", "out", "-q"]).exits(0);
    let out = folder.path().join("out");
    let splits = json(&out.join("dataset.json"))["splits"].clone();
    assert!(splits[0]["runs_of_classes"].is_array() && splits[1].get("runs_of_classes").is_none(), "{splits}");
    assert!(fs::read_to_string(out.join("README.md")).unwrap().contains("| class | label | train |\n"));
}

#[test]
fn regress_a_name_with_a_line_break_is_one_line_of_the_card() {
    let folder =
        folder_with(&PLAN.replace("\"outer\"", "\"outer\\n\\n# all | healthy\"").replace("runs = 7", "runs = 2"));
    make(folder.path(), &["-o", "out", "-q"]).exits(0);
    let card = fs::read_to_string(folder.path().join("out/README.md")).unwrap();
    assert!(card.contains("\n| outer # all \\| healthy | 1 | 1 |\n"), "{card}");
}

#[test]
fn regress_analyze_says_that_a_data_set_is_one() {
    let folder = folder_with(&PLAN.replace("runs = 7", "runs = 2"));
    make(folder.path(), &["-o", "out", "-q"]).exits(0);
    for named in ["out", "out/runs", "out/runs/part-00000.parquet"] {
        let told = brinell(folder.path(), &["analyze", named]).exits(2);
        let told = told.complains(&["error: out is a data set", "runs/part-*.parquet", "`brinell dataset sheet out`"]);
        assert_eq!(told.err.lines().count(), 1, "{told:?}");
    }
}
