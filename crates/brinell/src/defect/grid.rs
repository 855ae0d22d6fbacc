//! Damage as depths on a grid: bilinear between its nodes, 0 beyond its border. Lengths in m.

use super::piecewise::{Line, PiecewisePolynomial};
use crate::scenario::DepthGrid;

/// Depths at the nodes of a grid, with their width L_s(s) and mean depth h_s(s), and what the surface between the nodes
/// covers.
///
/// The law `ecl` needs one width and one depth at each s. In L_s every damaged node (depth other than 0) represents its
/// cell, dz wide; h_s is the mean depth over that width, so that L_s h_s is the section of the damage at a column. Both
/// are tabulated at the columns and straight between them. What the surface itself covers is [`Covered`].
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    start: [f64; 2],
    step: [f64; 2],
    columns: usize,
    rows: usize,
    depth: Vec<f64>,
    width: PiecewisePolynomial,
    mean: PiecewisePolynomial,
    mean_lines: Vec<Line>,
    covered: Covered,
}

/// What the bilinear surface of a grid covers: between four nodes it is damaged unless all four are 0. SI.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Covered {
    /// Largest measure of the damaged z at one s, m.
    pub widest: f64,
    /// Seen from above, m^2.
    pub area: f64,
    /// Below the sound surface, m^3; raised nodes count 0.
    pub volume: f64,
}

impl Grid {
    /// From the scenario's units. `None` where the sizes do not fit, a number is not finite, or nothing is damaged.
    pub fn new(grid: &DepthGrid) -> Option<Self> {
        let nodes = grid.columns.checked_mul(grid.rows)?;
        let numbers = [grid.s0_mm, grid.z0_mm, grid.ds_mm, grid.dz_mm];
        let fits = grid.columns >= 2
            && grid.rows >= 2
            && grid.depth_um.len() == nodes
            && grid.ds_mm > 0.0
            && grid.dz_mm > 0.0
            && numbers.iter().chain(&grid.depth_um).all(|x| x.is_finite());
        if !fits || grid.depth_um.iter().all(|h| *h == 0.0) {
            return None;
        }
        let mut this = Self {
            start: [1e-3 * grid.s0_mm, 1e-3 * grid.z0_mm],
            step: [1e-3 * grid.ds_mm, 1e-3 * grid.dz_mm],
            columns: grid.columns,
            rows: grid.rows,
            depth: grid.depth_um.iter().map(|h| 1e-6 * h).collect(),
            width: PiecewisePolynomial::default(),
            mean: PiecewisePolynomial::default(),
            mean_lines: Vec::new(),
            covered: Covered::default(),
        };
        this.tabulate(f64::INFINITY);
        Some(this)
    }

    /// The same, moved along z by `offset` (m).
    pub fn moved(mut self, offset: f64) -> Self {
        self.start[1] += offset;
        self
    }

    /// Leaves out what a roller of length L (m) does not reach: cells beyond |z| = L/2.
    pub fn within(mut self, length: f64) -> Self {
        self.tabulate(0.5 * length);
        self
    }

    fn tabulate(&mut self, reach: f64) {
        let half = 0.5 * self.step[1];
        let cells: Vec<f64> = (0..self.rows)
            .map(|row| {
                let z = self.z(row);
                ((z + half).min(reach) - (z - half).max(-reach)).max(0.0)
            })
            .collect();
        let mut width = vec![0.0; self.columns];
        let mut section = vec![0.0; self.columns];
        for (row, cell) in cells.iter().enumerate() {
            for column in 0..self.columns {
                let h = self.depth[row * self.columns + column];
                if h != 0.0 {
                    width[column] += cell;
                    section[column] += cell * h;
                }
            }
        }
        let mean: Vec<f64> = width.iter().zip(&section).map(|(w, a)| if *w > 0.0 { a / w } else { 0.0 }).collect();
        self.width = PiecewisePolynomial::of_lines(&self.lines(&width));
        self.mean_lines = self.lines(&mean);
        self.mean = PiecewisePolynomial::of_lines(&self.mean_lines);
        self.covered = self.cover(reach);
    }

