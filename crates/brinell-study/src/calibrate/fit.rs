//! One fit from its first point to the Jacobian at its best: who asks for how many runs, and what they weigh.
//!
//! A quarter of the runs is spread over the whole cube, a fifth flies with the swarm, and the rest goes downhill from
//! the best places; so many are kept back that each key can be moved to both sides of the best point, twice where the
//! budget allows it.

use super::identify::{Identified, column_noise, identify};
use super::search::{Ask, Halt, STEP, around, chi_square, latin_hypercube, local, slopes, swarm};
use super::target::{Answer, Target, residuals};
use std::cell::RefCell;

/// Runs a batch of points of the unit cube: answers in the order of the points, `None` for a run that failed; it may
/// refuse with [`Unfit::Interrupted`].
pub type Run<'a> = dyn FnMut(&[Vec<f64>]) -> Result<Vec<Option<Vec<Answer>>>, Unfit> + 'a;

/// How a search is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Settings {
    /// Random seed of the points of the cube.
    pub seed: u64,
    /// Runs at most, [`least_budget`] or more.
    pub budget: usize,
}

/// Why a point was requested.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Spread over the whole.
    Start,
    /// The swarm's.
    Swarm,
    /// Downhill.
    Local,
    /// Beside the best.
    Around,
}

impl Stage {
    /// For tables.
    pub fn word(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Swarm => "swarm",
            Self::Local => "local",
            Self::Around => "around",
        }
    }
}

/// A point that was run.
#[derive(Debug, Clone, PartialEq)]
pub struct Evaluation {
    /// Where, in the unit cube.
    pub place: Vec<f64>,
    /// What for.
    pub stage: Stage,
    /// What came of it, for each target; `None` where the run failed.
    pub answers: Option<Vec<Answer>>,
    /// Sum of squares of the residuals; infinite where the run failed.
    pub chi_square: f64,
}

/// The outcome.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// All runs, in the order in which they were requested.
    pub evaluations: Vec<Evaluation>,
    /// Standard uncertainty that each target weighs with: its own, and a run's.
    pub sigma: Vec<f64>,
    /// A run's share of it.
    pub own: Vec<f64>,
    /// The run with the smallest sum of squares.
    pub best: usize,
    /// Residuals there.
    pub residuals: Vec<f64>,
    /// The run around which differences were taken: the best, or one whose sum of squares is larger by less than 1.
    pub centre: usize,
    /// Half the distance of each key's difference, in ranges.
    pub steps: Vec<f64>,
    /// Searches downhill that the budget ended, or that did not begin.
    pub cut_off: usize,
    /// What the differences say.
    pub identified: Identified,
}

/// So many half intervals from the best point the rise of chi-square should be its square times that at the interval's
/// end: nine times, which the runs' own uncertainty does not hide.
const FAR: f64 = 3.0;

impl Fit {
    /// Runs that meet the targets as well as a 95 % interval allows, with their numbers from 0.
    fn as_well(&self) -> impl Iterator<Item = (usize, &Evaluation)> {
        let most = self.evaluations[self.best].chi_square + self.identified.rise;
        self.evaluations.iter().enumerate().filter(move |(_, e)| e.chi_square <= most)
    }

    /// The interval of `key` by differences about the best point, widened to the runs that meet the targets as well.
    pub fn interval(&self, key: usize) -> (f64, f64) {
        let (place, half) = (self.evaluations[self.best].place[key], self.identified.half_widths[key]);
        let places = self.as_well().map(|(_, e)| e.place[key]);
        places.fold((place - half, place + half), |(low, high), at| (low.min(at), high.max(at)))
    }

    /// Where linear least squares expects the best place of `key`, in the unit interval, where that is outside its interval
    /// about the best point: the search has not come to its end there, or the targets are not linear.
    pub fn elsewhere(&self, key: usize) -> Option<f64> {
        let expected = self.evaluations[self.centre].place[key] + self.identified.step[key];
        let off = (expected - self.evaluations[self.best].place[key]).abs();
        (off > self.identified.half_widths[key]).then_some(expected)
    }

