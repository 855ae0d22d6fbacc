//! The union of drawn rings, so that the even-odd rule holds for all of them together.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::float::simplify::SimplifyShape;

use crate::geometry::signed_area;

pub(crate) type Rings = Vec<Vec<[f64; 2]>>;

/// The union of rings by a fill rule: outer rings counter-clockwise, holes clockwise, none crossing.
pub(crate) fn united(rings: &[Vec<[f64; 2]>], rule: FillRule) -> Rings {
    let rings: Rings = rings.iter().filter(|ring| ring.len() >= 3).cloned().collect();
    let shapes = rings.simplify_shape_as::<i64>(rule);
    let mut result = Rings::new();
    for shape in shapes {
        for (i, mut ring) in shape.into_iter().enumerate() {
            let area = signed_area(&ring);
            if (i == 0) != (area > 0.0) {
                ring.reverse();
            }
            result.push(ring);
        }
    }
    result
}
