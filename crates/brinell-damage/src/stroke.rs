//! Damage drawn by hand: the area under a round pen, and depth taken off or put back by a round brush.

use crate::error::check_range;
use crate::outline::{DEEPEST_UM, check_grid};
use crate::svg_union::united;
use crate::{DamageError, Polygons};
use brinell::scenario::DepthGrid;
use i_overlay::core::fill_rule::FillRule;
use std::f64::consts::PI;

/// Corners of half a round end.
const CORNERS: usize = 8;
/// Areas that are united at once.
const AT_ONCE: usize = 8;
/// Most points of a stroke.
const MOST_POINTS: usize = 2000;
/// Most nodes of a grid that a brush grows, and of one that it begins, whose steps are wider where it would have more:
/// a stroke is worked out while the hand moves.
const MOST_NODES: usize = 1 << 16;
const MOST_FRESH: f64 = 16384.0;
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
    let rings: Vec<Vec<[f64; 2]>> = ends.chain(dot).map(|(a, b)| capsule(a, b, radius)).collect();
    Ok(Polygons { polygons_mm: covered(&rings), ..Polygons::default() })
}

/// The union of areas that follow each other along a line. Neighbours are united first: what lies inside is gone before
/// far parts meet, so the cost grows little faster than the number of areas.
fn covered(rings: &[Vec<[f64; 2]>]) -> Vec<Vec<[f64; 2]>> {
    if rings.len() <= AT_ONCE {
        return united(rings, FillRule::NonZero);
    }
    let (before, after) = rings.split_at(rings.len() / 2);
    let halves = [covered(before), covered(after)].concat();
    united(&halves, FillRule::NonZero)
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
    end(b, heading - 0.5 * PI).chain(end(a, heading + 0.5 * PI)).collect()
}

/// A grid with depth added under a brush, or taken off, where `depth_um` is negative: then up to the sound surface, and
/// what is raised above that stays as it is. All of it along the line, nothing at the brush's rim, with the square of the
/// distance between. Without a grid a new one begins.
///
/// # Errors
/// As [`scratch`]; where the grid's sizes do not fit its depths, or it would get too large; where the depth is no number.
pub fn brush(grid: Option<&DepthGrid>, stroke: &Stroke, depth_um: f64) -> Result<DepthGrid, DamageError> {
    stroke.check()?;
    grid.map_or(Ok(()), check_grid)?;
    check_range("depth_um", depth_um.abs(), -f64::MIN_POSITIVE, DEEPEST_UM, "within 1 km")?;
    let points = stroke.thinned();
    let radius = 0.5 * stroke.width_mm;
    let mut grid = grown(grid, &points, radius)?;
    let far = Distances::of(&grid, &points, radius).squared;
    for (depth, far) in grid.depth_um.iter_mut().zip(far) {
        let share = far / (radius * radius);
        if share < 1.0 {
            *depth = (*depth + depth_um * (1.0 - share)).max(depth.min(0.0));
        }
    }
    Ok(grid)
}

/// Squared distances (mm^2) of a grid's nodes from a line, where they are within a radius. Only nodes near a part of
/// the line are visited.
struct Distances {
    squared: Vec<f64>,
}

impl Distances {
    fn of(grid: &DepthGrid, points: &[[f64; 2]], radius: f64) -> Self {
        let squared = vec![f64::INFINITY; grid.columns * grid.rows];
        let mut all = Self { squared };
        let last = points[points.len() - 1];
        for (k, from) in points.iter().enumerate() {
            let to = points.get(k + 1).copied().unwrap_or(last);
            all.along(grid, *from, to, radius);
        }
        all
    }

    fn along(&mut self, grid: &DepthGrid, a: [f64; 2], b: [f64; 2], radius: f64) {
        let d = [b[0] - a[0], b[1] - a[1]];
        let length = (d[0] * d[0] + d[1] * d[1]).max(f64::MIN_POSITIVE);
        for row in 0..grid.rows {
            let z = grid.z0_mm + grid.dz_mm * row as f64;
            // The part of the line that is within the radius of this row of nodes, from 0 to 1.
            let [low, high] = match d[1] == 0.0 {
                true if (z - a[1]).abs() < radius => [0.0, 1.0],
                true => continue,
                false => {
                    let ends = [-radius, radius].map(|r| (z + r - a[1]) / d[1]);
                    [ends[0].min(ends[1]).max(0.0), ends[0].max(ends[1]).min(1.0)]
                }
            };
            if low > high {
                continue;
            }
            let ends = [a[0] + low * d[0], a[0] + high * d[0]];
            let node = |s: f64| ((s - grid.s0_mm) / grid.ds_mm).max(0.0);
            let first = node(ends[0].min(ends[1]) - radius) as usize;
            let past = (node(ends[0].max(ends[1]) + radius) as usize + 2).min(grid.columns);
            for column in first..past {
                let p = [grid.s0_mm + grid.ds_mm * column as f64 - a[0], z - a[1]];
                let share = ((p[0] * d[0] + p[1] * d[1]) / length).clamp(0.0, 1.0);
                let off = [p[0] - share * d[0], p[1] - share * d[1]];
                let place = &mut self.squared[row * grid.columns + column];
                *place = place.min(off[0] * off[0] + off[1] * off[1]);
            }
        }
    }
}

