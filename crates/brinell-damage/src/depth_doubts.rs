//! Words on scans that are read in a way that was hardly meant: depths as heights, a tilted part as damage.

use crate::scan::Scan;
use brinell::scenario::{ScanFile, ScanForm};

/// Share of the deviation that is raised, above which heights and depths are taken for mixed up.
const MOSTLY_RAISED: f64 = 0.8;
/// Share of the rim's variance that a tilt takes, at least.
const TILTED: f64 = 0.9;
/// Rise of a tilt over the scan, in thresholds, at least.
const LEAST_RISE: f64 = 3.0;

/// Where nearly all that deviates is raised.
pub(crate) fn raised(scan: &Scan, options: &ScanFile) -> Option<String> {
    let (mut up, mut all) = (0.0, 0.0);
    for depth in &scan.depth_um {
        up += (-depth).max(0.0);
        all += depth.abs();
    }
    (up > MOSTLY_RAISED * all).then(|| {
        let (word, other) = match options.height_positive_up {
            true => ("depths", false),
            false => ("heights", true),
        };
        format!(
            "{:.0} % of the deviation is raised; are these {word}? `height_positive_up = {other}`",
            100.0 * up / all
        )
    })
}

/// Where the rim lies on a tilted plane that nobody asked to take off.
pub(crate) fn tilt(scan: &Scan, options: &ScanFile) -> Option<String> {
    if options.remove_form != ScanForm::None || scan.columns < 3 || scan.rows < 3 {
        return None;
    }
    // Sums over the rim about the middle; its sides are symmetrical about both axes.
    let (mut n, mut mean, mut ss, mut zz, mut sd, mut zd) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    let rim = |i: &usize| {
        let (column, row) = (i % scan.columns, i / scan.columns);
        column == 0 || row == 0 || column + 1 == scan.columns || row + 1 == scan.rows
    };
    let there = |i: &usize| !scan.depth_um[*i].is_nan();
    let rim: Vec<usize> = (0..scan.depth_um.len()).filter(rim).filter(there).collect();
    for &i in &rim {
        let (s, z) = scan.place(i % scan.columns, i / scan.columns);
        let depth = scan.depth_um[i];
        n += 1.0;
        mean += depth;
        ss += s * s;
        zz += z * z;
        sd += s * depth;
        zd += z * depth;
    }
    mean /= f64::max(n, 1.0);
    let (slope_s, slope_z) = (sd / ss, zd / zz);
    let (last_s, last_z) = scan.place(scan.columns - 1, scan.rows - 1);
    let rise = 2.0 * ((slope_s * last_s).abs() + (slope_z * last_z).abs());
    let variance: f64 = rim.iter().map(|&i| (scan.depth_um[i] - mean).powi(2)).sum();
    let tilted = slope_s * sd + slope_z * zd > TILTED * variance;
    (tilted && rise > LEAST_RISE * options.threshold_um).then(|| {
        format!("its rim rises by {rise:.1} um from corner to corner, as a tilted part does: `remove_form = \"plane\"` takes that off")
    })
}
