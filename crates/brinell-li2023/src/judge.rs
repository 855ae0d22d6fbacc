//! How a claim is decided from numbers.

use crate::claim::{Check, Claim, Statement};
use crate::numbers::Numbers;
use crate::verdict::{Trend, Verdict, between, follows, greater, over};
use brinell::signal::Estimate;

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

/// Verdicts of statements, each with what decided it.
pub(crate) type Decided = Vec<(Verdict, Vec<Found>)>;

/// A claim compared with numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged {
    /// The claim's.
    pub verdict: Verdict,
    /// The same from its own statements alone, without another reading.
    pub plain: Verdict,
    /// Of each statement, with what decided it.
    pub statements: Decided,
    /// Of the other reading as a whole, and of each of its statements.
    pub otherwise: Option<(Verdict, Decided)>,
}

impl Judged {
    /// Whether the sentence holds under its other reading alone.
    fn turned(&self) -> bool {
        let open = matches!(self.plain, Verdict::Fails | Verdict::Partly | Verdict::Undecided);
        open && self.otherwise.as_ref().is_some_and(|other| other.0 == Verdict::Holds)
    }

    /// The verdict in words, with what it is conditional on: "undecided: holds if the RMS includes the start-up".
    pub fn words(&self, claim: &Claim) -> String {
        let mut words = self.verdict.words().to_owned();
        let fails = self.statements.iter().any(|s| s.0 == Verdict::Fails);
        match &claim.otherwise {
            Some(other) if self.turned() => words += &format!(": holds {}", other.words),
            _ if self.verdict == Verdict::Undecided && fails => words += ": in part at most",
            _ => {}
        }
        if !claim.under.is_empty() && self.verdict != Verdict::Missing {
            words += &format!(", {}", claim.under);
        }
        words
    }
}

/// Decides a claim.
pub(crate) fn judge(claim: &Claim, numbers: &Numbers) -> Judged {
    let all = |statements: &[Statement]| {
        let decided = statements.iter().map(|s| decide(&s.check, numbers));
        let decided: Decided = decided.collect();
        let verdicts: Vec<Verdict> = decided.iter().map(|s| s.0).collect();
        (Verdict::of_all(&verdicts), decided)
    };
    let (plain, statements) = all(&claim.statements);
    let otherwise = claim.otherwise.as_ref().map(|other| all(&other.statements));
    let mut judged = Judged { verdict: plain, plain, statements, otherwise };
    if judged.turned() {
        judged.verdict = Verdict::Undecided;
    }
    judged
}

/// SI unit of a number, by its name.
fn unit(name: &str) -> &'static str {
    let of_acceleration = name.ends_with(".rms") || name.contains("peak") && !name.ends_with("force");
    match name {
        _ if name.ends_with("frequency") => "Hz",
        _ if name.ends_with("contact_length") => "m",
        _ if of_acceleration => "m/s^2",
        _ if name.contains("force") => "N",
        _ => "",
    }
}

fn found(case: &str, name: &str, number: Option<Estimate>) -> Found {
    Found {
        what: format!("{case}: {name}"),
        value: number.map(|n| n.value),
        interval: number.and_then(|n| n.interval).map(|i| (i.low, i.high)),
        unit: unit(name),
    }
}

fn quotient(what: String, ratio: Option<brinell::signal::ratio::Ratio>) -> Found {
    Found {
        what,
        value: ratio.map(|r| r.value),
        // Of two exact numbers it is no interval.
        interval: ratio.and_then(|r| r.interval).filter(|(low, high)| low < high),
        unit: "",
    }
}

