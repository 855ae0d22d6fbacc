//! No command writes over a file that it reads, and none mixes its results with another command's.

use crate::common::{Call, GIVEN, SHORT, brinell, column, command, files, folder_with, json, results, typed};
use std::fs;
use std::path::Path;
use tempfile::tempdir;

/// Of a file that is read and would be replaced, and of any other that no command made.
const INPUT: &str = "would be written, and is an input of this command";
const FOREIGN: &str = "that are in no list of results there";

/// A second of a tone as `name`, and the call that analyses it.
fn signal(here: &Path, name: &str) {
    let tone: Vec<f64> = (0..12_000).map(|k| (0.7 * f64::from(k)).sin()).collect();
    column(&here.join(name), &tone);
}

fn analyze(here: &Path, file: &str, more: &[&str]) -> Call {
    brinell(here, &[&["analyze", file, "-q"], &GIVEN[..], more].concat())
}

fn run(here: &Path, more: &[&str]) -> Call {
    let quick = ["run", "--quiet", "--no-report", "--signals", "csv"];
    brinell(here, &[&quick[..], more].concat())
}

/// That the call is refused, with these words, and changes nothing.
#[track_caller]
fn refused(here: &Path, args: &[&str], words: &str) {
    let before = results(here);
    brinell(here, args).exits(2).complains(&[words]);
    assert!(results(here) == before, "{args:?} changed something");
}

#[test]
fn prop_a_run_never_writes_over_what_it_reads() {
    let folder = folder_with("scenario.toml", SHORT);
    let here = folder.path();
    let args = ["run", "scenario.toml", "-o", ".", "-q"];
    refused(here, &args, FOREIGN);
    refused(here, &[&args[..], &["--overwrite"]].concat(), FOREIGN);
    // Of several runs, none over what any of them reads.
    fs::create_dir(here.join("b")).unwrap();
    fs::copy(here.join("scenario.toml"), here.join("b/scenario.toml")).unwrap();
    fs::copy(here.join("scenario.toml"), here.join("b.toml")).unwrap();
    brinell(here, &["run", "b/scenario.toml", "b.toml", "-o", ".", "-q"]).exits(2).complains(&[
        "b holds files that are in no list of results there: scenario.toml",
        FOREIGN,
        "nothing was run",
    ]);
    // A run's own results, from its own folder.
    run(here, &["b.toml", "-o", "o"]).exits(0);
    refused(here, &["run", "o/scenario.toml", "-o", "o", "-q"], INPUT);
    // By standard input as well.
    #[cfg(unix)]
    {
        let before = results(here);
        let input = fs::File::open(here.join("o/scenario.toml")).unwrap();
        let call = command(here, &["run", "-", "-o", "o", "-q"]).stdin(input).output();
        Call::from(call.unwrap()).exits(2).complains(&["scenario.toml would be written", "(standard input)"]);
        assert!(results(here) == before);
    }
}

#[cfg(unix)]
#[test]
fn prop_links_do_not_hide_an_input() {
    let folder = folder_with("mine.toml", SHORT);
    let here = folder.path();
    for (name, link) in [("hard", true), ("soft", false)] {
        let folder = here.join(name);
        fs::create_dir(&folder).unwrap();
        let at = folder.join("scenario.toml");
        match link {
            true => fs::hard_link(here.join("mine.toml"), at).unwrap(),
            false => std::os::unix::fs::symlink("../mine.toml", at).unwrap(),
        }
        refused(here, &["run", "mine.toml", "-o", name, "-q", "--overwrite"], FOREIGN);
        let linked = format!("{name}/scenario.toml");
        refused(here, &["run", &linked, "-o", name, "-q"], FOREIGN);
    }
    // Results that are inputs by another name.
    run(here, &["mine.toml", "-o", "o"]).exits(0);
    for (name, link) in [("hard.toml", true), ("soft.toml", false)] {
        match link {
            true => fs::hard_link(here.join("o/scenario.toml"), here.join(name)).unwrap(),
            false => std::os::unix::fs::symlink("o/scenario.toml", here.join(name)).unwrap(),
        }
        refused(here, &["run", name, "-o", "o", "-q", "--overwrite"], INPUT);
    }
    signal(here, "x.csv");
    fs::hard_link(here.join("x.csv"), here.join("y.json")).unwrap();
    for output in ["x.csv", "./x.csv", "y.json"] {
        analyze(here, "x.csv", &["--json", output])
            .exits(2)
            .complains(&[output, "is an input of this command (x.csv)"]);
    }
    assert_eq!(crate::common::lines(&here.join("y.json")), 12_000);
}

