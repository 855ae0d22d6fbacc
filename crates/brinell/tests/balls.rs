//! Ball bearings: Hertz's ellipse, the static balance, damage on strips across the groove (section 17 of the model).

use crate::common::cases::case;
use crate::common::read_li2023 as read;
use brinell::contact::ball::Strips;
use brinell::contact::{Damping, LoadDeflection};
use brinell::defect::{
    Angles, Defect, Defects, SIDES, Side, damaged_contact, depth_at_bottom, edge_gradient, energy, tangent,
};
use brinell::elementary::Exponent;
use brinell::model::Model;
use brinell::plausibility::before;
use brinell::scenario::{self, DepthGrid, RollerPath, Scenario, Surface};
use brinell::statics::{Problem, solve, static_load_zone};
use brinell::summary::strayed;
use proptest::prelude::*;
use std::f64::consts::PI;

const LAW: LoadDeflection = LoadDeflection {
    stiffness: 2.68371e10,
    exponent: Exponent::ThreeHalves,
    damping: Damping::Constant(150.0),
    strips: None,
};

/// R_w of the 6205's outer contact, and the R_eq that its balls have there, m.
const ACROSS: f64 = 73.241e-3;
const ALONG: f64 = 1.0 / (1.0 / 3.97e-3 - 1.0 / 23.49e-3);
/// R_o, m.
const RACEWAY: f64 = 23.49e-3;

fn law() -> LoadDeflection {
    LoadDeflection { strips: Some(Strips::new(LAW.stiffness, ACROSS)), ..LAW }
}

fn bearing() -> Scenario {
    case("xval/balls")
}

/// Defects on the outer raceway of the 6205, each a shape, an offset (mm) and a depth (um).
fn defects(shapes: &[(scenario::Shape, f64, f64)], path: RollerPath, slices: usize) -> Vec<Defect> {
    let mut s = bearing();
    s.contact.roller_path = path;
    s.contact.slices = slices;
    let all: Vec<scenario::Defect> = shapes
        .iter()
        .map(|(shape, offset, depth)| scenario::Defect {
            shape: shape.clone(),
            axial_offset_mm: *offset,
            depth_um: *depth,
            center_deg: 0.0,
            ..s.defects[0].clone()
        })
        .collect();
    Defect::all(&all, &s.bearing, &s.contact).unwrap()
}

fn at(s: f64) -> Angles {
    Angles { orbit: s / RACEWAY, spin: 0.0, ring: 0.0 }
}

fn elastic(defects: &[Defect], s: f64, delta: f64) -> f64 {
    let law = law();
    damaged_contact(Defects::all(defects, Side::Outer), &law, &at(s), delta).map_or(law.healthy(delta), |d| d.elastic)
}

fn rectangle(length_mm: f64, width_mm: f64) -> scenario::Shape {
    scenario::Shape::Rectangle { length_mm, width_mm }
}

fn circle(diameter_mm: f64) -> scenario::Shape {
    scenario::Shape::Circle { diameter_mm }
}

/// A bowl: depths that differ along and across.
fn bowl() -> scenario::Shape {
    let (columns, rows, step) = (41, 31, 0.05);
    let depth = |c: usize, r: usize| {
        let (s, z) = (c as f64 * step - 1.0, r as f64 * step - 0.75);
        (12.0 * (1.0 - s * s - z * z / 0.5)).max(0.0)
    };
    scenario::Shape::DepthMap {
        grid: DepthGrid {
            s0_mm: -1.0,
            z0_mm: -0.75,
            ds_mm: step,
            dz_mm: step,
            columns,
            rows,
            depth_um: (0..rows * columns).map(|k| depth(k % columns, k / columns)).collect(),
        },
    }
}

