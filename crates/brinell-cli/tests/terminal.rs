//! What reaches the terminal: all of it or an exit of 1, and nothing that steers it.

use crate::common::{Call, SHORT, brinell, command, folder_with, limited, typed};
use std::fs;
use std::path::Path;

#[cfg(target_os = "linux")]
#[test]
fn prop_a_standard_output_that_takes_nothing_is_exit_1_everywhere() {
    let folder = folder_with("s.toml", SHORT);
    let here = folder.path();
    let plan = "base = \"s.toml\"\nruns = 2\nseed = 1\nlicence = \"CC0-1.0\"\n[[classes]]\nname = \"c\"\n";
    fs::write(here.join("plan.toml"), plan).unwrap();
    let long = "simulation.duration_s=0.5";
    let fast = "operation.speed_rpm=3000";
    let run = ["run", "s.toml", "-o", "RUN", "-q", "--no-report"];
    brinell(here, &[&run[..], &["--set", long, "--set", fast]].concat()).exits(0);
    brinell(here, &["dataset", "plan.toml", "-o", "data", "-q"]).exits(0);
    let call = |args: &[&str]| -> Call {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        command(here, args).stdout(full).output().unwrap().into()
    };
    let vary = "operation.speed_rpm=1000,1500";
    for args in [
        &["schema"][..],
        &["--help"],
        &["run", "--help"],
        &["--version"],
        &["init"],
        &["init", "new.toml"],
        &["check", "s.toml"],
        &["bearing", "list"],
        &["bearing", "show", "NN3007"],
        &["frequencies", "NN3007"],
        &["frequencies", "NN3007", "--json"],
        &["defect", "convert", "s.toml", "--to", "profile"],
        &["defect", "simplify", "s.toml", "--to", "equal-area-circle"],
        &["defect", "fit", "s.toml"],
        &["defect", "preview", "s.toml", "-o", "p"],
        &["defect", "random", "--seed", "1", "--length-mm", "2", "--width-mm", "2"],
        &["analyze", "RUN", "--json", "-"],
        &["analyze", "RUN"],
        &["run", "s.toml", "-o", "o", "--no-report"],
        &["sweep", "s.toml", "--vary", vary, "--dry-run"],
        &["dataset", "plan.toml", "--dry-run"],
        &["dataset", "verify", "data"],
        &["dataset", "merge", "data", "-o", "joined"],
    ] {
        call(args).exits(1).complains(&["error: cannot write to standard output: No space left on device"]);
    }
    assert!(here.join("o/summary.json").exists(), "the results are there");
    // Bad input stays bad input; and who asks for no words misses none.
    call(&["check", "none.toml"]).exits(2);
    call(&["run", "s.toml", "-o", "o", "--no-report", "-q"]).exits(0);
}

/// That nothing of a call's output steers a terminal, and that `shown` is there.
#[track_caller]
fn harmless(call: &Call, shown: &str) {
    let all = format!("{}{}", call.out, call.err);
    let acts = |c: char| c.is_control() && c != '\n' && c != '\t';
    assert!(!all.contains(acts), "{call:?}");
    assert!(all.contains(shown), "no {shown} in {call:?}");
}

