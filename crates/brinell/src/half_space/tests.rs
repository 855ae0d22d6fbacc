//! Tables against other solvers and closed forms.

use super::build::{self, Built, Range};
use super::damage::{Damage, gather};
use super::field::pressure_at;
use super::geometry::Geometry;
use super::level::{self, Fineness};
use super::raster::{Bounds, Raster};
use super::{healthy_pressure, pressure_over};
use crate::defect::{Defect, Side};
use crate::effective::{Effective, Table};
use crate::scenario::{self, Scenario, Shape, Surface, Tables};
use std::num::NonZeroUsize;
use std::sync::atomic::AtomicBool;

const EDGE: f64 = 10e-6;

fn scenario(preset: &str) -> Scenario {
    let rest = "[operation]\nspeed_rpm = 1800\nload_n = [300, 0]\n[simulation]\nduration_s = 0.1";
    Scenario::from_toml(&format!("[bearing]\npreset = \"{preset}\"\n{rest}")).unwrap()
}

fn geometry(preset: &str) -> Geometry {
    let scenario = scenario(preset);
    Geometry::of_bearing(&scenario.bearing, &scenario.contact, Side::Outer).unwrap()
}

fn rectangle(length: f64, width: f64, depth: f64, edge: f64) -> Raster {
    let half = |x: f64| [-0.5 * x, 0.5 * x];
    Raster::of_depths(Bounds { s: half(length), z: half(width) }, edge, |_, _| depth)
}

fn threads(n: usize) -> NonZeroUsize {
    NonZeroUsize::new(n).unwrap()
}

fn built(geometry: &Geometry, raster: &Raster, delta_um: &[f64]) -> Built {
    let delta: Vec<f64> = delta_um.iter().map(|x| 1e-6 * x).collect();
    build::table_at(geometry, raster, &delta, Tables::Standard, threads(2), &AtomicBool::new(false)).unwrap()
}

/// Q/Q_0 where the healthy force is a power of delta.
fn force_ratio(built: &Built, delta: f64, s: f64, power: f64) -> f64 {
    let at = built.table.at(delta, s);
    (at.delta.max(0.0) / delta).powf(power) * at.by_delta
}

/// Worst errors of delta_eff over delta and of Q/Q_0 against rows of `s_mm,delta_um,delta_eff_um,q_over_q_healthy`.
fn worst(built: &Built, text: &str, power: f64) -> [f64; 2] {
    let mut worst = [0.0_f64; 2];
    for line in text.lines().skip(1) {
        let row: Vec<f64> = line.split(',').map(|x| x.parse().unwrap()).collect();
        let (s, delta) = (1e-3 * row[0], 1e-6 * row[1]);
        let effective = built.table.at(delta, s).delta.max(0.0);
        worst[0] = worst[0].max((effective - 1e-6 * row[2]).abs() / delta);
        worst[1] = worst[1].max((force_ratio(built, delta, s, power) - row[3]).abs());
    }
    worst
}

/// The whole reference where it is at hand, which is not in every copy of the repository; else four of its deformations.
fn reference(name: &str, thinned: &str) -> String {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/reference");
    std::fs::read_to_string(format!("{folder}/half-space-{name}.csv")).unwrap_or_else(|_| thinned.to_owned())
}

