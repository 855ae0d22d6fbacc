//! Bearings in a machine, section 25.

use brinell::accuracy::settings;
use brinell::machine::{
    Disc, Housing, HousingMode, Linear, Machine, MachineMotion, Material, Mode, OnShaft, Part, Plan, PlanError, Point,
    Shaft, Spring, Structure,
};
use brinell::model::{Model, Motion, Power, Support};
use brinell::scenario::{Accuracy, LoadOn, Scenario, Speed, Start};
use brinell::simulate::{End, Recording, Signals, Simulation};
use brinell::solver::{Settings, Stepper, System};
use brinell::start;
use brinell_shaft::{Beam, reduce};
use std::f64::consts::{FRAC_PI_2, PI};

const STEEL: Material = Material { youngs_modulus: 211e9, shear_modulus: 81.2e9, density: 7810.0 };
const LENGTH: f64 = 0.4;
/// Seats.
const AT: [f64; 2] = [0.1, 0.3];

/// A shaft of 30 mm with a disc of 2 kg in the middle under `load`, out of balance, on two bearings, whose outer rings are on their own supports
/// or both in a rigid housing.
fn plan(scenarios: [&Scenario; 2], (is_rigid, in_housing): (bool, bool), load: [f64; 2], unbalance: f64) -> Plan {
    let part = Part { length: LENGTH, outer_diameter: 0.03, inner_diameter: 0.0 };
    let middle = 0.5 * LENGTH;
    let shaft = Shaft {
        material: STEEL,
        discs: vec![Disc { at: middle, mass: 2.0, diametral_inertia: 3e-3, polar_inertia: 5e-3 }],
        loads: vec![(middle, load)],
        unbalances: vec![(middle, unbalance, 0.3)],
        looked_at: vec![("1".into(), middle)],
        is_rigid,
        ..Shaft::of_steel(vec![part])
    };
    let housing = Housing {
        at: middle,
        mass: 6.0,
        inertia: 0.05,
        support: Support { stiffness: 1.1e8, damping: 1500.0 },
        tilt_support: Support { stiffness: 1.1e6, damping: 15.0 },
        modes: Vec::new(),
        sensors: [("sensor1", AT[0]), ("sensor2", AT[1])].map(|(name, z)| (name.into(), z, FRAC_PI_2)).into(),
    };
    let model = |k: usize| Model::new(scenarios[k]).unwrap();
    let bearings = [0, 1].map(|k: usize| OnShaft::new(model(k), AT[k], in_housing.then_some(0)));
    Plan { shaft, bearings: bearings.into(), housings: in_housing.then_some(housing).into_iter().collect() }
}

fn on_two(scenarios: [&Scenario; 2], how: (bool, bool), load: [f64; 2], unbalance: f64) -> Machine {
    plan(scenarios, how, load, unbalance).machine().unwrap()
}

/// Mass of that shaft with its disc and inner rings, kg.
fn mass(s: &Scenario) -> f64 {
    STEEL.density * LENGTH * PI * 0.03_f64.powi(2) / 4.0 + 2.0 + 2.0 * s.bearing.inner_ring_mass_kg
}

/// A bearing whose load comes from the shaft.
fn of(preset: &str, model: &str) -> Scenario {
    let text = format!(
        "[bearing]\npreset = \"{preset}\"\n[operation]\nspeed_rpm = 1800\nload_n = [0, -1]\nload_on = \"inner-ring\"\ngravity_m_per_s2 = [0, -9.81]\n[support]\ninner_stiffness_n_per_m = 0\ninner_damping_ns_per_m = 0\nouter_stiffness_n_per_m = 5e7\nouter_damping_ns_per_m = 500\n[simulation]\nmodel = \"{model}\"\n"
    );
    let mut s = Scenario::from_toml(&text).unwrap_or_else(|e| panic!("{e:?}"));
    s.operation.load_n = [0.0; 2];
    s
}

fn rectangle_on(s: &Scenario) -> Scenario {
    let mut s = s.clone();
    s.defects = crate::common::cases::rectangle().defects;
    s.defects[0].center_deg = -90.0;
    s
}