/// Every kind of damage that a ball meets, alone and together.
fn kinds() -> Vec<Vec<(scenario::Shape, f64, f64)>> {
    let profile = scenario::Shape::Profile {
        arc_mm: vec![-0.9, -0.2, 0.1, 0.8],
        width_mm: vec![0.2, 1.4, 1.1, 0.3],
        depth_um: Some(vec![0.0, 9.0, 4.0, 2.0]),
    };
    vec![
        vec![(rectangle(1.0, 0.9), 0.0, 8.0)],
        vec![(rectangle(1.4, 6.0), 0.3, 280.0)],
        vec![(circle(1.3), 0.0, 6.0)],
        vec![(circle(1.3), 0.4, 6.0)],
        vec![(profile, 0.0, 8.0)],
        vec![(bowl(), 0.1, 8.0)],
        vec![(circle(1.0), 0.0, 9.0), (rectangle(1.6, 0.3), -0.2, 5.0)],
    ]
}

const PATHS: [RollerPath; 2] = [RollerPath::Point, RollerPath::Envelope];

#[test]
fn lit_stribecks_heaviest_ball() {
    // Harris: Q_max = 4.37 F/Z for many balls without clearance; of nine, one of them at the load, 4.385
    // (`docs/src/theory/balls.md`).
    for (balls, expected) in [(9, 4.385), (900, 4.37)] {
        let mut s = bearing();
        s.defects.clear();
        s.bearing.rollers_per_row = balls;
        s.bearing.radial_clearance_um = 0.0;
        s.operation.load_n = [1000.0, 0.0];
        s.operation.speed_rpm = scenario::Speed::Constant(1e-3);
        s.support.inner_stiffness_n_per_m = 0.0;
        let model = Model::new(&s).unwrap();
        let mut problem = Problem::at_start(&model);
        problem.fix_outer = true;
        let balance = solve(&model, &problem).unwrap();
        let heaviest = balance.outer_force.iter().fold(0.0_f64, |m, q| m.max(*q));
        let factor = heaviest * balls as f64 / 1000.0;
        assert!((factor - expected).abs() < 3e-3, "{balls} balls: {factor}");
    }
}

/// Shift of the loaded inner ring (um), the outer one held, a ball at the load.
fn shift(bearing: &str, load: f64) -> f64 {
    let text = format!(
        "[bearing]\nelement = \"ball\"\n{bearing}\n[operation]\nspeed_rpm = 0.001\nload_n = [{load}, 0]\nload_on = \"inner-ring\"\n\
         [support]\ninner_stiffness_n_per_m = 0\n"
    );
    let loaded = read(&text, &[]).unwrap_or_else(|p| panic!("{p:?}"));
    let model = Model::new(&loaded.scenario).unwrap();
    let mut problem = Problem::at_start(&model);
    problem.fix_outer = true;
    1e6 * solve(&model, &problem).unwrap().inner[0]
}

#[test]
fn lit_shift_of_a_6205_and_of_a_commercial_code() {
    let of_6205 = "inner_raceway_diameter_mm = 31.1\nouter_raceway_diameter_mm = 46.98\nroller_diameter_mm = 7.94\nrollers_per_row = 9\n\
                   radial_clearance_um = 0";
    let ours = shift(of_6205, 200.0);
    assert!((ours / 4.8180 - 1.0).abs() < 2e-5, "{ours}");
    // Seven balls of 11.5 mm on 43.5 mm, 0.52 inside and 0.53 outside, 210 GPa, 1000 N; the commercial code prints
    // 15.1101 and 21.223 um.
    for (clearance, expected) in [(0.0, 15.1102), (5.0, 21.2228)] {
        let bearing = format!(
            "inner_raceway_diameter_mm = 32\nouter_raceway_diameter_mm = 55\nroller_diameter_mm = 11.5\nrollers_per_row = 7\n\
             outer_groove_conformity = 0.53\nradial_clearance_um = {clearance}\n[contact]\nyoungs_modulus_gpa = 210"
        );
        let ours = shift(&bearing, 1000.0);
        assert!((ours / expected - 1.0).abs() < 1e-5, "{ours} against {expected}");
    }
}

#[test]
fn lit_frequencies_of_cwru() {
    let model = Model::new(&bearing()).unwrap();
    let k = model.kinematics(2.0 * PI);
    for (ours, given) in [(k.bpfo, 3.5848), (k.bpfi, 5.4152), (k.ftf, 0.39831), (2.0 * k.bsf, 4.7135)] {
        assert!((ours / given - 1.0).abs() < 3e-5, "{ours} against {given}");
    }
}

