//! delta_eff(delta, s) of one damaged surface under one contact, as the equations of motion look it up (section 19).
//!
//! At every node of delta the value, the slope in delta and the curvature in delta are cubic splines along s; between two nodes of delta
//! a quintic in delta joins them. So delta_eff has continuous second derivatives, and its derivatives are exactly those of one function. Splining along s is
//! linear, so a table with natural cubic splines along delta (a file's) is their tensor product.
//!
//! s along the damaged surface from the damage's centre, delta the contact's deformation; all in m. Beyond the last delta the table goes on straight. At and
//! below the first, nothing touches. Outside its s the contact is healthy, delta_eff = delta.

use super::spline;

/// Bytes that the coefficients of one table may take.
pub const MOST_BYTES: usize = 2 << 20;
/// Nodes along each axis at the least.
pub const FEWEST_NODES: usize = 4;
/// Coefficients of a node: value, slope and curvature in delta, each with its second derivative along s.
const PER_NODE: usize = 6;
/// Pairs of s and delta at the most.
pub(crate) const MOST_NODES: usize = MOST_BYTES / (8 * PER_NODE);

/// delta_eff at one place, with its derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effective {
    /// delta_eff, m. 0 or less: no force.
    pub delta: f64,
    /// d delta_eff / d delta.
    pub by_delta: f64,
    /// d delta_eff / d s.
    pub by_s: f64,
    /// d2 delta_eff / d delta2, 1/m.
    pub by_delta2: f64,
}

/// Why numbers make no table.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TableError {
    /// Too few nodes along an axis.
    #[error("{nodes} different values of {axis}; a table takes at least {FEWEST_NODES}")]
    TooFew {
        /// `s` or `delta`.
        axis: &'static str,
        /// Nodes there are.
        nodes: usize,
    },
    /// Nodes that do not rise.
    #[error("{axis} number {index} (from 1) is not above the one before; values must rise")]
    NotRising {
        /// `s` or `delta`.
        axis: &'static str,
        /// Which node, from 1.
        index: usize,
    },
    /// Values for another number of nodes.
    #[error("{found} values for {expected} nodes; give one for every pair of s and delta")]
    NotFull {
        /// Pairs of s and delta.
        expected: usize,
        /// Values there are.
        found: usize,
    },
    /// A number that is not finite.
    #[error("a number of the table is not finite")]
    NotFinite,
    /// More than [`MOST_BYTES`].
    #[error("{nodes} nodes; a table takes at most {most}: leave out s far from edges, or every other delta", most = MOST_NODES)]
    TooLarge {
        /// Pairs of s and delta.
        nodes: usize,
    },
}

/// Rising nodes, with the interval at a place found in constant time.
#[derive(Debug, Clone, PartialEq)]
struct Axis {
    nodes: Vec<f64>,
    /// 1/width of every interval.
    inverse: Vec<f64>,
    /// Bins a metre.
    density: f64,
    /// The interval in which each of equally wide bins begins.
    bins: Vec<u32>,
}

/// Bins for every interval.
const BINS: usize = 4;

impl Axis {
    fn new(nodes: &[f64], axis: &'static str) -> Result<Self, TableError> {
        if nodes.len() < FEWEST_NODES {
            return Err(TableError::TooFew { axis, nodes: nodes.len() });
        }
        if let Some(k) = nodes.windows(2).position(|w| w[0] >= w[1]) {
            return Err(TableError::NotRising { axis, index: k + 2 });
        }
        let (first, last) = (nodes[0], nodes[nodes.len() - 1]);
        let count = BINS * (nodes.len() - 1);
        let density = count as f64 / (last - first);
        let most = nodes.len() - 2;
        let mut bins = vec![0; count + 1];
        let mut interval = 0;
        for (k, bin) in bins.iter_mut().enumerate() {
            // A hair before its beginning, so that round-off in finding the bin does not matter: the search goes forward alone.
            let from = first + (k as f64 - 1e-6) / density;
            while interval < most && nodes[interval + 1] <= from {
                interval += 1;
            }
            *bin = interval as u32;
        }
        let inverse = nodes.windows(2).map(|w| 1.0 / (w[1] - w[0])).collect();
        Ok(Self { nodes: nodes.to_vec(), inverse, density, bins })
    }

