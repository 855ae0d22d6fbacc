//! The same bytes whatever the threads, the shards and the interruptions.

use super::{PLAN, brinell, command, files, folder_with, make, same};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant, SystemTime};

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
            "complete: one/dataset.json",
        ])
        .complains(&["too short to settle", "(in 7 of 7 runs looked at, the first of them run 0)"]);
    make(folder.path(), &["-o", "two", "-j", "2", "-q"]).exits(0).keeps_quiet();
    same(&at("one"), &at("two"));
    for shard in ["3/3", "1/3", "2/3"] {
        make(folder.path(), &["-o", "three", "--shard", shard, "-q"]).exits(0);
        assert_eq!(at("three/dataset.json").exists(), shard == "2/3");
    }
    same(&at("one"), &at("three"));
    make(folder.path(), &["-o", "three", "--shard", "4/4"])
        .exits(0)
        .complains(&["this shard is empty, as the plan has 3 files in all"]);
    // In folders of their own, merged; then twice.
    for shard in ["1/2", "2/2"] {
        make(folder.path(), &["-o", &shard.replace('/', "-"), "--shard", shard, "-q"]).exits(0);
    }
    brinell(folder.path(), &["dataset", "merge", "1-2", "-o", "joined"])
        .exits(1)
        .complains(&["incomplete: 1 file in none of the folders (part 1)"]);
    brinell(folder.path(), &["dataset", "merge", "1-2", "2-2", "-o", "joined"])
        .exits(0)
        .says(&["joined: 1 file brought, 2 there before"]);
    same(&at("one"), &at("joined"));
    brinell(folder.path(), &["dataset", "verify", "joined"])
        .exits(0)
        .says(&["3 of 3 files sound, 7 runs with 0 failed"])
        .keeps_quiet();

    // Again: nothing is touched.
    let times = |folder: &Path| -> Vec<SystemTime> {
        files(folder).iter().map(|f| fs::metadata(folder.join(f)).unwrap().modified().unwrap()).collect()
    };
    let before = times(&at("one"));
    make(folder.path(), &["-o", "one"]).exits(0).says(&["0 runs in", "7 there before"]);
    assert_eq!(times(&at("one")), before);
    // A file that went missing comes back as it was.
    fs::remove_file(at("one").join("runs/part-00001.parquet")).unwrap();
    make(folder.path(), &["-o", "one"]).exits(0).says(&["3 runs in", "4 there before"]);
    same(&at("one"), &at("two"));
}

#[cfg(unix)]
#[test]
fn prop_kill_9_loses_no_finished_run() {
    let folder = folder_with(&PLAN.replace("runs = 7", "runs = 40").replace("runs_per_file = 3", "runs_per_file = 16"));
    let args = ["dataset", "plan.toml", "-o", "out", "-q", "-j", "2"];
    make(folder.path(), &["-o", "whole", "-q"]).exits(0);
    let out = folder.path().join("out");
    // Runs that are on the disk, in a file or waiting for one.
    let finished = || -> BTreeSet<usize> {
        let names = if out.exists() { files(&out) } else { Vec::new() };
        let runs = names.iter().flat_map(|name| {
            let number = |rest: &str, end| rest.strip_suffix(end)?.parse::<usize>().ok();
            let of_file = name.strip_prefix("runs/part-").and_then(|rest| number(rest, ".parquet"));
            let one = name.split_once("/run-").and_then(|(_, rest)| number(rest, ".row"));
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
            assert!(begin.elapsed() < Duration::from_secs(60), "no run is finished");
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
    make(folder.path(), &["-o", "out"])
        .exits(0)
        .says(&[&format!("{left} runs in"), &format!("{} there before", before.len())]);
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
    fs::copy(folder.path().join("whole/work/campaign.json"), folder.path().join("out/work/campaign.json")).unwrap();
    make(folder.path(), &["-o", "out", "-q"]).exits(0);
    same(&folder.path().join("whole"), &folder.path().join("out"));
}
