//! Damage drawn by hand: the area under a round pen, and depth taken off or put back by a round brush.

use crate::svg_union::united;
use crate::{DamageError, DepthGrid, Polygons};
use i_overlay::core::fill_rule::FillRule;
use std::f64::consts::PI;

/// Corners of half a round end.
const CORNERS: usize = 8;
/// Most points of a stroke, and most nodes of a grid that a brush makes.
const MOST_POINTS: usize = 2000;
const MOST_NODES: usize = 1 << 18;
/// Widest pen, mm.
const WIDEST_MM: f64 = 100.0;

/// A line as it was drawn: points (s, z) in mm and the width of the pen, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke<'a> {
    /// At least one.
    pub points_mm: &'a [[f64; 2]],
    /// Above 0.
    pub width_mm: f64,
}

impl Stroke<'_> {
    fn check(&self) -> Result<(), DamageError> {
        let sound = |p: &[f64; 2]| p.iter().all(|x| x.is_finite() && x.abs() < 1e4);
        let wide = self.width_mm > 0.0 && self.width_mm <= WIDEST_MM;
        let count = (1..=MOST_POINTS).contains(&self.points_mm.len());
        match wide && count && self.points_mm.iter().all(sound) {
            true => Ok(()),
            false => Err(DamageError::Option {
                option: "stroke",
                value: format!("{} points, {} mm wide", self.points_mm.len(), self.width_mm),
                allowed: "1 to 2000 points within 10 m, above 0 and up to 100 mm wide",
            }),
        }
    }

    /// Without points that lie closer than a tenth of the pen: they change nothing that is seen.
    fn thinned(&self) -> Vec<[f64; 2]> {
        let mut kept: Vec<[f64; 2]> = Vec::new();
        for point in self.points_mm {
            let near = |q: &[f64; 2]| distance(*q, *point) < 0.1 * self.width_mm;
            if !kept.last().is_some_and(near) {
                kept.push(*point);
            }
        }
        kept
    }

    /// Distance (mm) of a place from the line.
    fn distance(points: &[[f64; 2]], at: [f64; 2]) -> f64 {
        let single = points.first().map_or(f64::INFINITY, |p| distance(*p, at));
        let along = points.windows(2).map(|ends| {
            let (a, b) = (ends[0], ends[1]);
            let (d, p) = ([b[0] - a[0], b[1] - a[1]], [at[0] - a[0], at[1] - a[1]]);
            let length = d[0] * d[0] + d[1] * d[1];
            let share = ((p[0] * d[0] + p[1] * d[1]) / length).clamp(0.0, 1.0);
            distance([a[0] + share * d[0], a[1] + share * d[1]], at)
        });
        along.fold(single, f64::min)
    }
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// The area that a round pen covers, as outlines (mm).
///
/// # Errors
/// Where the stroke is no line, or its width is out of range.
pub fn scratch(stroke: &Stroke) -> Result<Polygons, DamageError> {
    stroke.check()?;
    let points = stroke.thinned();
    let radius = 0.5 * stroke.width_mm;
    // A single point is a stroke of no length.
    let last = points[points.len() - 1];
    let ends = points.windows(2).map(|w| (w[0], w[1]));
    let dot = (points.len() == 1).then_some((last, last));
    let rings: Vec<Vec<[f64; 2]>> = ends
        .chain(dot)
        .map(|(a, b)| capsule(a, b, radius))
        .collect();
    Ok(Polygons {
        polygons_mm: united(&rings, FillRule::NonZero),
        ..Polygons::default()
    })
}

/// All places within `radius` of the line from `a` to `b`, counter-clockwise.
fn capsule(a: [f64; 2], b: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    let heading = (b[1] - a[1]).atan2(b[0] - a[0]);
    let end = |center: [f64; 2], from: f64| {
        (0..=CORNERS).map(move |k| {
            let (sin, cos) = (from + PI * k as f64 / CORNERS as f64).sin_cos();
            [center[0] + radius * cos, center[1] + radius * sin]
        })
    };
    end(b, heading - 0.5 * PI)
        .chain(end(a, heading + 0.5 * PI))
        .collect()
}

/// A grid with depth added under a brush (or taken off, where `depth_um` is negative; never below the sound surface): all of it along the line,
/// nothing at the brush's rim, with the square of the distance between. Without a grid a new one begins.
///
/// # Errors
/// As [`scratch`], and where the grid would get too large.
pub fn brush(
    grid: Option<&DepthGrid>,
    stroke: &Stroke,
    depth_um: f64,
) -> Result<DepthGrid, DamageError> {
    stroke.check()?;
    let points = stroke.thinned();
    let radius = 0.5 * stroke.width_mm;
    let mut grid = grown(grid, &points, radius)?;
    let (columns, ds, dz) = (grid.columns, grid.ds_mm, grid.dz_mm);
    let [s0, z0] = [grid.s0_mm, grid.z0_mm];
    for (k, depth) in grid.depth_um.iter_mut().enumerate() {
        let at = [
            s0 + ds * (k % columns) as f64,
            z0 + dz * (k / columns) as f64,
        ];
        let far = Stroke::distance(&points, at) / radius;
        if far < 1.0 {
            *depth = (*depth + depth_um * (1.0 - far * far)).max(0.0);
        }
    }
    Ok(grid)
}

