//! Depth maps against closed forms.

use std::f64::consts::PI;

use crate::common::{Noise, npy, npy_f8};
use brinell::scenario::{DepthGrid, FirstRow, RollingDirection, ScanFile, ScanFill, ScanForm, ScanUnit, ScanZero};
use brinell_damage::{DepthMap, FileKind, read_depth_map};

/// Points 0.01 mm apart where a test does not care.
fn spaced(options: &ScanFile) -> ScanFile {
    ScanFile { ds_mm: options.ds_mm.or(Some(0.01)), dz_mm: options.dz_mm.or(Some(0.01)), ..options.clone() }
}

pub(crate) fn read_all(bytes: &[u8], options: &ScanFile) -> DepthMap {
    read_depth_map(bytes, None, &spaced(options)).unwrap()
}

fn read(bytes: &[u8], options: &ScanFile) -> DepthGrid {
    read_all(bytes, options).grid
}

/// The area of the cells that are not 0.
pub(crate) fn area_mm2(grid: &DepthGrid) -> f64 {
    let damaged = grid.depth_um.iter().filter(|&&d| d != 0.0).count();
    damaged as f64 * grid.ds_mm * grid.dz_mm
}

pub(crate) fn refuse(bytes: &[u8], options: &ScanFile) -> String {
    read_depth_map(bytes, None, &spaced(options)).unwrap_err().to_string()
}

pub(crate) fn csv(rows: usize, columns: usize, cell: impl Fn(usize, usize) -> String) -> Vec<u8> {
    let line = |row| (0..columns).map(|column| cell(row, column)).collect::<Vec<_>>().join(",");
    (0..rows).map(line).collect::<Vec<_>>().join("\n").into_bytes()
}

/// `(s, z)` of a point of a map with `rows` x `columns`, `step` mm apart, first row on top.
pub(crate) fn place(rows: usize, columns: usize, step: f64, row: usize, column: usize) -> (f64, f64) {
    ((column as f64 - 0.5 * (columns - 1) as f64) * step, (0.5 * (rows - 1) as f64 - row as f64) * step)
}

#[test]
fn analytic_circle_and_rectangle_have_their_area_and_widths_within_the_spacing() {
    let step = 0.02;
    let map = |inside: &dyn Fn(f64, f64) -> bool| {
        npy_f8(260, 240, |row, column| {
            let (s, z) = place(260, 240, step, row, column);
            if inside(s, z) { -20.0 } else { 0.0 }
        })
    };
    let options = ScanFile { ds_mm: Some(step), dz_mm: Some(step), ..Default::default() };
    let rectangle = read(&map(&|s, z| s.abs() < 1.5 && z.abs() < 2.0), &options);
    assert!((area_mm2(&rectangle) - 12.0).abs() < 1e-9);
    let DepthMap { grid: disc, warnings, .. } = read_all(&map(&|s, z| s.hypot(z) < 2.0), &options);
    assert!((area_mm2(&disc) / (4.0 * PI) - 1.0).abs() < 2e-3, "{}", area_mm2(&disc));
    for column in 0..disc.columns {
        let s = disc.s0_mm + column as f64 * step;
        let count = (0..disc.rows).filter(|&row| disc.at(column, row) != 0.0).count();
        let chord = 2.0 * (4.0 - s * s).max(0.0).sqrt();
        assert!((count as f64 * step - chord).abs() <= step + 1e-9, "s = {s}");
    }
    assert!(disc.depth_um.iter().all(|&d| d == 0.0 || d == 20.0));
    assert!(warnings.is_empty());
}

/// An L: the long stroke on the left, the short one at the bottom to the right; deepest at the foot's end.
fn letter(row: usize, column: usize) -> f64 {
    let long = (2..4).contains(&column) && (1..9).contains(&row);
    let short = (2..7).contains(&column) && (7..9).contains(&row);
    if long || short { 10.0 + column as f64 } else { 0.0 }
}

