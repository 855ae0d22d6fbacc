//! Stiffness and damping between the rings, and the force over the cage's angle, against closed forms and the equations of motion.

use brinell::coefficients::{Coefficients, coefficients, force_over_cage_angle};
use brinell::model::{Model, Motion, series_stiffness};
use brinell::scenario::{Accuracy, Operation, Scenario, Speed};
use brinell::solver::{Stepper, System};
use brinell::statics::{Balance, Problem, solve};
use brinell::{accuracy, start};
use std::f64::consts::TAU;

/// The NN3007 with 38 rollers.
const ROLLERS: &str = "preset = \"NN3007\"\nprofile = \"straight\"\n";

fn scenario(bearing: &str, more: &str) -> Scenario {
    let text = format!(
        "[bearing]\n{bearing}[operation]\nspeed_rpm = 3000\nload_n = [300, 0]\nload_on = \"inner-ring\"\n[support]\n\
         inner_stiffness_n_per_m = 0\n{more}"
    );
    Scenario::from_toml(&text).unwrap_or_else(|e| panic!("{e}"))
}

fn model(bearing: &str, more: &str) -> Model {
    Model::new(&scenario(bearing, more)).unwrap()
}

fn at(model: &Model, load: [f64; 2]) -> Coefficients {
    coefficients(model, load, 0.0).unwrap_or_else(|e| panic!("{e}"))
}

#[track_caller]
fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() < tolerance, "{found}, expected {expected}");
}

#[test]
fn analytic_stiffness_is_the_slope_of_load_over_displacement() {
    // A mean of slopes is the slope of means as far as positions in a pitch are alike: so of a preloaded bearing, less where few are loaded. What turned normals add, Q/R_m beside k, is left out: 4e-4.
    let preloaded = format!("{ROLLERS}radial_clearance_um = -10\n");
    for (bearing, tolerance) in
        [(&*preloaded, 1e-3), (ROLLERS, 0.06), ("preset = \"6205\"\nradial_clearance_um = 5\n", 0.06)]
    {
        let model = model(bearing, "");
        let (f, h) = ([260.0, 150.0], 1.0);
        let k = at(&model, f).stiffness;
        let moved = |by: [f64; 2]| at(&model, [f[0] + by[0], f[1] + by[1]]).displacement;
        for (axis, by) in [[h, 0.0], [0.0, h]].into_iter().enumerate() {
            let (ahead, behind) = (moved(by), moved(by.map(|f| -f)));
            let slope = [0, 1].map(|i| (ahead[i] - behind[i]) / (2.0 * h));
            for i in 0..2 {
                let force = k[i][0] * slope[0] + k[i][1] * slope[1];
                let expected = if i == axis { 1.0 } else { 0.0 };
                assert!((force - expected).abs() < tolerance, "{bearing}: {force}, expected {expected}");
            }
        }
        assert!((k[0][1] - k[1][0]).abs() < 1e-9 * k[0][0]);
    }
}

#[test]
fn analytic_without_clearance_stiffness_goes_with_the_contact_law() {
    // F = Z J K_s d^n: K = n F/d along the load, and K ~ F^((n - 1)/n). Displacements of some um turn normals by 1e-4 and less.
    for (bearing, n, twice) in [(ROLLERS, 10.0 / 9.0, 1024.0), ("preset = \"6205\"\n", 1.5, 8.0)] {
        let model = model(&format!("{bearing}radial_clearance_um = 0\n"), "");
        let [light, heavy] = [10.0, 10.0 * twice].map(|f| at(&model, [f, 0.0]));
        for axis in 0..2 {
            close(heavy.stiffness[axis][axis] / light.stiffness[axis][axis], 2.0, 2e-3);
        }
        close(light.stiffness[0][0], n * 10.0 / light.displacement[0], 1e-2);
        assert!(light.stiffness[0][1].abs() < 1e-3 * light.stiffness[0][0], "{light:?}");
    }
}

#[test]
fn analytic_centrifugal_force_of_preloaded_balls() {
    // Q_o = Q_i + m R_m w_c^2 and the deformations of both contacts are the interference: K = Z/2 of both in series.
    let model = model("preset = \"6205\"\nradial_clearance_um = -4\n", "");
    let speed = 15_000.0 * TAU / 60.0;
    let own = model.inertia.roller * model.geometry.pitch_radius * model.rolling_orbit_speed(speed).powi(2);
    let [k_in, k_out] = [&model.inner_contact, &model.outer_contact].map(|law| law.stiffness);
    let deformations = |q: f64| [(q / k_in).powf(2.0 / 3.0), ((q + own) / k_out).powf(2.0 / 3.0)];
    let (mut low, mut high) = (0.0, 1e4);
    for _ in 0..100 {
        let q = 0.5 * (low + high);
        let interference: f64 = deformations(q).iter().sum();
        if interference < -model.geometry.clearance { low = q } else { high = q }
    }
    let [a, b] = deformations(low);
    let [a, b] = [1.5 * k_in * a.sqrt(), 1.5 * k_out * b.sqrt()];
    let found = |speed: f64| coefficients(&model, [1.0, 0.0], speed).unwrap();
    (0..2).for_each(|axis| close(found(speed).stiffness[axis][axis], 4.5 * a * b / (a + b), 1e-4));
    let softer = found(speed).stiffness[0][0] / found(0.0).stiffness[0][0];
    assert!((0.9..0.999).contains(&softer), "{softer} by {own} N");
    assert_eq!(found(-speed), found(speed));
}

