//! The restricted likelihood of a change at every place and correlation, and the intervals that follow. Restricted (H. D. Patterson,
//! R. Thompson, Biometrika 58 (1971) 545), because the plain one takes scatter that wanders for less correlated than it is.

use super::course::median;
use super::fit::{Base, CORRELATIONS, Kind, Stretch, places, solved, whitening};
use crate::student_t_quantile;

/// Threshold of twice the log-likelihood for the place of a change, 95 %: (1 - exp(-x / 2))^2 = 0.95.
const PLACE: f64 = 7.352;

/// A fit of every place and correlation.
pub(super) struct Profile<'a> {
    pub(super) stretch: &'a Stretch,
    pub(super) base: Base,
    fits: Vec<Fit>,
    most: f64,
    /// Of the sum of squares.
    freedom: f64,
}

/// Of one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fit {
    place: Place,
    pub(super) rho: f64,
    /// What correlation and columns add to the log-likelihood.
    added: f64,
    /// Sum of squares, and by how much a coefficient off by 1 raises it.
    squares: f64,
    curvature: f64,
    /// The step, or the growth behind the place.
    by: f64,
    likelihood: f64,
}

/// Where a change may be.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Place {
    /// The first record of the new level, or the last before growth.
    record: usize,
    /// Halfway between the records of a step, or where growth begins: at a record or between two.
    time: f64,
    /// The places beside it, and so what it stands for: the records before and behind a step, the neighbours of an onset.
    between: (f64, f64),
}

/// The change that fits best, with 95 % intervals; times are of the stretch.
pub(super) struct Found {
    pub(super) record: usize,
    pub(super) time: f64,
    pub(super) between: (f64, f64),
    pub(super) by: f64,
    pub(super) by_between: (f64, f64),
    pub(super) rho: f64,
}

/// Onsets that are tried from one record to the next, of few records, and in a long gap.
const ONSETS: usize = 8;
const IN_A_GAP: usize = 40;
/// Records whose onsets are as many in all.
const MANY: usize = 400;

fn all_places(stretch: &Stretch, base: Base, kind: Kind) -> Vec<Place> {
    let (t, n) = (&stretch.t, stretch.len());
    let records = places(n, base, kind);
    if kind == Kind::Step {
        let step = |k: usize| Place { record: k, time: 0.5 * (t[k - 1] + t[k]), between: (t[k - 1], t[k]) };
        return records.map(step).collect();
    }
    let usual = median(&t.windows(2).map(|pair| pair[1] - pair[0]).collect::<Vec<_>>());
    let each = (MANY / n).clamp(1, ONSETS) as f64;
    let mut onsets: Vec<(usize, f64)> = Vec::new();
    for k in records {
        let gap = t[k + 1] - t[k];
        let parts = ((each * gap / usual).ceil() as usize).clamp(1, IN_A_GAP);
        onsets.extend((0..parts).map(|part| (k, t[k] + gap * part as f64 / parts as f64)));
    }
    let place = |i: usize| {
        let (record, time) = onsets[i];
        let next = onsets.get(i + 1).map_or(t[record + 1], |next| next.1);
        Place { record, time, between: (onsets[i.saturating_sub(1)].1, next) }
    };
    (0..onsets.len()).map(place).collect()
}

impl<'a> Profile<'a> {
    pub(super) fn of(stretch: &'a Stretch, base: Base, kind: Kind) -> Self {
        let freedom = (stretch.len() - if base == Base::Line { 3 } else { 2 }) as f64;
        let mut fits = Vec::new();
        for place in all_places(stretch, base, kind) {
            let mut uncorrelated = None;
            for rho in CORRELATIONS {
                let of = solved(
                    stretch.columns(base, kind, (place.record, place.time), rho),
                    stretch.whitened(&stretch.y, rho),
                );
                // Of columns whose scale does not count.
                let ln_det = of.ln_det - *uncorrelated.get_or_insert(of.ln_det);
                let added = whitening(rho) - 0.5 * ln_det;
                let likelihood = added + stretch.likelihood(of.squares, freedom);
                fits.push(Fit {
                    place,
                    rho,
                    added,
                    squares: of.squares,
                    curvature: of.curvature,
                    by: of.by,
                    likelihood,
                });
            }
        }
        let most = fits.iter().map(|f| f.likelihood).fold(f64::NEG_INFINITY, f64::max);
        Self { stretch, base, fits, most, freedom }
    }

    /// The log-likelihood of a fit if this were its sum of squares.
    pub(super) fn likelihood(&self, fit: &Fit, squares: f64) -> f64 {
        fit.added + self.stretch.likelihood(squares, self.freedom)
    }

    /// The least log-likelihood of a coefficient within its interval, by Student's t.
    pub(super) fn least(&self) -> f64 {
        // The place and the correlation are estimated too.
        let freedom = (self.freedom - 2.0).max(1.0);
        let t = student_t_quantile(0.975, freedom as u32);
        self.most - 0.5 * self.freedom * (1.0 + t * t / freedom).ln()
    }

    /// When a fit begins to grow.
    pub(super) fn onset(fit: &Fit) -> f64 {
        fit.place.time
    }

    /// Fits that are as likely as this.
    pub(super) fn above(&self, least: f64) -> impl Iterator<Item = &Fit> {
        self.fits.iter().filter(move |f| f.likelihood >= least)
    }

    pub(super) fn found(&self) -> Option<Found> {
        let best = self.fits.iter().max_by(|a, b| a.likelihood.total_cmp(&b.likelihood))?;
        let places = self.above(self.most - 0.5 * PLACE).map(|f| f.place.between);
        let between = places.fold(best.place.between, |b, of| (b.0.min(of.0), b.1.max(of.1)));
        let least = self.least();
        let ends = self.above(least).filter(|f| f.curvature > 0.0).map(|f| {
            let reach =
                ((self.stretch.squares(least - f.added, self.freedom) - f.squares).max(0.0) / f.curvature).sqrt();
            (f.by - reach, f.by + reach)
        });
        let by_between = ends.fold((best.by, best.by), |b, e| (b.0.min(e.0), b.1.max(e.1)));
        Some(Found {
            record: best.place.record,
            time: best.place.time,
            between,
            by: best.by,
            by_between,
            rho: best.rho,
        })
    }
}