/// A grid that reaches a node beyond the brush on every side; its steps are those that it has, or a sixteenth of the
/// brush, or as wide as a long stroke needs.
fn grown(grid: Option<&DepthGrid>, points: &[[f64; 2]], radius: f64) -> Result<DepthGrid, DamageError> {
    let extent = |axis: usize| {
        let values = points.iter().map(|p| p[axis]);
        let (low, high) = values.fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)));
        high - low + 2.0 * radius
    };
    let wide = (extent(0) * extent(1) / MOST_FRESH).sqrt();
    let fresh = (radius / 8.0).clamp(0.005, 0.1).max(wide);
    let steps = grid.map_or([fresh; 2], |g| [g.ds_mm, g.dz_mm]);
    let origin = grid.map_or([0.0; 2], |g| [g.s0_mm, g.z0_mm]);
    let counts = grid.map_or([0; 2], |g| [g.columns as i64, g.rows as i64]);
    // First node and the one past the last, counted from the origin of the old grid.
    let range = |axis: usize| {
        let values = points.iter().map(|p| (p[axis] - origin[axis]) / steps[axis]);
        let (low, high) = values.fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)));
        let reach = radius / steps[axis] + 1.0;
        let (low, high) = ((low - reach).floor() as i64, (high + reach).ceil() as i64 + 1);
        match counts[axis] {
            0 => (low, high),
            n => (low.min(0), high.max(n)),
        }
    };
    let ((s_low, s_high), (z_low, z_high)) = (range(0), range(1));
    let (columns, rows) = ((s_high - s_low) as usize, (z_high - z_low) as usize);
    let is_coarse = grid.is_none() && fresh > radius / 2.0;
    if is_coarse || columns.saturating_mul(rows) > MOST_NODES {
        return Err(DamageError::Option {
            option: "brush",
            value: format!("{columns} x {rows} nodes"),
            allowed: "65536 nodes at most, four across the brush; draw smaller, or with a wider brush from the start",
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
            let stroke = Stroke { points_mm: &points, width_mm: 0.5 };
            let area = scratch(&stroke).unwrap().area_mm2();
            let expected = 0.5 * length + polygon * 0.0625;
            assert!((area - expected).abs() < 1e-3 * expected, "{area} {expected}");
        }
    }

    /// To and fro over the same place: however the parts are united, the area is that of all at once.
    #[test]
    fn prop_a_long_stroke_is_the_union_of_its_parts() {
        let points: Vec<[f64; 2]> = (0..60)
            .map(|k| {
                let k = f64::from(k);
                [0.05 * k, 1.5 * (2.4 * k).sin()]
            })
            .collect();
        let width_mm = 0.3;
        let points_mm = &points;
        let stroke = Stroke { points_mm, width_mm };
        let rings: Vec<Vec<[f64; 2]>> = (points.windows(2)).map(|w| capsule(w[0], w[1], 0.5 * width_mm)).collect();
        let at_once = Polygons { polygons_mm: united(&rings, FillRule::NonZero), ..Polygons::default() };
        let (area, expected) = (scratch(&stroke).unwrap().area_mm2(), at_once.area_mm2());
        assert!((area - expected).abs() < 1e-6 * expected, "{area} {expected}");
    }

    #[test]
    fn prop_a_long_stroke_of_a_narrow_brush_has_a_coarser_grid() {
        let across = |width_mm: f64| {
            let points_mm = &[[0.0, -2.0], [20.0, 2.0]];
            brush(None, &Stroke { points_mm, width_mm }, 5.0)
        };
        let grid = across(0.5).unwrap();
        assert!(grid.columns * grid.rows < 20_000 && grid.ds_mm < 0.125);
        assert!(across(0.1).is_err());
    }

    #[test]
    fn prop_a_stroke_that_crosses_itself_is_one_area() {
        let points = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, -1.0]];
        let stroke = Stroke { points_mm: &points, width_mm: 0.2 };
        let crossed = scratch(&stroke).unwrap();
        let parts: f64 = points.windows(2).map(|w| distance(w[0], w[1]) * 0.2).sum();
        assert!(crossed.area_mm2() < parts + 0.04 && crossed.area_mm2() > parts - 0.12);
    }

    /// Near the line every node has its distance from it, and elsewhere none is visited.
    #[test]
    fn analytic_distances_are_those_from_the_line() {
        let points = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.3], [0.4, 1.1], [-0.3, -0.2]];
        let radius = 0.37;
        let grid = grown(None, &points, radius).unwrap();
        let found = Distances::of(&grid, &points, radius).squared;
        for (k, found) in found.iter().enumerate() {
            let s = grid.s0_mm + grid.ds_mm * (k % grid.columns) as f64;
            let z = grid.z0_mm + grid.dz_mm * (k / grid.columns) as f64;
            // By a thousand points of each part.
            let parts = points.windows(2).flat_map(|w| {
                (0..=1000).map(move |i| {
                    let at = f64::from(i) / 1000.0;
                    let on = [0, 1].map(|x| w[0][x] + at * (w[1][x] - w[0][x]));
                    distance(on, [s, z])
                })
            });
            let expected = parts.fold(f64::MAX, f64::min);
            match expected < radius {
                true => assert!((found.sqrt() - expected).abs() < 2e-3, "{s} {z}"),
                false => assert!(found.sqrt() > radius - 2e-3, "{s} {z}"),
            }
        }
    }

    /// A scan has such places: the rim of a dent.
    #[test]
    fn analytic_the_brush_lowers_a_raised_place_and_raises_none() {
        let stroke = Stroke { points_mm: &[[0.0, 0.0]], width_mm: 1.0 };
        let depth_um = vec![-5.0; 15];
        let (steps, counts) = ([0.5, 0.25], [3, 5]);
        let raised = DepthGrid {
            s0_mm: -0.5,
            z0_mm: -0.5,
            ds_mm: steps[0],
            dz_mm: steps[1],
            columns: counts[0],
            rows: counts[1],
            depth_um,
        };
        let brushed = |depth_um: f64| {
            let grid = brush(Some(&raised), &stroke, depth_um).unwrap();
            let at = |s: f64, z: f64| {
                let node = |x: f64, from: f64, step: f64| ((x - from) / step).round() as usize;
                grid.depth_um[node(z, grid.z0_mm, grid.dz_mm) * grid.columns + node(s, grid.s0_mm, grid.ds_mm)]
            };
            // In the middle, half-way to the brush's rim, on it, and where nothing was raised.
            [at(0.0, 0.0), at(0.0, 0.25), at(0.0, 0.5), at(1.0, 0.0)]
        };
        assert_eq!(brushed(2.0), [-3.0, -3.5, -5.0, 0.0]);
        assert_eq!(brushed(8.0), [3.0, 1.0, -5.0, 0.0]);
        assert_eq!(brushed(-2.0), [-5.0, -5.0, -5.0, 0.0]);
    }

    #[test]
    fn prop_the_brush_adds_takes_off_and_grows_its_grid() {
        let stroke = Stroke { points_mm: &[[0.0, 0.0], [2.0, 0.0]], width_mm: 1.0 };
        let once = brush(None, &stroke, 10.0).unwrap();
        assert!((once.deepest_um() - 10.0).abs() < 0.05);
        let aside = Stroke { points_mm: &[[5.0, 1.0]], width_mm: 1.0 };
        let wider = brush(Some(&once), &aside, 4.0).unwrap();
        assert!(wider.columns > once.columns && wider.rows > once.rows);
        let sum = |g: &DepthGrid| g.depth_um.iter().sum::<f64>();
        assert!(sum(&wider) > sum(&once));
        let back = brush(Some(&wider), &aside, -4.0).unwrap();
        assert!((sum(&back) - sum(&once)).abs() < 1e-9 * sum(&once));
        assert!(brush(None, &stroke, f64::NAN).is_err());
        for bad in [DepthGrid { ds_mm: 0.0, ..once.clone() }, DepthGrid { s0_mm: f64::INFINITY, ..once.clone() }] {
            assert!(brush(Some(&bad), &stroke, 1.0).unwrap_err().to_string().starts_with("`grid` is"));
        }
        let far = Stroke { points_mm: &[[5000.0, 0.0]], width_mm: 1.0 };
        assert!(brush(Some(&once), &far, 1.0).is_err());
        for width_mm in [0.0, -1.0, f64::NAN, 1e9] {
            let points_mm = stroke.points_mm;
            assert!(scratch(&Stroke { points_mm, width_mm }).is_err());
        }
    }
}