/// Steps to `t`, and the sum of the flows.
fn run<S: System<Flow = Power>>(system: &mut S, settings: Settings, y: &[f64], t: f64) -> (Stepper<Power>, Power) {
    let mut stepper = Stepper::new(system, settings, 0.0, y);
    let mut flows = Power::default();
    while stepper.t() < t {
        flows += stepper.step(system).unwrap();
    }
    (stepper, flows)
}

/// One bearing with half the shaft on its inner ring is either of two under a rigid shaft.
#[test]
fn analytic_two_bearings_under_a_rigid_shaft_are_one_under_half_the_load() {
    let s = of("6205", "full");
    let machine = on_two([&s, &s], (true, false), [300.0, -800.0], 0.0);
    let mut half = s.clone();
    half.operation.load_n = [150.0, -400.0];
    half.operation.load_on = LoadOn::InnerRing;
    half.bearing.inner_ring_mass_kg = 0.5 * mass(&s);
    let model = Model::new(&half).unwrap();
    let t = 0.02;
    // Steps of one length, below the limit of both: a step of another length has another error.
    let equal = |of: Settings| Settings { tolerance: 1e9, max_step: 5e-7, ..of };
    let (one, _) =
        run(&mut Motion::new(&model), equal(settings(&model, Accuracy::Standard)), &start::state(&model).unwrap(), t);
    let mut motion = MachineMotion::new(&machine);
    let (two, _) = run(&mut motion, equal(machine.settings(Accuracy::Standard)), &machine.initial().unwrap(), t);
    assert_eq!(one.work(), two.work());
    let (mut of_one, mut of_two) = (vec![0.0; 2 * model.layout.dof()], vec![0.0; 2 * machine.dof()]);
    one.interpolate(t, &mut of_one);
    two.interpolate(t, &mut of_two);
    for k in 0..2 {
        let first = machine.bearing(k);
        for ring in [model.layout.inner(), model.layout.outer()] {
            for at in [ring, ring + 1] {
                let (one, two) = (of_one[at], of_two[first + at]);
                assert!((one - two).abs() < 1e-9 * of_one[model.layout.inner() + 1].abs(), "{k}: {one:e}, {two:e}");
            }
        }
    }
}

/// Energy and momentum of an elastic shaft with unbalance on a damaged and a healthy bearing.
#[test]
fn analytic_energy_and_momentum_of_a_machine_close() {
    let healthy = of("6205", "full");
    let damaged = rectangle_on(&healthy);
    let rollers = of("NU206", "tilting");
    for (pair, in_housing) in
        [([&damaged, &healthy], false), ([&healthy, &damaged], true), ([&rollers, &rollers], true)]
    {
        let machine = on_two(pair, (false, in_housing), [0.0, -900.0], 2e-5);
        let mut motion = MachineMotion::new(&machine);
        let y = machine.initial().unwrap();
        let dof = machine.dof();
        let mut a = vec![0.0; dof];
        motion.accelerations(0.0, &y, &mut a);
        let before = machine.energy(0.0, &y, &motion.parts);
        let (stepper, flows) = run(&mut motion, machine.settings(Accuracy::Reference), &y, 0.04);
        let (t, y) = (stepper.t(), stepper.y().to_vec());
        motion.accelerations(t, &y, &mut a);
        let after = machine.energy(t, &y, &motion.parts);
        let turnover = flows.load.abs() + flows.drive.abs() + flows.dissipated();
        let left = after.total() - before.total() - flows.net();
        assert!(left.abs() < 1e-5 * turnover, "{left:e} of {turnover:e}");
        let imbalance = machine.imbalance((t, &y, &a), &motion.parts).unwrap();
        assert!(imbalance < 1e-12, "{imbalance:e}");
    }
}