fn deformations(text: &str) -> Vec<f64> {
    let mut all: Vec<f64> = text.lines().skip(1).map(|line| line.split(',').nth(1).unwrap().parse().unwrap()).collect();
    all.push(0.0);
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

#[test]
fn xval_pit_under_a_ball_agrees_with_another_solver() {
    // 6205, 2 x 1 mm, 100 um deep; two grids extrapolated, by another implementation.
    let text = reference("ball", include_str!("reference_ball.csv"));
    let built = built(&geometry("6205"), &rectangle(2e-3, 1e-3, 100e-6, EDGE), &deformations(&text));
    let [value, force] = worst(&built, &text, 1.5);
    assert!(value < 5e-3 && force < 0.01, "{value} {force}");
}

#[test]
fn xval_rectangle_under_a_roller_agrees_with_another_solver() {
    let text = reference("roller", include_str!("reference_roller.csv"));
    let built = built(&geometry("NN3007"), &rectangle(3e-3, 4e-3, 20e-6, EDGE), &deformations(&text));
    let [value, force] = worst(&built, &text, 10.0 / 9.0);
    // Palmgren's power in place of the half-space's healthy force takes 0.007 of it.
    assert!(value < 5e-3 && force < 0.01 + 0.007, "{value} {force}");
}

#[test]
fn xval_endless_pits_and_their_edge_under_a_ball() {
    // Section 19: 6205 at 6.3 um, edges as sharp as the grid. Q/Q_0 and U/U_0 inside, to the digits given.
    let ball = geometry("6205");
    for (width, force, energy) in [(0.2e-3, 0.969, 0.953), (0.5e-3, 0.852, 0.787), (1e-3, 0.576, 0.440)] {
        let built = built(&ball, &rectangle(4e-3, width, width, 0.0), &[0.0, 5.0, 6.3, 7.5]);
        let at = built.table.at(6.3e-6, 0.0);
        let got = [force_ratio(&built, 6.3e-6, 0.0, 1.5), (at.delta / 6.3e-6).powf(2.5)];
        assert!((got[0] - force).abs() < 2.5e-3 && (got[1] - energy).abs() < 2.5e-3, "{width}: {got:?}");
        if width < 1e-3 {
            continue;
        }
        let along = [(-100.0, 0.994), (-50.0, 0.964), (0.0, 0.914), (50.0, 0.847), (100.0, 0.769), (150.0, 0.683)];
        for (s, expected) in along.into_iter().chain([(200.0, 0.590), (300.0, 0.573)]) {
            let got = force_ratio(&built, 6.3e-6, -2e-3 + 1e-6 * s, 1.5);
            assert!((got - expected).abs() < 6e-3, "{s}: {got} {expected}");
        }
    }
}

#[test]
fn xval_a_roller_on_two_thirds_of_its_length() {
    let built = built(&geometry("NN3007"), &rectangle(3e-3, 4e-3, 20e-6, 0.0), &[0.0, 1.3, 3.33, 6.3]);
    for (delta, expected) in [(1.3e-6, 0.486), (3.33e-6, 0.508), (6.3e-6, 0.526)] {
        let got = force_ratio(&built, delta, 0.0, 10.0 / 9.0);
        // Palmgren's power, as above.
        assert!((got - expected).abs() < 8e-3, "{delta}: {got}");
    }
}

#[test]
fn xval_the_healthy_ball_is_hertz() {
    // 424.37 N and 1069.4 uJ at 6.3 um (section 19); Hertz gives 2.68371e10 * 6.3e-6^1.5 = 424.37 N and 2/5 of that times delta.
    let healthy = rectangle(1e-3, 1e-3, 0.0, EDGE);
    let field = pressure_at(&geometry("6205"), &healthy, 6.3e-6, 0.0, Tables::Standard).unwrap();
    assert!((field.force / 424.37 - 1.0).abs() < 1e-3, "{}", field.force);
    assert!((field.energy / 1069.4e-6 - 1.0).abs() < 1e-3, "{}", field.energy);
    let hertz = 1.5 * 424.37 / (std::f64::consts::PI * 132.2e-6 * 960.6e-6);
    assert!((field.largest / hertz - 1.0).abs() < 5e-3, "{} {hertz}", field.largest);
    assert_eq!(field.pressure.len(), field.cells[0] * field.cells[1]);
}

#[test]
fn analytic_pressures_over_no_depth_are_hertz_and_add_up_to_the_force() {
    let (of, no_depth) = (scenario("6205"), [pit_at(90.0, 0.0)]);
    for (defects, share) in [(&no_depth[..], 1.0), (&[pit_at(90.0, 280.0)], 0.995)] {
        let defects = Defect::all(defects, &of.bearing, &of.contact).unwrap();
        let field = pressure_over((&defects, 0), (&of.bearing, &of.contact), Side::Outer, 3e-6).unwrap();
        let sum: f64 = field.pressure.iter().sum();
        assert!((sum * field.size[0] * field.size[1] / field.force - 1.0).abs() < 1e-9);
        let [_, hertz] = crate::pressure::pressures(&of, [field.force; 2]);
        let healthy = healthy_pressure((&of.bearing, &of.contact), Side::Outer, 3e-6).unwrap();
        if share == 1.0 {
            assert!((field.largest / hertz - 1.0).abs() < 0.03, "{} {hertz}", field.largest);
            assert!((healthy / hertz - 1.0).abs() < 0.03, "{healthy} {hertz}");
            assert_eq!(field.share_above(2.0 * healthy), 0.0);
        } else {
            // A pit 0.18 mm across takes little of the force; beside it the pressure is far above.
            assert!(field.force < share * hertz_force(&of, 3e-6) && field.largest > 1.5 * healthy);
            assert!(field.at[0].hypot(field.at[1]) > 0.08e-3, "{:?}", field.at);
            assert!((1e-4..0.2).contains(&field.share_above(1.5 * healthy)));
        }
    }
}

/// A round pit on the outer raceway of a 6205.
fn pit_at(center_deg: f64, depth_um: f64) -> scenario::Defect {
    scenario::Defect {
        on: Surface::OuterRaceway,
        row: 1,
        center_deg,
        depth_um,
        axial_offset_mm: 0.0,
        shape: Shape::Circle { diameter_mm: 0.1778 },
        table: None,
    }
}

/// Q of the healthy outer contact at a deformation, N.
fn hertz_force(of: &Scenario, delta: f64) -> f64 {
    crate::model::Model::new(of).unwrap().contact(Side::Outer).healthy(delta)
}

#[test]
fn regress_the_largest_pressure_over_narrow_damage_is_at_the_damage_and_not_at_the_rollers_end() {
    let of = scenario("NN3007");
    let groove = |width_mm: f64, axial_offset_mm: f64, depth_um: f64| scenario::Defect {
        axial_offset_mm,
        shape: Shape::Rectangle { length_mm: 1.0, width_mm },
        ..pit_at(90.0, depth_um)
    };
    let found = |defect: scenario::Defect| {
        let defects = Defect::all(&[defect], &of.bearing, &of.contact).unwrap();
        pressure_over((&defects, 0), (&of.bearing, &of.contact), Side::Outer, 3e-6).unwrap()
    };
    for (width, offset) in [(0.1, 0.0), (0.1, 1.5), (2.0, 0.0), (2.0, -0.5)] {
        let field = found(groove(width, offset, 2.0));
        // A cell, and the edge's radius.
        let room = [0, 1].map(|k| field.size[k] + 1e-5);
        assert!(field.at[0].abs() < 0.5e-3 + room[0], "{width} mm: {:?}", field.at);
        assert!((field.at[1] - 1e-3 * offset).abs() < 0.5e-3 * width + room[1], "{width} mm: {:?}", field.at);
        // The grid has the pressure that is told.
        assert!(field.pressure.contains(&field.largest));
    }
    // Beside a scratch the ends of a straight roller press more.
    let field = found(groove(0.1, 0.0, 0.1));
    assert!(field.pressure.iter().any(|p| *p > field.largest), "{}", field.largest);
    assert!(field.at[1].abs() < 0.1e-3 + field.size[1], "{:?}", field.at);
}

#[test]
fn prop_pressures_are_counted_from_their_own_defect() {
    let of = scenario("6205");
    let found = |defects: &[scenario::Defect], k: usize| {
        let defects = Defect::all(defects, &of.bearing, &of.contact).unwrap();
        pressure_over((&defects, k), (&of.bearing, &of.contact), Side::Outer, 3e-6).unwrap()
    };
    let (alone, far) = (found(&[pit_at(90.0, 280.0)], 0), [pit_at(90.0, 280.0), pit_at(270.0, 280.0)]);
    assert_eq!(found(&far, 1), alone);
    // 1 degree is 0.4 mm: one contact meets both, and the second is as far from the first.
    let near = found(&[pit_at(90.0, 280.0), pit_at(91.0, 280.0)], 1);
    assert!((near.largest / alone.largest - 1.0).abs() < 0.25, "{} {}", near.largest, alone.largest);
    assert!((near.at[0].hypot(near.at[1]) - 0.1e-3).abs() < 0.03e-3, "{:?}", near.at);
    let defects = Defect::all(&far, &of.bearing, &of.contact).unwrap();
    assert_eq!(pressure_over((&defects, 0), (&of.bearing, &of.contact), Side::Inner, 3e-6), None);
}

#[test]
fn analytic_no_depth_is_healthy_and_a_wide_floor_is_its_depth() {
    for (preset, width) in [("6205", 6e-3), ("NN3007", 8e-3)] {
        let of = geometry(preset);
        let delta = [0.0, 2.0, 4.0, 8.0];
        let healthy = built(&of, &rectangle(1e-3, width, 0.0, EDGE), &delta);
        let floor = built(&of, &rectangle(3e-3, width, 1.5e-6, EDGE), &delta);
        for delta in [2e-6, 4e-6, 5e-6, 8e-6] {
            let at = healthy.table.at(delta, 0.2e-3);
            assert!((at.delta - delta).abs() < 1e-12 * delta && (at.by_delta - 1.0).abs() < 1e-9, "{at:?}");
            // The healthy energies are compared on a grid for another deformation.
            let at = floor.table.at(delta, 0.0);
            assert!((at.delta - (delta - 1.5e-6)).abs() < 2e-3 * delta, "{preset} {delta}: {at:?}");
            assert!(at.by_s.abs() < 1e-6, "{at:?}");
        }
    }
}

#[test]
fn prop_a_grid_twice_as_fine_changes_little() {
    let pit = rectangle(2e-3, 1e-3, 100e-6, EDGE);
    let standard = Tables::Standard.fineness();
    let fine = Fineness { along: 2.0 * standard.along, rows: 2 * standard.rows, ..standard };
    let ball = geometry("6205");
    let solve = |f| level::solve(&ball, &pit, 6e-6, &f, &AtomicBool::new(false)).unwrap();
    let [one, other] = [standard, fine].map(solve);
    let mut common = 0;
    for place in &one.places {
        let Some(same) = other.places.iter().find(|other| other.s == place.s) else { continue };
        common += 1;
        assert!((place.value - same.value).abs() < 2.5e-3 * 6e-6, "{place:?} {same:?}");
        assert!((place.slope - same.slope).abs() < 6e-3, "{place:?} {same:?}");
    }
    assert!(common > 20, "{common}");
}

#[test]
fn prop_where_an_edge_lies_in_a_cell_does_not_matter() {
    // The same pit moved by parts of a cell (3.8 um; 8 to 16 to half the contact's width): what the contact feels moves along. An edge
    // is placed to some hundredths of a cell, and delta_eff changes by 0.5 % of delta on a micrometre here.
    let ball = geometry("6205");
    let at_edge = |shift: f64| {
        let bounds = Bounds { s: [-1e-3 + shift, 1e-3 + shift], z: [-0.5e-3, 0.5e-3] };
        let pit = Raster::of_depths(bounds, EDGE, |_, _| 100e-6);
        let built = built(&ball, &pit, &[0.0, 1.0, 2.0, 4.0]);
        [-1.02e-3, -0.99e-3, -0.96e-3, -0.93e-3].map(|s| built.table.at(2e-6, s + shift).delta)
    };
    let first = at_edge(0.0);
    for shift in [0.9e-6, 1.7e-6, 3.1e-6] {
        for (a, b) in at_edge(shift).into_iter().zip(first) {
            assert!((a - b).abs() < 3e-3 * 2e-6, "{shift}: {a} {b}");
        }
    }
}

#[test]
fn prop_under_a_rim_contact_begins_above_the_surface() {
    let bounds = Bounds { s: [-0.5e-3, 0.5e-3], z: [-0.5e-3, 0.5e-3] };
    let rim = Raster::of_depths(bounds, EDGE, |s, z| {
        let r = s.hypot(z) / 0.5e-3;
        if r < 0.6 {
            30e-6
        } else if r < 1.0 {
            -2e-6 * (1.0 - ((r - 0.8) / 0.2).powi(2))
        } else {
            0.0
        }
    });
    assert!((rim.raised() - 2e-6).abs() < 1e-8);
    let (ball, range) = (geometry("6205"), Range { static_deflection: 3e-6, largest: 12e-6 });
    let built = build::table(&ball, &rim, &range, Tables::Coarse, threads(2), &AtomicBool::new(false)).unwrap();
    let table = built.table;
    assert_eq!(table.first_delta(), -rim.raised());
    // The rim is at 0.4 mm.
    assert!(table.at(-0.3e-6, 0.4e-3).delta > 0.0 && table.at(-1.9e-6, 0.4e-3).delta < 0.3e-6);
    assert!(table.at(6e-6, 0.4e-3).delta > 6e-6);
    assert!(table.at(-0.3e-6, 1.5e-3).delta <= 0.0);
    // Before the reach it is healthy, and delta_eff rises with delta all along.
    assert!((table.at(6e-6, table.range_s()[0]).delta - 6e-6).abs() < 1e-15);
    for k in 0..60 {
        let s = -0.6e-3 + 2e-5 * f64::from(k);
        assert!((1..12).all(|d| table.at(1e-6 * f64::from(d), s).by_delta > 0.0), "{s}");
    }
}

#[test]
fn prop_a_written_table_read_back_gives_the_same_force() {
    // A file has values alone: without further rows between the nodes of delta, Q was up to 2 % of the healthy one off.
    let range = Range { static_deflection: 2.7e-6, largest: 11e-6 };
    let (pits, ball) = ([rectangle(0.6e-3, 1e-3, 100e-6, EDGE), rectangle(2e-3, 1.6e-3, 4e-6, EDGE)], geometry("6205"));
    for pit in pits {
        let built = build::table(&ball, &pit, &range, Tables::Coarse, threads(2), &AtomicBool::new(false)).unwrap();
        let text = built.table.to_csv_text(|delta| delta.max(0.0).powf(1.5));
        let data = scenario::TableData::from_csv_text(&text).unwrap();
        let metres = |values: &[f64], unit: f64| values.iter().map(|x| x * unit).collect::<Vec<_>>();
        let (s, delta) = (metres(&data.s_mm, 1e-3), metres(&data.delta_um, 1e-6));
        let read = Table::from_grid(&s, &delta, &metres(data.values.list(), 1e-6)).unwrap();
        let [from, to] = built.table.range_s();
        for k in 0..400 {
            let s = from + (to - from) * (f64::from(k) + 0.5) / 400.0;
            for delta in [0.1e-6, 0.3e-6, 0.7e-6, 1.6e-6, 3.3e-6, 4.2e-6, 6.5e-6, 9.5e-6] {
                let [own, other] = [&built.table, &read].map(|table| table.at(delta, s));
                let force = |at: Effective| at.delta.max(0.0).powf(1.5) * at.by_delta;
                let error = (force(own) - force(other)) / f64::max(delta, 0.27e-6).powf(1.5);
                assert!(error.abs() < 3e-3, "s {s:e}, delta {delta:e}: {own:?} {other:?}");
            }
        }
    }
}

#[test]
fn prop_threads_change_no_bit_and_a_flag_stops() {
    let (roller, damage) = (geometry("NN3007"), rectangle(0.5e-3, 2e-3, 20e-6, EDGE));
    let range = Range { static_deflection: 2.5e-6, largest: 10e-6 };
    let go = |n: usize, stop: bool| {
        build::table(&roller, &damage, &range, Tables::Coarse, threads(n), &AtomicBool::new(stop))
    };
    let one = go(1, false).unwrap();
    assert_eq!(one, go(3, false).unwrap());
    assert_eq!(go(1, true), Err(super::error::BuildError::Stopped));
    let nothing = Range { static_deflection: 0.0, largest: 1e-5 };
    let error = build::table(&roller, &damage, &nothing, Tables::Coarse, threads(1), &AtomicBool::new(false));
    assert!(matches!(error, Err(super::error::BuildError::NotPositive { .. })));
}

#[test]
fn prop_defects_that_are_met_together_are_one_surface() {
    let scenario = scenario("NN3007");
    let defect = |center_deg: f64, depth_um: f64, on: Surface| scenario::Defect {
        on,
        row: 1,
        center_deg,
        depth_um,
        axial_offset_mm: 0.0,
        shape: Shape::Rectangle { length_mm: 1.0, width_mm: 2.0 },
        table: None,
    };
    let all = [
        defect(359.0, 10.0, Surface::OuterRaceway),
        defect(90.0, 10.0, Surface::OuterRaceway),
        defect(0.5, 20.0, Surface::OuterRaceway),
        defect(0.0, 20.0, Surface::InnerRaceway),
    ];
    let defects = Defect::all(&all, &scenario.bearing, &scenario.contact).unwrap();
    let groups = gather(&defects, |_| 0.2e-3);
    assert_eq!(groups, [vec![0, 2], vec![1], vec![3]]);
    let raster = &Damage::of(&defects, &groups[0], EDGE).raster;
    // 1.5 degrees on 27.5 mm is 0.72 mm: they overlap from 0.22 to 0.5 mm, where the deeper counts.
    for (s, depth) in [(-0.4e-3, 10e-6), (0.35e-3, 20e-6), (1.0e-3, 20e-6), (1.3e-3, 0.0)] {
        assert!((raster.rounded(s, 0.3e-3) - depth).abs() < 1e-11, "{s}: {}", raster.rounded(s, 0.3e-3));
    }
    assert!(raster.is_mirrored());
}

/// Deeper than the table reaches, over the whole width, a floor is where it is: delta_eff = delta - h.
#[test]
fn analytic_a_floor_beyond_the_table_holds() {
    let geometry = geometry("NN3007");
    for (depth, length) in [(20e-6, 3e-3), (500e-6, 9e-3)] {
        let raster = rectangle(length, 8e-3, depth, 10e-6);
        let range = Range { static_deflection: 1.3e-6, largest: 10e-6 };
        let stop = AtomicBool::new(false);
        let table = build::table(&geometry, &raster, &range, Tables::Quick, threads(2), &stop).unwrap().table;
        for above in [-5e-6, 1e-6, 5e-6] {
            let met = table.at(depth + above, 0.0);
            // The splines along s still feel the walls by some 1e-5 of the depth.
            assert!((met.delta - above).abs() < 1e-4 * depth && (met.by_delta - 1.0).abs() < 1e-9, "{depth}: {met:?}");
            assert!(met.by_s.abs() < 1e-6, "{depth}: {met:?}");
        }
        // On the way to the wall the roller leans on the edge: never more than healthy, never less than on the floor.
        for k in 0..=400 {
            let s = 1.2 * length * (f64::from(k) / 400.0 - 0.5);
            for delta in [2e-6, 8e-6] {
                let met = table.at(delta, s);
                // Tables hold to half a per cent of delta; quick ones ring by 2 % of the depth beside the kink where a deep floor ends.
                let [above, below] = [5e-3 * delta, 5e-2 * (delta + depth)];
                assert!(met.delta <= delta + above && met.delta >= delta - depth - below, "{depth}, s = {s}: {met:?}");
            }
        }
    }
}
