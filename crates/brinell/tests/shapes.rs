//! Shapes of damage against closed forms, against each other, and against an independent geometry library.

use brinell::contact::Hertz;
use brinell::defect::{Angles, Defect, Outline, Shape, Side, acting, edge_gradient, energy, spall};
use brinell::elementary::Exponent;
use brinell::scenario::{self, DepthGrid, EdgeReaction, Law, RollerPath, Scenario, Surface};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::float::clip::FloatClip;
use i_overlay::string::clip::ClipRule;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

const LAW: Hertz = Hertz {
    stiffness: 1.898e8,
    exponent: Exponent::TenNinths,
    damping: 200.0,
};

fn circle_mm(radius: f64, corners: usize) -> Vec<[f64; 2]> {
    (0..corners)
        .map(|k| {
            let (sin, cos) = (TAU * k as f64 / corners as f64).sin_cos();
            [radius * cos, radius * sin]
        })
        .collect()
}

fn grid_mm(half: [f64; 2], step: f64, depth: impl Fn(f64, f64) -> f64) -> DepthGrid {
    let [columns, rows] = half.map(|h| (2.0 * h / step).round() as usize + 1);
    let s = |c: usize| -half[0] + c as f64 * step;
    let z = |r: usize| -half[1] + r as f64 * step;
    DepthGrid {
        s0_mm: -half[0],
        z0_mm: -half[1],
        ds_mm: step,
        dz_mm: step,
        columns,
        rows,
        depth_um: (0..rows * columns)
            .map(|k| depth(s(k % columns), z(k / columns)))
            .collect(),
    }
}

fn shape(of: scenario::Shape) -> Shape {
    Shape::new(&of, 20e-6).unwrap()
}

/// The example's defect with another shape, law and path.
fn defect(of: scenario::Shape, on: Surface, law: Law, path: RollerPath, slices: usize) -> Defect {
    let mut s = Scenario::example();
    s.contact.law = law;
    s.contact.roller_path = path;
    s.contact.slices = slices;
    let d = scenario::Defect {
        shape: of,
        on,
        ..s.defects[0].clone()
    };
    Defect::new(&d, &s.bearing, &s.contact).unwrap()
}

fn at(orbit: f64) -> Angles {
    Angles {
        orbit,
        spin: 0.0,
        ring: 0.0,
    }
}

#[test]
fn analytic_rectangle_and_circle_as_polygons() {
    let corners = vec![[-1.5, -2.0], [1.5, -2.0], [1.5, 2.0], [-1.5, 2.0]];
    let rectangle = shape(scenario::Shape::Outline {
        polygons_mm: vec![corners],
    });
    let n = 720;
    let circle = shape(scenario::Shape::Outline {
        polygons_mm: vec![circle_mm(2.25, n)],
    });
    // A chord lies below its arc by at most the sagitta, along the radius; along z that is more where the border is steep.
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
            grid: grid_mm([2.5, 2.8], step, |s, z| {
                if s.abs() <= 1.5 && z.abs() <= 2.0 {
                    20.0
                } else {
                    0.0
                }
            }),
        });
        let circle = shape(scenario::Shape::DepthMap {
            grid: grid_mm([2.5, 2.8], step, |s, z| {
                if s.hypot(z) <= 2.25 { 20.0 } else { 0.0 }
            }),
        });
        for k in -94..=94 {
            let s = 1.5e-3 * f64::from(k) / 100.0;
            let off = (rectangle.damaged_length(s) - 4e-3).abs();
            assert!(
                off <= 1.001e-3 * step && (rectangle.own_depth(s).unwrap() - 20e-6).abs() < 1e-18
            );
            let s = 2.25e-3 * f64::from(k) / 100.0;
            let half = (2.25e-3f64.powi(2) - s * s).sqrt();
            // One cell along z, and what the border climbs within one column.
            let resolution = 1e-3 * step * (1.0 + 2.0 * s.abs() / half);
            let off = (circle.damaged_length(s) - 2.0 * half).abs();
            assert!(off <= resolution, "step {step}: {off} at {s}");
        }
        assert!((circle.area() / (PI * 2.25e-3f64.powi(2)) - 1.0).abs() < 0.1 * step);
    }
}

