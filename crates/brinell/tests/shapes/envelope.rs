//! Where damage lies across the roller, and the envelope that a roller follows.

use super::{at, defect, felt, grid_mm};
use brinell::defect::{Defect, Side};
use brinell::scenario::{self, RollerPath, Surface};

#[test]
fn analytic_axial_offset_moves_any_shape_and_what_leaves_the_roller_does_not_count() {
    let make = |of: scenario::Shape, axial_offset_mm: f64, path| {
        let mut s = crate::common::example();
        s.contact.roller_path = path;
        let d = scenario::Defect { shape: of, axial_offset_mm, ..s.defects[0].clone() };
        Defect::new(&d, &s.bearing, &s.contact).unwrap()
    };
    let rectangle = scenario::Shape::Rectangle { length_mm: 2.0, width_mm: 3.0 };
    let drawn = |z: f64| scenario::Shape::Outline {
        polygons_mm: vec![vec![[-1.0, z - 1.5], [1.0, z - 1.5], [1.0, z + 1.5], [-1.0, z + 1.5]]],
    };
    // As nodes half a step inside the border, which represent their cells.
    let mapped = scenario::Shape::DepthMap {
        grid: grid_mm([1.2, 1.7], 0.1, |s, z| if s.abs() < 1.01 && z.abs() < 1.46 { 20.0 } else { 0.0 }),
    };
    for (offset, width) in [(0.7, 3.0), (-0.7, 3.0), (2.5, 2.0), (-2.5, 2.0)] {
        for path in [RollerPath::Point, RollerPath::Envelope] {
            let moved =
                [make(rectangle.clone(), offset, path), make(drawn(0.0), offset, path), make(drawn(offset), 0.0, path)];
            let force = |d: &Defect, u: f64| felt(d, &at(u), 9e-6).map(|a| (a.elastic, a.floor.damaged_length));
            for d in &moved {
                for u in [0.0, 0.02, 0.035] {
                    let ((a, la), (b, lb)) = (force(d, u).unwrap(), force(&moved[0], u).unwrap());
                    assert!((a / b - 1.0).abs() < 1e-9, "{offset} {path:?} at {u}: {a} {b}");
                    assert!((la - lb).abs() < 1e-12 && (la - 1e-3 * width).abs() < 1e-12);
                }
            }
            let map = make(mapped.clone(), offset, path);
            assert!((map.damaged_length(0.0) - 1e-3 * width).abs() < 0.11e-3);
        }
    }
    // Mirrored damage gives the same force.
    let pair = [1.1, -1.1].map(|z| make(drawn(z), 0.0, RollerPath::Envelope));
    let [a, b] = pair.map(|d| felt(&d, &at(0.01), 9e-6).unwrap());
    assert!((a.elastic / b.elastic - 1.0).abs() < 1e-12);
}

#[test]
fn analytic_envelope_radii_of_every_surface() {
    let (r, inner, outer) = (3e-3, 21.5e-3, 27.5e-3);
    let outside = 1.0 / (1.0 / r - 1.0 / outer);
    let inside = 1.0 / (1.0 / r + 1.0 / inner);
    let rectangle = scenario::Shape::Rectangle { length_mm: 3.0, width_mm: 4.0 };
    for (on, side, radius) in [
        (Surface::OuterRaceway, Side::Outer, outside),
        (Surface::InnerRaceway, Side::Inner, inside),
        (Surface::Roller(3), Side::Outer, outside),
        (Surface::Roller(3), Side::Inner, inside),
    ] {
        let d = defect(rectangle.clone(), on, RollerPath::Envelope);
        let from_edge = 0.2e-3;
        let u = (1.5e-3 - from_edge) / d.radius;
        let h = d.floor(u, side).unwrap().depth;
        assert!((h - from_edge * from_edge / (2.0 * radius)).abs() < 1e-18, "{on:?} {side:?}");
    }
}

#[test]
fn prop_under_ecl_the_envelope_of_a_raised_edge_is_never_deeper_than_its_floor() {
    let burr = scenario::Shape::DepthMap { grid: grid_mm([1.0, 1.5], 0.25, |s, z| 10.0 - 11.0 * s.hypot(z)) };
    let make = |path| defect(burr.clone(), Surface::OuterRaceway, path);
    let (point, envelope) = (make(RollerPath::Point), make(RollerPath::Envelope));
    let mut raised = 0;
    for k in -500..=500 {
        let u = 1e-3 * f64::from(k) / 500.0 / point.radius;
        let depth = |d: &Defect| d.floor(u, Side::Outer).map_or(0.0, |f| f.depth);
        assert!(depth(&envelope) <= depth(&point) + 1e-15, "at {k}");
        raised += usize::from(depth(&point) == 0.0);
    }
    assert!(raised > 100, "no raised part");
}
