//! Outlines of depth maps against closed forms and the definition.

use brinell::defect::faults;
use brinell::scenario::DepthGrid;
use brinell_damage::{DamageError, level_of_area, outline};
use proptest::prelude::*;
use std::f64::consts::PI;

fn grid(half: [f64; 2], step: f64, depth: impl Fn(f64, f64) -> f64) -> DepthGrid {
    let [columns, rows] = half.map(|h| (2.0 * h / step).round() as usize + 1);
    DepthGrid {
        s0_mm: -half[0],
        z0_mm: -half[1],
        ds_mm: step,
        dz_mm: step,
        columns,
        rows,
        depth_um: (0..columns * rows)
            .map(|k| depth(-half[0] + step * (k % columns) as f64, -half[1] + step * (k / columns) as f64))
            .collect(),
    }
}

#[test]
fn analytic_a_circular_wall_keeps_its_area_within_the_resolution() {
    let exact = PI * 1.5 * 1.5;
    for step in [0.1, 0.05, 0.02] {
        let wall = grid([2.0, 2.5], step, |s, z| if s.hypot(z) <= 1.5 { 20.0 } else { 0.0 });
        let outline = outline(&wall, 10.0, 0.1 * step).unwrap();
        // The wall lies somewhere between two nodes, the line in their middle.
        assert!((outline.area_mm2() - exact).abs() < 0.5 * step * 2.0 * PI * 1.5, "{step}");
        let off = |p: &[f64; 2]| (p[0].hypot(p[1]) - 1.5).abs();
        let farthest = outline.polygons_mm[0].iter().map(off).fold(0.0, f64::max);
        assert!(farthest <= 0.75 * step, "{step}: {farthest}");
    }
}

#[test]
fn analytic_a_dents_contour_converges_at_second_order_in_the_step() {
    // 20 um deep in the middle of a paraboloid of 1.5 mm: 8 um deep at 1.5 sqrt(0.6) mm.
    let exact = PI * 1.5 * 1.5 * 0.6;
    let error = |step: f64| {
        let dent = grid([2.0, 2.0], step, |s, z| (20.0 * (1.0 - (s * s + z * z) / 2.25)).max(0.0));
        (outline(&dent, 8.0, 0.0).unwrap().area_mm2() / exact - 1.0).abs()
    };
    let errors = [0.1, 0.05, 0.025].map(error);
    assert!(errors[0] < 0.01, "{errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.7..2.3).contains(&order), "{errors:?}");
    }
}

#[test]
fn analytic_a_ring_has_a_hole_and_fewer_corners_within_the_tolerance() {
    let ring = grid([2.0, 2.0], 0.02, |s, z| {
        let r = s.hypot(z);
        (10.0 - 40.0 * (r - 1.2).abs()).max(0.0)
    });
    let all = outline(&ring, 5.0, 0.0).unwrap();
    assert_eq!(all.polygons_mm.len(), 2);
    // Half the depth is reached 1/8 mm to both sides of the ridge.
    let exact = PI * (1.325f64.powi(2) - 1.075f64.powi(2));
    assert!((all.area_mm2() / exact - 1.0).abs() < 2e-3, "{}", all.area_mm2());
    for tolerance in [0.002, 0.01, 0.05] {
        let few = outline(&ring, 5.0, tolerance).unwrap();
        let corners = |p: &brinell_damage::Polygons| p.polygons_mm.iter().map(Vec::len).sum::<usize>();
        assert!(4 * corners(&few) < corners(&all), "{tolerance}: {}", corners(&few));
        let off = |p: &[f64; 2]| {
            let r = p[0].hypot(p[1]);
            (r - 1.325).abs().min((r - 1.075).abs())
        };
        let farthest = few.polygons_mm.iter().flatten().map(off).fold(0.0, f64::max);
        assert!(farthest < 1e-3, "corners lie on the line: {farthest}");
        let lost = (few.area_mm2() - all.area_mm2()).abs();
        assert!(lost < tolerance * 2.0 * PI * 2.4, "{tolerance}: {lost}");
        assert!(faults(&few.polygons_mm).is_empty());
    }
}