#[test]
fn analytic_grown_reaches_its_width_or_its_area() {
    let outline = vec![vec![[-3.0, -0.5], [2.0, -1.0], [3.0, 0.25], [0.0, 1.0]]];
    let grown = |max_width_mm, area_mm2| {
        shape(scenario::Shape::Grown {
            outline: outline.clone(),
            max_width_mm,
            area_mm2,
        })
    };
    let Shape::Outline(wide) = grown(Some(3.0), None) else {
        panic!("a grown outline is an outline")
    };
    assert!((wide.width().largest() - 3e-3).abs() < 1e-15);
    assert!((grown(None, Some(9.0)).area() - 9e-6).abs() < 1e-18);
    // Alike in both directions.
    let same = shape(scenario::Shape::Outline {
        polygons_mm: outline.clone(),
    });
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
        let make = |law, path| defect(spall.clone(), Surface::OuterRaceway, law, path, 15);
        let (plain, along) = (make(Law::Ecl, RollerPath::Point), make(Law::Ecl, RollerPath::Envelope));
        let (cut, cut_along) = (make(Law::Sliced, RollerPath::Point), make(Law::Sliced, RollerPath::Envelope));
        let (first, last) = plain.shape.arc();
        prop_assert!((last - first - 1e-3 * length).abs() < 1e-9);
        for k in 0..=100 {
            let u = (first + (last - first) * f64::from(k) / 100.0) / plain.radius;
            let (Some(a), Some(b)) = (plain.floor(u, Side::Outer), along.floor(u, Side::Outer)) else {
                continue;
            };
            prop_assert!((0.0..=6e-3).contains(&a.damaged_length) && a.damaged_length == b.damaged_length);
            prop_assert!(b.depth <= a.depth + 1e-15 && b.depth >= 0.0);
            let force = |d: &Defect| acting([d].into_iter(), &LAW, &at(u), Side::Outer, 30e-6).map_or(0.0, |a| a.elastic);
            // Along the envelope the mean over a slice of a fine map is a sum over 12 lines, at a point it is exact.
            prop_assert!(force(&cut_along) >= force(&cut) * (1.0 - 3e-2));
        }
    }

    #[test]
    fn prop_sliced_and_ecl_agree_on_full_width_damage(u in -0.06..0.06f64, delta in -5e-6..60e-6f64) {
        let full = scenario::Shape::Rectangle { length_mm: 3.0, width_mm: 6.0 };
        for path in [RollerPath::Point, RollerPath::Envelope] {
            let force = |law| {
                let d = defect(full.clone(), Surface::OuterRaceway, law, path, 30);
                let stored = energy([&d].into_iter(), &LAW, &at(u), Side::Outer, delta);
                (acting([&d].into_iter(), &LAW, &at(u), Side::Outer, delta).map(|a| a.elastic), stored)
            };
            let ((a, ea), (b, eb)) = (force(Law::Ecl), force(Law::Sliced));
            prop_assert_eq!(a.is_some(), b.is_some());
            prop_assert!((a.unwrap_or(0.0) - b.unwrap_or(0.0)).abs() <= 1e-12 * LAW.healthy(60e-6));
            prop_assert!((ea - eb).abs() <= 1e-12 * LAW.energy(60e-6));
        }
    }
}

/// Elastic sums over a passage of 2.8 mm, over the healthy contact's.
fn passage(of: &scenario::Shape, path: RollerPath, slices: usize, delta: f64) -> Vec<f64> {
    let d = defect(of.clone(), Surface::OuterRaceway, Law::Sliced, path, slices);
    (0..40)
        .map(|k| {
            let u = 1.4e-3 * (f64::from(k) / 20.0 - 0.975) / d.radius;
            let healthy = LAW.healthy(delta);
            acting([&d].into_iter(), &LAW, &at(u), Side::Outer, delta)
                .map_or(1.0, |a| a.elastic / healthy)
        })
        .collect()
}

fn rms_of_difference(a: &[f64], b: &[f64]) -> f64 {
    let squares: f64 = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum();
    (squares / a.len() as f64).sqrt()
}

/// Differences of the elastic sum with 8, 16, ... slices from very many.
fn slice_errors(of: &scenario::Shape, path: RollerPath, delta: f64) -> Vec<f64> {
    let exact = passage(of, path, 2000, delta);
    [8, 16, 32, 64, 128]
        .map(|n| rms_of_difference(&passage(of, path, n, delta), &exact))
        .to_vec()
}

