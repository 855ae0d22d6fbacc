//! `brinell defect`: what it prints reads back, what it measures is right, what is wrong is reported.

use crate::common::{brinell, example, json};
use std::path::Path;

const HEAD: &str = "name = \"t\"\n[bearing]\npreset = \"NN3007\"\n[operation]\nspeed_rpm = 1800.0\n\
    load_n = [300.0, 0.0]\nload_on = \"outer-ring\"\n[simulation]\nlaws = \"li2023\"\nduration_s = 0.1\n";
const SQUARE_WITH_A_HOLE: &str = "[[defects]]\non = \"outer-raceway\"\ndepth_um = 8.0\n\
    shape = { outline = { polygons_mm = [[[-2, -2], [2, -2], [2, 2], [-2, 2]], [[-1, -1], [1, -1], [1, 1], [-1, 1]]] } }\n";

/// What a command that must succeed prints.
#[track_caller]
fn out(args: &[&str]) -> String {
    brinell(Path::new("."), args).exits(0).out
}

fn scenario(folder: &Path, name: &str, defects: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, format!("{HEAD}{defects}")).unwrap();
    path.display().to_string()
}

/// preview.json of a scenario.
fn preview_of(folder: &Path, scenario: &str, set: &[&str]) -> serde_json::Value {
    let args = ["defect", "preview", scenario, "-o", "preview", "--formats", "svg"];
    brinell(folder, &[&args, set].concat()).exits(0);
    json(&folder.join("preview/preview.json"))
}

/// The same under the paper's laws.
fn preview(folder: &Path, scenario: &str) -> serde_json::Value {
    preview_of(folder, scenario, &["--set", "simulation.laws=li2023"])
}

/// A curve of a preview's passage.
fn curve(preview: &serde_json::Value, name: &str) -> Vec<f64> {
    let values = preview["defects"][0]["passage"][name].as_array();
    values.unwrap_or_else(|| panic!("no {name}")).iter().map(|x| x.as_f64().unwrap()).collect()
}

fn number(json: &serde_json::Value, key: &str) -> f64 {
    json["defects"][0][key].as_f64().unwrap()
}

#[test]
fn analytic_preview_measures_closed_forms() {
    let folder = tempfile::tempdir().unwrap();
    let circle = preview(folder.path(), &example("circle.toml"));
    assert!((number(&circle, "area_mm2") / (std::f64::consts::PI * 2.25 * 2.25) - 1.0).abs() < 1e-5);
    assert!((number(&circle, "arc_deg") - (4.5f64 / 27.5).to_degrees()).abs() < 1e-9);
    let hole = scenario(folder.path(), "hole.toml", SQUARE_WITH_A_HOLE);
    let hole = preview(folder.path(), &hole);
    assert!((number(&hole, "area_mm2") - 12.0).abs() < 1e-3);
    assert!((number(&hole, "widest_mm") - 4.0).abs() < 1e-9);
    let curve = |name| curve(&hole, name);
    let (damaged, left) = (curve("length_damaged_l_s_mm"), curve("length_in_contact_l_e_mm"));
    assert!(damaged.iter().zip(&left).all(|(a, b)| (a + b - 6.0).abs() < 1e-12));
    assert!(damaged.iter().all(|x| [0.0, 2.0, 4.0].iter().any(|y| (x - y).abs() < 1e-9)));
    // Below the floor K is that of the remaining length, Eq. (23).
    let k = curve("stiffness_k_point_n_m_10_9");
    let healthy = k[0];
    for (k, l) in k.iter().zip(&left) {
        assert!((k / healthy - (l / 6.0).powf(8.0 / 9.0)).abs() < 1e-9);
    }
    // An envelope is never deeper.
    let (point, envelope) = (curve("depth_h_s_point_um"), curve("depth_h_s_envelope_um"));
    assert!(point.iter().zip(&envelope).all(|(p, e)| *e <= p + 1e-9));
    for file in ["damage-1.svg", "damage-1-passage.svg", "damage-1-passage.csv", "damage-1-section.csv"] {
        assert!(folder.path().join("preview").join(file).exists(), "{file}");
    }
}

