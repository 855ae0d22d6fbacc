//! Measured orders of the integrator: of the state, of its dense output and of the flows integrated along with it.
//!
//! Steps are fixed by a tolerance that refuses nothing and a longest step. The first five grow to it from a thousandth,
//! by a factor of five each: that is the same share of a step at every step size, and leaves the order alone.

use crate::common::cases::rectangle;
use brinell::model::{Energy, Model, Motion};
use brinell::scenario::Accuracy;
use brinell::solver::{Settings, Stepper, System};
use brinell::{accuracy, start};

/// Order of the pair.
const ORDER: f64 = 3.0;
/// How near a measured order must come.
const NEAR: f64 = 0.1;

fn fixed(step: f64, mass: Vec<f64>) -> Settings {
    Settings { tolerance: f64::MAX, mass, max_step: step }
}

/// Orders between consecutive halvings of the step.
fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect()
}

fn assert_order(what: &str, errors: &[f64], order: f64, near: f64) {
    let measured = orders(errors);
    println!("{what}: errors {errors:?}, orders {measured:.3?}");
    for m in &measured {
        assert!((m - order).abs() <= near, "{what}: order {m:.3}, not {order}; errors {errors:?}");
    }
}

/// Two oscillators with elementary solutions: Ermakov's x'' = 1/x^3 - x from x = 2 at rest, and z'' = 2 cos t^2 - 4 t^2
/// z, whose solution sin t^2 is reached only with the right nodes. Along with them, the integral of 1/x^2.
struct Oscillators {
    flow: f64,
}

impl Oscillators {
    /// (x, z, x', z').
    fn solution(t: f64) -> [f64; 4] {
        let (s, c) = t.sin_cos();
        let x = (4.0 * c * c + 0.25 * s * s).sqrt();
        let (zs, zc) = (t * t).sin_cos();
        [x, zs, -3.75 * s * c / x, 2.0 * t * zc]
    }

    /// Integral of 1/x^2 from 0.
    fn integral(t: f64) -> f64 {
        let turns = (t / std::f64::consts::PI).round();
        turns * std::f64::consts::PI + (0.25 * t.tan()).atan()
    }
}

impl System for Oscillators {
    type Flow = f64;

    fn size(&self) -> usize {
        4
    }

    fn accelerations(&mut self, t: f64, y: &[f64], a: &mut [f64]) {
        a[0] = y[0].powi(-3) - y[0];
        a[1] = 2.0 * (t * t).cos() - 4.0 * t * t * y[1];
        self.flow = 1.0 / (y[0] * y[0]);
    }

    fn flow(&self) -> f64 {
        self.flow
    }
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// Points within a step where its dense output is looked at.
const WITHIN: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];

#[test]
fn analytic_order_of_state_dense_output_and_flow() {
    const END: f64 = 3.0;
    let mut errors = [Vec::new(), Vec::new(), Vec::new()];
    for steps in [400, 800, 1600, 3200] {
        let mut system = Oscillators { flow: 0.0 };
        let settings = fixed(END / f64::from(steps), vec![1.0; 2]);
        let first = Oscillators::solution(0.0);
        let mut stepper = Stepper::new(&mut system, settings, 0.0, &first);
        let mut worst = [0.0f64; 3];
        let mut integral = 0.0;
        let mut y = [0.0; 4];
        while stepper.t() < END {
            integral += stepper.step(&mut system).unwrap();
            let (from, t) = (stepper.t_previous(), stepper.t());
            worst[0] = worst[0].max(distance(stepper.y(), &Oscillators::solution(t)));
            for s in WITHIN {
                let t = from + s * (t - from);
                stepper.interpolate(t, &mut y);
                worst[1] = worst[1].max(distance(&y, &Oscillators::solution(t)));
            }
            worst[2] = worst[2].max((integral - Oscillators::integral(t)).abs());
        }
        assert_eq!(stepper.work().rejections, 0);
        for (errors, worst) in errors.iter_mut().zip(worst) {
            errors.push(worst);
        }
    }
    assert_order("state", &errors[0], ORDER, NEAR);
    assert_order("dense output", &errors[1], ORDER, NEAR);
    assert_order("flow", &errors[2], ORDER, NEAR);
}

/// One step from the exact state leaves h^4 in the state, and dense output adds no larger error of its own.
#[test]
fn analytic_order_of_one_step() {
    let mut errors = [Vec::new(), Vec::new()];
    for halvings in 0..5 {
        let h = 0.02 * 0.5f64.powi(halvings);
        let mut worst = [0.0f64; 2];
        for k in 0..20 {
            let t0 = 0.15 * f64::from(k);
            let mut system = Oscillators { flow: 0.0 };
            // The first step is a thousandth of the longest.
            let settings = fixed(1e3 * h, vec![1.0; 2]);
            let mut stepper = Stepper::new(&mut system, settings, t0, &Oscillators::solution(t0));
            stepper.step(&mut system).unwrap();
            let t1 = stepper.t();
            assert!((t1 - t0 - h).abs() < 1e-12);
            worst[0] = worst[0].max(distance(stepper.y(), &Oscillators::solution(t1)));
            let mut y = [0.0; 4];
            for s in WITHIN {
                stepper.interpolate(t0 + s * h, &mut y);
                worst[1] = worst[1].max(distance(&y, &Oscillators::solution(t0 + s * h)));
            }
        }
        errors[0].push(worst[0]);
        errors[1].push(worst[1]);
    }
    assert_order("state, one step", &errors[0], ORDER + 1.0, NEAR);
    assert_order("dense output, one step", &errors[1], ORDER + 1.0, NEAR);
}

