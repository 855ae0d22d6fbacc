//! Adaptive explicit Runge-Kutta-Nystrom integration of q'' = f(t, q, q') with dense output.
//!
//! The state is y = (q, v), positions and their rates. A quantity (here, flows of energy) may be integrated along with
//! it. Errors are measured on the rates, weighted by the system's masses, so the tolerance is the square root of an
//! energy per step: an error of a velocity there is an error of a force integrated over the step. Nothing is allocated
//! after [`Stepper::new`].

mod tableau;

pub use tableau::{DAMPED_CONTACT, STAGES, Tableau};

use crate::lanes::{Column, blend, weighted_square};
use std::ops::{AddAssign, Mul};

/// A quantity integrated along with the state by the same quadrature, outside the error control.
pub trait Flow: Copy + Default + AddAssign + Mul<f64, Output = Self> {}

impl<F: Copy + Default + AddAssign + Mul<f64, Output = F>> Flow for F {}

/// What is integrated.
pub trait System {
    /// What is integrated beside the state.
    type Flow: Flow;

    /// Entries of the state.
    fn size(&self) -> usize;

    /// dv/dt, half as long as the state.
    fn accelerations(&mut self, t: f64, y: &[f64], a: &mut [f64]);

    /// Stability limit of the step at the last state given to [`System::accelerations`].
    fn stable_step(&self) -> f64 {
        f64::INFINITY
    }

    /// Rate of the integrated quantity at the last evaluated state.
    fn flow(&self) -> Self::Flow;
}

/// Settings of a [`Stepper`].
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Largest accepted norm of a step's error, in the units of sqrt(mass) times rate.
    pub tolerance: f64,
    /// Weights of the rates' errors (masses), one for each entry of the second half.
    pub mass: Vec<f64>,
    /// Longest step.
    pub max_step: f64,
}

/// Counted work.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Work {
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejections: u64,
    /// Right-hand sides spent on steps.
    pub evaluations: u64,
}

/// Why a step could not be taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepError {
    /// An entry of the state or of its derivative is not finite, however short the step.
    NonFinite {
        /// Time of the last good state.
        t: f64,
        /// First such entry of the state.
        index: usize,
    },
    /// The step fell below the resolution of time.
    Vanished {
        /// Time of the last good state.
        t: f64,
        /// Entry of the rates with the largest share of the error.
        index: usize,
    },
}

/// Steps a system through time.
#[derive(Debug, Clone)]
pub struct Stepper<F> {
    tolerance: f64,
    max_step: f64,
    /// Accelerations of the stages; the first are those of `y`, the last those of the trial state, and between steps
    /// those of `previous`.
    stages: [Column; STAGES + 1],
    flows: [F; STAGES + 1],
    y: Column,
    trial: Column,
    previous: Column,
    mass: Column,
    t: f64,
    t_previous: f64,
    step: f64,
    /// The system's longest step from the current state.
    limit: f64,
    /// Binary logarithm of the last accepted step's error over the tolerance.
    last_magnitude: f32,
    work: Work,
}

/// Controller: a step's error should come to this share of the tolerance.
const SAFETY: f64 = 0.9;
/// Bounds of the factor between consecutive steps.
const GROWTH: std::ops::RangeInclusive<f64> = 0.2..=5.0;
/// Share of the previous error in the proportional-integral controller (Hairer, Norsett, Wanner, Solving ODEs I, IV.2).
const INTEGRAL: f64 = 0.08;

/// An error of 1e-4 of the tolerance: a smaller one does not hold the next step back further.
const LEAST_MAGNITUDE: f32 = -13.29;

impl<F: Flow> Stepper<F> {
    /// At (t, y), with the accelerations evaluated there.
    pub fn new<S: System<Flow = F>>(system: &mut S, settings: Settings, t: f64, y: &[f64]) -> Self {
        let n = system.size();
        let mut stepper = Self {
            stages: std::array::from_fn(|_| Column::new(n / 2, 0.0)),
            flows: [F::default(); STAGES + 1],
            y: Column::from(y),
            trial: Column::new(n, 0.0),
            previous: Column::from(y),
            mass: Column::from(settings.mass.as_slice()),
            tolerance: settings.tolerance,
            max_step: settings.max_step,
            t,
            t_previous: t,
            // The controller finds its own step within a few trials; too short costs little, too long is rejected.
            step: 1e-3 * settings.max_step,
            limit: f64::INFINITY,
            last_magnitude: 0.0,
            work: Work::default(),
        };
        system.accelerations(t, y, &mut stepper.stages[0]);
        stepper.flows[0] = system.flow();
        stepper.limit = system.stable_step();
        stepper.work.evaluations = 1;
        stepper
    }

