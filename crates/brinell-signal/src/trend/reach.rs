//! When a level that grows reaches a limit, at the rate of its records.

use super::fit::{Base, solved};
use super::profile::{Fit, Profile};

/// When the limit is reached, with its 95 % interval, in the unit of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Most likely.
    pub at: f64,
    /// Not before, with the last record at the earliest.
    pub low: f64,
    /// Not after; `None` beyond fifty times the records' own span.
    pub high: Option<f64>,
}

/// Times that are tried, and the last of them in spans of the records.
const TIMES: usize = 160;
const LAST: f64 = 50.0;
const FIRST: f64 = 1e-3;

/// The profile likelihood of the time at which the line behind the change is at `limit`, over all places and correlations that are
/// allowed; times are of the stretch, whose last record is at 1. `None` where the level is there already.
pub(super) fn reach(profile: &Profile, limit: f64) -> Option<Reach> {
    let s = profile.stretch;
    let y: Vec<f64> = s.y.iter().map(|y| y - limit).collect();
    let allowed: Vec<&Fit> = profile.above(profile.least()).collect();
    let likelihood = |time: f64| {
        let of = |fit: &&Fit| {
            let (at, rho) = (Profile::onset(fit), fit.rho);
            let mut columns = Vec::new();
            if profile.base == Base::Line {
                columns.push(s.whitened(&s.t.iter().map(|t| t.min(at) - at).collect::<Vec<_>>(), rho));
            }
            columns.push(s.whitened(&s.t.iter().map(|t| (t - at).max(0.0) - (time - at)).collect::<Vec<_>>(), rho));
            let of = solved(columns, s.whitened(&y, rho));
            if of.by > 0.0 { profile.likelihood(fit, of.squares) } else { f64::NEG_INFINITY }
        };
        allowed.iter().map(of).fold(f64::NEG_INFINITY, f64::max)
    };
    let step = (LAST / FIRST).ln() / (TIMES - 1) as f64;
    let times: Vec<f64> =
        std::iter::once(1.0).chain((0..TIMES).map(|i| 1.0 + FIRST * (step * i as f64).exp())).collect();
    let all: Vec<f64> = times.iter().map(|t| likelihood(*t)).collect();
    let best = (0..all.len()).max_by(|a, b| all[*a].total_cmp(&all[*b]))?;
    if best == 0 {
        return None;
    }
    let needed = profile.least();
    let within = |i: &usize| all[*i] >= needed;
    let low = (0..=best).find(within).unwrap_or(best);
    let last = (best..all.len()).rev().find(within).unwrap_or(best);
    let high = (last + 1 < all.len()).then(|| times[(last + 1).min(all.len() - 1)]);
    Some(Reach { at: times[best], low: times[low.saturating_sub(1)], high })
}
