//! What must not matter: which way is up, where zero is, how often one looks, how many look at once.

use crate::common::cases::{Random, case, healthy, rectangle};
use crate::common::{Rows, simulate_rows};
use brinell::accuracy::settings;
use brinell::model::{Model, Motion};
use brinell::scenario::{Accuracy, Defect, Scenario, Shape, Speed, Start, Surface};
use brinell::solver::Stepper;
use brinell::start;
use std::f64::consts::TAU;

const SPAN_S: f64 = 5e-3;

/// States at every 0.1 ms. At `standard`, a step that round-off lets pass here and not there moves a run by as much as
/// the tolerance, and the comparison would be of tolerances.
fn trajectory(model: &Model, y: &[f64]) -> Vec<Vec<f64>> {
    let mut motion = Motion::new(model);
    let mut stepper = Stepper::new(&mut motion, settings(model, Accuracy::Reference), 0.0, y);
    let mut states = Vec::new();
    for k in 1..=(SPAN_S * 1e4) as u32 {
        let t = f64::from(k) * 1e-4;
        while stepper.t() < t {
            stepper.step(&mut motion).unwrap();
        }
        let mut state = y.to_vec();
        stepper.interpolate(t, &mut state);
        states.push(state);
    }
    states
}

/// Largest difference of two trajectories against the largest motion, both as mass-weighted speeds; pure rotation does
/// not count as motion.
fn difference(model: &Model, a: &[Vec<f64>], b: &[Vec<f64>]) -> f64 {
    let (mass, l) = (model.mass(), &model.layout);
    let dof = l.dof();
    let norm = |f: &dyn Fn(usize) -> f64| (0..dof).map(|k| mass[k] * f(k).powi(2)).sum::<f64>().sqrt();
    let mut worst = 0.0_f64;
    let mut motion = 0.0_f64;
    for (a, b) in a.iter().zip(b) {
        worst = worst.max(norm(&|k| a[dof + k] - b[dof + k]));
        motion = motion.max(norm(&|k| {
            if k < l.slots || k >= l.inner() { a[dof + k] } else { 0.0 }
        }));
    }
    worst / motion
}

/// How states and damage go over to a changed frame.
struct Change {
    /// Roller (from 0) that takes a roller's place.
    roller: Box<dyn Fn(usize) -> usize>,
    /// Of X and Y.
    vector: Box<dyn Fn([f64; 2]) -> [f64; 2]>,
    /// Sign of angles.
    sense: f64,
    /// Added to orbit angles of the rollers, which the wrap at a full turn may take back.
    orbit: f64,
    /// Added to spin angles.
    spin: f64,
    /// Added to the cages' angles.
    cage: f64,
    /// Added to the angles of damage on raceways.
    damage: f64,
}

impl Change {
    fn scenario(&self, s: &Scenario) -> Scenario {
        let mut s = s.clone();
        s.operation.load_n = (self.vector)(s.operation.load_n);
        s.operation.gravity_m_per_s2 = (self.vector)(s.operation.gravity_m_per_s2);
        s.bearing.row_stagger_deg *= self.sense;
        s.operation.speed_rpm = match s.operation.speed_rpm {
            Speed::Constant(rpm) => Speed::Constant(self.sense * rpm),
            Speed::Profile(points) => Speed::Profile(points.iter().map(|[t, rpm]| [*t, self.sense * rpm]).collect()),
        };
        for d in &mut s.defects {
            d.center_deg *= self.sense;
            match &mut d.on {
                Surface::Roller(k) => *k = (self.roller)(*k - 1) + 1,
                _ => d.center_deg += self.damage.to_degrees(),
            }
            if let (Shape::Profile { arc_mm, width_mm, depth_um }, true) = (&mut d.shape, self.sense < 0.0) {
                arc_mm.iter_mut().for_each(|a| *a = -*a);
                arc_mm.reverse();
                width_mm.reverse();
                depth_um.iter_mut().for_each(|d| d.reverse());
            }
        }
        s
    }

    fn state(&self, changed: &Model, y: &[f64]) -> Vec<f64> {
        let l = &changed.layout;
        let dof = l.dof();
        let mut out = vec![0.0; 2 * dof];
        for slot in 0..l.rollers() {
            let to = l.slot(l.row(slot), (self.roller)(l.roller(slot)));
            // Within half a turn of its pocket, which counts turns.
            let pocket = changed.pocket_angle[to] + self.sense * y[l.cage(l.row(slot)) + 2] + self.cage;
            let theta = self.sense * y[l.theta() + slot] + self.orbit;
            out[l.theta() + to] = theta + TAU * ((pocket - theta) / TAU).round();
            out[l.r() + to] = y[l.r() + slot];
            out[l.phi() + to] = self.sense * y[l.phi() + slot] + self.spin;
            out[dof + l.r() + to] = y[dof + l.r() + slot];
            out[dof + l.theta() + to] = self.sense * y[dof + l.theta() + slot];
            out[dof + l.phi() + to] = self.sense * y[dof + l.phi() + slot];
        }
        let mut vectors = vec![l.inner(), l.outer()];
        for row in 0..l.rows {
            let at = l.cage(row);
            out[at + 2] = self.sense * y[at + 2] + self.cage;
            out[dof + at + 2] = self.sense * y[dof + at + 2];
            vectors.push(at);
        }
        for at in vectors.into_iter().flat_map(|at| [at, dof + at]) {
            let turned = (self.vector)([y[at], y[at + 1]]);
            out[at..at + 2].copy_from_slice(&turned);
        }
        out
    }