/// A run of a machine: what its sensors see of damage in one bearing.
#[test]
fn prop_damage_at_one_end_is_heard_at_both_and_more_there() {
    let healthy = of("6205", "full");
    let damaged = rectangle_on(&healthy);
    let recording = Recording {
        duration_s: 0.4,
        sample_rate_hz: 25600.0,
        record: vec!["housing1.*".into(), "shaft.y*".into(), "bearing2.outer_ay".into()],
        accuracy: Accuracy::Standard,
        most_steps: 1e7,
        settled_s: 0.1,
    };
    let levels = |scenarios: [&Scenario; 2]| {
        let simulation =
            Simulation::of_machine(on_two(scenarios, (false, true), [0.0, -900.0], 2e-6), &recording).unwrap();
        let names: Vec<&str> = simulation.table().map(|(name, ..)| name).collect();
        assert_eq!(names, ["bearing2.outer_ay", "shaft.y1", "housing1.sensor1", "housing1.sensor2"]);
        let mut signals = Signals::new(&simulation).unwrap();
        let outcome = simulation.run(&mut signals);
        assert_eq!((outcome.end, outcome.rows), (End::Complete, 10241));
        assert!(outcome.energy.left_open().is_none(), "{:?}", outcome.energy.relative_residual());
        assert!(outcome.momentum_imbalance.unwrap() < 1e-11);
        // The housing is rigid: its ring follows it, and the sensor sits there.
        let [ring, sag, near, far] = ["bearing2.outer_ay", "shaft.y1", "housing1.sensor1", "housing1.sensor2"]
            .map(|name| signals.get(name).unwrap()[2560..].to_vec());
        assert!(sag.iter().all(|y| (-1e-3..0.0).contains(y)));
        assert!(ring.iter().zip(&far).map(|(a, b)| (a - b).powi(2)).sum::<f64>() < far.iter().map(|a| a * a).sum());
        [rms(&near), rms(&far)]
    };
    let (quiet, loud) = (levels([&healthy, &healthy]), levels([&damaged, &healthy]));
    assert!(loud[1] > 10.0 * quiet[1] && loud[0] > 1.5 * loud[1], "{quiet:?} {loud:?}");
    assert!((quiet[0] / quiet[1] - 1.0).abs() < 0.05, "{quiet:?}");
}

fn rms(x: &[f64]) -> f64 {
    (x.iter().map(|x| x * x).sum::<f64>() / x.len() as f64).sqrt()
}

/// `validation/shaft/figures.py`: a shaft with two discs on springs alone, from rest, out of balance.
#[test]
fn xval_a_shaft_moves_as_in_another_rotor_program() {
    let part = |length, outer_diameter, inner_diameter| Part { length, outer_diameter, inner_diameter };
    let discs = [(0.5, 0.28), (1.0, 0.35)]
        .map(|(at, diameter)| Disc::of_cylinder(at, &part(0.07, diameter, 0.05), STEEL.density));
    let springs = [0.0, 1.5].map(|at| Spring { at, radial: 1e6, tilt: 0.0 });
    let beam = Beam::new(&STEEL, &[part(1.5, 0.05, 0.0)], (&discs, &springs), &[], 0.25).unwrap();
    let reduced = reduce(&beam, 1e5, &[], 0.0, false).unwrap();
    let seat = |z: f64| {
        let [shift, tilt] = [beam.port(z), beam.tilt_port(z)].map(|port| reduced.port(&port.unwrap()));
        Structure::seat_of_shaft(&shift, &tilt)
    };
    let mut structure = Structure::shaft(&beam, &reduced);
    structure.add_unbalance(&seat(0.5), 1e-3, 0.3);
    let looked_at = [0.0, 0.5, 1.0].into_iter().flat_map(|z| seat(z).shift);
    let points = looked_at.map(|row| Point { name: "shaft".into(), is_sensor: false, structure: 0, row });
    // A bearing that holds nothing has to be there.
    let mut beside = of("6205", "full");
    beside.operation.speed_rpm = Speed::Constant(2400.0);
    beside.operation.gravity_m_per_s2 = [0.0; 2];
    let own = Model::new(&beside).unwrap();
    let first = own.layout.dof();
    let machine = Machine::new(vec![(own, [None, None])], vec![structure], points.collect());
    let mut y = machine.initial().unwrap();
    let dof = machine.dof();
    y[first..dof].fill(0.0);
    y[dof + first..].fill(0.0);
    let settings = Settings { tolerance: 1e9, max_step: 1e-6, ..machine.settings(Accuracy::Standard) };
    let mut motion = MachineMotion::new(&machine);
    let mut stepper = Stepper::new(&mut motion, settings, 0.0, &y);
    for (t, expected) in [
        (0.02, [-3.068721656e-5, -2.512329333e-5, -3.107042799e-5, 1.071775243e-5, -8.882730195e-6, 5.633681329e-5]),
        (0.05, [7.849651069e-5, -4.548536317e-5, 5.126414721e-5, -5.247684010e-5, -4.093392887e-5, -1.935947473e-5]),
        (0.1, [8.822347524e-5, 6.473605896e-5, 4.149419664e-5, 5.255333201e-5, -6.971163008e-5, -1.071720447e-5]),
    ] {
        while stepper.t() < t {
            stepper.step(&mut motion).unwrap();
        }
        stepper.interpolate(t, &mut y);
        for (k, expected) in expected.into_iter().enumerate() {
            let found = y[machine.point(k)];
            // Theirs takes the force as straight lines of 10 us.
            assert!((found - expected).abs() < 1e-8, "{t} s, {k}: {found:e} is not {expected:e}");
        }
    }
}