#[test]
fn analytic_a_rollers_preview_holds_both_contacts() {
    let folder = tempfile::tempdir().unwrap();
    let json = preview(folder.path(), &example("roller.toml"));
    let curve = |name: &str| curve(&json, name);
    // 1 mm of a roller of 3 mm radius; the envelope's parabola has the contact's relative radius.
    let angle = curve("angle_deg");
    for (side, curvature) in [("outer", 1.0 / 3.0 - 1.0 / 27.5), ("inner", 1.0 / 3.0 + 1.0 / 21.5)] {
        let depth = curve(&format!("depth_h_s_envelope_{side}_contact_um"));
        for (u, h) in angle.iter().zip(depth) {
            let from_edge = (0.5 - 3.0 * u.to_radians().abs()).max(0.0);
            let exact = (0.5e3 * from_edge * from_edge * curvature).min(20.0);
            assert!((h - exact).abs() < 1e-6, "{side} at {u}: {h} {exact}");
        }
        // Below the floor two of six millimetres carry.
        let k = curve(&format!("k_{side}_contact_point_n_m_10_9"));
        let least = k.iter().copied().fold(f64::INFINITY, f64::min);
        assert!((least / k[0] - (2.0f64 / 6.0).powf(8.0 / 9.0)).abs() < 1e-9);
    }
    assert!((curve("k_outer_contact_point_n_m_10_9")[0] / 1.898e8 - 1.0).abs() < 1e-9);
    assert!((curve("k_inner_contact_point_n_m_10_9")[0] / 1.828e8 - 1.0).abs() < 1e-9);
    assert!(!folder.path().join("preview/damage-1-section.svg").exists());
}

#[test]
fn prop_a_preview_under_half_space_is_of_its_tables() {
    let folder = tempfile::tempdir().unwrap();
    let json = preview_of(folder.path(), &example("ball-6205.toml"), &[]);
    let curve = |name: &str| curve(&json, name);
    let (effective, healthy) = (curve("effective_delta_damaged_um"), curve("effective_delta_healthy_delta_um"));
    let (force, pressed) = (curve("q_q_0_at_the_static_deformation"), curve("q_q_0_at_twice_it"));
    assert!(healthy.iter().all(|x| (x - number(&json, "approach_um")).abs() < 1e-9));
    // Healthy where the pit is out of reach; over it the ball carries less, and the less the lighter it is pressed.
    for k in [0, force.len() - 1] {
        // The table's splines swing by a millionth beside its ends.
        assert!((effective[k] / healthy[k] - 1.0).abs() < 1e-5, "{} {}", effective[k], healthy[k]);
        assert!((force[k] - 1.0).abs() < 1e-3 && (pressed[k] - 1.0).abs() < 1e-2, "{} {}", force[k], pressed[k]);
    }
    let middle = force.len() / 2;
    assert!(effective[middle] < 0.99 * healthy[middle]);
    assert!(force[middle] < pressed[middle] && pressed[middle] < 1.0, "{} {}", force[middle], pressed[middle]);
    let note = json["defects"][0]["passage_note"].as_str().unwrap();
    assert!(note.contains("law half-space") && note.is_ascii(), "{note}");
    assert!(!note.contains("paths side by side"));
    let pressures = json["defects"][0]["pressure"].as_array().unwrap();
    let [of] = &pressures[..] else { panic!("{} pressures", pressures.len()) };
    let value = |key: &str| of[key].as_f64().unwrap();
    let numbers =
        |of: &serde_json::Value| of.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect::<Vec<_>>();
    let [s, z] = ["s_mm", "z_mm"].map(|axis| numbers(&of["cells"][axis]));
    let rows: Vec<Vec<f64>> = of["cells"]["pressure_mpa"].as_array().unwrap().iter().map(numbers).collect();
    assert!(rows.len() == z.len() && rows.iter().all(|row| row.len() == s.len()));
    // Means over cells times their area are the force, which is the passage's where the ball is.
    let area = (s[1] - s[0]) * (z[1] - z[0]);
    assert!((rows.iter().flatten().sum::<f64>() * area / value("force_n") - 1.0).abs() < 1e-9);
    let angle = curve("angle_deg");
    let at = angle.partition_point(|u| u.to_radians() * 19.525 < value("contact_at_s_mm"));
    let healthy = number(&json, "heaviest_contact_n");
    assert!((value("force_n") / (healthy * force[at]) - 1.0).abs() < 0.02, "{} {}", value("force_n"), force[at]);
    let row = z.iter().position(|z| (z - value("z_mm")).abs() < 1e-9).unwrap();
    let column = s.iter().position(|s| (s - value("s_mm")).abs() < 1e-9).unwrap();
    assert_eq!(rows[row][column], value("largest_pressure_mpa"));
    assert!(rows.iter().flatten().all(|p| (0.0..=value("largest_pressure_mpa")).contains(p)));
    assert!(value("largest_pressure_mpa") > 1.5 * value("healthy_pressure_mpa"));
    // At the pit's edge it grows as cells shrink: whether a few of them are beyond hangs on the grid.
    let beyond = rows.iter().flatten().any(|p| *p > 3040.0);
    let share = value("share_beyond_yield");
    assert!(value("yield_begins_at_mpa") == 3040.0 && (share > 0.0) == beyond && share < 0.02, "{share}");
    let picture = folder.path().join("preview/damage-1-pressure.svg");
    assert!(picture.exists());
    // The paper's laws know none.
    let without = preview(folder.path(), &example("rectangle.toml"));
    assert_eq!(without["defects"][0]["pressure"].as_array().map(Vec::len), Some(0));
    assert!(!picture.exists());
}

