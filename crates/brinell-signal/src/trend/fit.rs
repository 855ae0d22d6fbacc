//! Least squares of a level of pieces under autoregressive scatter of first order, for every place of a change at once.

use super::course::{Course, median};

/// Correlations from record to record that are tried.
pub(super) const CORRELATIONS: [f64; 12] = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.98];

/// Records on either side of a change whose scatter is taken for their own, at least; fewer have that of all.
const OF_THEIR_OWN: usize = 5;

/// How many records are before a change.
fn before(kind: Kind, place: usize) -> usize {
    match kind {
        Kind::Step => place,
        Kind::Growth => place + 1,
    }
}

/// What there is before a change: one level, or a straight line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Base {
    Level,
    Line,
}

/// How a level changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// At once.
    Step,
    /// From then on along a straight line.
    Growth,
}

/// What a difference of these values counts as none below: numbers of a file have so many digits.
fn digits(y: &[f64]) -> f64 {
    1e-4 * (1.0 + y.iter().fold(0.0, |m: f64, y| m.max(y.abs())))
}

/// A stretch of records: times from 0 to 1, values, and the weight of each record (inverse of the root of its variance).
#[derive(Debug, Clone)]
pub(super) struct Stretch {
    pub(super) t: Vec<f64>,
    pub(super) y: Vec<f64>,
    pub(super) weight: Vec<f64>,
    /// Variance that each record's own interval explains.
    own: Vec<f64>,
    /// Least variance, in units of the records' own: what their intervals alone explain.
    pub(super) floor: f64,
}

impl Stretch {
    pub(super) fn of(course: &Course, from: usize, to: usize) -> Self {
        let (t0, span) = (course.t[from], course.t[to - 1] - course.t[from]);
        let (y, s) = (&course.y[from..to], &course.s[from..to]);
        let squares: Vec<f64> = y.windows(2).map(|p| 0.5 * (p[1] - p[0]).powi(2) / 0.455).collect();
        let scatter = (median(&squares) - median(&s.iter().map(|s| s * s).collect::<Vec<_>>())).max(0.0);
        let digits = digits(y);
        let own: Vec<f64> = s.iter().map(|s| s * s + digits * digits).collect();
        let variance = own.iter().map(|own| scatter + own).collect();
        Self::weighted(course.t[from..to].iter().map(|t| (t - t0) / span).collect(), y.to_vec(), own, variance)
    }

    fn weighted(t: Vec<f64>, y: Vec<f64>, own: Vec<f64>, variance: Vec<f64>) -> Self {
        let explained = own.iter().zip(&variance).map(|(own, v)| own / v);
        let floor = explained.sum::<f64>() / y.len() as f64;
        Self { t, y, own, floor, weight: variance.iter().map(|v| 1.0 / v.sqrt()).collect() }
    }

    /// The same with records weighted by their scatter before and behind a change.
    pub(super) fn reweighted(&self, best: &Best) -> Self {
        let before = before(best.kind, best.fit.0);
        let variance = self.weight.iter().enumerate().map(|(i, w)| best.variances[usize::from(i >= before)] / (w * w));
        Self::weighted(self.t.clone(), self.y.clone(), self.own.clone(), variance.collect())
    }

