//! Scenarios that name files of damage: what comes out of them, and what is said of files that do not do.

use std::fs;
use std::path::{Path, PathBuf};

use brinell::document::read;
use brinell::model::Model;
use brinell::scenario::{DefectTable, DepthGrid, Scenario, Shape};
use brinell_damage::{Unresolved, resolve, resolve_loaded};

const HEAD: &str = "name = \"files\"\n[bearing]\npreset = \"NN3007\"\n[operation]\nspeed_rpm = 1800.0\n\
    load_n = [300.0, 0.0]\n[simulation]\nlaws = \"li2023\"\nduration_s = 0.01\nsample_rate_hz = 25600.0\n";

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples")
}

fn corpus() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus")
}

/// One defect of this shape on the outer raceway.
fn with(shape: &str) -> Scenario {
    let text = format!(
        "{HEAD}[[defects]]\non = \"outer-raceway\"\ncenter_deg = 0.0\ndepth_um = 20.0\nshape = {{ {shape} }}\n"
    );
    read(&text, &[]).map_or_else(|e| panic!("{e:?}"), |loaded| loaded.scenario)
}

fn refusal(shape: &str, folder: &Path) -> String {
    let mut scenario = with(shape);
    let before = scenario.clone();
    let errors: Vec<Unresolved> = resolve(&mut scenario, folder).unwrap_err();
    assert_eq!(scenario, before, "a refused scenario stays as it was");
    let words: Vec<String> = errors.iter().map(ToString::to_string).collect();
    words.join("\n")
}

fn example(name: &str) -> (Scenario, Vec<String>) {
    let text = fs::read_to_string(examples().join(name)).unwrap();
    let mut scenario = read(&text, &[]).unwrap().scenario;
    let warnings = resolve(&mut scenario, &examples()).unwrap();
    (scenario, warnings)
}

/// Area and extents of an outline, (area, s extent, z extent).
fn measures(shape: &Shape) -> (f64, f64, f64) {
    let Shape::Outline { polygons_mm } = shape else {
        panic!("no outline: {shape:?}");
    };
    let extent = |k: usize| {
        let all = || polygons_mm.iter().flatten().map(|p| p[k]);
        all().fold(f64::MIN, f64::max) - all().fold(f64::MAX, f64::min)
    };
    let area = brinell::defect::Shape::new(shape, 0.0).unwrap().area();
    (1e6 * area, extent(0), extent(1))
}

#[test]
fn analytic_the_photo_becomes_the_spall_that_was_drawn() {
    let (scenario, warnings) = example("photo.toml");
    let (area, length, width) = measures(&scenario.defects[0].shape);
    println!("{area} mm^2, {length} x {width} mm, {warnings:?}");
    // See examples/draw_examples.rs; the soft edge moves it by a pixel of 0.02 mm or so.
    assert!((length - 3.0).abs() < 0.06 && (width - 4.0).abs() < 0.06);
    assert!(warnings.iter().all(|w| w.contains("photo-spall.png")));
    assert!(Model::new(&scenario).is_ok());
}

#[test]
fn analytic_the_scan_becomes_a_grid_around_its_damage() {
    let (scenario, warnings) = example("scan.toml");
    let Shape::DepthMap { grid } = &scenario.defects[0].shape else {
        panic!("no grid");
    };
    let deepest = grid.depth_um.iter().copied().fold(0.0, f64::max);
    println!("{} x {} nodes, {deepest} um, {warnings:?}", grid.columns, grid.rows);
    assert!((24.0..27.0).contains(&deepest));
    // One undamaged node all round: nothing ends in a wall that the scan does not have.
    let rim = |i: usize| {
        let (column, row) = (i % grid.columns, i / grid.columns);
        column == 0 || row == 0 || column + 1 == grid.columns || row + 1 == grid.rows
    };
    let mut on_rim = grid.depth_um.iter().enumerate().filter(|(i, _)| rim(*i));
    assert!(on_rim.all(|(_, depth)| *depth == 0.0));
    assert!(Model::new(&scenario).is_ok());
}

