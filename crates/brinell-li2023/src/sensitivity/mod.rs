//! The claims under each assumption made otherwise, and the search for a set of assumptions that agrees best.

mod chapters;
mod tables;

#[cfg(test)]
pub(crate) use chapters::{intro, ranges};

use crate::cases::owned;
use crate::points::points;
use crate::runs::numbers;
use crate::{
    CASES, Claim, Distance, Draw, Error, Judged, Length, Numbers, Point, RECORDS, Reading, Record, Runs, SEARCHED,
    Stage, VARIANTS, Variant, Verdict, answers, axes, case, claims, distance, draw, held, judge, targets,
};
use brinell_study::calibrate::{Settings, Unfit, fit, least_budget};
use std::ops::ControlFlow;

/// The search is a fixed one.
const SEED: u64 = 2023;
/// Sets that are looked at on all cases, and how far apart they lie at least along some axis of the cube.
const BEST: usize = 5;
const APART: f64 = 0.15;

/// The searches: one chooses the stretch of the record too, the other keeps to the steady part, since the first goes
/// where the paper's figures are met most easily.
const SCOPES: [(Option<Record>, usize); 2] = [(None, 640), (Some(Record::Steady), 460)];

/// An assumption that turns a verdict.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Flip {
    pub(crate) variant: &'static Variant,
    pub(crate) verdict: Verdict,
}

/// A variant's points.
struct Varied {
    variant: &'static Variant,
    points: Vec<Point>,
}

/// Everything that the sensitivity needs to run.
pub(crate) struct Plan {
    varied: Vec<Varied>,
    quick: bool,
    length: Length,
}

/// A set that a search looked at, with its runs.
type Drawn = (Draw, Vec<Point>);

/// What was found under one assumption made otherwise.
struct Tried {
    variant: &'static Variant,
    /// Of every claim.
    judged: Vec<Judged>,
    numbers: Numbers,
}

/// What the sets of one kind of record came to.
struct Nearest {
    record: Record,
    sets: usize,
    /// Estimate of the set that is nearest to the paper's RMS values.
    best: Option<(usize, Distance)>,
}

/// A set of assumptions, looked at on all cases.
struct Candidate {
    draw: Draw,
    distance: Distance,
    judged: Vec<(&'static Claim, Judged)>,
}

impl Candidate {
    fn held(&self) -> usize {
        held_of(self.judged.iter().map(|(_, judged)| judged))
    }

    fn checkable(&self) -> usize {
        let checkable = |(claim, judged): &&(&Claim, Judged)| claim.counts() && judged.plain != Verdict::NotCheckable;
        self.judged.iter().filter(checkable).count()
    }
}

impl Tried {
    fn held(&self) -> usize {
        held_of(&self.judged)
    }
}

/// How many of all claims hold that count; theirs are all verdicts in the order of the claims.
fn held_of<'a>(judged: impl IntoIterator<Item = &'a Judged>) -> usize {
    let holds = claims().zip(judged).filter(|(claim, j)| claim.counts() && j.plain == Verdict::Holds);
    holds.count()
}

/// What came out.
pub(crate) struct Sensitivity {
    /// In the order of [`VARIANTS`].
    variants: Vec<Tried>,
    /// The best sets of the search, best first.
    candidates: Vec<Candidate>,
    /// Sets that were drawn.
    drawn: usize,
    /// By the stretch of the record.
    nearest: Vec<Nearest>,
    length: Length,
}

impl Plan {
    pub(crate) fn new(quick: bool) -> Result<Self, Error> {
        let length = if quick { Length::QUICK_VARIANT } else { Length::VARIANT };
        let varied = VARIANTS.iter().map(|variant| {
            let points = points(CASES.iter(), &owned(&variant.settings), variant.outline, length)?;
            Ok(Varied { variant, points })
        });
        Ok(Self { varied: varied.collect::<Result<_, Error>>()?, quick, length })
    }

    fn budget(&self, scope: (Option<Record>, usize)) -> usize {
        let least = least_budget(axes(scope.0));
        if self.quick { least } else { scope.1.max(least) }
    }

    /// Sets that the searches look at, at most.
    fn sets(&self) -> usize {
        SCOPES.iter().map(|scope| self.budget(*scope)).sum()
    }

    /// What runs first.
    pub(crate) fn points(&self) -> impl Iterator<Item = &Point> {
        self.varied.iter().flat_map(|v| &v.points)
    }

    /// The searches, the best sets in all cases, and everything judged; the runs of [`Plan::points`] are made. `None`
    /// where it was interrupted.
    pub(crate) fn run<R: Runs>(&self, runs: &mut R) -> Result<Option<Sensitivity>, R::Error> {
        runs.search_begins(self.sets());
        let mut drawn = Vec::new();
        for scope in SCOPES {
            if self.search_within(scope, &mut drawn, runs)?.is_break() {
                return Ok(None);
            }
        }
        let finalists = self.finalists(&drawn, runs)?;
        let points: Vec<&Point> = finalists.iter().flat_map(|(_, points)| points).collect();
        let flow = runs.make(&points, Stage::Best)?;
        Ok(flow.is_continue().then(|| self.finish(&drawn, finalists, runs)))
    }

