//! Machines, as their user meets them: a template, `check`, `run`, `analyze`, a sweep; and what is not of a machine says so.

use crate::common::{brinell, csv, json, typed};
use std::fs;
use std::path::Path;
use tempfile::{TempDir, tempdir};

fn with(template: &str) -> TempDir {
    let folder = tempdir().unwrap();
    let args = ["init", "m.toml", "--template", template];
    brinell(folder.path(), &args).exits(0).keeps_quiet().says(&["wrote m.toml"]);
    folder
}

fn short(folder: &Path, more: &[&str]) {
    let run =
        ["run", "m.toml", "-o", "o", "-q", "--signals", "csv", "--set", "simulation.duration_s=0.3", "--overwrite"];
    brinell(folder, &[&run[..], more].concat()).exits(0);
}

#[test]
fn prop_templates_of_machines_pass_check_and_tell_what_each_bearing_carries() {
    for (template, sensors) in [
        ("motor", ["housing1.drive_end", "housing1.fan_end"]),
        ("machine", ["housing1.coupling_end", "housing2.fan_end"]),
    ] {
        let folder = with(template);
        let here = folder.path();
        assert!(
            fs::read_to_string(here.join("m.toml")).unwrap().starts_with("#:schema ./brinell-machine-schema.json\n")
        );
        let schema = brinell(here, &["schema", "--machine"]).exits(0).out;
        assert_eq!(fs::read_to_string(here.join("brinell-machine-schema.json")).unwrap(), schema);
        let words =
            ["the machine is valid", "Critical speeds", "Bearing 2 at Z = ", "carries", "misaligned by", "BPFO"];
        brinell(here, &["check", "m.toml"]).exits(0).keeps_quiet().says(&words);
        let told: serde_json::Value =
            serde_json::from_str(&brinell(here, &["check", "m.toml", "--json"]).exits(0).out).unwrap();
        // Loads and the shaft's weight are all that they carry, but for a coupling.
        let up = |k: usize| told["bearings"][k]["force_n"][1].as_f64().unwrap();
        let load = if template == "motor" { 300.0 } else { 0.0 };
        let whole = load + told["shaft_weight_n"].as_f64().unwrap();
        assert!((-up(0) - up(1) - whole).abs() < 0.05 * whole, "{} {} {whole}", up(0), up(1));
        short(here, &[]);
        let (names, rows) = csv(&here.join("o/signals.csv"));
        assert!(sensors.iter().all(|sensor| names.iter().any(|name| name == sensor)), "{names:?}");
        assert!(names.iter().any(|name| name == "shaft.x3") && names.iter().any(|name| name == "bearing2.outer_ay"));
        assert!(rows.iter().flatten().all(|x| x.is_finite()));
        // What it wrote is the same run.
        brinell(here, &["run", "o/scenario.toml", "-o", "again", "-q", "--signals", "csv", "--no-report"]).exits(0);
        assert!(fs::read(here.join("o/signals.csv")).unwrap() == fs::read(here.join("again/signals.csv")).unwrap());
        let page = fs::read_to_string(here.join("o/report.html")).unwrap();
        assert!(page.contains("Campbell diagram") && page.contains(sensors[1]));
    }
}

#[test]
fn prop_a_sensor_is_read_by_the_bearing_nearest_to_it() {
    let folder = with("motor");
    let here = folder.path();
    brinell(here, &["run", "m.toml", "-o", "o", "-q", "--signals", "csv", "--no-report", "--no-healthy"]).exits(0);
    let words = ["bearing 1 (6205) of the machine", "damage on: outer-raceway of bearing 1", "Outer race damage"];
    brinell(here, &["analyze", "o"]).exits(0).says(&words);
    let fan = ["analyze", "o", "--channel", "housing1.fan_end"];
    brinell(here, &fan).exits(0).says(&["bearing 2 (6203) of the machine", "damage on: outer-raceway of bearing 1"]);
    // Of the machine either bearing may be asked about.
    let other = [&fan[..], &["--bearing", "6205"]].concat();
    brinell(here, &other).exits(0).keeps_quiet();
    brinell(here, &[&fan[..], &["--bearing", "NU206"]].concat()).exits(0).complains(&["is of another bearing"]);
}

