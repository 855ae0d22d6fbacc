//! What `brinell run` leaves in its folder and says on the terminal.

use crate::common::{Call, SHORT, brinell, brinell_reading, command, csv, files, folder_with, json, typed};
use std::fs;
use std::path::Path;
use std::process::Stdio;
use tempfile::tempdir;

/// Samples of SHORT: floor(0.02 s * 25600 Hz) + 1.
const ROWS: usize = 513;

/// The default channels of a single-row bearing (design.md).
const CHANNELS: &str = "t inner_x inner_y inner_vx inner_vy inner_ax inner_ay outer_x outer_y outer_vx outer_vy outer_ax \
                        outer_ay inner_torque outer_torque cage1_x cage1_y cage1_ax cage1_ay cage1_speed sensor_ax sensor_ay";

#[test]
fn regress_csv_has_the_documented_channels_and_number_of_rows() {
    let folder = folder_with("s.toml", SHORT);
    let args = ["run", "s.toml", "-o", "o", "--signals", "csv"];
    let call = brinell(folder.path(), &args).exits(0).warns_of_the_short_run_alone();
    let output = folder.path().join("o");
    assert_eq!(files(&output), ["report.html", "scenario.toml", "signals.csv", "summary.json"]);
    for name in files(&output) {
        assert!(call.out.contains(&format!("  wrote o/{name}\n")), "{}", call.out);
    }
    let (names, rows) = csv(&output.join("signals.csv"));
    assert_eq!(names, typed(CHANNELS));
    assert_eq!(rows.len(), ROWS);
    for (i, row) in rows.iter().enumerate() {
        assert_eq!(row[0], i as f64 / 25600.0);
        assert!(row.iter().all(|x| x.is_finite()));
    }
}

#[test]
fn prop_a_duration_between_samples_is_rounded_down() {
    for (duration, rate, rows) in [("0.001", "25600.0", 26), ("0.0012", "10000.0", 13)] {
        let folder = folder_with("s.toml", &SHORT.replace("0.02", duration).replace("25600.0", rate));
        let args = typed("run s.toml -o o --signals csv --no-report");
        brinell(folder.path(), &args).exits(0);
        assert_eq!(csv(&folder.path().join("o/signals.csv")).1.len(), rows);
    }
}

#[test]
fn prop_the_same_scenario_gives_the_same_bytes_and_its_written_form_the_same_signals() {
    let folder = folder_with("s.toml", SHORT);
    let here = folder.path();
    let run = |scenario: &str, output: &str| {
        let args = ["run", scenario, "-o", output, "--signals", "csv,parquet", "--plots", "svg,png"];
        brinell(here, &args).exits(0).warns_of_the_short_run_alone();
    };
    run("s.toml", "a");
    run("s.toml", "b");
    run("a/scenario.toml", "c");
    let names = files(&here.join("a"));
    for name in &names {
        let bytes = |run: &str| fs::read(here.join(run).join(name)).unwrap();
        assert!(bytes("a") == bytes("b"), "{name} differs between two runs");
    }
    let text = |run: &str, name: &str| fs::read_to_string(here.join(run).join(name)).unwrap();
    assert!(text("a", "signals.csv") == text("c", "signals.csv"));
    // What was assumed is stated in the written form, so its comments differ; its values do not.
    let values = |run: &str| -> Vec<String> {
        let text = text(run, "scenario.toml");
        let lines = text.lines().map(|line| line.split("  #").next().unwrap_or(""));
        lines.map(|line| line.trim_end().to_owned()).collect()
    };
    assert_eq!(values("a"), values("c"));
    let plots: Vec<_> = names.iter().filter(|n| n.starts_with("plots/")).collect();
    assert!(plots.len() >= 8 && plots.len().is_multiple_of(2), "{plots:?}");
    for name in plots {
        let bytes = fs::read(here.join("a").join(name)).unwrap();
        let head: &[u8] = if name.ends_with(".svg") { b"<svg" } else { b"\x89PNG\r\n\x1a\n" };
        assert!(bytes.starts_with(head), "{name}");
    }
}