fn decide(check: &Check, numbers: &Numbers) -> (Verdict, Vec<Found>) {
    let number = |(case, name): (&str, &str)| numbers.get(case, name);
    let ratio_of = |of, to| over(number(of)?, number(to)?);
    match *check {
        Check::Near { case, name, paper, share } => {
            let number = number((case, name));
            let verdict = number.map_or(Verdict::Missing, |n| {
                let ends = n.interval.map_or((n.value, n.value), |i| (i.low, i.high));
                between(Some(ends), paper * (1.0 - share), paper * (1.0 + share))
            });
            (verdict, vec![found(case, name, number)])
        }
        Check::Greater { of, than } => {
            let ratio = ratio_of(of, than);
            let [a, b] = [of, than].map(|of| found(of.0, of.1, number(of)));
            (greater(ratio), vec![a, b, quotient("ratio".into(), ratio)])
        }
        Check::Ratio { of, to, low, high } => {
            let ratio = ratio_of(of, to);
            let verdict = ratio.map_or(Verdict::Missing, |r| between(r.interval, low, high));
            (verdict, vec![quotient(quotient_words(of, to), ratio)])
        }
        Check::Differs { of, from, times } => {
            let ratio = ratio_of(of, from);
            let verdict = ratio.map_or(Verdict::Missing, |r| match r.interval {
                Some((low, high)) if low >= times || high <= 1.0 / times => Verdict::Holds,
                Some((low, high)) if low > 1.0 / times && high < times => Verdict::Fails,
                _ => Verdict::Undecided,
            });
            (verdict, vec![quotient(quotient_words(of, from), ratio)])
        }
        Check::Apart { ref cases, name, least } => apart(cases, name, least, numbers),
        Check::Follows { trend, ref cases, name } => followed(trend, cases, name, numbers),
        Check::Changes { ref cases, name, times } => match ends(cases, name, numbers) {
            Ok((most, least)) => {
                let ratio = over(most.1, least.1);
                let what = format!("{} / {}: {name}", most.0, least.0);
                let verdict = ratio.map_or(Verdict::Missing, |r| between(r.interval, times, f64::INFINITY));
                (verdict, vec![quotient(what, ratio)])
            }
            Err(missing) => (Verdict::Missing, vec![missing]),
        },
    }
}

