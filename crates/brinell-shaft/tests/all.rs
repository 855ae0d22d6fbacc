//! The shaft against formulas and another rotor program.

use brinell_shaft::*;
use std::f64::consts::{PI, TAU};

const STEEL: Material = Material { youngs_modulus: 211e9, shear_modulus: 81.2e9, density: 7810.0 };

/// 1.5 m x 50 mm in six elements, with discs at 0.5 and 1.0 m.
fn two_discs() -> Beam {
    let part = Part { length: 1.5, outer_diameter: 0.05, inner_diameter: 0.0 };
    Beam::new(&STEEL, &[part], (&of_two(), &[]), &[], 0.25).unwrap()
}

fn isotropic(port: Port, stiffness: f64, damping: f64) -> Linear {
    Linear { port, stiffness: [[stiffness, 0.0], [0.0, stiffness]], damping: [[damping, 0.0], [0.0, damping]] }
}

fn at_both_ends(beam: &Beam) -> Vec<Linear> {
    [0.0, 1.5].map(|z| isotropic(beam.port(z).unwrap(), 1e6, 100.0)).into()
}

fn frequencies(modes: &[Mode]) -> Vec<f64> {
    modes.iter().map(|mode| mode.frequency).collect()
}

fn close(found: &[f64], expected: &[f64], relative: f64) {
    for (found, expected) in found.iter().zip(expected) {
        assert!((found / expected - 1.0).abs() < relative, "{found} is not {expected}");
    }
    assert!(found.len() >= expected.len());
}

/// ROSS 2.3.0, to all digits that are given.
#[test]
fn xval_two_discs_have_the_frequencies_of_another_program() {
    let beam = two_discs();
    let bearings = at_both_ends(&beam);
    let at_rest = frequencies(&beam.equations.modes(&bearings, 0.0));
    let each: Vec<f64> = at_rest.iter().copied().step_by(2).collect();
    close(&each, &[13.79217, 43.66055, 114.08034], 1e-6);
    let at_speed = beam.equations.modes(&bearings, 4000.0 / 60.0 * TAU);
    close(&frequencies(&at_speed), &[13.59026, 13.97325, 40.07430, 46.90813, 95.52661], 1e-6);
    use Whirl::{Backward, Forward};
    let ways: Vec<Whirl> = at_speed[..4].iter().map(|mode| mode.whirl).collect();
    assert_eq!(ways, [Backward, Forward, Backward, Forward]);
}

/// The same shaft, hollow, on two unequal bearings of which one is not symmetric.
fn on_unequal(inner_diameter: f64) -> (Beam, Vec<Linear>) {
    let part = Part { length: 1.5, outer_diameter: 0.05, inner_diameter };
    let beam = Beam::new(&STEEL, &[part], (&of_two(), &[]), &[], 0.25).unwrap();
    let bearings = vec![
        Linear {
            port: beam.port(0.0).unwrap(),
            stiffness: [[1e6, 0.1e6], [-0.05e6, 0.7e6]],
            damping: [[100.0, 0.0], [0.0, 150.0]],
        },
        Linear {
            port: beam.port(1.5).unwrap(),
            stiffness: [[2e7, 0.0], [0.0, 1.5e7]],
            damping: [[300.0, 0.0], [0.0, 300.0]],
        },
    ];
    (beam, bearings)
}

/// `validation/shaft/figures.py`; frequencies of bending alone.
#[test]
fn xval_unequal_bearings_under_a_hollow_shaft() {
    let (beam, bearings) = on_unequal(0.03);
    let modes = beam.equations.modes(&bearings, 4000.0 / 60.0 * TAU);
    close(&frequencies(&modes), &[14.218250, 15.317813, 48.937391, 54.500341, 120.323071], 1e-6);
    let ratios: Vec<f64> = modes.iter().map(|mode| mode.damping_ratio).collect();
    close(&ratios, &[1.083992e-2, -7.129067e-3, 2.235023e-2, -4.473714e-3, 2.229141e-2], 1e-5);
    let unbalances = [(beam.port(0.5).unwrap(), 0.001, 0.3), (beam.port(1.0).unwrap(), 0.002, 1.7)];
    let response = beam.equations.unbalance_response(&bearings, 700.0 / 60.0 * TAU, &unbalances).unwrap();
    let (x, y) = (response[4], response[beam.equations.size() + 4]);
    close(&[x.re, x.im], &[1.033172787e-5, 3.616788024e-5], 1e-6);
    close(&[y.re, y.im], &[4.479920976e-5, -1.664259050e-5], 1e-6);
}

/// `validation/shaft/figures.py`.
#[test]
fn xval_critical_speeds_are_those_of_another_program() {
    let beam = two_discs();
    let speeds = beam.equations.critical_speeds(&at_both_ends(&beam));
    let (speeds, ways): (Vec<f64>, Vec<Whirl>) = speeds.into_iter().unzip();
    // Theirs are of damped bearings.
    close(&speeds, &[86.408589, 86.905048, 260.538243, 288.646718, 563.405838], 2e-4);
    use Whirl::{Backward, Forward};
    assert_eq!(ways[..5], [Backward, Forward, Backward, Forward, Backward]);
}

