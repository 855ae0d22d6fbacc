//! Natural cubic splines on nodes of any spacing, and the tridiagonal systems behind them.

/// Solves a tridiagonal system in place: row k is `below[k] x[k-1] + at[k] x[k] + above[k] x[k+1] = right[k]`; the first of
/// `below` and the last of `above` are not read. The solution replaces `right`. For diagonally dominant systems.
pub(crate) fn solve_tridiagonal(below: &[f64], at: &mut [f64], above: &[f64], right: &mut [f64]) {
    for k in 1..right.len() {
        let share = below[k] / at[k - 1];
        at[k] -= share * above[k - 1];
        right[k] -= share * right[k - 1];
    }
    for k in (0..right.len()).rev() {
        let next = if k + 1 < right.len() { above[k] * right[k + 1] } else { 0.0 };
        right[k] = (right[k] - next) / at[k];
    }
}

/// Second derivatives at the nodes of the natural cubic spline through `y` at the rising `x`: 0 at both ends.
pub(crate) fn curvatures(x: &[f64], y: &[f64]) -> Vec<f64> {
    let n = x.len();
    if n < 3 {
        return vec![0.0; n];
    }
    let (mut below, mut at, mut above, mut right) = (vec![0.0; n], vec![1.0; n], vec![0.0; n], vec![0.0; n]);
    for k in 1..n - 1 {
        let (left, next) = (x[k] - x[k - 1], x[k + 1] - x[k]);
        below[k] = left / 6.0;
        at[k] = (left + next) / 3.0;
        above[k] = next / 6.0;
        right[k] = (y[k + 1] - y[k]) / next - (y[k] - y[k - 1]) / left;
    }
    solve_tridiagonal(&below, &mut at, &above, &mut right);
    right
}

/// First derivatives at the nodes of a cubic spline, given its second ones.
pub(crate) fn slopes(x: &[f64], y: &[f64], curvatures: &[f64]) -> Vec<f64> {
    let n = x.len();
    (0..n)
        .map(|k| {
            // From the interval to the right, at the last node from that to the left.
            let (a, b) = if k + 1 < n { (k, k + 1) } else { (k - 1, k) };
            let h = x[b] - x[a];
            let chord = (y[b] - y[a]) / h;
            let (at, other) = if k == a { (curvatures[a], curvatures[b]) } else { (curvatures[b], curvatures[a]) };
            let away = h * (2.0 * at + other) / 6.0;
            if k == a { chord - away } else { chord + away }
        })
        .collect()
}

/// Lower node of the interval of the rising `x` at `place`, which lies within them.
pub(crate) fn interval(x: &[f64], place: f64) -> usize {
    x.partition_point(|node| *node <= place).clamp(1, x.len() - 1) - 1
}

/// What the nodes of one interval weigh in a cubic spline's value and in its first two derivatives at a place.
pub(crate) struct Weights {
    lower: usize,
    /// Of the lower and the upper node.
    values: [[f64; 2]; 3],
    seconds: [[f64; 2]; 3],
}

impl Weights {
    /// At `place` within the interval from node `k` on.
    pub(crate) fn at(x: &[f64], k: usize, place: f64) -> Self {
        let h = x[k + 1] - x[k];
        let (a, b) = ((x[k + 1] - place) / h, (place - x[k]) / h);
        let sixth = h / 6.0;
        Self {
            lower: k,
            values: [[a, b], [-1.0 / h, 1.0 / h], [0.0; 2]],
            seconds: [
                [(a * a * a - a) * h * sixth, (b * b * b - b) * h * sixth],
                [(1.0 - 3.0 * a * a) * sixth, (3.0 * b * b - 1.0) * sixth],
                [a, b],
            ],
        }
    }

    /// Value and slope there of the spline through `y` with these second derivatives at the nodes.
    pub(crate) fn sums(&self, y: &[f64], seconds: &[f64]) -> [f64; 2] {
        let k = self.lower;
        [0, 1].map(|n| {
            let ([a, b], [c, d]) = (self.values[n], self.seconds[n]);
            a * y[k] + b * y[k + 1] + (c * seconds[k] + d * seconds[k + 1])
        })
    }

