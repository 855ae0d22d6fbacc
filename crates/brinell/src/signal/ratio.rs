//! The ratio of one indicator in two runs, with the interval that follows from the scatter of their blocks.
//!
//! With block means a and b, their standard errors s_a and s_b from n_a and n_b blocks, and r = a / b:
//!
//! ```text
//! ln r +- t(0.975, nu) sqrt(u_a + u_b),   u = (s / mean)^2,   nu = (u_a + u_b)^2 / (u_a^2 / (n_a - 1) + u_b^2 / (n_b - 1))
//! ```
//!
//! The variance of a logarithm to first order, and Welch and Satterthwaite's degrees of freedom, rounded down. It supposes positive
//! indicators, runs that scatter independently, and relative standard errors that are small: beyond [`LARGEST_ERROR`] the first order no
//! longer holds, and there is no interval. Runs that begin alike go alike for a while; that makes the true scatter of the ratio smaller, so
//! the interval errs on the wide side. A ratio of extremes asks for blocks of one length: where the blocks stand for different numbers of
//! turns, there is no ratio.

use super::indicators::{Interval, student_t_quantile};

/// Largest relative standard error of a mean for which a ratio has an interval.
pub const LARGEST_ERROR: f64 = 0.25;

/// How one run's indicator stands to another's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ratio {
    /// Ratio of the means over blocks.
    pub value: f64,
    /// Its 95 % interval; `None` where a mean is too uncertain for one.
    pub interval: Option<(f64, f64)>,
}

/// The mean over blocks behind `of` over that behind `to`; `None` where one is not positive, or the blocks differ in length.
pub fn ratio(of: &Interval, to: &Interval) -> Option<Ratio> {
    let sound = of.center > 0.0 && to.center > 0.0;
    if !sound || of.periods_per_block != to.periods_per_block {
        return None;
    }
    let value = of.center / to.center;
    let ([a, m], [b, n]) = (relative_variance(of)?, relative_variance(to)?);
    let limit = LARGEST_ERROR * LARGEST_ERROR;
    let half = if a + b == 0.0 {
        0.0
    } else {
        let freedom = (a + b).powi(2) / (a * a / m + b * b / n);
        student_t_quantile(0.975, freedom.floor().max(1.0) as u32) * (a + b).sqrt()
    };
    let interval = (a <= limit && b <= limit).then(|| (value * (-half).exp(), value * half.exp()));
    Some(Ratio { value, interval })
}

/// Variance of the mean over its square, and the degrees of freedom that it has.
fn relative_variance(interval: &Interval) -> Option<[f64; 2]> {
    let freedom = interval.blocks.checked_sub(1).filter(|f| *f > 0)?;
    let quantile = student_t_quantile(0.975, freedom as u32);
    let error = 0.5 * (interval.high - interval.low) / quantile;
    Some([(error / interval.center).powi(2), freedom as f64])
}

#[cfg(test)]
mod tests {
    use super::super::indicators::{Blocks, Indicator};
    use super::super::test_signals::Noise;
    use super::*;

    fn interval(noise: &mut Noise, blocks: usize, scale: f64) -> Interval {
        let mut all = Blocks::new();
        for _ in 0..blocks {
            (0..40).for_each(|_| all.push(scale * noise.normal()));
            all.end_block();
        }
        all.estimate(Indicator::Rms).unwrap().interval.unwrap()
    }

    #[test]
    fn analytic_interval_of_a_ratio_covers_the_truth_95_times_in_100() {
        // RMS of white noise of two sizes in unequal numbers of blocks: the ratio is 2.5, as both blocks' RMS share their bias.
        let mut noise = Noise::new(11);
        for (m, n) in [(15, 15), (6, 30), (4, 4)] {
            let (mut covered, trials) = (0, 2000);
            for _ in 0..trials {
                let (a, b) = (interval(&mut noise, m, 2.5), interval(&mut noise, n, 1.0));
                let (low, high) = ratio(&a, &b).unwrap().interval.unwrap();
                covered += usize::from(low <= 2.5 && 2.5 <= high);
            }
            let share = covered as f64 / f64::from(trials);
            // Four standard errors of a binomial share: 0.0195; degrees of freedom rounded down may cover a little more.
            assert!(
                (0.95 - 0.0195..0.95 + 0.03).contains(&share),
                "{m} and {n} blocks: {share}"
            );
        }
    }

    #[test]
    fn analytic_a_run_over_itself_and_the_inverse() {
        let mut noise = Noise::new(12);
        let (a, b) = (interval(&mut noise, 9, 3.0), interval(&mut noise, 12, 1.0));
        let (there, back) = (ratio(&a, &b).unwrap(), ratio(&b, &a).unwrap());
        assert!((there.value * back.value - 1.0).abs() < 1e-14);
        let ((l, h), (bl, bh)) = (there.interval.unwrap(), back.interval.unwrap());
        assert!((l * bh - 1.0).abs() < 1e-12 && (h * bl - 1.0).abs() < 1e-12);
        assert_eq!(ratio(&a, &a).unwrap().value, 1.0);
    }

    #[test]
    fn prop_what_has_no_ratio() {
        let sound = Interval {
            center: 2.0,
            low: 1.8,
            high: 2.2,
            blocks: 10,
            periods_per_block: 1,
        };
        let other = |change: fn(&mut Interval)| {
            let mut other = sound;
            change(&mut other);
            ratio(&sound, &other)
        };
        assert_eq!(other(|i| i.center = 0.0), None);
        assert_eq!(other(|i| i.center = -1.0), None);
        assert_eq!(other(|i| i.periods_per_block = 2), None);
        let wide = other(|i| (i.low, i.high) = (-3.0, 7.0)).unwrap();
        assert_eq!((wide.value, wide.interval), (1.0, None));
        let exact = ratio(
            &Interval {
                low: 2.0,
                high: 2.0,
                ..sound
            },
            &Interval {
                low: 2.0,
                high: 2.0,
                ..sound
            },
        );
        assert_eq!(exact.unwrap().interval, Some((1.0, 1.0)));
    }
}
