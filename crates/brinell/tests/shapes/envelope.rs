//! Where damage lies across the roller, the envelope that a roller follows, and the reaction of edges.

use super::{LAW, at, defect, grid_mm, oblique};
use brinell::defect::{Angles, Defect, Defects, Side, damaged_contact, edge_gradient, energy, spall};
use brinell::scenario::{self, Law, RollerPath, Surface};
use std::f64::consts::PI;

#[test]
fn analytic_axial_offset_moves_any_shape_and_what_leaves_the_roller_does_not_count() {
    let make = |of: scenario::Shape, axial_offset_mm: f64, law, path| {
        let mut s = crate::common::example();
        (s.contact.law, s.contact.roller_path, s.contact.slices) = (law, path, 11);
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
        for law in [Law::Ecl, Law::Sliced] {
            for path in [RollerPath::Point, RollerPath::Envelope] {
                let moved = [
                    make(rectangle.clone(), offset, law, path),
                    make(drawn(0.0), offset, law, path),
                    make(drawn(offset), 0.0, law, path),
                ];
                let force = |d: &Defect, u: f64| {
                    damaged_contact(Defects::one(d, Side::Outer), &LAW, &at(u), 9e-6)
                        .map(|a| (a.elastic, a.floor.damaged_length))
                };
                for d in &moved {
                    for u in [0.0, 0.02, 0.035] {
                        let ((a, la), (b, lb)) = (force(d, u).unwrap(), force(&moved[0], u).unwrap());
                        assert!((a / b - 1.0).abs() < 1e-9, "{offset} {law:?} {path:?} at {u}: {a} {b}");
                        assert!((la - lb).abs() < 1e-12 && (la - 1e-3 * width).abs() < 1e-12);
                    }
                }
                let map = make(mapped.clone(), offset, law, path);
                assert!((map.damaged_length(0.0) - 1e-3 * width).abs() < 0.11e-3);
            }
        }
    }
    // Mirrored damage gives the same force.
    let pair = [1.1, -1.1].map(|z| make(drawn(z), 0.0, Law::Sliced, RollerPath::Envelope));
    let [a, b] = pair.map(|d| damaged_contact(Defects::one(&d, Side::Outer), &LAW, &at(0.01), 9e-6).unwrap());
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
        let d = defect(rectangle.clone(), on, Law::Ecl, RollerPath::Envelope, 1);
        let from_edge = 0.2e-3;
        let u = (1.5e-3 - from_edge) / d.radius;
        let h = d.floor(u, side).unwrap().depth;
        assert!((h - from_edge * from_edge / (2.0 * radius)).abs() < 1e-18, "{on:?} {side:?}");
    }
}

#[test]
fn analytic_edge_gradient_is_the_derivative_of_the_energy() {
    let mut raised = spall(5, 3.0, 4.0, 0.8, 15.0);
    raised.depth_um.iter_mut().enumerate().for_each(|(k, h)| {
        if k % 7 == 0 {
            *h *= -0.3
        }
    });
    let map = scenario::Shape::DepthMap { grid: raised };
    let rectangle = scenario::Shape::Rectangle { length_mm: 2.0, width_mm: 3.0 };
    for (on, side) in [
        (Surface::OuterRaceway, Side::Outer),
        (Surface::InnerRaceway, Side::Inner),
        (Surface::Roller(3), Side::Outer),
        (Surface::Roller(3), Side::Inner),
    ] {
        let make = |x: &scenario::Shape| defect(x.clone(), on, Law::Sliced, RollerPath::Envelope, 12);
        let deepening = scenario::Shape::Profile {
            arc_mm: vec![-1.5, -0.2, 0.6, 1.5],
            width_mm: vec![1.0, 5.0, 3.1, 0.0],
            depth_um: Some(vec![3.0, 18.0, 11.0, 6.0]),
        };
        let sets: Vec<Vec<Defect>> = [
            vec![&map, &rectangle],
            vec![&map],
            vec![&rectangle],
            vec![&scenario::Shape::Circle { diameter_mm: 3.1 }],
            vec![&scenario::Shape::Li2023Irregular { max_width_mm: 4.0 }],
            vec![&oblique()],
            vec![&deepening],
        ]
        .map(|set| set.into_iter().map(make).collect())
        .into();
        for (set, both) in sets.iter().enumerate() {
            let base = if on == Surface::Roller(3) && side == Side::Inner { PI } else { 0.0 };
            for k in 0..60 {
                let x = (1.7e-3 * (f64::from(k) / 30.0 - 0.99)) / both[0].radius;
                let angles = Angles {
                    orbit: x - base + 0.3 + 0.2,
                    spin: if base > 0.0 || on == Surface::Roller(3) { 0.5 } else { 0.0 },
                    ring: if on == Surface::InnerRaceway { 0.5 } else { 0.0 },
                };
                let angles = Angles { orbit: if on == Surface::OuterRaceway { x } else { angles.orbit }, ..angles };
                let delta = 14e-6;
                let stored = |a: &Angles| energy(Defects::all(both, side), &LAW, a, delta);
                let e = edge_gradient(Defects::all(both, side), &LAW, &angles, delta);
                // Of several defects at once it is a difference itself, and the search over them leaves out ridges of a
                // nanometre.
                let (step, share) = if set == 0 { (3e-6, 3e-2) } else { (1e-7, 2e-3) };
                let by = |f: &dyn Fn(&mut Angles, f64)| {
                    let [up, down] = [step, -step].map(|h| {
                        let mut a = angles;
                        f(&mut a, h);
                        stored(&a)
                    });
                    (up - down) / (2.0 * step)
                };
                let numeric = [by(&|a, h| a.orbit += h), by(&|a, h| a.spin += h), by(&|a, h| a.ring += h)];
                let scale = 1e-4 * LAW.healthy(delta) * 0.1 * both[0].radius;
                for (ours, theirs) in [e.orbit, e.spin, e.ring].into_iter().zip(numeric) {
                    // A kink within the step leaves a difference of the order of the step.
                    assert!(
                        (ours - theirs).abs() < scale + share * theirs.abs(),
                        "set {set} {on:?} {side:?} {k}: {e:?} {numeric:?}"
                    );
                }
            }
        }
    }
}