    /// One search: its sets are added to `all` in the order in which they were looked at.
    fn search_within<R: Runs>(
        &self,
        scope: (Option<Record>, usize),
        all: &mut Vec<Drawn>,
        runs: &mut R,
    ) -> Result<ControlFlow<()>, R::Error> {
        let mut failure = None;
        let mut ask = |places: &[Vec<f64>]| {
            let made = places.iter().enumerate().map(|(k, place)| {
                let draw = draw(all.len() + k + 1, place, scope.0);
                let cases = SEARCHED.iter().filter_map(|id| case(id));
                let points = points(cases, &draw.settings, draw.outline, Length::START)?;
                Ok((draw, points))
            });
            let batch = made.collect::<Result<Vec<Drawn>, R::Error>>();
            let done = batch.and_then(|batch| {
                let points: Vec<&Point> = batch.iter().flat_map(|(_, points)| points).collect();
                Ok((runs.make(&points, Stage::Search)?, batch))
            });
            let batch = match done {
                Ok((ControlFlow::Continue(()), batch)) => batch,
                Ok((ControlFlow::Break(()), _)) => return Err(Unfit::Interrupted),
                Err(error) => {
                    failure = Some(error);
                    return Err(Unfit::Interrupted);
                }
            };
            let answered = batch.iter().map(|one| answers(&read(one, runs)));
            let answered = answered.collect();
            all.extend(batch);
            Ok(answered)
        };
        let settings = Settings { seed: SEED, budget: self.budget(scope) };
        let targets = targets();
        let found = fit(axes(scope.0), &targets, settings, &mut ask);
        match (failure, found) {
            (Some(failure), _) => Err(failure),
            (None, Err(Unfit::Interrupted)) => Ok(ControlFlow::Break(())),
            // Without one that came to its end there is nothing to choose from, and the results say so.
            (None, _) => Ok(ControlFlow::Continue(())),
        }
    }

    /// The best sets, on all cases: what runs then.
    fn finalists(&self, drawn: &[Drawn], runs: &impl Runs) -> Result<Vec<Drawn>, Error> {
        let scored = drawn.iter().enumerate();
        let mut scored: Vec<(f64, usize)> = scored.filter_map(|(k, one)| Some((score(&read(one, runs))?, k))).collect();
        scored.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        // Neighbours would say the same of the other cases.
        let mut best: Vec<&Draw> = Vec::new();
        for (_, k) in scored {
            let one = &drawn[k].0;
            let near = |d: &&Draw| {
                // Sets of different searches have different axes.
                let same = (d.outline, d.reading) == (one.outline, one.reading);
                let far = d.place.iter().zip(&one.place).map(|(a, b)| (a - b).abs());
                same && far.fold(0.0, f64::max) < APART
            };
            if best.len() < BEST && !best.iter().any(near) {
                best.push(one);
            }
        }
        let finalist =
            |draw: &Draw| Ok((draw.clone(), points(CASES.iter(), &draw.settings, draw.outline, self.length)?));
        best.into_iter().map(finalist).collect()
    }

