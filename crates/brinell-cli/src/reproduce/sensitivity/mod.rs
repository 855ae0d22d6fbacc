//! The claims under each unstated assumption, and the search for a set of assumptions that agrees best.

mod tell;

use super::points::{FromPaper, Point, numbers, point};
use crate::campaign::{Ledger, Task};
use crate::failure::Failure;
use brinell::paper::{
    Aspect, CASES, Claim, Design, Distance, Draw, Hypercube, Judged, Length, Numbers, SEARCHED,
    VARIANTS, Variant, Verdict, case, claims, distance, judge,
};

/// The search is a fixed one.
const SEED: u64 = 2023;
/// Sets that are looked at on all cases.
const BEST: usize = 3;

/// An assumption that turns a verdict.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flip {
    pub(super) variant: &'static Variant,
    pub(super) verdict: Verdict,
}

/// A variant's points; that of the filter has none of its own.
struct Varied {
    variant: &'static Variant,
    points: Vec<Point>,
}

/// Everything that the sensitivity needs to run.
pub(super) struct Plan {
    varied: Vec<Varied>,
    drawn: Vec<(Draw, Vec<Point>)>,
    length: Length,
}

/// A set of assumptions, looked at on all cases.
pub(super) struct Candidate {
    draw: Draw,
    /// Whether the outer ring is looked at behind the anti-alias filter.
    filtered: bool,
    distance: Distance,
    judged: Vec<(&'static Claim, Judged)>,
}

impl Candidate {
    fn held(&self) -> usize {
        let holds = |j: &&(_, Judged)| j.1.verdict == Verdict::Holds;
        self.judged.iter().filter(holds).count()
    }

    fn checkable(&self) -> usize {
        let checkable = |j: &&(_, Judged)| j.1.verdict != Verdict::NotCheckable;
        self.judged.iter().filter(checkable).count()
    }
}

/// What came out.
pub(super) struct Sensitivity {
    /// Each variant with the verdict of every claim.
    variants: Vec<(&'static Variant, Vec<Judged>)>,
    /// The best sets of the search, best first.
    candidates: Vec<Candidate>,
    /// Sets that were drawn.
    drawn: usize,
    turns: u32,
}

impl Plan {
    pub(super) fn new(quick: bool) -> Result<Self, Failure> {
        let length = if quick {
            Length::QUICK_VARIANT
        } else {
            Length::VARIANT
        };
        let varied = VARIANTS.iter().map(|variant| {
            let settings = owned(variant.settings);
            let points = CASES.iter().map(|case| point(case, &settings, length));
            Ok(Varied {
                variant,
                points: points.collect::<Result<_, Failure>>()?,
            })
        });
        let varied = varied.collect::<Result<_, Failure>>()?;
        let draws = Hypercube::new(if quick { 12 } else { 48 }, SEED).propose(&[]);
        let drawn = draws.into_iter().map(|draw| {
            let searched = SEARCHED.iter().filter_map(|id| case(id));
            let points = searched.map(|case| point(case, &draw.settings, length));
            let points = points.collect::<Result<_, Failure>>()?;
            Ok((draw, points))
        });
        Ok(Self {
            varied,
            drawn: drawn.collect::<Result<_, Failure>>()?,
            length,
        })
    }

    /// What runs first: variants and the cheap part of the search.
    pub(super) fn tasks(&self) -> impl Iterator<Item = &Task> {
        let varied = self.varied.iter().flat_map(|v| &v.points);
        let drawn = self.drawn.iter().flat_map(|d| &d.1);
        varied.chain(drawn).map(|point| &point.task)
    }

