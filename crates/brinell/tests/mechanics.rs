//! The default laws (sections 18 to 24): exact geometry, half-space contacts by given tables, viscoelastic damping, oiled walls,
//! rolling resistance, waviness and housing.

use crate::common::cases::{case, random_state, rectangle};
use crate::common::simulate;
use brinell::defect::Side;
use brinell::model::{Energy, Model, Motion, imbalance};
use brinell::scenario::{ContactDamping, GeometryLaw, Pockets, RollerPath, Scenario, Shape, Start, Waviness};
use brinell::simulate::{End, Simulation};
use brinell::solver::System;
use brinell::start;
use brinell::statics::{Problem, solve};

/// The given cases with every body damaged or wavy that can be.
fn cases() -> Vec<(&'static str, Scenario)> {
    let mut wavy = case("reference/mechanics-rectangle");
    wavy.bearing.waviness = Some(Waviness { amplitude_um: 0.4, exponent: 1.2, waves: [2, 60] });
    wavy.bearing.element_waviness = Some(Waviness { amplitude_um: 0.1, exponent: 1.0, waves: [2, 20] });
    wavy.operation.gravity_m_per_s2 = [1.0, -9.81];
    wavy.lubricant.drag_coefficient = 1.0;
    wavy.lubricant.effective_density_kg_per_m3 = 50.0;
    let mut guided_inside = case("reference/mechanics-rectangle");
    guided_inside.cage.guidance = brinell::scenario::Guidance::InnerRing;
    guided_inside.defects[0].on = brinell::scenario::Surface::InnerRaceway;
    let mut two_surfaces = case("reference/mechanics-ball-outer");
    let mut on_ball = two_surfaces.defects[0].clone();
    on_ball.on = brinell::scenario::Surface::Roller(7);
    on_ball.center_deg = 10.0;
    two_surfaces.defects.push(on_ball);
    let mut slotted = case("reference/mechanics-ball-outer");
    slotted.cage.pockets = Pockets::Slot;
    slotted.contact.damping = ContactDamping::Constant { ns_per_m: 150.0 };
    let mut tilting_damaged = case("xval/mechanics-tilting");
    tilting_damaged.defects = case("reference/mechanics-rectangle").defects;
    tilting_damaged.defects[0].table = None;
    tilting_damaged.defects[0].axial_offset_mm = 1.0;
    tilting_damaged.defects[0].row = 2;
    vec![
        ("tilting-damaged", tilting_damaged),
        ("rectangle", case("reference/mechanics-rectangle")),
        ("ball", case("reference/mechanics-ball-outer")),
        ("healthy-roller", case("reference/mechanics-healthy-roller")),
        ("wavy", wavy),
        ("guided-inside", guided_inside),
        ("two-surfaces", two_surfaces),
        ("slotted", slotted),
        ("tilting", case("xval/mechanics-tilting")),
    ]
}