    /// Value and first two derivatives there of the spline that is 1 at node `j`, 0 at the others, and has these second derivatives at the nodes.
    pub(crate) fn of(&self, j: usize, seconds: &[f64]) -> [f64; 3] {
        let k = self.lower;
        [0, 1, 2].map(|n| {
            let node = if j == k {
                self.values[n][0]
            } else if j == k + 1 {
                self.values[n][1]
            } else {
                0.0
            };
            node + self.seconds[n][0] * seconds[k] + self.seconds[n][1] * seconds[k + 1]
        })
    }
}

/// Value at `place` of the cubic spline through `y` with the second derivatives `m`; `place` within the nodes.
pub(crate) fn value(x: &[f64], y: &[f64], m: &[f64], place: f64) -> f64 {
    let k = interval(x, place);
    let Weights { values: [[a, b], ..], seconds: [[wa, wb], ..], .. } = Weights::at(x, k, place);
    a * y[k] + b * y[k + 1] + (wa * m[k] + wb * m[k + 1])
}

/// Second derivatives at the nodes that make the third derivative of the quintic Hermite spline through `y` with the
/// slopes `d` continuous, given those at the first and the last node.
pub(crate) fn quintic_curvatures(x: &[f64], y: &[f64], d: &[f64], ends: [f64; 2]) -> Vec<f64> {
    let n = x.len();
    let (mut below, mut at, mut above, mut right) = (vec![0.0; n], vec![1.0; n], vec![0.0; n], vec![0.0; n]);
    right[0] = ends[0];
    right[n - 1] = ends[1];
    for k in 1..n - 1 {
        let (l, r) = (x[k] - x[k - 1], x[k + 1] - x[k]);
        below[k] = -3.0 / l;
        at[k] = 9.0 * (1.0 / l + 1.0 / r);
        above[k] = -3.0 / r;
        right[k] = 60.0 * ((y[k + 1] - y[k]) / r.powi(3) - (y[k] - y[k - 1]) / l.powi(3))
            - (36.0 * d[k] + 24.0 * d[k + 1]) / (r * r)
            + (24.0 * d[k - 1] + 36.0 * d[k]) / (l * l);
    }
    solve_tridiagonal(&below, &mut at, &above, &mut right);
    right
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_natural_spline_reproduces_a_straight_line_and_its_slopes() {
        let x = [0.0, 0.5, 2.0, 2.5, 4.0];
        let y = x.map(|x| 3.0 - 2.0 * x);
        let m = curvatures(&x, &y);
        assert!(m.iter().all(|m| m.abs() < 1e-12));
        assert!(slopes(&x, &y, &m).iter().all(|d| (d + 2.0).abs() < 1e-12));
        assert!((value(&x, &y, &m, 1.3) - 0.4).abs() < 1e-12);
    }

    #[test]
    fn analytic_the_natural_spline_solves_its_system() {
        // Interior rows of the system, by hand:
        let m = curvatures(&[0.0, 1.0, 3.0, 4.0], &[0.0, 2.0, 1.0, 5.0]);
        // [1 1/3; 1/3 1] [m1; m2] = [-2.5; 4.5].
        assert!((m[1] + 4.5).abs() < 1e-12 && (m[2] - 6.0).abs() < 1e-12, "{m:?}");
    }

    #[test]
    fn analytic_the_quintic_spline_reproduces_a_quartic() {
        let x = [0.0, 1.0, 1.5, 3.0, 3.5];
        let f = |x: f64| x.powi(4) - 2.0 * x.powi(3) + x;
        let (y, d) = (x.map(f), x.map(|x| 4.0 * x.powi(3) - 6.0 * x * x + 1.0));
        let dd = x.map(|x| 12.0 * x * x - 12.0 * x);
        let c = quintic_curvatures(&x, &y, &d, [dd[0], dd[4]]);
        assert!(c.iter().zip(dd).all(|(c, e)| (c - e).abs() < 1e-9), "{c:?} {dd:?}");
    }
}
