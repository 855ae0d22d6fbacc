//! Embedded explicit Runge-Kutta-Nystrom pairs for q'' = f(t, q, q') with FSAL: the last stage is the first of the next
//! step.

/// Stages before the shared one.
pub const STAGES: usize = 4;

/// Coefficients of a pair.
///
/// Stage i is evaluated at t + c_i h, q + c_i h v + h^2 sum over j < i of ā_ij f_j and v + h sum of a_ij f_j; the last
/// of them, with the weights b̄ and b in place of ā and a, is the step's end. Ordinary Runge-Kutta methods are those
/// with ā = a a.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tableau {
    /// Order of the solution that is propagated.
    pub order: u32,
    /// Nodes c of stages 2, 3, ...
    pub nodes: [f64; STAGES],
    /// Rows of a for stages 2, 3, ...; the last row holds the weights b.
    pub rates: [[f64; STAGES]; STAGES],
    /// Rows of ā for stages 2, 3, ...; the last row holds the weights b̄.
    pub positions: [[f64; STAGES]; STAGES],
    /// Weights of the error estimate of the rates, the shared stage's last.
    pub error: [f64; STAGES + 1],
    /// Stability limits: damping ratios zeta, and for each the longest h |lambda| up to which the faster of the motions
    /// exp(lambda t) of q'' + 2 zeta w q' + w^2 q = 0 decays. Linear between; beyond the last, its value.
    pub stability_limits: &'static [(f64, f64)],
}

impl Tableau {
    /// Weights b of the propagated solution.
    pub fn weights(&self) -> [f64; STAGES] {
        self.rates[STAGES - 1]
    }

    /// Stability limit: the longest step in which a motion of q'' + 2 zeta w q' + w^2 q = 0 decays, s; `rate` is
    /// |lambda| of the faster one, 1/s, and infinite damping ratios are those of v' = -rate v.
    pub fn stability_limit(&self, rate: f64, damping_ratio: f64) -> f64 {
        let after = self.stability_limits.partition_point(|(z, _)| *z <= damping_ratio);
        let limit = match (after.checked_sub(1).map(|k| self.stability_limits[k]), self.stability_limits.get(after)) {
            (Some((z0, d0)), Some(&(z1, d1))) => d0 + (d1 - d0) * (damping_ratio - z0) / (z1 - z0),
            (Some((_, d)), None) | (None, Some(&(_, d))) => d,
            (None, None) => 0.0,
        };
        limit / rate
    }
}

/// A 3(2) pair of four right-hand sides a step, made for contacts with dampers.
///
/// Third order leaves thirteen coefficients free. They are the short decimals below, found by differential evolution:
/// large stability limits for q'' + 2 zeta w q' + w^2 q = 0 at damping ratios of 0.03 to 0.7, and small residuals of
/// the conditions of order 4 (root of their sum of squares 0.032; Bogacki and Shampine's pair: 0.095). The
/// others follow from order 3; `validation/coefficients/nystrom.py` solves for them and prints these numbers. The
/// error's weights give the leading terms of Bogacki and Shampine's estimate.
pub const DAMPED_CONTACT: Tableau = Tableau {
    order: 3,
    nodes: [0.38348, 0.58144, 0.9944, 1.0],
    rates: [
        [0.38348, 0.0, 0.0, 0.0],
        [-0.07217, 0.65361, 0.0, 0.0],
        [0.16242, 0.36299, 0.46899, 0.0],
        [0.15522993506504404, 0.2798615154713095, 0.40940128714545665, 0.15550726231818976],
    ],
    positions: [
        [0.03267, 0.0, 0.0, 0.0],
        [0.15208, 0.09345, 0.0, 0.0],
        [0.09695354226568687, 0.19371, 0.0759, 0.0],
        [0.14862514898647475, 0.23088485101352527, 0.10095, 0.01954],
    ],
    error: [-0.08619251623373898, 0.06996537886782737, 0.10235032178636416, 0.03887681557954744, -0.125],
    stability_limits: &[
        (0.0, 2.5),
        (0.02, 2.6),
        (0.03, 3.2),
        (0.1, 3.8),
        (0.15, 3.8),
        (0.2, 3.65),
        (0.22, 3.65),
        (0.25, 4.1),
        (0.45, 4.0),
        (0.54, 4.0),
        (0.64, 4.2),
        (0.8, 3.4),
        (0.9, 3.0),
        (0.96, 2.8),
        (1.0, 2.1),
        (1.04, 2.5),
        (1.19, 2.95),
        (1.22, 3.7),
    ],
};

#[cfg(test)]
mod tests {
    use super::*;

    const PAIR: Tableau = DAMPED_CONTACT;

    /// c, a, ā and both weights, with the shared stage's row left out of a and ā.
    struct Stages {
        c: [f64; STAGES],
        a: [[f64; STAGES]; STAGES],
        abar: [[f64; STAGES]; STAGES],
    }

