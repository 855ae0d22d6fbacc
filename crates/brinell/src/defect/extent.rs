//! How large damage is: one answer for terminal, pages, data sets and studio.

use super::Shape;

/// Length, width, area and depths of a shape, SI: what every output says of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Along s, m.
    pub length: f64,
    /// Along the axis, m: from the lowest to the highest z; for shapes that are only a width over s, the largest L_s.
    pub width: f64,
    /// Largest damaged length along the axis at one s, m: less than the width where undamaged surface lies between. A depth map counts the surface between its nodes.
    pub widest: f64,
    /// s of the middle, m.
    pub middle: f64,
    /// m^2.
    pub area: f64,
    /// Volume over area, m; the shape's own where it has depths, else the defect's.
    pub depth: f64,
    /// Of its deepest point, m; the shape's own where it has depths, else the defect's.
    pub deepest: f64,
    /// Height of its highest raised edge, m.
    pub raised: f64,
}

impl Extent {
    /// Of a shape; `depth` (m) is the defect's.
    pub fn of(shape: &Shape, depth: f64) -> Self {
        let (first, last) = shape.arc();
        let Sums { widest, area, volume, deepest } = match shape {
            Shape::DepthMap(grid) => {
                let covered = grid.covered();
                let (widest, deepest) = (covered.widest, grid.extremes().0);
                Sums { widest, area: covered.area, volume: covered.volume, deepest }
            }
            _ => Sums::by_midpoints(shape, depth),
        };
        let width = match shape {
            Shape::Outline(outline) => outline.heights().1 - outline.heights().0,
            Shape::DepthMap(grid) => grid.heights().1 - grid.heights().0,
            Shape::Circle { radius } => 2.0 * radius,
            _ => widest,
        };
        Self {
            length: last - first,
            width,
            widest,
            middle: 0.5 * (first + last),
            area,
            depth: if area > 0.0 { volume / area } else { depth },
            deepest,
            raised: shape.raised(),
        }
    }
}

/// What is summed over a shape, SI.
struct Sums {
    widest: f64,
    area: f64,
    volume: f64,
    deepest: f64,
}

impl Sums {
    fn by_midpoints(shape: &Shape, depth: f64) -> Self {
        const CELLS: u32 = 20_000;
        let (first, last) = shape.arc();
        let ds = (last - first) / f64::from(CELLS);
        let (mut widest, mut area, mut volume, mut deepest) = (0.0_f64, 0.0, 0.0, 0.0_f64);
        for k in 0..CELLS {
            let s = first + (f64::from(k) + 0.5) * ds;
            let (width, depth) = (shape.damaged_length(s), shape.own_depth(s).unwrap_or(depth));
            (widest, deepest) = (widest.max(width), deepest.max(depth));
            area += width * ds;
            volume += width * ds * depth;
        }
        // The extremes of a profile may be at its ends.
        for s in [first, last] {
            let inside = s + 1e-9 * (0.5 * (first + last) - s);
            widest = widest.max(shape.damaged_length(inside));
            deepest = deepest.max(shape.own_depth(inside).unwrap_or(depth));
        }
        Self { widest, area, volume, deepest }
    }
}
