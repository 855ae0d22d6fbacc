//! The law `sliced`: how it converges and what it agrees with.

use super::{LAW, at, defect, grid_mm, oblique};
use brinell::defect::{Defects, Side, damaged_contact};
use brinell::scenario::{self, Law, RollerPath, Surface};

/// Elastic sums over a passage of 2.8 mm, over the healthy contact's.
fn passage(of: &scenario::Shape, path: RollerPath, slices: usize, delta: f64) -> Vec<f64> {
    let d = defect(of.clone(), Surface::OuterRaceway, Law::Sliced, path, slices);
    (0..40)
        .map(|k| {
            let u = 1.4e-3 * (f64::from(k) / 20.0 - 0.975) / d.radius;
            let healthy = LAW.healthy(delta);
            damaged_contact(Defects::one(&d, Side::Outer), &LAW, &at(u), delta).map_or(1.0, |a| a.elastic / healthy)
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
    [8, 16, 32, 64, 128].map(|n| rms_of_difference(&passage(of, path, n, delta), &exact)).to_vec()
}

fn order(errors: &[f64]) -> f64 {
    let n = errors.len() - 1;
    (errors[0] / errors[n]).log2() / n as f64
}

#[test]
fn analytic_damage_of_one_depth_at_a_point_knows_no_slices_and_below_its_floor_is_linear_in_its_width() {
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
            let d = defect(of.clone(), Surface::OuterRaceway, Law::Sliced, RollerPath::Point, 30);
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
    // Within a slice depths are averaged before the law is applied. Along an envelope they rise from 0 at a slanted
    // edge within a slice or two.
    let dent = scenario::Shape::DepthMap {
        grid: grid_mm([2.0, 3.0], 0.02, |s, z| 8.0 * (0.3 + (0.4 * z).cos()) * (1.0 - 0.2 * s * s)),
    };
    let circle = scenario::Shape::Circle { diameter_mm: 4.5 };
    for (name, of, path, delta, orders, most) in [
        ("dent", &dent, RollerPath::Point, 30e-6, 1.9..2.1, 1e-5),
        ("circle", &circle, RollerPath::Envelope, 35e-6, 1.0..2.3, 2e-3),
        ("outline", &oblique(), RollerPath::Envelope, 35e-6, 1.0..2.3, 2e-3),
        // Where a slice holds both what carries and what does not, the mean depth decides for all of it.
        ("circle not reached", &circle, RollerPath::Envelope, 12e-6, 1.0..2.0, 1e-2),
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
    let ragged = scenario::Shape::Random { seed: 5, length_mm: 2.4, width_mm: 4.1, roughness: 1.0 };
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
                            damaged_contact(Defects::one(&d, Side::Outer), &LAW, &at(u), delta)
                                .map_or(1.0, |a| a.elastic / healthy)
                        })
                        .collect()
                };
                let (few, many) = (forces(10), forces(300));
                let step = |x: &[f64]| x.windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f64::max);
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
                        (0.0..1.0).contains(&at).then(|| 1e-3 * (a[0] + at * (b[0] - a[0])))
                    })
                    .collect();
                hits.sort_by(f64::total_cmp);
                (hits.len() >= 2).then(|| [hits[0], hits[1]])
            }
            _ => None,
        }
    };
    // Convex, so that a line has one chord: slanted edges, off the middle of the row.
    let slanted =
        scenario::Shape::Outline { polygons_mm: vec![vec![[-1.4, -0.3], [0.9, -1.1], [1.5, 0.6], [-0.2, 2.2]]] };
    for of in [scenario::Shape::Circle { diameter_mm: 2.6 }, slanted] {
        let n = 9;
        let d = defect(of.clone(), Surface::OuterRaceway, Law::Sliced, RollerPath::Envelope, n);
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
                let ours = damaged_contact(Defects::one(&d, Side::Outer), &LAW, &at(s / d.radius), delta);
                let (elastic, length) = ours.map_or((LAW.healthy(delta), 0.0), |a| (a.elastic, a.floor.damaged_length));
                let off = (elastic * n as f64 - sum).abs() / (n as f64 * LAW.healthy(delta));
                assert!(off < 2e-4, "{of:?} at {s}: {off}");
                assert!((length - 6e-3 * covered).abs() < 4e-6, "{of:?} at {s}");
                // L_s is the covered z, exactly, at any number of slices.
                assert!((length - d.damaged_length(s)).abs() < 1e-10, "{of:?} at {s}");
            }
        }
    }
}