    /// Whether all values are the same to the digits that count.
    pub(super) fn is_constant(&self) -> bool {
        let (low, high) = self.y.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |b, y| (b.0.min(*y), b.1.max(*y)));
        high - low <= digits(&self.y)
    }

    pub(super) fn len(&self) -> usize {
        self.t.len()
    }

    /// Values less what the record before them leads one to expect, each by its weight.
    pub(super) fn whitened(&self, x: &[f64], rho: f64) -> Vec<f64> {
        let mut white = Vec::with_capacity(x.len());
        white.push((1.0 - rho * rho).sqrt() * x[0] * self.weight[0]);
        white.extend((1..x.len()).map(|i| (x[i] - rho * x[i - 1]) * self.weight[i]));
        white
    }

    /// Whitened columns of the base, each of length 1 and normal to those before.
    fn base(&self, base: Base, rho: f64) -> Vec<Vec<f64>> {
        let mut all = vec![self.whitened(&vec![1.0; self.len()], rho)];
        if base == Base::Line {
            all.push(self.whitened(&self.t, rho));
        }
        orthonormal(all).0
    }

    /// The log-likelihood of a sum of squares with so many degrees of freedom, of records without correlation.
    pub(super) fn likelihood(&self, squares: f64, freedom: f64) -> f64 {
        let variance = (squares / freedom).max(self.floor);
        -0.5 * freedom * variance.ln() - 0.5 * squares / variance
    }

    /// The log-likelihood of two parts of a sum of squares, each with a variance of its own where it has records enough; and the variances.
    fn in_two(&self, squares: f64, front: f64, before: usize) -> (f64, [f64; 2]) {
        let n = self.len();
        if before < OF_THEIR_OWN || n - before < OF_THEIR_OWN {
            let n = n as f64;
            return (self.likelihood(squares, n), [(squares / n).max(self.floor); 2]);
        }
        let parts = [(front, before), ((squares - front).max(0.0), n - before)];
        let [first, second] = parts.map(|(squares, n)| self.likelihood(squares, n as f64));
        (first + second, parts.map(|(squares, n)| (squares / n as f64).max(self.floor)))
    }

    /// The sum of squares that has this log-likelihood.
    pub(super) fn squares(&self, likelihood: f64, freedom: f64) -> f64 {
        let at_floor = -0.5 * freedom * self.floor.ln();
        match likelihood <= at_floor - 0.5 * freedom {
            true => freedom * (-(2.0 * likelihood / freedom + 1.0)).exp(),
            false => 2.0 * self.floor * (at_floor - likelihood),
        }
    }

    /// Columns whose last one's coefficient is the step from record `k` on, or the growth from the time `from` on.
    pub(super) fn columns(&self, base: Base, kind: Kind, (k, from): (usize, f64), rho: f64) -> Vec<Vec<f64>> {
        let mut all = vec![vec![1.0; self.len()]];
        match (base, kind) {
            (Base::Level, _) => {}
            (Base::Line, Kind::Step) => all.push(self.t.clone()),
            (Base::Line, Kind::Growth) => all.push(self.t.iter().map(|t| t.min(from)).collect()),
        }
        all.push(match kind {
            Kind::Step => (0..self.len()).map(|i| f64::from(u8::from(i >= k))).collect(),
            Kind::Growth => self.t.iter().map(|t| (t - from).max(0.0)).collect(),
        });
        all.iter().map(|x| self.whitened(x, rho)).collect()
    }

    /// What the base leaves of the values: sum of squares, and the values themselves, whitened.
    fn left(&self, y: &[f64], rho: f64, columns: &[Vec<f64>]) -> (f64, Vec<f64>) {
        let mut w = self.whitened(y, rho);
        for q in columns {
            let along = dot(q, &w);
            w.iter_mut().zip(q).for_each(|(w, q)| *w -= along * q);
        }
        (dot(&w, &w), w)
    }
}

/// The base of every correlation, made once for many series of the same times.
pub(super) struct Search<'a> {
    stretch: &'a Stretch,
    base: Base,
    columns: Vec<Vec<Vec<f64>>>,
}

/// The best of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Best {
    /// Twice the gain of log-likelihood over no change.
    pub(super) gain: f64,
    pub(super) kind: Kind,
    /// Correlation, and variance of what is new in a record, without a change.
    pub(super) rho: f64,
    pub(super) variance: f64,
    /// Place and correlation of the change.
    pub(super) fit: (usize, f64),
    /// Variance of what is new in a record before and behind the change.
    pub(super) variances: [f64; 2],
}

/// Records that a change leaves on either side, at least.
pub(super) const BESIDE: usize = 3;

/// Where a change of this kind may be: the first record of the new level, or the last before growth.
pub(super) fn places(n: usize, base: Base, kind: Kind) -> std::ops::Range<usize> {
    match (kind, base) {
        (Kind::Step, _) => BESIDE..n + 1 - BESIDE,
        (Kind::Growth, Base::Level) => 0..n - BESIDE,
        (Kind::Growth, Base::Line) => BESIDE - 1..n - BESIDE,
    }
}

impl<'a> Search<'a> {
    pub(super) fn new(stretch: &'a Stretch, base: Base) -> Self {
        Self { stretch, base, columns: CORRELATIONS.iter().map(|rho| stretch.base(base, *rho)).collect() }
    }

    /// The change that explains most of these values.
    pub(super) fn best(&self, y: &[f64]) -> Best {
        let s = self.stretch;
        let (mut none, mut rho0, mut variance) = (f64::NEG_INFINITY, 0.0, 0.0);
        let (mut most, mut change) = (f64::NEG_INFINITY, (Kind::Step, (0, 0.0), [1.0; 2]));
        for (rho, columns) in CORRELATIONS.into_iter().zip(&self.columns) {
            let (squares, left) = s.left(y, rho, columns);
            let (n, whitening) = (s.len() as f64, whitening(rho));
            let likelihood = s.likelihood(squares, n) + whitening;
            if likelihood > none {
                (none, rho0, variance) = (likelihood, rho, (squares / n).max(s.floor));
            }
            self.gains(rho, columns, (squares, &left), |gain, front, k, kind| {
                let (likelihood, variances) = s.in_two((squares - gain).max(0.0), front.max(0.0), before(kind, k));
                if likelihood + whitening > most {
                    most = likelihood + whitening;
                    change = (kind, (k, rho), variances);
                }
            });
        }
        let (kind, fit, variances) = change;
        Best { gain: 2.0 * (most - none), kind, rho: rho0, variance, fit, variances }
    }

