//! Which changes of a level are significant, where they are and how large.

use super::course::Course;
use super::fit::{Base, Best, CORRELATIONS, Kind, Search, Stretch};
use super::profile::Profile;
use super::reach::{Reach, reach};
use crate::estimate::{Estimate, Interval};
use crate::random::{Random, mix};

/// Fewest records that a change is looked for in.
pub const FEWEST: usize = 8;
/// Simulated series without a change, for one test.
const SIMULATED: usize = 999;
/// Parts of parts that are tested.
const DEPTH: usize = 3;

/// A change of a level.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// What changed.
    pub kind: Kind,
    /// When: halfway between two records for a step; growth may begin at a record or between two.
    pub at: f64,
    /// Not before and not after: 95 %. A step is between two records, at the least.
    pub between: (f64, f64),
    /// How much: the step, or the growth in a unit of time; with its 95 % interval.
    pub by: Estimate,
    /// Probability of such a gain by scatter alone.
    pub p: f64,
    /// Correlation of scatter from record to record that fits best.
    pub correlation: f64,
    /// The records it was found in, and what was before it there.
    part: (usize, usize, Base),
    best: Best,
}

/// What was found in a level.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// In the order of time; empty where none is significant.
    pub changes: Vec<Change>,
    /// Probability of the largest change by scatter alone; small without a change where scatter changes and the level does not.
    pub p: f64,
    /// How many of the last records, one or two, leap off the course of those before them and are in no change: odd records, or the beginning of
    /// a change that the next ones tell.
    pub aside: usize,
}

/// Changes whose probability without a change is below `alpha`; `None` of fewer than [`FEWEST`] records. The same input gives the same
/// outcome.
pub fn changes(course: &Course, alpha: f64) -> Option<Outcome> {
    let n = course.t.len();
    if n < FEWEST {
        return None;
    }
    let mut found = Vec::new();
    let (calmed, aside) = course.calmed();
    let p = test(&calmed, (0, n, Base::Level), alpha, DEPTH, &mut found);
    found.sort_by(|a: &Change, b: &Change| a.at.total_cmp(&b.at));
    Some(Outcome { changes: found, p, aside })
}

fn test(course: &Course, part: (usize, usize, Base), alpha: f64, depth: usize, found: &mut Vec<Change>) -> f64 {
    let (from, to, base) = part;
    if depth == 0 || to - from < FEWEST {
        return 1.0;
    }
    let stretch = Stretch::of(course, from, to);
    // Values that are all alike do not change, whatever their rounding.
    if stretch.is_constant() {
        return 1.0;
    }
    let search = Search::new(&stretch, base);
    let best = search.best(&stretch.y);
    let p = by_scatter(&search, &stretch, base, &best, alpha);
    if p > alpha {
        return p;
    }
    // The other kind where this one's interval says no change: a level that rises and falls again is higher all the same.
    let kinds = if best.kind == Kind::Step { [Kind::Step, Kind::Growth] } else { [Kind::Growth, Kind::Step] };
    let reweighted = stretch.reweighted(&best);
    let clear = kinds.into_iter().find_map(|kind| {
        let of = Profile::of(&reweighted, base, kind).found()?;
        let (low, high) = of.by_between;
        // Growth may end: that is a change of a line.
        ((base, kind) == (Base::Line, Kind::Growth) || low * high > 0.0).then_some((kind, of))
    });
    // Otherwise the scatter changes, and not the level.
    let Some((kind, of)) = clear else { return p };
    let (begin, span) = (course.t[from], course.t[to - 1] - course.t[from]);
    let unit = if kind == Kind::Step { 1.0 } else { 1.0 / span };
    let (low, high) = of.by_between;
    let interval = Interval { low: unit * low, high: unit * high, freedom: stretch.len() as u32 };
    let time = |t: f64| begin + span * t;
    found.push(Change {
        kind,
        at: time(of.time),
        between: (time(of.between.0), time(of.between.1)),
        by: Estimate { value: unit * of.by, interval: Some(interval) },
        p,
        correlation: of.rho,
        part,
        best,
    });
    let at = from + of.record;
    let (left, right) = match kind {
        Kind::Step => ((from, at, base), (at, to, Base::Level)),
        Kind::Growth => {
            // The line begins at the record nearest to the onset.
            let begins = at + usize::from(of.time > 0.5 * (stretch.t[of.record] + stretch.t[of.record + 1]));
            ((from, at + 1, base), (begins, to, Base::Line))
        }
    };
    test(course, left, alpha, depth - 1, found);
    test(course, right, alpha, depth - 1, found);
    p
}

/// The probability of such a gain without a change; no further than to say that it is above `alpha` (J. Besag, P. Clifford, Biometrika 78
/// (1991) 301).
fn by_scatter(search: &Search, stretch: &Stretch, base: Base, best: &Best, alpha: f64) -> f64 {
    let n = stretch.len() as f64;
    let columns = if base == Base::Line { 2.0 } else { 1.0 };
    let rho = ((n * best.rho + columns) / (n - 2.0 - columns)).min(CORRELATIONS[CORRELATIONS.len() - 1]);
    let most = (alpha * (SIMULATED + 1) as f64) as usize;
    let mut random = Random::new(mix(stretch.len() as u64));
    let innovations = search.innovations(best);
    let mut next = || innovations[(random.part() * innovations.len() as f64) as usize];
    let mut beyond = 0;
    let mut y = vec![0.0; stretch.len()];
    for tried in 1..=SIMULATED {
        let mut last = next() / (1.0 - rho * rho).sqrt();
        for (i, y) in y.iter_mut().enumerate() {
            if i > 0 {
                last = rho * last + next();
            }
            *y = last * best.variance.sqrt() / stretch.weight[i];
        }
        beyond += usize::from(search.best(&y).gain >= best.gain);
        if beyond > most.max(10) {
            return beyond as f64 / tried as f64;
        }
    }
    (beyond + 1) as f64 / (SIMULATED + 1) as f64
}

impl Change {
    /// When the level is at `limit` if it grows on as it does: growth alone says so, and where its interval is above 0.
    pub fn reach(&self, course: &Course, limit: f64) -> Option<Reach> {
        let grows = self.kind == Kind::Growth && self.by.interval.is_some_and(|i| i.low > 0.0);
        let (from, to, base) = self.part;
        let stretch = grows.then(|| Stretch::of(&course.calmed().0, from, to).reweighted(&self.best))?;
        let (t0, span) = (course.t[from], course.t[to - 1] - course.t[from]);
        let found = reach(&Profile::of(&stretch, base, Kind::Growth), limit)?;
        let time = |t: f64| t0 + span * t;
        Some(Reach { at: time(found.at), low: time(found.low), high: found.high.map(time) })
    }
}