    fn finish(&self, drawn: &[Drawn], finalists: Vec<Drawn>, runs: &impl Runs) -> Sensitivity {
        let variants = self.varied.iter().map(|v| {
            let plain = numbers(&v.points, runs);
            let read = plain.read(v.variant.reading);
            Tried { variant: v.variant, judged: claims().map(|claim| judge(claim, &read)).collect(), numbers: plain }
        });
        let candidates = finalists.into_iter().filter_map(|finalist| {
            let numbers = read(&finalist, runs);
            Some(Candidate {
                distance: distance(&numbers)?,
                judged: claims().map(|claim| (claim, judge(claim, &numbers))).collect(),
                draw: finalist.0,
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
            drawn: drawn.len(),
            nearest: nearest(drawn, runs),
            length: self.length,
        }
    }
}

/// The nearest set of each stretch of the record, the steady part first.
fn nearest(drawn: &[Drawn], runs: &impl Runs) -> Vec<Nearest> {
    let mut all: Vec<Nearest> = Vec::new();
    for record in RECORDS {
        let mine: Vec<&Drawn> = drawn.iter().filter(|d| d.0.reading.record == *record).collect();
        let known = mine.iter().filter_map(|one| Some((one.0.number, distance(&read(one, runs))?)));
        all.push(Nearest { record: *record, sets: mine.len(), best: known.min_by(|a, b| a.1.rms.total_cmp(&b.1.rms)) });
    }
    all
}

fn read((draw, points): &Drawn, runs: &impl Runs) -> Numbers {
    numbers(points, runs).read(draw.reading)
}

/// Share of the statements about the searched cases that do not hold, plus the distance from the paper's RMS values.
fn score(numbers: &Numbers) -> Option<f64> {
    Some(1.0 - held(numbers) + distance(numbers)?.rms)
}

/// Whether one decided verdict is another than the other; what is open on either side turns nothing.
fn turns(verdict: Verdict, other: Verdict) -> bool {
    let decided = |v| matches!(v, Verdict::Holds | Verdict::Partly | Verdict::Fails);
    decided(verdict) && decided(other) && verdict != other
}

impl Sensitivity {
    /// The verdict of a claim's own statements in runs as short as those under the assumptions, nothing changed.
    pub(crate) fn unchanged(&self, place: usize) -> Option<Verdict> {
        self.variants.first().map(|tried| tried.judged[place].plain)
    }

    /// Assumptions that turn a claim's verdict, compared with runs of the same length in which nothing is changed.
    pub(crate) fn flips(&self, place: usize) -> Vec<Flip> {
        let unchanged = self.unchanged(place);
        let all = self.variants.iter().filter_map(|tried| {
            let other = tried.judged[place].plain;
            turns(unchanged?, other).then_some(Flip { variant: tried.variant, verdict: other })
        });
        all.collect()
    }

    /// The verdicts of a claim under every assumption that has one, that of the baseline first.
    pub(crate) fn verdicts(&self, id: &str) -> Vec<(&'static Variant, Verdict)> {
        let place = claims().position(|claim| claim.id == id);
        let of = |tried: &Tried| Some((tried.variant, tried.judged[place?].plain));
        self.variants.iter().filter_map(of).filter(|(_, verdict)| *verdict != Verdict::Missing).collect()
    }

    /// A number of a case under an assumption.
    pub(crate) fn value(&self, variant: &str, case: &str, name: &str) -> Option<f64> {
        let tried = self.variants.iter().find(|t| t.variant.id == variant)?;
        tried.numbers.get(case, name).map(|n| n.value)
    }

    /// Smallest and largest ratio of a number in two cases, both of the steady part, over the assumptions under which
    /// that is what is read.
    pub(crate) fn ratios(&self, of: &str, to: &str, name: &str) -> Option<(f64, f64)> {
        let steady = self.variants.iter().filter(|t| t.variant.reading == Reading::USUAL);
        let ratio = |tried: &Tried| {
            let (a, b) = (tried.numbers.get(of, name)?, tried.numbers.get(to, name)?);
            (b.value > 0.0).then(|| a.value / b.value)
        };
        let all: Vec<f64> = steady.filter_map(ratio).collect();
        let least = all.iter().copied().min_by(f64::total_cmp)?;
        Some((least, all.iter().copied().max_by(f64::total_cmp)?))
    }

    /// Sets that were looked at with the steady part and with a record from t = 0, and how near the nearest of each
    /// came.
    pub(crate) fn nearest(&self) -> [(usize, Option<&Distance>); 2] {
        [true, false].map(|steady| {
            let mine = || self.nearest.iter().filter(move |n| (n.record == Record::Steady) == steady);
            let best = mine().filter_map(|n| n.best.as_ref().map(|b| &b.1));
            let best = best.min_by(|a, b| a.rms.total_cmp(&b.rms));
            (mine().map(|n| n.sets).sum(), best)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_only_decided_verdicts_turn() {
        use Verdict::{Fails, Holds, Missing, NotCheckable, Partly, Undecided};
        let decided = [Holds, Partly, Fails];
        for (k, a) in decided.into_iter().enumerate() {
            for (j, b) in decided.into_iter().enumerate() {
                assert_eq!(turns(a, b), j != k, "{a:?} {b:?}");
            }
            for open in [Undecided, Missing, NotCheckable] {
                assert!(!turns(a, open) && !turns(open, a), "{a:?} {open:?}");
            }
        }
    }

    #[test]
    fn prop_flips_compare_with_runs_of_the_same_length() {
        let place = claims().position(|claim| !claim.statements.is_empty()).unwrap();
        let tried = |variant: &'static Variant, verdict: Verdict| {
            let numbers = Numbers::default();
            let mut judged: Vec<Judged> = claims().map(|claim| judge(claim, &numbers)).collect();
            judged[place].plain = verdict;
            Tried { variant, judged, numbers }
        };
        let flips = |verdicts: [Verdict; 3]| {
            let variants = VARIANTS.iter().zip(verdicts).map(|(variant, verdict)| tried(variant, verdict));
            let sensitivity = Sensitivity {
                variants: variants.collect(),
                candidates: vec![],
                drawn: 0,
                nearest: vec![],
                length: Length::VARIANT,
            };
            sensitivity.flips(place).iter().map(|flip| flip.variant.id).collect::<Vec<_>>()
        };
        use Verdict::{Fails, Holds, Undecided};
        assert_eq!(flips([Fails, Fails, Holds]), [VARIANTS[2].id]);
        assert!(flips([Undecided, Fails, Holds]).is_empty());
        assert!(flips([Holds, Undecided, Holds]).is_empty());
    }
}