    fn stages() -> Stages {
        let below = |rows: &[[f64; STAGES]; STAGES]| {
            let mut all = [[0.0; STAGES]; STAGES];
            all[1..].copy_from_slice(&rows[..STAGES - 1]);
            all
        };
        let mut c = [0.0; STAGES];
        c[1..].copy_from_slice(&PAIR.nodes[..STAGES - 1]);
        Stages { c, a: below(&PAIR.rates), abar: below(&PAIR.positions) }
    }

    fn dot(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }

    /// Sum over i of w_i times the products of the lists' i-th entries.
    fn sum<const N: usize>(w: &[f64; N], lists: &[[f64; N]]) -> f64 {
        (0..N).map(|i| w[i] * lists.iter().map(|l| l[i]).product::<f64>()).sum()
    }

    /// Conditions of q'' = f(t, q, q') (Hairer, Norsett, Wanner, Solving ODEs I, II.14), every tree up to the order.
    #[test]
    fn analytic_pair_has_third_order_and_its_estimate_second() {
        let Stages { c, a, abar } = stages();
        let ac = a.map(|row| dot(&row, &c));
        let u = abar.map(|row| row.iter().sum());
        let (b, bbar) = (PAIR.weights(), PAIR.positions[STAGES - 1]);
        let conditions = [
            ("b", sum(&b, &[]), 1.0),
            ("b c", sum(&b, &[c]), 1.0 / 2.0),
            ("b c c", sum(&b, &[c, c]), 1.0 / 3.0),
            ("b a c", sum(&b, &[ac]), 1.0 / 6.0),
            ("b ā", sum(&b, &[u]), 1.0 / 6.0),
            ("b̄", sum(&bbar, &[]), 1.0 / 2.0),
            ("b̄ c", sum(&bbar, &[c]), 1.0 / 6.0),
        ];
        for (name, is, should) in conditions {
            assert!((is - should).abs() < 1e-15, "{name}: {is}");
        }
        for (row, node) in a.iter().zip(c) {
            assert!((row.iter().sum::<f64>() - node).abs() < 1e-15);
        }
        let with_end = |list: [f64; STAGES], end: f64| {
            let mut all = [end; STAGES + 1];
            all[..STAGES].copy_from_slice(&list);
            all
        };
        let c = with_end(c, 1.0);
        let third = [
            sum(&PAIR.error, &[c, c]),
            2.0 * sum(&PAIR.error, &[with_end(ac, 0.5)]),
            2.0 * sum(&PAIR.error, &[with_end(u, 0.5)]),
        ];
        assert!(sum(&PAIR.error, &[]).abs() < 1e-15);
        assert!(sum(&PAIR.error, &[c]).abs() < 1e-15);
        for term in third {
            assert!((term + 1.0 / 24.0).abs() < 1e-15, "{third:?}");
        }
    }

    /// Largest |eigenvalue| of what a step does to (q, h v) of q'' + 2 zeta w q' + w^2 q = 0, for w h = `x`.
    fn amplification(x: f64, zeta: f64) -> f64 {
        let Stages { c, a, abar } = stages();
        let step = |q: f64, v: f64| {
            let mut f = [0.0; STAGES];
            for i in 0..STAGES {
                let at = q + c[i] * v + dot(&abar[i], &f);
                f[i] = -x * x * at - 2.0 * zeta * x * (v + dot(&a[i], &f));
            }
            [q + v + dot(&PAIR.positions[STAGES - 1], &f), v + dot(&PAIR.weights(), &f)]
        };
        let ([m00, m10], [m01, m11]) = (step(1.0, 0.0), step(0.0, 1.0));
        let (half, det) = (0.5 * (m00 + m11), m00 * m11 - m01 * m10);
        let root = half * half - det;
        if root > 0.0 { half.abs() + root.sqrt() } else { det.sqrt() }
    }

    #[test]
    fn analytic_motions_decay_in_every_step_that_is_allowed() {
        for k in 0..=400 {
            let zeta = 0.005 * f64::from(k);
            // The faster motion's |lambda| / w.
            let fast = zeta.max(1.0) + (zeta * zeta - 1.0).max(0.0).sqrt();
            let longest = PAIR.stability_limit(1.0, zeta);
            for share in 1..=100 {
                let reach = longest * f64::from(share) / 100.0;
                let most = match (reach > 1.0, zeta) {
                    // Slower than the step: nothing must grow. The slower motion of a strongly damped pair may be as
                    // slow as it likes.
                    (false, _) | (_, 1.2..) => 1.0,
                    (true, 0.3..) => 0.9,
                    // exp(-zeta) is what a step of 1 / |lambda| should leave.
                    (true, _) => 1.0 - 0.5 * zeta,
                };
                let left = amplification(reach / fast, zeta);
                assert!(left <= most + 1e-12, "zeta {zeta}, h |lambda| {reach}: {left}");
            }
        }
        // v' = -rate v.
        for share in 1..=100 {
            let reach = PAIR.stability_limit(1.0, f64::INFINITY) * f64::from(share) / 100.0;
            let left = amplification(1e-9 * reach, 0.5e9);
            assert!(left <= 1.0 + 1e-6, "h |lambda| {reach}: {left}");
        }
    }
}