    /// Holds the changed run against the run of the changed scenario.
    fn assert_holds(&self, name: &str, s: &Scenario) {
        let model = Model::new(s).unwrap();
        let changed = Model::new(&self.scenario(s)).unwrap();
        let y = start::state(&model).unwrap();
        let base = trajectory(&model, &y);
        let expected: Vec<Vec<f64>> = base.iter().map(|y| self.state(&changed, y)).collect();
        let found = trajectory(&changed, &self.state(&changed, &y));
        let deviation = difference(&changed, &expected, &found);
        // What round-off alone makes of this run: the same equations from a start that differs in the last bits.
        let round_off = (1..=3)
            .map(|seed| {
                let mut random = Random::new(seed);
                let nudge = |y: &f64| y * (1.0 + 4.0 * f64::EPSILON * random.signed());
                let nudged: Vec<f64> = y.iter().map(nudge).collect();
                difference(&model, &base, &trajectory(&model, &nudged))
            })
            .fold(0.0, f64::max);
        println!("{name}: {deviation:.1e}, round-off {round_off:.1e}");
        assert!(
            deviation < LARGEST && deviation < (100.0 * round_off).max(1e-10),
            "{name}: {deviation:e}, round-off {round_off:e}"
        );
    }
}

/// Impacts make round-off grow: from the drop of the `rolling` start, where every roller bounces, to 1e-2 of the motion
/// within 1 ms; from equilibrium to 1e-5 (NN3007) or 6e-4 (the single row under gravity) in 5 ms. Past this bound the
/// comparison with round-off would say nothing.
const LARGEST: f64 = 3e-3;

/// Damage on every surface, a load and gravity off the axes.
fn askew(base: Scenario) -> Scenario {
    let mut s = base;
    s.operation.load_n = [260.0, 150.0];
    s.operation.gravity_m_per_s2 = [1.0, -9.81];
    s.simulation.start = Start::Equilibrium;
    s.defects[0].center_deg = 24.0;
    s.defects[0].shape = Shape::Rectangle { length_mm: 3.0, width_mm: 4.0 };
    s.defects.push(Defect {
        on: Surface::InnerRaceway,
        row: s.bearing.rows,
        center_deg: 17.0,
        depth_um: 20.0,
        axial_offset_mm: 0.0,
        shape: Shape::Profile {
            arc_mm: vec![-1.2, -0.4, 0.6, 1.1],
            width_mm: vec![0.0, 4.0, 3.0, 0.0],
            depth_um: Some(vec![5.0, 12.0, 10.0, 4.0]),
        },
        table: None,
    });
    s.defects.push(Defect {
        on: Surface::Roller(3),
        row: 1,
        center_deg: 10.0,
        depth_um: 9.0,
        axial_offset_mm: 0.0,
        shape: Shape::Circle { diameter_mm: 2.0 },
        table: None,
    });
    s
}

#[test]
fn prop_mirrored_bearing_moves_mirrored() {
    for base in [rectangle(), case("xval/single-row-inner-guided"), case("xval/three-rows-drag-gap")] {
        let rollers = base.bearing.rollers_per_row;
        let mirror = Change {
            roller: Box::new(move |j| (rollers - j) % rollers),
            vector: Box::new(|[x, y]| [x, -y]),
            sense: -1.0,
            orbit: 0.0,
            spin: 0.0,
            cage: 0.0,
            damage: 0.0,
        };
        let s = askew(base);
        mirror.assert_holds(&s.name, &s);
        // The same with the load left as it was is another motion: the comparison can fail.
        let mut wrong = s.clone();
        wrong.operation.load_n[1] *= -1.0;
        let model = Model::new(&s).unwrap();
        let y = start::state(&model).unwrap();
        let other = trajectory(&Model::new(&wrong).unwrap(), &y);
        assert!(difference(&model, &trajectory(&model, &y), &other) > 0.1);
    }
}

fn turned(angle: f64) -> Box<dyn Fn([f64; 2]) -> [f64; 2]> {
    let (sin, cos) = angle.sin_cos();
    Box::new(move |[x, y]| [cos * x - sin * y, sin * x + cos * y])
}

