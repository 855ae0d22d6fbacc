//! Outlines and floors of damage as functions of the arc: L_s(s) and h_s(s), section 3 and Eqs. (25)-(27).
//!
//! s in m from the defect's centre, counter-clockwise around the surface; L_s and h_s in m. Outside `[first, last]` there is no
//! damage.

use super::grid::Grid;
use super::outline::Outline;
use super::piecewise::Line;
use super::profile::Profile;
use super::random;
use crate::scenario;

/// Six joined arcs of the paper's irregular defect (Eq. 27 made whole), lengths in mm for a peak half-width of 2 mm.
#[expect(clippy::approx_constant, reason = "the paper's printed digits")]
const LI2023_ARCS_MM: [f64; 6] = [1.6695, 1.5, 0.7071, 1.4142, 0.7071, 1.0];

/// Largest width of the irregular shape as tabulated, mm.
const LI2023_WIDTH_MM: f64 = 4.0;

/// Half-width in mm on arc `index` (from 0) of the paper's irregular defect at the fraction `s` of it.
#[doc(hidden)]
#[expect(clippy::approx_constant, reason = "the paper's printed digits")]
pub fn li2023_half_width_mm(index: usize, s: f64) -> f64 {
    match index {
        0 => 3.8284 - (16.0 - (1.6695 * s + 1.1589).powi(2)).sqrt(),
        1 => 1.0,
        2 => 1.0 + 0.7071 * s,
        3 => 1.0 + (1.0 - (1.4142 * s - 0.7071).powi(2)).max(0.0).sqrt(),
        4 => 1.7071 - 0.7071 * s,
        _ => (1.0 - s * s).max(0.0).sqrt(),
    }
}

/// Shape of one defect, SI.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// Constant width over a length.
    Rectangle {
        /// Half the length along s, m.
        half_length: f64,
        /// Width along the axis, m.
        width: f64,
    },
    /// Circle of radius a.
    Circle {
        /// a, m.
        radius: f64,
    },
    /// Piecewise linear in s.
    Profile(Profile),
    /// The paper's irregular shape.
    Li2023Irregular {
        /// L_s over its tabulated value.
        scale: f64,
    },
    /// Polygons, one depth.
    Outline(Outline),
    /// Depths on a grid.
    DepthMap(Grid),
}

impl Shape {
    /// From the scenario's units; `depth` (m) is the defect's. `None` where a shape makes no sense: a profile whose
    /// lists do not fit, polygons without area, a grid with holes; and where it is still a file.
    pub fn new(shape: &scenario::Shape, depth: f64) -> Option<Self> {
        let metres = |v: &[f64], unit: f64| v.iter().map(|x| x * unit).collect::<Vec<_>>();
        Some(match shape {
            scenario::Shape::Rectangle { length_mm, width_mm } => {
                Self::Rectangle { half_length: 0.5e-3 * length_mm, width: 1e-3 * width_mm }
            }
            scenario::Shape::Circle { diameter_mm } => Self::Circle { radius: 0.5e-3 * diameter_mm },
            scenario::Shape::Profile { arc_mm, width_mm, depth_um } => Self::Profile(Profile::new(
                metres(arc_mm, 1e-3),
                metres(width_mm, 1e-3),
                depth_um.as_ref().map(|d| metres(d, 1e-6)),
            )?),
            scenario::Shape::Li2023Irregular { max_width_mm } => {
                Self::Li2023Irregular { scale: max_width_mm / LI2023_WIDTH_MM }
            }
            scenario::Shape::Outline { polygons_mm } => Self::Outline(outline(polygons_mm)?),
            scenario::Shape::DepthMap { grid } => Self::DepthMap(Grid::new(grid)?),
            scenario::Shape::Grown { outline: polygons, max_width_mm, area_mm2 } => {
                let seed = outline(polygons)?;
                let factor = match (max_width_mm, area_mm2) {
                    (Some(width), None) => 1e-3 * width / seed.width().largest(),
                    (None, Some(area)) => (1e-6 * area / seed.width().integral()).sqrt(),
                    _ => return None,
                };
                Self::Outline(seed.scaled(factor)?)
            }
            scenario::Shape::Random { seed, length_mm, width_mm, roughness } => {
                let fits = [length_mm, width_mm].iter().all(|x| x.is_finite() && **x > 0.0)
                    && (0.0..=1.0).contains(roughness)
                    && depth.is_finite();
                if !fits {
                    return None;
                }
                // The pattern is drawn for some depth even where the defect has none.
                let grid = random::spall(*seed, *length_mm, *width_mm, *roughness, 1e6 * depth);
                match Grid::new(&grid) {
                    Some(grid) => Self::DepthMap(grid),
                    None => Self::Rectangle { half_length: 0.5e-3 * length_mm, width: 0.0 },
                }
            }
            scenario::Shape::Image(_) | scenario::Shape::Svg(_) | scenario::Shape::Scan(_) => {
                return None;
            }
        })
    }