#[test]
fn prop_what_is_printed_reads_back_with_the_same_area() {
    let folder = tempfile::tempdir().unwrap();
    let spall = out(&["defect", "random", "--seed", "7", "--length-mm", "4", "--width-mm", "3", "--roughness", "0.7"]);
    let sources = [
        example("rectangle.toml"),
        example("circle.toml"),
        example("irregular.toml"),
        scenario(folder.path(), "hole.toml", SQUARE_WITH_A_HOLE),
        scenario(folder.path(), "spall.toml", &spall),
    ];
    for source in &sources {
        let seen = preview(folder.path(), source);
        for command in [
            &["convert", "--to", "profile"][..],
            &["convert", "--to", "outline"],
            &["simplify", "--to", "equal-area-rectangle"],
            &["simplify", "--to", "equal-area-circle"],
            &["fit", "--toml"],
        ] {
            let mut args = vec!["defect", command[0], source];
            args.extend(&command[1..]);
            let printed = out(&args);
            let again = scenario(folder.path(), "again.toml", &printed);
            // An outline and a width along s are those of the nodes of a grid, a simple shape that of its surface.
            let kept = if command[0] == "simplify" { "area_mm2" } else { "area_in_ecl_mm2" };
            let off = number(&preview(folder.path(), &again), "area_mm2") / number(&seen, kept) - 1.0;
            assert!(off.abs() < 3e-3, "{command:?} of {source}: area off by {off}");
        }
    }
}

#[test]
fn lit_the_bounding_rectangle_of_the_papers_shape_is_seven_by_four() {
    let printed = out(&["defect", "simplify", &example("irregular.toml"), "--to", "bounding-rectangle"]);
    let folder = tempfile::tempdir().unwrap();
    let again = scenario(folder.path(), "again.toml", &printed);
    let json = preview(folder.path(), &again);
    assert!((number(&json, "length_mm") - 7.0).abs() < 5e-3);
    assert!((number(&json, "widest_mm") - 4.0).abs() < 1e-3);
}

#[test]
fn lit_the_fit_is_the_papers_six_segments_and_states_its_error() {
    let text = out(&["defect", "fit", &example("irregular.toml")]);
    assert!(text.starts_with("6 segments, order 5, 113 samples each"), "{text}");
    assert!(text.contains("fit error: width rms") && text.contains("segment 6:"), "{text}");
}