#[test]
fn analytic_no_depth_is_hertz() {
    for kind in kinds() {
        let flat: Vec<_> = kind
            .iter()
            .map(|(shape, offset, _)| (shape.clone(), *offset, 0.0))
            .filter(|(shape, ..)| matches!(shape, scenario::Shape::Rectangle { .. } | scenario::Shape::Circle { .. }))
            .collect();
        for path in PATHS {
            let all = defects(&flat, path, 7);
            for delta in [2e-7, 3e-6, 4e-5] {
                let ours = elastic(&all, 1e-4, delta);
                assert!((ours / law().healthy(delta) - 1.0).abs() < 1e-14);
            }
        }
    }
}

#[test]
fn analytic_an_ellipse_in_a_pit_carries_exactly_nothing() {
    for path in PATHS {
        let all = defects(&[(circle(3.0), 0.0, 900.0)], path, 13);
        // a_z = sqrt(2 R_w delta) is 1.2 mm at 10 um.
        for k in 0..100 {
            let delta = 1e-7 * f64::from(k);
            assert_eq!(elastic(&all, 0.1e-3, delta), 0.0, "{path:?} {delta}");
        }
        assert!(elastic(&all, 0.1e-3, 2e-5) > 0.0);
    }
}

/// h(s, z) of a rectangle by its path.
fn depth(half: f64, deep: f64, path: RollerPath, s: f64) -> f64 {
    let end = half - s.abs();
    match path {
        RollerPath::Point => deep,
        RollerPath::Envelope => deep.min(end * end / (2.0 * ALONG)),
    }
}

#[test]
fn analytic_slices_against_the_integral_they_stand_for() {
    const CELLS: i32 = 40_000;
    let strips = law().strips.unwrap();
    for path in PATHS {
        let (rectangular, round) =
            (defects(&[(rectangle(1.0, 0.9), 0.2, 8.0)], path, 9), defects(&[(circle(1.2), 0.0, 6.0)], path, 1000));
        for (s, delta) in [(0.0, 3e-6), (0.2e-3, 7e-6), (-0.41e-3, 2e-5)] {
            let integral = |h: &dyn Fn(f64) -> f64| -> f64 {
                let dz = 4e-3 / f64::from(2 * CELLS);
                let at = |k: i32| {
                    let z = (f64::from(k) + 0.5) * dz;
                    (delta - z * z / (2.0 * ACROSS) - h(z)).max(0.0)
                };
                strips.stiffness * dz * (-CELLS..CELLS).map(at).sum::<f64>()
            };
            let of_rectangle = |z: f64| {
                if (-0.25e-3..0.65e-3).contains(&z) { depth(0.5e-3, 8e-6, path, s) } else { 0.0 }
            };
            let of_circle = |z: f64| {
                let half = (0.36e-6 - z * z).max(0.0).sqrt();
                if s.abs() < half { depth(half, 6e-6, path, s) } else { 0.0 }
            };
            let (ours, exact) = (elastic(&rectangular, s, delta), integral(&of_rectangle));
            assert!((ours - exact).abs() < 2e-4 * law().healthy(delta), "{path:?}: {ours} {exact}");
            let (ours, exact) = (elastic(&round, s, delta), integral(&of_circle));
            assert!((ours - exact).abs() < 3e-4 * law().healthy(delta), "{path:?}: {ours} {exact}");
        }
    }
}

#[test]
fn analytic_energy_is_the_integral_of_the_force_and_the_tangent_its_slope() {
    const CELLS: u32 = 4000;
    let top = 1.3e-5;
    for kind in kinds() {
        for path in PATHS {
            let all = defects(&kind, path, 6);
            for s in [-0.31e-3, 0.05e-3, 0.44e-3] {
                let dx = top / f64::from(CELLS);
                let work: f64 = (0..CELLS).map(|k| elastic(&all, s, (f64::from(k) + 0.5) * dx) * dx).sum();
                let ours = energy(Defects::all(&all, Side::Outer), &law(), &at(s), top);
                let size = law().energy(top);
                assert!((ours - work).abs() < 1e-6 * size, "{ours} against {work}");
                let step = 1e-9;
                let slope = (elastic(&all, s, top + step) - elastic(&all, s, top - step)) / (2.0 * step);
                let ours = tangent(Defects::all(&all, Side::Outer), &law(), &at(s), top);
                let size = law().tangent(top, None);
                assert!((ours - slope).abs() < 1e-3 * size, "{ours} against {slope}");
            }
        }
    }
}

