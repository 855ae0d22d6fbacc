//! Depth maps that are refused, and the memory that the largest takes.

use crate::common::{npy, npy_f8, peak_mb};
use crate::depth_maps::{area_mm2, csv, place, raceway, read_all, refuse, spall};
use brinell::scenario::{ScanFile, ScanForm, ScanUnit, ScanZero};
use brinell_damage::{DamageError, FileKind, read_depth_map};

#[test]
fn prop_unusable_maps_are_refused_in_words() {
    let default = ScanFile::default();
    let pit = |row: usize, column: usize| if row == 2 && column == 2 { -9.0 } else { 0.0 };
    let map = npy_f8(5, 5, pit);
    for (bytes, words) in [
        (b"1,2\n3,x4\n".to_vec(), "line 2, column 2: `x4` is not a number"),
        (b"1,2\n\n3,4,5\n".to_vec(), "line 3 has 3 values where the first row has 2"),
        (b"5\n6\n".to_vec(), "the map: a grid of 1 x 2 points is not understood; at least 2 x 2"),
        (b"1,2\n3,4\n".to_vec(), "there is no damage in it: no spot reaches"),
        (b"\x89PNG\r\n\x1a\n".to_vec(), "this PNG file is broken at its header"),
        (b"PK\x03\x04".to_vec(), "a zip archive (such as npz or xlsx) cannot be read as a depth map; save it as"),
        (b"\x93NUMPY\x01\0\xff\xff{}".to_vec(), "this NPY file is broken at its header: it ends here"),
        (map[..map.len() - 1].to_vec(), "this NPY file is broken at its data: 199 bytes where 5 x 5 values need 200"),
        (npy("<c8", false, [2, 2], &[0; 32]), "descr: `<c8` is not understood; save the array as float64"),
        (npy("<f8", false, [90_000, 90_000], &[]), "the number of points is 90000 x 90000"),
        (csv(4, 4, |r, c| if r > 0 { String::new() } else { format!("{c}") }), "12 of 16 points are missing"),
    ] {
        let said = refuse(&bytes, &ScanFile { threshold_um: 50.0, ..default.clone() });
        assert!(said.starts_with(words), "{said}");
    }
    let rough = npy_f8(5, 5, |r, c| (r * 7 + c * 3) as f64 + 0.5);
    let as_is = ScanFile { zero: ScanZero::AsIs, threshold_um: 0.1, ..default.clone() };
    assert!(refuse(&rough, &as_is).starts_with("all of it would be damage"));
    let tiny = ScanFile { remove_form: ScanForm::Plane, ..default.clone() };
    assert!(refuse(&npy_f8(3, 3, pit), &tiny).contains("at least 16 are needed"));
    let short = ScanFile { remove_form: ScanForm::Cylinder, radius_mm: Some(0.5), ds_mm: Some(1.0), ..default.clone() };
    assert!(refuse(&map, &short).starts_with("the cylinder cannot be fitted: the scan is longer"));
    for (options, words) in [
        (ScanFile { ds_mm: Some(f64::NAN), ..default.clone() }, "`ds_mm` is NaN"),
        (
            ScanFile { zero: ScanZero::Percentile, zero_percentile: Some(101.0), ..default.clone() },
            "`zero_percentile` is 101",
        ),
        (ScanFile { unit: ScanUnit::Counts, nm_per_count: Some(0.0), ..default.clone() }, "`nm_per_count` is 0"),
    ] {
        assert!(refuse(&map, &options).starts_with(words));
    }
    let error = read_depth_map(&map, Some(FileKind::Csv), &default).unwrap_err();
    assert_eq!(error, DamageError::NotWhatItsNameSays { expected: FileKind::Csv, found: Some(FileKind::Npy) });
}

#[test]
#[ignore = "half a gigabyte and some seconds; `-- --ignored --nocapture --test-threads 1` by hand"]
fn prop_the_largest_map_stays_within_a_gigabyte() {
    let step = 0.001;
    let map = npy_f8(4096, 4096, |row, column| {
        let (s, z) = place(4096, 4096, step, row, column);
        raceway(27.5, 0.02, s, z) - spall(s, z)
    });
    let options = ScanFile {
        ds_mm: Some(step),
        dz_mm: Some(step),
        remove_form: ScanForm::Cylinder,
        speck_mm2: 0.01,
        ..Default::default()
    };
    println!("before reading: {:.0} MB", peak_mb());
    let begin = std::time::Instant::now();
    let grid = read_all(&map, &options).grid;
    println!("{:?}, peak {:.0} MB", begin.elapsed(), peak_mb());
    assert!((area_mm2(&grid) - 3.2).abs() < 0.01);
    assert!(peak_mb() < 1000.0);
}
