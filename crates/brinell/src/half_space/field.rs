//! Pressures of one damaged contact: for pictures, not for motion.

use super::build::Accuracy;
use super::geometry::Geometry;
use super::level::{Fineness, Grid, Presser, cell_length};
use super::raster::Raster;
use std::f64::consts::PI;

/// Pressures on a grid over the contact's window.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// Cells along s and across.
    pub cells: [usize; 2],
    /// Their sizes, m.
    pub size: [f64; 2],
    /// s and z of the first cell's middle, m.
    pub first: [f64; 2],
    /// Pressures, row by row of z, Pa.
    pub pressure: Vec<f64>,
    /// Largest pressure, Pa: at sharp edges it grows as cells shrink.
    pub largest: f64,
    /// Q, N.
    pub force: f64,
    /// U, J.
    pub energy: f64,
}

/// Pressures at the deformation `delta` (m) with the contact's middle at `s` (m), to the nearest cell. `None` where nothing touches.
pub fn pressure_at(geometry: &Geometry, raster: &Raster, delta: f64, s: f64, accuracy: Accuracy) -> Option<Field> {
    let fineness: Fineness = accuracy.fineness();
    let pressed_by = delta + raster.raised();
    if !(pressed_by > 0.0 && pressed_by.is_finite() && s.is_finite()) {
        return None;
    }
    let dx = cell_length(geometry.half_width(pressed_by), &fineness);
    let half = ((geometry.reach(pressed_by) / dx).ceil() as usize).max(4);
    let rows = 2 * geometry.rows(raster, pressed_by, fineness.rows);
    let dz = geometry.half_across(pressed_by) / rows as f64;
    let grid = Grid::new(geometry, raster, delta, [dx, dz], half, &fineness);
    let middle = (s / dx).round() as i64;
    let mut presser = Presser::new(&grid);
    let pressed = presser.pressed(&grid.window(middle), delta, fineness.tolerance);
    if pressed.energy <= 0.0 {
        return None;
    }
    let unit = PI * geometry.modulus / dx;
    let along = 2 * half;
    let p: Vec<f64> = presser.contact.p.iter().map(|p| p * unit).collect();
    let mirrored = grid.influence.cells().mirrored;
    let other = p.chunks_exact(along).rev().flatten().copied().filter(|_| mirrored);
    let pressure: Vec<f64> = other.chain(p.iter().copied()).collect();
    let sides = if mirrored { 2.0 } else { 1.0 };
    let area = sides * dx * dz * unit;
    let across = pressure.len() / along;
    Some(Field {
        cells: [along, across],
        size: [dx, dz],
        first: [(middle as f64 - half as f64 + 0.5) * dx, (0.5 - 0.5 * across as f64) * dz],
        largest: pressure.iter().fold(0.0, |most, p| p.max(most)),
        pressure,
        force: pressed.force * area,
        energy: pressed.energy * area,
    })
}