#[test]
fn analytic_edge_gradient_is_the_slope_of_the_energy() {
    let delta = 9e-6;
    for kind in kinds() {
        let all = defects(&kind, RollerPath::Envelope, 8);
        let of = |s: f64| energy(Defects::all(&all, Side::Outer), &law(), &at(s), delta);
        for s in [-0.37e-3, 0.062e-3, 0.43e-3] {
            let step = 2e-8;
            let slope = (of(s + step) - of(s - step)) / (2.0 * step) * RACEWAY;
            let ours = edge_gradient(Defects::all(&all, Side::Outer), &law(), &at(s), delta).orbit;
            let size = law().energy(delta) / 1e-3 * RACEWAY;
            assert!((ours - slope).abs() < 2e-4 * size, "{ours} against {slope}");
        }
    }
}

#[test]
fn prop_results_do_not_depend_on_the_number_of_slices() {
    // A rectangle's slices are alike; of a circle they are a rule of integration.
    let delta = 6e-6;
    for path in PATHS {
        let mut before: Option<(f64, f64)> = None;
        for slices in [10, 30, 300] {
            let one = defects(&[(rectangle(1.0, 0.9), 0.0, 8.0)], path, slices);
            let round = defects(&[(circle(1.2), 0.1, 6.0)], path, slices);
            let ours = (elastic(&one, 0.1e-3, delta), elastic(&round, 0.1e-3, delta));
            if let Some(before) = before {
                assert!((ours.0 / before.0 - 1.0).abs() < 1e-13);
                // A slice's mean depth stands for depths of which some let go: less and less with their number.
                let off = (ours.1 - before.1).abs() / law().healthy(delta);
                assert!(off < 0.6 / slices as f64, "{slices}: {off}");
            }
            before = Some(ours);
        }
    }
}

#[test]
fn prop_mirrored_slices_are_those_of_both_sides() {
    // An offset of a picometre takes the short cut of mirrored slices away.
    for path in PATHS {
        for slices in [1, 6, 7] {
            let alike = defects(&[(circle(1.3), 0.0, 6.0)], path, slices);
            let moved = defects(&[(circle(1.3), 1e-9, 6.0)], path, slices);
            for delta in [1e-6, 8e-6, 3e-5] {
                let (a, b) = (elastic(&alike, 0.2e-3, delta), elastic(&moved, 0.2e-3, delta));
                assert!((a - b).abs() < 1e-5 * law().healthy(delta), "{a} {b}");
            }
        }
    }
}

#[test]
fn prop_two_halves_are_a_whole() {
    for path in PATHS {
        let whole = defects(&[(rectangle(1.0, 1.2), 0.0, 7.0)], path, 8);
        let halves = [(rectangle(1.0, 0.6), 0.3, 7.0), (rectangle(1.0, 0.6), -0.3, 7.0)];
        let halves = defects(&halves, path, 8);
        for (s, delta) in [(0.0, 5e-6), (0.33e-3, 9e-6), (0.46e-3, 2e-5)] {
            let (a, b) = (elastic(&whole, s, delta), elastic(&halves, s, delta));
            assert!((a - b).abs() < 1e-12 * law().healthy(delta), "{a} {b}");
        }
    }
}

