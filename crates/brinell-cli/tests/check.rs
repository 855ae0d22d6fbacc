//! What `brinell check` says of a scenario, and that `brinell run` repeats its warnings.

use crate::common::{Call, SHORT, brinell, example, folder_with, parsed, typed};
use std::fs;
use std::path::Path;

/// `check` of SHORT, long enough to settle, with settings.
fn check(settings: &[&str]) -> Call {
    call(&[], settings)
}

fn call(options: &[&str], settings: &[&str]) -> Call {
    let folder = folder_with("s.toml", &SHORT.replace("duration_s = 0.02", "duration_s = 0.2"));
    let set = settings.iter().flat_map(|s| ["--set", s]);
    let args = ["check", "s.toml"].into_iter().chain(options.iter().copied()).chain(set);
    brinell(folder.path(), &args.collect::<Vec<_>>())
}

#[test]
fn lit_check_shows_clearance_rating_and_pressure() {
    let call = check(&["operation.load_n=[3650, 0]"]).exits(0).says(&[
        "Clearance 16.25 um on one side, 32.5 um on the diameter; ISO 5753-1 CN for a bore of 30 mm",
        "Rating    C0 = 36.5 kN, 10.0 times the load (SKF General catalogue",
        "MPa at the inner raceway, ",
        "static limit 4000 MPa",
        "ball-pass period        ",
        "MPa at most on the 4.80 mm of contact left on the outer raceway",
    ]);
    // C0 presses the heaviest roller with 4000 MPa where the load zone is half a turn; clearance makes it narrower.
    let line = call.out.lines().find(|l| l.contains("contact pressure"));
    let inner: f64 = line.and_then(|l| l.split_whitespace().nth(2)).and_then(|x| x.parse().ok()).unwrap();
    assert!((4000.0 / 10f64.sqrt()..1700.0).contains(&inner), "{inner}");
    check(&["bearing.clearance_class=C3"])
        .exits(0)
        .says(&["Clearance 23.75 um on one side, 47.5 um on the diameter; ISO 5753-1 C3 for"]);
    check(&["bearing.rollers_per_row=12"]).exits(0).says(&["(estimate by the formula of ISO 76)"]);
}

#[test]
fn prop_check_shows_slices_where_the_load_along_a_roller_is_uneven() {
    let planar = check(&[]).exits(0).says(&[
        "contact pressure ",
        "Static load without damage in 30 slices (ISO/TS 16281), straight rollers; static limit 4000 MPa",
        "pressure, largest ",
        "life L10r ",
    ]);
    assert!(!planar.out.contains("tau_x"), "{}", planar.out);
    let tilting = ["simulation.model=tilting", "bearing.profile=logarithmic"];
    let call = check(&tilting).exits(0).says(&[
        "logarithmic rollers",
        "in the end slices no load",
        "inner ring from outer   tilted by (",
        "over (x, y, tau_x, tau_y) in N/m, N/rad and N m/rad",
    ]);
    // It would be of an even load.
    assert!(!call.out.contains("contact pressure "), "{}", call.out);
    // Straight rollers are pressed at their ends, and a load off the middle presses one end beyond the limit that the
    // even load keeps.
    let off = ["simulation.model=tilting", "operation.load_n=[20000, 0]", "operation.load_offset_mm=10", "defects=[]"];
    let call = check(&off).exits(0);
    let peak = call.out.split("in the end slices ").nth(1).unwrap();
    let peak: f64 = peak.split_whitespace().next().unwrap().parse().unwrap();
    assert!(peak > 4000.0, "{}", call.out);
    assert!(call.err.contains(&format!("the contact pressure reaches {peak:.0} MPa")), "{peak} {}", call.err);
}

#[test]
fn prop_check_as_json_has_the_numbers_of_the_text() {
    let settings = ["simulation.model=tilting", "bearing.profile=logarithmic"];
    let text = check(&settings).exits(0);
    let json = parsed(&call(&["--json"], &settings).exits(0).out);
    let slices = &json["slices"];
    let largest = slices["healthy"]["largest"]["pressure_mpa"].as_f64().unwrap();
    let line = text.out.lines().find(|l| l.contains("pressure, largest")).unwrap();
    let printed: f64 = line.split_whitespace().nth(2).unwrap().parse().unwrap();
    assert!((printed / largest - 1.0).abs() < 1e-3, "{printed} {largest}");
    assert_eq!(slices["healthy"]["stiffness"].as_array().unwrap().len(), 4);
    assert!(slices["life_revolutions"].as_f64().unwrap() > 1e6);
    assert!(json["frequencies_hz"]["bpfo"].as_f64().unwrap() > 0.0);
    let zone = &json["load_zone"];
    let wide = format!("load zone               {:.1} deg wide", zone["extent_deg"].as_f64().unwrap());
    assert!(text.out.contains(&wide), "{wide}\n{}", text.out);
    assert_eq!(zone["ends_deg"].as_array().unwrap().len(), 2);
    assert!(zone["stiffness_n_per_m"][0][0].as_f64().unwrap() > 0.0);
}

