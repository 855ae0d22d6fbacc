//! How numbers with intervals decide a statement. A number without an interval is exact: it is read off a shape, not
//! off a signal.
//!
//! - a > b: by the 95 % interval of the ratio ([`brinell::signal::ratio`]); decided where it excludes equality.
//! - near: decided where the interval lies wholly inside, or wholly outside, the stated bounds.
//! - trends: by the ratios of neighbours. A step whose interval includes equality may go either way; the trend holds
//!   where it holds whichever way such steps go, fails where it fails whichever way they go, and is undecided
//!   otherwise.
//!
//! Each interval is at 95 % by itself: of twenty true equalities one is expected to look decided.

use brinell::signal::Estimate;
use brinell::signal::ratio::{Ratio, ratio};
use serde::Deserialize;

/// What came out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Every part of it holds.
    Holds,
    /// Some parts hold, others do not.
    Partly,
    /// It does not hold.
    Fails,
    /// The intervals include equality.
    Undecided,
    /// A number is missing: a run failed, or has no such number.
    Missing,
    /// No number could decide it.
    NotCheckable,
}

impl Verdict {
    /// As tables say it.
    pub fn words(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Partly => "holds in part",
            Self::Fails => "does not hold",
            Self::Undecided => "undecided",
            Self::Missing => "not computed",
            Self::NotCheckable => "not checkable",
        }
    }

    /// Of a claim, from its statements: what is decided decides it where the undecided cannot change that.
    pub fn of_all(parts: &[Verdict]) -> Self {
        let some = |verdict| parts.contains(&verdict);
        match parts {
            [] => Self::NotCheckable,
            _ if some(Self::Missing) => Self::Missing,
            _ if some(Self::Fails) && (some(Self::Holds) || some(Self::Partly)) => Self::Partly,
            _ if some(Self::Partly) => Self::Partly,
            // Were the open ones to hold, it would hold in part.
            _ if some(Self::Undecided) => Self::Undecided,
            _ if some(Self::Fails) => Self::Fails,
            _ => Self::Holds,
        }
    }

    fn of(holds: bool, fails: bool) -> Self {
        match (holds, fails) {
            (true, _) => Self::Holds,
            (_, true) => Self::Fails,
            _ => Self::Undecided,
        }
    }
}

/// The ratio of two numbers; `None` where one is not positive.
pub(crate) fn over(of: Estimate, to: Estimate) -> Option<Ratio> {
    let scaled = |number: Estimate, by: f64| {
        let (low, high) = number.interval.map(|i| (i.low * by, i.high * by))?;
        Some((low.min(high), low.max(high)))
    };
    match (&of.interval, &to.interval) {
        (Some(_), Some(_)) => ratio(&of, &to),
        _ if !(of.value > 0.0 && to.value > 0.0) => None,
        (Some(_), None) => Some(Ratio { value: of.value / to.value, interval: scaled(of, 1.0 / to.value) }),
        (None, Some(b)) => Some(Ratio {
            value: of.value / to.value,
            interval: (b.low > 0.0).then(|| (of.value / b.high, of.value / b.low)),
        }),
        (None, None) => {
            let value = of.value / to.value;
            Some(Ratio { value, interval: Some((value, value)) })
        }
    }
}

/// Whether the ratio is above 1.
pub(crate) fn greater(ratio: Option<Ratio>) -> Verdict {
    let Some(ratio) = ratio else {
        return Verdict::Missing;
    };
    match ratio.interval {
        Some((low, high)) => Verdict::of(low > 1.0, high <= 1.0),
        None => Verdict::Undecided,
    }
}

/// Whether what lies in `interval` lies between two bounds.
pub(crate) fn between(interval: Option<(f64, f64)>, low: f64, high: f64) -> Verdict {
    match interval {
        Some((a, b)) => Verdict::of(a >= low && b <= high, b < low || a > high),
        None => Verdict::Undecided,
    }
}

/// Which way a quantity goes from step to step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Trend {
    /// Up at every step.
    Rises,
    /// Down at every step.
    Falls,
    /// Up once or more, then down once or more.
    RisesThenFalls,
}

impl Trend {
    fn is(self, ups: impl Iterator<Item = bool>) -> bool {
        let ups: Vec<bool> = ups.collect();
        match self {
            Self::Rises => ups.iter().all(|up| *up),
            Self::Falls => ups.iter().all(|up| !up),
            Self::RisesThenFalls => {
                let peak = ups.iter().position(|up| !up).unwrap_or(ups.len());
                peak > 0 && peak < ups.len() && ups[peak..].iter().all(|up| !up)
            }
        }
    }
}

