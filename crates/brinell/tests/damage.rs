//! Whole runs over damage: laws and paths against each other, the energy audit, and what a run costs.

use crate::common::{Rows, simulate};
use brinell::channel::{Frame, contact_length, contact_stiffness};
use brinell::defect::{Side, spall};
use brinell::model::{Model, Motion};
use brinell::observe::passes::Passes;
use brinell::scenario::{self, Accuracy, Defect, EdgeReaction, Law, RollerPath, Scenario, Shape, Surface};
use brinell::simulate::{Observer, Simulation};
use brinell::solver::Stepper;

fn run_of(shape: Shape, law: Law, path: RollerPath, duration_s: f64) -> Scenario {
    let mut s = crate::common::example();
    s.contact.law = law;
    s.contact.roller_path = path;
    s.simulation.duration_s = duration_s;
    s.simulation.record = vec!["outer_*".into(), "inner_*".into()];
    s.defects[0].shape = shape;
    s
}

fn rectangle(width_mm: f64) -> Shape {
    Shape::Rectangle { length_mm: 3.0, width_mm }
}

#[test]
fn prop_no_width_is_the_healthy_bearing_to_the_bit() {
    let mut healthy = run_of(rectangle(4.0), Law::Ecl, RollerPath::Point, 6e-3);
    healthy.defects.clear();
    let healthy = simulate(&healthy).0;
    for law in [Law::Ecl, Law::Sliced] {
        for path in [RollerPath::Point, RollerPath::Envelope] {
            let mut none = run_of(rectangle(0.0), law, path, 6e-3);
            // An odd number has a slice in the very middle.
            none.contact.slices = 31;
            assert_eq!(simulate(&none).0.data, healthy.data, "{law:?} {path:?}");
        }
    }
}

/// Forces of models that are the same but for round-off differ by less than this share of the largest: some hundred
/// additions (30 slices).
const SAME: f64 = 1e-12;

/// Largest difference of a contact force or an acceleration between two models at the same states, over the largest of
/// its kind; the states are those of a run of the first. Two runs would not do: impacts amplify the round-off of either
/// until it hides what is compared.
fn force_difference(models: &[Model; 2], until: f64) -> f64 {
    let mut motions = models.each_ref().map(Motion::new);
    let y = brinell::start::state(&models[0]).unwrap();
    let settings = brinell::accuracy::settings(&models[0], Accuracy::Standard);
    let mut stepper = Stepper::new(&mut motions[0], settings, 0.0, &y);
    let mut rates = [vec![0.0; y.len()], vec![0.0; y.len()]];
    let (mut worst, mut on_damage): (f64, usize) = (0.0, 0);
    while stepper.t() < until {
        stepper.step(&mut motions[0]).unwrap();
        for (motion, rate) in motions.iter_mut().zip(&mut rates) {
            motion.derivative(stepper.t(), stepper.y(), rate);
        }
        let contacts = motions.each_ref().map(|m| &m.ws.contacts[Side::Outer as usize]);
        assert_eq!(contacts[0].on_damage, contacts[1].on_damage);
        on_damage += contacts[0].on_damage.iter().filter(|on| **on).count();
        let largest = contacts[0].force.iter().fold(0.0, |m: f64, q| m.max(q.abs()));
        for (a, b) in contacts[0].force.iter().zip(contacts[1].force.iter()) {
            worst = worst.max((a - b).abs() / largest);
        }
        let size = rates[0].iter().fold(0.0, |m: f64, a| m.max(a.abs()));
        for (a, b) in rates[0].iter().zip(&rates[1]) {
            worst = worst.max((a - b).abs() / size);
        }
    }
    assert!(on_damage > 100, "{on_damage} contacts on damage");
    worst
}

/// The bearing with this damage.
fn model_of(shape: &Shape, law: Law, path: RollerPath) -> Model {
    let mut s = run_of(shape.clone(), law, path, 0.012);
    s.operation.load_ramp_s = 0.002;
    Model::new(&s).unwrap()
}

#[test]
fn prop_a_rectangle_drawn_as_an_outline_runs_the_same() {
    let corners = vec![[-1.5, -2.0], [1.5, -2.0], [1.5, 2.0], [-1.5, 2.0]];
    let drawn = Shape::Outline { polygons_mm: vec![corners] };
    for law in [Law::Ecl, Law::Sliced] {
        for path in [RollerPath::Point, RollerPath::Envelope] {
            let models = [&drawn, &rectangle(4.0)].map(|shape| model_of(shape, law, path));
            let off = force_difference(&models, 0.012);
            println!("{law:?} {path:?}: {off:.1e}");
            // Slices along the envelope are fitted to 1e-9 of the depth in the outline, and closed forms in the
            // rectangle.
            let most = if (law, path) == (Law::Sliced, RollerPath::Envelope) { 1e-6 } else { SAME };
            assert!(off < most, "{law:?} {path:?}: {off:e}");
        }
    }
}

