//! Exit codes and what is said with them: 0 done, 1 the run failed, 2 bad input, 130 interrupted.

use crate::common::{Call, SHORT, brinell, brinell_reading, csv, files, folder_with, json};
use std::fs;
use tempfile::tempdir;

/// `check` of SHORT with `from` replaced by `to`.
#[track_caller]
fn check_with(from: &str, to: &str) -> Call {
    assert!(SHORT.contains(from), "{from}");
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("s.toml"), SHORT.replacen(from, to, 1)).unwrap();
    brinell(folder.path(), &["check", "s.toml"])
}

#[test]
fn regress_a_sound_scenario_exits_0_without_complaint() {
    check_with("duration_s = 0.02", "duration_s = 0.2").exits(0).says(&["short: the scenario is valid"]).keeps_quiet();
    check_with("short", "brief").exits(0).says(&["brief: the scenario is valid"]).warns_of_the_short_run_alone();
}

#[test]
fn regress_a_misspelt_key_is_answered_with_the_nearest() {
    check_with("speed_rpm", "sped_rpm").exits(2).complains(&[
        "error, line 7: operation.sped_rpm = 1500.0: unknown key; did you mean `speed_rpm`?",
        "--> s.toml:7:1\n",
        "7 | sped_rpm = 1500.0\n",
        "| ^^^^^^^^\n",
    ]);
}

#[test]
fn regress_what_no_file_holds_is_refused_in_a_few_lines() {
    let keys: String = (0..3000).map(|k| format!("k{k} = 1\n")).collect();
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("s.toml"), keys + SHORT).unwrap();
    let call = brinell(folder.path(), &["check", "s.toml"])
        .exits(2)
        .complains(&["and 2980 more like k", "3000 errors in s.toml"]);
    assert!(call.err.lines().count() < 120, "{}", call.err);
    fs::write(folder.path().join("s.toml"), SHORT).unwrap();
    fs::write(folder.path().join("plan.toml"), "#".repeat(5 << 20)).unwrap();
    let long = vec!["a"; 60_000].join(".") + "=1";
    for (args, words) in [
        (&["check", "s.toml", "--set", &*long][..], "has 60000 parts"),
        (&["run", "s.toml", "-o", "o", "--set", &*long], "has 60000 parts"),
        (&["sweep", "s.toml", "-o", "o", "--vary", &*long], "has 60000 parts"),
        (&["dataset", "plan.toml", "-o", "o"], "larger than 4 MiB; a scenario or a plan"),
        (&["check", "s.toml", "--set", "operation.speed_rpm=1e12"], "is a speed factor of 4.6"),
        (
            &["run", "s.toml", "-o", "o", "--set", "operation.load_n=[1e15, 0]"],
            "times the static load rating C0 = 36500 N",
        ),
    ] {
        brinell(folder.path(), args).exits(2).complains(&[words]);
    }
}

#[test]
fn regress_all_errors_come_at_once_in_the_order_of_the_file() {
    let folder = tempdir().unwrap();
    let text = SHORT.replace("load_n", "laod_n").replace("20.0", "-20.0").replace("25600.0", "\"often\"");
    let call = brinell_reading(folder.path(), &["check", "-"], text.as_bytes())
        .exits(2)
        .complains(&["3 errors in standard input", "--> standard input:8:1"]);
    let at = |part: &str| call.err.find(part).unwrap_or_else(|| panic!("no {part} in {}", call.err));
    // The key that was meant is not missing too.
    assert!(!call.err.contains("operation.load_n: missing"), "{}", call.err);
    assert!(at("line 8: operation.laod_n = [300.0, 0.0]") < at("line 13: defects.0.depth_um = -20.0"));
    assert!(at("line 13: defects.0.depth_um") < at("line 19: simulation.sample_rate_hz = \"often\""));
    assert_eq!(call.out, "");
}