    /// The same without what a roller of length L (m) does not reach, moved along z by `offset` (m). A shape that is a
    /// width alone stays about z = 0: its defect keeps the offset.
    pub fn placed(self, offset: f64, length: f64) -> Self {
        match self {
            Self::DepthMap(grid) if offset != 0.0 => Self::DepthMap(grid.moved(offset).within(length)),
            Self::DepthMap(grid) => Self::DepthMap(grid.within(length)),
            Self::Outline(outline) if offset != 0.0 => Self::Outline(outline.moved(offset).within(length)),
            Self::Outline(outline) => Self::Outline(outline.within(length)),
            other => other,
        }
    }

    /// Whether the shape is a width alone, centred on z = 0 where nothing moves it.
    pub fn is_width(&self) -> bool {
        !matches!(self, Self::Outline(_) | Self::DepthMap(_))
    }

    /// First and last s of the damage, m.
    pub fn arc(&self) -> (f64, f64) {
        match self {
            Self::Rectangle { half_length, .. } => (-half_length, *half_length),
            Self::Circle { radius } => (-radius, *radius),
            Self::Profile(p) => p.arc(),
            Self::Li2023Irregular { .. } => {
                let half = 0.5e-3 * LI2023_ARCS_MM.iter().sum::<f64>();
                (-half, half)
            }
            Self::Outline(outline) => outline.width().span(),
            Self::DepthMap(grid) => grid.width().span(),
        }
    }

    /// L_s(s), m, for s within [`Shape::arc`]; not clamped to the roller's length.
    #[inline]
    pub fn damaged_length(&self, s: f64) -> f64 {
        match self {
            Self::Rectangle { width, .. } => *width,
            Self::Circle { radius } => 2.0 * (radius * radius - s * s).max(0.0).sqrt(),
            Self::Profile(p) => p.width(s),
            Self::Li2023Irregular { scale } => {
                let mut from_start = (s - self.arc().0) * 1e3;
                let mut index = 0;
                while index < 5 && from_start > LI2023_ARCS_MM[index] {
                    from_start -= LI2023_ARCS_MM[index];
                    index += 1;
                }
                let fraction = (from_start / LI2023_ARCS_MM[index]).clamp(0.0, 1.0);
                2e-3 * li2023_half_width_mm(index, fraction) * scale
            }
            Self::Outline(outline) => outline.width().value(s),
            Self::DepthMap(grid) => grid.width().value(s),
        }
    }

    /// h_s(s), m, where the shape carries its own depths: of a depth map the mean over the damaged width, 0 where that
    /// is raised.
    #[inline]
    pub fn own_depth(&self, s: f64) -> Option<f64> {
        match self {
            Self::Profile(p) => p.depth(s),
            Self::DepthMap(grid) => Some(grid.mean_depth().value(s).max(0.0)),
            _ => None,
        }
    }

    /// h_s(s) over the arc as straight pieces; `depth` (m) where the shape has none of its own. 0 where an outline
    /// leaves a gap.
    pub(super) fn depths(&self, depth: f64) -> Vec<Line> {
        match self {
            Self::Profile(p) => p.depths(depth),
            Self::Outline(outline) => outline
                .width()
                .breakpoints()
                .windows(2)
                .filter(|w| outline.width().value(0.5 * (w[0] + w[1])) > 0.0)
                .map(|w| Line::flat(w[0], w[1], depth))
                .collect(),
            Self::DepthMap(grid) => grid.mean_lines().iter().flat_map(sunk).collect(),
            _ => {
                let (first, last) = self.arc();
                vec![Line::flat(first, last, depth)]
            }
        }
    }

