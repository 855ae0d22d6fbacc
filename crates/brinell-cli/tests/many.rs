//! Several scenarios in one call: where results go, what happens when one fails, and that company changes no bit.

use crate::common::{SHORT, brinell, files, typed};
use std::fs;
use std::path::Path;
use tempfile::tempdir;

/// SHORT as a file of `folder`, with the depth of its damage.
fn scenario(folder: &Path, file: &str, depth_um: &str) {
    let path = folder.join(file);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    let text = SHORT.replacen("depth_um = 20.0", &format!("depth_um = {depth_um}"), 1);
    fs::write(path, text).unwrap();
}

#[test]
fn prop_several_runs_give_the_bits_of_each_alone() {
    let folder = tempdir().unwrap();
    let names = ["a", "b", "c"];
    for (name, depth) in names.into_iter().zip(["5.0", "10.0", "20.0"]) {
        scenario(folder.path(), &format!("{name}.toml"), depth);
    }
    brinell(folder.path(), &["run", "a.toml", "b.toml", "c.toml", "-o", "many", "--jobs", "2"])
        .exits(0)
        .says(&["many/b: short: 0.02", "3 runs, 2 at a time, in"])
        .warns_of_the_short_run_alone();
    for name in names {
        let (file, alone) = (format!("{name}.toml"), format!("alone/{name}"));
        brinell(folder.path(), &["run", &file, "-o", &alone, "-q"]).exits(0).keeps_quiet();
        let many = folder.path().join("many").join(name);
        let alone = folder.path().join("alone").join(name);
        assert_eq!(files(&many), files(&alone));
        for file in ["signals.parquet", "scenario.toml", "summary.json"] {
            let read = |folder: &Path| fs::read(folder.join(file)).unwrap();
            assert!(read(&many) == read(&alone), "{name}/{file}");
        }
    }
}

#[test]
fn regress_two_scenarios_of_one_stem_are_refused_before_anything_runs() {
    let folder = tempdir().unwrap();
    scenario(folder.path(), "x/spall.toml", "5.0");
    scenario(folder.path(), "y/Spall.toml", "10.0");
    brinell(folder.path(), &["run", "x/spall.toml", "y/Spall.toml", "-o", "out"])
        .exits(2)
        .complains(&["x/spall.toml and y/Spall.toml would both be written to", "rename one"]);
    assert!(!folder.path().join("out").exists());
}

#[test]
fn regress_every_scenario_is_checked_before_any_runs() {
    let folder = tempdir().unwrap();
    scenario(folder.path(), "good.toml", "5.0");
    scenario(folder.path(), "bad.toml", "-1");
    scenario(folder.path(), "worse.toml", "-2");
    brinell(folder.path(), &typed("run good.toml bad.toml worse.toml none.toml -o out")).exits(2).complains(&[
        "--> bad.toml:13",
        "--> worse.toml:13",
        "cannot read none.toml",
        "nothing was run",
    ]);
    assert!(!folder.path().join("out").exists());
}

#[test]
fn regress_one_that_fails_stops_no_other() {
    let folder = tempdir().unwrap();
    for name in ["a.toml", "b.toml", "c.toml"] {
        scenario(folder.path(), name, "5.0");
    }
    // A folder where the run of b wants a file.
    fs::create_dir_all(folder.path().join("out/b/summary.json/in-the-way")).unwrap();
    brinell(folder.path(), &["run", "a.toml", "b.toml", "c.toml", "-o", "out", "-j", "1"])
        .exits(1)
        .says(&["out/a: short", "out/c: short"])
        .complains(&["error: b.toml: ", "summary.json", "1 of 3 runs failed"]);
    for name in ["a", "c"] {
        assert!(folder.path().join("out").join(name).join("report.html").exists());
    }
}

/// `..` is what is left of `...toml` without its ending, and `.` of `..toml`.
#[test]
fn prop_no_name_of_a_file_leads_out_of_the_folder() {
    for name in ["...toml", "..toml"] {
        let folder = tempdir().unwrap();
        scenario(folder.path(), name, "5.0");
        scenario(folder.path(), "a.toml", "5.0");
        let file = format!("./{name}");
        let args = ["run", &file, "a.toml", "-o", "m/deep", "-q", "--no-report"];
        brinell(folder.path(), &args).exits(0);
        let own = [name, "a.toml"].map(str::to_owned);
        let mut there = files(folder.path());
        there.retain(|file| !own.contains(file));
        let one = |stem: &str| {
            ["scenario.toml", "signals.parquet", "spectra.parquet", "summary.json"]
                .map(|file| format!("m/deep/{stem}/{file}"))
        };
        assert_eq!(there, [one("a"), one("run")].concat());
    }
}