#[test]
fn lit_facts_of_exact_geometry() {
    // R_m = 24.5 mm, r = 3 mm, C_r = 10 um, w_i = 60 pi: section 18's numbers.
    let mut s = case("reference/mechanics-rectangle");
    s.defects.clear();
    s.operation.load_n = [0.0; 2];
    let model = Model::new(&s).unwrap();
    let l = &model.layout;
    let dof = l.dof();
    let mut y = brinell::start::state(&model).unwrap();
    y[l.inner()..l.inner() + 2].copy_from_slice(&[50e-6, 20e-6]);
    y[l.outer()..l.outer() + 2].copy_from_slice(&[-4e-6, 3e-6]);
    y[dof + l.inner()..][..2].copy_from_slice(&[1e-3, -2e-3]);
    y[dof + l.outer()..][..2].copy_from_slice(&[-0.5e-3, 0.4e-3]);
    let slot = l.slot(0, 3);
    y[l.r() + slot] = 5e-6;
    y[l.theta() + slot] = 0.3;
    y[dof + l.r() + slot] = 2e-3;
    y[dof + l.theta() + slot] = 82.7;
    y[dof + l.phi() + slot] = -675.0;
    let mut motion = Motion::new(&model);
    let mut dy = vec![0.0; y.len()];
    motion.derivative(0.0, &y, &mut dy);
    let at = |side: Side| {
        let c = &motion.ws.contacts[side as usize];
        [c.deformation[slot], c.approach_rate[slot], c.slip[slot], 0.3 + c.lean(slot), c.distance[slot]]
    };
    let [delta, rate, slip, alpha, rho] = at(Side::Inner);
    assert!((delta - 38.676_845_070e-6).abs() < 6e-16 && (rate + 1.276_376_417e-3).abs() < 6e-13);
    assert!((slip - 0.006_407_845).abs() < 6e-10 && (alpha - 0.299_822_884_044).abs() < 6e-13);
    let arm = 3e-3 - 0.5 * delta;
    assert!((rho - arm - 21.470_661_577e-3).abs() < 6e-13 && (arm - 2.980_661_577e-3).abs() < 6e-13);
    let [delta, rate, slip, alpha, rho] = at(Side::Outer);
    assert!((delta - 7.935_119_658e-6).abs() < 6e-16 && (rate - 2.024_810_681e-3).abs() < 6e-13);
    assert!((slip + 0.003_712_070).abs() < 6e-10 && (alpha - 0.299_834_825_321).abs() < 6e-13);
    let arm = 3e-3 - 0.5 * delta;
    assert!((rho + arm - 27.503_967_560e-3).abs() < 6e-13 && (arm - 2.996_032_440e-3).abs() < 6e-13);
}

/// A state in which contacts, pockets and lands are closed.
fn disturbed(model: &Model, seed: u64) -> Vec<f64> {
    random_state(model, seed)
}

#[test]
fn prop_linear_and_angular_momentum_change_by_external_forces_alone() {
    for (name, s) in cases() {
        let model = Model::new(&s).unwrap();
        for seed in 0..40 {
            let y = disturbed(&model, seed);
            let mut motion = Motion::new(&model);
            let mut dy = vec![0.0; y.len()];
            motion.derivative(0.011, &y, &mut dy);
            let a = &mut dy[model.layout.dof()..];
            let own = imbalance(&model, 0.011, &y, a, &motion.ws).unwrap();
            // Round-off of some 500 additions.
            assert!(own < 1e-13, "{name}: {own:e}");
            if model.tilt.is_some() {
                // Torques about the axis are audited in the plane alone.
                continue;
            }
            // The audit sees a torque that has no reaction.
            let phi = model.layout.phi();
            a[phi] += 1e3;
            let seen = imbalance(&model, 0.011, &y, a, &motion.ws).unwrap();
            assert!(seen > 1e-12, "{name}: a lost torque left {seen:e}");
        }
    }
}

#[test]
fn prop_moving_all_bodies_by_one_vector_changes_no_force() {
    for (name, mut s) in cases() {
        // What is held outside does feel it.
        s.support.inner_stiffness_n_per_m = 0.0;
        s.support.outer_stiffness_n_per_m = 0.0;
        let model = Model::new(&s).unwrap();
        let l = &model.layout;
        let y = disturbed(&model, 3);
        let by = [3e-6, -5e-6];
        let mut moved = y.clone();
        for at in [l.inner(), l.outer()].into_iter().chain((0..l.rows).map(|row| l.cage(row))) {
            moved[at] += by[0];
            moved[at + 1] += by[1];
        }
        let (pitch, dof) = (model.geometry.pitch_radius, l.dof());
        for slot in 0..l.rollers() {
            let (r, theta) = (pitch + y[l.r() + slot], y[l.theta() + slot]);
            let x = [r * theta.cos() + by[0], r * theta.sin() + by[1]];
            let turned = (x[1] * theta.cos() - x[0] * theta.sin()).atan2(x[0] * theta.cos() + x[1] * theta.sin());
            let (dr, along) = (y[dof + l.r() + slot], r * y[dof + l.theta() + slot]);
            let new = x[0].hypot(x[1]);
            moved[l.r() + slot] = new - pitch;
            moved[l.theta() + slot] = theta + turned;
            moved[dof + l.r() + slot] = dr * turned.cos() + along * turned.sin();
            moved[dof + l.theta() + slot] = (along * turned.cos() - dr * turned.sin()) / new;
        }
        let forces = |y: &[f64]| {
            let mut motion = Motion::new(&model);
            let mut dy = vec![0.0; y.len()];
            motion.derivative(0.011, y, &mut dy);
            let contacts = motion.ws.contacts.iter().flat_map(|c| c.force.to_vec());
            let pockets = motion.ws.pocket_force.to_vec();
            contacts.chain(pockets).chain(dy[dof + l.inner()..][..4].to_vec()).collect::<Vec<f64>>()
        };
        let (before, after) = (forces(&y), forces(&moved));
        let largest = before.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        for (k, (a, b)) in before.iter().zip(&after).enumerate() {
            // Places are known to some 1e-17 m, which stiff contacts turn into 1e-8 N.
            assert!((a - b).abs() < 1e-9 * largest, "{name}: {k}: {a} became {b}");
        }
    }
}

