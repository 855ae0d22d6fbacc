//! The simple shapes that others would have assumed instead of the real damage (the paper's section 4.2).

use super::{Extent, Shape};
use crate::scenario::{self, Bearing};
use std::f64::consts::PI;

/// What to simplify to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Simple {
    /// The rectangle around it (7 x 4 mm in the paper).
    BoundingRectangle,
    /// The rectangle of the same area and the bounding one's proportions.
    EqualAreaRectangle,
    /// The circle of the same area.
    EqualAreaCircle,
}

/// The same defect with a simple shape, its centre moved to the middle of the real arc. A rectangle or circle is
/// centred along the axis, wherever the real damage lies; it may come out wider than the roller, which the scenario's
/// checks then say. `None` where the shape makes no sense.
pub fn simplify(defect: &scenario::Defect, bearing: &Bearing, to: Simple) -> Option<scenario::Defect> {
    let depth = 1e-6 * defect.depth_um;
    let shape = Shape::new(&defect.shape, depth)?;
    let extent = Extent::of(&shape, depth);
    let diameter_mm = bearing.diameter_mm(defect.on);
    let rectangle = |factor: f64| scenario::Shape::Rectangle {
        length_mm: 1e3 * factor * extent.length,
        width_mm: 1e3 * factor * extent.width,
    };
    Some(scenario::Defect {
        center_deg: defect.center_deg + (2e3 * extent.middle / diameter_mm).to_degrees(),
        depth_um: 1e6 * extent.depth,
        shape: match to {
            Simple::BoundingRectangle => rectangle(1.0),
            Simple::EqualAreaRectangle => rectangle((extent.area / (extent.length * extent.width)).sqrt()),
            Simple::EqualAreaCircle => scenario::Shape::Circle { diameter_mm: 2e3 * (extent.area / PI).sqrt() },
        },
        ..defect.clone()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;

    fn simple(shape: scenario::Shape, to: Simple) -> scenario::Defect {
        let scenario = Scenario::example();
        let defect = scenario::Defect { shape, ..scenario.defects[0].clone() };
        simplify(&defect, &scenario.bearing, to).unwrap()
    }

    #[test]
    fn lit_the_papers_simplification_is_seven_by_four() {
        let irregular = scenario::Shape::Li2023Irregular { max_width_mm: 4.0 };
        let d = simple(irregular, Simple::BoundingRectangle);
        let scenario::Shape::Rectangle { length_mm, width_mm } = d.shape else { panic!("{:?}", d.shape) };
        assert!((length_mm - 7.0).abs() < 5e-3 && (width_mm - 4.0).abs() < 1e-3);
        assert!((d.depth_um - 20.0).abs() < 1e-9);
    }

    #[test]
    fn analytic_area_is_kept_and_the_middle_moves() {
        let off_centre = scenario::Shape::Outline { polygons_mm: vec![vec![[1.0, -1.0], [4.0, -1.0], [1.0, 3.0]]] };
        let d = simple(off_centre.clone(), Simple::EqualAreaCircle);
        let scenario::Shape::Circle { diameter_mm } = d.shape else { panic!("{:?}", d.shape) };
        assert!((PI / 4.0 * diameter_mm * diameter_mm - 6.0).abs() < 1e-6);
        assert!((d.center_deg - (2.5f64 / 27.5).to_degrees()).abs() < 1e-9);
        let d = simple(off_centre, Simple::EqualAreaRectangle);
        let scenario::Shape::Rectangle { length_mm, width_mm } = d.shape else { panic!("{:?}", d.shape) };
        assert!((length_mm * width_mm - 6.0).abs() < 1e-6);
        assert!((length_mm / width_mm - 0.75).abs() < 1e-9);
    }
}