#[test]
fn prop_names_from_files_do_not_steer_the_terminal() {
    let name = r#"name = "\u001b]52;c;cHduZWQ=\u0007\u009b\n2J""#;
    let folder = folder_with("s.toml", &SHORT.replace(r#"name = "short""#, name));
    let here: &Path = folder.path();
    let shown = r"\u{1b}]52;c;cHduZWQ=\u{7}\u{9b}\u{a}2J";
    harmless(&brinell(here, &["check", "s.toml"]).exits(0), shown);
    let run = ["run", "s.toml", "-o", "o", "--no-report"];
    harmless(&brinell(here, &run).exits(0), shown);
    let both = ["run", "s.toml", "s2.toml", "-o", "many", "--no-report"];
    fs::copy(here.join("s.toml"), here.join("s2.toml")).unwrap();
    harmless(&brinell(here, &both).exits(0), shown);
    // A key, and a line of the file, as raw as a file can hold it.
    for text in [format!("\"\\u001b]0;x\\u0007\" = 1\n{SHORT}"), format!("# \u{9b}2J\nnamed = \"\u{9b}2J\"\n{SHORT}")] {
        fs::write(here.join("bad.toml"), text).unwrap();
        harmless(&brinell(here, &["check", "bad.toml"]).exits(2), "\\u{");
    }
    // Channels of a measured file.
    fs::write(here.join("x.csv"), "\u{1b}]0;PWNED\u{7},b\n1,2\n3,4\n5,6\n").unwrap();
    let call = brinell(here, &["analyze", "x.csv", "--rate", "1000"]).exits(2);
    harmless(&call, r"\u{1b}]0;PWNED\u{7}");
    // JSON stays JSON.
    fs::write(here.join("y.csv"), "a\u{9b}\n1\n2\n").unwrap();
    let call = brinell(here, &["frequencies", "NN3007", "--json"]).exits(0);
    serde_json::from_str::<serde_json::Value>(&call.out).unwrap();
}

/// The kernel kills a process that writes beyond the limit, unless it ignores the signal.
#[cfg(target_os = "linux")]
#[test]
fn prop_a_file_beyond_the_limit_on_files_is_an_error_and_leaves_nothing() {
    let folder = folder_with("s.toml", SHORT);
    let run = "run s.toml -o o -q --no-report --signals csv";
    limited(folder.path(), 32, run).exits(1).complains(&["signals.csv"]);
    let there = crate::common::files(&folder.path().join("o"));
    let left = |name: &String| name.contains(".partial") || name.starts_with("signals");
    assert!(!there.iter().any(left), "{there:?}");
}

#[cfg(target_os = "linux")]
#[test]
fn prop_a_closed_standard_output_is_exit_1_where_something_was_to_be_said() {
    let folder = folder_with("s.toml", SHORT);
    let run = "run s.toml -o o -q --no-report";
    for (args, output, code) in [
        ("check s.toml", ">&-", 1),
        ("--help", ">&-", 1),
        (run, ">&-", 0),
        ("check s.toml", ">/dev/null", 0),
        ("check s.toml", "1<>/dev/null", 0),
    ] {
        let call = std::process::Command::new("sh")
            .args(["-c", &format!("exec \"$0\" {args} {output}")])
            .arg(env!("CARGO_BIN_EXE_brinell"))
            .current_dir(folder.path())
            .output()
            .unwrap();
        let call = Call::from(call).exits(code);
        if code == 1 {
            call.complains(&["cannot write to standard output: it is closed"]);
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn regress_a_run_that_cannot_be_written_keeps_the_results_before_it() {
    let folder = folder_with("s.toml", SHORT);
    let first = ["run", "s.toml", "-o", "o", "-q", "--signals", "csv"];
    brinell(folder.path(), &first).exits(0);
    let before = crate::common::results(&folder.path().join("o"));
    // Signals too long; then signals that fit, and a report that does not.
    for (blocks, signals, lacks) in [(32, "csv", "signals.csv"), (400, "none", "report.html")] {
        let run = format!("run s.toml -o o -q --signals {signals}");
        limited(folder.path(), blocks, &run).exits(1).complains(&[lacks]);
        assert!(crate::common::results(&folder.path().join("o")) == before);
    }
    // With room for them the new results come, and what they have not goes.
    let again = ["run", "s.toml", "-o", "o", "-q", "--signals", "none"];
    brinell(folder.path(), &again).exits(0);
    assert_eq!(crate::common::files(&folder.path().join("o")), ["report.html", "scenario.toml", "summary.json"]);
}

#[cfg(target_os = "linux")]
#[test]
fn regress_results_that_cannot_be_written_leave_those_before_them() {
    let folder = folder_with("s.toml", SHORT);
    let here = folder.path();
    let other = SHORT.replace("depth_um = 20.0", "depth_um = 5.0");
    fs::write(here.join("b.toml"), other).unwrap();
    // Enough turns of the shaft for an analysis.
    let longer = SHORT.replace("speed_rpm = 1500.0", "speed_rpm = 3000.0");
    let longer = longer.replace("duration_s = 0.02", "duration_s = 0.4");
    fs::write(here.join("r.toml"), longer).unwrap();
    brinell(here, &["run", "r.toml", "-o", "r", "-q", "--no-report"]).exits(0);
    // Fewer files the second time; the first of them fit, the last does not.
    for (line, lacks) in [
        ("analyze r -o a -q", "report.html"),
        ("compare s.toml b.toml -o c -q", "compare.json"),
        ("defect preview s.toml -o p --formats svg", "damage-1-passage.csv"),
    ] {
        let args = typed(line);
        let output = here.join(args[args.iter().position(|a| *a == "-o").unwrap() + 1]);
        let first = match args[0] {
            "defect" => [&args[..args.len() - 2], &["--formats", "svg,png"]].concat(),
            _ => [&args[..], &["--plots", "svg,png"]].concat(),
        };
        brinell(here, &first).exits(0);
        let before = crate::common::results(&output);
        limited(here, 60, line).exits(1).complains(&[lacks]);
        assert!(crate::common::results(&output) == before, "{args:?}");
        brinell(here, &args).exits(0);
        let after = crate::common::files(&output);
        assert!(after.len() < before.len(), "{after:?}");
        assert!(!after.iter().any(|name| name.ends_with(".partial")));
    }
}
