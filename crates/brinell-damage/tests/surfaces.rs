//! Surfaces as instruments save them, and point clouds, against the same heights as an array.

use crate::common::npy_f8;
use crate::common::surfaces::{cloud, sdf_binary, sdf_text, sur, x3p, zip};
use brinell::scenario::{DepthGrid, ScanFile, ScanFill};
use brinell_damage::{FileKind, read_depth_map};

const COLUMNS: usize = 31;
const ROWS: usize = 21;
/// um.
const STEP: f64 = 25.0;

/// A pit of 20 um off the middle, a ridge beside it, two points missing.
fn heights(column: usize, row: usize) -> f64 {
    match (column, row) {
        (8, 9) | (20, 3) => f64::NAN,
        (6..=14, 5..=11) => -20.0 + 0.125 * column as f64,
        (16..=17, 5..=11) => 4.0,
        _ => 0.25,
    }
}

fn options(spacing_mm: Option<f64>) -> ScanFile {
    ScanFile { ds_mm: spacing_mm, dz_mm: spacing_mm, fill: ScanFill::Neighbours, ..Default::default() }
}

fn words(bytes: &[u8], options: &ScanFile) -> String {
    read_depth_map(bytes, None, options).unwrap_err().to_string()
}

#[test]
fn xval_every_format_gives_the_map_of_the_array() {
    let step_mm = 1e-3 * STEP;
    let array = npy_f8(ROWS, COLUMNS, |row, column| heights(column, row));
    let wanted = read_depth_map(&array, None, &options(Some(step_mm))).unwrap().grid;
    let h = &heights;
    for (name, kind, bytes) in [
        ("SDF, text", FileKind::Sdf, sdf_text(COLUMNS, ROWS, STEP, h)),
        ("SDF, binary", FileKind::Sdf, sdf_binary(COLUMNS, ROWS, STEP, h)),
        ("SUR", FileKind::Sur, sur(COLUMNS, ROWS, STEP, h, false)),
        ("SUR, packed", FileKind::Sur, sur(COLUMNS, ROWS, STEP, h, true)),
        ("X3P", FileKind::X3p, x3p(COLUMNS, ROWS, STEP, h, false)),
        ("X3P, packed", FileKind::X3p, x3p(COLUMNS, ROWS, STEP, h, true)),
        ("cloud", FileKind::Csv, cloud(COLUMNS, ROWS, STEP, h, "x_mm,y_mm,z_um\n")),
    ] {
        assert_eq!(FileKind::of_content(&bytes), Some(kind), "{name}");
        let found = read_depth_map(&bytes, Some(kind), &options(None)).unwrap_or_else(|e| panic!("{name}: {e}"));
        same(name, &found.grid, &wanted);
        let wrong = words(&bytes, &options(Some(2.0 * step_mm)));
        assert!(wrong.contains("`ds_mm` is 0.05"), "{name}: {wrong}");
    }
    let said = words(&array, &options(None));
    assert!(said.contains("give `ds_mm` and `dz_mm`"), "{said}");
}

fn same(name: &str, found: &DepthGrid, wanted: &DepthGrid) {
    assert_eq!((found.columns, found.rows), (wanted.columns, wanted.rows), "{name}");
    // Spacing and heights go through 32-bit numbers or decimals.
    let near = |a: f64, b: f64, by: f64| (a - b).abs() <= by;
    assert!(near(found.ds_mm, wanted.ds_mm, 1e-6) && near(found.s0_mm, wanted.s0_mm, 1e-5), "{name}");
    assert!(near(found.z0_mm, wanted.z0_mm, 1e-5), "{name}");
    let all = found.depth_um.iter().zip(&wanted.depth_um);
    assert!(all.clone().all(|(a, b)| near(*a, *b, 1e-6)), "{name}");
}

#[test]
fn analytic_a_point_cloud_without_names_takes_its_unit_from_the_stated_spacing() {
    let bytes = cloud(COLUMNS, ROWS, STEP, &heights, "");
    let grid = read_depth_map(&bytes, None, &options(Some(0.025))).unwrap().grid;
    assert_eq!((grid.columns, grid.rows), (COLUMNS, ROWS));
    let said = words(&bytes, &options(None));
    assert!(said.contains("name the columns with their units"), "{said}");
    let scattered = b"x_mm,y_mm,z_um\n0,0,1\n1,0.3,2\n0.1,5,3\n4,4,4\n2.2,9,5\n6,1,6\n7.7,3,0\n1,8,8\n3,3.1,9\n5,5,1\n";
    let said = words(scattered, &options(None));
    assert!(said.contains("no regular grid"), "{said}");
}

#[test]
fn regress_axes_in_the_first_row_and_column_are_seen() {
    for corner in ["", "y\\x", "0"] {
        let mut text = corner.to_owned();
        for k in 1..8 {
            text += &format!(",{}", 0.5 * f64::from(k));
        }
        for row in 1..9 {
            text += &format!("\n{row}");
            for column in 1..8 {
                text += &format!(",{}", if (3..6).contains(&row) && column > 2 { -(row * column) } else { 0 });
            }
        }
        let said = words(text.as_bytes(), &options(Some(0.1)));
        assert!(said.contains("count its axes, in steps of 0.5 and 1"), "{corner}: {said}");
    }
}

#[test]
fn regress_depths_read_as_heights_and_a_tilt_are_said() {
    let options = options(Some(0.025));
    let depths = npy_f8(ROWS, COLUMNS, |row, column| -heights(column, row));
    let said = read_depth_map(&depths, None, &options).unwrap().warnings.join("\n");
    assert!(said.contains("are these depths? `height_positive_up = false`"), "{said}");
    let tilted = npy_f8(ROWS, COLUMNS, |row, column| heights(column, row) + 0.5 * column as f64 - 0.2 * row as f64);
    let said = read_depth_map(&tilted, None, &options).unwrap().warnings.join("\n");
    // 30 columns of 0.5 um and 20 rows of 0.2 um.
    assert!(said.contains("rises by 19.0 um") && said.contains("remove_form = \"plane\""), "{said}");
    let plain = npy_f8(ROWS, COLUMNS, |row, column| heights(column, row));
    let said = read_depth_map(&plain, None, &options).unwrap().warnings.join("\n");
    assert!(!said.contains("raised") && !said.contains("rim"), "{said}");
}

#[test]
fn prop_files_that_are_cut_off_or_lie_about_their_size_are_refused() {
    let h = &heights;
    for bytes in [
        sdf_text(COLUMNS, ROWS, STEP, h),
        sdf_binary(COLUMNS, ROWS, STEP, h),
        sur(COLUMNS, ROWS, STEP, h, false),
        sur(COLUMNS, ROWS, STEP, h, true),
        x3p(COLUMNS, ROWS, STEP, h, true),
    ] {
        for part in [0.1, 0.5, 0.9] {
            let cut = &bytes[..(part * bytes.len() as f64) as usize];
            assert!(read_depth_map(cut, None, &options(None)).is_err());
        }
    }
    let mut huge = sdf_binary(2, 2, STEP, h);
    huge[42..46].copy_from_slice(&[0xff; 4]);
    let said = words(&huge, &options(None));
    assert!(said.contains("65535 x 65535"), "{said}");
    let empty = zip(&[("main.xml", b"<a/>")], false);
    assert!(read_depth_map(&empty, None, &options(None)).is_err());
}