    /// A run that meets the targets as well as the interval of `key` allows, far outside this interval: the targets do
    /// not depend linearly on the keys between the two, and differences about the best run do not tell how sure the key
    /// is. Of several the best.
    pub fn rival(&self, key: usize) -> Option<usize> {
        let (place, far) = (self.evaluations[self.best].place[key], FAR * self.identified.half_widths[key]);
        let rivals = self.as_well().filter(|(_, e)| (e.place[key] - place).abs() > far);
        rivals.min_by(|a, b| a.1.chi_square.total_cmp(&b.1.chi_square)).map(|(k, _)| k)
    }
}

/// Why there is no outcome.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Unfit {
    /// Somebody stopped it.
    #[error("interrupted")]
    Interrupted,
    /// No point of the start came to its end.
    #[error("none of the {0} runs spread over the bounds came to its end")]
    AllFailed(usize),
    /// A target that no run has.
    #[error("{name}: none of the {runs} runs spread over the bounds has a value of it")]
    NoValue {
        /// The target.
        name: String,
        /// Runs that were asked.
        runs: usize,
    },
}

/// Fewest runs for so many keys: a start, and both sides of each key.
pub fn least_budget(keys: usize) -> usize {
    start_size(keys, 0) + 2 * keys
}

/// Runs of the start: those of [`latin_hypercube`] with the seed.
pub(super) fn start_size(keys: usize, budget: usize) -> usize {
    (2 * keys + 2).max(budget / 4)
}

/// A drop of the sum of squares that counts.
const BETTER: f64 = 1.0;
/// A run's share of a target's uncertainty from which on runs count as noisy.
const NOISY: f64 = 0.1;
/// A difference should be so many times its noise.
const ABOVE_NOISE: f64 = 3.0;
/// Half the distance of a difference at most, in ranges.
const WIDEST: f64 = 0.2;
/// Longest step along an axis.
const FARTHEST: f64 = 0.3;
/// Places that the local search begins at, at most, and how far apart they lie at least.
const BEGINNINGS: usize = 4;
const APART: f64 = 0.15;

/// What has been asked.
struct Book<'a> {
    targets: &'a [Target],
    ask: &'a mut Run<'a>,
    evaluations: Vec<Evaluation>,
    sigma: Vec<f64>,
    stage: Stage,
    /// Runs that may have been requested by the end of this stage.
    limit: usize,
}

