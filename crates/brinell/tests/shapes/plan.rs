//! Outlines and depth maps against closed forms and an independent geometry library.

use super::{circle_mm, defect, grid_mm, shape};
use brinell::defect::{Outline, Shape, Side};
use brinell::scenario::{self, RollerPath, Surface};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::float::clip::FloatClip;
use i_overlay::string::clip::ClipRule;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

#[test]
fn analytic_rectangle_and_circle_as_polygons() {
    let corners = vec![[-1.5, -2.0], [1.5, -2.0], [1.5, 2.0], [-1.5, 2.0]];
    let rectangle = shape(scenario::Shape::Outline { polygons_mm: vec![corners] });
    let n = 720;
    let circle = shape(scenario::Shape::Outline { polygons_mm: vec![circle_mm(2.25, n)] });
    // A chord lies below its arc by at most the sagitta, along the radius; along z that is more where the border is
    // steep.
    let sagitta = 2.25e-3 * (1.0 - (PI / n as f64).cos());
    for k in -999..=999 {
        let s = 1.5e-3 * f64::from(k) / 1000.0;
        assert!((rectangle.damaged_length(s) - 4e-3).abs() < 1e-15);
        let s = 2.25e-3 * f64::from(k) / 1000.0;
        let half = (2.25e-3f64.powi(2) - s * s).sqrt();
        let steep = 2.25e-3 / half;
        let off = (circle.damaged_length(s) - 2.0 * half).abs();
        assert!(off <= 2.0 * sagitta * steep * 1.01, "{off} at {s}");
    }
    assert!((rectangle.area() - 12e-6).abs() < 1e-18);
    assert!((circle.area() / (PI * 2.25e-3f64.powi(2)) - 1.0).abs() < 2e-5);
    let (first, last) = rectangle.arc();
    assert!((first + 1.5e-3).abs() < 1e-18 && (last - 1.5e-3).abs() < 1e-18);
}

#[test]
fn analytic_rectangle_and_circle_as_depth_maps() {
    for step in [0.05, 0.02] {
        let rectangle = shape(scenario::Shape::DepthMap {
            grid: grid_mm([2.5, 2.8], step, |s, z| if s.abs() <= 1.5 && z.abs() <= 2.0 { 20.0 } else { 0.0 }),
        });
        let circle = shape(scenario::Shape::DepthMap {
            grid: grid_mm([2.5, 2.8], step, |s, z| if s.hypot(z) <= 2.25 { 20.0 } else { 0.0 }),
        });
        for k in -94..=94 {
            let s = 1.5e-3 * f64::from(k) / 100.0;
            let off = (rectangle.damaged_length(s) - 4e-3).abs();
            assert!(off <= 1.001e-3 * step && (rectangle.own_depth(s).unwrap() - 20e-6).abs() < 1e-18);
            let s = 2.25e-3 * f64::from(k) / 100.0;
            let half = (2.25e-3f64.powi(2) - s * s).sqrt();
            // One cell along z, and what the border climbs within one column.
            let resolution = 1e-3 * step * (1.0 + 2.0 * s.abs() / half);
            let off = (circle.damaged_length(s) - 2.0 * half).abs();
            assert!(off <= resolution, "step {step}: {off} at {s}");
        }
        // The damaged nodes count the area without bias; the surface reaches to the next sound nodes, half a step farther
        // along s and along z: by a perimeter of 2 pi a times half a step times the mean of |sin| + |cos|, which is 4/pi.
        let Shape::DepthMap(nodes) = &circle else { panic!("a grid") };
        let exact = PI * 2.25e-3f64.powi(2);
        assert!((nodes.width().integral() / exact - 1.0).abs() < 0.1 * step);
        let farther = 1e-3 * step * 4.0 * 2.25e-3 / exact;
        assert!(((circle.area() / exact - 1.0) / farther - 1.0).abs() < 0.1, "{} {farther}", circle.area() / exact);
    }
}

#[test]
fn analytic_grown_reaches_its_width_or_its_area() {
    let outline = vec![vec![[-3.0, -0.5], [2.0, -1.0], [3.0, 0.25], [0.0, 1.0]]];
    let grown =
        |max_width_mm, area_mm2| shape(scenario::Shape::Grown { outline: outline.clone(), max_width_mm, area_mm2 });
    let Shape::Outline(wide) = grown(Some(3.0), None) else { panic!("a grown outline is an outline") };
    assert!((wide.width().largest() - 3e-3).abs() < 1e-15);
    assert!((grown(None, Some(9.0)).area() - 9e-6).abs() < 1e-18);
    // Alike in both directions.
    let same = shape(scenario::Shape::Outline { polygons_mm: outline.clone() });
    let ratio = (wide.width().span().1 - wide.width().span().0) / (same.arc().1 - same.arc().0);
    assert!((wide.width().integral() / same.area() - ratio * ratio).abs() < 1e-12);
}