    /// What is new in each record, and in no level with this change, in units of its standard deviation.
    pub(super) fn innovations(&self, best: &Best) -> Vec<f64> {
        let (place, rho) = best.fit;
        let columns = orthonormal(self.stretch.columns(self.base, best.kind, (place, self.stretch.t[place]), rho)).0;
        let (_, mut left) = self.stretch.left(&self.stretch.y, rho, &columns);
        let mean = left.iter().sum::<f64>() / left.len() as f64;
        let before = before(best.kind, place);
        left.iter_mut()
            .enumerate()
            .for_each(|(i, x)| *x = (*x - mean) / best.variances[usize::from(i >= before)].sqrt());
        let deviation = (dot(&left, &left) / left.len() as f64).sqrt();
        left.iter_mut().for_each(|x| *x /= deviation.max(f64::MIN_POSITIVE));
        left
    }

    /// By how much each change lessens the sum of squares of what is `left`, and how much of this is then before it; from the last record to the
    /// first, with the sums over all records behind a place.
    fn gains(
        &self,
        rho: f64,
        columns: &[Vec<f64>],
        (squares, left): (f64, &[f64]),
        mut of: impl FnMut(f64, f64, usize, Kind),
    ) {
        let (s, n) = (self.stretch, self.stretch.len());
        let ranges = [Kind::Step, Kind::Growth].map(|kind| places(n, self.base, kind));
        let (mut cc, mut cu, mut uu, mut cw, mut uw) = (0.0, 0.0, 0.0, 0.0, 0.0);
        let (mut cq, mut uq) = ([0.0; 2], [0.0; 2]);
        // Over this record and those behind it: squares of what is left, its products with the base, those within the base.
        let (mut ww, mut wq, mut qq) = (0.0, [0.0; 2], [[0.0; 2]; 2]);
        // Before a change its column is 0, and what is made normal to the base is the base's part of it alone.
        let front = |by: f64, along: [f64; 2], (ww, wq, qq): (f64, [f64; 2], [[f64; 2]; 2])| {
            let mut sum = squares - ww;
            for j in 0..columns.len() {
                sum -= 2.0 * by * along[j] * wq[j];
                for l in 0..columns.len() {
                    sum += by * by * along[j] * along[l] * (f64::from(u8::from(j == l)) - qq[j][l]);
                }
            }
            sum
        };
        for k in (0..n).rev() {
            let (g, t) = (s.weight[k], s.t[k]);
            if ranges[1].contains(&k) {
                let along = [uq[0] - t * cq[0], uq[1] - t * cq[1]];
                let (gain, by) = gain(uu - 2.0 * t * cu + t * t * cc, uw - t * cw, along);
                of(gain, front(by, along, (ww, wq, qq)), k, Kind::Growth);
            }
            ww += left[k] * left[k];
            for (j, q) in columns.iter().enumerate() {
                wq[j] += left[k] * q[k];
                columns.iter().enumerate().for_each(|(l, other)| qq[j][l] += q[k] * other[k]);
            }
            if ranges[0].contains(&k) {
                let along = [0, 1].map(|j| columns.get(j).map_or(0.0, |q| g * q[k] + cq[j]));
                let (gain, by) = gain(g * g + cc, g * left[k] + cw, along);
                of(gain, front(by, along, (ww, wq, qq)), k, Kind::Step);
            }
            if k > 0 {
                let (c, u) = (g * (1.0 - rho), g * (t - rho * s.t[k - 1]));
                (cc, cu, uu) = (cc + c * c, cu + c * u, uu + u * u);
                (cw, uw) = (cw + c * left[k], uw + u * left[k]);
                for (j, q) in columns.iter().enumerate() {
                    (cq[j], uq[j]) = (cq[j] + c * q[k], uq[j] + u * q[k]);
                }
            }
        }
    }
}

/// What a column of this square, this product with what is left and these along the base lessens the sum by, and its coefficient.
fn gain(square: f64, product: f64, along: [f64; 2]) -> (f64, f64) {
    let own = square - along[0] * along[0] - along[1] * along[1];
    if own > 1e-9 * square { (product * product / own, product / own) } else { (0.0, 0.0) }
}