#[test]
fn regress_check_prints_numbers_that_can_be_read() {
    let call = check(&["operation.load_n=[0, -2500]", "bearing.radial_clearance_um=-10", "defects=[]"])
        .exits(0)
        .says(&["load zone               360.0 deg wide", "-10 um on one side, -20 um on the diameter: preload"]);
    let after = |name: &str| {
        let line = call.out.lines().find(|l| l.trim_start().starts_with(name));
        line.unwrap_or_else(|| panic!("{name}: {}", call.out)).to_owned()
    };
    // What the solver leaves over is no displacement.
    let shift = after("inner ring from outer");
    assert!(shift.contains("(0, -"), "{shift}");
    assert!(after("bearing stiffness").ends_with("xy 0 N/m"), "{}", call.out);
    // Values are in one column.
    let starts: Vec<usize> = ["healthy contacts", "at ", "loaded ring's support"]
        .iter()
        .map(|name| {
            let line = after(name);
            // Two spaces, a name of up to 23 characters, a space.
            line.len() - line[25..].trim_start().len()
        })
        .collect();
    assert_eq!(starts, [26, 26, 26], "{}", call.out);
    check(&["operation.speed_rpm=-1500"]).exits(0).says(&["in pure rolling, at 1500 r/min, clockwise"]).keeps_quiet();
}

#[test]
fn regress_check_and_run_warn_alike() {
    check(&["defects.0.center_deg=180"]).exits(0).complains(&["warning", "outside the load zone"]);
    let folder = folder_with("s.toml", SHORT);
    let args = typed("run s.toml -o o --signals none --set defects.0.center_deg=180");
    brinell(folder.path(), &args).exits(0).complains(&["outside the load zone", "too short to settle"]);
    let summary = fs::read_to_string(folder.path().join("o/summary.json")).unwrap();
    let page = fs::read_to_string(folder.path().join("o/report.html")).unwrap();
    for text in [summary, page] {
        assert!(text.contains("outside the load zone") && text.contains("too short to settle"));
    }
}

#[test]
fn prop_a_plan_in_place_of_a_scenario_is_said_to_be_one() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let data_set = ["init", "plan.toml", "--template", "data-set"];
    brinell(here, &data_set).exits(0);
    for command in ["check", "run"] {
        let call = brinell(here, &[command, "plan.toml"])
            .exits(2)
            .complains(&["plan.toml is no scenario but the plan of a data set", "brinell dataset plan.toml --dry-run"]);
        assert_eq!(call.err.lines().count(), 1, "{call:?}");
    }
    // A scenario with keys that it must not have stays one.
    std::fs::write(here.join("s.toml"), "base = \"x\"\nruns = 2\n[bearing]\n").unwrap();
    brinell(here, &["check", "s.toml"]).exits(2).complains(&["unknown key", "preset"]);
}

#[test]
fn regress_damage_outside_the_load_zone_has_no_pressure_of_the_heaviest_roller() {
    let beside = "beside the damage";
    assert!(check(&["operation.load_n=[300, 0]"]).exits(0).out.contains(beside));
    assert!(!check(&["operation.load_n=[-300, 0]"]).exits(0).out.contains(beside));
}

#[test]
fn regress_a_held_ring_has_no_support_frequency() {
    let held = check(&["simulation.model=lumped", "operation.load_on=inner-ring"]).exits(0).out;
    assert!(held.contains("ring on its support     inner ") && !held.contains("rings on their supports"), "{held}");
}

#[test]
fn regress_round_off_is_no_tilt() {
    let tilting = ["--set", "simulation.model=tilting", "--set", "defects=[]"];
    let file = example("single-row.toml");
    let args = [&["check", &file[..]], &tilting[..]].concat();
    brinell(Path::new("."), &args).exits(0).says(&["tilted by (0, 0) urad; rollers by up to 0 urad"]);
}
