//! Scenarios side by side: what comes out, that a run beside itself is itself, and what is refused.

use crate::common::{brinell, files, json, same, typed, with_blocks};
use brinell_io::{Cell, read_records};
use std::fs;
use tempfile::TempDir;

/// Two scenarios of nine turns of the shaft, so that indicators have intervals.
fn folder() -> TempDir {
    let folder = with_blocks("actual.toml");
    let text = fs::read_to_string(folder.path().join("actual.toml")).unwrap();
    let simple = text.replace("length_mm = 2.0", "length_mm = 3.0");
    fs::write(folder.path().join("simple.toml"), simple).unwrap();
    folder
}

#[test]
fn regress_files_and_variants_come_side_by_side() {
    let folder = folder();
    let variant = "lumped:simulation.model=lumped;defects.0.depth_um=10";
    let args = format!("compare actual.toml simple.toml -o out --plots svg --variant {variant}");
    brinell(folder.path(), &typed(&args))
        .exits(0)
        .says(&["simple over actual (the baseline), ratios:", "lumped over actual (the baseline), ratios:"])
        .says(&["sensor_ax.rms: ", "(95 %, scatter only: "]);
    let out = folder.path().join("out");
    let names = files(&out);
    let results =
        "compare.csv compare.html compare.json compare.parquet scenarios/1-actual.toml scenarios/3-lumped.toml";
    let plots = "plots/waveform.svg plots/spectrum.svg plots/defect1-length.svg plots/defect1-entry.svg";
    for name in [typed(results), typed(plots)].concat() {
        assert!(names.iter().any(|there| there == name), "no {name} in {names:?}");
    }
    let json = json(&out.join("compare.json"));
    assert_eq!(json["baseline"], "actual");
    let rms = &json["quantities"]["sensor_ax.rms"];
    let value = |label: &str| rms["runs"][label]["value"].as_f64().unwrap();
    assert!(value("actual") > 0.0 && value("simple") > 0.0 && value("lumped") > 0.0);
    let ratio = &rms["ratios"]["simple"];
    let number = |key: &str| ratio[key].as_f64().unwrap();
    assert!(number("low") < number("value") && number("value") < number("high"));
    assert!(rms["ratios"].get("actual").is_none());
    assert!(json["scenarios"]["lumped"].as_str().unwrap().contains("model = \"lumped\""));
    // Names may break after their points on a phone.
    let page = fs::read_to_string(out.join("compare.html")).unwrap().replace("<wbr>", "");
    for part in [
        "What differs",
        "simulation.model",
        "Entry and exit",
        "simple / actual",
        ">instantaneous</td>",
        ">anti-aliased</td>",
    ] {
        assert!(page.contains(part), "no {part}");
    }
    // Values travel in base64, which may spell anything.
    let parts = page.split("<script");
    let seen: String = parts.filter_map(|part| part.rsplit("</script>").next()).collect();
    assert!(!seen.contains("NaN"));
}

#[test]
fn regress_runs_without_a_common_sensor_are_told_where_the_rest_is() {
    let folder = folder();
    // The lumped model's outer ring does not move where the load is on the inner one: it has no sensor.
    let text = fs::read_to_string(folder.path().join("actual.toml")).unwrap();
    let text = text.replace("[operation]\n", "[operation]\nload_on = \"inner-ring\"\n");
    fs::write(folder.path().join("inner.toml"), text).unwrap();
    let args = typed("compare inner.toml -o out --variant lumped:simulation.model=lumped");
    let call = brinell(folder.path(), &args).exits(0);
    assert!(!call.out.contains("ratios:"), "{}", call.out);
    call.says(&["lumped over inner (the baseline): the sensor's levels", "are in compare.csv and compare.html"]);
}