/// What correlation adds to a log-likelihood of whitened values.
pub(super) fn whitening(rho: f64) -> f64 {
    0.5 * (1.0 - rho * rho).ln()
}

/// A fit of columns.
pub(super) struct Solved {
    /// What is left.
    pub(super) squares: f64,
    /// The coefficient of the last column.
    pub(super) by: f64,
    /// By how much that raises the sum of squares, if it is off by 1.
    pub(super) curvature: f64,
    /// Logarithm of the determinant of the columns' products.
    pub(super) ln_det: f64,
}

pub(super) fn solved(columns: Vec<Vec<f64>>, mut w: Vec<f64>) -> Solved {
    let (normal, squares) = orthonormal(columns);
    let mut along = 0.0;
    for q in &normal {
        along = dot(q, &w);
        w.iter_mut().zip(q).for_each(|(w, q)| *w -= along * q);
    }
    let curvature = squares.last().copied().unwrap_or(0.0);
    let by = if curvature > 0.0 { along / curvature.sqrt() } else { 0.0 };
    Solved { squares: dot(&w, &w), by, curvature, ln_det: squares.iter().map(|x| x.ln()).sum() }
}

/// Gram-Schmidt, twice for its rounding; and the squares of what each column is normal to those before.
fn orthonormal(columns: Vec<Vec<f64>>) -> (Vec<Vec<f64>>, Vec<f64>) {
    let (mut done, mut squares): (Vec<Vec<f64>>, Vec<f64>) = Default::default();
    for mut x in columns {
        for _ in 0..2 {
            for q in &done {
                let along = dot(q, &x);
                x.iter_mut().zip(q).for_each(|(x, q)| *x -= along * q);
            }
        }
        let square = dot(&x, &x);
        x.iter_mut().for_each(|x| *x /= square.sqrt().max(f64::MIN_POSITIVE));
        done.push(x);
        squares.push(square);
    }
    (done, squares)
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    /// Sums over all records behind a place give what a fit of the columns gives.
    #[test]
    fn analytic_the_gain_of_each_place_is_that_of_its_fit() {
        let mut random = Random::new(3);
        let t: Vec<f64> = (0..20).map(|i| f64::from(i) + 0.6 * random.uniform()).collect();
        let y: Vec<f64> = t.iter().map(|_| random.normal()).collect();
        let s = t.iter().map(|_| 0.3 * random.uniform()).collect();
        let stretch = Stretch::of(&Course { t, y, s }, 0, 20);
        for base in [Base::Level, Base::Line] {
            let search = Search::new(&stretch, base);
            for (rho, columns) in CORRELATIONS.into_iter().zip(&search.columns) {
                let (squares, left) = stretch.left(&stretch.y, rho, columns);
                search.gains(rho, columns, (squares, &left), |gain, front, k, kind| {
                    let change = |i: usize, t: f64| match kind {
                        Kind::Step => f64::from(u8::from(i >= k)),
                        Kind::Growth => (t - stretch.t[k]).max(0.0),
                    };
                    let column: Vec<f64> = stretch.t.iter().enumerate().map(|(i, t)| change(i, *t)).collect();
                    let mut all = columns.clone();
                    all.push(stretch.whitened(&column, rho));
                    let fitted = solved(all.clone(), stretch.whitened(&stretch.y, rho)).squares;
                    let (_, left) = stretch.left(&stretch.y, rho, &orthonormal(all).0);
                    let direct = dot(&left[..before(kind, k)], &left[..before(kind, k)]);
                    assert!((front - direct).abs() < 1e-8 * squares, "{kind:?} {k} {rho}: {front} {direct}");
                    // Growth from the first record on is no news to a line, and is not asked of one.
                    assert!((squares - gain - fitted).abs() < 1e-8 * squares, "{kind:?} {k} {rho}: {gain}");
                });
            }
        }
    }

    #[test]
    fn analytic_a_sum_of_squares_and_its_likelihood_are_each_others_inverse() {
        let course = Course { t: vec![0.0, 1.0, 2.0], y: vec![0.0, 1.0, 0.5], s: vec![0.2; 3] };
        let stretch = Stretch::of(&course, 0, 3);
        for squares in [0.01, 0.5, 3.0, 40.0] {
            let back = stretch.squares(stretch.likelihood(squares, 2.0), 2.0);
            assert!((back / squares - 1.0).abs() < 1e-9, "{squares} {back}");
        }
    }
}
