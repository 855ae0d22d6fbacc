//! Several defects at one contact.

use super::{LAW, at, defect, grid_mm};
use brinell::defect::{Angles, Defect, Defects, Side, damaged_contact, energy};
use brinell::scenario::{self, EdgeReaction, Law, RollerPath, Surface};
use std::f64::consts::PI;

#[test]
fn analytic_deepest_of_several_acts_in_each_slice_and_spares_raised_edges() {
    let flat = |length_mm, depth_um| {
        let mut s = crate::common::example();
        s.contact.law = Law::Sliced;
        s.contact.edge_reaction = EdgeReaction::None;
        let d = scenario::Defect {
            shape: scenario::Shape::Rectangle { length_mm, width_mm: 2.0 },
            depth_um,
            ..s.defects[0].clone()
        };
        Defect::new(&d, &s.bearing, &s.contact).unwrap()
    };
    let (shallow, deep) = (flat(4.0, 3.0), flat(2.0, 9.0));
    let on = |d: &[&Defect], u, delta| {
        let all: Vec<Defect> = d.iter().copied().cloned().collect();
        damaged_contact(Defects::all(&all, Side::Outer), &LAW, &at(u), delta).unwrap().elastic
    };
    let force = |d: &[&Defect], u| on(d, u, 20e-6);
    // One defect of one depth is summed as a whole, several slice by slice: the same to round-off.
    let same = |a: f64, b: f64| (a - b).abs() < 1e-12 * b;
    assert!(same(force(&[&shallow, &deep], 0.0), force(&[&deep], 0.0)));
    assert!(same(force(&[&deep, &shallow], 0.0), force(&[&deep], 0.0)));
    let off = 1.5e-3 / deep.radius;
    assert!(same(force(&[&shallow, &deep], off), force(&[&shallow], off)));
    // A ridge 5 um high under a defect that leaves its slices alone: it still carries.
    let ridge = scenario::Shape::DepthMap { grid: grid_mm([1.0, 3.0], 0.5, |_, z| if z > 1.6 { -5.0 } else { 0.0 }) };
    let ridge = defect(ridge, Surface::OuterRaceway, Law::Sliced, RollerPath::Point, 30);
    let alone = on(&[&ridge], 0.0, -1e-6);
    let with = on(&[&deep, &ridge], 0.0, -1e-6);
    assert!(alone > 0.0 && same(alone, with));
}

/// The angles at which a roller's line of contact is `u` (rad) from the centre of damage at 0 on either side.
fn over(on: Surface, side: Side, u: f64) -> Angles {
    match (on, side) {
        (Surface::Roller(_), Side::Inner) => at(u - PI),
        _ => at(u),
    }
}

#[test]
fn analytic_halves_that_touch_or_overlap_are_the_whole_under_the_envelope() {
    let part = |law, on, from_mm: f64, to_mm: f64| {
        let of = scenario::Shape::Rectangle { length_mm: to_mm - from_mm, width_mm: 4.0 };
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
                            damaged_contact(Defects::all(d, side), &LAW, &angles, delta).map(|a| a.elastic)
                        };
                        let (one, two) = (force(std::slice::from_ref(&whole)), force(&halves));
                        let stored = |d: &[Defect]| energy(Defects::all(d, side), &LAW, &angles, delta);
                        let (e_one, e_two) = (stored(std::slice::from_ref(&whole)), stored(&halves));
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
        let mut s = crate::common::example();
        s.contact.roller_path = RollerPath::Envelope;
        let d = scenario::Defect { shape: of, depth_um, ..s.defects[0].clone() };
        Defect::new(&d, &s.bearing, &s.contact).unwrap()
    };
    let rectangle = |length_mm, width_mm| scenario::Shape::Rectangle { length_mm, width_mm };
    let defects = [make(rectangle(5.0, 5.0), 3.0), make(rectangle(1.0, 1.0), 25.0)];
    let (half, radius) = (0.5e-3, 1.0 / (1.0 / 3e-3 - 1.0 / 27.5e-3));
    for k in -100..=100 {
        let s = 0.5e-3 * f64::from(k) / 100.0;
        let u = s / defects[0].radius;
        let both: Vec<_> = brinell::defect::floors(Defects::all(&defects, Side::Outer), &at(u)).collect();
        let exact = (3e-6 + (half - s.abs()).powi(2) / (2.0 * radius)).min(25e-6);
        assert!((both[0].depth - 3e-6).abs() < 1e-15, "the dent at {s}");
        assert!((both[1].depth - exact).abs() < 1e-15, "the pit at {s}: {} {exact}", both[1].depth);
        assert_eq!((both[0].damaged_length, both[1].damaged_length), (5e-3, 1e-3));
    }
}

#[test]
fn prop_under_ecl_the_envelope_of_a_raised_edge_is_never_deeper_than_its_floor() {
    let burr = scenario::Shape::DepthMap { grid: grid_mm([1.0, 1.5], 0.25, |s, z| 10.0 - 11.0 * s.hypot(z)) };
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
