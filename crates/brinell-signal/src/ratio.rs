//! The ratio of one quantity in two runs, with the interval that follows from the intervals of both.
//!
//! With values a and b, r = a / b, standard errors s_a and s_b of their logarithms with nu_a and nu_b degrees of
//! freedom:
//!
//! ```text
//! ln r +- t(0.975, nu) sqrt(u_a + u_b),   u = s^2,   nu = (u_a + u_b)^2 / (u_a^2 / nu_a + u_b^2 / nu_b)
//! ```
//!
//! Degrees of freedom are those of Welch and Satterthwaite, rounded down. s is half the width of the 95 % interval on a
//! logarithmic scale over Student's t; an interval that reaches zero says nothing of the logarithm, and then the ratio
//! has none. It supposes runs that scatter independently. Runs that begin alike go alike for a while; that makes the
//! true scatter of the ratio smaller, so the interval errs on the wide side.

use super::estimate::{Estimate, Interval, Written};
use super::scatter::student_t_quantile;
use schemars::JsonSchema;
use serde::Serialize;

/// Ratio of one run's quantity to another's.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
#[serde(into = "Written")]
pub struct Ratio {
    /// Ratio of the values.
    pub value: f64,
    /// Its 95 % interval; `None` where a value has none, one that reaches zero, or one of no degrees of freedom.
    pub interval: Option<(f64, f64)>,
}

impl From<Ratio> for Written {
    fn from(r: Ratio) -> Self {
        Written::new(r.value, r.interval)
    }
}

/// The value of `of` over that of `to`; `None` where one is not positive.
pub fn ratio(of: &Estimate, to: &Estimate) -> Option<Ratio> {
    if !(of.value > 0.0 && to.value > 0.0) {
        return None;
    }
    let value = of.value / to.value;
    Some(Ratio { value, interval: half_width(of, to).map(|half| (value * (-half).exp(), value * half.exp())) })
}

/// Half the interval of ln r.
fn half_width(of: &Estimate, to: &Estimate) -> Option<f64> {
    let (a, m) = variance(&of.interval?)?;
    let (b, n) = variance(&to.interval?)?;
    if a + b == 0.0 {
        return Some(0.0);
    }
    let freedom = (a + b).powi(2) / (a * a / m + b * b / n);
    Some(student_t_quantile(0.975, freedom.floor().max(1.0) as u32) * (a + b).sqrt())
}

/// Variance of the logarithm, and the degrees of freedom that it has.
fn variance(interval: &Interval) -> Option<(f64, f64)> {
    (interval.low > 0.0 && interval.freedom > 0).then(|| {
        let quantile = student_t_quantile(0.975, interval.freedom);
        let error = 0.5 * (interval.high / interval.low).ln() / quantile;
        (error * error, f64::from(interval.freedom))
    })
}

#[cfg(test)]
mod tests {
    use super::super::blocks::Blocks;
    use super::super::indicators::Indicator;
    use super::super::test_signals::Noise;
    use super::*;

    fn estimate(noise: &mut Noise, blocks: usize, scale: f64) -> Estimate {
        let mut all = Blocks::new();
        for _ in 0..blocks {
            (0..40).for_each(|_| all.push(scale * noise.normal()));
            all.end_block();
        }
        all.estimate(Indicator::Rms).unwrap()
    }

    #[test]
    fn analytic_interval_of_a_ratio_covers_the_truth_95_times_in_100() {
        // RMS of white noise of two sizes in unequal numbers of blocks.
        let mut noise = Noise::new(11);
        for (m, n) in [(15, 15), (12, 30), (40, 60)] {
            let (mut covered, trials) = (0, 2000);
            for _ in 0..trials {
                let (a, b) = (estimate(&mut noise, m, 2.5), estimate(&mut noise, n, 1.0));
                let (low, high) = ratio(&a, &b).unwrap().interval.unwrap();
                covered += usize::from(low <= 2.5 && 2.5 <= high);
            }
            let share = covered as f64 / f64::from(trials);
            // Four standard errors of a binomial share: 0.0195; degrees of freedom rounded down may cover a little
            // more.
            assert!((0.95 - 0.0195..0.95 + 0.03).contains(&share), "{m} and {n} blocks: {share}");
        }
    }

    #[test]
    fn analytic_a_run_over_itself_and_the_inverse() {
        let mut noise = Noise::new(12);
        let (a, b) = (estimate(&mut noise, 9, 3.0), estimate(&mut noise, 12, 1.0));
        let (there, back) = (ratio(&a, &b).unwrap(), ratio(&b, &a).unwrap());
        assert!((there.value * back.value - 1.0).abs() < 1e-14);
        let ((l, h), (bl, bh)) = (there.interval.unwrap(), back.interval.unwrap());
        assert!((l * bh - 1.0).abs() < 1e-12 && (h * bl - 1.0).abs() < 1e-12);
        assert_eq!(ratio(&a, &a).unwrap().value, 1.0);
        // The ratio of the values that are printed.
        assert_eq!(there.value, a.value / b.value);
    }

    #[test]
    fn prop_what_has_no_ratio_or_no_interval() {
        let of =
            |value: f64, low: f64, high: f64| Estimate { value, interval: Some(Interval { low, high, freedom: 9 }) };
        let sound = of(2.0, 1.8, 2.2);
        assert_eq!(ratio(&sound, &of(0.0, 0.0, 0.0)), None);
        assert_eq!(ratio(&sound, &of(-1.0, -2.0, 1.0)), None);
        let wide = ratio(&sound, &of(2.0, -3.0, 7.0)).unwrap();
        assert_eq!((wide.value, wide.interval), (1.0, None));
        let free = Estimate { value: 2.0, interval: Some(Interval { low: 1.8, high: 2.2, freedom: 0 }) };
        assert_eq!(ratio(&sound, &free), Some(Ratio { value: 1.0, interval: None }));
        let exact = of(2.0, 2.0, 2.0);
        assert_eq!(ratio(&exact, &exact).unwrap().interval, Some((1.0, 1.0)));
    }
}