#[test]
fn prop_files_of_damage_are_inputs() {
    let drawing = r#"<svg xmlns="http://www.w3.org/2000/svg" width="3mm" height="2mm" viewBox="0 0 3 2"><path d="M0 0H3V2H0Z"/></svg>"#;
    let folder = tempdir().unwrap();
    let here = folder.path();
    fs::create_dir(here.join("plots")).unwrap();
    for file in ["damage-1.svg", "plots/waveform.svg"] {
        fs::write(here.join(file), drawing).unwrap();
        let shape = format!("svg = {{ file = \"{file}\" }}");
        let text = SHORT.replace("rectangle = { length_mm = 2.0, width_mm = 4.0 }", &shape);
        fs::write(here.join("s.toml"), text).unwrap();
        brinell(here, &["check", "s.toml"]).exits(0);
        match file {
            "damage-1.svg" => refused(here, &["defect", "preview", "s.toml", "-o", "."], FOREIGN),
            _ => refused(here, &["run", "s.toml", "-o", ".", "-q", "--plots", "svg"], FOREIGN),
        }
    }
    // A drawing in the place of a result.
    brinell(here, &["defect", "preview", "s.toml", "-o", "p", "--formats", "svg"]).exits(0);
    fs::copy(here.join("damage-1.svg"), here.join("p/damage-1.svg")).unwrap();
    let text = fs::read_to_string(here.join("s.toml")).unwrap().replace("plots/waveform.svg", "p/damage-1.svg");
    fs::write(here.join("s.toml"), text).unwrap();
    refused(here, &["defect", "preview", "s.toml", "-o", "p", "--overwrite"], INPUT);
}

#[test]
fn prop_a_measured_signal_and_the_folder_of_a_run_stay() {
    let folder = folder_with("s.toml", SHORT);
    let here = folder.path();
    run(here, &["s.toml", "-o", "RUN"]).exits(0);
    for args in [
        &["analyze", "RUN", "-o", "RUN"][..],
        &["analyze", "RUN", "-o", "RUN", "--overwrite"],
        &["analyze", "RUN", "--json", "RUN/summary.json"],
        &["analyze", "RUN/signals.csv", "-o", "RUN", "--overwrite"],
    ] {
        let before = results(here);
        let call = brinell(here, args).exits(2);
        assert!(results(here) == before, "{args:?} {call:?}");
    }
}

#[test]
fn prop_campaigns_spare_their_inputs() {
    let folder = folder_with("best.toml", SHORT);
    let here = folder.path();
    let fit = "operation.speed_rpm=1400:1600";
    let target = "sensor_ax.rms=30~1";
    let calibrate = |base| {
        let given = ["--fit", fit, "--target", target, "--budget", "8", "-o", "."];
        [&["calibrate", base], &given[..]].concat()
    };
    refused(here, &calibrate("best.toml"), FOREIGN);
    fs::create_dir(here.join("scenarios")).unwrap();
    for name in ["a.toml", "b.toml"] {
        fs::write(here.join("scenarios").join(name), SHORT).unwrap();
    }
    refused(here, &["compare", "scenarios/a.toml", "scenarios/b.toml", "-o", "."], FOREIGN);
    // Nor into a folder with anything else in it.
    fs::create_dir(here.join("o")).unwrap();
    fs::write(here.join("o/sweep.json"), "{}").unwrap();
    refused(here, &typed("sweep best.toml --vary operation.speed_rpm=1000 -o o"), FOREIGN);
    // What it resumes from is no input.
    fs::remove_file(here.join("o/sweep.json")).unwrap();
    brinell(here, &typed("sweep best.toml --vary operation.speed_rpm=1500 -q -o o")).exits(0);
    fs::rename(here.join("best.toml"), here.join("o/best.toml")).unwrap();
    refused(here, &typed("sweep o/best.toml --vary operation.speed_rpm=1500 -q -o o"), INPUT);
}

#[cfg(unix)]
#[test]
fn prop_a_printed_entry_is_not_appended_to_its_own_scenario() {
    let folder = folder_with("s.toml", SHORT);
    let here = folder.path();
    let out = fs::File::options().append(true).open(here.join("s.toml"));
    let args = ["defect", "convert", "s.toml", "--to", "profile"];
    let call = command(here, &args).stdout(out.unwrap()).output();
    Call::from(call.unwrap()).exits(2).complains(&["standard output would be written"]);
    assert_eq!(fs::read_to_string(here.join("s.toml")).unwrap(), SHORT);
}