/// A star-shaped polygon around its centre.
fn star() -> impl Strategy<Value = Vec<[f64; 2]>> {
    (prop::collection::vec(0.3..2.5f64, 3..40), -1.0..1.0f64).prop_map(|(radii, turn)| {
        let n = radii.len() as f64;
        radii
            .iter()
            .enumerate()
            .map(|(k, r)| {
                let (sin, cos) = (TAU * k as f64 / n + turn).sin_cos();
                [r * cos, r * sin]
            })
            .collect()
    })
}

fn outline(polygons: &[Vec<[f64; 2]>]) -> Outline {
    Outline::new(polygons.to_vec()).unwrap()
}

/// The parts of a polygon on both sides of s = cut: Sutherland and Hodgman's clip.
fn split(polygon: &[[f64; 2]], cut: f64) -> [Vec<[f64; 2]>; 2] {
    [1.0, -1.0].map(|side| {
        let mut kept = Vec::new();
        for (k, p) in polygon.iter().enumerate() {
            let q = polygon[(k + 1) % polygon.len()];
            let inside = |x: &[f64; 2]| side * (x[0] - cut) <= 0.0;
            if inside(p) {
                kept.push(*p);
            }
            if inside(p) != inside(&q) {
                let f = (cut - p[0]) / (q[0] - p[0]);
                kept.push([cut, p[1] + f * (q[1] - p[1])]);
            }
        }
        kept
    })
}

proptest! {
    #[test]
    fn prop_width_is_invariant_under_splitting_and_mirrors(polygon in star(), cut in -0.25..0.25f64) {
        let whole = outline(std::slice::from_ref(&polygon));
        let parts = outline(&split(&polygon, cut));
        let up = outline(&[polygon.iter().map(|p| [p[0], -p[1]]).collect()]);
        let back = outline(&[polygon.iter().map(|p| [-p[0], p[1]]).collect()]);
        let (low, high) = whole.heights();
        for k in 0..=200 {
            let s = -2.5 + 5.0 * (f64::from(k) + 0.123) / 200.0;
            let width = whole.width().value(s);
            prop_assert!((0.0..=high - low + 1e-12).contains(&width));
            prop_assert!((parts.width().value(s) - width).abs() < 1e-9);
            prop_assert!((up.width().value(s) - width).abs() < 1e-9);
            prop_assert!((back.width().value(-s) - width).abs() < 1e-9);
        }
    }

    #[test]
    fn xval_slicing_agrees_with_i_overlay(polygon in star(), hole in 0.05..0.25f64, share in 0.02..0.98f64) {
        // A hole around the centre, which every star contains.
        let polygons = vec![polygon, circle_mm(hole, 24)];
        let ours = outline(&polygons);
        let rule = ClipRule { invert: false, boundary_included: false };
        let length = |line: Vec<[f64; 2]>| -> f64 {
            let parts = line.clip_by_as::<i64>(&polygons, FillRule::EvenOdd, rule);
            let long = |p: &[[f64; 2]]| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1]);
            parts.iter().map(|p| p.windows(2).map(long).sum::<f64>()).sum()
        };
        let (first, last) = ours.width().span();
        let s = first + share * (last - first);
        let theirs = length(vec![[s, -10.0], [s, 10.0]]);
        prop_assert!((ours.width().value(s) - theirs).abs() < 1e-6, "L_s({s}): {} {theirs}", ours.width().value(s));
    }

    #[test]
    fn prop_damage_is_within_the_roller_and_its_envelope_never_deeper(
        seed in any::<u64>(), roughness in 0.0..1.0f64, length in 0.5..6.0f64, width in 0.5..6.0f64,
    ) {
        let spall = scenario::Shape::Random { seed, length_mm: length, width_mm: width, roughness };
        let make = |path| defect(spall.clone(), Surface::OuterRaceway, path);
        let (plain, along) = (make(RollerPath::Point), make(RollerPath::Envelope));
        let (first, last) = plain.shape.arc();
        prop_assert!((last - first - 1e-3 * length).abs() < 1e-9);
        for k in 0..=100 {
            let u = (first + (last - first) * f64::from(k) / 100.0) / plain.radius;
            let (Some(a), Some(b)) = (plain.floor(u, Side::Outer), along.floor(u, Side::Outer)) else {
                continue;
            };
            prop_assert!((0.0..=6e-3).contains(&a.damaged_length) && a.damaged_length == b.damaged_length);
            prop_assert!(b.depth <= a.depth + 1e-15 && b.depth >= 0.0);
        }
    }

}