#[test]
fn prop_runs_whose_loads_lie_along_different_axes_are_compared_along_their_loads() {
    let folder = folder();
    let text = fs::read_to_string(folder.path().join("actual.toml")).unwrap();
    fs::write(folder.path().join("right.toml"), &text).unwrap();
    let down = text.replace("load_n = [300.0, 0.0]", "load_n = [0.0, -300.0]");
    assert_ne!(down, text);
    fs::write(folder.path().join("down.toml"), down).unwrap();
    let call = brinell(folder.path(), &typed("compare right.toml down.toml -o out --plots svg")).exits(0);
    assert!(!call.out.contains("sensor_ax.rms"), "{}", call.out);
    let call = call
        .says(&["sensor.rms on the axis nearer the load (sensor_ay over sensor_ax): "])
        .complains(&["the loads point along different axes"]);
    let page = fs::read_to_string(folder.path().join("out/compare.html")).unwrap();
    for part in ["right (sensor_ax)", "down (sensor_ay)", "RMS of the sensor on the axis nearer each run’s load"] {
        assert!(page.contains(part), "no {part}");
    }
    // What a curve's column is called is what it holds.
    let json = json(&folder.path().join("out/compare.json"));
    let rms = |channel: &str, run: &str| json["quantities"][channel]["runs"][run]["value"].as_f64().unwrap();
    let along = rms("sensor_ay.rms", "down") / rms("sensor_ax.rms", "right");
    let said = call.out.lines().find(|line| line.contains("sensor.rms")).unwrap().to_owned();
    let said: f64 = said.split("): ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!((said / along - 1.0).abs() < 0.01, "{said} is not {along}");
    let curves = fs::read_dir(folder.path().join("out/curves")).unwrap();
    let heads: Vec<String> = curves
        .map(|file| fs::read_to_string(file.unwrap().path()).unwrap().lines().next().unwrap().to_owned())
        .filter(|head| head.contains("Sensor acceleration"))
        .collect();
    assert!(heads.iter().any(|head| head.contains("down (sensor_ay)")), "{heads:?}");
}

#[test]
fn prop_the_folder_of_a_run_stands_for_its_scenario() {
    let folder = folder();
    brinell(folder.path(), &typed("run simple.toml --no-report --no-healthy --signals none -q -o runs/simple.1"))
        .exits(0);
    brinell(folder.path(), &typed("compare actual.toml runs/simple.1 -q -o out")).exits(0);
    let of_folder = json(&folder.path().join("out/compare.json"));
    brinell(folder.path(), &typed("compare actual.toml simple.toml -q -o file")).exits(0);
    let of_file = json(&folder.path().join("file/compare.json"));
    let value = |json: &serde_json::Value, run: &str| json["quantities"]["sensor_ax.rms"]["runs"][run]["value"].clone();
    assert!(value(&of_file, "simple").is_number());
    assert_eq!(value(&of_folder, "simple.1"), value(&of_file, "simple"));
}

#[test]
fn prop_a_run_beside_itself_is_itself_on_any_number_of_threads() {
    let folder = folder();
    let args = typed("compare actual.toml --variant again:name=twin -o");
    for (out, jobs) in [("one", "1"), ("two", "2")] {
        let args: Vec<&str> = args.iter().copied().chain([out, "-q", "-j", jobs]).collect();
        brinell(folder.path(), &args).exits(0).keeps_quiet();
    }
    same(&folder.path().join("one"), &folder.path().join("two"));
    let columns = ["actual", "again", "again.ratio"];
    let rows = read_records(folder.path().join("one/compare.parquet"), &columns, |_| true).unwrap();
    assert!(rows.iter().all(|row| row[0] == row[1] && [Cell::Empty, Cell::Number(1.0)].contains(&row[2])));
    assert!(rows.iter().filter(|row| row[2] != Cell::Empty).count() > 100);
}

#[test]
fn prop_what_check_warns_of_is_said_of_the_runs_and_on_the_page() {
    let folder = folder();
    brinell(folder.path(), &typed("compare actual.toml simple.toml --variant above:defects.0.center_deg=180 -o out"))
        .exits(0)
        .complains(&["center_deg = 180.0 (defect 1): this damage is outside the load zone"])
        .complains(&["(in 1 of 3 runs looked at, the first of them run above)"]);
    let page = fs::read_to_string(folder.path().join("out/compare.html")).unwrap();
    assert!(page.contains("(in 1 of 3 runs looked at, the first of them run above)"));
}

#[test]
fn prop_what_a_run_warns_of_is_said_once_with_its_runs_on_the_terminal_the_page_and_in_the_json() {
    let folder = folder();
    let hi = ["--variant", "hi:simulation.sample_rate_hz=51200"];
    let args = [&typed("compare actual.toml simple.toml -o out")[..], &hi].concat();
    let call = brinell(folder.path(), &args).exits(0);
    let warned: Vec<String> = ["parametric work: ", "are of different bandwidths"].map(str::to_owned).into();
    let told = "(in 3 of 3 runs looked at, the first of them run actual)";
    let page = fs::read_to_string(folder.path().join("out/compare.html")).unwrap();
    let json = json(&folder.path().join("out/compare.json"))["warnings"].to_string();
    for words in warned.iter().map(String::as_str).chain([told]) {
        for text in [&call.err, &json, &page] {
            assert_eq!(text.matches(words).count(), 1, "{words}: {}{json}", call.err);
        }
    }
    // Of one sample rate levels are of one bandwidth.
    let call = brinell(folder.path(), &typed("compare actual.toml simple.toml -o same")).exits(0);
    assert!(!call.err.contains("bandwidths"), "{}", call.err);
}

#[test]
fn regress_scenarios_that_are_called_alike_are_named_by_their_folders() {
    let folder = folder();
    for name in ["a", "b", "1", "2"] {
        fs::create_dir(folder.path().join(name)).unwrap();
        fs::copy(folder.path().join("actual.toml"), folder.path().join(name).join("scenario.toml")).unwrap();
    }
    // From within one's folder, and of folders that are numbers.
    for (from, scenarios, columns) in [
        ("a", "scenario.toml ../b/scenario.toml", ["scenario", "b", "b.ratio"]),
        ("b", "../1/scenario.toml ../2/scenario.toml", ["1/scenario", "2/scenario", "2/scenario.ratio"]),
    ] {
        let from = folder.path().join(from);
        brinell(&from, &typed(&format!("compare {scenarios} -q -o out"))).exits(0);
        let rows = read_records(from.join("out/compare.parquet"), &columns, |_| true).unwrap();
        assert!(rows.iter().any(|row| row[2] == Cell::Number(1.0)));
    }
}

#[test]
fn regress_what_cannot_be_compared() {
    let folder = folder();
    let call = |more: &[&str]| {
        let args: Vec<&str> = ["compare", "actual.toml"].iter().chain(more).copied().collect();
        brinell(folder.path(), &args).exits(2)
    };
    call(&[]).complains(&["1 to compare", "allowed: 2 to 6 scenarios and variants"]);
    call(&["--variant", "x"]).complains(&["--variant x: expected NAME:KEY=VALUE"]);
    call(&["--variant", "a=b:c"]).complains(&["expected NAME:KEY=VALUE"]);
    call(&["--variant", "x:a"]).complains(&["expected KEY=VALUE"]);
    call(&["--variant", "5:name=x"]).complains(&["`5` cannot name a run"]);
    // Of the same name in other folders, each is called by its folder.
    for name in ["a", "b"] {
        fs::create_dir(folder.path().join(name)).unwrap();
        fs::copy(folder.path().join("actual.toml"), folder.path().join(name).join("actual.toml")).unwrap();
    }
    brinell(folder.path(), &["compare", "a/actual.toml", "b/actual.toml", "--variant", "b:name=x"])
        .exits(2)
        .complains(&["two runs would be called b"]);
    call(&["actual.toml"]).complains(&["two runs would be called actual"]);
    call(&["--variant", "x:operation.speed_rpm=\"fast\""]).complains(&["operation.speed_rpm"]);
    // Found before anything runs, not when the table is written.
    for name in ["unit", "actual.low"] {
        let variant = format!("{name}:operation.speed_rpm=1000");
        call(&["--variant", &variant])
            .complains(&[&format!("two columns would be called {name}: rename a file or a variant")]);
    }
    call(&["--variant", "x:name=a; name=b"]).complains(&["name is set twice"]);
    call(&["none.toml"]).complains(&["cannot read none.toml"]);
    fs::create_dir(folder.path().join("empty")).unwrap();
    call(&["empty"]).complains(&["cannot read empty/scenario.toml"]);
    assert!(!folder.path().join("out").exists());
}