    /// The same along the line z = 0 alone, which a width about z = `middle` (m) may miss.
    pub(super) fn depths_at_bottom(&self, depth: f64, middle: f64) -> Vec<Line> {
        match self {
            Self::DepthMap(grid) => grid.along(0.0).iter().flat_map(sunk).collect(),
            Self::Outline(outline) => {
                let flat = |ends: &[f64]| Line::flat(ends[0], ends[1], depth);
                outline.crossings_of_bottom().chunks_exact(2).map(flat).collect()
            }
            _ if middle == 0.0 => self.depths(depth),
            _ => {
                let on = |s: f64| 0.5 * self.damaged_length(s) >= middle.abs();
                let lines = self.depths(depth);
                lines.iter().flat_map(|line| parts_where(line, on)).collect()
            }
        }
    }

    /// Lowest and highest z; a width alone is centred on z = `middle` (m).
    pub(super) fn heights(&self, middle: f64) -> [f64; 2] {
        let widest = match self {
            Self::DepthMap(grid) => return grid.heights().into(),
            Self::Outline(outline) => return outline.heights().into(),
            Self::Rectangle { width, .. } => *width,
            Self::Circle { radius } => 2.0 * radius,
            Self::Profile(p) => p.widest(),
            Self::Li2023Irregular { scale } => 1e-3 * LI2023_WIDTH_MM * scale,
        };
        [middle - 0.5 * widest, middle + 0.5 * widest]
    }

    /// Height of the highest raised edge, m; 0 where none is.
    pub fn raised(&self) -> f64 {
        match self {
            Self::DepthMap(grid) => (-grid.extremes().1).max(0.0),
            _ => 0.0,
        }
    }

    /// Ends of `segments` parts of the arc, m: the joints of the paper's six arcs where there are six, else equal
    /// parts.
    pub(super) fn joints(&self, segments: usize) -> Vec<f64> {
        let (first, last) = self.arc();
        if matches!(self, Self::Li2023Irregular { .. }) && segments == LI2023_ARCS_MM.len() {
            let ends = LI2023_ARCS_MM.iter().scan(first, |s, arc| {
                *s += 1e-3 * arc;
                Some(*s)
            });
            return [first].into_iter().chain(ends).collect();
        }
        (0..=segments).map(|k| first + (last - first) * k as f64 / segments as f64).collect()
    }

    /// What L_s of the law `ecl` adds up to, m^2: of a depth map the cells of its damaged nodes, else the area.
    pub fn area_in_ecl(&self) -> f64 {
        match self {
            Self::DepthMap(grid) => grid.width().integral(),
            other => other.area(),
        }
    }

    /// Area seen from above, m^2; of a closed form by the midpoint rule, of a depth map of the surface between its nodes.
    pub fn area(&self) -> f64 {
        self.area_where(|s| self.damaged_length(s))
    }

    /// The same of a closed form whose damaged length is `length` of the arc coordinate.
    pub(super) fn area_where(&self, length: impl Fn(f64) -> f64) -> f64 {
        const CELLS: u32 = 20_000;
        match self {
            Self::Outline(outline) => return outline.width().integral(),
            Self::DepthMap(grid) => return grid.covered().area,
            _ => {}
        }
        let (first, last) = self.arc();
        let ds = (last - first) / f64::from(CELLS);
        (0..CELLS).map(|k| length(first + (f64::from(k) + 0.5) * ds) * ds).sum()
    }
}

/// The parts of a straight piece that are 0 or deeper: what is raised counts as 0, up to where the piece sinks below.
fn sunk(line: &Line) -> impl Iterator<Item = Line> + use<> {
    let (a, b) = (line.at_from, line.at_to);
    let zero = line.from + (line.to - line.from) * (a / (a - b)).clamp(0.0, 1.0);
    let part = |from: f64, to: f64, at_from: f64, at_to: f64| (to > from).then_some(Line { from, to, at_from, at_to });
    let parts = if a * b < 0.0 {
        [part(line.from, zero, a.max(0.0), 0.0), part(zero, line.to, 0.0, b.max(0.0))]
    } else {
        [part(line.from, line.to, a.max(0.0), b.max(0.0)), None]
    };
    parts.into_iter().flatten()
}