#[test]
fn regress_bad_input_ends_with_two_and_says_what_is_allowed() {
    let irregular = example("irregular.toml");
    let healthy = example("healthy.toml");
    let scan = example("scan.toml");
    for (args, words) in [
        (&["preview", &irregular, "--defect", "0"][..], "defects 1 to 1"),
        (&["preview", &healthy], "no [[defects]]"),
        (&["preview", &irregular, "--ring-thickness-mm", "-1"], "above 0"),
        (
            &["preview", &irregular, "--ring-thickness-mm", "0.001"],
            "defect 1 is 0.02000 mm deep; expected a thicker ring",
        ),
        (&["convert", &irregular, "--to", "profile", "--points", "1"], "expected 8 to"),
        (&["fit", &irregular, "--order", "200"], "an order of at most 20"),
        (&["fit", &irregular, "--segments", "0"], "expected 1 to"),
        (&["convert", &irregular, "--to", "outline", "--level-um", "3"], "belong to the outline of a depth map"),
        (
            &["convert", &scan, "--to", "outline", "--level-um", "90"],
            "no depth is above --level-um = 90; the deepest is",
        ),
        (&["convert", &scan, "--to", "outline", "--tolerance-mm", "-1"], "--tolerance-mm is -1; it must be"),
        (&["random", "--seed", "1", "--length-mm", "nan", "--width-mm", "1"], "--length-mm NaN"),
        (&["random", "--seed", "1", "--length-mm", "1", "--width-mm", "1", "--roughness", "2"], "--roughness 2"),
    ] {
        brinell(Path::new("."), &[&["defect"], args].concat()).exits(2).complains(&[words]);
    }
}

#[test]
fn prop_a_table_is_refused_where_no_file_can_hold_it() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |name: &str, more: &[&str], words: &[&str]| {
        let file = example(name);
        let args = [&["defect", "table", &file[..], "-o", "t.csv"], more].concat();
        brinell(folder.path(), &args).exits(2).complains(words);
        assert!(!folder.path().join("t.csv").exists());
    };
    refused(
        "one-sided.toml",
        &[],
        &["simulation.model = \"tilting\"", "a file holds one", "--set simulation.model=full"],
    );
    refused("rectangle.toml", &["--inner"], &["--inner: defect 1 is on the outer-raceway, which has one contact"]);
}

#[test]
fn prop_a_table_that_does_not_fit_is_refused_or_said_and_has_no_pressures() {
    let folder = tempfile::tempdir().unwrap();
    let with_table = |rows: &str| {
        std::fs::write(folder.path().join("t.csv"), format!("s_mm,delta_um,delta_eff_um\n{rows}")).unwrap();
        let text = format!(
            "{}[[defects]]\non = \"outer-raceway\"\ncenter_deg = 0.0\ndepth_um = 20.0\n\
             shape = {{ rectangle = {{ length_mm = 3.0, width_mm = 4.0 }} }}\ntable = \"t.csv\"\n",
            HEAD.replace("li2023", "mechanics").replace("duration_s = 0.1", "duration_s = 0.2")
        );
        std::fs::write(folder.path().join("t.toml"), text).unwrap();
    };
    let grid = |ends: f64, half_mm: f64| {
        let of = |(s, share): (f64, f64)| (0..5).map(move |k| format!("{s},{k},{}\n", share * f64::from(k)));
        let rows = [(-1.0, ends), (-0.5, 0.6), (0.5, 0.6), (1.0, ends)].map(|(s, share)| (s * half_mm, share));
        rows.into_iter().flat_map(of).collect::<String>()
    };
    // Cut short: an error; of shorter damage: a warning; of this: none, and no pressures, which is said.
    with_table(&grid(0.9, 2.0));
    brinell(folder.path(), &["check", "t.toml"]).exits(2).complains(&[
        "table = \"t.csv\"",
        "the force would jump there",
        "0.5 %",
    ]);
    with_table(&grid(1.0, 1.0));
    brinell(folder.path(), &["check", "t.toml"])
        .exits(0)
        .complains(&["defects.0.table (defect 1): it ends at s = -1.00 and 1.00 mm"]);
    with_table(&grid(1.0, 2.0));
    brinell(folder.path(), &["check", "t.toml"]).exits(0).keeps_quiet();
    brinell(folder.path(), &["defect", "preview", "t.toml", "-o", "p", "--formats", "svg"])
        .exits(0)
        .says(&["by the table of its file, which has no pressures to draw"]);
    assert!(!folder.path().join("p/damage-1-pressure.svg").exists());
}