#[test]
fn analytic_an_l_is_turned_and_never_mirrored() {
    for first_row in [FirstRow::Top, FirstRow::Bottom] {
        let map = npy_f8(12, 10, |row, column| match first_row {
            FirstRow::Top => -letter(row, column),
            FirstRow::Bottom => -letter(11 - row, column),
        });
        for (direction, top, foot, empty) in [
            (RollingDirection::Right, [-1.5, 3.0], [2.0, -3.0], [2.0, 3.0]),
            (RollingDirection::Up, [3.0, 1.5], [-3.0, -2.0], [3.0, -2.0]),
            (RollingDirection::Left, [1.5, -3.0], [-2.0, 3.0], [-2.0, -3.0]),
            (RollingDirection::Down, [-3.0, -1.5], [3.0, 2.0], [-3.0, 2.0]),
        ] {
            let options = ScanFile {
                ds_mm: Some(1.0),
                dz_mm: Some(1.0),
                rolling_direction: direction,
                first_row,
                zero: ScanZero::AsIs,
                ..Default::default()
            };
            let grid = read(&map, &options);
            let depth =
                |[s, z]: [f64; 2]| grid.at((s - grid.s0_mm).round() as usize, (z - grid.z0_mm).round() as usize);
            assert!(depth(top) >= 12.0 && depth(top) <= 13.0, "{direction:?} {first_row:?}");
            assert_eq!(depth(foot), 16.0, "{direction:?} {first_row:?}");
            assert_eq!(depth(empty), 0.0, "{direction:?} {first_row:?}");
            let there = read(&map, &ScanFile { center: false, ..options });
            assert_eq!(there.s0_mm, -0.5 * (there.columns - 1) as f64);
            assert_eq!(there.depth_um, grid.depth_um);
        }
    }
}

/// A raceway of radius `radius` (positive: hollow), its axis turned by `turn`, and tilted; heights in um.
pub(crate) fn raceway(radius: f64, turn: f64, s: f64, z: f64) -> f64 {
    // Across the axis, from the lowest (or highest) line, which lies beside the middle.
    let x = (s - turn * z) / turn.hypot(1.0) + 0.4;
    let sag = radius - radius.signum() * (radius * radius - x * x).sqrt();
    1e3 * (sag + 0.004 * z) + 123.0
}

pub(crate) fn spall(s: f64, z: f64) -> f64 {
    if (s - 0.3).abs() < 1.0 && z.abs() < 0.8 { 25.0 } else { 0.0 }
}

#[test]
fn analytic_tilt_and_curvature_are_removed_exactly() {
    let (rows, columns, step) = (60, 90, 0.06);
    for (form, known, radius, turn) in [
        (ScanForm::Plane, None, 1e12, 0.0),
        (ScanForm::Cylinder, None, 27.5, 0.0),
        (ScanForm::Cylinder, None, 27.5, 0.05),
        (ScanForm::Cylinder, None, -21.5, -0.03),
        (ScanForm::Cylinder, None, -3.5, 0.02),
        (ScanForm::Cylinder, Some(27.5), 27.5, 0.05),
        (ScanForm::Cylinder, Some(21.5), -21.5, 0.02),
    ] {
        let map = npy_f8(rows, columns, |row, column| {
            let (s, z) = place(rows, columns, step, row, column);
            let tilt = if form == ScanForm::Plane { 7.0 * s } else { 0.0 };
            let form = if form == ScanForm::Plane { 4.0 * z } else { raceway(radius, turn, s, z) };
            form + tilt - spall(s, z)
        });
        let options = ScanFile {
            ds_mm: Some(step),
            dz_mm: Some(step),
            remove_form: form,
            radius_mm: known,
            center: false,
            ..Default::default()
        };
        let grid = read(&map, &options);
        for row in 0..rows {
            for column in 0..columns {
                let (s, z) = (grid.s0_mm + column as f64 * step, grid.z0_mm + row as f64 * step);
                let error = (grid.at(column, row) - spall(s, z)).abs();
                assert!(error < 1e-5, "{form:?} {radius}: {error} um at {s} {z}");
            }
        }
    }
}

#[test]
fn analytic_a_torus_is_removed_exactly_and_its_radii_are_those_of_the_surface() {
    // Grooves of an outer and an inner ring of a 6205, and a ball; at the middle of its height and beside it.
    for (radius, across, t) in [(23.49, 4.129, 0.0), (23.49, 4.129, 0.1), (-15.55, 4.129, 0.05), (-3.97, -3.97, 0.08)] {
        let step = 0.04;
        let read = |given: Option<f64>, side: usize| {
            let map = npy_f8(side, side, |row, column| {
                let (s, z) = place(side, side, step, row, column);
                let arc = |r: f64, x: f64| r - r.signum() * (r * r - x * x).sqrt();
                let from = across * t;
                let y = arc(across, z + from) - arc(across, from);
                let around = radius - y;
                // The circle that the profile leaves there, seen beside its middle.
                let height = radius - around.signum() * (around * around - (s + 0.3).powi(2)).sqrt();
                1e3 * height - if s.hypot(z) < 0.2 { 20.0 } else { 0.0 }
            });
            let options = ScanFile {
                ds_mm: Some(step),
                dz_mm: Some(step),
                remove_form: ScanForm::Torus,
                radius_mm: given,
                center: false,
                ..Default::default()
            };
            let read = read_depth_map(&map, None, &options).unwrap();
            for row in 0..side {
                for column in 0..side {
                    let (s, z) = place(side, side, step, row, column);
                    let error = (read.grid.at(column, row) - if s.hypot(z) < 0.2 { 20.0 } else { 0.0 }).abs();
                    assert!(error < 1e-4, "{radius} {across} {t} {given:?}: {error} um at {s} {z}");
                }
            }
            read.form.unwrap()
        };
        for (given, side) in [(None, 26), (None, 51), (Some(radius.abs()), 51)] {
            let form = read(given, side);
            let radii = [form.around, form.across.unwrap()].map(|c| c.curvature_per_mm.recip());
            // Of a sphere place, tilt and turn are one: what noise-free depths leave of its radius is above a thousandth.
            let off = |k: usize, of: f64| (radii[k] / of - 1.0).abs();
            assert!(off(0, radius) < 2e-3 && off(1, across) < 2e-3, "{radii:?}");
        }
    }
}