#[test]
fn analytic_the_level_of_an_area_encloses_it() {
    let dent = grid([2.0, 2.0], 0.05, |s, z| (20.0 * (1.0 - (s * s + z * z) / 2.25)).max(0.0));
    for area in [0.5, 3.0, 6.0] {
        let level = level_of_area(&dent, area).unwrap();
        let enclosed = outline(&dent, level, 0.0).unwrap().area_mm2();
        assert!((enclosed / area - 1.0).abs() < 1e-4, "{area}: {enclosed}");
        // The paraboloid's own: r^2 = 2.25 (1 - h / 20).
        assert!((level - 20.0 * (1.0 - area / PI / 2.25)).abs() < 0.05, "{area}: {level}");
    }
    // A mask: its cells are what the middle between deep and sound nodes encloses, but for the corners.
    let mask = grid([2.0, 2.5], 0.05, |s, z| if s.hypot(z) <= 1.5 { 20.0 } else { 0.0 });
    let level = level_of_area(&mask, crate::depth_maps::area_mm2(&mask)).unwrap();
    assert!((8.0..=12.0).contains(&level), "{level}");
    assert!(level_of_area(&dent, 1e3).unwrap() < 1e-4);
}

#[test]
fn analytic_damage_at_the_grids_edge_is_closed_along_it() {
    let full = grid([1.0, 1.5], 0.1, |_, _| 5.0);
    let outline = outline(&full, 1.0, 1e-6).unwrap();
    assert_eq!(outline.polygons_mm.len(), 1);
    assert_eq!(outline.polygons_mm[0].len(), 4, "{outline:?}");
    assert!((outline.area_mm2() - 6.0).abs() < 1e-12);
}

#[test]
fn regress_what_cannot_be_outlined_is_reported() {
    let flat = grid([1.0, 1.0], 0.5, |s, _| if s == 0.0 { 3.0 } else { 0.0 });
    assert!(matches!(outline(&flat, 4.0, 0.0), Err(DamageError::NothingDamaged { .. })));
    for (level, tolerance) in [(-1.0, 0.0), (f64::NAN, 0.0), (1.0, -0.1), (1.0, f64::NAN)] {
        let error = outline(&flat, level, tolerance).unwrap_err();
        assert!(matches!(error, DamageError::Option { .. }), "{error}");
    }
    for area in [f64::NAN, -1.0, f64::INFINITY] {
        assert!(level_of_area(&flat, area).is_err(), "{area}");
    }
}

/// Its fields are anybody's.
#[test]
fn prop_a_grid_that_is_none_is_refused() {
    let sound = grid([1.0, 1.0], 0.5, |s, z| s + z);
    for bad in [
        DepthGrid { depth_um: vec![5.0], ..sound.clone() },
        DepthGrid { columns: usize::MAX, ..sound.clone() },
        DepthGrid { columns: 0, rows: 0, depth_um: Vec::new(), ..sound.clone() },
        DepthGrid { columns: 1, rows: 25, ..sound.clone() },
        DepthGrid { dz_mm: f64::NAN, ..sound.clone() },
        DepthGrid { depth_um: vec![f64::NAN; 25], ..sound.clone() },
        DepthGrid { depth_um: vec![1e308; 25], ..sound },
    ] {
        let errors = [outline(&bad, 1.0, 0.0).map(drop), level_of_area(&bad, 1.0).map(drop)];
        for error in errors.map(Result::unwrap_err) {
            assert!(error.to_string().starts_with("`grid` is"), "{error}");
        }
    }
}

proptest! {
    #[test]
    fn prop_outlines_are_valid_and_hold_the_nodes_that_are_deeper(
        depths in prop::collection::vec(-3.0..10.0f64, 64), level in 0.0..9.0f64, tolerance in 0.0..0.3f64,
    ) {
        let noise = DepthGrid {
            s0_mm: -2.0, z0_mm: 1.0, ds_mm: 0.3, dz_mm: 0.5, columns: 8, rows: 8, depth_um: depths
        };
        let Ok(exact) = outline(&noise, level, 0.0) else { return Ok(()) };
        let inside = |p: [f64; 2]| exact.polygons_mm.iter().fold(false, |inside, ring| {
            ring.iter().zip(ring.iter().cycle().skip(1)).fold(inside, |inside, (a, b)| {
                let passes = (a[1] <= p[1]) != (b[1] <= p[1])
                    && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
                inside != passes
            })
        });
        for k in 0..64 {
            let (c, r) = (k % 8, k / 8);
            // Nodes at the grid's edge lie on the line, nodes at the level next to it.
            let within = (1..7).contains(&c) && (1..7).contains(&r) && (noise.depth_um[k] - level).abs() > 1e-6;
            let p = [-2.0 + 0.3 * c as f64, 1.0 + 0.5 * r as f64];
            prop_assert!(!within || inside(p) == (noise.depth_um[k] > level), "node {} {}", c, r);
        }
        let few = outline(&noise, level, tolerance).unwrap();
        prop_assert!(faults(&few.polygons_mm).is_empty(), "{:?}", faults(&few.polygons_mm));
        prop_assert!(few.area_mm2() > 0.0);
    }
}
