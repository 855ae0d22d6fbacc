//! The restricted likelihood of a change at every place and correlation, and the intervals that follow. Restricted (H. D. Patterson,
//! R. Thompson, Biometrika 58 (1971) 545), because the plain one takes scatter that wanders for less correlated than it is.

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
    pub(super) place: usize,
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

/// The change that fits best, with 95 % intervals.
pub(super) struct Found {
    pub(super) place: usize,
    pub(super) between: (usize, usize),
    pub(super) by: f64,
    pub(super) by_between: (f64, f64),
    pub(super) rho: f64,
}

impl<'a> Profile<'a> {
    pub(super) fn of(stretch: &'a Stretch, base: Base, kind: Kind) -> Self {
        let freedom = (stretch.len() - if base == Base::Line { 3 } else { 2 }) as f64;
        let mut fits = Vec::new();
        for place in places(stretch.len(), base, kind) {
            let mut uncorrelated = None;
            for rho in CORRELATIONS {
                let of = solved(stretch.columns(base, kind, place, rho), stretch.whitened(&stretch.y, rho));
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

    /// Fits that are as likely as this.
    pub(super) fn above(&self, least: f64) -> impl Iterator<Item = &Fit> {
        self.fits.iter().filter(move |f| f.likelihood >= least)
    }

    pub(super) fn found(&self) -> Option<Found> {
        let best = self.fits.iter().max_by(|a, b| a.likelihood.total_cmp(&b.likelihood))?;
        let places = self.above(self.most - 0.5 * PLACE).map(|f| f.place);
        let between = places.fold((best.place, best.place), |b, k| (b.0.min(k), b.1.max(k)));
        let least = self.least();
        let ends = self.above(least).filter(|f| f.curvature > 0.0).map(|f| {
            let reach =
                ((self.stretch.squares(least - f.added, self.freedom) - f.squares).max(0.0) / f.curvature).sqrt();
            (f.by - reach, f.by + reach)
        });
        let by_between = ends.fold((best.by, best.by), |b, e| (b.0.min(e.0), b.1.max(e.1)));
        Some(Found { place: best.place, between, by: best.by, by_between, rho: best.rho })
    }
}