#[test]
fn analytic_noise_and_a_large_spall_hardly_move_the_form() {
    let (rows, columns, step) = (80, 100, 0.06);
    for (share, bound) in [(0.2, 0.1), (0.35, 0.1)] {
        let side = (share * (rows * columns) as f64).sqrt() * step / 2.0;
        let mut noise = Noise(5);
        let grain: Vec<f64> = (0..rows * columns).map(|_| 0.2 * noise.normal()).collect();
        let inside = |s: f64, z: f64| (s - 0.4).abs() < side && z.abs() < side;
        let map = npy_f8(rows, columns, |row, column| {
            let (s, z) = place(rows, columns, step, row, column);
            raceway(27.5, 0.02, s, z) + grain[row * columns + column] - if inside(s, z) { 25.0 } else { 0.0 }
        });
        let options = ScanFile {
            ds_mm: Some(step),
            dz_mm: Some(step),
            remove_form: ScanForm::Cylinder,
            zero: ScanZero::AsIs,
            threshold_um: 2.0,
            ..Default::default()
        };
        let grid = read(&map, &options);
        let damaged: Vec<f64> = grid.depth_um.iter().copied().filter(|&d| d != 0.0).collect();
        let mean = damaged.iter().sum::<f64>() / damaged.len() as f64;
        println!("{share}: mean depth {mean}");
        assert!((mean - 25.0).abs() < bound, "{share}: {mean}");
    }
}

#[test]
fn analytic_the_drawn_scan_gives_its_raceway_and_its_spall() {
    let scan = include_bytes!("../../../examples/scan.csv");
    let options = ScanFile {
        ds_mm: Some(0.06),
        dz_mm: Some(0.06),
        remove_form: ScanForm::Cylinder,
        fill: ScanFill::Neighbours,
        threshold_um: 1.0,
        speck_mm2: 0.05,
        ..Default::default()
    };
    let DepthMap { grid, warnings, notes, .. } = read_depth_map(scan, Some(FileKind::Csv), &options).unwrap();
    // See examples/draw_examples.rs.
    let mut deep: Vec<f64> = grid.depth_um.iter().copied().filter(|&d| d > 20.0).collect();
    deep.sort_by(f64::total_cmp);
    assert!((deep[deep.len() / 2] - 25.0).abs() < 0.5);
    // One point deep: a note, as it was asked for.
    assert_eq!(warnings, [""; 0]);
    assert!(notes.iter().any(|note| note == "80 of 8000 points were missing and are filled from their neighbours"));
    assert!(read_depth_map(scan, None, &ScanFile { fill: ScanFill::None, ..options }).is_err());
}

#[test]
fn analytic_missing_points_of_a_slope_are_filled_on_it() {
    let map = csv(20, 20, |row, column| match (row, column) {
        (5..8, 5..8) | (0, 0) | (19, 3) => String::new(),
        (12, 12) => "-9999".to_owned(),
        (12, 14) => "NaN".to_owned(),
        _ => format!("{}", 2.0 * row as f64 + column as f64),
    });
    let options = ScanFile {
        missing: Some(-9999.0),
        fill: ScanFill::Neighbours,
        zero: ScanZero::AsIs,
        height_positive_up: false,
        first_row: FirstRow::Bottom,
        threshold_um: 2.5,
        ..Default::default()
    };
    let DepthMap { grid, warnings, .. } = read_all(&map, &options);
    for (row, column) in [(6, 6), (5, 7), (12, 12), (12, 14)] {
        assert!((grid.at(column, row) - (2 * row + column) as f64).abs() < 1e-3, "{}", grid.at(column, row));
    }
    assert_eq!(
        warnings[0],
        "13 of 400 points were missing and are filled from their neighbours; some lie up to 2 points from any measured one, where the surface \
         is a guess: look at it, or scan again"
    );
    // A slope that nobody takes off.
    assert!(warnings[1].contains("as a tilted part does"));
    assert_eq!(
        refuse(&map, &ScanFile { fill: ScanFill::None, ..options }),
        "13 of 400 points are missing (the first in row 1, column 1); fill them from their neighbours with `fill`"
    );
}