    fn first(&self) -> f64 {
        self.nodes[0]
    }

    fn last(&self) -> f64 {
        self.nodes[self.nodes.len() - 1]
    }

    /// Lower node of the interval at `place`, which lies within the nodes.
    #[inline]
    fn interval(&self, place: f64) -> usize {
        let bin = ((place - self.nodes[0]) * self.density) as usize;
        let mut k = self.bins[bin.min(self.bins.len() - 1)] as usize;
        while k + 2 < self.nodes.len() && self.nodes[k + 1] <= place {
            k += 1;
        }
        k
    }
}

/// delta_eff over s and delta.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    s: Axis,
    delta: Axis,
    /// Coefficients, row by row of s: [value, its second derivative along s, the same of the slope, the same of the curvature].
    nodes: Vec<[f64; PER_NODE]>,
}

impl Table {
    /// From values on a full grid, row by row of s (m): natural cubic splines along both.
    ///
    /// # Errors
    /// Where there are too few or too many nodes, they do not rise, or a value is missing or not finite.
    pub fn from_grid(s: &[f64], delta: &[f64], delta_eff: &[f64]) -> Result<Self, TableError> {
        let axes = Self::axes(s, delta, delta_eff)?;
        let (mut slopes, mut curvatures) = (Vec::new(), Vec::new());
        for row in delta_eff.chunks_exact(delta.len()) {
            let second = spline::curvatures(delta, row);
            slopes.extend(spline::slopes(delta, row, &second));
            curvatures.extend(second);
        }
        Ok(Self::assemble(axes, delta_eff, &slopes, &curvatures))
    }

    /// From values and slopes in delta on a full grid, row by row of s: exact at nodes in both. `lowest` says for every s which is the
    /// first node of delta that touches: from there down the values must be straight.
    pub(crate) fn from_slopes(
        (s, delta): (&[f64], &[f64]),
        delta_eff: &[f64],
        slopes: &[f64],
        lowest: &[usize],
    ) -> Result<Self, TableError> {
        let axes = Self::axes(s, delta, delta_eff)?;
        let n = delta.len();
        let mut curvatures = Vec::with_capacity(delta_eff.len());
        for ((values, slopes), &from) in delta_eff.chunks_exact(n).zip(slopes.chunks_exact(n)).zip(lowest) {
            let from = from.min(n - 1);
            curvatures.extend(std::iter::repeat_n(0.0, from));
            match n - from {
                1 => curvatures.push(0.0),
                _ => curvatures.extend(spline::quintic_curvatures(
                    &delta[from..],
                    &values[from..],
                    &slopes[from..],
                    [0.0; 2],
                )),
            }
        }
        if slopes.iter().chain(&curvatures).any(|x| !x.is_finite()) {
            return Err(TableError::NotFinite);
        }
        Ok(Self::assemble(axes, delta_eff, slopes, &curvatures))
    }

    fn axes(s: &[f64], delta: &[f64], values: &[f64]) -> Result<[Axis; 2], TableError> {
        if s.iter().chain(delta).chain(values).any(|x| !x.is_finite()) {
            return Err(TableError::NotFinite);
        }
        let axes = [Axis::new(s, "s")?, Axis::new(delta, "delta")?];
        let nodes = s.len().saturating_mul(delta.len());
        if nodes > MOST_NODES {
            return Err(TableError::TooLarge { nodes });
        }
        if values.len() != nodes {
            return Err(TableError::NotFull { expected: nodes, found: values.len() });
        }
        Ok(axes)
    }

    /// Splines along s of what stands at every node of delta.
    fn assemble([s, delta]: [Axis; 2], values: &[f64], slopes: &[f64], curvatures: &[f64]) -> Self {
        let n = delta.nodes.len();
        let mut nodes = vec![[0.0; PER_NODE]; values.len()];
        for (place, field) in [values, slopes, curvatures].into_iter().enumerate() {
            for column in 0..n {
                let along: Vec<f64> = field[column..].iter().step_by(n).copied().collect();
                let second = spline::curvatures(&s.nodes, &along);
                for (row, (y, m)) in along.into_iter().zip(second).enumerate() {
                    nodes[row * n + column][2 * place] = y;
                    nodes[row * n + column][2 * place + 1] = m;
                }
            }
        }
        Self { s, delta, nodes }
    }