    /// Of what lies within |z| <= reach (m).
    fn cover(&self, reach: f64) -> Covered {
        let mut all = Covered::default();
        let rows = self.rows_within(-reach, reach);
        for column in 0..self.columns - 1 {
            let (mut width, mut section) = (0.0, 0.0);
            for &(row, [a, b]) in rows.iter().filter(|(row, _)| self.is_damaged(column, *row)) {
                width += b - a;
                let at = row * self.columns + column;
                let share = (0.5 * (a + b) - self.z(row)) / self.step[1];
                let mean = |low: usize, high: usize| 0.5 * (self.depth[low].max(0.0) + self.depth[high].max(0.0));
                let (below, above) = (mean(at, at + 1), mean(at + self.columns, at + self.columns + 1));
                section += (b - a) * ((1.0 - share) * below + share * above);
            }
            all.widest = all.widest.max(width);
            all.area += width * self.step[0];
            all.volume += section * self.step[0];
        }
        all
    }

    /// What the surface between its nodes covers.
    pub fn covered(&self) -> Covered {
        self.covered
    }

    /// s of a column, m.
    fn s(&self, column: usize) -> f64 {
        self.start[0] + column as f64 * self.step[0]
    }

    /// The cells between rows within low..high (m): the row below each, and what of its z lies within.
    fn rows_within(&self, low: f64, high: f64) -> Vec<(usize, [f64; 2])> {
        (0..self.rows - 1)
            .map(|row| (row, [self.z(row).max(low), self.z(row + 1).min(high)]))
            .filter(|(_, [a, b])| a < b)
            .collect()
    }

    /// Whether anything is damaged between two columns and two rows, given the first of each.
    fn is_damaged(&self, column: usize, row: usize) -> bool {
        let at = row * self.columns + column;
        [at, at + 1, at + self.columns, at + self.columns + 1].iter().any(|k| self.depth[*k] != 0.0)
    }

    /// Depth of a column at z between the row given and the next, m.
    fn between_rows(&self, column: usize, row: usize, z: f64) -> f64 {
        let share = (z - self.z(row)) / self.step[1];
        let at = row * self.columns + column;
        (1.0 - share) * self.depth[at] + share * self.depth[at + self.columns]
    }

    /// The row below z; `None` beyond the grid.
    fn row_at(&self, z: f64) -> Option<usize> {
        Self::place((z - self.start[1]) / self.step[1], self.rows)
    }

    fn place(x: f64, nodes: usize) -> Option<usize> {
        (0.0..=(nodes - 1) as f64).contains(&x).then(|| (x as usize).min(nodes - 2))
    }

    /// Depth at (s, z), m; `None` where nothing is damaged.
    pub(super) fn under(&self, s: f64, z: f64) -> Option<f64> {
        let row = self.row_at(z)?;
        let column = Self::place((s - self.start[0]) / self.step[0], self.columns)?;
        self.is_damaged(column, row).then(|| {
            let share = (s - self.s(column)) / self.step[0];
            let (a, b) = (self.between_rows(column, row, z), self.between_rows(column + 1, row, z));
            a + share * (b - a)
        })
    }

    fn z(&self, row: usize) -> f64 {
        self.start[1] + row as f64 * self.step[1]
    }

    /// Straight between columns, without what is 0 at both.
    fn lines(&self, values: &[f64]) -> Vec<Line> {
        (0..self.columns - 1)
            .filter(|&c| values[c] != 0.0 || values[c + 1] != 0.0)
            .map(|c| Line { from: self.s(c), to: self.s(c + 1), at_from: values[c], at_to: values[c + 1] })
            .collect()
    }

    /// L_s(s), m.
    pub fn width(&self) -> &PiecewisePolynomial {
        &self.width
    }

