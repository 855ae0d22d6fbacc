//! How the length of damage grows from its beginning to failure, and how one machine differs from another.

use brinell::document::reading::Choice;
use brinell::signal::distribution::normal_quantile;

/// Equal steps of the time from the beginning of damage to failure; the increments of a machine scatter one by one,
/// whatever its snapshots.
pub(super) const STEPS: usize = 64;

/// The law of growth: which share of its way the length has grown, over the share of the time since it began.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Law {
    /// x^p.
    #[default]
    Power,
    /// (exp(r x) - 1) / (exp(r) - 1).
    Exponential,
    /// The logistic function of r (x - 1/2), from 0 to 1.
    Logistic,
}

impl Choice for Law {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        ("power", Self::Power, "of the time, with an exponent"),
        ("exponential", Self::Exponential, "in time, with a rate"),
        ("logistic", Self::Logistic, "slow, fast, slow, with a rate"),
    ];
}

impl Law {
    /// As the plan says it.
    pub fn word(self) -> &'static str {
        Choice::word(self)
    }

    /// Key of its parameter.
    pub fn parameter(self) -> &'static str {
        match self {
            Self::Power => "history.exponent",
            Self::Exponential | Self::Logistic => "history.rate",
        }
    }

    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Power => "length as a power",
            Self::Exponential => "length as an exponential function",
            Self::Logistic => "length as a logistic function",
        }
    }

    /// Grown share after the share `x` of the time: 0 at 0, 1 at 1, never falling. `steepness`, above 0, is the exponent or
    /// the rate.
    pub fn share(self, x: f64, steepness: f64) -> f64 {
        let x = x.clamp(0.0, 1.0);
        match self {
            Self::Power => x.powf(steepness),
            Self::Exponential => (steepness * x).exp_m1() / steepness.exp_m1(),
            Self::Logistic => {
                let end = (0.25 * steepness).tanh();
                0.5 * ((0.5 * steepness * (x - 0.5)).tanh() / end + 1.0)
            }
        }
    }

    /// The same where each of [`STEPS`] increments is multiplied by exp(scatter z), z being the normal quantile of its
    /// place in (0, 1), and all are divided by their sum: so the ends stay, and nothing shrinks.
    pub(super) fn scattered(self, x: f64, steepness: f64, scatter: f64, places: impl Fn(usize) -> f64) -> f64 {
        if scatter == 0.0 {
            return self.share(x, steepness);
        }
        let node = |k: usize| self.share(k as f64 / STEPS as f64, steepness);
        let (mut before, mut all) = (0.0, 0.0);
        let x = x.clamp(0.0, 1.0);
        for k in 0..STEPS {
            let [from, to] = [node(k), node(k + 1)];
            let weight = (scatter * normal_quantile(places(k).max(f64::EPSILON))).exp();
            all += weight * (to - from);
            // The law's own course within a step.
            before += weight * (self.share(x, steepness).clamp(from, to) - from);
        }
        before / all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_laws_at_given_times() {
        assert_eq!([0.0, 0.5, 1.0].map(|x| Law::Power.share(x, 2.0)), [0.0, 0.25, 1.0]);
        // sqrt(e^r) in the middle: (e^(r/2) - 1)/(e^r - 1) = 1/(e^(r/2) + 1).
        let middle = Law::Exponential.share(0.5, 4.0);
        assert!((middle - 1.0 / (2_f64.exp() + 1.0)).abs() < 1e-15);
        // s(a) = 1/(1 + e^-a): (s(-r/4) - s(-r/2))/(s(r/2) - s(-r/2)).
        let s = |a: f64| 1.0 / (1.0 + (-a).exp());
        let quarter = Law::Logistic.share(0.25, 8.0);
        assert!((quarter - (s(-2.0) - s(-4.0)) / (s(4.0) - s(-4.0))).abs() < 1e-15);
        for law in [Law::Power, Law::Exponential, Law::Logistic] {
            assert_eq!([law.share(0.0, 3.0), law.share(1.0, 3.0)], [0.0, 1.0]);
        }
    }

    #[test]
    fn prop_scatter_keeps_both_ends_and_never_shrinks() {
        for (law, scatter) in [(Law::Power, 0.3), (Law::Exponential, 1.0), (Law::Logistic, 3.0)] {
            let places = |k: usize| (0.37 + 0.618 * k as f64).fract();
            let at = |x: f64| law.scattered(x, 2.5, scatter, places);
            assert!(at(0.0) == 0.0 && (at(1.0) - 1.0).abs() < 1e-14);
            let course: Vec<f64> = (0..=1000).map(|k| at(f64::from(k) / 1000.0)).collect();
            assert!(course.windows(2).all(|pair| pair[1] >= pair[0]));
            let plain = |k: u32| law.share(f64::from(k) / 1000.0, 2.5);
            assert!((0..=1000).any(|k| (course[k as usize] - plain(k)).abs() > 1e-3));
        }
    }
}