#[test]
fn analytic_damping_is_the_time_times_the_stiffness() {
    // With next to no roughness every contact has tau k, and so have all of them in series.
    let model = model("preset = \"6205\"\n", "[contact]\ndamping_time_us = 2.5\nroughness_um = 1e-6\n");
    let Coefficients { stiffness, damping, .. } = at(&model, [300.0, 200.0]);
    for (k, c) in stiffness.iter().flatten().zip(damping.iter().flatten()) {
        close(*c, 2.5e-6 * k, 1e-5);
    }
}

#[test]
fn analytic_equal_dampers_of_a_preloaded_bearing() {
    // All Z contacts pressed, k_i = k_o: c/2 each, Z/2 of them along any axis.
    let even = "[contact]\ninner_stiffness = 8e8\nouter_stiffness = 8e8\ndamping_ns_per_m = 200\n";
    let model = model(&format!("{ROLLERS}radial_clearance_um = -10\n"), even);
    let c = at(&model, [100.0, 0.0]).damping;
    (0..2).for_each(|axis| close(c[axis][axis], 200.0 / 2.0 * 38.0 / 2.0, 1e-9));
    assert!(c[0][1].abs() < 1e-6);
}

#[test]
fn prop_damping_takes_the_power_that_the_equations_of_motion_take() {
    // Rings and elements moved as a slowly changing load moves them, from balance to balance, at positions all over a pitch.
    let model = model(&format!("{ROLLERS}radial_clearance_um = -10\n"), "[contact]\ninner_stiffness = 3e8\n");
    let mut problem = Problem { speed: 0.0, fix_outer: true, ..Problem::at_start(&model) };
    let c = at(&model, [300.0, 0.0]).damping;
    let l = &model.layout;
    let under = |problem: &Problem, f: [f64; 2]| -> Balance {
        let mut model = model.clone();
        model.load.full = f;
        model.inertia.inner_ring = 0.0;
        solve(&model, problem).unwrap()
    };
    for (phase, by) in [[1.0, 0.0], [0.0, 1.0], [0.6, -0.8], [1.0, 1.0]].into_iter().enumerate() {
        problem
            .orbit
            .iter_mut()
            .zip(&model.pocket_angle)
            .for_each(|(orbit, pocket)| *orbit = pocket + 0.05 * phase as f64);
        let middle = under(&problem, [300.0, 0.0]);
        let [ahead, behind] = [1.0, -1.0].map(|s| under(&problem, [300.0 + s * by[0], s * by[1]]));
        let rate = |a: f64, b: f64| 0.5 * (a - b);
        let v = [0, 1].map(|k| rate(ahead.inner[k], behind.inner[k]));
        let mut y = vec![0.0; 2 * l.dof()];
        y[l.r()..][..l.slots].copy_from_slice(&middle.r);
        y[l.theta()..][..l.slots].copy_from_slice(&problem.orbit);
        y[l.inner()..][..2].copy_from_slice(&middle.inner);
        let rates = &mut y[l.dof()..];
        rates[l.inner()..][..2].copy_from_slice(&v);
        for slot in 0..l.slots {
            rates[l.r() + slot] = rate(ahead.r[slot], behind.r[slot]);
        }
        let mut motion = Motion::new(&model);
        motion.accelerations(0.0, &y, &mut vec![0.0; l.dof()]);
        let expected: f64 = (0..2).map(|i| (0..2).map(|j| v[i] * c[i][j] * v[j]).sum::<f64>()).sum();
        close(motion.ws.power.contact, expected, 1e-4);
    }
}