impl Book<'_> {
    fn place(&self, point: &[f64]) -> Option<usize> {
        self.evaluations.iter().position(|e| e.place == point)
    }

    /// Which evaluations answer the points; new ones are run, all of them or none.
    fn indices(&mut self, points: &[Vec<f64>]) -> Result<Vec<usize>, Halt> {
        let mut new: Vec<Vec<f64>> = Vec::new();
        for point in points {
            if self.place(point).is_none() && !new.contains(point) {
                new.push(point.clone());
            }
        }
        if self.evaluations.len() + new.len() > self.limit {
            return Err(Halt::Budget);
        }
        if !new.is_empty() {
            let answers = (self.ask)(&new).map_err(|_| Halt::Interrupted)?;
            for (place, answers) in new.into_iter().zip(answers) {
                let found = answers.as_ref().map(|a| residuals(self.targets, &self.sigma, a));
                self.evaluations.push(Evaluation {
                    place,
                    stage: self.stage,
                    chi_square: chi_square(found.as_deref()),
                    answers,
                });
            }
        }
        Ok(points.iter().filter_map(|p| self.place(p)).collect())
    }

    fn residuals(&self, index: usize) -> Option<Vec<f64>> {
        let answers = self.evaluations[index].answers.as_ref()?;
        Some(residuals(self.targets, &self.sigma, answers))
    }

    fn best(&self) -> usize {
        let all = self.evaluations.iter().enumerate();
        let least = all.min_by(|a, b| a.1.chi_square.total_cmp(&b.1.chi_square));
        least.map_or(0, |(k, _)| k)
    }

    /// From best to worst.
    fn ranked(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.evaluations.len()).collect();
        order.sort_by(|a, b| {
            let of = |k: &usize| self.evaluations[*k].chi_square;
            of(a).total_cmp(&of(b)).then(a.cmp(b))
        });
        order
    }

    /// The weights, from what the `count` best runs say of their own uncertainty. They are the same for all runs, so
    /// that none is preferred for being uncertain.
    fn weigh(&mut self, count: usize) -> Vec<f64> {
        let best = self.ranked().into_iter().take(count);
        let best: Vec<&Vec<Answer>> = best.filter_map(|k| self.evaluations[k].answers.as_ref()).collect();
        let own: Vec<f64> = (0..self.targets.len())
            .map(|t| {
                let with = best.iter().filter(|a| a[t].value.is_some());
                let mut known: Vec<f64> = with.map(|a| a[t].uncertainty).collect();
                known.sort_by(f64::total_cmp);
                known.get(known.len() / 2).copied().unwrap_or(0.0)
            })
            .collect();
        for ((sigma, own), target) in self.sigma.iter_mut().zip(&own).zip(self.targets) {
            *sigma = target.uncertainty.hypot(*own);
        }
        for k in 0..self.evaluations.len() {
            self.evaluations[k].chi_square = chi_square(self.residuals(k).as_deref());
        }
        own
    }

    /// A run's share of each target's uncertainty.
    fn noise(&self, own: &[f64]) -> Vec<f64> {
        let both = own.iter().zip(&self.sigma);
        both.map(|(own, sigma)| own / sigma).collect()
    }

    /// Whether some of the `runs` runs of the start has a value of each target.
    fn has_every_target(&self, runs: usize) -> Result<(), Unfit> {
        let answered: Vec<&Vec<Answer>> = (self.evaluations.iter()).filter_map(|e| e.answers.as_ref()).collect();
        if answered.is_empty() {
            return Err(Unfit::AllFailed(runs));
        }
        let missing = |t: &usize| answered.iter().all(|a| a[*t].value.is_none());
        match (0..self.targets.len()).find(missing) {
            Some(t) => Err(Unfit::NoValue { name: self.targets[t].name.clone(), runs }),
            None => Ok(()),
        }
    }

    /// Places that the local search begins at: the best ones that lie apart.
    fn beginnings(&self) -> Vec<Vec<f64>> {
        let mut beginnings: Vec<Vec<f64>> = Vec::new();
        for k in self.ranked() {
            let place = &self.evaluations[k].place;
            let near = |other: &Vec<f64>| {
                let far = place.iter().zip(other).map(|(a, b)| (a - b).abs());
                far.fold(0.0, f64::max) < APART
            };
            if !beginnings.iter().any(near) && beginnings.len() < BEGINNINGS {
                beginnings.push(place.clone());
            }
        }
        beginnings
    }
}

/// Fits `keys` keys to targets. The same answers make the same fit.
///
/// # Errors
/// Where it was interrupted, or no run says anything of some target.
///
/// # Panics
/// Where the budget is below [`least_budget`], or there is no target.
pub fn fit<'a>(keys: usize, targets: &'a [Target], settings: Settings, ask: &'a mut Run<'a>) -> Result<Fit, Unfit> {
    assert!(keys > 0 && settings.budget >= least_budget(keys) && !targets.is_empty());
    let start = start_size(keys, settings.budget);
    let reserve = (4 * keys + 1).min(settings.budget / 5).max(2 * keys);
    let mut book = Book {
        targets,
        ask,
        evaluations: Vec::new(),
        sigma: targets.iter().map(|t| t.uncertainty).collect(),
        stage: Stage::Start,
        limit: start,
    };
    let points = latin_hypercube(settings.seed, keys, start);
    book.indices(&points).map_err(|_| Unfit::Interrupted)?;
    book.has_every_target(start)?;
    let own = book.weigh(start.div_ceil(2));
    let noisy = book.noise(&own).iter().any(|n| *n > NOISY);
    let step = if noisy { 2.0 * STEP } else { STEP };

    let particles = (2 * keys + 2).min(start);
    let rounds = (settings.budget.saturating_sub(start + reserve)).min(settings.budget / 5) / particles;
    let population: Vec<(Vec<f64>, f64)> = (book.ranked().into_iter().take(particles))
        .map(|k| &book.evaluations[k])
        .map(|e| (e.place.clone(), e.chi_square))
        .collect();
    book.stage = Stage::Swarm;
    book.limit = start + rounds * particles;
    stage(&mut book, |ask| swarm(ask, &population, rounds as u64, settings.seed))?;

    book.stage = Stage::Local;
    book.limit = settings.budget - reserve;
    let mut cut_off = 0;
    for beginning in &book.beginnings() {
        let ended = stage(&mut book, |ask| local(ask, beginning, targets.len(), step))?;
        cut_off += usize::from(!ended);
    }
    // Runs near the best are what the outcome rests on.
    let own = book.weigh(particles);
    let noise = book.noise(&own);
    book.stage = Stage::Around;
    book.limit = settings.budget;
    let (centre, steps, identified) = look_around(&mut book, &noise, vec![step; keys])?;
    let best = book.best();
    Ok(Fit {
        residuals: book.residuals(best).unwrap_or_default(),
        sigma: book.sigma,
        evaluations: book.evaluations,
        own,
        best,
        centre,
        steps,
        cut_off,
        identified,
    })
}