#[test]
fn prop_power_of_every_flow_is_the_change_of_energy() {
    for (name, s) in cases() {
        let model = Model::new(&s).unwrap();
        let dof = model.layout.dof();
        for seed in 0..20 {
            let (t, y) = (0.011, disturbed(&model, 100 + seed));
            let mut motion = Motion::new(&model);
            let mut dy = vec![0.0; y.len()];
            motion.derivative(t, &y, &mut dy);
            let power = motion.ws.power;
            let h = 1e-9;
            let mut energy = |by: f64| {
                // To second order, so that the difference is right to h^2.
                let mut moved = y.clone();
                for k in 0..dof {
                    moved[k] += by * y[dof + k] + 0.5 * by * by * dy[dof + k];
                    moved[dof + k] += by * dy[dof + k];
                }
                let mut scratch = vec![0.0; y.len()];
                motion.derivative(t + by, &moved, &mut scratch);
                Energy::of(&model, t + by, &moved, &motion.ws).total()
            };
            let rate = (energy(h) - energy(-h)) / (2.0 * h);
            let net = power.net();
            let scale = power.dissipated().abs() + power.drive.abs() + power.load.abs() + power.film.abs() + 1.0;
            // Energies of some J are known to 1e-16 of them, over 2e-9 s.
            assert!((rate - net).abs() < 2e-5 * scale, "{name} {seed}: {rate} W, flows {net} W: {power:?}");
        }
    }
}

#[test]
fn prop_energy_of_runs_closes() {
    for (name, mut s) in cases() {
        s.simulation.duration_s = 0.01;
        s.simulation.accuracy = brinell::scenario::Accuracy::Reference;
        // Cases made in code may hold what no file does, such as a roughness beside a damper of its own.
        let simulation = Simulation::unchecked(&s).unwrap();
        let mut signals = brinell::simulate::Signals::new(&simulation).unwrap();
        let outcome = simulation.run(&mut signals);
        assert_eq!(outcome.end, End::Complete, "{name}");
        let turnover = outcome.energy.turnover();
        let open = outcome.energy.residual().abs();
        println!("{name}: {open:.1e} J of {turnover:.1e} J");
        assert!(open < 1e-5 * turnover, "{name}: {open:e} J of {turnover:e} J");
        assert_eq!(outcome.energy.parametric, 0.0);
        assert_eq!(outcome.energy.flows.lever, 0.0);
    }
}

