//! Claims as data, and how one is decided from numbers.

use super::numbers::{Number, Numbers};
use super::verdict::{Trend, Verdict, between, follows, greater, over};

/// How a statement is checked. Names are those of [`crate::campaign::quantities`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Check {
    /// A number of a case lies within `share` of the paper's.
    Near {
        /// The case.
        case: &'static str,
        /// The number.
        name: &'static str,
        /// The paper's figure.
        paper: f64,
        /// How far off it may be, relative to the paper's.
        share: f64,
    },
    /// A number of one case exceeds one of another.
    Greater {
        /// Case and number that is said to be larger.
        of: (&'static str, &'static str),
        /// Case and number that is said to be smaller.
        than: (&'static str, &'static str),
    },
    /// The ratio of a number in two cases lies between bounds.
    Ratio {
        /// The case above.
        of: &'static str,
        /// The case below.
        to: &'static str,
        /// The number.
        name: &'static str,
        /// Least ratio.
        low: f64,
        /// Greatest ratio.
        high: f64,
    },
    /// A number follows a trend along cases.
    Follows {
        /// The trend.
        trend: Trend,
        /// The cases, in order.
        cases: &'static [&'static str],
        /// The number.
        name: &'static str,
    },
    /// A number's largest value along cases is at least `times` its smallest.
    Changes {
        /// The cases.
        cases: &'static [&'static str],
        /// The number.
        name: &'static str,
        /// Least ratio.
        times: f64,
    },
}

/// One checkable statement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Statement {
    /// In words.
    pub words: &'static str,
    /// How it is decided.
    pub check: Check,
}

/// A sentence of the paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Claim {
    /// How tables call it.
    pub id: &'static str,
    /// Where it stands: "4.3, Fig. 17".
    pub place: &'static str,
    /// Its words, shortened at most.
    pub sentence: &'static str,
    /// The paper's figures, where it prints any.
    pub paper: &'static str,
    /// What is checked; none where no number decides the sentence.
    pub statements: &'static [Statement],
    /// What to know about it: how it was read, or why it cannot be checked and what was looked at instead.
    pub note: &'static str,
}

impl Check {
    /// Cases that it needs.
    pub fn cases(&self) -> Vec<&'static str> {
        match *self {
            Self::Near { case, .. } => vec![case],
            Self::Greater { of, than } => vec![of.0, than.0],
            Self::Ratio { of, to, .. } => vec![of, to],
            Self::Follows { cases, .. } | Self::Changes { cases, .. } => cases.to_vec(),
        }
    }
}

impl Claim {
    /// Cases that it needs.
    pub fn cases(&self) -> Vec<&'static str> {
        let mut all: Vec<_> = self
            .statements
            .iter()
            .flat_map(|s| s.check.cases())
            .collect();
        all.sort_unstable();
        all.dedup();
        all
    }
}

/// A number of ours behind a verdict.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// What it is.
    pub what: String,
    /// How much; `None` where it is missing.
    pub value: Option<f64>,
    /// Its 95 % interval.
    pub interval: Option<(f64, f64)>,
    /// SI unit; empty of ratios.
    pub unit: &'static str,
}

/// A claim held against numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged {
    /// The claim's.
    pub verdict: Verdict,
    /// Of each statement, with what decided it.
    pub statements: Vec<(Verdict, Vec<Found>)>,
}

/// Decides a claim.
pub fn judge(claim: &Claim, numbers: &Numbers) -> Judged {
    let statements: Vec<_> = claim
        .statements
        .iter()
        .map(|statement| decide(&statement.check, numbers))
        .collect();
    let verdicts: Vec<Verdict> = statements.iter().map(|s| s.0).collect();
    Judged {
        verdict: Verdict::of_all(&verdicts),
        statements,
    }
}

/// SI unit of a number, by its name.
fn unit(name: &str) -> &'static str {
    let of_acceleration =
        name.ends_with(".rms") || name.contains("peak") && !name.ends_with("force");
    match name {
        _ if name.ends_with("frequency") => "Hz",
        _ if name.ends_with("contact_length") => "m",
        _ if of_acceleration => "m/s^2",
        _ => "",
    }
}

fn found(case: &str, name: &str, number: Option<Number>) -> Found {
    Found {
        what: format!("{case}: {name}"),
        value: number.map(|n| n.value),
        interval: number.and_then(|n| n.interval).map(|i| (i.low, i.high)),
        unit: unit(name),
    }
}

fn quotient(what: String, ratio: Option<crate::signal::ratio::Ratio>) -> Found {
    Found {
        what,
        value: ratio.map(|r| r.value),
        interval: ratio.and_then(|r| r.interval),
        unit: "",
    }
}