#[test]
fn prop_results_say_what_made_them() {
    let folder = folder_with("s.toml", SHORT);
    let here = folder.path();
    let run = |out: &str, date: Option<&str>| {
        let args = ["run", "s.toml", "-o", out, "--signals", "none", "--quiet"];
        let mut command = command(here, &args);
        match date {
            Some(date) => command.env("SOURCE_DATE_EPOCH", date),
            None => command.env_remove("SOURCE_DATE_EPOCH"),
        };
        let call: Call = command.output().unwrap().into();
        call.exits(0);
        json(&here.join(out).join("summary.json"))["made_by"].clone()
    };
    // date -u -d @951782400
    let made = run("a", Some("951782400"));
    assert_eq!(made["date"], "2000-02-29T00:00:00Z");
    let text = fs::read_to_string(here.join("a/scenario.toml")).unwrap();
    assert_eq!(made["scenario_sha256"], brinell::made_by::digest(&text));
    let told = brinell(here, &["--version"]).exits(0).out;
    assert!(told.contains(&format!("kernel {}", made["kernel"].as_str().unwrap())), "{told}");
    assert!(told.contains(&format!("commit {}", made["commit"].as_str().unwrap_or("unknown"))), "{told}");
    let page = fs::read_to_string(here.join("a/report.html")).unwrap();
    for part in
        ["2000-02-29 00:00:00 UTC", &made["scenario_sha256"].as_str().unwrap()[..12], made["kernel"].as_str().unwrap()]
    {
        assert!(page.contains(part), "{part}");
    }
    // By the clock, without it.
    let now = run("b", None)["date"].as_str().unwrap().to_owned();
    assert!(now.as_str() > "2026" && now.len() == 20, "{now}");
}

#[test]
fn regress_summary_has_the_documented_members() {
    // Long enough for indicators from blocks of revolutions.
    let folder = folder_with("s.toml", &SHORT.replace("0.02", "0.3"));
    let here = folder.path();
    let args = typed("run s.toml -o o --signals none --no-report");
    let call = brinell(here, &args).exits(0).keeps_quiet();
    assert!(call.out.contains("in the envelope; pure rolling 131.05 Hz"), "{}", call.out);
    assert_eq!(files(&here.join("o")), ["scenario.toml", "summary.json"]);
    let s = json(&here.join("o/summary.json"));
    assert_eq!(s["name"], "short");
    assert_eq!(s["brinell"], env!("CARGO_PKG_VERSION"));
    assert_eq!(s["status"], serde_json::json!({ "complete": true }));
    assert_eq!(s["quantities"]["work.samples"]["value"], 7681.0);
    assert_eq!(s["quantities"]["reached"]["value"], 0.3);
    // The law of the paper is fed by its damage; the same words on the terminal.
    let warnings = s["warnings"].as_array().unwrap();
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    let fed = warnings[0].as_str().unwrap();
    assert!(fed.starts_with("parametric work: "), "{fed}");
    assert!(call.out.contains(fed), "{}", call.out);
    let bpfo = s["defect_frequencies"]["hz"]["bpfo"].as_f64().unwrap();
    assert!((bpfo - 131.05).abs() < 0.01, "{bpfo}");
    assert_eq!(s["defects"][0]["line"]["name"], "BPFO");
    let number = |name: &str| s["quantities"][name]["value"].as_f64().unwrap_or_else(|| panic!("{name}"));
    // What the outer ring does at the samples, and what a data logger would hold of it.
    for channel in ["outer_ax", "sensor_ax"] {
        for indicator in ["rms", "peak_to_peak", "kurtosis", "crest_factor"] {
            let e = &s["quantities"][format!("{channel}.{indicator}")];
            assert!(e["unit"].is_string(), "{channel} {indicator}: {e}");
            for member in ["value", "low", "high"] {
                assert!(e[member].is_number(), "{channel} {indicator} {member}: {e}");
            }
        }
    }
    number("row1.cage_slip");
    assert!(s["load_zone"]["static"]["largest_contact_force_n"].as_f64().unwrap() > 0.0);
    assert!(number("work.steps") > 0.0);
    assert!(number("audit.energy_residual_over_turnover").abs() < 0.02);
    assert!(number("audit.momentum_imbalance") < 1e-12);
    // Every value that `check` lists as assumed, and no other.
    let check = brinell(here, &["check", "s.toml", "--assumptions"]).exits(0);
    let listed: Vec<String> = check
        .out
        .lines()
        .skip_while(|line| !line.starts_with("Assumed"))
        .skip(1)
        .map(|line| line.trim().split(' ').next().unwrap().to_owned())
        .collect();
    let assumed: Vec<String> = s["assumed"]
        .as_array()
        .unwrap()
        .iter()
        .map(|a| {
            assert!(a["why"].as_str().is_some_and(|why| !why.is_empty()), "{a}");
            a["key"].as_str().unwrap().to_owned()
        })
        .collect();
    assert_eq!(listed, assumed);
    assert!(assumed.iter().any(|key| key == "operation.load_ramp_s"));
    assert!(!assumed.iter().any(|key| key == "operation.speed_rpm"));
}