    /// delta_eff where the contact's deformation is `delta` and lies at `s`, both in m.
    #[inline]
    pub fn at(&self, delta: f64, s: f64) -> Effective {
        let first = self.delta.first();
        if !(s >= self.s.first() && s <= self.s.last()) {
            return Effective { delta, by_delta: 1.0, by_s: 0.0, by_delta2: 0.0 };
        }
        if delta <= first {
            return Effective { delta: delta - first, by_delta: 0.0, by_s: 0.0, by_delta2: 0.0 };
        }
        self.straight(delta, s)
    }

    /// The same, but below the first delta it goes on as straight as beyond the last.
    #[inline]
    pub(super) fn straight(&self, delta: f64, s: f64) -> Effective {
        if !(s >= self.s.first() && s <= self.s.last()) {
            return Effective { delta, by_delta: 1.0, by_s: 0.0, by_delta2: 0.0 };
        }
        let along = self.along(s);
        let (first, last) = (self.delta.first(), self.delta.last());
        if delta <= first || delta >= last {
            let [low, high] = along(if delta <= first { 0 } else { self.delta.nodes.len() - 2 });
            let (at, beyond) = if delta <= first { (low, delta - first) } else { (high, delta - last) };
            return Effective {
                delta: at.value[0] + beyond * at.value[1],
                by_delta: at.value[1],
                by_s: at.by_s[0] + beyond * at.by_s[1],
                by_delta2: 0.0,
            };
        }
        let k = self.delta.interval(delta);
        let [low, high] = along(k);
        let width = [self.delta.nodes[k + 1] - self.delta.nodes[k], self.delta.inverse[k]];
        let x = delta - self.delta.nodes[k];
        let [value, by_delta, by_delta2] = quintic(low.value, high.value, width, x);
        let [by_s, ..] = quintic(low.by_s, high.by_s, width, x);
        Effective { delta: value, by_delta, by_s, by_delta2 }
    }

    /// What stands at node k of delta and at the next, at s.
    #[inline]
    fn along(&self, s: f64) -> impl Fn(usize) -> [Along; 2] {
        let row = self.s.interval(s);
        let h = self.s.nodes[row + 1] - self.s.nodes[row];
        let inverse = self.s.inverse[row];
        let b = (s - self.s.nodes[row]) * inverse;
        let a = 1.0 - b;
        // Weights of the cubic: values and second derivatives at both ends; then of its slope.
        let sixth = h * h / 6.0;
        let (wa, wb) = ((a * a - 1.0) * a * sixth, (b * b - 1.0) * b * sixth);
        let (va, vb) = ((1.0 - 3.0 * a * a) * h / 6.0, (3.0 * b * b - 1.0) * h / 6.0);
        let n = self.delta.nodes.len();
        let (lower, upper) = (&self.nodes[row * n..(row + 1) * n], &self.nodes[(row + 1) * n..(row + 2) * n]);
        move |k| {
            [k, k + 1].map(|k| {
                let (p, q) = (&lower[k], &upper[k]);
                let mut along = Along { value: [0.0; 3], by_s: [0.0; 3] };
                for c in 0..3 {
                    let (y0, m0, y1, m1) = (p[2 * c], p[2 * c + 1], q[2 * c], q[2 * c + 1]);
                    along.value[c] = (a * y0 + b * y1) + (wa * m0 + wb * m1);
                    along.by_s[c] = (y1 - y0) * inverse + (va * m0 + vb * m1);
                }
                along
            })
        }
    }

    /// What stands at the nodes, row by row of s.
    pub(super) fn values(&self) -> &[[f64; PER_NODE]] {
        &self.nodes
    }

    /// Put together from these again; `None` where they make no table.
    pub(super) fn from_values([s, delta]: [&[f64]; 2], nodes: Vec<[f64; PER_NODE]>) -> Option<Self> {
        let first: Vec<f64> = nodes.iter().map(|at| at[0]).collect();
        let [s, delta] = Self::axes(s, delta, &first).ok()?;
        Some(Self { s, delta, nodes })
    }

    /// First and last s, m: outside, the contact is healthy.
    pub fn range_s(&self) -> [f64; 2] {
        [self.s.first(), self.s.last()]
    }

    /// First delta, m: at and below it nothing touches.
    pub fn first_delta(&self) -> f64 {
        self.delta.first()
    }