#[test]
fn lit_restitution_of_a_free_element() {
    // Section 20: a free element against a fixed raceway at 1, 5 and 20 cm/s.
    for (stiffness, exponent, mass, expected) in [
        (2.68371e10, 1.5, 0.002_057, [0.88, 0.76, 0.64]),
        (8.54e8, 10.0 / 9.0, 0.0013, [0.86, 0.64, 0.45]),
        (1.898e8, 10.0 / 9.0, 0.0013, [0.88, 0.72, 0.60]),
    ] {
        let law = brinell::contact::LoadDeflection {
            stiffness,
            exponent: brinell::elementary::Exponent::new(exponent),
            damping: brinell::contact::Damping::Time { tau: 2.5e-6, roughness: 1e-7 },
            across: None,
        };
        for (speed, expected) in [0.01, 0.05, 0.2].into_iter().zip(expected) {
            let acceleration = |x: f64, v: f64| {
                let elastic = law.healthy(x);
                -brinell::contact::damped(elastic, law.damper(elastic, x), v) / mass
            };
            let (mut x, mut v, h) = (0.0, speed, 1e-8);
            loop {
                let (k1, l1) = (v, acceleration(x, v));
                let (k2, l2) = (v + 0.5 * h * l1, acceleration(x + 0.5 * h * k1, v + 0.5 * h * l1));
                let (k3, l3) = (v + 0.5 * h * l2, acceleration(x + 0.5 * h * k2, v + 0.5 * h * l2));
                let (k4, l4) = (v + h * l3, acceleration(x + h * k3, v + h * l3));
                x += h * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
                v += h * (l1 + 2.0 * l2 + 2.0 * l3 + l4) / 6.0;
                if x <= 0.0 {
                    break;
                }
            }
            let restitution = -v / speed;
            assert!((restitution - expected).abs() < 0.0051, "{stiffness:e} {speed}: {restitution}");
        }
    }
}

#[test]
fn prop_two_accuracies_agree_where_forces_are_smooth() {
    // Section 26: smooth forces make a trajectory well-posed.
    let mut s = case("reference/mechanics-ball-outer");
    s.simulation.duration_s = 0.01;
    let (tight, _) = simulate(&s);
    s.simulation.accuracy = brinell::scenario::Accuracy::Standard;
    let (standard, _) = simulate(&s);
    // Found with three kernels alike: 1.7e-2 and 4.6e-6. It is what `standard` leaves of the ring's ringing after the drop of the first 5 ms, whose phase
    // its steps shift; later 3e-3 to 7e-3 is left.
    for (name, limit) in [("outer_ay", 2.5e-2), ("outer_y", 2e-5)] {
        let (a, b) = (tight.column(name), standard.column(name));
        let from = a.len() / 10;
        let norm = |of: &dyn Fn(usize) -> f64| (from..a.len()).map(|k| of(k).powi(2)).sum::<f64>().sqrt();
        let off = norm(&|k| a[k] - b[k]) / norm(&|k| a[k]);
        println!("{name}, standard against reference: {off:.1e}");
        assert!(off < limit, "{name}: {off:e}");
    }
}

/// Under `ecl` nothing pushes along the surface, so seen from displaced centres its forces have no potential: a balance all the same.
#[test]
fn prop_a_balance_over_deep_damage_under_ecl_in_exact_geometry_leaves_no_force() {
    for (depth_um, length_mm) in [(20.0, 3.0), (500.0, 3.0), (500.0, 5.0), (2000.0, 5.0)] {
        for center_deg in [0.0, 7.3] {
            let mut s = rectangle();
            s.simulation.start = Start::Equilibrium;
            s.simulation.geometry = GeometryLaw::Exact;
            s.contact.roller_path = RollerPath::Envelope;
            s.friction.raceway_coefficient = 0.0;
            s.defects[0].depth_um = depth_um;
            s.defects[0].center_deg = center_deg;
            s.defects[0].shape = Shape::Rectangle { length_mm, width_mm: 6.0 };
            let model = Model::new(&s).unwrap();
            let b = solve(&model, &Problem::at_start(&model)).unwrap();
            // The forces of the motion there, all bodies held: no dampers and no film.
            let mut y = start::state(&model).unwrap();
            let mut motion = Motion::new(&model);
            let mut dy = vec![0.0; motion.size()];
            let l = &model.layout;
            y[l.dof()..].fill(0.0);
            motion.derivative(s.operation.load_ramp_s, &y, &mut dy);
            let a = &dy[l.dof()..];
            let [inner, outer] = [(l.inner(), model.inertia.inner_ring), (l.outer(), model.inertia.outer_ring)]
                .map(|(at, m)| m * a[at].hypot(a[at + 1]));
            // 1e-7 of the load is the solver's, and 1e-10 m along a wall of slope 0.7 changes a force by 0.02 N.
            assert!(inner.max(outer) < 0.02, "{depth_um} um, {length_mm} mm, {center_deg} deg: {inner} and {outer} N");
            assert!(b.residual < 1e-7 * 600.0);
        }
    }
}
