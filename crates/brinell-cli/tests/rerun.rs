//! A run into a folder that holds results already; what a run keeps of its scenario's assumptions; the kernel.

use crate::common::{SHORT, brinell, command, files, folder_with, json, typed};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// SHORT as `a.toml`, and another scenario as `b.toml`.
fn folder() -> TempDir {
    let folder = folder_with("a.toml", SHORT);
    let other = SHORT.replace("depth_um = 20.0", "depth_um = 5.0");
    fs::write(folder.path().join("b.toml"), other).unwrap();
    folder
}

/// A run of 20 ms without the page, which takes longer than the run.
fn run<'a>(scenario: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    let first = ["run", scenario, "-o", "o", "--quiet", "--no-report"];
    [&first[..], more].concat()
}

fn text(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap()
}

const OPEN: &str = include_str!("../../brinell/tests/open-audit.toml");

#[test]
fn prop_files_of_a_run_that_is_made_again_are_those_at_reference() {
    let folder = folder_with("open.toml", OPEN);
    let here = folder.path();
    let said = brinell(here, &typed("run open.toml -o a --no-report --signals csv,parquet")).exits(0);
    said.says(&["made again at \"reference\""]);
    brinell(here, &typed("run open.toml -o b --no-report --signals csv,parquet --set simulation.accuracy=reference"))
        .exits(0);
    assert_eq!(text(here, "a/signals.csv"), text(here, "b/signals.csv"));
    assert_eq!(files(&here.join("a")), files(&here.join("b")));
    assert_eq!(json(&here.join("a/summary.json"))["simulated"]["accuracy"], "reference");
}

#[test]
fn regress_a_run_that_would_take_too_many_steps_leaves_no_folder() {
    let folder = folder_with("a.toml", SHORT);
    let said = brinell(folder.path(), &typed("run a.toml -o o --set simulation.most_steps=100")).exits(2);
    said.complains(&["simulation.most_steps = 1e2: the run would take about"]);
    assert!(!folder.path().join("o").exists());
    brinell(folder.path(), &typed("check a.toml --set simulation.most_steps=100")).exits(2);
}

#[test]
fn regress_the_same_scenario_again_leaves_no_file_of_the_run_before() {
    let folder = folder();
    let here = folder.path();
    brinell(here, &typed("run a.toml -o o --quiet --signals csv --plots svg")).exits(0);
    let output = here.join("o");
    let first = files(&output);
    assert!(first.iter().any(|n| n.starts_with("plots/")) && first.contains(&"report.html".into()));
    let listed: Vec<String> = serde_json::from_value(json(&output.join("summary.json"))["files"].clone()).unwrap();
    let mut sorted = listed.clone();
    sorted.sort();
    assert_eq!(sorted, first, "the summary lists what is there");
    // What a killed run left, and a folder with results of its own, are in nobody's way.
    fs::write(output.join("signals.mat.partial"), "half").unwrap();
    brinell(here, &typed("defect preview a.toml -o o/damage --formats svg")).exits(0);
    fs::remove_file(output.join("signals.csv")).unwrap();
    brinell(here, &run("a.toml", &[])).exits(0).keeps_quiet();
    let own = |folder: &Path| {
        let all = files(folder).into_iter().filter(|name| !name.starts_with("damage/") && !name.ends_with(".partial"));
        all.collect::<Vec<_>>()
    };
    assert_eq!(own(&output), ["scenario.toml", "signals.parquet", "spectra.parquet", "summary.json"]);
    assert!(!output.join("plots").exists() && output.join("damage/preview.json").exists());
    // The written scenario is the same scenario.
    fs::copy(output.join("scenario.toml"), here.join("written.toml")).unwrap();
    brinell(here, &run("written.toml", &["--signals", "none"])).exits(0);
    assert_eq!(own(&output), ["scenario.toml", "summary.json"]);
}

#[test]
fn regress_results_of_another_scenario_are_refused_or_replaced_as_a_whole() {
    let folder = folder();
    let here = folder.path();
    brinell(here, &run("a.toml", &["--signals", "csv", "--plots", "svg"])).exits(0);
    let before = crate::common::results(&here.join("o"));
    brinell(here, &run("b.toml", &[])).exits(2).complains(&[
        "o holds results of another scenario",
        "--overwrite",
        "-o",
    ]);
    // An override makes another scenario as well.
    brinell(here, &run("a.toml", &["--set", "operation.speed_rpm=900"])).exits(2);
    assert!(crate::common::results(&here.join("o")) == before, "a refused run changes nothing");
    brinell(here, &run("b.toml", &["--overwrite"])).exits(0).keeps_quiet();
    assert_eq!(files(&here.join("o")), ["scenario.toml", "signals.parquet", "spectra.parquet", "summary.json"]);
    assert!(text(here, "o/scenario.toml").contains("depth_um = 5.0"));
}

