//! The claims under each unstated assumption, and the search for a set of assumptions that agrees best.

mod tell;

use super::points::{Point, numbers, point};
use crate::campaign::{Ledger, Task};
use crate::failure::Failure;
use brinell::calibrate::{Settings, Unfit, fit, least_budget};
use brinell::paper::{
    Aspect, CASES, Claim, Distance, Draw, Judged, Length, Numbers, SEARCHED, VARIANTS, Variant,
    Verdict, answers, axes, case, claims, distance, draw, held, judge, targets,
};

/// The search is a fixed one.
const SEED: u64 = 2023;
/// Sets that are looked at on all cases, and how far apart they lie at least along some axis of the cube.
const BEST: usize = 5;
const APART: f64 = 0.15;

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
    /// Sets that the search may look at.
    budget: usize,
    length: Length,
}

/// A set that the search looked at, with its runs.
pub(super) type Drawn = (Draw, Vec<Point>);

/// A set of assumptions, looked at on all cases.
pub(super) struct Candidate {
    draw: Draw,
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
        Ok(Self {
            varied: varied.collect::<Result<_, Failure>>()?,
            budget: if quick { least_budget(axes()) } else { 96 },
            length,
        })
    }

    /// Sets that the search looks at, at most.
    pub(super) fn budget(&self) -> usize {
        self.budget
    }

    /// What runs first.
    pub(super) fn tasks(&self) -> impl Iterator<Item = &Task> {
        let points = self.varied.iter().flat_map(|v| &v.points);
        points.map(|point| &point.task)
    }

    /// Sets of the search, in the order in which they were looked at. `run` sees to it that what it gets is done, and says whether it was
    /// interrupted; then there are none.
    pub(super) fn search(
        &self,
        ledger: &mut Ledger,
        mut run: impl FnMut(&[Drawn], &mut Ledger) -> Result<bool, Failure>,
    ) -> Result<Option<Vec<Drawn>>, Failure> {
        let (mut all, mut failure) = (Vec::new(), None);
        let mut ask = |places: &[Vec<f64>]| {
            let made = places.iter().enumerate().map(|(k, place)| {
                let draw = draw(all.len() + k + 1, place);
                let cases = SEARCHED.iter().filter_map(|id| case(id));
                let points = cases.map(|case| point(case, &draw.settings, self.length));
                let points = points.collect::<Result<_, Failure>>()?;
                Ok((draw, points))
            });
            let done = made.collect::<Result<Vec<Drawn>, Failure>>();
            let done = done.and_then(|batch| Ok((run(&batch, ledger)?, batch)));
            let batch = match done {
                Ok((false, batch)) => batch,
                Ok((true, _)) => return Err(Unfit::Interrupted),
                Err(error) => {
                    failure = Some(error);
                    return Err(Unfit::Interrupted);
                }
            };
            let answered = batch.iter().map(|one| answers(&read(one, ledger)));
            let answered = answered.collect();
            all.extend(batch);
            Ok(answered)
        };
        let settings = Settings {
            seed: SEED,
            budget: self.budget,
        };
        let targets = targets();
        let found = fit(axes(), &targets, settings, &mut ask);
        match (failure, found) {
            (Some(failure), _) => Err(failure),
            (None, Err(Unfit::Interrupted)) => Ok(None),
            // Without one that came to its end there is nothing to choose from, and that is told.
            (None, _) => Ok(Some(all)),
        }
    }

    /// The best sets, on all cases: what runs then.
    pub(super) fn finalists(
        &self,
        drawn: &[Drawn],
        ledger: &Ledger,
    ) -> Result<Vec<Finalist>, Failure> {
        let scored = drawn.iter().enumerate();
        let mut scored: Vec<(f64, usize)> = scored
            .filter_map(|(k, one)| Some((score(&read(one, ledger))?, k)))
            .collect();
        scored.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        // Neighbours would say the same of the other cases.
        let mut best: Vec<&Draw> = Vec::new();
        for (_, k) in scored {
            let one = &drawn[k].0;
            let near = |d: &&Draw| {
                let far = d.place.iter().zip(&one.place).map(|(a, b)| (a - b).abs());
                far.fold(0.0, f64::max) < APART
            };
            if best.len() < BEST && !best.iter().any(near) {
                best.push(one);
            }
        }
        let finalist = |draw: &Draw| {
            let points = CASES
                .iter()
                .map(|case| point(case, &draw.settings, self.length));
            Ok(Finalist {
                points: points.collect::<Result<_, Failure>>()?,
                draw: draw.clone(),
            })
        };
        best.into_iter().map(finalist).collect()
    }

    pub(super) fn finish(
        &self,
        drawn: usize,
        finalists: Vec<Finalist>,
        ledger: &Ledger,
    ) -> Sensitivity {
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
            let numbers = of_draw(&f.draw, &f.points, ledger);
            Some(Candidate {
                distance: distance(&numbers)?,
                judged: claims()
                    .map(|claim| (claim, judge(claim, &numbers)))
                    .collect(),
                draw: f.draw,
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
            drawn,
            turns: self.length.turns,
        }
    }
}

/// A set of assumptions on its way to all cases.
pub(super) struct Finalist {
    draw: Draw,
    pub(super) points: Vec<Point>,
}

fn read((draw, points): &Drawn, ledger: &Ledger) -> Numbers {
    of_draw(draw, points, ledger)
}

fn of_draw(draw: &Draw, points: &[Point], ledger: &Ledger) -> Numbers {
    let plain = numbers(points, ledger);
    if draw.filtered {
        plain.behind_filter()
    } else {
        plain
    }
}

fn owned(settings: &[(&str, &str)]) -> Vec<(String, String)> {
    let own = |(key, value): &(&str, &str)| ((*key).to_owned(), (*value).to_owned());
    settings.iter().map(own).collect()
}

/// Share of the statements about the searched cases that do not hold, plus the distance from the paper's RMS values.
fn score(numbers: &Numbers) -> Option<f64> {
    Some(1.0 - held(numbers) + distance(numbers)?.rms)
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