#[test]
fn regress_what_is_no_scenario_is_refused() {
    let folder = tempdir().unwrap();
    let here = folder.path();
    brinell(here, &["check", "missing.toml"]).exits(2).complains(&["cannot read missing.toml"]);
    brinell(here, &["check", "."]).exits(2).complains(&["cannot read ."]);
    brinell_reading(here, &["check", "-"], b"name = \"\xff\xfe\"\n").exits(2).complains(&["line 1", "UTF-8"]);
    brinell_reading(here, &["check", "-"], b"name = \n[bearing")
        .exits(2)
        .complains(&["line 1: not valid TOML", "line 2: not valid TOML"]);
    // One bracket that was forgotten is one error, at its place, and not one a line behind it.
    let open = SHORT.replace("[300.0, 0.0]", "[300.0, 0.0");
    let call = brinell_reading(here, &["check", "-"], open.as_bytes()).exits(2);
    assert_eq!(call.err.matches("error").count(), 1, "{}", call.err);
    call.complains(&["line 8: not valid TOML: this `[` is not closed before line 1", "its `]` is missing"]);
    brinell_reading(here, &["check", "-"], b"")
        .exits(2)
        .complains(&["operation.speed_rpm: missing", "operation.load_n: missing"]);
}

#[test]
fn regress_overrides_are_checked_like_the_file() {
    let folder = folder_with("s.toml", SHORT);
    let set = |value: &str| brinell(folder.path(), &["check", "s.toml", "--set", value]);
    set("operation.speed_rpm=3000").exits(0).says(&["at 3000 r/min"]);
    set("defects.0.on=inner-raceway").exits(0);
    // Names of bearings that are digits need no quotes.
    brinell(folder.path(), &["init", "b.toml", "--template", "ball"]).exits(0);
    let args = ["check", "b.toml", "--set", "bearing.preset=6206"];
    brinell(folder.path(), &args).exits(0).says(&["Bearing   6206: 1 row of 9 balls"]);
    set("nonsense").exits(2).complains(&["--set nonsense: expected KEY=VALUE", "--set operation.speed_rpm=3000"]);
    set("=3").exits(2).complains(&["expected KEY=VALUE"]);
    set("operation.speed_rpm=fast").exits(2).complains(&["a number in r/min", "override"]);
}

#[test]
fn regress_a_place_that_is_none_is_bad_input() {
    let folder = folder_with("s.toml", SHORT);
    let here = folder.path();
    fs::write(here.join("file"), "").unwrap();
    fs::create_dir_all(here.join("o/signals.csv")).unwrap();
    brinell(here, &["run", "s.toml", "-o", "file"]).exits(2).complains(&["cannot make the folder file"]);
    brinell(here, &["run", "s.toml", "-o", "o", "--signals", "csv"])
        .exits(2)
        .complains(&["signals.csv: this is a folder"]);
    brinell(here, &["init", "nowhere/s.toml"]).exits(2).complains(&["no such folder as nowhere"]);
    assert_eq!(fs::read(here.join("file")).unwrap(), b"");
}

#[test]
fn regress_bad_arguments_exit_2() {
    let folder = tempdir().unwrap();
    for args in [
        &[][..],
        &["rnu", "s.toml"],
        &["run"],
        &["run", "s.toml", "--signals", "flac"],
        &["run", "s.toml", "--plots", "gif"],
        &["run", "s.toml", "--jobs", "0"],
        &["run", "s.toml", "--width", "90mm"],
        &["run", "s.toml", "--plots", "pdf", "--width", "90"],
        &["run", "s.toml", "--plots", "pdf", "--width", "79mm"],
        &["bearing", "show", "6999"],
        &["frequencies"],
    ] {
        let call = brinell(folder.path(), args).exits(2);
        assert!(!call.err.is_empty() && call.out.is_empty(), "{call:#?}");
    }
}

