//! A function of the arc, exactly: straight and parabolic pieces between breakpoints, found in constant time.
//!
//! Widths L_s(s), depths h_s(s) and the depths of slices h_k(s) are made of straight pieces with jumps; their envelopes
//! of parabolas as well. s and values in m.

/// A straight piece of a function; elsewhere the function is 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// First s, m.
    pub from: f64,
    /// Last s, m.
    pub to: f64,
    /// Value at the first s, m.
    pub at_from: f64,
    /// Value at the last s, m.
    pub at_to: f64,
}

impl Line {
    /// The same value all along.
    pub fn flat(from: f64, to: f64, value: f64) -> Self {
        Self { from, to, at_from: value, at_to: value }
    }

    /// Its slope.
    pub(super) fn slope(&self) -> f64 {
        (self.at_to - self.at_from) / (self.to - self.from)
    }
}

/// c0 + c1 x + c2 x^2 with x = s - start, from `start` to the next piece's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Piece {
    pub(super) start: f64,
    pub(super) c: [f64; 3],
}

/// Finds the piece that holds s in constant time, whatever the pieces hold.
#[derive(Debug, Clone, PartialEq, Default)]
struct Lookup {
    first: f64,
    last: f64,
    pieces: usize,
    /// The piece on which each of equally wide buckets begins.
    index: Vec<u32>,
    buckets_per_metre: f64,
}

impl Lookup {
    /// For `pieces` that follow one another from `first` to `last` (m); `start` says where each begins.
    fn new(first: f64, last: f64, pieces: usize, start: impl Fn(usize) -> f64) -> Self {
        let buckets = 2 * pieces;
        let width = (last - first) / buckets as f64;
        let mut k = 0;
        let index = (0..buckets)
            .map(|bucket| {
                let s = first + bucket as f64 * width;
                while k + 1 < pieces && start(k + 1) <= s {
                    k += 1;
                }
                // Round-off may put an s just left of a bucket's border into that bucket.
                k.saturating_sub(1) as u32
            })
            .collect();
        Self { first, last, pieces, index, buckets_per_metre: 1.0 / width }
    }

    /// First and last s, m.
    fn span(&self) -> (f64, f64) {
        (self.first, self.last)
    }

    /// The piece that holds s, the right-hand one at a breakpoint.
    #[inline]
    fn find(&self, s: f64, start: impl Fn(usize) -> f64) -> Option<usize> {
        if !(s >= self.first && s <= self.last) || self.pieces == 0 {
            return None;
        }
        let bucket = ((s - self.first) * self.buckets_per_metre) as usize;
        let mut k = self.index[bucket.min(self.index.len() - 1)] as usize;
        while k + 1 < self.pieces && start(k + 1) <= s {
            k += 1;
        }
        Some(k)
    }
}

/// Pieces side by side, 0 before and after them; at a jump the right-hand value.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PiecewisePolynomial {
    lookup: Lookup,
    pieces: Vec<Piece>,
}

impl PiecewisePolynomial {
    /// From straight pieces in ascending order that do not overlap; what lies between them is 0.
    pub fn of_lines(lines: &[Line]) -> Self {
        let mut pieces: Vec<Piece> = Vec::with_capacity(lines.len());
        let mut end = f64::NEG_INFINITY;
        let mut first = None;
        for line in lines.iter().filter(|l| l.to > l.from) {
            if first.is_some() && line.from > end {
                pieces.push(Piece { start: end, c: [0.0; 3] });
            }
            first.get_or_insert(line.from);
            pieces.push(Piece { start: line.from, c: [line.at_from, line.slope(), 0.0] });
            end = line.to;
        }
        first.map_or_else(Self::default, |first| Self::of_pieces(first, end, pieces))
    }

    /// From pieces that follow one another from `first` to `last`.
    pub(super) fn of_pieces(first: f64, last: f64, pieces: Vec<Piece>) -> Self {
        if pieces.is_empty() {
            return Self::default();
        }
        Self { lookup: Lookup::new(first, last, pieces.len(), |k| pieces[k].start), pieces }
    }