#[test]
fn xval_every_way_of_writing_a_map_gives_the_same_grid() {
    let depth = |row: usize, column: usize| -> i32 {
        if (2..5).contains(&row) && (3..7).contains(&column) { 20 + (row * 9 + column) as i32 % 7 } else { 0 }
    };
    let (rows, columns) = (8, 9);
    let items = |size: usize, big: bool, fortran: bool, bits: &dyn Fn(i32) -> u64| -> Vec<u8> {
        let order =
            (0..rows * columns).map(|i| if fortran { (i % rows, i / rows) } else { (i / columns, i % columns) });
        order
            .flat_map(|(row, column)| {
                let mut bytes = bits(depth(row, column)).to_le_bytes()[..size].to_vec();
                if big {
                    bytes.reverse();
                }
                bytes
            })
            .collect()
    };
    let whole = |v: i32| v as u64;
    let f4 = |v: i32| u64::from((v as f32).to_bits());
    let f8 = |v: i32| f64::from(v).to_bits();
    let shape = [rows, columns];
    let text = |separator: &str, decimal: char, end: &str| -> Vec<u8> {
        let cell = |row, column| format!("{}{decimal}0", depth(row, column));
        let line = |row| (0..columns).map(|c| cell(row, c)).collect::<Vec<_>>().join(separator) + end;
        (0..rows).map(line).collect::<String>().into_bytes()
    };
    let mut with_names = b"\xef\xbb\xbf# a comment, with commas\na,b,c,d,e,f,g,h,i\n".to_vec();
    with_names.extend(text(",", '.', "\r\n"));
    let files = [
        npy("<f8", false, shape, &items(8, false, false, &f8)),
        npy(">f8", true, shape, &items(8, true, true, &f8)),
        npy("<f4", true, shape, &items(4, false, true, &f4)),
        npy(">f4", false, shape, &items(4, true, false, &f4)),
        npy("|u1", false, shape, &items(1, false, false, &whole)),
        npy("<i2", false, shape, &items(2, false, false, &whole)),
        npy(">u2", true, shape, &items(2, true, true, &whole)),
        npy("<i4", false, shape, &items(4, false, false, &whole)),
        npy("<i8", false, shape, &items(8, false, false, &whole)),
        text(",", '.', "\n"),
        text(", ", '.', "\n"),
        text(",", '.', ",\n"),
        text(";", ',', "\n"),
        text(";", ',', ";\r\n"),
        text("\t", ',', "\n"),
        text(" ", '.', "\n"),
        text("  ", ',', "\n"),
        with_names,
    ];
    let options = ScanFile { height_positive_up: false, ..Default::default() };
    let expected = read(&files[0], &options);
    assert_eq!(expected.at(3, 5), f64::from(depth(2, 3)));
    for (i, file) in files.iter().enumerate() {
        assert_eq!(read(file, &options).depth_um, expected.depth_um, "file {i}");
    }
    // Negative integers, and units.
    let negative = npy("<i2", false, shape, &items(2, false, false, &|v| (-v) as u64));
    let heights = ScanFile { unit: ScanUnit::Counts, nm_per_count: Some(1000.0), ..Default::default() };
    assert_eq!(read(&negative, &heights).depth_um, expected.depth_um);
    let mm = ScanFile { unit: ScanUnit::Mm, threshold_um: 0.0, ..options.clone() };
    assert!(refuse(&files[0], &mm).starts_with("the depth of a point is 2.400e4 um, more than the 5e3 um"));
    let wide = items(2, true, false, &|v| (30_000 - 10 * v) as u64);
    let png = crate::common::png(columns, rows, png::ColorType::Grayscale, png::BitDepth::Sixteen, &wide);
    let counts = ScanFile { unit: ScanUnit::Counts, nm_per_count: Some(100.0), ..Default::default() };
    let grid = read(&png, &counts);
    for (a, b) in grid.depth_um.iter().zip(&expected.depth_um) {
        assert!((a - b).abs() < 1e-9);
    }
}
