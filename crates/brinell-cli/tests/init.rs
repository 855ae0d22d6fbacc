//! `init`: every template passes `check` and runs, and nothing of the user's is overwritten.

use crate::common::{brinell, csv, files, typed};
use std::fs;
use tempfile::tempdir;

const TEMPLATES: [&str; 9] =
    ["outer-spall", "inner-spall", "photo", "scan", "run-up", "measured", "data-set", "histories", "ball"];
/// Those that are plans.
const PLANS: [&str; 2] = ["data-set", "histories"];

#[test]
fn prop_every_template_passes_check_with_bearings_of_every_kind() {
    for (k, template) in TEMPLATES.into_iter().enumerate() {
        for (j, bearing) in ["NN3007", "6205-2RS/C3", "NU 306 ECP", "6001", "NJ205", "UC204"].into_iter().enumerate() {
            // Half of the bearings with each template, for time; either half has rollers and balls.
            if (j / 2 + j + k) % 2 == 0 || template == "ball" && bearing.starts_with('N') {
                continue;
            }
            let folder = tempdir().unwrap();
            let here = folder.path();
            let args = ["init", "s.toml", "--template", template, "--bearing", bearing];
            brinell(here, &args).exits(0).keeps_quiet();
            let text = fs::read_to_string(here.join("s.toml")).unwrap();
            let call = if PLANS.contains(&template) {
                brinell(here, &["check", "s-base.toml"]).exits(0).keeps_quiet();
                // A fifth of its runs, for time.
                fs::write(here.join("s.toml"), text.replace("runs = 60", "runs = 12")).unwrap();
                brinell(here, &["dataset", "s.toml", "--dry-run"]).exits(0)
            } else {
                assert!(text.starts_with("#:schema ./brinell-schema.json\n"), "{text}");
                // Tables of a scan in a fifth of the time.
                let check = ["check", "s.toml", "--set", "contact.tables=coarse"];
                brinell(here, &check).exits(0).says(&["the scenario is valid"])
            };
            assert!(!call.err.contains("error"), "{template}, {bearing}: {call:?}");
            // What a first scenario draws no warning for: damage off the load zone, a run too short, loads beyond the
            // rating.
            let remarks: Vec<&str> = call.err.lines().filter(|l| l.starts_with("warning:")).collect();
            let of_files = |line: &&&str| line.contains("image") || line.contains("depth");
            // The least load that histories of a small bearing draw is felt by its support.
            let of_draws = |line: &&&str| template == "histories" && line.contains("at rest the support carries");
            let others = remarks.iter().filter(|line| !of_files(line) && !of_draws(line)).count();
            assert_eq!(others, 0, "{template}, {bearing}: {}", call.err);
            // The example scan is of this bearing's raceway.
            assert!(
                !call.err.contains("the fitted") && !call.err.contains("form"),
                "{template}, {bearing}: {}",
                call.err
            );
            assert!(text.lines().count() < 50, "not small:\n{text}");
        }
    }
}

#[test]
fn prop_every_template_runs() {
    for template in TEMPLATES {
        let folder = tempdir().unwrap();
        let here = folder.path();
        brinell(here, &["init", "s.toml", "--template", template]).exits(0);
        // A shorter run than the template's: that it runs, and leaves numbers.
        if PLANS.contains(&template) {
            let plan = fs::read_to_string(here.join("s.toml")).unwrap();
            let short = plan
                .replace("runs = 60", "runs = 3")
                .replace("machines = 3", "machines = 1")
                .replace("snapshots = 24", "snapshots = 2")
                .replace("simulation.duration_s = 1.1", "simulation.duration_s = 0.6");
            let base = fs::read_to_string(here.join("s-base.toml")).unwrap();
            fs::write(here.join("s-base.toml"), base.replace("duration_s = 1.0", "duration_s = 0.6")).unwrap();
            fs::write(here.join("s.toml"), short).unwrap();
            brinell(here, &["dataset", "s.toml", "-o", "o", "-q"]).exits(0);
            assert!(here.join("o/dataset.json").exists());
            let card = fs::read_to_string(here.join("o/README.md")).unwrap();
            assert!(!card.contains("runs have"), "{template}: no row is warned of: {card}");
            continue;
        }
        let short = "simulation.duration_s=0.05";
        let coarse = "contact.tables=coarse";
        let run =
            ["run", "s.toml", "-o", "o", "-q", "--signals", "csv", "--no-report", "--set", short, "--set", coarse];
        brinell(here, &run).exits(0);
        let (names, rows) = csv(&here.join("o/signals.csv"));
        assert!(names.iter().any(|n| n.starts_with("sensor_")), "{names:?}");
        let finite = rows.iter().flatten().all(|x| x.is_finite());
        assert!(finite && rows.len() > 1000, "{template}");
    }
}

#[test]
fn prop_the_template_of_an_inner_race_is_long_enough_for_its_line() {
    let folder = tempdir().unwrap();
    let here = folder.path();
    let init = ["init", "s.toml", "--template", "inner-spall"];
    brinell(here, &init).exits(0);
    brinell(here, &["run", "s.toml", "-o", "o", "--no-report"]).exits(0).says(&[
        "m/s^2, mean peak to peak of a revolution ",
        "defect 1: BPFI 32",
        " (95 %: 3",
    ]);
    // The same frequency, with an interval of its own.
    brinell(here, &["analyze", "o"]).exits(0).says(&[
        "m/s^2 of noise added before the verdict, as of a quiet machine",
        "Inner race damage, clear: BPFI at 32",
        " Hz (95 %: 3",
    ]);
}