#[test]
fn prop_a_sweep_and_a_comparison_of_machines_tell_the_sensors() {
    let folder = with("motor");
    let here = folder.path();
    let short = "--set simulation.duration_s=0.2 --set contact.tables=coarse";
    let sweep = format!(
        "sweep m.toml --vary shaft.unbalance.0.size_g_mm=10,400 --set operation.speed_rpm=6000 --set bearing.0.defects=[] {short} -o s -q"
    );
    brinell(here, &typed(&sweep)).exits(0);
    let table = fs::read_to_string(here.join("s/sweep.csv")).unwrap();
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = lines.next().unwrap();
    let at = names.iter().position(|name| *name == "housing1.fan_end.rms").unwrap();
    let levels: Vec<f64> = lines.map(|cells| cells[at].parse().unwrap()).collect();
    assert!(levels[1] > levels[0], "{levels:?}");
    assert!(fs::read_to_string(here.join("s/sweep.html")).unwrap().contains("housing1.drive_end"));
    fs::copy(here.join("m.toml"), here.join("n.toml")).unwrap();
    brinell(here, &typed(&format!("compare m.toml n.toml {short} -o c"))).exits(0).says(&["housing1.drive_end.rms"]);
}

const PLAN: &str = r#"name = "ends"
base = "m.toml"
runs = 6
seed = 3
runs_per_file = 6
licence = "CC0-1.0"
signals = ["housing1.*"]
[vary]
simulation.duration_s = 0.1
contact.tables = "coarse"
shaft.unbalance.0.size_g_mm = { uniform = [5, 80] }
[[classes]]
name = "healthy"
defects = []
[[classes]]
name = "drive end"
[[classes.defects]]
on = "outer-raceway"
center_deg = -90
depth_um = { uniform = [5, 20] }
shape.rectangle = { length_mm = 1, width_mm = 2 }
[[classes]]
name = "fan end"
bearing = 2
[[classes.defects]]
on = "inner-raceway"
depth_um = 10
shape.rectangle = { length_mm = 1, width_mm = 2 }
"#;

#[test]
fn prop_a_data_set_of_a_machine_says_which_bearing_is_damaged() {
    let folder = with("motor");
    let here = folder.path();
    fs::write(here.join("plan.toml"), PLAN).unwrap();
    brinell(here, &["dataset", "plan.toml", "-o", "d", "-q"]).exits(0);
    let about = json(&here.join("d/dataset.json"));
    let columns = about["columns"].as_array().unwrap();
    for name in ["housing1.drive_end", "damaged_bearing", "bearings", "shaft.unbalance.0.size_g_mm"] {
        assert!(columns.iter().any(|column| column["name"] == name), "{name}");
    }
    let rows = crate::dataset::rows(&here.join("d/runs/part-00000.parquet"));
    assert_eq!(rows.len(), 6);
    for row in &rows {
        let class = crate::dataset::text(row, "class").unwrap();
        let number = match class.as_str() {
            "healthy" => 0,
            "drive end" => 1,
            _ => 2,
        };
        assert_eq!(crate::dataset::whole(row, "damaged_bearing"), number, "{class}");
        assert_eq!(crate::dataset::text(row, "bearing").as_deref(), Some("6205"));
    }
}

#[test]
fn regress_what_is_of_one_bearing_says_so() {
    let folder = with("motor");
    let here = folder.path();
    brinell(here, &["init", "a.toml", "--template", "motor", "--bearing", "6205"])
        .exits(2)
        .complains(&["--bearing is of templates of one bearing"]);
    brinell(here, &["init", "a.toml", "--template", "machine", "--full"])
        .exits(2)
        .complains(&["brinell schema --machine"]);
    brinell(here, &["coefficients", "m.toml", "--loads", "100", "--speeds", "1000", "-o", "k"])
        .exits(2)
        .complains(&["machine"]);
    let beyond = ["check", "m.toml", "--set", "bearing.1.at_mm=400"];
    brinell(here, &beyond).exits(2).complains(&[
        "bearing.1.at_mm = 400",
        "beyond the shaft's ends",
        "allowed: 0.0 to 300.0 mm",
    ]);
    fs::write(here.join("modes.csv"), "frequency_hz,damping_ratio,bearing1_x,bearing1_y,bearing2_x,bearing2_y,drive_end,fan_end\n250,0.02,0,0.2,0,0.2,0.2,0.2\n").unwrap();
    let text = fs::read_to_string(here.join("m.toml")).unwrap();
    let (before, rest) = text.split_once("[[housing]]").unwrap();
    let (_, after) = rest.split_once("[[sensor]]").unwrap();
    let by_modes = format!("{before}[[housing]]\nmodes = \"modes.csv\"\n\n[[sensor]]{after}");
    fs::write(here.join("m.toml"), &by_modes).unwrap();
    short(here, &["--no-report"]);
    fs::write(here.join("modes.csv"), "frequency_hz,damping_ratio\n250,0.02\n").unwrap();
    brinell(here, &["check", "m.toml"])
        .exits(2)
        .complains(&["housing.0.modes = \"modes.csv\"", "line 1: there is no column bearing1_x"]);
}