/// Whether the largest of the cases exceeds the smallest by `least`.
fn apart(cases: &[&'static str], name: &'static str, least: f64, numbers: &Numbers) -> (Verdict, Vec<Found>) {
    match ends(cases, name, numbers) {
        Ok((most, smallest)) => {
            let half = |n: Estimate| n.interval.map_or(0.0, |i| 0.5 * (i.high - i.low));
            let apart = most.1.value - smallest.1.value;
            // Ends of independent intervals.
            let error = half(most.1).hypot(half(smallest.1));
            let interval = (apart - error, apart + error);
            let found = Found {
                what: format!("{} less {}: {name}", most.0, smallest.0),
                value: Some(apart),
                interval: Some(interval),
                unit: unit(name),
            };
            (between(Some(interval), least, f64::INFINITY), vec![found])
        }
        Err(missing) => (Verdict::Missing, vec![missing]),
    }
}

/// Whether the cases follow the trend, step by step.
fn followed(trend: Trend, cases: &[&'static str], name: &'static str, numbers: &Numbers) -> (Verdict, Vec<Found>) {
    let values: Vec<_> = cases.iter().map(|case| numbers.get(case, name)).collect();
    let step = |pair: &[Option<Estimate>]| over(pair[1]?, pair[0]?);
    let steps: Vec<_> = values.windows(2).map(step).collect();
    let all = cases.iter().zip(&values);
    let all = all.map(|(case, number)| found(case, name, *number)).collect();
    (follows(trend, &steps), all)
}

/// "a / b: name", or both names where they differ.
fn quotient_words(of: (&str, &str), to: (&str, &str)) -> String {
    if of.1 == to.1 {
        format!("{} / {}: {}", of.0, to.0, of.1)
    } else if of.0 == to.0 {
        format!("{}: {} / {}", of.0, of.1, to.1)
    } else {
        format!("{}: {} / {}: {}", of.0, of.1, to.0, to.1)
    }
}

type At = (&'static str, Estimate);

/// The cases with a number's largest and smallest value; what is missing where one has none.
fn ends(cases: &[&'static str], name: &str, numbers: &Numbers) -> Result<(At, At), Found> {
    let mut known: Vec<At> = Vec::new();
    for case in cases {
        match numbers.get(case, name) {
            Some(number) => known.push((*case, number)),
            None => return Err(found(case, name, None)),
        }
    }
    known.sort_by(|a, b| a.1.value.total_cmp(&b.1.value));
    match (known.last(), known.first()) {
        (Some(most), Some(least)) => Ok((*most, *least)),
        _ => Err(found("", name, None)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claim::Otherwise;
    use crate::verdict::Trend;
    use crate::{case, claims};
    use brinell::signal::Interval;

    fn scattered(center: f64) -> Estimate {
        Estimate { value: center, interval: Some(Interval { low: 0.98 * center, high: 1.02 * center, freedom: 29 }) }
    }

    fn of(check: &Check, values: &[(&str, f64)]) -> Verdict {
        let mut numbers = Numbers::default();
        for (case, value) in values {
            numbers.insert(case, "q.rms", scattered(*value));
        }
        decide(check, &numbers).0
    }

    #[test]
    fn prop_each_kind_of_check_comes_out_each_way() {
        let near = Check::Near { case: "a", name: "q.rms", paper: 10.0, share: 0.1 };
        assert_eq!(of(&near, &[("a", 10.2)]), Verdict::Holds);
        assert_eq!(of(&near, &[("a", 11.0)]), Verdict::Undecided);
        assert_eq!(of(&near, &[("a", 13.0)]), Verdict::Fails);
        assert_eq!(of(&near, &[]), Verdict::Missing);
        let greater = Check::Greater { of: ("a", "q.rms"), than: ("b", "q.rms") };
        assert_eq!(of(&greater, &[("a", 2.0), ("b", 1.0)]), Verdict::Holds);
        assert_eq!(of(&greater, &[("a", 1.0), ("b", 1.0)]), Verdict::Undecided);
        assert_eq!(of(&greater, &[("a", 1.0), ("b", 2.0)]), Verdict::Fails);
        assert_eq!(of(&greater, &[("a", 1.0)]), Verdict::Missing);
        let ratio = Check::Ratio { of: ("a", "q.rms"), to: ("b", "q.rms"), low: 1.0, high: 1.1 };
        assert_eq!(of(&ratio, &[("a", 1.05), ("b", 1.0)]), Verdict::Holds);
        assert_eq!(of(&ratio, &[("a", 1.1), ("b", 1.0)]), Verdict::Undecided);
        assert_eq!(of(&ratio, &[("a", 1.5), ("b", 1.0)]), Verdict::Fails);
        let follows = Check::Follows { trend: Trend::Rises, cases: vec!["a", "b", "c"], name: "q.rms" };
        assert_eq!(of(&follows, &[("a", 1.0), ("b", 2.0), ("c", 3.0)]), Verdict::Holds);
        assert_eq!(of(&follows, &[("a", 1.0), ("b", 2.0), ("c", 2.0)]), Verdict::Undecided);
        assert_eq!(of(&follows, &[("a", 1.0), ("b", 3.0), ("c", 2.0)]), Verdict::Fails);
        assert_eq!(of(&follows, &[("a", 1.0), ("c", 2.0)]), Verdict::Missing);
        let changes = Check::Changes { cases: vec!["a", "b", "c"], name: "q.rms", times: 1.5 };
        assert_eq!(of(&changes, &[("a", 2.0), ("b", 1.0), ("c", 1.5)]), Verdict::Holds);
        assert_eq!(of(&changes, &[("a", 1.5), ("b", 1.0), ("c", 1.2)]), Verdict::Undecided);
        assert_eq!(of(&changes, &[("a", 1.1), ("b", 1.0), ("c", 1.0)]), Verdict::Fails);
        assert_eq!(of(&changes, &[("a", 1.1)]), Verdict::Missing);
        let differs = Check::Differs { of: ("a", "q.rms"), from: ("b", "q.rms"), times: 1.5 };
        assert_eq!(of(&differs, &[("a", 2.0), ("b", 1.0)]), Verdict::Holds);
        assert_eq!(of(&differs, &[("a", 1.0), ("b", 2.0)]), Verdict::Holds);
        assert_eq!(of(&differs, &[("a", 1.5), ("b", 1.0)]), Verdict::Undecided);
        assert_eq!(of(&differs, &[("a", 1.1), ("b", 1.0)]), Verdict::Fails);
        assert_eq!(of(&differs, &[("a", 1.1)]), Verdict::Missing);
        let apart = Check::Apart { cases: vec!["a", "b", "c"], name: "q.rms", least: 0.5 };
        assert_eq!(of(&apart, &[("a", 2.0), ("b", 1.0), ("c", 1.5)]), Verdict::Holds);
        assert_eq!(of(&apart, &[("a", 1.5), ("b", 1.0), ("c", 1.2)]), Verdict::Undecided);
        assert_eq!(of(&apart, &[("a", 1.1), ("b", 1.0), ("c", 1.0)]), Verdict::Fails);
        assert_eq!(of(&apart, &[("a", 1.1)]), Verdict::Missing);
    }

    #[test]
    fn prop_another_reading_makes_a_failure_undecided_and_says_so() {
        let as_read =
            vec![Statement { words: "near", check: Check::Near { case: "a", name: "q.rms", paper: 10.0, share: 0.1 } }];
        let other =
            vec![Statement { words: "near", check: Check::Near { case: "b", name: "q.rms", paper: 10.0, share: 0.1 } }];
        let claim = Claim {
            statements: as_read,
            under: "under a guess",
            otherwise: Some(Otherwise { words: "if b", statements: other }),
            ..Claim::default()
        };
        let words = |a: f64, b: Option<f64>| {
            let mut numbers = Numbers::default();
            numbers.insert("a", "q.rms", scattered(a));
            if let Some(b) = b {
                numbers.insert("b", "q.rms", scattered(b));
            }
            judge(&claim, &numbers).words(&claim)
        };
        assert_eq!(words(20.0, Some(10.0)), "undecided: holds if b, under a guess");
        assert_eq!(words(20.0, Some(20.0)), "does not hold, under a guess");
        assert_eq!(words(20.0, None), "does not hold, under a guess");
        assert_eq!(words(10.0, Some(20.0)), "holds, under a guess");
        assert_eq!(words(11.0, Some(10.0)), "undecided: holds if b, under a guess");
        assert_eq!(words(11.0, None), "undecided, under a guess");
    }

    #[test]
    fn prop_what_fails_beside_the_undecided_says_so() {
        let near = |case| Statement { words: "", check: Check::Near { case, name: "q.rms", paper: 10.0, share: 0.1 } };
        let claim = Claim { statements: vec![near("a"), near("b")], ..Claim::default() };
        let words = |a: f64, b: f64| {
            let mut numbers = Numbers::default();
            numbers.insert("a", "q.rms", scattered(a));
            numbers.insert("b", "q.rms", scattered(b));
            judge(&claim, &numbers).words(&claim)
        };
        assert_eq!(words(20.0, 11.0), "undecided: in part at most");
        assert_eq!(words(10.0, 11.0), "undecided");
        assert_eq!(words(20.0, 20.0), "does not hold");
        assert_eq!(words(20.0, 10.0), "holds in part");
    }

    #[test]
    fn prop_claims_are_whole() {
        for (k, claim) in claims().enumerate() {
            assert!(claims().take(k).all(|other| other.id != claim.id), "{}", claim.id);
            assert!(claim.cases().iter().all(|id| case(id).is_some()), "{}", claim.id);
            // What cannot be checked says why.
            assert!(!claim.statements.is_empty() || !claim.note.is_empty(), "{}", claim.id);
            let judged = judge(claim, &Numbers::default());
            let nothing = if claim.statements.is_empty() { Verdict::NotCheckable } else { Verdict::Missing };
            assert_eq!(judged.verdict, nothing, "{}", claim.id);
        }
    }
}