#[test]
fn analytic_depth_at_the_bottom_by_the_path() {
    let reached = 0.2e-3 * 0.2e-3 / (2.0 * ALONG);
    for (path, expected) in [(RollerPath::Point, 80e-6), (RollerPath::Envelope, reached)] {
        let all = defects(&[(rectangle(1.0, 0.9), 0.0, 80.0)], path, 5);
        let depth = depth_at_bottom(Defects::all(&all, Side::Outer), &at(0.3e-3)).unwrap();
        assert!((depth / expected - 1.0).abs() < 1e-9, "{depth}");
        // Beside the bottom the lumped model knows of none; off the arc none is met.
        let beside = defects(&[(rectangle(1.0, 0.9), 0.5, 80.0)], path, 5);
        assert_eq!(depth_at_bottom(Defects::all(&beside, Side::Outer), &at(0.3e-3)), Some(0.0));
        assert_eq!(depth_at_bottom(Defects::all(&all, Side::Outer), &at(0.6e-3)), None);
    }
}

#[test]
fn prop_a_ball_with_damage_meets_both_raceways() {
    let mut s = bearing();
    s.defects[0].on = Surface::Roller(1);
    s.defects[0].center_deg = 0.0;
    let all = Defect::all(&s.defects, &s.bearing, &s.contact).unwrap();
    let model = Model::new(&s).unwrap();
    for (side, spin) in [(Side::Outer, 0.0), (Side::Inner, PI)] {
        let angles = Angles { orbit: 0.0, spin, ring: 0.0 };
        let law = model.contact(side);
        let damaged = damaged_contact(Defects::all(&all, side), law, &angles, 1e-5).unwrap();
        assert!(damaged.elastic < 0.9 * law.healthy(1e-5));
        let other = SIDES.into_iter().find(|x| *x != side).unwrap();
        let law = model.contact(other);
        assert!(damaged_contact(Defects::all(&all, other), law, &angles, 1e-5).is_none());
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn prop_force_lies_between_none_and_hertz_and_rises(
        kind in 0_usize..7, path in 0_usize..2, slices in 1_usize..40, s in -1e-3..1e-3_f64, delta in 0.0..4e-5_f64,
    ) {
        let all = defects(&kinds()[kind], PATHS[path], slices);
        let force = elastic(&all, s, delta);
        let hertz = law().healthy(delta);
        prop_assert!(force >= 0.0 && force <= hertz * (1.0 + 1e-12));
        prop_assert!(elastic(&all, s, 1.01 * delta) >= force * (1.0 - 1e-12));
        let damaged = damaged_contact(Defects::all(&all, Side::Outer), &law(), &at(s), delta);
        if let Some(damaged) = damaged {
            let axis = 2.0 * (2.0 * ACROSS * delta).sqrt();
            prop_assert!((-1e-15..=axis + 1e-15).contains(&damaged.floor.damaged_length));
        }
    }
}

/// A heavy cage under 5 kN at 8000 r/min.
fn fast(settings: &[(&str, &str)]) -> Scenario {
    let text = "bearing.preset = \"6316\"\noperation = { speed_rpm = 8000, load_n = [0, -5000], \
                gravity_m_per_s2 = [0, -9.81] }\nsimulation = { duration_s = 0.1, sample_rate_hz = 25600 }";
    let settings: Vec<_> = settings.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    read(text, &settings).unwrap().scenario
}

#[test]
fn regress_a_cage_that_its_soft_land_lets_stray_is_said_and_a_stiff_one_holds_it() {
    let warned = |settings: &[(&str, &str)]| {
        let scenario = fast(settings);
        let run = brinell::simulate(&scenario).unwrap();
        strayed(&scenario, &run.findings)
    };
    let said = warned(&[]);
    assert!(
        said.len() == 1 && said[0].starts_with("cage beyond its clearance: the centre of the cage of row 1"),
        "{said:?}"
    );
    let stiff = [("cage.land_stiffness_n_per_m", "1e7"), ("cage.land_damping_ns_per_m", "200")];
    assert_eq!(warned(&stiff), Vec::<String>::new());
}

#[test]
fn regress_an_ellipse_beyond_any_groove_is_said() {
    let warned = |conformity: &str| {
        let scenario = fast(&[("bearing.inner_groove_conformity", conformity)]);
        let model = Model::new(&scenario).unwrap();
        let all = before(&scenario, &model, &static_load_zone(&model));
        all.iter().any(|problem| problem.to_string().contains("no such bearing carries this load so"))
    };
    assert!(warned("0.5005") && !warned("0.52"));
}