#[test]
fn prop_turned_bearing_moves_turned() {
    let s = askew(rectangle());
    // By any angle, rollers and cages turned along.
    for degrees in [37.0_f64, 90.0, -135.0] {
        let angle = degrees.to_radians();
        let turn = Change {
            roller: Box::new(|j| j),
            vector: turned(angle),
            sense: 1.0,
            orbit: angle,
            spin: angle,
            cage: angle,
            damage: angle,
        };
        turn.assert_holds(&format!("by {degrees} degrees"), &s);
    }
}

#[test]
fn prop_bearing_turned_by_pitches_moves_turned() {
    // Pockets fall onto pockets: cages stay, each roller takes the place of the one ahead.
    let s = askew(rectangle());
    let rollers = s.bearing.rollers_per_row;
    for pitches in [1, 7] {
        let angle = TAU * pitches as f64 / rollers as f64;
        let turn = Change {
            roller: Box::new(move |j| (j + pitches) % rollers),
            vector: turned(angle),
            sense: 1.0,
            orbit: angle,
            spin: angle,
            cage: 0.0,
            damage: angle,
        };
        turn.assert_holds(&format!("by {pitches} pitches"), &s);
    }
}

fn same_bits(a: &Rows, b: &Rows) -> bool {
    a.names == b.names
        && a.data.len() == b.data.len()
        && a.data
            .iter()
            .zip(&b.data)
            .all(|(a, b)| a.len() == b.len() && a.iter().zip(b).all(|(x, y)| x.to_bits() == y.to_bits()))
}

/// Everything recorded.
fn all(mut s: Scenario, duration: f64) -> Scenario {
    s.simulation.duration_s = duration;
    s.simulation.record = vec!["*".into()];
    s
}

#[test]
fn prop_damage_of_no_width_is_healthy_to_the_bit() {
    let healthy = simulate_rows(&all(healthy(), 0.03));
    let shapes = [
        Shape::Rectangle { length_mm: 3.0, width_mm: 0.0 },
        Shape::Profile { arc_mm: vec![-2.0, 0.0, 2.0], width_mm: vec![0.0; 3], depth_um: Some(vec![1.0, 20.0, 1.0]) },
    ];
    for shape in shapes {
        let mut s = all(rectangle(), 0.03);
        s.defects[0].shape = shape;
        for on in [Surface::InnerRaceway, Surface::Roller(2)] {
            let mut another = s.defects[0].clone();
            another.on = on;
            s.defects.push(another);
        }
        assert!(same_bits(&healthy, &simulate_rows(&s)));
    }
    assert!(!same_bits(&healthy, &simulate_rows(&all(rectangle(), 0.03))), "damage shows");
}

#[test]
fn prop_same_scenario_same_bits_alone_and_beside_another() {
    let s = all(rectangle(), 0.02);
    let alone = simulate_rows(&s);
    assert!(same_bits(&alone, &simulate_rows(&s)));
    std::thread::scope(|scope| {
        let beside: Vec<_> = (0..2).map(|_| scope.spawn(|| simulate_rows(&s))).collect();
        for run in beside {
            assert!(same_bits(&alone, &run.join().unwrap()));
        }
    });
}

#[test]
fn prop_sample_rate_does_not_change_the_motion() {
    let sampled = |rate: f64| {
        let mut s = all(rectangle(), 0.02);
        s.simulation.sample_rate_hz = rate;
        simulate_rows(&s)
    };
    let base = sampled(25_600.0);
    // Common instants: every second sample, and every 64th (2.5 ms).
    for (rate, ours, theirs) in [(12_800.0, 2, 1), (10_000.0, 64, 25)] {
        let other = sampled(rate);
        let mut compared = 0;
        for (name, (a, b)) in base.names.iter().zip(base.data.iter().zip(&other.data)) {
            // The anti-alias filter follows the sample rate.
            if name.starts_with("sensor_") {
                continue;
            }
            for (a, b) in a.iter().step_by(ours).zip(b.iter().step_by(theirs)) {
                assert_eq!(a.to_bits(), b.to_bits(), "{name} at {rate} Hz");
                compared += 1;
            }
        }
        assert!(compared > 1000);
    }
}

#[test]
fn prop_duration_does_not_change_earlier_samples() {
    let (short, long) = (simulate_rows(&all(rectangle(), 0.01)), simulate_rows(&all(rectangle(), 0.017)));
    for (name, (a, b)) in short.names.iter().zip(short.data.iter().zip(&long.data)) {
        assert_eq!(a.len(), 257);
        for (k, (a, b)) in a.iter().zip(b).enumerate() {
            assert_eq!(a.to_bits(), b.to_bits(), "{name} at sample {k}");
        }
    }
}