fn decide(check: &Check, numbers: &Numbers) -> (Verdict, Vec<Found>) {
    match *check {
        Check::Near {
            case,
            name,
            paper,
            share,
        } => {
            let number = numbers.get(case, name);
            let verdict = number.map_or(Verdict::Missing, |n| {
                let ends = n.interval.map_or((n.value, n.value), |i| (i.low, i.high));
                between(Some(ends), paper * (1.0 - share), paper * (1.0 + share))
            });
            (verdict, vec![found(case, name, number)])
        }
        Check::Greater { of, than } => {
            let (a, b) = (numbers.get(of.0, of.1), numbers.get(than.0, than.1));
            let ratio = a.zip(b).and_then(|(a, b)| over(a, b));
            let all = vec![
                found(of.0, of.1, a),
                found(than.0, than.1, b),
                quotient("ratio".into(), ratio),
            ];
            (greater(ratio), all)
        }
        Check::Ratio {
            of,
            to,
            name,
            low,
            high,
        } => {
            let (a, b) = (numbers.get(of, name), numbers.get(to, name));
            let ratio = a.zip(b).and_then(|(a, b)| over(a, b));
            let verdict = ratio.map_or(Verdict::Missing, |r| between(r.interval, low, high));
            (
                verdict,
                vec![quotient(format!("{of} / {to}: {name}"), ratio)],
            )
        }
        Check::Follows { trend, cases, name } => {
            let values: Vec<_> = cases.iter().map(|case| numbers.get(case, name)).collect();
            let step = |pair: &[Option<Number>]| over(pair[1]?, pair[0]?);
            let steps: Vec<_> = values.windows(2).map(step).collect();
            let all = cases.iter().zip(&values);
            let all = all
                .map(|(case, number)| found(case, name, *number))
                .collect();
            (follows(trend, &steps), all)
        }
        Check::Changes { cases, name, times } => {
            let mut known = Vec::new();
            for case in cases {
                match numbers.get(case, name) {
                    Some(number) => known.push((*case, number)),
                    None => return (Verdict::Missing, vec![found(case, name, None)]),
                }
            }
            let by = |a: &&(&str, Number), b: &&(&str, Number)| a.1.value.total_cmp(&b.1.value);
            let (Some(most), Some(least)) = (known.iter().max_by(by), known.iter().min_by(by))
            else {
                return (Verdict::Missing, vec![]);
            };
            let ratio = over(most.1, least.1);
            let what = format!("{} / {}: {name}", most.0, least.0);
            let verdict = ratio.map_or(Verdict::Missing, |r| {
                between(r.interval, times, f64::INFINITY)
            });
            (verdict, vec![quotient(what, ratio)])
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{case, claims};
    use super::*;
    use crate::signal::Interval;

    fn scattered(center: f64) -> Number {
        Number {
            value: center,
            interval: Some(Interval {
                low: 0.98 * center,
                high: 1.02 * center,
                freedom: 29,
            }),
        }
    }

    fn of(check: Check, values: &[(&str, f64)]) -> Verdict {
        let mut numbers = Numbers::default();
        for (case, value) in values {
            numbers.insert(case, "q.rms", scattered(*value));
        }
        decide(&check, &numbers).0
    }

    #[test]
    fn prop_each_kind_of_check_comes_out_each_way() {
        let near = Check::Near {
            case: "a",
            name: "q.rms",
            paper: 10.0,
            share: 0.1,
        };
        assert_eq!(of(near, &[("a", 10.2)]), Verdict::Holds);
        assert_eq!(of(near, &[("a", 11.0)]), Verdict::Undecided);
        assert_eq!(of(near, &[("a", 13.0)]), Verdict::Fails);
        assert_eq!(of(near, &[]), Verdict::Missing);
        let greater = Check::Greater {
            of: ("a", "q.rms"),
            than: ("b", "q.rms"),
        };
        assert_eq!(of(greater, &[("a", 2.0), ("b", 1.0)]), Verdict::Holds);
        assert_eq!(of(greater, &[("a", 1.0), ("b", 1.0)]), Verdict::Undecided);
        assert_eq!(of(greater, &[("a", 1.0), ("b", 2.0)]), Verdict::Fails);
        assert_eq!(of(greater, &[("a", 1.0)]), Verdict::Missing);
        let ratio = Check::Ratio {
            of: "a",
            to: "b",
            name: "q.rms",
            low: 1.0,
            high: 1.1,
        };
        assert_eq!(of(ratio, &[("a", 1.05), ("b", 1.0)]), Verdict::Holds);
        assert_eq!(of(ratio, &[("a", 1.1), ("b", 1.0)]), Verdict::Undecided);
        assert_eq!(of(ratio, &[("a", 1.5), ("b", 1.0)]), Verdict::Fails);
        let follows = Check::Follows {
            trend: Trend::Rises,
            cases: &["a", "b", "c"],
            name: "q.rms",
        };
        assert_eq!(
            of(follows, &[("a", 1.0), ("b", 2.0), ("c", 3.0)]),
            Verdict::Holds
        );
        assert_eq!(
            of(follows, &[("a", 1.0), ("b", 2.0), ("c", 2.0)]),
            Verdict::Undecided
        );
        assert_eq!(
            of(follows, &[("a", 1.0), ("b", 3.0), ("c", 2.0)]),
            Verdict::Fails
        );
        assert_eq!(of(follows, &[("a", 1.0), ("c", 2.0)]), Verdict::Missing);
        let changes = Check::Changes {
            cases: &["a", "b", "c"],
            name: "q.rms",
            times: 1.5,
        };
        assert_eq!(
            of(changes, &[("a", 2.0), ("b", 1.0), ("c", 1.5)]),
            Verdict::Holds
        );
        assert_eq!(
            of(changes, &[("a", 1.5), ("b", 1.0), ("c", 1.2)]),
            Verdict::Undecided
        );
        assert_eq!(
            of(changes, &[("a", 1.1), ("b", 1.0), ("c", 1.0)]),
            Verdict::Fails
        );
        assert_eq!(of(changes, &[("a", 1.1)]), Verdict::Missing);
    }

    #[test]
    fn prop_claims_are_whole() {
        for (k, claim) in claims().enumerate() {
            assert!(
                claims().take(k).all(|other| other.id != claim.id),
                "{}",
                claim.id
            );
            assert!(
                claim.cases().iter().all(|id| case(id).is_some()),
                "{}",
                claim.id
            );
            // What cannot be checked says why.
            assert!(
                !claim.statements.is_empty() || !claim.note.is_empty(),
                "{}",
                claim.id
            );
            let judged = judge(claim, &Numbers::default());
            let nothing = if claim.statements.is_empty() {
                Verdict::NotCheckable
            } else {
                Verdict::Missing
            };
            assert_eq!(judged.verdict, nothing, "{}", claim.id);
        }
    }
}
