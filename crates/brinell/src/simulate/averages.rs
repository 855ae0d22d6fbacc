//! Accelerations on the fast grid, as averages and not as values at an instant.
//!
//! Where contacts open and close and rollers go over sharp edges, an acceleration jumps: its spectrum has no end, and
//! values at instants would fold what lies above half their rate into the band, to velocities at low frequencies
//! before all, from where no later filter removes it. The integral of an acceleration is known, so it is averaged
//! before it is sampled. With the displacements d_k from the instants t_k to t_(k+1), h apart,
//!
//! m_k = (d_k - d_(k-1)) / h² = ∫ a(t_k + u) (1 - |u|/h)/h du,  |u| < h,
//!
//! exactly: the average weighted by a triangle, whose response is sinc²(f h), twice zero at every frequency that folds
//! to 0. What folds to f from 1/h - f is lower by (1/(f h) - 1)². In the passband, a_k = -m_(k-1)/12 + 7/6 m_k -
//! m_(k+1)/12 takes the response of the triangle back, to 1 - 0.18 (pi f h)⁴.

use crate::solver::{Flow, Stepper};

/// Instants by which an average lags: it needs two more on its right.
pub(super) const LAG: u64 = 2;
/// Of the averages about the one before, the instant, and the one after.
const EQUALISER: [f64; 3] = [-1.0 / 12.0, 7.0 / 6.0, -1.0 / 12.0];

/// Averages the accelerations of some positions.
#[derive(Debug, Clone)]
pub(super) struct Averages {
    /// Distance of the instants, s.
    interval: f64,
    lists: Vec<Position>,
}

#[derive(Debug, Clone)]
struct Position {
    /// Where its average goes.
    place: usize,
    /// Which of the state's.
    index: usize,
    /// Displacement since the last instant up to the start of the last step, m.
    carried: f64,
    /// Displacement in the interval before the last instant, m.
    before: f64,
    /// Averages about the last two instants but one, m/s².
    averages: [f64; 2],
}

impl Averages {
    /// Of each (place, index of the position) of `entries`, at instants `interval` apart, from t = 0. Nothing
    /// accelerated before.
    pub(super) fn new(entries: &[(usize, usize)], interval: f64, rates: &[f64]) -> Self {
        let lists = entries.iter().map(|&(place, index)| Position {
            place,
            index,
            carried: 0.0,
            before: interval * rates[index],
            averages: [0.0; 2],
        });
        Self { interval, lists: lists.collect() }
    }

    /// Before the next step: the last one is over.
    pub(super) fn pass<F: Flow>(&mut self, stepper: &Stepper<F>) {
        let whole = stepper.displacements(stepper.t());
        for p in &mut self.lists {
            p.carried += whole(p.index);
        }
    }

    /// Where what follows the last step's end changed its polynomial: what was carried is of the one before, whose
    /// whole was passed.
    pub(super) fn go_on<F: Flow>(&mut self, stepper: &Stepper<F>) {
        let whole = stepper.displacements(stepper.t());
        for p in &mut self.lists {
            p.carried -= whole(p.index);
        }
    }

    /// At the next instant t, within the last step: the accelerations at the instant [`LAG`] before, into their places.
    pub(super) fn at<F: Flow>(&mut self, t: f64, stepper: &Stepper<F>, accelerations: &mut [f64]) {
        let per_square = 1.0 / (self.interval * self.interval);
        let until = stepper.displacements(t);
        for p in &mut self.lists {
            let within = until(p.index);
            let now = p.carried + within;
            p.carried = -within;
            let average = (now - p.before) * per_square;
            p.before = now;
            let [first, second] = p.averages;
            accelerations[p.place] = EQUALISER[0] * first + EQUALISER[1] * second + EQUALISER[2] * average;
            p.averages = [second, average];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::{Settings, System};
    use std::f64::consts::TAU;

    /// Instants a second.
    const RATE: f64 = 1000.0;

    /// An acceleration that depends on time alone.
    struct Driven<A>(A);

    impl<A: Fn(f64) -> f64> System for Driven<A> {
        type Flow = f64;

        fn size(&self) -> usize {
            2
        }

        fn accelerations(&mut self, t: f64, _: &[f64], a: &mut [f64]) {
            a[0] = self.0(t);
        }

        fn flow(&self) -> f64 {
            0.0
        }
    }

    /// `count` averages of an acceleration, from t = 0.
    fn averages(acceleration: impl Fn(f64) -> f64, rate: f64, count: usize) -> Vec<f64> {
        let mut system = Driven(acceleration);
        let settings = Settings { tolerance: 1e9, mass: vec![1.0], max_step: 0.013 / RATE };
        let y = [0.0, rate];
        let mut stepper = Stepper::new(&mut system, settings, 0.0, &y);
        let mut averages = Averages::new(&[(0, 0)], 1.0 / RATE, &y[1..]);
        let mut out = Vec::new();
        for k in 1.. {
            let t = k as f64 / RATE;
            while stepper.t() < t {
                averages.pass(&stepper);
                stepper.step(&mut system).unwrap();
            }
            let mut value = [f64::NAN];
            averages.at(t, &stepper, &mut value);
            if k >= LAG {
                out.push(value[0]);
            }
            if out.len() == count {
                return out;
            }
        }
        unreachable!()
    }

    #[test]
    fn analytic_the_passband_is_flat_and_without_delay() {
        for f in [0.0, 10.0, 31.0, 50.0] {
            let wave = |t: f64| 1.7 * (TAU * f * t + 0.4).cos();
            let out = averages(wave, 3.0, 200);
            let worst = (5..200).map(|k| (out[k] - wave(k as f64 / RATE)).abs()).fold(0.0, f64::max);
            assert!(worst < 1.2e-4 * 1.7, "{f} Hz: {worst:e}");
        }
    }

    #[test]
    fn analytic_what_folds_is_lower_by_the_square_of_the_ratio_of_frequencies() {
        for (f, order) in [(10.0, 1.0), (50.0, 1.0), (25.0, 2.0)] {
            let high = order * RATE - f;
            let out = averages(|t| (TAU * high * t).cos(), 0.0, 400);
            let highest = out[5..].iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            let least = (f / high).powi(2);
            assert!((highest / least - 1.0).abs() < 0.03, "{high} Hz: {highest:e}, {least:e}");
        }
    }

    #[test]
    fn analytic_a_jump_between_instants_keeps_its_momentum() {
        // Values at instants would make it 0.4 of an interval longer.
        let pulse = |t: f64| if (20.3..22.9).contains(&(t * RATE)) { 1.0 } else { 0.0 };
        let out = averages(pulse, 0.0, 60);
        let momentum: f64 = out.iter().sum();
        assert!((momentum - 2.6).abs() < 0.02, "{momentum}");
    }
}
