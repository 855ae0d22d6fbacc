//! Pressures of one damaged contact: for pictures, not for motion.

use super::geometry::Geometry;
use super::level::{Fineness, Grid, Presser, cell_length};
use super::raster::{Bounds, Raster};
use crate::scenario::Tables;
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
    /// Its s and z, m.
    pub at: [f64; 2],
    /// s of the contact's middle, m.
    pub middle: f64,
    /// Q, N.
    pub force: f64,
    /// U, J.
    pub energy: f64,
}

/// The grid of one deformation.
struct Window {
    grid: Grid,
    /// Cells to either side of the contact's middle.
    half: usize,
    size: [f64; 2],
    delta: f64,
    /// What a solver's pressure of 1 is, Pa.
    unit: f64,
    tolerance: f64,
}

impl Window {
    /// `None` where nothing touches, or the damage is too ragged for a table.
    fn new(geometry: &Geometry, raster: &Raster, delta: f64, accuracy: Tables) -> Option<Self> {
        let fineness: Fineness = accuracy.fineness();
        let pressed_by = delta + raster.raised();
        if !(pressed_by > 0.0 && pressed_by.is_finite()) {
            return None;
        }
        let dx = cell_length(geometry.half_width(pressed_by), &fineness);
        let half = ((geometry.reach(pressed_by) / dx).ceil() as usize).max(4);
        let rows = 2 * geometry.rows(raster, pressed_by, fineness.rows);
        let size = [dx, geometry.half_across(pressed_by) / rows as f64];
        let grid = Grid::new(geometry, raster, delta, size, half, &fineness).ok()?;
        Some(Self { grid, half, size, delta, unit: PI * geometry.modulus / dx, tolerance: fineness.tolerance })
    }

    /// Pressures with the contact's middle before cell `middle`.
    fn field(&self, middle: i64) -> Option<Field> {
        let mut presser = Presser::new(&self.grid);
        let pressed = presser.pressed(&self.grid.window(middle), self.delta, self.tolerance);
        if pressed.energy <= 0.0 {
            return None;
        }
        let along = 2 * self.half;
        let [dx, dz] = self.size;
        let p: Vec<f64> = presser.contact.p.iter().map(|p| p * self.unit).collect();
        let mirrored = self.grid.influence.cells().mirrored;
        let other = p.chunks_exact(along).rev().flatten().copied().filter(|_| mirrored);
        let pressure: Vec<f64> = other.chain(p.iter().copied()).collect();
        let sides = if mirrored { 2.0 } else { 1.0 };
        let area = sides * dx * dz * self.unit;
        let across = pressure.len() / along;
        let first = [(middle as f64 - self.half as f64 + 0.5) * dx, (0.5 - 0.5 * across as f64) * dz];
        let most = |a: (usize, f64), b: (usize, f64)| if b.1 > a.1 { b } else { a };
        let (cell, largest) = pressure.iter().copied().enumerate().fold((0, 0.0), most);
        Some(Field {
            cells: [along, across],
            size: self.size,
            first,
            at: [first[0] + dx * (cell % along) as f64, first[1] + dz * (cell / along) as f64],
            middle: middle as f64 * dx,
            largest,
            pressure,
            force: pressed.force * area,
            energy: pressed.energy * area,
        })
    }
}

/// Pressures at the deformation `delta` (m) with the contact's middle at `s` (m), to the nearest cell. `None` where nothing touches.
pub fn pressure_at(geometry: &Geometry, raster: &Raster, delta: f64, s: f64, accuracy: Tables) -> Option<Field> {
    let window = Window::new(geometry, raster, delta, accuracy).filter(|_| s.is_finite())?;
    window.field((s / window.size[0]).round() as i64)
}

impl Field {
    /// With s counted from `s` (m) on.
    pub(super) fn seen_from(mut self, s: f64) -> Self {
        for place in [&mut self.first[0], &mut self.at[0], &mut self.middle] {
            *place -= s;
        }
        self
    }

    /// The largest pressure in cells that meet `bounds`, and its s and z: a straight roller's end may press more elsewhere. `None`
    /// where nothing presses there.
    fn within(&self, bounds: &Bounds) -> Option<(f64, [f64; 2])> {
        let cells = |axis: usize, [low, high]: [f64; 2]| {
            let cell = |x: f64| (x - self.first[axis]) / self.size[axis] + 0.5;
            let end = |x: f64| x.clamp(0.0, self.cells[axis] as f64) as usize;
            end(cell(low).floor())..end(cell(high).ceil())
        };
        let (along, across) = (cells(0, bounds.s), cells(1, bounds.z));
        let all = across.flat_map(|row| along.clone().map(move |column| [column, row]));
        let pressure = |[column, row]: [usize; 2]| self.pressure[row * self.cells[0] + column];
        let most = all.max_by(|a, b| pressure(*a).total_cmp(&pressure(*b))).filter(|cell| pressure(*cell) > 0.0)?;
        Some((pressure(most), [0, 1].map(|k| self.first[k] + self.size[k] * most[k] as f64)))
    }

    /// Share of the pressed area whose pressure is above `limit`, Pa.
    pub fn share_above(&self, limit: f64) -> f64 {
        let cells = |least: f64| self.pressure.iter().filter(|p| **p > least).count() as f64;
        cells(limit) / cells(0.0).max(1.0)
    }
}

/// The largest pressure of the healthy contact at `delta` (m) on the same grid, Pa.
pub(super) fn healthy(geometry: &Geometry, delta: f64) -> Option<f64> {
    let whole = Raster::of_depths(Bounds { s: [-1e-3, 1e-3], z: [-1e-3, 1e-3] }, 0.0, |_, _| 0.0);
    pressure_at(geometry, &whole, delta, 0.0, Tables::Standard).map(|field| field.largest)
}

/// Places between the first and the last edge at the most.
const PLACES: i64 = 160;

/// Pressures at `delta` (m) where they are largest over damage within `bounds` while the contact passes it. The place is found on
/// the grid of [`Tables::Coarse`] in steps of a quarter of the contact's half-width, or longer ones in long damage.
pub(super) fn largest_pressure(geometry: &Geometry, raster: &Raster, delta: f64, bounds: &Bounds) -> Option<Field> {
    let coarse = Window::new(geometry, raster, delta, Tables::Coarse)?;
    let dx = coarse.size[0];
    let reach = geometry.reach(delta.max(0.0));
    let [first, last] = [((bounds.s[0] - reach) / dx).floor() as i64, ((bounds.s[1] + reach) / dx).ceil() as i64];
    let quarter = (0.25 * geometry.half_width(delta + raster.raised()) / dx).round() as i64;
    let step = quarter.max((last - first) / PLACES).max(1);
    let mut largest: Option<(f64, i64)> = None;
    let mut before: Option<(Vec<usize>, Option<Field>)> = None;
    for middle in (first..=last).step_by(step as usize) {
        let window = coarse.grid.window(middle);
        // What lies under the contact is the same, and so is the pressure, about another middle.
        let field = match before.take() {
            Some((same, field)) if same == window => field.map(|field| {
                let moved = field.middle - middle as f64 * dx;
                field.seen_from(moved)
            }),
            _ => coarse.field(middle),
        };
        if let Some((most, _)) = field.as_ref().and_then(|field| field.within(bounds))
            && largest.is_none_or(|(before, _)| most > before)
        {
            largest = Some((most, middle));
        }
        before = Some((window, field));
    }
    let field = pressure_at(geometry, raster, delta, largest?.1 as f64 * dx, Tables::Standard)?;
    let (largest, at) = field.within(bounds)?;
    Some(Field { largest, at, ..field })
}