fn order(errors: &[f64]) -> f64 {
    let n = errors.len() - 1;
    (errors[0] / errors[n]).log2() / n as f64
}

/// The outline of `tests/reference/slices-oblique.toml`, moved as there.
fn oblique() -> scenario::Shape {
    let corners = [
        [-1.7, 0.15],
        [0.4, -0.65],
        [1.6, 0.9],
        [1.1, 2.75],
        [-0.3, 1.35],
        [-1.2, 2.4],
    ];
    scenario::Shape::Outline {
        polygons_mm: vec![corners.map(|[s, z]| [s, z - 0.3]).to_vec()],
    }
}

#[test]
fn analytic_damage_of_one_depth_at_a_point_knows_no_slices_and_below_its_floor_is_linear_in_its_width()
 {
    for of in [
        scenario::Shape::Circle { diameter_mm: 2.6 },
        scenario::Shape::Li2023Irregular { max_width_mm: 4.0 },
        oblique(),
    ] {
        // Above the floor of 20 um, and below it.
        for delta in [12e-6, 35e-6] {
            let one = passage(&of, RollerPath::Point, 1, delta);
            for n in [7, 30, 300] {
                let many = passage(&of, RollerPath::Point, n, delta);
                assert!(rms_of_difference(&one, &many) < 1e-14, "{of:?} {n}");
            }
            let d = defect(
                of.clone(),
                Surface::OuterRaceway,
                Law::Sliced,
                RollerPath::Point,
                30,
            );
            for (k, share) in one.iter().enumerate() {
                let v = d.damaged_length(1.4e-3 * (k as f64 / 20.0 - 0.975)) / 6e-3;
                let floor = LAW.healthy(delta - 20e-6) / LAW.healthy(delta);
                assert!((share - (1.0 - v + v * floor)).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn analytic_slices_converge_at_second_order_on_slopes_and_at_first_or_better_along_the_envelope() {
    // Within a slice depths are averaged before the law is applied. Along an envelope they rise from 0 at a slanted edge within a slice or two.
    let dent = scenario::Shape::DepthMap {
        grid: grid_mm([2.0, 3.0], 0.02, |s, z| {
            8.0 * (0.3 + (0.4 * z).cos()) * (1.0 - 0.2 * s * s)
        }),
    };
    let circle = scenario::Shape::Circle { diameter_mm: 4.5 };
    for (name, of, path, delta, orders, most) in [
        ("dent", &dent, RollerPath::Point, 30e-6, 1.9..2.1, 1e-5),
        (
            "circle",
            &circle,
            RollerPath::Envelope,
            35e-6,
            1.0..2.3,
            2e-3,
        ),
        (
            "outline",
            &oblique(),
            RollerPath::Envelope,
            35e-6,
            1.0..2.3,
            2e-3,
        ),
        // Where a slice holds both what carries and what does not, the mean depth decides for all of it.
        (
            "circle not reached",
            &circle,
            RollerPath::Envelope,
            12e-6,
            1.0..2.0,
            1e-2,
        ),
    ] {
        let errors = slice_errors(of, path, delta);
        println!("{name} {errors:?}, order {:.2}", order(&errors));
        assert!(orders.contains(&order(&errors)), "{name} {errors:?}");
        assert!(errors[2] < most, "{name} {errors:?}");
    }
}

#[test]
fn prop_ten_slices_make_no_step_and_hardly_differ_from_three_hundred() {
    // A slice that switched as a whole would be a step of a fifth: outlines have two borders.
    let ragged = scenario::Shape::Random {
        seed: 5,
        length_mm: 2.4,
        width_mm: 4.1,
        roughness: 1.0,
    };
    for (of, most) in [
        (scenario::Shape::Circle { diameter_mm: 2.6 }, 0.01),
        (scenario::Shape::Li2023Irregular { max_width_mm: 4.0 }, 0.01),
        (oblique(), 0.01),
        // A map covers cell by cell, so the mean depth of a wide slice jumps at a column.
        (ragged, 0.1),
    ] {
        for path in [RollerPath::Point, RollerPath::Envelope] {
            for delta in [3e-6, 12e-6] {
                let forces = |slices: usize| -> Vec<f64> {
                    let d = defect(of.clone(), Surface::OuterRaceway, Law::Sliced, path, slices);
                    let (first, last) = d.shape.arc();
                    let healthy = LAW.healthy(delta);
                    (-100..=20_100)
                        .map(|k| {
                            let u = (first + (last - first) * f64::from(k) / 2e4) / d.radius;
                            acting([&d].into_iter(), &LAW, &at(u), Side::Outer, delta)
                                .map_or(1.0, |a| a.elastic / healthy)
                        })
                        .collect()
                };
                let (few, many) = (forces(10), forces(300));
                let step = |x: &[f64]| {
                    x.windows(2)
                        .map(|w| (w[1] - w[0]).abs())
                        .fold(0.0, f64::max)
                };
                let (step, fine, off) = (step(&few), step(&many), rms_of_difference(&few, &many));
                println!("{of:?} {path:?} {delta}: steps {step:.1e} {fine:.1e}, apart {off:.1e}");
                assert!(step < most && off < 0.05, "{of:?} {path:?}: {step} {off}");
            }
        }
    }
}

/// min over s' of h(s') + (s - s')^2 / (2 R) along z = const where h is `depth` between two s and 0 elsewhere.
fn reached(s: f64, [from, to]: [f64; 2], depth: f64, radius: f64) -> f64 {
    let d = (s - from).min(to - s).max(0.0);
    depth.min(d * d / (2.0 * radius))
}

#[test]
fn analytic_slices_agree_with_a_fine_sum_over_z() {
    // Half the lines z = const of each slice, by the definition.
    const LINES: usize = 4000;
    let radius = 1.0 / (1.0 / 3e-3 - 1.0 / 27.5e-3);
    let chord = |of: &scenario::Shape, z: f64| -> Option<[f64; 2]> {
        match of {
            scenario::Shape::Circle { diameter_mm } => {
                let a = 0.5e-3 * diameter_mm;
                (z.abs() < a).then(|| {
                    let half = (a * a - z * z).sqrt();
                    [-half, half]
                })
            }
            scenario::Shape::Outline { polygons_mm } => {
                let p = &polygons_mm[0];
                let mut hits: Vec<f64> = (0..p.len())
                    .filter_map(|k| {
                        let (a, b) = (p[k], p[(k + 1) % p.len()]);
                        let at = (1e3 * z - a[1]) / (b[1] - a[1]);
                        (0.0..1.0)
                            .contains(&at)
                            .then(|| 1e-3 * (a[0] + at * (b[0] - a[0])))
                    })
                    .collect();
                hits.sort_by(f64::total_cmp);
                (hits.len() >= 2).then(|| [hits[0], hits[1]])
            }
            _ => None,
        }
    };
    // Convex, so that a line has one chord: slanted edges, off the middle of the row.
    let slanted = scenario::Shape::Outline {
        polygons_mm: vec![vec![[-1.4, -0.3], [0.9, -1.1], [1.5, 0.6], [-0.2, 2.2]]],
    };
    for of in [scenario::Shape::Circle { diameter_mm: 2.6 }, slanted] {
        let n = 9;
        let d = defect(
            of.clone(),
            Surface::OuterRaceway,
            Law::Sliced,
            RollerPath::Envelope,
            n,
        );
        for k in 0..25 {
            let s = 1.4e-3 * (f64::from(k) / 12.0 - 1.0);
            for delta in [9e-6, 28e-6] {
                let mut sum = 0.0;
                let mut covered = 0.0;
                for slice in 0..n {
                    let (mut count, mut depth) = (0.0, 0.0);
                    for line in 0..LINES {
                        let place = (slice * LINES + line) as f64 + 0.5;
                        let z = 6e-3 * (place / (n * LINES) as f64 - 0.5);
                        if let Some(c) = chord(&of, z).filter(|c| c[0] <= s && s <= c[1]) {
                            count += 1.0;
                            depth += reached(s, c, 20e-6, radius);
                        }
                    }
                    let phi = count / LINES as f64;
                    covered += phi / n as f64;
                    sum += (1.0 - phi) * LAW.healthy(delta);
                    if count > 0.0 {
                        sum += phi * LAW.healthy(delta - depth / count);
                    }
                }
                let ours = acting(
                    [&d].into_iter(),
                    &LAW,
                    &at(s / d.radius),
                    Side::Outer,
                    delta,
                );
                let (elastic, length) = ours.map_or((LAW.healthy(delta), 0.0), |a| {
                    (a.elastic, a.floor.damaged_length)
                });
                let off = (elastic * n as f64 - sum).abs() / (n as f64 * LAW.healthy(delta));
                assert!(off < 2e-4, "{of:?} at {s}: {off}");
                assert!((length - 6e-3 * covered).abs() < 4e-6, "{of:?} at {s}");
                // L_s is the covered z, exactly, at any number of slices.
                assert!(
                    (length - d.damaged_length(s)).abs() < 1e-10,
                    "{of:?} at {s}"
                );
            }
        }
    }
}

#[test]
fn analytic_axial_offset_moves_any_shape_and_what_leaves_the_roller_does_not_count() {
    let make = |of: scenario::Shape, axial_offset_mm: f64, law, path| {
        let mut s = Scenario::example();
        (s.contact.law, s.contact.roller_path, s.contact.slices) = (law, path, 11);
        let d = scenario::Defect {
            shape: of,
            axial_offset_mm,
            ..s.defects[0].clone()
        };
        Defect::new(&d, &s.bearing, &s.contact).unwrap()
    };
    let rectangle = scenario::Shape::Rectangle {
        length_mm: 2.0,
        width_mm: 3.0,
    };
    let drawn = |z: f64| scenario::Shape::Outline {
        polygons_mm: vec![vec![
            [-1.0, z - 1.5],
            [1.0, z - 1.5],
            [1.0, z + 1.5],
            [-1.0, z + 1.5],
        ]],
    };
    // As nodes half a step inside the border, which stand for their cells.
    let mapped = scenario::Shape::DepthMap {
        grid: grid_mm([1.2, 1.7], 0.1, |s, z| {
            if s.abs() < 1.01 && z.abs() < 1.46 {
                20.0
            } else {
                0.0
            }
        }),
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
                    acting([d].into_iter(), &LAW, &at(u), Side::Outer, 9e-6)
                        .map(|a| (a.elastic, a.floor.damaged_length))
                };
                for d in &moved {
                    for u in [0.0, 0.02, 0.035] {
                        let ((a, la), (b, lb)) =
                            (force(d, u).unwrap(), force(&moved[0], u).unwrap());
                        assert!(
                            (a / b - 1.0).abs() < 1e-9,
                            "{offset} {law:?} {path:?} at {u}: {a} {b}"
                        );
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
    let [a, b] =
        pair.map(|d| acting([&d].into_iter(), &LAW, &at(0.01), Side::Outer, 9e-6).unwrap());
    assert!((a.elastic / b.elastic - 1.0).abs() < 1e-12);
}

#[test]
fn analytic_envelope_radii_of_every_surface() {
    let (r, inner, outer) = (3e-3, 21.5e-3, 27.5e-3);
    let outside = 1.0 / (1.0 / r - 1.0 / outer);
    let inside = 1.0 / (1.0 / r + 1.0 / inner);
    let rectangle = scenario::Shape::Rectangle {
        length_mm: 3.0,
        width_mm: 4.0,
    };
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
        assert!(
            (h - from_edge * from_edge / (2.0 * radius)).abs() < 1e-18,
            "{on:?} {side:?}"
        );
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
    let rectangle = scenario::Shape::Rectangle {
        length_mm: 2.0,
        width_mm: 3.0,
    };
    for (on, side) in [
        (Surface::OuterRaceway, Side::Outer),
        (Surface::InnerRaceway, Side::Inner),
        (Surface::Roller(3), Side::Outer),
        (Surface::Roller(3), Side::Inner),
    ] {
        let make =
            |x: &scenario::Shape| defect(x.clone(), on, Law::Sliced, RollerPath::Envelope, 12);
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
            let base = if on == Surface::Roller(3) && side == Side::Inner {
                PI
            } else {
                0.0
            };
            for k in 0..60 {
                let x = (1.7e-3 * (f64::from(k) / 30.0 - 0.99)) / both[0].radius;
                let angles = Angles {
                    orbit: x - base + 0.3 + 0.2,
                    spin: if base > 0.0 || on == Surface::Roller(3) {
                        0.5
                    } else {
                        0.0
                    },
                    ring: if on == Surface::InnerRaceway {
                        0.5
                    } else {
                        0.0
                    },
                };
                let angles = Angles {
                    orbit: if on == Surface::OuterRaceway {
                        x
                    } else {
                        angles.orbit
                    },
                    ..angles
                };
                let delta = 14e-6;
                let stored = |a: &Angles| energy(both.iter(), &LAW, a, side, delta);
                let e = edge_gradient(both.iter(), &LAW, &angles, side, delta);
                // Of several defects at once it is a difference itself, and the search over them leaves out ridges of a nanometre.
                let (step, share) = if set == 0 { (3e-6, 3e-2) } else { (1e-7, 2e-3) };
                let by = |f: &dyn Fn(&mut Angles, f64)| {
                    let [up, down] = [step, -step].map(|h| {
                        let mut a = angles;
                        f(&mut a, h);
                        stored(&a)
                    });
                    (up - down) / (2.0 * step)
                };
                let numeric = [
                    by(&|a, h| a.orbit += h),
                    by(&|a, h| a.spin += h),
                    by(&|a, h| a.ring += h),
                ];
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

#[test]
fn analytic_deepest_of_several_acts_in_each_slice_and_spares_raised_edges() {
    let flat = |length_mm, depth_um| {
        let mut s = Scenario::example();
        s.contact.law = Law::Sliced;
        s.contact.edge_reaction = EdgeReaction::None;
        let d = scenario::Defect {
            shape: scenario::Shape::Rectangle {
                length_mm,
                width_mm: 2.0,
            },
            depth_um,
            ..s.defects[0].clone()
        };
        Defect::new(&d, &s.bearing, &s.contact).unwrap()
    };
    let (shallow, deep) = (flat(4.0, 3.0), flat(2.0, 9.0));
    let force = |d: &[&Defect], u| {
        acting(d.iter().copied(), &LAW, &at(u), Side::Outer, 20e-6)
            .unwrap()
            .elastic
    };
    // One defect of one depth is summed as a whole, several slice by slice: the same to round-off.
    let same = |a: f64, b: f64| (a - b).abs() < 1e-12 * b;
    assert!(same(force(&[&shallow, &deep], 0.0), force(&[&deep], 0.0)));
    assert!(same(force(&[&deep, &shallow], 0.0), force(&[&deep], 0.0)));
    let off = 1.5e-3 / deep.radius;
    assert!(same(
        force(&[&shallow, &deep], off),
        force(&[&shallow], off)
    ));
    // A ridge 5 um high under a defect that leaves its slices alone: it still carries.
    let ridge = scenario::Shape::DepthMap {
        grid: grid_mm([1.0, 3.0], 0.5, |_, z| if z > 1.6 { -5.0 } else { 0.0 }),
    };
    let ridge = defect(
        ridge,
        Surface::OuterRaceway,
        Law::Sliced,
        RollerPath::Point,
        30,
    );
    let alone = acting([&ridge].into_iter(), &LAW, &at(0.0), Side::Outer, -1e-6)
        .unwrap()
        .elastic;
    let with = acting(
        [&deep, &ridge].into_iter(),
        &LAW,
        &at(0.0),
        Side::Outer,
        -1e-6,
    )
    .unwrap()
    .elastic;
    assert!(alone > 0.0 && same(alone, with));
}

/// The angles at which a roller's line of contact stands `u` (rad) from the centre of damage at 0 on either side.
fn over(on: Surface, side: Side, u: f64) -> Angles {
    match (on, side) {
        (Surface::Roller(_), Side::Inner) => at(u - PI),
        _ => at(u),
    }
}

#[test]
fn analytic_halves_that_touch_or_overlap_are_the_whole_under_the_envelope() {
    let part = |law, on, from_mm: f64, to_mm: f64| {
        let of = scenario::Shape::Rectangle {
            length_mm: to_mm - from_mm,
            width_mm: 4.0,
        };
        let mut d = defect(of, on, law, RollerPath::Envelope, 12);
        d.center = 0.5e-3 * (from_mm + to_mm) / d.radius;
        d
    };
    for law in [Law::Ecl, Law::Sliced] {
        for (on, side) in [
            (Surface::OuterRaceway, Side::Outer),
            (Surface::InnerRaceway, Side::Inner),
            (Surface::Roller(3), Side::Outer),
            (Surface::Roller(3), Side::Inner),
        ] {
            let whole = part(law, on, -1.5, 1.5);
            for cuts in [[0.0, 0.0], [0.1, -0.1], [1.4, 1.3]] {
                let halves = [part(law, on, -1.5, cuts[0]), part(law, on, cuts[1], 1.5)];
                let mut apart = 0.0_f64;
                for k in -110..=110 {
                    let u = 1.507e-5 * f64::from(k) / whole.radius;
                    let angles = over(on, side, u);
                    for delta in [5e-6, 25e-6, 60e-6] {
                        let force = |d: &[Defect]| {
                            acting(d.iter(), &LAW, &angles, side, delta).map(|a| a.elastic)
                        };
                        let (one, two) = (force(std::slice::from_ref(&whole)), force(&halves));
                        let stored = |d: &[Defect]| energy(d.iter(), &LAW, &angles, side, delta);
                        let (e_one, e_two) =
                            (stored(std::slice::from_ref(&whole)), stored(&halves));
                        assert_eq!(one.is_some(), two.is_some(), "{law:?} {on:?} {side:?} {k}");
                        let size = LAW.healthy(delta);
                        let (one, two) = (one.unwrap_or(size), two.unwrap_or(size));
                        let place = format!("{law:?} {on:?} {side:?} {cuts:?} at {k}, {delta}");
                        assert!((one - two).abs() < 1e-9 * size, "{place}: {one} {two}");
                        // Two floors: the energy is integrated by cells.
                        assert!((e_one - e_two).abs() < 1e-3 * LAW.energy(delta), "{place}");
                        let separate = halves
                            .iter()
                            .map(|d| force(std::slice::from_ref(d)).unwrap_or(size))
                            .fold(f64::INFINITY, f64::min);
                        apart = apart.max((separate - one) / size);
                    }
                }
                // The deepest of the separate envelopes is another, stiffer contact.
                assert!(apart > 0.05, "{law:?} {on:?} {side:?} {cuts:?}: {apart}");
            }
        }
    }
}

#[test]
fn analytic_under_ecl_two_defects_follow_the_envelope_of_one_profile_and_a_pit_deepens_no_dent() {
    let make = |of, depth_um| {
        let mut s = Scenario::example();
        s.contact.roller_path = RollerPath::Envelope;
        let d = scenario::Defect {
            shape: of,
            depth_um,
            ..s.defects[0].clone()
        };
        Defect::new(&d, &s.bearing, &s.contact).unwrap()
    };
    let rectangle = |length_mm, width_mm| scenario::Shape::Rectangle {
        length_mm,
        width_mm,
    };
    let (dent, pit) = (
        make(rectangle(5.0, 5.0), 3.0),
        make(rectangle(1.0, 1.0), 25.0),
    );
    let (half, radius) = (0.5e-3, 1.0 / (1.0 / 3e-3 - 1.0 / 27.5e-3));
    for k in -100..=100 {
        let s = 0.5e-3 * f64::from(k) / 100.0;
        let u = s / dent.radius;
        let both: Vec<_> =
            brinell::defect::floors([&dent, &pit].into_iter(), &at(u), Side::Outer).collect();
        let exact = (3e-6 + (half - s.abs()).powi(2) / (2.0 * radius)).min(25e-6);
        assert!((both[0].depth - 3e-6).abs() < 1e-15, "the dent at {s}");
        assert!(
            (both[1].depth - exact).abs() < 1e-15,
            "the pit at {s}: {} {exact}",
            both[1].depth
        );
        assert_eq!(
            (both[0].damaged_length, both[1].damaged_length),
            (5e-3, 1e-3)
        );
    }
}

#[test]
fn prop_under_ecl_the_envelope_of_a_raised_edge_is_never_deeper_than_its_floor() {
    let burr = scenario::Shape::DepthMap {
        grid: grid_mm([1.0, 1.5], 0.25, |s, z| 10.0 - 11.0 * s.hypot(z)),
    };
    let make = |path| defect(burr.clone(), Surface::OuterRaceway, Law::Ecl, path, 1);
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