    /// Last delta, m: beyond it the table goes on straight.
    pub fn last_delta(&self) -> f64 {
        self.delta.last()
    }

    /// Nodes along s, m.
    pub fn s_nodes(&self) -> &[f64] {
        &self.s.nodes
    }

    /// Nodes along delta, m.
    pub fn delta_nodes(&self) -> &[f64] {
        &self.delta.nodes
    }

    /// delta_eff (m) and its slope in delta at a node of each.
    pub fn node(&self, s: usize, delta: usize) -> (f64, f64) {
        let at = &self.nodes[s * self.delta.nodes.len() + delta];
        (at[0], at[2])
    }
}

/// Value, slope and curvature in delta at a node of delta, and their derivatives along s.
#[derive(Clone, Copy)]
struct Along {
    value: [f64; 3],
    by_s: [f64; 3],
}

/// Value and first two derivatives at `x` of the quintic over 0..`width` (and 1 over that) with value, slope and curvature given at both ends.
#[inline]
fn quintic(low: [f64; 3], high: [f64; 3], [width, inverse]: [f64; 2], x: f64) -> [f64; 3] {
    let [f, d, c] = low;
    // What is left at the far end above the parabola of the near one, in units of a step.
    let e0 = high[0] - (f + width * (d + 0.5 * width * c));
    let e1 = (high[1] - (d + width * c)) * width;
    let e2 = (high[2] - c) * width * width;
    let t = x * inverse;
    let (p, q, r) = (10.0 * e0 - 4.0 * e1 + 0.5 * e2, -15.0 * e0 + 7.0 * e1 - e2, 6.0 * e0 - 3.0 * e1 + 0.5 * e2);
    [
        f + x * (d + 0.5 * x * c) + t * t * t * (p + t * (q + t * r)),
        d + x * c + t * t * (3.0 * p + t * (4.0 * q + t * 5.0 * r)) * inverse,
        c + t * (6.0 * p + t * (12.0 * q + t * 20.0 * r)) * inverse * inverse,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const S: [f64; 9] = [-4e-4, -3e-4, -2e-4, -1.5e-4, -1e-4, 0.0, 1e-4, 2e-4, 4e-4];
    const DELTA: [f64; 6] = [-1e-6, 0.5e-6, 1e-6, 2e-6, 4e-6, 7e-6];

    /// Something smooth that sinks in the middle.
    fn effective(delta: f64, s: f64) -> (f64, f64) {
        let pit = (-(s / 1.3e-4).powi(2)).exp();
        let bent = 3e-6 * (1.0 - (-delta / 3e-6).exp());
        (delta - pit * bent, 1.0 - pit * (-delta / 3e-6).exp())
    }

    fn both() -> [Table; 2] {
        let (mut values, mut slopes) = (Vec::new(), Vec::new());
        for s in S {
            for delta in DELTA {
                let (value, slope) = effective(delta, s);
                values.push(value);
                slopes.push(slope);
            }
        }
        let natural = Table::from_grid(&S, &DELTA, &values).unwrap();
        [natural, Table::from_slopes((&S, &DELTA), &values, &slopes, &[0; 9]).unwrap()]
    }

    #[test]
    fn prop_nodes_are_exact_with_their_slopes() {
        for (which, table) in both().iter().enumerate() {
            for s in &S[..8] {
                for delta in &DELTA[1..] {
                    let (value, slope) = effective(*delta, *s);
                    let at = table.at(*delta, *s);
                    assert!((at.delta - value).abs() < 1e-18, "{delta} {s}: {at:?} {value}");
                    assert!(which == 0 || (at.by_delta - slope).abs() < 1e-12, "{delta} {s}: {at:?} {slope}");
                }
            }
        }
    }

    #[test]
    fn prop_beyond_the_nodes_straight_healthy_or_nothing() {
        for table in both() {
            let (last, beyond) = (table.at(7e-6, 0.3e-4), table.at(9e-6, 0.3e-4));
            assert!((beyond.delta - last.delta - 2e-6 * last.by_delta).abs() < 1e-18);
            assert!(beyond.by_delta == last.by_delta && beyond.by_delta2 == 0.0);
            for s in [-4.1e-4, 4.1e-4, f64::NAN] {
                assert_eq!(table.at(3e-6, s), Effective { delta: 3e-6, by_delta: 1.0, by_s: 0.0, by_delta2: 0.0 });
            }
            let nothing = table.at(-1.5e-6, 0.0);
            assert!(nothing.delta < 0.0 && nothing.by_delta == 0.0 && nothing.by_s == 0.0);
            assert!(table.at(-1e-6, 0.0).delta <= 0.0);
        }
    }

    #[test]
    fn xval_a_file_is_the_tensor_product_of_splines_in_either_order() {
        // First along s at every delta, then along delta.
        let [table, _] = both();
        for (delta, s) in [(0.7e-6, -0.7e-4), (3e-6, 1.7e-4), (6.9e-6, -3.9e-4), (-0.9e-6, 0.4e-4)] {
            let column = DELTA.map(|delta| {
                let row = S.map(|s| effective(delta, s).0);
                spline::value(&S, &row, &spline::curvatures(&S, &row), s)
            });
            let expected = spline::value(&DELTA, &column, &spline::curvatures(&DELTA, &column), delta);
            let got = table.at(delta, s).delta;
            assert!((got - expected).abs() < 1e-18, "{delta} {s}: {got} {expected}");
        }
    }

    #[test]
    fn prop_what_makes_no_table_is_refused() {
        let grid = |s: &[f64], delta: &[f64], n: usize| Table::from_grid(s, delta, &vec![0.0; n]).unwrap_err();
        assert_eq!(grid(&S[..3], &DELTA, 18), TableError::TooFew { axis: "s", nodes: 3 });
        assert_eq!(grid(&[0.0, 1.0, 1.0, 2.0], &DELTA, 24), TableError::NotRising { axis: "s", index: 3 });
        assert_eq!(grid(&S, &DELTA, 53), TableError::NotFull { expected: 54, found: 53 });
        assert_eq!(grid(&[0.0, 1.0, 2.0, f64::NAN], &DELTA, 24), TableError::NotFinite);
        let many: Vec<f64> = (0..10_000).map(f64::from).collect();
        assert_eq!(grid(&many, &DELTA, 60_000), TableError::TooLarge { nodes: 60_000 });
    }

    proptest! {
        #[test]
        fn prop_derivatives_are_those_of_the_value(delta in -1e-6..9e-6f64, s in -4.2e-4..4.2e-4f64) {
            for table in both() {
                let (x, z) = (1e-10, 1e-8);
                let slope = |a: f64, b: f64, h: f64| (a - b) / (2.0 * h);
                let at = table.at(delta, s);
                // Differences across an end mean nothing: the value bends or jumps there.
                let near = |x: f64, end: f64, h: f64| (x - end).abs() < 2.0 * h;
                if near(delta, -1e-6, x) || near(s, -4e-4, z) || near(s, 4e-4, z) {
                    continue;
                }
                let [up, down] = [table.at(delta + x, s), table.at(delta - x, s)];
                prop_assert!((at.by_delta - slope(up.delta, down.delta, x)).abs() < 1e-6);
                prop_assert!((at.by_delta2 - slope(up.by_delta, down.by_delta, x)).abs() * 1e-6 < 1e-4);
                let [right, left] = [table.at(delta, s + z), table.at(delta, s - z)];
                prop_assert!((at.by_s - slope(right.delta, left.delta, z)).abs() < 1e-6);
            }
        }

        #[test]
        fn prop_second_derivatives_have_no_jump_at_a_node(row in 1usize..8, column in 1usize..6, s in -3.9e-4..3.9e-4f64) {
            for table in both() {
                let (x, z) = (1e-15, 1e-13);
                let delta = DELTA[column];
                let jump = table.at(delta + x, s).by_delta2 - table.at(delta - x, s).by_delta2;
                prop_assert!(jump.abs() * 1e-6 < 1e-6, "{jump}");
                // Along s by differences of the slope on either side.
                let (node, inner) = (S[row], 2.7e-6);
                let bend = |a: f64, b: f64| (table.at(inner, node + b).by_s - table.at(inner, node + a).by_s) / (b - a);
                let jump = bend(z, 1e3 * z) - bend(-1e3 * z, -z);
                prop_assert!(jump.abs() < 1e-3 * bend(z, 1e3 * z).abs().max(10.0), "{jump}");
            }
        }
    }
}