    /// The best sets so far, on all cases: what runs then. A set counts once, with the better reading of the filter.
    pub(super) fn finalists(&self, ledger: &Ledger) -> Result<Vec<Finalist>, Failure> {
        let mut scored: Vec<(f64, usize, bool)> = Vec::new();
        for (k, (_, points)) in self.drawn.iter().enumerate() {
            let plain = numbers(points, ledger);
            let both = [(plain.clone(), false), (plain.behind_filter(), true)];
            let scores = both
                .iter()
                .filter_map(|(n, filtered)| Some((score(n)?, k, *filtered)));
            scored.extend(scores.min_by(|a, b| a.0.total_cmp(&b.0)));
        }
        scored.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let best = scored.into_iter().take(BEST);
        best.map(|(_, k, filtered)| {
            let draw = self.drawn[k].0.clone();
            let points = CASES
                .iter()
                .map(|case| point(case, &draw.settings, self.length));
            Ok(Finalist {
                points: points.collect::<Result<_, Failure>>()?,
                draw,
                filtered,
            })
        })
        .collect()
    }

    pub(super) fn finish(&self, finalists: Vec<Finalist>, ledger: &Ledger) -> Sensitivity {
        let judged = |n: &Numbers| claims().map(|claim| judge(claim, n)).collect();
        let variants = self.varied.iter().map(|v| {
            let plain = numbers(&v.points, ledger);
            let numbers = match v.variant.aspect {
                Aspect::Filter => plain.behind_filter(),
                _ => plain,
            };
            (v.variant, judged(&numbers))
        });
        let candidates = finalists.into_iter().filter_map(|f| {
            let plain = numbers(&f.points, ledger);
            let numbers = if f.filtered {
                plain.behind_filter()
            } else {
                plain
            };
            Some(Candidate {
                distance: distance(&numbers)?,
                judged: claims()
                    .map(|claim| (claim, judge(claim, &numbers)))
                    .collect(),
                draw: f.draw,
                filtered: f.filtered,
            })
        });
        let mut candidates: Vec<Candidate> = candidates.collect();
        candidates.sort_by(|a, b| {
            let by_distance = a.distance.rms.total_cmp(&b.distance.rms);
            b.held().cmp(&a.held()).then(by_distance)
        });
        Sensitivity {
            variants: variants.collect(),
            candidates,
            drawn: self.drawn.len(),
            turns: self.length.turns,
        }
    }
}

/// A set of assumptions on its way to all cases.
pub(super) struct Finalist {
    draw: Draw,
    filtered: bool,
    pub(super) points: Vec<Point>,
}

fn owned(settings: &[(&str, &str)]) -> Vec<(String, String)> {
    let own = |(key, value): &(&str, &str)| ((*key).to_owned(), (*value).to_owned());
    settings.iter().map(own).collect()
}

/// Share of the statements that do not hold, of those that the searched cases decide, plus the distance from the paper's RMS values.
fn score(numbers: &Numbers) -> Option<f64> {
    let distance = distance(numbers)?;
    let searched = |claim: &&Claim| claim.cases().iter().all(|case| SEARCHED.contains(case));
    let verdicts: Vec<Verdict> = claims()
        .filter(searched)
        .flat_map(|claim| judge(claim, numbers).statements)
        .map(|(verdict, _)| verdict)
        .collect();
    let off = verdicts.iter().filter(|v| **v != Verdict::Holds).count();
    Some(off as f64 / verdicts.len().max(1) as f64 + distance.rms)
}

impl Sensitivity {
    /// Assumptions under which a claim that held fails, or one that failed holds.
    pub(super) fn flips(&self, place: usize, verdict: Verdict) -> Vec<Flip> {
        let turned = |other: Verdict| {
            use Verdict::{Fails, Holds, Partly};
            matches!(
                (verdict, other),
                (Holds, Fails | Partly) | (Fails, Holds | Partly) | (Partly, Holds | Fails)
            )
        };
        let all = self.variants.iter().filter_map(|(variant, judged)| {
            let other = judged[place].verdict;
            turned(other).then_some(Flip {
                variant,
                verdict: other,
            })
        });
        all.collect()
    }
}

/// Points whose signals nobody asks for: only their numbers are kept.
pub(super) fn open<'a>(
    tasks: impl Iterator<Item = &'a Task>,
    work: &FromPaper,
    ledger: &Ledger,
    already: &mut Vec<Task>,
) {
    for task in tasks {
        let known = already.iter().any(|t| t.fingerprint == task.fingerprint);
        if !known && !work.is_done(task, ledger) {
            already.push(task.clone());
        }
    }
}