    /// h_s(s): mean depth over the damaged width, m.
    pub fn mean_depth(&self) -> &PiecewisePolynomial {
        &self.mean
    }

    /// h_s(s) as straight pieces between columns.
    pub(super) fn mean_lines(&self) -> &[Line] {
        &self.mean_lines
    }

    /// Depth along the line z = const as straight pieces between columns; none beyond the grid.
    pub fn along(&self, z: f64) -> Vec<Line> {
        let place = (z - self.start[1]) / self.step[1];
        let top = (self.rows - 1) as f64;
        if !(-1e-9..=top + 1e-9).contains(&place) {
            return Vec::new();
        }
        let place = place.clamp(0.0, top);
        let row = (place as usize).min(self.rows - 2);
        let share = place - row as f64;
        let values: Vec<f64> = (0..self.columns)
            .map(|c| {
                let (a, b) = (self.depth[row * self.columns + c], self.depth[(row + 1) * self.columns + c]);
                (1.0 - share) * a + share * b
            })
            .collect();
        self.lines(&values)
    }

    /// Depth at (s, z), m; 0 where nothing is damaged.
    pub fn depth(&self, s: f64, z: f64) -> f64 {
        self.under(s, z).unwrap_or(0.0)
    }

    /// Deepest and highest node, m; the highest is below 0 where an edge is raised.
    pub fn extremes(&self) -> (f64, f64) {
        let all = || self.depth.iter().copied();
        (all().fold(f64::NEG_INFINITY, f64::max), all().fold(f64::INFINITY, f64::min))
    }

    /// Smallest and largest z of damaged nodes with the ramp to their undamaged neighbours, m.
    pub fn heights(&self) -> (f64, f64) {
        let damaged = |row: &usize| self.depth[row * self.columns..(row + 1) * self.columns].iter().any(|h| *h != 0.0);
        let first = (0..self.rows).find(damaged).unwrap_or(0);
        let last = (0..self.rows).rfind(damaged).unwrap_or(0);
        (self.z(first.saturating_sub(1)), self.z((last + 1).min(self.rows - 1)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_pyramid() {
        // One node 6 um deep in the middle of 5 x 3 nodes, 1 mm apart: a tent in every direction.
        let mut depth_um = vec![0.0; 15];
        depth_um[7] = 6.0;
        let g =
            Grid::new(&DepthGrid { s0_mm: -2.0, z0_mm: -1.0, ds_mm: 1.0, dz_mm: 1.0, columns: 5, rows: 3, depth_um })
                .unwrap();
        for (s, z, h) in [(0.0, 0.0, 6.0), (0.5, 0.0, 3.0), (0.5, -0.5, 1.5), (1.5, 0.0, 0.0), (0.0, 1.2, 0.0)] {
            assert!((g.depth(1e-3 * s, 1e-3 * z) - 1e-6 * h).abs() < 1e-18, "at {s} {z}");
        }
        assert_eq!(g.width().span(), (-1e-3, 1e-3));
        assert!((g.width().value(0.0) - 1e-3).abs() < 1e-15);
        assert!((g.mean_depth().value(0.0) - 6e-6).abs() < 1e-18);
        assert!((g.clone().within(0.4e-3).width().value(0.0) - 0.4e-3).abs() < 1e-15);
        assert_eq!(g.extremes(), (6e-6, 0.0));
        // The tent covers four cells of 1 mm^2; its volume is a quarter of their box.
        let c = g.covered();
        assert!((c.widest - 2e-3).abs() < 1e-15 && (c.area - 4e-6).abs() < 1e-18, "{c:?}");
        assert!((c.volume - 6e-12).abs() < 1e-24, "{c:?}");
        let c = g.within(1.0e-3).covered();
        assert!((c.widest - 1e-3).abs() < 1e-15 && (c.area - 2e-6).abs() < 1e-18, "{c:?}");
        assert!((c.volume - 4.5e-12).abs() < 1e-24, "{c:?}");
    }
}