/// Lets a search ask the book, and tells whether it came to its end; to run out of points is no failure.
fn stage(
    book: &mut Book,
    search: impl for<'b> FnOnce(&RefCell<&'b mut Ask<'b>>) -> Result<(), Halt>,
) -> Result<bool, Unfit> {
    let mut ask = |points: &[Vec<f64>]| {
        let indices = book.indices(points)?;
        Ok(indices.into_iter().map(|k| book.residuals(k)).collect())
    };
    match search(&RefCell::new(&mut ask)) {
        Ok(()) => Ok(true),
        Err(Halt::Budget) => Ok(false),
        Err(Halt::Interrupted) => Err(Unfit::Interrupted),
    }
}

/// Differences around the best point: where a neighbour is better, around that, while points are left. A key that moves
/// the targets by less than thrice the noise is moved further.
fn look_around(book: &mut Book, noise: &[f64], mut steps: Vec<f64>) -> Result<(usize, Vec<f64>, Identified), Unfit> {
    let keys = steps.len();
    let mut centre = book.best();
    let mut last = None;
    loop {
        let place = book.evaluations[centre].place.clone();
        let points = around(&place, &steps);
        let answered = match book.indices(&points) {
            Ok(indices) => indices,
            Err(Halt::Interrupted) => return Err(Unfit::Interrupted),
            Err(Halt::Budget) => break,
        };
        let answers: Vec<Option<Vec<f64>>> = answered.iter().map(|k| book.residuals(*k)).collect();
        let middle = book.residuals(centre).unwrap_or_default();
        let jacobian = slopes(&place, &middle, &points, &answers);
        let distance = |k: usize| points[2 * k + 1][k] - points[2 * k][k];
        let floor: Vec<f64> = (0..keys).map(|k| column_noise(noise, distance(k))).collect();
        let identified = identify(&middle, &jacobian, &floor);
        // Over wide differences the step of least squares sees past the roughness that stops a search downhill.
        match book.indices(&[moved(&place, &identified.step)]) {
            Err(Halt::Interrupted) => return Err(Unfit::Interrupted),
            Ok(_) | Err(Halt::Budget) => {}
        }
        last = Some((centre, steps.clone(), identified));
        let best = book.best();
        if book.evaluations[best].chi_square + BETTER < book.evaluations[centre].chi_square {
            centre = best;
            continue;
        }
        let weak = |k: &usize| jacobian.column(*k).norm() < ABOVE_NOISE * floor[*k];
        let weak: Vec<usize> = (0..keys).filter(weak).filter(|k| steps[*k] < WIDEST).collect();
        if weak.is_empty() {
            break;
        }
        for k in weak {
            steps[k] = (2.0 * steps[k]).min(WIDEST);
        }
    }
    match last {
        Some(found) => Ok(found),
        // The reserve holds the first round.
        None => Err(Unfit::Interrupted),
    }
}

/// From `place` by `step`, no further than [`FARTHEST`] along any axis and within the cube.
fn moved(place: &[f64], step: &[f64]) -> Vec<f64> {
    let longest = step.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
    let scale = if longest > FARTHEST { FARTHEST / longest } else { 1.0 };
    place.iter().zip(step).map(|(x, d)| (x + scale * d).clamp(0.0, 1.0)).collect()
}