/// Half the load and weight each; the slope of a beam that its middle presses on, F L^2/(16 E I), on either side.
#[test]
fn analytic_two_bearings_share_the_load_of_a_bent_shaft() {
    for model in ["full", "tilting"] {
        let mut s = of(if model == "full" { "6205" } else { "NU206" }, model);
        s.simulation.start = Start::Equilibrium;
        let load = 9000.0;
        let machine = on_two([&s, &s], (false, true), [0.0, -load], 0.0);
        let balance = machine.balance().unwrap();
        let half = 0.5 * (load + 9.81 * mass(&s));
        let slope = load * (AT[1] - AT[0]).powi(2) / (16.0 * STEEL.youngs_modulus * PI / 64.0 * 0.03_f64.powi(4));
        for (k, carried) in balance.bearings.iter().enumerate() {
            let own =
                machine.bearings[k].model.layout.rollers() as f64 * machine.bearings[k].model.inertia.roller * 9.81;
            assert!((carried.force[1] + half).abs() < own, "{carried:?}, {half}");
            assert!(carried.force[0].abs() < 1e-3 * half);
            let bent = if k == 0 { -carried.misalignment[1] } else { carried.misalignment[1] };
            match model {
                // Of the shaft's weight 2 kg and its ends are not where the load is.
                "full" => assert!((bent / slope - 1.0).abs() < 0.01, "{bent:e} is not {slope:e}"),
                // Rollers hold it.
                _ => {
                    assert!(bent > 0.3 * slope && bent < slope && carried.moment[1].abs() > 1.0, "{bent:e} {carried:?}")
                }
            }
        }
        // There it stays: what is left is what rolling and the cage do.
        let (mut motion, y) = (MachineMotion::new(&machine), machine.initial().unwrap());
        let mut a = vec![0.0; machine.dof()];
        motion.accelerations(0.0, &y, &mut a);
        let shaft = &a[machine.bearings.iter().map(|of| of.model.layout.dof()).sum::<usize>()..machine.point(0)];
        let left = shaft.iter().fold(0.0_f64, |most, a| most.max(a.abs()));
        assert!(left < 0.02 * load, "{left}");
    }
}

