//! `brinell coefficients`: its files agree with each other, and what cannot be is refused.

use crate::common::{brinell, csv, files, folder_with, json, parsed};
use std::path::Path;

/// Deep grooves under the default laws, with damage whose table takes no time.
const BALLS: &str = r#"name = "balls"
[bearing]
preset = "6205"
[operation]
speed_rpm = 1500
load_n = [300, -400]
load_on = "outer-ring"
[[defects]]
on = "outer-raceway"
center_deg = -53
depth_um = 20
shape = { circle = { diameter_mm = 1.5 } }
[simulation]
laws = "li2023"
[contact]
damping_time_us = 2.5
"#;

fn column(path: &Path, name: &str) -> Vec<f64> {
    let (names, rows) = csv(path);
    let at = names.iter().position(|column| column == name).unwrap_or_else(|| panic!("no {name} in {names:?}"));
    rows.iter().map(|row| row[at]).collect()
}

#[test]
fn prop_every_file_has_the_same_coefficients() {
    let folder = folder_with("b.toml", BALLS);
    let here = folder.path();
    let args = ["coefficients", "b.toml", "--speeds", "3000,0:2000:1000", "--loads", "500,1kN", "-o", "out"];
    brinell(here, &args).exits(0).keeps_quiet().says(&["towards -53.13 deg", "40.00 deg", "ross_bearing.py"]);
    assert_eq!(files(&here.join("out")), ["coefficients.csv", "coefficients.json", "force.csv", "ross_bearing.py"]);
    let table = here.join("out/coefficients.csv");
    let of = |name: &str| column(&table, name);
    assert_eq!(of("load_n"), [500.0, 500.0, 500.0, 500.0, 1000.0, 1000.0, 1000.0, 1000.0]);
    assert_eq!(of("speed_rpm"), [0.0, 1000.0, 2000.0, 3000.0, 0.0, 1000.0, 2000.0, 3000.0]);
    let listed = json(&here.join("out/coefficients.json"));
    let ross = std::fs::read_to_string(here.join("out/ross_bearing.py")).unwrap();
    for name in ["kxx_n_per_m", "kxy_n_per_m", "kyx_n_per_m", "kyy_n_per_m", "cxx_ns_per_m", "cyy_ns_per_m"] {
        let values = of(name);
        let rows = listed["rows"].as_array().unwrap();
        assert_eq!(values, rows.iter().map(|row| row[name].as_f64().unwrap()).collect::<Vec<_>>(), "{name}");
        for half in values.chunks(4) {
            assert!(ross.contains(&format!("\"{}\": {half:?}", &name[..3])), "{name}: {half:?} in {ross}");
        }
    }
    // Towards -53 degrees the bearing is stiffer along y, and a push along +x sends it up.
    let [xx, yy, xy, yx] = ["kxx_n_per_m", "kyy_n_per_m", "kxy_n_per_m", "kyx_n_per_m"].map(|name| of(name)[0]);
    assert!(yy > xx && xy < 0.0 && (xy - yx).abs() < 1e-9 * xx, "{xx} {yy} {xy} {yx}");
    assert!(of("displacement_x_um")[0] > 0.0 && of("displacement_y_um")[0] < 0.0);

    // The healthy force is the load, the damaged one less by what the ball at the pit loses.
    let force = here.join("out/force.csv");
    let towards = |x: &str, y: &str| -> Vec<f64> {
        let (x, y) = (column(&force, x), column(&force, y));
        x.iter().zip(&y).map(|(x, y)| 0.6 * x - 0.8 * y).collect()
    };
    let (damaged, healthy) = (towards("fx_n", "fy_n"), towards("healthy_fx_n", "healthy_fy_n"));
    let mean = healthy.iter().sum::<f64>() / healthy.len() as f64;
    assert!((mean - 500.0).abs() < 15.0, "{mean}");
    let lost: Vec<f64> = healthy.iter().zip(&damaged).map(|(a, b)| a - b).collect();
    let most = lost.iter().copied().fold(0.0, f64::max);
    assert!(most > 10.0 && lost.contains(&0.0) && lost.iter().all(|x| *x > -1.0), "{most}");
}

#[test]
fn prop_results_give_way_to_the_next_and_to_nothing_else() {
    let folder = folder_with("b.toml", BALLS);
    let here = folder.path();
    let args = |more: &[&str]| brinell(here, &[&["coefficients", "b.toml", "-o", "out"], more].concat());
    args(&[]).exits(0);
    let first = json(&here.join("out/coefficients.json"));
    // Eleven speeds, to twice the scenario's, under its own load.
    let rows = first["rows"].as_array().unwrap();
    assert_eq!(
        (rows.len(), rows[10]["speed_rpm"].as_f64(), rows[0]["load_n"].as_f64()),
        (11, Some(3000.0), Some(500.0))
    );
    // Without damage no force over the angle, and none of the earlier call's.
    let printed = args(&["--set", "defects=[]", "--speeds", "100", "--json"]).exits(0).out;
    assert_eq!(parsed(&printed), json(&here.join("out/coefficients.json")));
    assert_eq!(files(&here.join("out")), ["coefficients.csv", "coefficients.json", "ross_bearing.py"]);
    brinell(here, &["defect", "preview", "b.toml", "-o", "out"])
        .exits(2)
        .complains(&["brinell coefficients", "--overwrite"]);
    std::fs::write(here.join("out/mine.txt"), "").unwrap();
    args(&[]).exits(2).complains(&["mine.txt"]);
}

#[test]
fn regress_what_cannot_be_is_refused_with_value_and_range() {
    let folder = folder_with("b.toml", BALLS);
    for (more, parts) in [
        (&["--speeds", "-500"][..], &["--speeds -500", "allowed: 0 or more r/min, at most 1e9"][..]),
        (&["--speeds", "0:100"], &["--speeds", "three parts"]),
        (&["--speeds", "fast"], &["--speeds fast", "allowed: 0 or more r/min"]),
        (&["--loads", "100,0"], &["--loads 0", "allowed: more than 0 N"]),
        (&["--loads", "nan"], &["--loads nan", "allowed: more than 0 N"]),
        (&["--speeds", "0:100:0.001"], &["--speeds", "100000 values"]),
        (&["--speeds", "0:1000:1", "--loads", "1:20:1"], &["1001 speeds and 20 loads", "10000 rows"]),
        (&["--set", "operation.load_n=[0,0]"], &["operation.load_n = [0, 0]", "allowed: more than 0 N"]),
        (
            &["--set", "simulation.model=lumped", "--set", "contact={damping_ns_per_m=200}"],
            &["simulation.model = \"lumped\"", "allowed: \"full\""],
        ),
        (&["--set", "simulation.model=full", "-o", "b.toml"], &["b.toml"]),
    ] {
        let call = brinell(folder.path(), &[&["coefficients", "b.toml"], more].concat()).exits(2).complains(parts);
        assert_eq!(call.out, "", "{more:?}");
    }
    brinell(folder.path(), &["init", "--template", "machine", "m.toml"]).exits(0);
    brinell(folder.path(), &["coefficients", "m.toml"]).exits(2).complains(&["[shaft]", "2 bearings", "one bearing"]);
    assert!(!folder.path().join("out").exists());
}