    /// First and last s of what is not 0, m.
    pub fn span(&self) -> (f64, f64) {
        self.lookup.span()
    }

    /// Value at s, m.
    #[inline]
    pub fn value(&self, s: f64) -> f64 {
        let Some(k) = self.lookup.find(s, |k| self.pieces[k].start) else { return 0.0 };
        let Piece { start, c } = &self.pieces[k];
        let x = s - start;
        c[0] + x * (c[1] + x * c[2])
    }

    /// Each piece and where it ends, m.
    fn with_ends(&self) -> impl Iterator<Item = (&Piece, f64)> {
        let ends = self.pieces.iter().skip(1).map(|p| p.start);
        self.pieces.iter().zip(ends.chain([self.lookup.last]))
    }

    /// Integral over all s, m^2.
    pub fn integral(&self) -> f64 {
        self.with_ends()
            .map(|(p, end)| {
                let x = end - p.start;
                x * (p.c[0] + x * (p.c[1] / 2.0 + x * p.c[2] / 3.0))
            })
            .sum()
    }

    /// Largest value at a breakpoint or between, m; straight pieces, and parabolas that open upwards, as those of an
    /// envelope.
    pub fn largest(&self) -> f64 {
        self.with_ends()
            .map(|(p, end)| {
                let x = end - p.start;
                p.c[0].max(p.c[0] + x * (p.c[1] + x * p.c[2]))
            })
            .fold(0.0, f64::max)
    }

    /// Breakpoints, the ends among them, m.
    pub fn breakpoints(&self) -> Vec<f64> {
        let starts = self.pieces.iter().map(|p| p.start);
        if self.pieces.is_empty() {
            return Vec::new();
        }
        starts.chain([self.lookup.last]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_lines_gaps_and_jumps() {
        let c = PiecewisePolynomial::of_lines(&[
            Line { from: -1.0, to: 0.0, at_from: 0.0, at_to: 2.0 },
            Line::flat(0.0, 0.5, 5.0),
            Line::flat(1.0, 2.0, 3.0),
        ]);
        let at = [(-1.5, 0.0), (-0.5, 1.0), (0.0, 5.0), (0.25, 5.0), (0.75, 0.0), (1.5, 3.0), (2.0, 3.0), (2.1, 0.0)];
        for (s, value) in at {
            assert!((c.value(s) - value).abs() < 1e-14, "at {s}");
        }
        assert!((c.integral() - (1.0 + 2.5 + 3.0)).abs() < 1e-14);
        assert_eq!(PiecewisePolynomial::of_lines(&[]).value(0.0), 0.0);
    }

    #[test]
    fn prop_constant_time_search_agrees_with_a_plain_one() {
        // Breakpoints bunched at one end, the worst case for equal buckets.
        let mut arcs = vec![0.0];
        while arcs[arcs.len() - 1] < 200.0 {
            let k = arcs.len() as i32;
            arcs.push(arcs[arcs.len() - 1] + 1.5f64.powi(k % 60) * 1e-9);
        }
        let lines: Vec<Line> = arcs
            .windows(2)
            .map(|w| Line { from: w[0], to: w[1], at_from: w[0].sin(), at_to: w[1].cos() })
            .filter(|l| l.to > l.from)
            .collect();
        let c = PiecewisePolynomial::of_lines(&lines);
        for k in 0..100_000 {
            let s = 200.0 * f64::from(k) / 1e5;
            let plain = lines
                .iter()
                .rev()
                .find(|l| l.from <= s)
                .filter(|_| s <= lines[lines.len() - 1].to)
                .map_or(0.0, |l| l.at_from + (l.at_to - l.at_from) / (l.to - l.from) * (s - l.from));
            assert!((c.value(s) - plain).abs() < 1e-9, "at {s}");
        }
    }
}