/// Pockets of 1e28 N/m pass every check; no step is short enough for the first roller that touches one.
#[test]
fn regress_a_failed_run_exits_1_says_where_and_keeps_what_it_has() {
    let folder = folder_with("s.toml", &SHORT.replace("NU206", "NN3007"));
    let here = folder.path();
    let stiff = "cage.contact_stiffness_n_per_m=1e28";
    let args = ["run", "s.toml", "-o", "o", "--signals", "csv,parquet"];
    let damping = "cage.contact_damping_ns_per_m=20";
    let call = brinell(here, &[&args[..], &["--set", stiff, "--set", damping]].concat())
        .exits(1)
        .complains(&[
            "error: ",
            " at t = 0.0",
            " s: ",
            " in row ",
            // Which contact or pocket is pressed hardest there hangs on round-off.
            " carries ",
        ])
        .says(&["Failed: the results are partial, up to t = 0.0"]);
    let errors = call.err.lines().filter(|l| l.starts_with("error"));
    assert_eq!(errors.count(), 1, "{call:#?}");
    let (_, rows) = csv(&here.join("o/signals.csv"));
    let summary = json(&here.join("o/summary.json"));
    assert!(rows.len() > 10 && rows.len() < 513, "{} rows", rows.len());
    assert!(rows.iter().flatten().all(|x| x.is_finite()));
    assert_eq!(summary["status"]["complete"], false);
    assert_eq!(summary["quantities"]["work.samples"]["value"], rows.len() as f64);
    let reason = summary["status"]["reason"].as_str().unwrap();
    assert!(call.err.ends_with(&format!("error: {reason}\n")));
    // The footer's metadata is there as plain text.
    let parquet = fs::read(here.join("o/signals.parquet")).unwrap();
    let footer = String::from_utf8_lossy(&parquet[parquet.len().saturating_sub(20_000)..]).into_owned();
    assert!(footer.contains(&format!("partial: {reason}")));
    assert_eq!(
        files(&here.join("o")),
        ["report.html", "scenario.toml", "signals.csv", "signals.parquet", "summary.json"]
    );
}

#[cfg(unix)]
mod interrupted {
    use super::*;
    use crate::common::command;
    use std::process::Stdio;
    use std::time::{Duration, Instant};

    /// Starts a run of many minutes, interrupts it once `signals.csv.partial` holds `bytes`, and waits for its end.
    fn interrupt(extra: &[&str], bytes: u64) -> (tempfile::TempDir, Call) {
        let folder = folder_with("s.toml", SHORT);
        let here = folder.path();
        let args = ["run", "s.toml", "-o", "o", "--signals", "csv,parquet", "--set", "simulation.duration_s=300"];
        let child =
            command(here, &[&args[..], extra].concat()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let begin = Instant::now();
        let partial = here.join("o/signals.csv.partial");
        while fs::metadata(&partial).map_or(true, |m| m.len() < bytes) {
            assert!(begin.elapsed() < Duration::from_secs(30), "nothing is written");
            std::thread::sleep(Duration::from_millis(10));
        }
        // The handler is set before the first step, not before the file's creation.
        std::thread::sleep(Duration::from_millis(200));
        let signal = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
        assert!(signal.success());
        (folder, child.wait_with_output().unwrap().into())
    }

    #[test]
    fn regress_an_interrupted_run_exits_130_and_keeps_what_it_has() {
        let (folder, call) = interrupt(&[], 1);
        let call =
            call.exits(130).says(&["Interrupted: the results are partial, up to t = "]).complains(&["s.toml: about "]);
        assert!(call.out.contains("wrote o/signals.csv"));
        let output = folder.path().join("o");
        let (_, rows) = csv(&output.join("signals.csv"));
        let summary = json(&output.join("summary.json"));
        assert!(!rows.is_empty());
        assert_eq!(summary["quantities"]["work.samples"]["value"], rows.len() as f64);
        assert_eq!(summary["simulated"]["duration_s"], 300.0);
        assert_eq!(summary["status"]["complete"], false);
        let parquet = fs::read(output.join("signals.parquet")).unwrap();
        assert!(parquet.starts_with(b"PAR1") && parquet.ends_with(b"PAR1"));
        assert!(String::from_utf8_lossy(&parquet).contains("partial: interrupted"));
        assert_eq!(
            files(&output),
            ["report.html", "scenario.toml", "signals.csv", "signals.parquet", "spectra.parquet", "summary.json"]
        );
    }

    /// A sample every 200 s of simulated time: minutes go by from one to the next.
    #[test]
    fn regress_ctrl_c_is_noticed_between_samples() {
        let begin = Instant::now();
        let (_folder, call) =
            interrupt(&["--set", "simulation.sample_rate_hz=0.005", "--set", "simulation.most_steps=1000000000000"], 0);
        call.exits(130).says(&["Interrupted: the results are partial, up to t = 0.0000 s."]);
        assert!(begin.elapsed() < Duration::from_secs(20));
    }
}
