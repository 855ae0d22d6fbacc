//! Damage seen from above, as polygons: exact, traced along its width, or the line of one depth.

use crate::outline::{level_of_area, outline};
use brinell::defect::{Shape, spall};
use brinell::scenario::{self, DepthGrid};
use std::f64::consts::TAU;

/// Corners of a drawn circle.
pub const CORNERS: usize = 113;

/// The grid of a shape that has one.
pub fn depth_grid(of: &scenario::Defect) -> Option<DepthGrid> {
    match &of.shape {
        scenario::Shape::DepthMap { grid } => Some(grid.clone()),
        scenario::Shape::Random { seed, length_mm, width_mm, roughness } => {
            Some(spall(*seed, *length_mm, *width_mm, *roughness, of.depth_um.max(1.0)))
        }
        _ => None,
    }
}

/// Where a grid's border is drawn if nobody says otherwise.
pub struct Contour {
    /// Depth of the line.
    pub level_um: f64,
    /// How far it may be simplified.
    pub tolerance_mm: f64,
}

impl Contour {
    /// At the depth at which the outline encloses as much area as the damaged nodes have, to a tenth of the finer step:
    /// about half-way down the ramps to sound nodes.
    ///
    /// # Errors
    /// Where no depth's line encloses that area.
    pub fn of(grid: &DepthGrid, shape: &Shape) -> Result<Self, crate::DamageError> {
        let level_um = level_of_area(grid, 1e6 * shape.area_in_ecl())?;
        Ok(Self { level_um, tolerance_mm: 0.1 * grid.ds_mm.min(grid.dz_mm) })
    }
}

/// The damage seen from above, mm: exact where it has corners, `points` of them on a curved edge; widths alone are
/// centred.
pub fn polygons_mm(of: &scenario::Defect, shape: &Shape, points: usize) -> Vec<Vec<[f64; 2]>> {
    match shape {
        Shape::Rectangle { half_length, width } if *width > 0.0 => {
            let (a, b) = (1e3 * half_length, 0.5e3 * width);
            vec![vec![[-a, -b], [a, -b], [a, b], [-a, b]]]
        }
        Shape::Circle { radius } => {
            let corner = |k: usize| {
                let (sin, cos) = (TAU * k as f64 / points as f64).sin_cos();
                [1e3 * radius * cos, 1e3 * radius * sin]
            };
            vec![(0..points).map(corner).collect()]
        }
        Shape::Outline(outline) => {
            let mm = |p: &Vec<[f64; 2]>| p.iter().map(|x| x.map(|x| 1e3 * x)).collect();
            outline.polygons().iter().map(mm).collect()
        }
        Shape::DepthMap(_) => depth_grid(of)
            .and_then(|grid| {
                let usual = Contour::of(&grid, shape).ok()?;
                outline(&grid, usual.level_um, usual.tolerance_mm).ok()
            })
            .map_or(Vec::new(), |outline| outline.polygons_mm),
        _ => centred(shape, points),
    }
}

/// Polygons around the parts where L_s > 0, half of it to either side.
fn centred(shape: &Shape, points: usize) -> Vec<Vec<[f64; 2]>> {
    let mut parts: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut open: Vec<[f64; 2]> = Vec::new();
    let mut close = |open: &mut Vec<[f64; 2]>| {
        let back: Vec<[f64; 2]> = open.iter().rev().filter(|p| p[1] > 0.0).map(|p| [p[0], -p[1]]).collect();
        if open.len() > 1 && !back.is_empty() {
            parts.push(open.drain(..).chain(back).collect());
        }
        open.clear();
    };
    for (s, width) in course(shape, points) {
        let half = 0.5 * width;
        if half > 0.0 || !open.is_empty() {
            open.push([s, half]);
        } else {
            // The last point without width before the damage begins.
            open = vec![[s, 0.0]];
        }
        if half <= 0.0 && open.len() > 1 {
            close(&mut open);
            open = vec![[s, 0.0]];
        }
    }
    close(&mut open);
    parts
}

/// (s, L_s) in mm over the arc: closer at its ends, twice where L_s jumps.
pub fn course(shape: &Shape, points: usize) -> Vec<(f64, f64)> {
    let (first, last) = shape.arc();
    let length = last - first;
    let mut nodes: Vec<f64> = match shape {
        Shape::Rectangle { .. } => vec![first, last],
        Shape::Outline(outline) => outline.width().breakpoints(),
        Shape::DepthMap(grid) => grid.width().breakpoints(),
        _ => {
            let n = points.max(2) - 1;
            let cosine = |k: usize| 0.5 - 0.5 * (0.5 * TAU * k as f64 / n as f64).cos();
            (0..=n).map(|k| first + length * cosine(k)).collect()
        }
    };
    if nodes.len() > 4 * points {
        let n = points.max(2) - 1;
        nodes = (0..=n).map(|k| first + length * k as f64 / n as f64).collect();
    }
    let hair = 1e-9 * length;
    let width = |s: f64| shape.damaged_length(s.clamp(first, last)).max(0.0);
    let mut all = Vec::with_capacity(nodes.len());
    let end = nodes.len() - 1;
    for (k, s) in nodes.into_iter().enumerate() {
        let s = if k == end { last } else { s };
        let (before, after) = (width(s - hair), width(s + hair));
        let (mm, jump) = (1e3 * s, (after - before).abs() > 1e-6 * length);
        // At an end the width on the inside; where there is hardly any, that of the end itself.
        let end_width = |inside: f64| match inside < 1e-4 * length {
            true => width(s),
            false => inside,
        };
        if k == 0 {
            all.push((mm, 1e3 * end_width(after)));
        } else if k == end {
            all.push((mm, 1e3 * end_width(before)));
        } else if jump {
            all.extend([(mm, 1e3 * before), (mm, 1e3 * after)]);
        } else {
            all.push((mm, 1e3 * width(s)));
        }
    }
    all
}
