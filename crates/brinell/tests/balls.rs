//! Ball bearings: Hertz's ellipse, the static balance, damage in the lumped model (section 17 of the model).

use crate::common::cases::case;
use crate::common::read_li2023 as read;
use brinell::defect::ecl::depth_at_bottom;
use brinell::defect::{Angles, Defect, Defects, Side};
use brinell::model::Model;
use brinell::plausibility::{before, strayed};
use brinell::scenario::{self, Law, ModelKind, RollerPath, Scenario};
use brinell::statics::{Problem, solve, static_load_zone};
use std::f64::consts::PI;

/// R_eq that the balls of a 6205 have at its outer contact, and R_o, m.
const ALONG: f64 = 1.0 / (1.0 / 3.97e-3 - 1.0 / 23.49e-3);
const RACEWAY: f64 = 23.49e-3;

fn bearing() -> Scenario {
    let mut s = case("xval/balls");
    s.operation.gravity_m_per_s2 = [0.0; 2];
    s
}

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

/// All that the lumped model knows of damage under a ball.
#[test]
fn analytic_depth_at_the_bottom_by_the_path() {
    let deep = |path, shape: &str, offset_mm: f64, at: f64| {
        let mut s = bearing();
        (s.simulation.model, s.contact.law, s.contact.roller_path) = (ModelKind::Lumped, Law::Ecl, path);
        let text = format!("[[defects]]\non = \"outer-raceway\"\ncenter_deg = 0\ndepth_um = 80\nshape = {{ {shape} }}");
        let loaded =
            brinell::document::read(&format!("bearing.preset = \"6205\"\n{OPERATION}{text}"), &[]).unwrap().scenario;
        let of = scenario::Defect { axial_offset_mm: offset_mm, ..loaded.defects[0].clone() };
        let defect = Defect::new(&of, &s.bearing, &s.contact).unwrap();
        let angles = Angles { orbit: at / RACEWAY, spin: 0.0, ring: 0.0 };
        depth_at_bottom(Defects::one(&defect, Side::Outer), &angles)
    };
    let reached = 0.2e-3 * 0.2e-3 / (2.0 * ALONG);
    let drawn = "outline = { points_mm = [[-0.5, -0.45], [0.5, -0.45], [0.5, 0.45], [-0.5, 0.45]] }";
    for (path, expected) in [(RollerPath::Point, 80e-6), (RollerPath::Envelope, reached)] {
        for shape in ["rectangle = { length_mm = 1, width_mm = 0.9 }", drawn] {
            let depth = deep(path, shape, 0.0, 0.3e-3).unwrap();
            assert!((depth / expected - 1.0).abs() < 1e-9, "{path:?} {shape}: {depth}");
            let moved = deep(path, shape, 0.3, 0.3e-3).unwrap();
            assert!((moved / depth - 1.0).abs() < 1e-9, "{path:?} {shape}: {moved} and {depth}");
            // Beside the bottom the lumped model knows of none; off the arc none is met.
            assert_eq!(deep(path, shape, 0.5, 0.3e-3), None);
            assert_eq!(deep(path, shape, 0.0, 0.6e-3), None);
        }
        // A circle's chord at z = 0.
        let disc = deep(path, "circle = { diameter_mm = 1 }", 0.3, 0.39e-3);
        assert!(disc.is_some() && deep(path, "circle = { diameter_mm = 1 }", 0.3, 0.41e-3).is_none());
    }
}

const OPERATION: &str = "operation = { speed_rpm = 1800, load_n = [800, 0] }\n";

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
