//! Missing points of a scan, and specks of what is left of its noise.

use crate::scan::Scan;
use brinell::defect::{neighbours, parts};

/// Smoothing sweeps over filled points.
const SWEEPS: usize = 40;

/// Gives missing points (NaN) the values that join their neighbours smoothly: layer by layer inwards, then relaxed
/// towards a harmonic surface. Returns how many there were and how many layers deep they went.
pub(crate) fn fill(scan: &mut Scan) -> (usize, usize) {
    let (columns, rows) = (scan.columns, scan.rows);
    let depth = &mut scan.depth_um;
    let missing: Vec<usize> = (0..depth.len()).filter(|&i| depth[i].is_nan()).collect();
    if missing.is_empty() || missing.len() == depth.len() {
        return (missing.len(), 0);
    }
    let mut queued = vec![false; depth.len()];
    let mut layer: Vec<usize> = Vec::new();
    let near = |i: usize| neighbours(i, columns, rows);
    for &i in &missing {
        if near(i).any(|j| !depth[j].is_nan()) {
            queued[i] = true;
            layer.push(i);
        }
    }
    let mut layers = 0;
    while !layer.is_empty() {
        layers += 1;
        let values: Vec<f64> = layer
            .iter()
            .map(|&i| {
                let known = near(i).map(|j| depth[j]).filter(|d| !d.is_nan());
                let (sum, count) = known.fold((0.0, 0.0), |(s, n), d| (s + d, n + 1.0));
                sum / count
            })
            .collect();
        for (&i, value) in layer.iter().zip(values) {
            depth[i] = value;
        }
        let mut next = Vec::new();
        for &i in &layer {
            for j in near(i) {
                if depth[j].is_nan() && !queued[j] {
                    queued[j] = true;
                    next.push(j);
                }
            }
        }
        layer = next;
    }
    for _ in 0..SWEEPS {
        for &i in &missing {
            let (sum, count) = near(i).fold((0.0, 0.0), |(s, n), j| (s + depth[j], n + 1.0));
            depth[i] = sum / count;
        }
    }
    (missing.len(), layers)
}

/// Sets connected groups of damaged points that cover fewer than `smallest` points to 0; returns how many groups.
pub(crate) fn drop_specks(scan: &mut Scan, smallest: f64) -> usize {
    let mut dropped = 0;
    let damaged = scan.depth_um.iter().map(|d| *d != 0.0).collect();
    parts(scan.columns, damaged, |group| {
        if (group.len() as f64) < smallest {
            dropped += 1;
            group.iter().for_each(|&i| scan.depth_um[i] = 0.0);
        }
    });
    dropped
}