#[test]
fn prop_a_ring_rings_and_decays_as_its_coefficients_say() {
    // Without friction, and in centred geometry, so that nothing moves the rollers along the raceways meanwhile. A knock of 1 mm/s on an inner ring of 50 kg, as it moves by the equations of motion: frequency and decay of the oscillator m, k, c.
    let s = scenario(
        &format!("{ROLLERS}radial_clearance_um = -20\ninner_ring_mass_kg = 50\n"),
        "inner_damping_ns_per_m = 0\nouter_stiffness_n_per_m = 1e12\n[housing]\nmass_kg = 1e7\n[contact]\nroughness_um = 1e-4\n[friction]\nraceway_coefficient = 0\n\
         rolling_coefficient = 0\n[simulation]\nstart = \"equilibrium\"\ngeometry = \"centred\"\n",
    );
    let load = [1000.0, 0.0];
    let s = Scenario { operation: Operation { speed_rpm: Speed::Constant(60.0), load_n: load, ..s.operation }, ..s };
    let model = Model::new(&s).unwrap();
    let of = coefficients(&model, load, TAU).unwrap();
    let (m, k, c) = (model.inertia.inner_ring, of.stiffness[0][0], of.damping[0][0]);
    let mut y = start::state(&model).unwrap();
    let (at, rest) = (model.layout.inner(), y[model.layout.inner()]);
    y[model.layout.dof() + at] = 1e-3;
    let mut motion = Motion::new(&model);
    let mut stepper = Stepper::new(&mut motion, accuracy::settings(&model, Accuracy::Standard), 0.0, &y);
    // Times at which it passes its rest upwards, and the heights before them.
    let (mut upwards, mut heights) = (Vec::new(), Vec::new());
    let (mut before, mut height) = ((0.0, 0.0), 0.0_f64);
    while upwards.len() < 20 {
        stepper.step(&mut motion).unwrap();
        let now = (stepper.t(), stepper.y()[at] - rest);
        assert!(now.0 < 0.1, "{upwards:?}");
        height = height.max(now.1);
        if before.1 < 0.0 && now.1 >= 0.0 {
            upwards.push(before.0 + (now.0 - before.0) * before.1 / (before.1 - now.1));
            heights.push(std::mem::take(&mut height));
        }
        before = now;
    }
    let time = upwards[19] - upwards[0];
    close(TAU * 19.0 / time, (k / m - (0.5 * c / m).powi(2)).sqrt(), 5e-4);
    close((heights[0] / heights[19]).ln() / time, 0.5 * c / m, 5e-3);
}

#[test]
fn analytic_a_roller_in_a_deep_pit_takes_its_force_with_it() {
    let pit = "[[defects]]\non = \"outer-raceway\"\ncenter_deg = 0\ndepth_um = 500\nshape = { rectangle = { length_mm = 0.5, \
               width_mm = 50 } }\n[simulation]\nlaws = \"li2023\"\n";
    let model = model(&format!("{ROLLERS}row_stagger_deg = 0\n"), pit);
    let forces = force_over_cage_angle(&model, 0.0).unwrap();
    let pitch = TAU / 19.0;
    assert!(forces.len() > 200);
    close(forces.last().unwrap().cage_angle, pitch, 1e-12);
    let fall = |k: usize| [0, 1].map(|i| forces[k].damaged[i] - forces[k].healthy[i]);
    // The pit is in row 1: one of the two rollers above it loses all that its deformation gives.
    let k = series_stiffness(model.inner_contact.stiffness, model.outer_contact.stiffness, 10.0 / 9.0);
    let delta = at(&model, [300.0, 0.0]).displacement[0] - model.geometry.clearance;
    close(-fall(0)[0], k * delta.powf(10.0 / 9.0), 1e-3);
    // Half a pitch on, nothing is over it; a pitch on, the next roller.
    assert_eq!(fall(forces.len() / 2), [0.0; 2]);
    close(fall(forces.len() - 1)[0], fall(0)[0], 1e-9);
    let mean = forces.iter().map(|at| at.healthy[0]).sum::<f64>() / forces.len() as f64;
    close(mean, 300.0, 1e-2);
}

#[test]
fn prop_damage_that_turns_is_followed_over_its_own_turn() {
    let on = |on: &str| {
        let defect = format!(
            "[[defects]]\non = {on}\ndepth_um = 20\nshape = {{ circle = {{ diameter_mm = 1 }} }}\n[simulation]\nlaws = \"li2023\"\n"
        );
        let model = model("preset = \"6205\"\n", &defect);
        let forces = force_over_cage_angle(&model, 100.0).unwrap();
        // Where it is under load, and where it is not.
        let changed = forces.iter().filter(|at| at.damaged != at.healthy).count();
        assert!(changed > 0 && changed < forces.len(), "{on}: {changed} of {}", forces.len());
        (forces.last().unwrap().cage_angle, model.rolling_orbit_speed(1.0))
    };
    let (span, orbit) = on("\"inner-raceway\"");
    close(span, TAU * orbit, 1e-12);
    close(on("\"roller\"\nroller = 1").0, TAU, 1e-12);
}