/// The parts of a straight piece where something holds: looked for at many places, their ends found to round-off.
fn parts_where(line: &Line, holds: impl Fn(f64) -> bool) -> Vec<Line> {
    const PLACES: u32 = 1024;
    let place = |k: u32| line.from + (line.to - line.from) * f64::from(k) / f64::from(PLACES);
    // A jump's value is that of the right-hand side.
    let at = |k: u32| holds(if k == PLACES { line.to.next_down() } else { place(k) });
    let change = |k: u32| {
        let (mut before, mut after) = (place(k - 1), place(k));
        for _ in 0..60 {
            let middle = 0.5 * (before + after);
            if holds(middle) == at(k - 1) { before = middle } else { after = middle }
        }
        0.5 * (before + after)
    };
    let mut ends: Vec<f64> = at(0).then_some(line.from).into_iter().collect();
    ends.extend((1..=PLACES).filter(|k| at(k - 1) != at(*k)).map(change));
    ends.extend((ends.len() % 2 == 1).then_some(line.to));
    let value = |s: f64| line.at_from + line.slope() * (s - line.from);
    let part = |e: &[f64]| Line { from: e[0], to: e[1], at_from: value(e[0]), at_to: value(e[1]) };
    ends.chunks_exact(2).map(part).collect()
}

fn outline(polygons_mm: &[Vec<[f64; 2]>]) -> Option<Outline> {
    let metres = |p: &Vec<[f64; 2]>| p.iter().map(|x| x.map(|x| 1e-3 * x)).collect();
    Outline::new(polygons_mm.iter().map(metres).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_circle_and_rectangle_areas() {
        let circle = Shape::Circle { radius: 2.25e-3 };
        assert!((circle.area() / (std::f64::consts::PI * 2.25e-3 * 2.25e-3) - 1.0).abs() < 1e-5);
        let rectangle = Shape::Rectangle { half_length: 1.5e-3, width: 4e-3 };
        assert!((rectangle.area() / 12e-6 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn lit_irregular_is_seven_millimetres_long_and_four_wide_and_has_no_jump() {
        let shape = Shape::Li2023Irregular { scale: 1.0 };
        let (first, last) = shape.arc();
        assert!(((last - first) - 7e-3).abs() < 5e-6);
        let n = 70_000;
        let width: Vec<f64> =
            (0..=n).map(|k| shape.damaged_length(first + (last - first) * f64::from(k) / f64::from(n))).collect();
        let widest = width.iter().copied().fold(0.0, f64::max);
        assert!((widest - 4e-3).abs() < 1e-6, "widest {widest}");
        assert!(width[0] < 1e-6 && width[n as usize] < 1e-6);
        // The last arc ends with a vertical tangent, 2 sqrt(1 - s^2); elsewhere neighbours are close.
        let jump = width.windows(2).map(|w| (w[1] - w[0]).abs()).take(69_000).fold(0.0, f64::max);
        assert!(jump < 2e-6, "jump {jump}");
    }

    #[test]
    fn analytic_profile_is_linear_and_jumps_where_the_arc_repeats() {
        let p = Shape::Profile(
            Profile::new(vec![-1e-3, 0.0, 0.0, 2e-3], vec![0.0, 1e-3, 3e-3, 1e-3], Some(vec![0.0, 4e-6, 8e-6, 0.0]))
                .unwrap(),
        );
        assert!((p.damaged_length(-0.5e-3) - 0.5e-3).abs() < 1e-15);
        assert!((p.damaged_length(-1e-12) - 1e-3).abs() < 1e-9);
        assert!((p.damaged_length(1e-12) - 3e-3).abs() < 1e-9);
        assert!((p.damaged_length(2e-3) - 1e-3).abs() < 1e-15);
        assert!((p.own_depth(1e-3).unwrap() - 4e-6).abs() < 1e-15);
        assert!(Profile::new(vec![0.0, -1.0], vec![0.0, 0.0], None).is_none());
    }
}