#[test]
fn prop_a_plan_that_holds_nothing_is_refused() {
    let s = of("6205", "full");
    let sound = plan([&s, &s], (false, true), [0.0, -100.0], 0.0);
    let refused = |change: &dyn Fn(&mut Plan)| {
        let mut plan = sound.clone();
        change(&mut plan);
        plan.machine().unwrap_err().to_string()
    };
    assert_eq!(
        refused(&|plan| plan.bearings[1].at = 0.5),
        "something sits at Z = 0.5 m, beyond the shaft, which reaches from 0 to 0.4 m"
    );
    assert_eq!(
        refused(&|plan| drop(plan.bearings.pop())),
        "a shaft on one bearing needs a coupling, or it turns about it"
    );
    assert_eq!(refused(&|plan| plan.bearings.clear()), PlanError::NoBearing.to_string());
    assert_eq!(
        refused(&|plan| plan.bearings[1].housing = Some(1)),
        "bearing 2 sits in housing 2, of which there are 1"
    );
    assert_eq!(refused(&|plan| plan.housings[0].mass = 0.0), "a housing's mass, kg = 0: must be above 0");
    let mut coupled = sound;
    coupled.bearings.pop();
    coupled.shaft.couplings.push(Spring { at: 0.0, radial: 1e6, tilt: 1e3 });
    assert!(coupled.machine().unwrap().balance().is_ok());
}

/// Springs between outer rings and the housing, of which one is out of line.
#[test]
fn analytic_a_fit_gives_way_as_its_spring_does_and_a_stiff_one_not_at_all() {
    let s = of("6205", "full");
    let made = |stiffness: Option<f64>, offset: [f64; 2]| {
        let mut plan = plan([&s, &s], (false, true), [0.0, -900.0], 2e-5);
        for bearing in &mut plan.bearings {
            bearing.fit = stiffness.map(|stiffness| Support { stiffness, damping: 300.0 });
        }
        plan.bearings[0].offset = offset;
        plan.machine().unwrap()
    };
    let sag = |machine: &Machine, k: usize| {
        let balance = machine.balance().unwrap();
        let at = machine.bearing(k) + machine.bearings[k].model.layout.outer() + 1;
        (balance.positions[at], balance.bearings[k].force[1])
    };
    let rigid = made(None, [0.0; 2]);
    for k in 0..2 {
        let (at, _) = sag(&rigid, k);
        let (stiff, _) = sag(&made(Some(1e12), [0.0; 2]), k);
        assert!((stiff - at).abs() < 1e-9, "{stiff:e}, {at:e}");
        let soft = made(Some(1e7), [0.0; 2]);
        let (lower, force) = sag(&soft, k);
        // With the weight of the ring and of what rolls.
        let ring = soft.bearings[k].model.inertia.outer_ring * 9.81;
        assert!((at - lower - (ring - force) / 1e7).abs() < 0.3e-7, "{lower:e}, {at:e}, {force}");
    }
    // A seat that is 20 um higher carries more of the load, by a rigid or a soft fit.
    let lifted = made(Some(1e8), [0.0, 20e-6]);
    let (_, level) = sag(&made(Some(1e8), [0.0; 2]), 0);
    assert!(sag(&lifted, 0).0 > sag(&made(Some(1e8), [0.0; 2]), 0).0 + 10e-6);
    assert!((sag(&lifted, 0).1 - level).abs() < 50.0, "two bearings share a load whatever their height");
    for machine in [lifted, made(None, [0.0, 20e-6])] {
        let recording = Recording {
            duration_s: 0.05,
            sample_rate_hz: 12_000.0,
            record: vec!["bearing1.outer_ay".into()],
            accuracy: Accuracy::Standard,
            most_steps: 1e7,
            settled_s: 0.02,
        };
        let outcome = Simulation::of_machine(machine, &recording).unwrap().run(&mut ());
        assert!(outcome.energy.relative_residual().unwrap().abs() < 1e-4, "{:?}", outcome.energy);
        assert!(outcome.momentum_imbalance.unwrap() < 1e-9, "{:?}", outcome.momentum_imbalance);
    }
}