#[test]
fn prop_full_width_damage_runs_the_same_in_both_laws() {
    for path in [RollerPath::Point, RollerPath::Envelope] {
        let models = [Law::Ecl, Law::Sliced].map(|law| model_of(&rectangle(6.0), law, path));
        let off = force_difference(&models, 0.012);
        println!("{path:?}: {off:.1e}");
        assert!(off < SAME, "{path:?}: {off:e}");
    }
}

#[test]
fn analytic_a_run_from_equilibrium_on_sliced_damage_starts_as_quietly_as_a_healthy_one() {
    for seed in [1, 2, 3] {
        let spall = Shape::Random { seed, length_mm: 6.0, width_mm: 5.0, roughness: 0.5 };
        let mut s = run_of(spall, Law::Sliced, RollerPath::Envelope, 1e-3);
        s.simulation.start = scenario::Start::Equilibrium;
        s.defects[0].depth_um = 8.0;
        let rows = simulate(&s).0;
        // The orbit's dampers and friction are no part of a static balance: the healthy bearing has their push too.
        s.defects.clear();
        let healthy = simulate(&s).0;
        let push = |rows: &Rows| ["outer_ax", "outer_ay", "inner_ax", "inner_ay"].map(|name| rows.column(name)[0]);
        for (a, b) in push(&rows).into_iter().zip(push(&healthy)) {
            assert!((a - b).abs() < 1.0, "seed {seed}: {a} and {b} m/s^2");
        }
    }
}

fn on(surface: Surface, shape: Shape) -> Defect {
    Defect { on: surface, row: 1, center_deg: 0.0, depth_um: 12.0, axial_offset_mm: 0.0, shape, table: None }
}

/// Energy that no entry explains, the parametric work and the turnover, J.
fn audit(defects: Vec<Defect>, edge_reaction: EdgeReaction) -> [f64; 4] {
    let mut s = run_of(rectangle(4.0), Law::Sliced, RollerPath::Envelope, 0.06);
    s.contact.edge_reaction = edge_reaction;
    // Several defects along an envelope are searched slice by slice: fewer slices, less to wait for.
    s.contact.slices = 3;
    s.operation.load_ramp_s = 0.005;
    s.simulation.accuracy = Accuracy::Reference;
    s.defects = defects;
    let outcome = simulate(&s).1;
    let e = outcome.energy;
    [e.residual(), e.parametric, e.turnover(), outcome.momentum_imbalance.unwrap()]
}

#[test]
fn analytic_conservative_edges_close_the_energy_audit_on_every_surface() {
    let cases = [
        ("outer", vec![on(Surface::OuterRaceway, rectangle(4.0))]),
        ("inner", vec![on(Surface::InnerRaceway, rectangle(4.0))]),
        ("roller", vec![on(Surface::Roller(1), rectangle(4.0))]),
        (
            // Without a depth map: a map covers cell by cell, so that a slice's covered share, and with it the mean
            // depth of what is covered, jumps from one column to the next. The energy then is not continuous (3.5 % of
            // a contact's force at 10 slices).
            "overlap",
            vec![
                on(Surface::OuterRaceway, rectangle(4.0)),
                on(Surface::OuterRaceway, Shape::Circle { diameter_mm: 4.5 }),
                on(Surface::InnerRaceway, rectangle(2.0)),
            ],
        ),
    ];
    for (name, defects) in cases {
        let [paper, parametric, _, _] = audit(defects.clone(), EdgeReaction::None);
        let [closed, none, turnover, momentum] = audit(defects, EdgeReaction::Conservative);
        println!(
            "{name}: residual {closed:.2e} J, parametric before {parametric:.2e} J (residual {paper:.2e}), turnover {turnover:.2e} J, momentum {momentum:.1e}"
        );
        assert_eq!(none, 0.0);
        assert!(parametric.abs() > 1e-6, "{name}: nothing to close");
        assert!(closed.abs() < 2e-2 * parametric.abs(), "{name}");
        assert!(momentum < 1e-12, "{name}: momentum {momentum:e}");
    }
}

/// Passes, and what the contacts on damage themselves say at every step.
struct Both {
    passes: Passes,
    length: f64,
    stiffness: f64,
    last_event: f64,
}

impl Both {
    fn of(scenario: &Scenario) -> (Self, u64) {
        let simulation = Simulation::new(scenario).unwrap();
        let passes = Passes::new(simulation.model());
        let mut both = Both { passes, length: f64::INFINITY, stiffness: f64::INFINITY, last_event: 0.0 };
        let outcome = simulation.run(&mut both);
        (both, outcome.rows)
    }
}