#[test]
fn prop_a_folder_with_a_file_that_no_manifest_lists_is_refused_and_stays() {
    let folder = folder();
    let here = folder.path();
    let output = here.join("o");
    let refused = |name: &str| {
        let before = crate::common::results(&output);
        for flags in [&[][..], &["--overwrite"]] {
            brinell(here, &run("a.toml", flags)).exits(2).complains(&["o holds files", name, "move them away", "-o"]);
        }
        assert!(crate::common::results(&output) == before, "{name}");
    };
    // Into a folder of somebody's.
    for name in ["signals.csv", "scenario.toml", "notes.txt", "plots/own.svg"] {
        fs::create_dir_all(output.join("plots")).unwrap();
        fs::write(output.join(name), SHORT).unwrap();
        refused(name);
        fs::remove_dir_all(&output).unwrap();
    }
    // Beside results.
    brinell(here, &run("a.toml", &["--plots", "svg"])).exits(0);
    for name in ["thesis.txt", "signals.csv", "plots/own.svg"] {
        fs::write(output.join(name), "mine").unwrap();
        refused(name);
        fs::remove_file(output.join(name)).unwrap();
    }
    // Whatever a list names, nothing outside the folder is touched.
    let mut summary = json(&output.join("summary.json"));
    let files = summary["files"].as_array_mut().unwrap();
    files.extend(["../a.toml", "plots/../../b.toml"].map(Into::into));
    files.push(3.into());
    fs::write(output.join("summary.json"), summary.to_string()).unwrap();
    brinell(here, &run("a.toml", &["--signals", "none"])).exits(0);
    assert_eq!(crate::common::files(&output), ["scenario.toml", "summary.json"]);
    assert!(here.join("a.toml").exists() && here.join("b.toml").exists());
    // As written before summaries listed files.
    summary.as_object_mut().unwrap().remove("files");
    fs::write(output.join("summary.json"), summary.to_string()).unwrap();
    fs::remove_file(output.join("scenario.toml")).unwrap();
    refused("summary.json");
}

#[test]
fn regress_a_scenario_that_somebody_changed_is_not_replaced_unasked() {
    let folder = folder();
    let here = folder.path();
    brinell(here, &run("a.toml", &[])).exits(0);
    brinell(here, &run("a.toml", &[])).exits(0);
    let noted = text(here, "o/scenario.toml") + "# keep this one\n";
    fs::write(here.join("o/scenario.toml"), &noted).unwrap();
    brinell(here, &run("a.toml", &[])).exits(2).complains(&["its scenario.toml was changed", "--overwrite"]);
    assert_eq!(text(here, "o/scenario.toml"), noted);
    brinell(here, &run("a.toml", &["--overwrite"])).exits(0);
}

#[test]
fn regress_one_foreign_folder_stops_all_of_several_runs() {
    let folder = folder();
    let here = folder.path();
    let both = typed("run a.toml b.toml -o o --quiet --no-report --signals none");
    brinell(here, &["run", "a.toml", "-o", "o/b", "--quiet", "--no-report"]).exits(0);
    brinell(here, &both).exits(2).complains(&["b.toml: o/b holds results of another scenario", "nothing was run"]);
    assert!(!here.join("o/a").exists());
    brinell(here, &[&both[..], &["--overwrite"]].concat()).exits(0);
    for stem in ["a", "b"] {
        assert_eq!(files(&here.join("o").join(stem)), ["scenario.toml", "summary.json"]);
    }
}

/// The keys and reasons that `check --assumptions` prints.
fn assumptions(here: &Path, scenario: &str) -> Vec<String> {
    let call = brinell(here, &["check", scenario, "--assumptions"]).exits(0);
    let list = call.out.split("Assumed, because it was not given:\n").nth(1).unwrap();
    list.lines().map(str::to_owned).collect()
}

#[test]
fn regress_written_scenarios_keep_what_was_assumed() {
    let folder = folder();
    let here = folder.path();
    brinell(here, &run("a.toml", &["--signals", "none"])).exits(0);
    let source = assumptions(here, "a.toml");
    assert!(source.len() > 10, "{source:?}");
    assert_eq!(assumptions(here, "o/scenario.toml"), source);
    let first = json(&here.join("o/summary.json"));
    brinell(here, &typed("run o/scenario.toml -o again --quiet --no-report --signals none")).exits(0);
    let again = json(&here.join("again/summary.json"));
    assert_eq!(first["assumed"].as_array().unwrap().len(), source.len());
    assert_eq!(again["assumed"], first["assumed"]);
    // Third hand, and of a comparison.
    assert_eq!(text(here, "again/scenario.toml"), text(here, "o/scenario.toml"));
    brinell(here, &["compare", "a.toml", "o/scenario.toml", "-o", "c", "--quiet"]).exits(0);
    let written: Vec<String> = files(&here.join("c")).into_iter().filter(|n| n.ends_with(".toml")).collect();
    assert_eq!(written.len(), 2, "{written:?}");
    for name in written {
        assert_eq!(assumptions(&here.join("c"), &name), source, "{name}");
    }
}

#[test]
fn prop_the_kernel_is_recorded_and_an_unknown_one_refused() {
    let folder = folder();
    let here = folder.path();
    let call = |kernel: &str, args: &[&str]| -> crate::common::Call {
        let mut command = command(here, args);
        command.env("BRINELL_KERNEL", kernel);
        command.output().unwrap().into()
    };
    for kernel in ["plain", "portable"] {
        let args = ["run", "a.toml", "-o", kernel, "--quiet", "--no-report", "--signals", "csv"];
        call(kernel, &args).exits(0);
        let summary = json(&here.join(kernel).join("summary.json"));
        assert_eq!(summary["solver"]["kernel"], kernel);
    }
    // It reaches the run: libm rounds otherwise than the lanes' functions.
    assert_ne!(text(here, "plain/signals.csv"), text(here, "portable/signals.csv"));
    for args in [&["run", "a.toml", "-o", "bad"][..], &["check", "a.toml"]] {
        call("sse9", args).exits(2).complains(&["BRINELL_KERNEL = \"sse9\"", "plain, portable"]);
    }
    assert!(!here.join("bad").exists());
}