#[test]
fn regress_report_stands_alone() {
    // A name that would break out of any element or attribute.
    let name = r#"name = "a\"b'</title><script>x</script>&amp;""#;
    let folder = folder_with("s.toml", &SHORT.replace(r#"name = "short""#, name));
    let args = ["run", "s.toml", "-o", "o", "--signals", "none"];
    brinell(folder.path(), &args).exits(0);
    let html = fs::read_to_string(folder.path().join("o/report.html")).unwrap();
    assert!(!html.contains("<script>x"));
    for outside in ["http:", "https:", "src=", "@import", "<link", "<iframe", "file:"] {
        assert!(!html.contains(outside), "{outside}");
    }
    // Fonts and clips are in the page.
    for resource in html.split("url(").skip(1) {
        let inside = resource.starts_with("data:") || resource.starts_with('#');
        assert!(inside, "{:?}", resource.get(..40));
    }
    // Links lead within the page, to where something is.
    for link in html.split("href=\"").skip(1) {
        let target = link.split('"').next().unwrap();
        if target.starts_with("data:image/png;base64,") {
            // A picture's shades, inside the page.
            continue;
        }
        let id = target.strip_prefix('#').unwrap_or_else(|| panic!("{target}"));
        assert!(html.contains(&format!("id=\"{id}\"")), "{id}");
    }
}

#[test]
fn regress_pictures_for_print_come_with_their_numbers() {
    let folder = folder_with("s.toml", SHORT);
    let here = folder.path();
    let args = ["run", "s.toml", "-q", "--no-report", "-o", "o", "--plots", "pdf,svg", "--width", "9cm"];
    brinell(here, &args).exits(0).keeps_quiet();
    let names = files(&here.join("o"));
    for name in ["plots/waveform.pdf", "plots/waveform.svg", "plots/headline.pdf"] {
        assert!(names.contains(&name.to_owned()), "{names:?}");
    }
    let svg = fs::read_to_string(here.join("o/plots/waveform.svg")).unwrap();
    assert!(svg.contains(" width=\"90mm\""));
    let curve = fs::read_to_string(here.join("o/curves/waveform.csv")).unwrap();
    let head = curve.lines().next().unwrap();
    assert!(head.starts_with("Time (ms),Outer ring acceleration; ") && head.ends_with(" (m/s^2)"), "{head}");
    assert!(curve.lines().count() > 100);
    let bad = ["run", "s.toml", "--plots", "pdf", "--width", "250mm"];
    brinell(here, &bad).exits(2).complains(&["250mm", "--width", "80 to 200 mm"]);
}

#[test]
fn regress_signal_formats_are_what_was_requested() {
    let folder = folder_with("s.toml", &SHORT.replace("0.02", "0.002"));
    let here = folder.path();
    for (formats, expected) in [
        (&[][..], &["signals.parquet"][..]),
        (&["--signals", "none"], &[]),
        (&["--signals", "csv"], &["signals.csv"]),
        (&["--signals", "csv,parquet"], &["signals.csv", "signals.parquet"]),
        (&["--signals", "csv,csv,none"], &["signals.csv"]),
        (&["--signals", "mat,npz,uff58,wav"], &["signals.mat", "signals.npz", "signals.uff", "signals.wav"]),
    ] {
        let output = format!("o{}", formats.join(""));
        let args = [&["run", "s.toml", "--no-report", "-o", &output], formats].concat();
        brinell(here, &args).exits(0).warns_of_the_short_run_alone();
        let mut written = files(&here.join(&output));
        written.retain(|name| name.starts_with("signals"));
        assert_eq!(written, expected, "{formats:?}");
    }
}

#[test]
fn regress_quiet_is_silent_and_the_default_folder_bears_the_name() {
    let folder = tempdir().unwrap();
    let here = folder.path();
    let text = SHORT.replace("\"short\"", "\"../a b/ü\"").replace("0.02", "0.002").replace("25600.0", "1000.0");
    // A sample rate this low is warned about, unless quiet.
    let call = brinell_reading(here, &["run", "-", "-q", "--no-report"], text.as_bytes()).exits(0);
    assert_eq!((call.out.as_str(), call.err.as_str()), ("", ""));
    assert_eq!(files(&here.join("out")), ["_a_b_ü/scenario.toml", "_a_b_ü/signals.parquet", "_a_b_ü/summary.json"]);
    let args = ["run", "-", "--no-report", "--signals", "none"];
    brinell_reading(here, &args, text.as_bytes())
        .exits(0)
        .complains(&["warning, line 19: simulation.sample_rate_hz = 1000.0", "too low"]);
}

/// Names of the recorded columns, and what was said on standard error.
fn columns(here: &Path, record: &str) -> (Vec<String>, String) {
    let args = typed("run s.toml -o o --no-report --overwrite --signals csv --set simulation.duration_s=0.001 --set");
    let call = brinell(here, &[&args[..], &[&format!("simulation.record={record}")]].concat()).exits(0);
    (csv(&here.join("o/signals.csv")).0, call.err)
}

#[test]
fn regress_record_picks_channels_by_wildcards() {
    let folder = folder_with("s.toml", SHORT);
    let here = folder.path();
    let (names, err) = columns(here, r#"["outer_a*", "contact3_*", "roller1_03_*"]"#);
    assert!(names.starts_with(&["t", "outer_ax", "outer_ay"].map(String::from)), "{names:?}");
    for channel in ["r", "x", "y", "ax", "ay", "orbit", "orbit_speed", "spin", "spin_speed", "slip_inner", "slip_outer"]
    {
        assert!(names.contains(&format!("roller1_03_{channel}")), "{channel} in {names:?}");
    }
    assert_eq!(names.len(), 3 + 11, "{names:?}");
    // There is no third row.
    let idle = "warning: simulation.record: \"contact3_*\" matches no channel of this bearing\n";
    assert!(err.contains(idle), "{err}");
    assert_eq!(err.matches("warning: ").count(), 2, "{err}");
    let (names, _) = columns(here, r#"["contact*_outer_length", "pocket1_13_force"]"#);
    assert_eq!(names.len(), 1 + 13 + 1);
    assert_eq!(names[1], "contact1_01_outer_length");
    let (names, _) = columns(here, r#"["*"]"#);
    let unique: std::collections::BTreeSet<_> = names.iter().collect();
    assert_eq!(unique.len(), names.len());
    let (names, err) = columns(here, r#"["nothing"]"#);
    assert_eq!(names, ["t"]);
    assert!(err.contains("\"nothing\" matches no channel"), "{err}");
}

/// Rust ignores SIGPIPE: a closed pipe is an error of the write, and `println!` panics at it.
#[test]
fn regress_a_closed_pipe_is_no_failure() {
    let folder = folder_with("s.toml", &SHORT.replace("speed_rpm", "sped_rpm"));
    for (args, code) in
        [(&["schema"][..], 0), (&["bearing", "list"], 0), (&["check", "s.toml", "--set", "operation.speed_rpm=9"], 2)]
    {
        let mut child = command(folder.path(), args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop((child.stdout.take(), child.stderr.take()));
        assert_eq!(child.wait().unwrap().code(), Some(code), "{args:?}");
    }
}

#[test]
fn regress_a_run_too_short_to_look_for_a_frequency_says_so() {
    let folder = folder_with("s.toml", SHORT);
    let here = folder.path();
    let args = typed("run s.toml -o o --signals none --no-healthy --set simulation.duration_s=0.001");
    let call = brinell(here, &args).exits(0);
    let why = "too short to look for BPFO: 0.1 periods of 24; a duration_s of ";
    call.says(&[why, " would do; pure rolling 131.05 Hz", ", peak to peak of the record "]);
    let summary = json(&here.join("o/summary.json"));
    let found = &summary["quantities"]["defect1.frequency"];
    assert!(
        found["value"].is_null() && summary["defects"][0]["line"]["too_short"].as_str().unwrap().starts_with(why),
        "{summary}"
    );
    let page = fs::read_to_string(here.join("o/report.html")).unwrap();
    assert!(page.contains(why) && page.contains("with the damage; load zone"));
}