/// Natural frequencies of a machine with linear bearings: a rigid shaft in a rigid housing, by hand.
#[test]
fn analytic_a_rigid_shaft_in_a_rigid_housing_has_the_frequencies_of_two_masses() {
    let s = of("6205", "full");
    let machine = plan([&s, &s], (true, true), [0.0, -900.0], 0.0).machine().unwrap();
    let (equations, ports) = machine.linearised();
    let (k, c) = (5e7, 0.0);
    let bearings: Vec<Linear> = (ports.into_iter())
        .map(|port| Linear { port, stiffness: [[k, 0.0], [0.0, k]], damping: [[c, 0.0], [0.0, c]] })
        .collect();
    let modes = equations.modes(&bearings, 0.0);
    // Up and down: the shaft on two springs on a housing on its own.
    let (m, big) = (mass(&s), 6.0 + 2.0 * machine.bearings[0].model.inertia.outer_ring);
    let (a, b) = (2.0 * k / m, (2.0 * k + 1.1e8) / big);
    let root = ((a - b).powi(2) + 4.0 * (2.0 * k).powi(2) / (m * big)).sqrt();
    for square in [0.5 * (a + b - root), 0.5 * (a + b + root)] {
        let wanted = square.sqrt() / std::f64::consts::TAU;
        // The housing has a damper.
        let undamped = |mode: &Mode| mode.frequency / (1.0 - mode.damping_ratio.powi(2)).sqrt();
        let near = modes.iter().any(|mode| (undamped(mode) / wanted - 1.0).abs() < 1e-3);
        assert!(near, "{wanted} among {modes:?}");
    }
}

/// A housing that can only shift: as a rigid body that tilts do not move, and as two modes of the same mass.
#[test]
fn analytic_a_rigid_body_is_two_modes_and_rings_add_to_their_mass() {
    let mut s = of("6205", "full");
    // What a housing of modes weighs is not known.
    s.operation.gravity_m_per_s2 = [0.0; 2];
    s.simulation.start = Start::Equilibrium;
    let made = |by_modes: bool| {
        let mut plan = plan([&s, &s], (false, true), [0.0, -900.0], 5e-5);
        let housing = &mut plan.housings[0];
        let (mass, Support { stiffness, damping }) = (housing.mass, housing.support);
        housing.tilt_support.stiffness = 1e9;
        housing.inertia = 1e3;
        if by_modes {
            let frequency = (stiffness / mass).sqrt();
            let share = mass.sqrt().recip();
            let mode = |axis: usize| HousingMode {
                frequency,
                damping_ratio: damping / (2.0 * mass * frequency),
                seats: vec![if axis == 0 { [share, 0.0] } else { [0.0, share] }; 2],
                sensors: vec![if axis == 0 { 0.0 } else { share }; 2],
            };
            housing.modes = vec![mode(0), mode(1)];
        }
        plan.machine().unwrap()
    };
    let [body, modes] = [false, true].map(made);
    let t = 0.01;
    let steps = |machine: &Machine| {
        let settings = Settings { tolerance: 1e9, max_step: 5e-7, ..machine.settings(Accuracy::Standard) };
        let mut motion = MachineMotion::new(machine);
        let (stepper, _) = run(&mut motion, settings, &machine.initial().unwrap(), t);
        let mut y = vec![0.0; 2 * machine.dof()];
        stepper.interpolate(t, &mut y);
        let point = |k: usize| y[machine.point(k)];
        let ring = |k: usize| y[machine.bearing(k) + machine.bearings[k].model.layout.outer() + 1];
        [point(1), point(2), point(3), ring(0), ring(1)]
    };
    for (a, b) in steps(&body).into_iter().zip(steps(&modes)) {
        assert!((a - b).abs() < 1e-5 * a.abs().max(1e-6), "{a:e} {b:e}");
    }
    let sag = |machine: &Machine| machine.balance().unwrap().positions[machine.bearing(0)..].to_vec();
    let at = body.bearings[0].model.layout.outer() + 1;
    assert!((sag(&body)[at] - sag(&modes)[at]).abs() < 1e-9, "{:e} {:e}", sag(&body)[at], sag(&modes)[at]);
    assert!(matches!(refused_modes(&s), PlanError::Modes { housing: 1, seats: 2, sensors: 2 }));
}

fn refused_modes(s: &Scenario) -> PlanError {
    let mut plan = plan([s, s], (false, true), [0.0, -900.0], 0.0);
    plan.housings[0].modes =
        vec![HousingMode { frequency: 1e3, damping_ratio: 0.1, seats: vec![[1.0, 0.0]], sensors: Vec::new() }];
    plan.machine().unwrap_err()
}