/// No warning ends a first run under the laws "mechanics", that of parametric work included.
#[test]
fn prop_the_first_run_of_a_template_conserves_energy() {
    for template in ["outer-spall", "inner-spall", "run-up", "measured", "ball"] {
        let folder = tempdir().unwrap();
        let here = folder.path();
        brinell(here, &["init", "s.toml", "--template", template]).exits(0);
        let run = typed("run s.toml -o o --no-report --no-healthy --set simulation.laws=mechanics");
        brinell(here, &run).exits(0).keeps_quiet();
    }
}

#[test]
fn prop_full_templates_are_the_same_scenario() {
    for template in ["outer-spall", "inner-spall", "run-up", "measured", "ball", "photo", "scan"] {
        let folder = tempdir().unwrap();
        let here = folder.path();
        brinell(here, &["init", "s.toml", "--template", template]).exits(0);
        let full = ["init", "full.toml", "--template", template, "--full"];
        brinell(here, &full).exits(0);
        brinell(here, &["diff", "s.toml", "full.toml"]).exits(0).says(&["key", "name"]);
        let same = ["init", "full.toml", "--template", template, "--full", "--force"];
        brinell(here, &same).exits(0);
        let text = fs::read_to_string(here.join("full.toml")).unwrap();
        fs::write(here.join("full.toml"), text.replace("name = \"full\"", "name = \"s\"")).unwrap();
        brinell(here, &["diff", "s.toml", "full.toml"]).exits(0).says(&["no difference: the same run"]);
        assert!(text.lines().count() > 80, "{template}");
    }
}

#[test]
fn prop_init_overwrites_nothing_of_the_users() {
    let folder = tempdir().unwrap();
    let here = folder.path();
    brinell(here, &["init", "s.toml"]).exits(0).keeps_quiet().says(&["wrote s.toml", "brinell run s.toml"]);
    let written = fs::read_to_string(here.join("s.toml")).unwrap();
    // A file's name is its scenario's, whatever it is.
    brinell(here, &["init", "{load}.toml"]).exits(0);
    let odd = fs::read_to_string(here.join("{load}.toml")).unwrap();
    assert_eq!(odd, written.replace("name = \"s\"", "name = \"{load}\""));
    fs::remove_file(here.join("{load}.toml")).unwrap();
    assert_eq!(brinell(here, &["init"]).exits(0).out, written.replace("name = \"s\"", "name = \"outer-spall\""));
    fs::write(here.join("s.toml"), "mine").unwrap();
    brinell(here, &["init", "s.toml"]).exits(2).complains(&["s.toml exists; --force overwrites it"]);
    assert_eq!(fs::read(here.join("s.toml")).unwrap(), b"mine");
    brinell(here, &["init", "s.toml", "--force"]).exits(0);
    assert_eq!(fs::read_to_string(here.join("s.toml")).unwrap(), written);
    fs::remove_file(here.join("s.toml")).unwrap();
    fs::remove_file(here.join("brinell-schema.json")).unwrap();
    let photo = ["init", "s.toml", "--template", "photo"];
    fs::write(here.join("photo-spall.png"), "mine").unwrap();
    brinell(here, &photo).exits(2).complains(&["photo-spall.png exists; --force overwrites it"]);
    assert_eq!(files(here), ["photo-spall.png"], "nothing was written");
    fs::remove_file(here.join("photo-spall.png")).unwrap();
    brinell(here, &photo).exits(0).says(&["wrote photo-spall.png", "brinell run s.toml"]);
    assert_eq!(files(here), ["brinell-schema.json", "photo-spall.png", "s.toml"]);
    // The same example and schema again are no reason to refuse; a file that is no schema of brinell's is.
    brinell(here, &["init", "t.toml", "--template", "photo"]).exits(0);
    fs::write(here.join("brinell-schema.json"), "{}").unwrap();
    brinell(here, &["init", "u.toml"]).exits(2).complains(&["brinell-schema.json exists"]);
    brinell(here, &["init", "u.toml", "--force"]).exits(0);
    let schema = brinell(here, &["schema"]).exits(0).out;
    assert_eq!(fs::read_to_string(here.join("brinell-schema.json")).unwrap(), schema);
}

#[test]
fn regress_what_init_refuses() {
    for (args, words) in [
        (&["init", "--template", "photo"][..], "--template photo writes files beside the scenario"),
        (&["init", "s.toml", "--bearing", "NU2O6"], "did you mean NU206?"),
        (&["init", "s.toml", "--bearing", "ZA-2115"], "only the defect frequencies are known"),
        (&["init", "s.toml", "--template", "ball", "--bearing", "NU206"], "takes a ball bearing"),
        (&["init", "s.toml", "--template", "data-set", "--full"], "--full is about scenarios"),
        (&["init", "s.toml", "--template", "spall"], "outer-spall"),
    ] {
        let folder = tempdir().unwrap();
        brinell(folder.path(), args).exits(2).complains(&[words]);
        assert!(files(folder.path()).is_empty());
    }
}