#[test]
fn prop_a_resolved_scenario_reads_back_bit_for_bit_and_needs_no_file() {
    for name in ["photo.toml", "scan.toml"] {
        let (scenario, _) = example(name);
        let again = read(&scenario.to_toml(), &[]).unwrap().scenario;
        assert_eq!(again, scenario, "{name}");
        let mut twice = again.clone();
        assert_eq!(resolve(&mut twice, Path::new("/nowhere")), Ok(Vec::new()));
        assert_eq!(twice, scenario, "{name}");
    }
}

#[test]
fn prop_scenarios_that_name_files_read_back_bit_for_bit() {
    for shape in [
        "image = { file = \"a.png\", mm_per_pixel = 0.01, threshold = 0.3, use_alpha = true, edges = \"pixel-edges\" }",
        "svg = { file = \"a.svg\", path_id = \"spall\", mm_per_unit = 0.2, center = false }",
        "depth_map = { file = \"a.npy\", ds_mm = 0.01, dz_mm = 0.02, unit = \"counts\", nm_per_count = 3.0, missing = -1, \
         zero = \"percentile\", zero_percentile = 40.0, remove_form = \"cylinder\", radius_mm = 27.5, first_row = \"bottom\" }",
    ] {
        let scenario = with(shape);
        let text = scenario.to_toml();
        let again = read(&text, &[]).unwrap_or_else(|e| panic!("{e:?}\n{text}"));
        assert_eq!(again.scenario, scenario);
    }
}

#[test]
fn regress_a_drawing_is_read_from_the_scenarios_folder() {
    let shape = "svg = { file = \"shapes.svg\", mm_per_unit = 0.01 }";
    let mut scenario = with(shape);
    resolve(&mut scenario, &corpus()).unwrap();
    let (area, length, width) = measures(&scenario.defects[0].shape);
    assert!(area > 0.0 && length > 0.0 && width > 0.0);
}

#[test]
fn regress_files_that_do_not_do_are_refused_in_words() {
    let photo =
        |scale: &str, more: &str| format!("image = {{ file = \"photo-spall.png\", mm_per_pixel = {scale}{more} }}");
    let examples = examples();
    for (shape, wanted) in [
        ("image = { file = \"none.png\", mm_per_pixel = 0.02 }", "cannot read"),
        ("image = { file = \".\", mm_per_pixel = 0.02 }", "not a plain file"),
        ("image = { file = \"scan.csv\", mm_per_pixel = 0.02 }", "cannot be read as an image"),
        ("svg = { file = \"photo-spall.png\" }", "PNG"),
        ("depth_map = { file = \"photo.toml\", ds_mm = 0.1, dz_mm = 0.1 }", "not a number"),
        // Nothing is as dark as that, and everything darker than this.
        (&photo("0.02", ", threshold = 0.01"), "no damage"),
        (&photo("0.02", ", threshold = 0.999"), "all of it would be damage"),
        (&photo("0.5", ""), "off the raceway's edge"),
        (&photo("2.0", ""), "past a full circle"),
        ("depth_map = { file = \"scan.csv\", ds_mm = 0.06, dz_mm = 0.06 }", "are missing"),
        (
            "depth_map = { file = \"scan.csv\", ds_mm = 0.06, dz_mm = 0.06, fill = \"neighbours\", zero = \"as-is\" }",
            "all of it would be damage",
        ),
    ] {
        let words = refusal(shape, &examples);
        println!("{words}\n");
        assert!(words.contains(wanted), "{shape}\n{words}");
        assert!(words.starts_with("defects.0.shape."), "{words}");
    }
}

