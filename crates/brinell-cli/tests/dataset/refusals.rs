//! What does not fit, or was changed, is reported; what is there stays.

use super::{PLAN, brinell, files, folder_with, make, results};
use brinell_io::record_facts;
use std::fs;

#[test]
fn prop_what_was_changed_after_it_was_written_is_reported() {
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
    brinell(folder.path(), &["dataset", "verify", "out"]).exits(1).complains(&[
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
    make(folder.path(), &["-o", "out"])
        .exits(2)
        .complains(&["runs/part-00001.parquet: ", "one of them is damaged; remove both"]);
    fs::remove_file(&file).unwrap();
    fs::remove_file(out.join("work/part-00001.json")).unwrap();
    make(folder.path(), &["-o", "out", "-q"]).exits(0);
    assert!(fs::read(&file).unwrap() == whole);
    assert_eq!(fs::read_to_string(out.join("dataset.json")).unwrap(), sidecar);
}

#[test]
fn regress_distributions_that_leave_a_range_are_refused_with_how_often() {
    let plan = PLAN
        .replace("[vary]", "[vary]\nlubricant.viscosity_pa_s = { grid = [0.01, -1.0, 0.02] }")
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
    make(folder.path(), &["-o", "out"])
        .exits(2)
        .complains(&["lubricant.viscosity_pa_s = -1.0: out of range (in 2 of 6 runs, such as run 0)", "plan.toml:9:"]);
    // All of them.
    let folder = folder_with(&plan.replace("{ grid = [0.01, -1.0, 0.02] }", "-1.0"));
    make(folder.path(), &["-o", "out"]).exits(2).complains(&[
        "lubricant.viscosity_pa_s = -1.0: out of range (in 6 of 6 runs, such as run 0)\n  allowed: >= 0 Pa s\n",
        "plan.toml:9:",
    ]);
    // No distribution has a key that there is not.
    let folder = folder_with(&PLAN.replace("depth_um = { log = [5, 20] }", "depth_mm = { log = [0.005, 0.02] }"));
    let call = make(folder.path(), &["-o", "out"]).exits(2).complains(&["unknown key; did you mean `depth_um`?"]);
    assert!(!call.err.contains("give narrower distributions"), "{call:#?}");
    // A grid is not drawn again: the plan is impossible.
    let folder = folder_with(&plan.replace("[vary]", "out_of_range = \"redraw\"\n[vary]"));
    make(folder.path(), &["-o", "out"]).exits(2).complains(&["1000 further draws did not fit either"]);
}

#[test]
fn regress_bad_input_is_reported() {
    for (from, to, parts) in [
        ("speed_rpm", "sped_rpm", vec!["operation.sped_rpm", "did you mean `speed_rpm`?", "plan.toml:9:"]),
        ("base.toml", "no.toml", vec!["base = \"no.toml\": cannot read no.toml", "plan.toml:2:"]),
        (
            "runs = 7",
            "runs = 7\nsignals = [\"outer_zz\"]",
            vec!["signals = \"outer_zz\": no channel of the first runs has such a name", "plan.toml:4:"],
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
            "\"outer-raceway\"",
            "\"outer\"",
            vec![
                "defects.0.on = \"outer\" (defect 1): unknown word; did you mean \"outer-raceway\"? (in 3 of 7 runs, such as run 1)",
                "plan.toml:18:",
            ],
        ),
        (
            "uniform = [1400, 1600]",
            "uniform = [1400]",
            vec!["vary.operation.speed_rpm = { uniform = [1400] }: expected two numbers, found 1 of them"],
        ),
        ("uniform = [1400, 1600]", "uniform = [1600, 1400]", vec!["the ends are reversed", "plan.toml:9:"]),
        ("seed = 11", "seed = -1", vec!["seed = -1: out of range", "plan.toml:4:"]),
    ] {
        let folder = folder_with(&PLAN.replacen(from, to, 1));
        make(folder.path(), &["-o", "out"]).exits(2).complains(&parts);
        assert!(!folder.path().join("out").exists());
    }
    let folder = folder_with(PLAN);
    for (args, part) in
        [(vec!["--shard", "0/4"], "shards count from 1: 1/4 to 4/4"), (vec!["--shard", "5/4"], "expected I/N")]
    {
        make(folder.path(), &args).exits(2).complains(&[part]);
    }
    brinell(folder.path(), &["dataset", "verify", "."]).exits(2).complains(&["no data set is here"]);
    brinell(folder.path(), &["dataset", "merge", ".", "-o", "x"]).exits(2).complains(&["no data set is here"]);
    assert!(!folder.path().join("x").exists());
}

#[test]
fn regress_another_campaign_another_version_and_damage_are_found() {
    let folder = folder_with(PLAN);
    let at = |name: &str| folder.path().join(name);
    make(folder.path(), &["-o", "out", "-q"]).exits(0);
    // Comments and order are no other campaign, another seed is.
    fs::write(at("plan.toml"), format!("# a comment\n{PLAN}")).unwrap();
    make(folder.path(), &["-o", "out", "-q"]).exits(0).keeps_quiet();
    fs::write(at("plan.toml"), PLAN.replace("seed = 11", "seed = 12")).unwrap();
    let before = results(&at("out"));
    make(folder.path(), &["-o", "out"]).exits(2).complains(&["out holds another campaign, \"test\" with 7 runs"]);
    make(folder.path(), &["-o", "other", "-q"]).exits(0);
    brinell(folder.path(), &["dataset", "merge", "out", "other", "-o", "x"])
        .exits(2)
        .complains(&["other holds another campaign"]);
    // The same where the folder has nothing but the files.
    fs::rename(at("out/work"), at("work")).unwrap();
    make(folder.path(), &["-o", "out"]).exits(2).complains(&["out holds another campaign"]);
    fs::remove_dir_all(at("out/work")).unwrap();
    fs::rename(at("work"), at("out/work")).unwrap();
    assert!(before == results(&at("out")));
    fs::write(at("plan.toml"), PLAN).unwrap();

    // Another version.
    let mine = at("out/work/campaign.json");
    let text = fs::read_to_string(&mine).unwrap();
    let version = env!("CARGO_PKG_VERSION");
    fs::write(&mine, text.replace(&format!("\"brinell\": \"{version}\""), "\"brinell\": \"0.0.9\"")).unwrap();
    make(folder.path(), &["-o", "out"])
        .exits(2)
        .complains(&["out holds runs of brinell 0.0.9, and this is ", "one data set has one version"]);
    brinell(folder.path(), &["dataset", "verify", "out"]).exits(1).complains(&["runs/part-00000.parquet: of brinell"]);
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
    brinell(folder.path(), &["dataset", "verify", "out"]).exits(1).complains(&[
        "runs/part-00000.parquet is missing",
        "runs/part-00001.parquet: of another campaign",
        "runs/part-00002.parquet: its checksum is another than when it was written",
        "runs/part-00007.parquet: no file of this data set",
    ]);
}

#[test]
fn prop_a_description_that_is_cut_short_is_reported_with_its_remedy() {
    let folder = folder_with(PLAN);
    let at = |name: &str| folder.path().join("out").join(name);
    let again = |name: &str| format!("remove {name}, and the plan's own command");
    make(folder.path(), &["-o", "out", "-q"]).exits(0);
    for name in ["dataset.json", "work/campaign.json"] {
        let whole = fs::read(at(name)).unwrap();
        fs::write(at(name), &whole[..whole.len() / 2]).unwrap();
        brinell(folder.path(), &["dataset", "verify", "out"])
            .exits(1)
            .says(&["3 of 3 files sound"])
            .complains(&["damaged (EOF", &again(name)]);
        if name == "work/campaign.json" {
            make(folder.path(), &["-o", "out", "-q"]).exits(2).complains(&["damaged (EOF", &again(name)]);
        }
        fs::remove_file(at(name)).unwrap();
        make(folder.path(), &["-o", "out", "-q"]).exits(0);
        assert!(fs::read(at(name)).unwrap() == whole, "{name}");
        brinell(folder.path(), &["dataset", "verify", "out"]).exits(0);
    }
    for name in ["dataset.json", "work/campaign.json"] {
        fs::write(at(name), "{").unwrap();
    }
    brinell(folder.path(), &["dataset", "verify", "out"]).exits(2).complains(&[&again("dataset.json")]);
    brinell(folder.path(), &["dataset", "verify", "plan.toml"]).exits(2).complains(&["plan.toml: no data set is here"]);
}

#[test]
fn regress_a_dry_run_tells_and_writes_nothing() {
    let folder = folder_with(PLAN);
    make(folder.path(), &["--dry-run", "--shard", "1/2"]).exits(0).says(&[
        "0 healthy: 4 runs",
        "1 outer: 3 runs",
        "varies: operation.speed_rpm, defects.0.depth_um, defects.0.shape.random.length_mm",
        "signals: sensor_ax, sensor_ay",
        "4 runs of this shard: 0.0800 s simulated",
    ]);
    assert_eq!(files(folder.path()), ["base.toml", "plan.toml"]);
}