/// Modes with residual vectors against the full model; the second are what a force at a bearing yields of all others.
#[test]
fn analytic_few_modes_and_residual_vectors_say_what_all_say() {
    let part = Part { length: 1.5, outer_diameter: 0.05, inner_diameter: 0.0 };
    let places = [0.0, 1.5];
    let full = two_discs();
    assert_eq!(full, Beam::new(&STEEL, &[part], (&of_two(), &[]), &places, 0.25).unwrap());
    let ports = places.map(|z| full.port(z).unwrap());
    let reduced = reduce(&full, 0.0, &ports, 0.0, false).unwrap();

    assert_eq!(reduced.frequencies[..2], [0.0, 0.0]);
    assert_eq!(reduced.frequencies.len(), 8);
    // An order below a loaded element's 40 kHz, which set the step.
    assert!(reduced.frequencies[7] / TAU < 4600.0);
    let w = 4000.0 / 60.0 * TAU;
    let of = |equations: &Equations, ports: Vec<Port>, w: f64| {
        let bearings: Vec<_> = ports.into_iter().map(|port| isotropic(port, 1e6, 100.0)).collect();
        frequencies(&equations.modes(&bearings, w))
    };
    for speed in [0.0, w] {
        let exact = of(&full.equations, ports.to_vec(), speed);
        let few = of(&reduced.equations, ports.iter().map(|port| reduced.port(port)).collect(), speed);
        close(&few[..4], &exact[..4], 1e-3);
    }
    // Modes alone are a thousand times as far off.
    let alone = reduce(&full, 0.0, &[], 0.0, false).unwrap();
    let at_rest = |equations: &Equations, ports: Vec<Port>| of(equations, ports, 0.0)[4];
    let exact = at_rest(&full.equations, ports.to_vec());
    let error =
        |of: &Reduced| (at_rest(&of.equations, ports.iter().map(|port| of.port(port)).collect()) / exact - 1.0).abs();
    assert!(error(&alone) > 1000.0 * error(&reduced));
}

fn of_two() -> [Disc; 2] {
    [(0.5, 0.28), (1.0, 0.35)].map(|(at, diameter)| {
        let body = Part { length: 0.07, outer_diameter: diameter, inner_diameter: 0.05 };
        Disc::of_cylinder(at, &body, STEEL.density)
    })
}

/// f_1 = 4.7300^2/(2 pi L^2) sqrt(E I/(rho A)) of a slender free beam, and 7.8532 for the second.
#[test]
fn analytic_a_slender_free_beam() {
    let part = Part { length: 2.0, outer_diameter: 0.01, inner_diameter: 0.0 };
    let beam = Beam::new(&STEEL, &[part], (&[], &[]), &[], 0.05).unwrap();
    let reduced = reduce(&beam, 500.0, &[], 0.0, false).unwrap();
    let speed = (STEEL.youngs_modulus / STEEL.density).sqrt() * 0.01 / 4.0;
    let expected = [4.730041_f64, 7.853205].map(|root| root * root / 4.0 * speed);
    close(&reduced.frequencies[2..4], &expected, 2e-4);
    close(&[beam.mass(), beam.centre()], &[STEEL.density * PI * 0.25e-4 * 2.0, 1.0], 1e-12);
}

/// A rigid shaft on two equal springs: it bounces at sqrt(2 k/m), and tilts at w where 2 k a^2 = w^2 (J - I_p) when it turns with it.
#[test]
fn analytic_critical_speeds_of_a_rigid_shaft() {
    let part = Part { length: 0.4, outer_diameter: 0.04, inner_diameter: 0.0 };
    let disc = Disc { at: 0.2, mass: 5.0, diametral_inertia: 0.02, polar_inertia: 0.01 };
    let places = [0.05, 0.35];
    let beam = Beam::new(&STEEL, &[part], (&[disc], &[]), &places, 0.05).unwrap();
    let reduced = reduce(&beam, 1e3, &[], 0.0, true).unwrap();
    assert_eq!(reduced.frequencies, [0.0, 0.0]);
    let bearings = places.map(|z| isotropic(reduced.port(&beam.port(z).unwrap()), 1e6, 0.0));
    let mass = STEEL.density * PI * 0.4e-3 * 0.4;
    let diametral = 0.02 + mass * (3.0 * 4e-4 + 0.16) / 12.0;
    let polar = 0.01 + 0.5 * mass * 4e-4;
    let expected = [(2e6 / (mass + 5.0)).sqrt(), (2e6 * 0.15_f64.powi(2) / (diametral - polar)).sqrt()];
    let speeds = reduced.equations.critical_speeds(&bearings);
    let forward: Vec<f64> = speeds.iter().filter(|(_, whirl)| *whirl == Whirl::Forward).map(|(w, _)| *w).collect();
    close(&forward[forward.len() - 1..], &expected[1..], 1e-9);
    close(&[speeds[0].0, speeds[2].0], &[expected[0], (2e6 * 0.15_f64.powi(2) / (diametral + polar)).sqrt()], 1e-9);
    assert_eq!(speeds[2].1, Whirl::Backward);
}

#[test]
fn analytic_springs_to_the_ground_and_rigid_motions() {
    let part = Part { length: 0.5, outer_diameter: 0.03, inner_diameter: 0.01 };
    let spring = Spring { at: 0.5, radial: 2e6, tilt: 0.0 };
    let beam = Beam::new(&STEEL, &[part], (&[], &[spring]), &[], 0.02).unwrap();
    let reduced = reduce(&beam, 1000.0, &[], 0.0, false).unwrap();
    // It swings about that end, and one rigid motion is left.
    assert_eq!(reduced.frequencies.iter().filter(|w| **w == 0.0).count(), 1);
    assert!(Beam::new(&STEEL, &[part], (&[], &[Spring { at: 0.6, ..spring }]), &[], 0.02).is_none());
}