#[test]
fn regress_a_file_that_is_not_what_its_name_says_is_refused() {
    let folder = std::env::temp_dir().join(format!("brinell-resolve-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    fs::copy(examples().join("scan.csv"), folder.join("photo.png")).unwrap();
    let words = refusal("image = { file = \"photo.png\", mm_per_pixel = 0.02 }", &folder);
    fs::remove_dir_all(&folder).unwrap();
    assert!(words.contains("should be PNG") && words.contains("CSV"), "{words}");
}

#[test]
fn regress_every_bad_file_is_reported_at_once_and_overlaps_are_seen_after_reading() {
    let photo = "shape = { image = { file = \"photo-spall.png\", mm_per_pixel = 0.02 } }";
    let missing = "shape = { image = { file = \"none.png\", mm_per_pixel = 0.02 } }";
    let defect =
        |shape: &str| format!("[[defects]]\non = \"outer-raceway\"\ncenter_deg = 0.0\ndepth_um = 20.0\n{shape}\n");
    let both = |shape: &str| {
        let text = format!("{HEAD}{}{}", defect(shape), defect(shape));
        read(&text, &[]).unwrap()
    };
    let errors = resolve(&mut both(missing).scenario, &examples()).unwrap_err();
    assert_eq!(errors.iter().map(|e| e.defect).collect::<Vec<_>>(), [0, 1]);
    let mut loaded = both(photo);
    assert_eq!(loaded.warnings, []);
    let warnings = resolve(&mut loaded.scenario, &examples()).unwrap();
    assert!(warnings.iter().any(|w| w.contains("overlaps defect 1")), "{warnings:?}");
}

#[test]
fn regress_a_scan_whose_rim_is_damage_is_doubted() {
    let shape = "depth_map = { file = \"scan.csv\", ds_mm = 0.06, dz_mm = 0.06, fill = \"neighbours\", remove_form = \"plane\" }";
    let text = format!("{HEAD}[[defects]]\non = \"outer-raceway\"\ncenter_deg = 0.0\nshape = {{ {shape} }}\n");
    let mut scenario = read(&text, &[]).unwrap().scenario;
    let said = match resolve(&mut scenario, &examples()) {
        Ok(warnings) => warnings.join("\n"),
        Err(errors) => errors[0].to_string(),
    };
    assert!(said.contains("remove_form"), "{said}");
}

#[test]
fn analytic_a_fitted_radius_is_kept_and_one_that_is_not_the_surface_s_is_warned_of() {
    // The example is hollow with 27.5 mm, as the outer raceway is. A spacing of 1.2 makes the radius 1.44 of that, one
    // of 1.05 makes it 1.10, within a fifth.
    let warned = |on: &str, keys: &str| {
        let text = format!(
            "{HEAD}[[defects]]\non = \"{on}\"\ncenter_deg = 0.0\nshape = {{ depth_map = {{ \
             file = \"scan.csv\", dz_mm = 0.06, fill = \"neighbours\", speck_mm2 = 0.05, remove_form = \"cylinder\", {keys} }} }}\n"
        );
        let mut loaded = read(&text, &[]).unwrap();
        let warnings = resolve_loaded(&mut loaded, &text, &[], &examples()).unwrap();
        let found = loaded.provenance.into_iter().find(|p| p.key == "defects.0.shape.depth_map.radius_mm" && p.assumed);
        let radius = found.map(|p| (p.value.parse::<f64>().unwrap(), p.reason()));
        (warnings.into_iter().find(|w| w.contains("the fitted cylinder")), radius)
    };
    for (on, keys, radius, wanted) in [
        ("outer-raceway", "ds_mm = 0.06", 27.5, None),
        ("outer-raceway", "ds_mm = 0.063", 27.5 * 1.1025, None),
        ("outer-raceway", "ds_mm = 0.072", 27.5 * 1.44, Some("outer raceway is hollow with 27.5 mm; check `ds_mm`")),
        ("inner-raceway", "ds_mm = 0.06", 27.5, Some("check `height_positive_up` and `on`")),
    ] {
        let (said, found) = warned(on, keys);
        let (fitted, how) = found.expect(keys);
        // Noise of 0.15 um on a sag of 160 um, on a surface with a spall.
        assert!((fitted / radius - 1.0).abs() < 0.01, "{keys}: {fitted}");
        assert_eq!(how, "fitted to the scan: hollow along s");
        match wanted {
            Some(words) => assert!(said.as_ref().is_some_and(|w| w.contains(words)), "{keys}: {said:?}"),
            None => assert_eq!(said, None, "{keys}"),
        }
    }
    // A radius that was given is its author's.
    assert_eq!(warned("outer-raceway", "ds_mm = 0.06, radius_mm = 27.5"), (None, None));
}

#[test]
fn regress_a_cylinder_is_doubted_on_a_ball_bearing() {
    let text = HEAD.replace("NN3007", "6205")
        + "[[defects]]\non = \"outer-raceway\"\nshape = { depth_map = { file = \"a.csv\", remove_form = \"FORM\" } }\n";
    let remarks = |form: &str| {
        let loaded = read(&text.replace("FORM", form), &[]).unwrap();
        loaded.warnings.iter().filter(|w| w.key.ends_with("remove_form")).map(ToString::to_string).collect::<String>()
    };
    assert!(remarks("cylinder").contains("no surface of a ball bearing is a cylinder"));
    assert_eq!(remarks("torus"), "");
}

#[test]
fn regress_keys_of_a_written_grid_and_of_a_file_exclude_each_other() {
    let read_shape = |keys: &str| {
        let text = format!(
            "{HEAD}[[defects]]\non = \"outer-raceway\"\nshape = {{ depth_map = {{ ds_mm = 0.1, dz_mm = 0.1, {keys} }} }}\n"
        );
        read(&text, &[]).map_err(|e| e.iter().map(ToString::to_string).collect::<String>())
    };
    let grid = "columns = 2, rows = 2, depth_um = [1, 1, 1, 1]";
    let Ok(loaded) = read_shape(grid) else {
        panic!("a written grid reads");
    };
    assert!(matches!(loaded.scenario.defects[0].shape, Shape::DepthMap { grid: DepthGrid { columns: 2, .. } }));
    for (keys, wanted) in [
        ("file = \"a.csv\", columns = 2", "only where there is no `file`"),
        (&format!("{grid}, remove_form = \"plane\""), "only where there is a `file`"),
        (&format!("{grid}, missing = 3"), "only where there is a `file`"),
        ("columns = 2, rows = 2", "depth_um"),
        ("file = \"a.csv\", radius_mm = 3.0", "remove_form"),
        ("file = \"a.csv\", unit = \"counts\"", "nm_per_count"),
        ("file = \"a.csv\", remove_from = \"plane\"", "did you mean `remove_form`"),
    ] {
        let words = read_shape(keys).unwrap_err();
        assert!(words.contains(wanted), "{keys}\n{words}");
    }
}

/// A scenario of the half-space law with a table, and a folder that has its file.
fn tabled(name: &str, csv: &str) -> (Scenario, PathBuf) {
    let folder = std::env::temp_dir().join(format!("brinell-table-{name}-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("pit.csv"), csv).unwrap();
    let text = format!(
        "{}[[defects]]\non = \"outer-raceway\"\ncenter_deg = 0.0\ndepth_um = 20.0\n\
         shape = {{ rectangle = {{ length_mm = 3.0, width_mm = 4.0 }} }}\ntable = \"pit.csv\"\n",
        HEAD.replace("li2023", "mechanics")
    );
    (read(&text, &[]).map_or_else(|e| panic!("{e:?}"), |loaded| loaded.scenario), folder)
}

#[test]
fn prop_a_table_comes_from_its_file_and_is_written_out() {
    let (mut scenario, folder) =
        tabled("good", "s_mm,delta_um,delta_eff_um,note\n-2,0,0,a\n-2,5,5,b\n2,0,0,c\n2,5,5,d\n");
    assert_eq!(resolve(&mut scenario, &folder), Ok(vec![]));
    let Some(DefectTable::Read(table)) = &scenario.defects[0].table else { panic!("no table") };
    assert_eq!(table.values.list(), [0.0, 5.0, 0.0, 5.0]);
    assert_eq!(read(&scenario.to_toml(), &[]).unwrap().scenario, scenario);
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn prop_a_table_that_does_not_do_is_named_with_its_line() {
    for (csv, words) in [
        ("s_mm,delta_um,delta_eff_um\n-2,0,0\n-2,5,x\n", "line 3: delta_eff_um is \"x\""),
        ("s_mm,delta_um,delta_eff_um\n-2,0,0\n-2,5,5\n2,0,0\n", "no node s_mm = 2, delta_um = 5"),
        ("s_mm,delta_um\n", "no column delta_eff_um"),
    ] {
        let (mut scenario, folder) = tabled(&format!("bad-{}", csv.len()), csv);
        let before = scenario.clone();
        let errors = resolve(&mut scenario, &folder).unwrap_err();
        assert_eq!((&errors[0].key[..], &errors[0].file[..]), ("defects.0.table", "pit.csv"));
        assert!(errors[0].message.contains(words), "{}", errors[0].message);
        assert_eq!(scenario, before);
        fs::remove_dir_all(folder).unwrap();
    }
}
