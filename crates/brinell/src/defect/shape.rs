//! Outlines and floors of damage as functions of the arc: L_s(s) and h_s(s), section 3 and Eqs. (25)-(27).
//!
//! s in m along the rolling direction from the defect's centre; L_s and h_s in m. Outside `[first, last]` there is no damage.

use crate::scenario;

/// Six joined arcs of the paper's irregular defect (Eq. 27 made whole), lengths in mm for a peak half-width of 2 mm.
#[expect(clippy::approx_constant, reason = "the paper's printed digits")]
const LI2023_ARCS_MM: [f64; 6] = [1.6695, 1.5, 0.7071, 1.4142, 0.7071, 1.0];

/// Largest width of the irregular shape as tabulated, mm.
const LI2023_WIDTH_MM: f64 = 4.0;

/// Half-width in mm on arc `index` at the fraction `s` of it.
#[expect(clippy::approx_constant, reason = "the paper's printed digits")]
fn li2023_half_width_mm(index: usize, s: f64) -> f64 {
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
        /// Half the length along the rolling direction, m.
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
}

/// Piecewise-linear width and depth; the arc may repeat where they jump.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    arc: Vec<f64>,
    width: Vec<f64>,
    depth: Option<Vec<f64>>,
}

impl Profile {
    /// From equally long lists (m), the arc never decreasing. `None` where they do not fit or are empty.
    pub fn new(arc: Vec<f64>, width: Vec<f64>, depth: Option<Vec<f64>>) -> Option<Self> {
        let fits = arc.len() >= 2
            && arc.len() == width.len()
            && depth.as_ref().is_none_or(|d| d.len() == arc.len())
            && arc.windows(2).all(|w| w[0] <= w[1]);
        fits.then_some(Self { arc, width, depth })
    }

    /// Index k and fraction f with s between points k and k + 1; the right-hand value at a jump.
    fn locate(&self, s: f64) -> (usize, f64) {
        let k = self
            .arc
            .partition_point(|&a| a <= s)
            .clamp(1, self.arc.len() - 1)
            - 1;
        let step = self.arc[k + 1] - self.arc[k];
        let fraction = if step > 0.0 {
            ((s - self.arc[k]) / step).clamp(0.0, 1.0)
        } else {
            1.0
        };
        (k, fraction)
    }
}

fn lerp(values: &[f64], (k, fraction): (usize, f64)) -> f64 {
    values[k] + (values[k + 1] - values[k]) * fraction
}

impl Shape {
    /// From the scenario's units. `None` where a profile's lists do not fit.
    pub fn new(shape: &scenario::Shape) -> Option<Self> {
        let metres = |v: &[f64], unit: f64| v.iter().map(|x| x * unit).collect::<Vec<_>>();
        Some(match shape {
            scenario::Shape::Rectangle {
                length_mm,
                width_mm,
            } => Self::Rectangle {
                half_length: 0.5e-3 * length_mm,
                width: 1e-3 * width_mm,
            },
            scenario::Shape::Circle { diameter_mm } => Self::Circle {
                radius: 0.5e-3 * diameter_mm,
            },
            scenario::Shape::Profile {
                arc_mm,
                width_mm,
                depth_um,
            } => Self::Profile(Profile::new(
                metres(arc_mm, 1e-3),
                metres(width_mm, 1e-3),
                depth_um.as_ref().map(|d| metres(d, 1e-6)),
            )?),
            scenario::Shape::Li2023Irregular { max_width_mm } => Self::Li2023Irregular {
                scale: max_width_mm / LI2023_WIDTH_MM,
            },
        })
    }

    /// First and last s of the damage, m.
    pub fn arc(&self) -> (f64, f64) {
        match self {
            Self::Rectangle { half_length, .. } => (-half_length, *half_length),
            Self::Circle { radius } => (-radius, *radius),
            Self::Profile(p) => (p.arc[0], p.arc[p.arc.len() - 1]),
            Self::Li2023Irregular { .. } => {
                let half = 0.5e-3 * LI2023_ARCS_MM.iter().sum::<f64>();
                (-half, half)
            }
        }
    }

    /// L_s(s), m, for s within [`Shape::arc`]; not clamped to the roller's length.
    #[inline]
    pub fn damaged_length(&self, s: f64) -> f64 {
        match self {
            Self::Rectangle { width, .. } => *width,
            Self::Circle { radius } => 2.0 * (radius * radius - s * s).max(0.0).sqrt(),
            Self::Profile(p) => lerp(&p.width, p.locate(s)),
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
        }
    }

    /// h_s(s), m, where the shape carries its own depths.
    #[inline]
    pub fn own_depth(&self, s: f64) -> Option<f64> {
        match self {
            Self::Profile(Profile {
                depth: Some(depth), ..
            }) => {
                let Self::Profile(p) = self else { return None };
                Some(lerp(depth, p.locate(s)))
            }
            _ => None,
        }
    }

    /// Area of the outline, m^2, by the midpoint rule.
    pub fn area(&self) -> f64 {
        const CELLS: u32 = 20_000;
        let (first, last) = self.arc();
        let ds = (last - first) / f64::from(CELLS);
        (0..CELLS)
            .map(|k| self.damaged_length(first + (f64::from(k) + 0.5) * ds) * ds)
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_circle_and_rectangle_areas() {
        let circle = Shape::Circle { radius: 2.25e-3 };
        assert!((circle.area() / (std::f64::consts::PI * 2.25e-3 * 2.25e-3) - 1.0).abs() < 1e-5);
        let rectangle = Shape::Rectangle {
            half_length: 1.5e-3,
            width: 4e-3,
        };
        assert!((rectangle.area() / 12e-6 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn lit_irregular_is_seven_millimetres_long_and_four_wide_and_has_no_jump() {
        let shape = Shape::Li2023Irregular { scale: 1.0 };
        let (first, last) = shape.arc();
        assert!(((last - first) - 7e-3).abs() < 5e-6);
        let n = 70_000;
        let width: Vec<f64> = (0..=n)
            .map(|k| shape.damaged_length(first + (last - first) * f64::from(k) / f64::from(n)))
            .collect();
        let widest = width.iter().copied().fold(0.0, f64::max);
        assert!((widest - 4e-3).abs() < 1e-6, "widest {widest}");
        assert!(width[0] < 1e-6 && width[n as usize] < 1e-6);
        // The last arc ends with a vertical tangent, 2 sqrt(1 - s^2); elsewhere neighbours are close.
        let jump = width
            .windows(2)
            .map(|w| (w[1] - w[0]).abs())
            .take(69_000)
            .fold(0.0, f64::max);
        assert!(jump < 2e-6, "jump {jump}");
    }

    #[test]
    fn analytic_profile_is_linear_and_jumps_where_the_arc_repeats() {
        let p = Shape::Profile(
            Profile::new(
                vec![-1e-3, 0.0, 0.0, 2e-3],
                vec![0.0, 1e-3, 3e-3, 1e-3],
                Some(vec![0.0, 4e-6, 8e-6, 0.0]),
            )
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
