//! Depths of a defect as means over small cells: what a solver on a grid sees of it. s from the defect's centre, z from the row's middle, m.

use super::placed::Defect;
use super::shape::Shape;

/// Lines s = const across a column of cells. What lies between two z on each is exact.
const LINES: usize = 4;
/// Sides of an outline for every part of the arc that lists them.
const SIDES_LISTED: usize = 8;

/// A defect ready to be averaged over cells.
#[derive(Debug)]
pub struct MeanDepths<'a> {
    defect: &'a Defect,
    /// Parts of an outline's arc: the sides that meet each.
    parts: Vec<Vec<[[f64; 2]; 2]>>,
}

impl<'a> MeanDepths<'a> {
    /// Of a defect.
    pub fn new(defect: &'a Defect) -> Self {
        let mut parts = Vec::new();
        if let Shape::Outline(outline) = &defect.shape {
            let sides: usize = outline.polygons().iter().map(Vec::len).sum();
            parts = vec![Vec::new(); (sides / SIDES_LISTED).clamp(1, 10_000)];
            let (first, last) = defect.shape.arc();
            let scale = parts.len() as f64 / (last - first);
            for polygon in outline.polygons() {
                for (k, to) in polygon.iter().enumerate() {
                    let from = polygon[(k + polygon.len() - 1) % polygon.len()];
                    let part = |s: f64| (((s - first) * scale).max(0.0) as usize).min(parts.len() - 1);
                    let (low, high) = (part(from[0].min(to[0])), part(from[0].max(to[0])));
                    parts[low..=high].iter_mut().for_each(|part| part.push([from, *to]));
                }
            }
        }
        Self { defect, parts }
    }

    /// First and last s and z of what can be met, m.
    pub fn bounds(&self) -> [[f64; 2]; 2] {
        let end = 0.5 * self.defect.roller_length;
        [self.defect.shape.arc().into(), self.defect.heights().map(|z| z.clamp(-end, end))]
    }

    /// Adds to each cell of a column between two s its mean depth; cells from z = `low` on, each `step` wide.
    pub fn add(&self, [from, to]: [f64; 2], (low, step): (f64, f64), column: &mut [f64]) {
        let (first, last) = self.defect.shape.arc();
        let met = [from.max(first), to.min(last)];
        if met[0] >= met[1] {
            return;
        }
        let width = (met[1] - met[0]) / LINES as f64;
        for k in 0..LINES {
            let s = met[0] + (k as f64 + 0.5) * width;
            self.add_line(s, width / (to - from), (low, step), column);
        }
    }

    fn add_line(&self, s: f64, weight: f64, (low, step): (f64, f64), column: &mut [f64]) {
        let defect = self.defect;
        let mut add = |[from, to]: [f64; 2], depth: f64| {
            let [from, to] = [from, to].map(|z| ((z - low) / step).clamp(0.0, column.len() as f64));
            let cells = from as usize..(to.ceil() as usize).min(column.len());
            for k in cells {
                let covered = to.min(k as f64 + 1.0) - from.max(k as f64);
                column[k] += weight * depth * covered.max(0.0);
            }
        };
        match &defect.shape {
            Shape::Outline(_) => {
                for between in self.crossed(s).chunks_exact(2) {
                    add([between[0], between[1]], defect.depth);
                }
            }
            Shape::DepthMap(grid) => {
                for (k, cell) in column.iter_mut().enumerate() {
                    for part in [0.25, 0.75] {
                        let z = low + (k as f64 + part) * step;
                        *cell += 0.5 * weight * grid.under(s, z).unwrap_or(0.0);
                    }
                }
            }
            shape => {
                let half = 0.5 * shape.damaged_length(s);
                add([defect.middle - half, defect.middle + half], defect.depth_at(s));
            }
        }
    }

    /// z at which an outline's sides cross a line s = const, rising.
    fn crossed(&self, s: f64) -> Vec<f64> {
        let (first, last) = self.defect.shape.arc();
        let part = (s - first) / (last - first) * self.parts.len() as f64;
        let Some(sides) = self.parts.get((part.max(0.0) as usize).min(self.parts.len().saturating_sub(1))) else {
            return Vec::new();
        };
        let mut all: Vec<f64> = sides
            .iter()
            .filter(|[from, to]| (from[0] <= s) != (to[0] <= s))
            .map(|[from, to]| from[1] + (to[1] - from[1]) * (s - from[0]) / (to[0] - from[0]))
            .collect();
        all.sort_by(f64::total_cmp);
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::{self, Scenario, Surface};

    fn defect(shape: scenario::Shape, axial_offset_mm: f64) -> Defect {
        let text = "[bearing]\npreset = \"NN3007\"\n[operation]\nspeed_rpm = 1800\nload_n = [300, 0]\n[simulation]\nduration_s = 0.1";
        let scenario = Scenario::from_toml(text).unwrap();
        let defect = scenario::Defect {
            on: Surface::OuterRaceway,
            row: 1,
            center_deg: 0.0,
            depth_um: 20.0,
            axial_offset_mm,
            shape,
            table: None,
        };
        Defect::new(&defect, &scenario.bearing, &scenario.contact).unwrap()
    }

    /// Volume by means over cells, m^3, over that of area and depth.
    fn volume_ratio(defect: &Defect) -> f64 {
        let mean = MeanDepths::new(defect);
        let [s, z] = mean.bounds();
        let (columns, rows) = (301, 203);
        let (ds, dz) = ((s[1] - s[0]) / f64::from(columns), (z[1] - z[0]) / f64::from(rows));
        let mut sum = 0.0;
        for k in 0..columns {
            let mut column = vec![0.0; rows as usize];
            let from = s[0] + f64::from(k) * ds;
            mean.add([from, from + ds], (z[0], dz), &mut column);
            sum += column.iter().sum::<f64>() * ds * dz;
        }
        sum / (defect.shape.area() * defect.depth)
    }

    #[test]
    fn analytic_means_over_cells_add_up_to_the_volume() {
        let star = vec![vec![[-1.0, -0.5], [1.2, -0.7], [0.1, 0.0], [0.9, 1.1], [-0.8, 0.4]]];
        let shapes = [
            scenario::Shape::Rectangle { length_mm: 3.0, width_mm: 4.0 },
            scenario::Shape::Circle { diameter_mm: 1.5 },
            scenario::Shape::Li2023Irregular { max_width_mm: 4.0 },
            scenario::Shape::Outline { polygons_mm: star },
        ];
        for (shape, offset) in shapes.into_iter().zip([0.3, -0.5, 0.0, 0.4]) {
            let ratio = volume_ratio(&defect(shape.clone(), offset));
            assert!((ratio - 1.0).abs() < 2e-4, "{shape:?}: {ratio}");
        }
    }
}