/// A grid that reaches a node beyond the brush on every side; its steps are those that it has, or a sixteenth of the brush.
fn grown(
    grid: Option<&DepthGrid>,
    points: &[[f64; 2]],
    radius: f64,
) -> Result<DepthGrid, DamageError> {
    let fresh = (radius / 8.0).clamp(0.005, 0.1);
    let steps = grid.map_or([fresh; 2], |g| [g.ds_mm, g.dz_mm]);
    let origin = grid.map_or([0.0; 2], |g| [g.s0_mm, g.z0_mm]);
    let counts = grid.map_or([0; 2], |g| [g.columns as i64, g.rows as i64]);
    // First node and the one past the last, counted from the origin of the old grid.
    let range = |axis: usize| {
        let values = points
            .iter()
            .map(|p| (p[axis] - origin[axis]) / steps[axis]);
        let (low, high) = values.fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)));
        let reach = radius / steps[axis] + 1.0;
        let (low, high) = (
            (low - reach).floor() as i64,
            (high + reach).ceil() as i64 + 1,
        );
        match counts[axis] {
            0 => (low, high),
            n => (low.min(0), high.max(n)),
        }
    };
    let ((s_low, s_high), (z_low, z_high)) = (range(0), range(1));
    let (columns, rows) = ((s_high - s_low) as usize, (z_high - z_low) as usize);
    if columns.saturating_mul(rows) > MOST_NODES {
        return Err(DamageError::Option {
            option: "brush",
            value: format!("{columns} x {rows} nodes"),
            allowed: "262144 nodes at most; draw smaller, or with a wider brush from the start",
        });
    }
    let mut depth_um = vec![0.0; columns * rows];
    if let Some(old) = grid {
        for row in 0..old.rows {
            let to = (row + (-z_low) as usize) * columns + (-s_low) as usize;
            let from = row * old.columns;
            depth_um[to..to + old.columns].copy_from_slice(&old.depth_um[from..from + old.columns]);
        }
    }
    Ok(DepthGrid {
        s0_mm: origin[0] + steps[0] * s_low as f64,
        z0_mm: origin[1] + steps[1] * z_low as f64,
        ds_mm: steps[0],
        dz_mm: steps[1],
        columns,
        rows,
        depth_um,
        ..DepthGrid::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A straight stroke covers length times width and a circle of its ends; the circle has 16 corners.
    #[test]
    fn analytic_area_of_a_straight_scratch_and_of_a_dot() {
        let polygon = 0.5 * 16.0 * (2.0 * PI / 16.0).sin();
        for (points, length) in [(vec![[0.0, 0.0], [3.0, 0.0]], 3.0), (vec![[1.0, 2.0]], 0.0)] {
            let stroke = Stroke {
                points_mm: &points,
                width_mm: 0.5,
            };
            let area = scratch(&stroke).unwrap().area_mm2();
            let expected = 0.5 * length + polygon * 0.0625;
            assert!(
                (area - expected).abs() < 1e-3 * expected,
                "{area} {expected}"
            );
        }
    }

    #[test]
    fn prop_a_stroke_that_crosses_itself_is_one_area() {
        let points = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, -1.0]];
        let stroke = Stroke {
            points_mm: &points,
            width_mm: 0.2,
        };
        let crossed = scratch(&stroke).unwrap();
        let parts: f64 = points.windows(2).map(|w| distance(w[0], w[1]) * 0.2).sum();
        assert!(crossed.area_mm2() < parts + 0.04 && crossed.area_mm2() > parts - 0.12);
    }

    #[test]
    fn prop_the_brush_adds_takes_off_and_grows_its_grid() {
        let stroke = Stroke {
            points_mm: &[[0.0, 0.0], [2.0, 0.0]],
            width_mm: 1.0,
        };
        let once = brush(None, &stroke, 10.0).unwrap();
        let deepest = |g: &DepthGrid| g.depth_um.iter().copied().fold(0.0, f64::max);
        assert!((deepest(&once) - 10.0).abs() < 0.05);
        let aside = Stroke {
            points_mm: &[[5.0, 1.0]],
            width_mm: 1.0,
        };
        let wider = brush(Some(&once), &aside, 4.0).unwrap();
        assert!(wider.columns > once.columns && wider.rows > once.rows);
        let sum = |g: &DepthGrid| g.depth_um.iter().sum::<f64>();
        assert!(sum(&wider) > sum(&once));
        let back = brush(Some(&wider), &aside, -4.0).unwrap();
        assert!((sum(&back) - sum(&once)).abs() < 1e-9 * sum(&once));
        let far = Stroke {
            points_mm: &[[5000.0, 0.0]],
            width_mm: 1.0,
        };
        assert!(brush(Some(&once), &far, 1.0).is_err());
        for width_mm in [0.0, -1.0, f64::NAN, 1e9] {
            let points_mm = stroke.points_mm;
            assert!(
                scratch(&Stroke {
                    points_mm,
                    width_mm
                })
                .is_err()
            );
        }
    }
}