impl Observer for Both {
    fn step(&mut self, f: &Frame) {
        self.passes.take(f, true, true);
        let contacts = &f.ws.contacts[Side::Outer as usize];
        for slot in (0..f.model.layout.rollers()).filter(|slot| contacts.on_damage[*slot]) {
            self.length = self.length.min(contact_length(f.model, f.ws, Side::Outer, slot));
            self.stiffness = self.stiffness.min(contact_stiffness(f.model, f.ws, Side::Outer, slot));
        }
        self.last_event = self.passes.events.back().map_or(0.0, |event| event.t);
    }
}

#[test]
fn prop_extremes_of_a_defect_are_of_all_its_passes_and_nothing_happens_after_the_last_sample() {
    // Loads that pass 1 um only in part, so that passes differ.
    let mut scenario = run_of(rectangle(4.0), Law::Sliced, RollerPath::Envelope, 0.06);
    scenario.defects[0].depth_um = 1.2;
    let (both, rows) = Both::of(&scenario);
    let found = both.passes.extremes(0).unwrap();
    assert_eq!((found.length, found.stiffness), (both.length, both.stiffness));
    assert!(both.last_event > 0.0 && both.last_event * scenario.simulation.sample_rate_hz <= (rows - 1) as f64);
}

#[test]
fn analytic_a_contact_that_only_a_ridge_closes_touches_along_the_ridge() {
    // The full width, and half of it.
    for (half_width, share) in [(4.0, 1.0), (1.5, 0.5)] {
        let grid = scenario::DepthGrid {
            s0_mm: -1.0,
            z0_mm: -half_width,
            ds_mm: 2.0,
            dz_mm: 2.0 * half_width,
            columns: 2,
            rows: 2,
            depth_um: vec![-40.0; 4],
        };
        let mut scenario = run_of(Shape::DepthMap { grid }, Law::Sliced, RollerPath::Point, 0.03);
        // Opposite to the load nothing else touches.
        scenario.defects[0].center_deg = 180.0;
        let (both, _) = Both::of(&scenario);
        let length = scenario.bearing.roller_length_mm * 1e-3;
        assert!((both.length / (share * length) - 1.0).abs() < 1e-9, "{} of {length}", both.length);
        assert!((both.stiffness / (share * scenario.contact.outer_stiffness) - 1.0).abs() < 1e-9);
    }
}

/// A map of the given nodes over 3 x 4 mm.
fn map(columns: usize, rows: usize, depth: impl Fn(usize, usize) -> f64) -> Shape {
    let grid = scenario::DepthGrid {
        s0_mm: -1.5,
        z0_mm: -2.0,
        ds_mm: 3.0 / (columns - 1) as f64,
        dz_mm: 4.0 / (rows - 1) as f64,
        columns,
        rows,
        depth_um: (0..columns * rows).map(|k| depth(k % columns, k / columns)).collect(),
    };
    Shape::DepthMap { grid }
}

/// Right-hand sides counted, which noise cannot touch; times are printed beside them.
///
/// The same damage as the rectangle's, scanned with relief at every node, costs what the rectangle costs. A spall of
/// another outline is another excitation: along the envelope it stays within the same bound, at a point every node of
/// its ragged border makes the force fall within a few micrometres.
#[test]
fn prop_a_detailed_depth_map_costs_little_more_than_a_rectangle() {
    let relief = |c: usize, r: usize| 1.0 + 0.1 * (0.9 * c as f64).sin() * (0.7 * r as f64).cos();
    let scan = map(301, 201, |c, r| 20.0 * relief(c, r));
    let spall = Shape::DepthMap { grid: spall(11, 3.0, 4.0, 0.6, 20.0) };
    for (law, path, spall_bound) in [
        (Law::Ecl, RollerPath::Point, 1.25),
        (Law::Ecl, RollerPath::Envelope, 1.25),
        (Law::Sliced, RollerPath::Point, 1.75),
        (Law::Sliced, RollerPath::Envelope, 1.25),
    ] {
        let work = |shape: &Shape| {
            let s = run_of(shape.clone(), law, path, 0.15);
            let clock = std::time::Instant::now();
            let work = simulate(&s).1.work.solver;
            (work.evaluations as f64, clock.elapsed().as_secs_f64())
        };
        let (plain, plain_s) = work(&rectangle(4.0));
        for (name, shape, bound) in [("scan", &scan, 1.25), ("spall", &spall, spall_bound)] {
            let (evaluations, seconds) = work(shape);
            println!(
                "{law:?} {path:?} {name}: right-hand sides {plain} and {evaluations} ({:+.1} %), seconds {plain_s:.3} and {seconds:.3} ({:+.1} %)",
                100.0 * (evaluations / plain - 1.0),
                100.0 * (seconds / plain_s - 1.0)
            );
            assert!(evaluations <= bound * plain, "{law:?} {path:?} {name}");
        }
    }
}