    /// Goes on from the present state in a system with as many entries: accelerations are evaluated anew, the
    /// controller seeks its step anew, and the last step's dense output and the counted work stay.
    pub fn go_on_in<S: System<Flow = F>>(&mut self, system: &mut S, settings: Settings) {
        let mut next = Self::new(system, settings, self.t, &self.y);
        std::mem::swap(&mut next.previous, &mut self.previous);
        std::mem::swap(&mut next.stages[STAGES], &mut self.stages[STAGES]);
        next.t_previous = self.t_previous;
        next.work.evaluations += self.work.evaluations;
        next.work.steps = self.work.steps;
        next.work.rejections = self.work.rejections;
        *self = next;
    }

    /// Time of the current state.
    pub fn t(&self) -> f64 {
        self.t
    }

    /// Current state.
    pub fn y(&self) -> &[f64] {
        &self.y
    }

    /// Accelerations at the current state.
    pub fn accelerations(&self) -> &[f64] {
        &self.stages[0]
    }

    /// Start of the last step.
    pub fn t_previous(&self) -> f64 {
        self.t_previous
    }

    /// Counted work so far.
    pub fn work(&self) -> Work {
        self.work
    }

    /// Takes one step and returns the integral of the flow over it. The last evaluation of `system` is the one at the
    /// new state.
    ///
    /// # Errors
    /// Where the state stops being finite, or no step is short enough.
    pub fn step<S: System<Flow = F>>(&mut self, system: &mut S) -> Result<F, StepError> {
        let tableau = DAMPED_CONTACT;
        let exponent = 1.0 / f64::from(tableau.order);
        let mut shrunk = false;
        loop {
            let h = self.step.min(self.max_step).min(self.limit);
            if h <= 16.0 * f64::EPSILON * self.t.abs().max(f64::MIN_POSITIVE) || h < 1e-18 {
                return Err(self.failure());
            }
            for (s, node) in tableau.nodes.into_iter().enumerate() {
                match s {
                    0 => self.place::<3, 2>(h),
                    1 => self.place::<4, 3>(h),
                    2 => self.place::<5, 4>(h),
                    _ => self.place::<6, 5>(h),
                }
                system.accelerations(self.t + node * h, &self.trial, &mut self.stages[s + 1]);
                self.flows[s + 1] = system.flow();
            }
            self.work.evaluations += STAGES as u64;
            let error = self.error(h) / self.tolerance;
            if error.is_finite() && error <= 1.0 {
                // Single precision: a step need not be longer or shorter by less.
                let magnitude = (error.max(1e-10) as f32).log2();
                let factor = SAFETY
                    * f64::from(
                        ((0.75 * INTEGRAL - exponent) as f32 * magnitude + INTEGRAL as f32 * self.last_magnitude)
                            .exp2(),
                    );
                let ceiling = if shrunk { 1.0 } else { *GROWTH.end() };
                self.last_magnitude = magnitude.max(LEAST_MAGNITUDE);
                self.accept(h);
                self.limit = system.stable_step();
                self.step = h * factor.clamp(*GROWTH.start(), ceiling);
                let mut integral = F::default();
                for (weight, flow) in tableau.weights().iter().zip(&self.flows) {
                    integral += *flow * (weight * h);
                }
                self.flows[0] = self.flows[STAGES];
                return Ok(integral);
            }
            self.work.rejections += 1;
            shrunk = true;
            let factor = if error.is_finite() { SAFETY * error.powf(-exponent) } else { 0.1 };
            self.step = h * factor.clamp(0.1, 0.9);
        }
    }

    /// Places the trial state of the stage after `V` - 1 = `Q` - 2 others: sums of `Q` lists for positions and `V` for
    /// rates.
    fn place<const Q: usize, const V: usize>(&mut self, h: f64) {
        let tableau = DAMPED_CONTACT;
        let half = self.y.len() / 2;
        let (q, v) = self.y.split_at(half);
        let (to_q, to_v) = self.trial.split_at_mut(half);
        let (mut factors, mut lists) = ([1.0; Q], [q; Q]);
        (factors[1], lists[1]) = (h * tableau.nodes[V - 2], v);
        for k in 2..Q {
            let weight = tableau.positions[V - 2][k - 2];
            (factors[k], lists[k]) = (h * h * weight, &self.stages[k - 2]);
        }
        blend(to_q, factors, lists);
        let (mut factors, mut lists) = ([1.0; V], [v; V]);
        for k in 1..V {
            let weight = tableau.rates[V - 2][k - 1];
            (factors[k], lists[k]) = (h * weight, &self.stages[k - 1]);
        }
        blend(to_v, factors, lists);
    }