/// Which forces act.
#[derive(PartialEq, Clone)]
struct Acting {
    closed: Vec<bool>,
    pocket: Vec<i8>,
    on_damage: Vec<bool>,
}

impl Acting {
    fn of(motion: &Motion) -> Self {
        let ws = &motion.ws;
        let contacts = || ws.contacts.iter();
        let sign = |f: &f64| i8::from(*f > 0.0) - i8::from(*f < 0.0);
        Self {
            closed: contacts().flat_map(|c| c.force.iter().map(|f| *f > 0.0)).collect(),
            pocket: ws.pocket_force.iter().map(sign).collect(),
            on_damage: contacts().flat_map(|c| c.on_damage.iter().copied()).collect(),
        }
    }
}

/// Share of a stretch left out at each of its ends. A contact that has just closed or is about to open is near delta =
/// 0, where delta^(10/9) is not smooth, and no step is short enough there for an order to show.
const MARGIN: f64 = 0.1;

/// The longest stretch between two switches, no roller on damage, without its margins; and the state at its start.
fn quiet_stretch(model: &Model, from: f64, to: f64) -> (f64, f64, Vec<f64>) {
    let mut motion = Motion::new(model);
    let settings = accuracy::settings(model, Accuracy::Reference);
    let initial = start::state(model).unwrap();
    let mut stepper = Stepper::new(&mut motion, settings.clone(), 0.0, &initial);
    while stepper.t() < from {
        stepper.step(&mut motion).unwrap();
    }
    let mut best = (0.0, 0.0, initial);
    let mut acting = Acting::of(&motion);
    let mut since = (stepper.t(), stepper.y().to_vec());
    while stepper.t() < to {
        let last = stepper.t();
        stepper.step(&mut motion).unwrap();
        let now = Acting::of(&motion);
        if now != acting {
            if !acting.on_damage.contains(&true) && last - since.0 > best.1 - best.0 {
                best = (since.0, last, since.1);
            }
            since = (stepper.t(), stepper.y().to_vec());
            acting = now;
        }
    }
    let (from, to, first) = best;
    let margin = MARGIN * (to - from);
    let mut stepper = Stepper::new(&mut motion, settings, from, &first);
    while stepper.t() < from + margin {
        stepper.step(&mut motion).unwrap();
    }
    (stepper.t(), to - margin, stepper.y().to_vec())
}

/// The longest step, s: the fastest contact decays in about as long.
const LONGEST: f64 = 3.2e-6;
/// Halvings of it that are compared, the first included; after a fifth the error, 1e-13, is near round-off.
const LEVELS: i32 = 4;
/// Of these, the ones whose audit is well above its round-off, about 5e-16 J.
const AUDITED: usize = 3;

/// Between two switches the bearing is smooth, and the order is the method's there: against steps eight times as short
/// as the shortest, and against the energy audit, which needs no other solution.
#[test]
fn analytic_order_on_the_bearing_between_switches() {
    let model = Model::new(&rectangle()).unwrap();
    let (from, to, first) = quiet_stretch(&model, 2e-3, 12e-3);
    println!("quiet from {from:.6} to {to:.6}");
    assert!(to - from > 5e-5, "quiet from {from} to {to}");
    let mass = model.mass();
    let norm = |a: &[f64], b: &[f64]| {
        let half = mass.len();
        let sum: f64 = mass.iter().zip(a[half..].iter().zip(&b[half..])).map(|(m, (a, b))| m * (a - b) * (a - b)).sum();
        sum.sqrt()
    };
    let run = |step: f64, at: &mut dyn FnMut(&Stepper<_>)| {
        let mut motion = Motion::new(&model);
        let mut stepper = Stepper::new(&mut motion, fixed(step, mass.clone()), from, &first);
        let acting = Acting::of(&motion);
        let before = Energy::of(&model, from, &first, &motion.ws).total();
        let mut flow = 0.0;
        let mut residual = 0.0f64;
        while stepper.t() < to {
            flow += stepper.step(&mut motion).unwrap().net();
            assert!(Acting::of(&motion) == acting, "a switch at {}", stepper.t());
            let now = Energy::of(&model, stepper.t(), stepper.y(), &motion.ws).total();
            residual = residual.max((now - before - flow).abs());
            at(&stepper);
        }
        residual
    };
    // Grid of the comparisons, the same for all.
    let grid: Vec<f64> = (1..40).map(|k| from + (to - from) * f64::from(k) / 40.0).collect();
    let sample = |step: f64| {
        let mut states = Vec::new();
        let mut y = vec![0.0; first.len()];
        let residual = run(step, &mut |stepper| {
            while states.len() < grid.len() && grid[states.len()] <= stepper.t() {
                stepper.interpolate(grid[states.len()], &mut y);
                states.push(y.clone());
            }
        });
        assert_eq!(states.len(), grid.len());
        (states, residual)
    };
    let (exact, _) = sample(LONGEST * 0.5f64.powi(LEVELS + 2));
    let mut errors = [Vec::new(), Vec::new()];
    for level in 0..LEVELS {
        let (states, residual) = sample(LONGEST * 0.5f64.powi(level));
        errors[0].push(states.iter().zip(&exact).map(|(a, b)| norm(a, b)).fold(0.0, f64::max));
        errors[1].push(residual);
    }
    assert_order("bearing, dense output", &errors[0], ORDER, NEAR);
    assert_order("bearing, energy audit", &errors[1][..AUDITED], ORDER, NEAR);
}
