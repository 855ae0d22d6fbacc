//! Section properties of a damaged ring, Eqs. (1)-(20) in the form of section 3 of the model.
//!
//! The cross-section is a rectangle of width L and thickness 2 h_z with a notch L_s x h_s in its raceway side. As in
//! the paper, none of this enters the equations of motion: it describes the damage. All SI; L_s in [0, L], h_s in [0, 2
//! h_z), and at least one of them below its limit.

use super::Shape;

/// A ring's cross-section under damage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// A = 2 L h_z (1 - a), m^2, with a = v q, v = L_s/L and q = h_s/(2 h_z) (Eqs. 3, 8, 12, 19).
    pub area: f64,
    /// I = (2/3) L h_z^3 K_I, m^4: second moment about the centroid's axial line (Eqs. 5, 9, 20).
    pub inertia: f64,
    /// K_I = (1 - 4 a + 6 v q^2 - 4 v q^3 + v^2 q^4)/(1 - a): I over that of the whole section (Eq. 15).
    pub inertia_ratio: f64,
    /// h_a = 2 h_z (1 - a), m: thickness of a whole section of the same area (Eqs. 6, 13).
    pub area_thickness: f64,
    /// h_I = 2 h_z K_I^(1/3), m: thickness of a whole section of the same inertia (Eqs. 7, 14).
    pub inertia_thickness: f64,
    /// K_r = h_I / h_a (Eqs. 16, 17).
    pub thickness_ratio: f64,
}

impl Section {
    /// Of a section of width L and thickness 2 h_z (m) with a notch of L_s x h_s (m).
    pub fn new(width: f64, thickness: f64, damaged_length: f64, depth: f64) -> Self {
        let v = (damaged_length / width).clamp(0.0, 1.0);
        let q = (depth / thickness).clamp(0.0, 1.0);
        let a = v * q;
        let ratio = (1.0 - 4.0 * a + 6.0 * v * q * q - 4.0 * v * q.powi(3) + v * v * q.powi(4)) / (1.0 - a);
        let area_thickness = thickness * (1.0 - a);
        let inertia_thickness = thickness * ratio.cbrt();
        Self {
            area: width * thickness * (1.0 - a),
            inertia: width * thickness.powi(3) / 12.0 * ratio,
            inertia_ratio: ratio,
            area_thickness,
            inertia_thickness,
            thickness_ratio: inertia_thickness / area_thickness,
        }
    }
}

/// Section properties at `points` equally spaced s (m) over the damage: of a ring of width L and the given thickness
/// (m), `depth` (m) is for where the shape has none of its own.
pub fn sections(shape: &Shape, depth: f64, width: f64, thickness: f64, points: usize) -> Vec<(f64, Section)> {
    let (first, last) = shape.arc();
    (0..points)
        .map(|k| {
            let s = first + (last - first) * k as f64 / points.saturating_sub(1).max(1) as f64;
            let h = shape.own_depth(s).unwrap_or(depth);
            let damaged = shape.damaged_length(s).min(width);
            (s, Section::new(width, thickness, damaged, h))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn xval_closed_forms_agree_with_numerical_integration(
            v in 0.0..1.0f64, q in 0.0..0.95f64, width in 1e-3..0.1f64, thickness in 1e-3..0.05f64,
        ) {
            let section = Section::new(width, thickness, v * width, q * thickness);
            // Strips across the thickness, the floor of the notch on the border of two; moments of each strip exact.
            let floor = thickness * (1.0 - q);
            let (mut area, mut first, mut second) = (0.0, 0.0, 0.0);
            for (from, to, w) in [(0.0, floor, width), (floor, thickness, width * (1.0 - v))] {
                const STRIPS: i32 = 2000;
                let dy = (to - from) / f64::from(STRIPS);
                for k in 0..STRIPS {
                    let y = from + (f64::from(k) + 0.5) * dy;
                    area += w * dy;
                    first += w * dy * y;
                    second += w * dy * y * y;
                }
            }
            let inertia = second - first * first / area;
            prop_assert!((section.area / area - 1.0).abs() < 1e-11);
            // The midpoint rule leaves out dy^2/12 of each strip.
            prop_assert!((section.inertia / inertia - 1.0).abs() < 2e-5, "{} {}", section.inertia, inertia);
            let whole = width * thickness.powi(3) / 12.0;
            prop_assert!((section.inertia_ratio * whole / section.inertia - 1.0).abs() < 1e-12);
            prop_assert!((section.thickness_ratio
                - section.inertia_ratio.cbrt() / (1.0 - v * q)).abs() < 1e-12);
        }
    }

    #[test]
    fn analytic_limits() {
        let whole = Section::new(6e-3, 3e-3, 0.0, 20e-6);
        assert_eq!((whole.inertia_ratio, whole.thickness_ratio), (1.0, 1.0));
        // A notch over the full width leaves a thinner rectangle.
        let thin = Section::new(6e-3, 3e-3, 6e-3, 1e-3);
        assert!((thin.inertia / (6e-3 * 2e-3f64.powi(3) / 12.0) - 1.0).abs() < 1e-14);
        assert!((thin.thickness_ratio - 1.0).abs() < 1e-14);
    }

    #[test]
    fn analytic_sections_along_a_circle() {
        let shape = Shape::Circle { radius: 2e-3 };
        let all = sections(&shape, 20e-6, 6e-3, 3e-3, 5);
        assert_eq!(all.len(), 5);
        assert_eq!(all[2].1, Section::new(6e-3, 3e-3, 4e-3, 20e-6));
        assert_eq!(all[0].1.inertia_ratio, 1.0);
    }
}
