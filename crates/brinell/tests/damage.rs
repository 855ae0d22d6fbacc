//! Whole runs over damage under `ecl`: paths and shapes against each other, and what a run costs.

use crate::common::simulate;
use brinell::channel::{Frame, contact_length, contact_stiffness};
use brinell::defect::{Side, spall};
use brinell::model::{Model, Motion};
use brinell::observe::passes::Passes;
use brinell::scenario::{self, Accuracy, RollerPath, Scenario, Shape};
use brinell::simulate::{Observer, Simulation};
use brinell::solver::Stepper;

fn run_of(shape: Shape, path: RollerPath, duration_s: f64) -> Scenario {
    let mut s = crate::common::example();
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
    let mut healthy = run_of(rectangle(4.0), RollerPath::Point, 6e-3);
    healthy.defects.clear();
    let healthy = simulate(&healthy).0;
    for path in [RollerPath::Point, RollerPath::Envelope] {
        let none = run_of(rectangle(0.0), path, 6e-3);
        assert_eq!(simulate(&none).0.data, healthy.data, "{path:?}");
    }
}

/// Forces of models that are the same but for round-off differ by less than this share of the largest.
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
fn model_of(shape: &Shape, path: RollerPath) -> Model {
    let mut s = run_of(shape.clone(), path, 0.012);
    s.operation.load_ramp_s = 0.002;
    Model::new(&s).unwrap()
}

#[test]
fn prop_a_rectangle_drawn_as_an_outline_runs_the_same() {
    let corners = vec![[-1.5, -2.0], [1.5, -2.0], [1.5, 2.0], [-1.5, 2.0]];
    let drawn = Shape::Outline { polygons_mm: vec![corners] };
    for path in [RollerPath::Point, RollerPath::Envelope] {
        let models = [&drawn, &rectangle(4.0)].map(|shape| model_of(shape, path));
        let off = force_difference(&models, 0.012);
        println!("{path:?}: {off:.1e}");
        assert!(off < SAME, "{path:?}: {off:e}");
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
    let mut scenario = run_of(rectangle(4.0), RollerPath::Envelope, 0.06);
    scenario.defects[0].depth_um = 1.2;
    let (both, rows) = Both::of(&scenario);
    let found = both.passes.extremes(0).unwrap();
    assert_eq!((found.length, found.stiffness), (both.length, both.stiffness));
    assert!(both.last_event > 0.0 && both.last_event * scenario.simulation.sample_rate_hz <= (rows - 1) as f64);
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
/// The same damage as the rectangle's, scanned with relief at every node, and a spall of another outline.
#[test]
fn prop_a_detailed_depth_map_costs_little_more_than_a_rectangle() {
    let relief = |c: usize, r: usize| 1.0 + 0.1 * (0.9 * c as f64).sin() * (0.7 * r as f64).cos();
    let scan = map(301, 201, |c, r| 20.0 * relief(c, r));
    let spall = Shape::DepthMap { grid: spall(11, 3.0, 4.0, 0.6, 20.0) };
    for path in [RollerPath::Point, RollerPath::Envelope] {
        let work = |shape: &Shape| {
            let s = run_of(shape.clone(), path, 0.15);
            let clock = std::time::Instant::now();
            let work = simulate(&s).1.work.solver;
            (work.evaluations as f64, clock.elapsed().as_secs_f64())
        };
        let (plain, plain_s) = work(&rectangle(4.0));
        for (name, shape) in [("scan", &scan), ("spall", &spall)] {
            let (evaluations, seconds) = work(shape);
            println!(
                "{path:?} {name}: right-hand sides {plain} and {evaluations} ({:+.1} %), seconds {plain_s:.3} and {seconds:.3} ({:+.1} %)",
                100.0 * (evaluations / plain - 1.0),
                100.0 * (seconds / plain_s - 1.0)
            );
            assert!(evaluations <= 1.25 * plain, "{path:?} {name}");
        }
    }
}