#[test]
fn regress_results_of_another_command_are_refused_or_replaced_whole() {
    let folder = folder_with("s.toml", SHORT);
    let here = folder.path();
    signal(here, "x.csv");
    signal(here, "y.csv");
    run(here, &["s.toml", "-o", "o", "--plots", "svg"]).exits(0);
    let before = results(&here.join("o"));
    let words = ["o holds results of `brinell run`", "-o", "--overwrite"];
    analyze(here, "x.csv", &["-o", "o"]).exits(2).complains(&words);
    let sweep = typed("sweep s.toml --vary operation.speed_rpm=1500 -q -o");
    for args in [
        &["compare", "s.toml", "--variant", "t:name=t", "-o", "o"][..],
        &["defect", "preview", "s.toml", "-o", "o"],
        &["reproduce", "--quick", "-o", "o"],
        &[&sweep[..], &["o"]].concat(),
    ] {
        brinell(here, args).exits(2).complains(&words[..1]);
    }
    assert!(results(&here.join("o")) == before);
    // With the flag, nothing of the run stays.
    analyze(here, "x.csv", &["-o", "o", "--overwrite"]).exits(0);
    let there = files(&here.join("o"));
    let listed = json(&here.join("o/analysis.json"))["files"].clone();
    let listed: Vec<String> = serde_json::from_value(listed).unwrap();
    assert!(there.iter().all(|name| listed.contains(name)), "{there:?}");
    assert_eq!(there.len(), listed.len());
    // The same signal again is the same results; another signal's are not.
    analyze(here, "x.csv", &["-o", "o", "--plots", "png"]).exits(0);
    assert!(!files(&here.join("o")).iter().any(|name| name.ends_with(".svg")));
    analyze(here, "y.csv", &["-o", "o"]).exits(2).complains(&["o holds results of another signal"]);
    run(here, &["s.toml", "-o", "o"]).exits(2).complains(&["o holds results of `brinell analyze`"]);
    run(here, &["s.toml", "-o", "o", "--overwrite"]).exits(0);
    assert_eq!(files(&here.join("o")), ["scenario.toml", "signals.csv", "summary.json"]);
    // Finished runs are never removed.
    brinell(here, &[&sweep[..], &["points"]].concat()).exits(0);
    let before = results(&here.join("points"));
    run(here, &["s.toml", "-o", "points", "--overwrite"]).exits(2).complains(&["finished runs of a sweep"]);
    assert!(results(&here.join("points")) == before);
    // Nor are a study's and a data set's mixed.
    let plan = "base = \"s.toml\"\nruns = 2\nseed = 1\n[vary]\noperation.speed_rpm = { uniform = [1700, 1900] }\n";
    fs::write(here.join("plan.toml"), plan).unwrap();
    refused(here, &["dataset", "plan.toml", "-o", "points", "-q"], "points holds finished runs of a sweep");
    fs::create_dir(here.join("set")).unwrap();
    for name in ["dataset.json", "sweep.csv"] {
        fs::write(here.join("set").join(name), "somebody's").unwrap();
    }
    refused(here, &[&sweep[..], &["set"]].concat(), "set holds a data set");
    refused(here, &["reproduce", "--quick", "-o", "set"], "set holds a data set");
}

/// What is beside results: files that systems leave are nobody's, all others are named, also where a command writes pictures.
#[test]
fn prop_files_of_others_are_named_and_those_of_the_system_are_not() {
    let folder = folder_with("s.toml", SHORT);
    let here = folder.path();
    run(here, &["s.toml", "-o", "o"]).exits(0);
    for name in [".DS_Store", "Thumbs.db"] {
        fs::write(here.join("o").join(name), "the system's").unwrap();
    }
    run(here, &["s.toml", "-o", "o"]).exits(0);
    assert!(here.join("o/.DS_Store").exists() && here.join("o/Thumbs.db").exists());
    // Results of another run where this one puts its pictures.
    run(here, &["s.toml", "-o", "o/plots"]).exits(0);
    refused(
        here,
        &["run", "s.toml", "-o", "o", "-q", "--plots", "svg", "--overwrite"],
        "plots/scenario.toml and 2 more",
    );
    fs::remove_dir_all(here.join("o/plots")).unwrap();
    fs::write(here.join("o/notes.txt"), "mine").unwrap();
    refused(
        here,
        &["run", "s.toml", "-o", "o", "-q", "--overwrite"],
        "o holds files that are in no list of results there: notes.txt; nothing",
    );
}

#[test]
fn regress_a_comparison_of_other_scenarios_leaves_none_of_the_first() {
    let folder = crate::common::with_blocks("a.toml");
    let here = folder.path();
    let compare = |variants: &[&str], more: &[&str]| -> Call {
        let mut args = vec!["compare", "a.toml", "-o", "c", "-q"];
        variants.iter().for_each(|v| args.extend(["--variant", v]));
        brinell(here, &[&args[..], more].concat())
    };
    let both = ["t:name=t", "u:defects.0.depth_um=10"];
    compare(&both, &["--plots", "svg"]).exits(0);
    compare(&both, &[]).exits(0);
    compare(&both[..1], &[]).exits(2).complains(&["c holds results of another set of scenarios"]);
    compare(&both[..1], &["--overwrite"]).exits(0);
    assert_eq!(
        files(&here.join("c")),
        ["compare.csv", "compare.html", "compare.json", "compare.parquet", "scenarios/1-a.toml", "scenarios/2-t.toml"]
    );
}