    fn accept(&mut self, h: f64) {
        std::mem::swap(&mut self.previous, &mut self.y);
        std::mem::swap(&mut self.y, &mut self.trial);
        self.stages.swap(0, STAGES);
        self.t_previous = self.t;
        self.t += h;
        self.work.steps += 1;
    }

    /// Mass-weighted norm of the error of the rates.
    fn error(&self, h: f64) -> f64 {
        let stages = self.stages.each_ref().map(|s| &s[..]);
        h * weighted_square(&self.mass, DAMPED_CONTACT.error, stages).sqrt()
    }

    fn failure(&self) -> StepError {
        let half = self.y.len() / 2;
        let ends = self.trial.iter().chain(&self.stages[STAGES]);
        if let Some(index) = ends.into_iter().position(|x| !x.is_finite()) {
            // Accelerations are the slopes of the rates.
            let index = if index < 2 * half { index } else { index - half };
            return StepError::NonFinite { t: self.t, index };
        }
        StepError::Vanished { t: self.t, index: half + self.largest_error() }
    }

    /// Entry of the rates with the largest share of the last error.
    fn largest_error(&self) -> usize {
        let share = |k: usize| {
            let weights = DAMPED_CONTACT.error.iter();
            let e: f64 = weights.zip(&self.stages).map(|(w, s)| w * s[k]).sum();
            self.mass[k] * e * e
        };
        (0..self.mass.len()).max_by(|&a, &b| share(a).total_cmp(&share(b))).unwrap_or(0)
    }

    /// Entry of the rates whose error sets the length of steps; `None` where the stability limit or the longest step does.
    pub fn hardest(&mut self) -> Option<usize> {
        // As they were before the last step was accepted.
        self.stages.swap(0, STAGES);
        let index = self.largest_error();
        self.stages.swap(0, STAGES);
        (self.step < self.limit.min(self.max_step)).then_some(index)
    }

    /// How far into the last step `t` lies, as a share of it, and the step.
    fn within(&self, t: f64) -> (f64, f64) {
        let h = self.t - self.t_previous;
        if h > 0.0 { ((t - self.t_previous) / h, h) } else { (1.0, h) }
    }

    /// State at a time within the last step, by the cubic Hermite polynomial of its ends (third order, as the pair is).
    pub fn interpolate(&self, t: f64, y: &mut [f64]) {
        let (s, h) = self.within(t);
        let r = 1.0 - s;
        let factors = [r * r * (1.0 + 2.0 * s), s * s * (1.0 + 2.0 * r), h * s * r * r, -h * s * s * r];
        let half = self.y.len() / 2;
        let ((q0, v0), (q1, v1)) = (self.previous.split_at(half), self.y.split_at(half));
        let (q, v) = y.split_at_mut(half);
        blend(q, factors, [q0, q1, v0, v1]);
        blend(v, factors, [v0, v1, &self.stages[STAGES], &self.stages[0]]);
    }

    /// Displacements from the start of the last step to a time within it, by the index of the position: integrals of the
    /// interpolated rates, which keep the momentum of every step.
    pub fn displacements(&self, t: f64) -> impl Fn(usize) -> f64 {
        let (s, h) = self.within(t);
        // Of the polynomial in `interpolate`, term by term.
        let (square, cube) = (s * s, s * s * s);
        let last = cube * (1.0 - 0.5 * s);
        let factors = [
            h * (s - last),
            h * last,
            h * h * square * (0.5 - s * (2.0 / 3.0 - 0.25 * s)),
            h * h * cube * (0.25 * s - 1.0 / 3.0),
        ];
        let half = self.y.len() / 2;
        let (v0, v1) = (&self.previous[half..], &self.y[half..]);
        let (a0, a1) = (&self.stages[STAGES], &self.stages[0]);
        move |k| factors[0] * v0[k] + factors[1] * v1[k] + factors[2] * a0[k] + factors[3] * a1[k]
    }
}
