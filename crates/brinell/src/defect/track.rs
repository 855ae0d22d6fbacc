//! One slice along the arc: which fraction of its width damage covers, and the mean depth of what is covered (section
//! 3).
//!
//! Both are made of cubic pieces between breakpoints, found in constant time.

use super::piecewise::Lookup;

/// A fraction closer than this to 0 or 1 counts as 0 or 1: else round-off in a pit would switch the whole damper on.
const ROUND_OFF: f64 = 1e-9;

/// Largest error of a fitted fraction, and of a fraction times its depth over the largest depth.
const TOLERANCE: f64 = 1e-9;

/// Shortest piece of a fit, m.
const SHORTEST: f64 = 1e-12;

/// phi counted as 0 or 1 where round-off alone keeps it from there.
#[inline]
pub(super) fn settled(phi: f64) -> f64 {
    if phi <= ROUND_OFF {
        0.0
    } else if phi >= 1.0 - ROUND_OFF {
        1.0
    } else {
        phi
    }
}

/// phi and h as cubics in s - start, up to the next piece's start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Part {
    pub(super) start: f64,
    pub(super) phi: [f64; 4],
    /// m.
    pub(super) h: [f64; 4],
}

impl Part {
    pub(super) fn nothing(start: f64) -> Self {
        Self { start, phi: [0.0; 4], h: [0.0; 4] }
    }
}

#[inline]
fn value(c: &[f64; 4], x: f64) -> f64 {
    c[0] + x * (c[1] + x * (c[2] + x * c[3]))
}

#[inline]
fn slope(c: &[f64; 4], x: f64) -> f64 {
    c[1] + x * (2.0 * c[2] + x * 3.0 * c[3])
}

/// phi_k(s) and h_k(s) of one slice, or of several that are alike.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Track {
    /// The slice, from 0; where `count` is 2 its mirror image is the other.
    pub(super) slice: usize,
    /// How many slices.
    pub(super) count: f64,
    lookup: Lookup,
    parts: Vec<Part>,
}

impl Track {
    /// From pieces in ascending order up to `last` (m); `None` where nothing is covered.
    pub(super) fn new(slice: usize, count: f64, parts: Vec<Part>, last: f64) -> Option<Self> {
        let first = parts.first()?.start;
        let covers = parts.iter().any(|p| p.phi != [0.0; 4]);
        covers.then(|| Self { slice, count, lookup: Lookup::new(first, last, parts.len(), |k| parts[k].start), parts })
    }

    /// First and last s where anything is covered, m.
    pub(super) fn span(&self) -> (f64, f64) {
        self.lookup.span()
    }

    #[inline]
    fn at(&self, s: f64) -> Option<(&Part, f64)> {
        let k = self.lookup.find(s, |k| self.parts[k].start)?;
        let part = &self.parts[k];
        Some((part, s - part.start))
    }

    /// phi and h at s.
    #[inline]
    pub(super) fn value(&self, s: f64) -> (f64, f64) {
        match self.at(s) {
            Some((part, x)) => (settled(value(&part.phi, x)), value(&part.h, x)),
            None => (0.0, 0.0),
        }
    }

    /// dphi/ds (1/m) and dh/ds at s, right-hand at a kink.
    #[inline]
    pub(super) fn slope(&self, s: f64) -> (f64, f64) {
        self.at(s).map_or((0.0, 0.0), |(part, x)| (slope(&part.phi, x), slope(&part.h, x)))
    }
}

/// Cubic pieces of a function s -> (phi, h) between breakpoints (ascending), as many as its error asks for; `deepest`
/// (m) is the scale of h.
pub(super) fn fit(breaks: &[f64], deepest: f64, of: impl Fn(f64) -> (f64, f64)) -> Vec<Part> {
    let mut parts = Vec::new();
    for pair in breaks.windows(2) {
        let mut open = vec![[pair[0], pair[1]]];
        while let Some([from, to]) = open.pop() {
            let part = through(from, to, &of);
            let good = |share: f64| {
                let x = share * (to - from);
                let ((phi, h), ours) = (of(from + x), (value(&part.phi, x), value(&part.h, x)));
                (phi - ours.0).abs() <= TOLERANCE && phi * (h - ours.1).abs() <= TOLERANCE * deepest.max(1e-9)
            };
            let middle = 0.5 * (from + to);
            if to - from <= SHORTEST || [0.003, 0.16, 0.5, 0.84, 0.997].into_iter().all(good) {
                parts.push(part);
            } else {
                open.extend([[middle, to], [from, middle]]);
            }
        }
    }
    parts
}

/// The cubics through a function's values at four points within from..to.
fn through(from: f64, to: f64, of: &impl Fn(f64) -> (f64, f64)) -> Part {
    // Chebyshev's points, on which a cubic errs least; never an end, where the function may jump.
    const AT: [f64; 4] =
        [0.038_060_233_744_356_62, 0.308_658_283_817_455_1, 0.691_341_716_182_544_9, 0.961_939_766_255_643_3];
    let width = to - from;
    let values = AT.map(|t| of(from + t * width));
    let cubic = |y: [f64; 4]| {
        // Newton's divided differences, multiplied out.
        let mut d = y;
        for level in 1..4 {
            for k in (level..4).rev() {
                d[k] = (d[k] - d[k - 1]) / (AT[k] - AT[k - level]);
            }
        }
        let mut c = [d[3], 0.0, 0.0, 0.0];
        for k in (0..3).rev() {
            // c <- c (t - t_k) + d_k
            for j in (1..4).rev() {
                c[j] = c[j - 1] - AT[k] * c[j];
            }
            c[0] = d[k] - AT[k] * c[0];
        }
        [c[0], c[1] / width, c[2] / width.powi(2), c[3] / width.powi(3)]
    };
    Part { start: from, phi: cubic(values.map(|v| v.0)), h: cubic(values.map(|v| v.1)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_fit_is_exact_for_cubics_and_close_for_a_vertical_tangent() {
        let exact = fit(&[-1e-3, 1e-3], 1.0, |s| (1e9 * s.powi(3) + 0.5, 2e3 * s * s));
        assert_eq!(exact.len(), 1);
        let track = Track::new(0, 1.0, exact, 1e-3).unwrap();
        for s in [-1e-3, -2e-4, 0.0, 3e-4, 1e-3] {
            let (phi, h) = track.value(s);
            assert!((phi - settled(1e9 * s.powi(3) + 0.5)).abs() < 1e-12 && (h - 2e3 * s * s).abs() < 1e-15);
            let (dphi, dh) = track.slope(s);
            assert!((dphi - 3e9 * s * s).abs() < 1e-8 && (dh - 4e3 * s).abs() < 1e-11);
        }
        let root = |s: f64| ((s + 1e-3) / 2e-3).max(0.0).sqrt();
        let parts = fit(&[-1e-3, 1e-3], 1.0, |s| (root(s), 0.0));
        let track = Track::new(0, 1.0, parts, 1e-3).unwrap();
        for k in 0..2000 {
            let s = -1e-3 + 2e-3 * (f64::from(k) / 2000.0).powi(3);
            let off = (track.value(s).0 - settled(root(s))).abs();
            assert!(off < 2e-9 || s < -1e-3 + 4.0 * SHORTEST, "{off} at {k}");
        }
    }
}