/// Whether steps follow a trend; each is the ratio of a value to the one before.
pub(crate) fn follows(trend: Trend, steps: &[Option<Ratio>]) -> Verdict {
    let mut ways: Vec<Option<bool>> = Vec::new();
    for step in steps {
        let Some(step) = step else {
            return Verdict::Missing;
        };
        ways.push(match step.interval {
            Some((low, _)) if low > 1.0 => Some(true),
            Some((_, high)) if high < 1.0 => Some(false),
            _ => None,
        });
    }
    let open: Vec<usize> = (0..ways.len()).filter(|k| ways[*k].is_none()).collect();
    if open.len() > 16 {
        return Verdict::Undecided;
    }
    let (mut holds, mut fails) = (true, true);
    for choice in 0..1_u32 << open.len() {
        let up = |k: usize| {
            let place = open.iter().position(|o| *o == k).unwrap_or(0);
            ways[k].unwrap_or(choice >> place & 1 == 1)
        };
        let so = trend.is((0..ways.len()).map(up));
        holds &= so;
        fails &= !so;
    }
    Verdict::of(holds, fails)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::exact;
    use brinell::signal::Interval;

    fn number(value: f64, half: f64) -> Estimate {
        Estimate { value, interval: Some(Interval { low: value - half, high: value + half, freedom: 19 }) }
    }

    /// A step up, down, or open.
    fn step(way: char) -> Option<Ratio> {
        let (value, interval) = match way {
            '+' => (1.3, Some((1.1, 1.5))),
            '-' => (0.7, Some((0.6, 0.9))),
            '?' => (1.1, Some((0.9, 1.3))),
            // A ratio that is too uncertain for an interval.
            _ => (1.5, None),
        };
        Some(Ratio { value, interval })
    }

    fn trend(trend: Trend, ways: &str) -> Verdict {
        follows(trend, &ways.chars().map(step).collect::<Vec<_>>())
    }

    #[test]
    fn prop_greater_comes_out_each_way() {
        let of = |a, b| greater(over(a, b));
        assert_eq!(of(number(5.0, 0.1), number(4.0, 0.1)), Verdict::Holds);
        assert_eq!(of(number(4.0, 0.1), number(5.0, 0.1)), Verdict::Fails);
        assert_eq!(of(number(4.0, 0.5), number(4.1, 0.5)), Verdict::Undecided);
        assert_eq!(of(number(4.0, 3.9), number(1.0, 0.1)), Verdict::Undecided);
        assert_eq!(of(number(0.0, 0.1), number(1.0, 0.1)), Verdict::Missing);
        assert_eq!(of(exact(2.0), exact(1.0)), Verdict::Holds);
        assert_eq!(of(exact(1.0), exact(1.0)), Verdict::Fails);
        assert_eq!(of(exact(1.0), number(2.0, 0.1)), Verdict::Fails);
        assert_eq!(of(number(2.0, 0.1), exact(1.0)), Verdict::Holds);
        assert_eq!(greater(None), Verdict::Missing);
    }

    #[test]
    fn analytic_ratio_of_equal_scatter_is_that_of_the_signal_room() {
        // ln r +- t sqrt(u_a + u_b) with 38 degrees of freedom; the halves are t(19) s.
        let t = |freedom| brinell::signal::student_t_quantile(0.975, freedom);
        let (low, high) = over(number(2.0, 0.1), number(1.0, 0.05)).unwrap().interval.unwrap();
        let log_half = 0.5 * (2.1_f64 / 1.9).ln();
        let half = t(38) / t(19) * log_half * 2.0_f64.sqrt();
        assert!((low - 2.0 * (-half).exp()).abs() < 1e-9);
        assert!((high - 2.0 * half.exp()).abs() < 1e-9);
    }

    #[test]
    fn prop_between_comes_out_each_way() {
        assert_eq!(between(Some((1.01, 1.09)), 1.0, 1.1), Verdict::Holds);
        assert_eq!(between(Some((1.2, 1.3)), 1.0, 1.1), Verdict::Fails);
        assert_eq!(between(Some((0.8, 0.9)), 1.0, 1.1), Verdict::Fails);
        assert_eq!(between(Some((1.05, 1.15)), 1.0, 1.1), Verdict::Undecided);
        assert_eq!(between(None, 1.0, 1.1), Verdict::Undecided);
    }

    #[test]
    fn prop_trends_come_out_each_way() {
        for (ways, rises, falls, both) in [
            ("++++", Verdict::Holds, Verdict::Fails, Verdict::Fails),
            ("----", Verdict::Fails, Verdict::Holds, Verdict::Fails),
            ("++--", Verdict::Fails, Verdict::Fails, Verdict::Holds),
            ("--++", Verdict::Fails, Verdict::Fails, Verdict::Fails),
            ("+-+-", Verdict::Fails, Verdict::Fails, Verdict::Fails),
            // Whichever way the open step goes, it rises and then falls.
            ("++?-", Verdict::Fails, Verdict::Fails, Verdict::Holds),
            // The peak may lie at the end.
            ("+++?", Verdict::Undecided, Verdict::Fails, Verdict::Undecided),
            ("+?++", Verdict::Undecided, Verdict::Fails, Verdict::Fails),
            ("????", Verdict::Undecided, Verdict::Undecided, Verdict::Undecided),
            ("+ -", Verdict::Fails, Verdict::Fails, Verdict::Holds),
        ] {
            assert_eq!(trend(Trend::Rises, ways), rises, "{ways} rises");
            assert_eq!(trend(Trend::Falls, ways), falls, "{ways} falls");
            assert_eq!(trend(Trend::RisesThenFalls, ways), both, "{ways} both");
        }
        assert_eq!(follows(Trend::Rises, &[step('+'), None]), Verdict::Missing);
    }

    #[test]
    fn prop_a_claim_follows_from_its_statements() {
        use Verdict::{Fails, Holds, Missing, NotCheckable, Partly, Undecided};
        for (parts, whole) in [
            (vec![], NotCheckable),
            (vec![Holds, Holds], Holds),
            (vec![Holds, Fails], Partly),
            (vec![Fails, Fails], Fails),
            (vec![Fails, Undecided], Undecided),
            (vec![Partly, Undecided], Partly),
            (vec![Holds, Undecided], Undecided),
            (vec![Holds, Undecided, Fails], Partly),
            (vec![Holds, Missing], Missing),
        ] {
            assert_eq!(Verdict::of_all(&parts), whole, "{parts:?}");
        }
    }
}
