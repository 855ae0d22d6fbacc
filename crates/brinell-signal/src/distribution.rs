//! Tails of the distributions that spectral estimates of noise follow: chi-square, F, the normal one, and their
//! quantiles.
//!
//! Incomplete gamma and beta functions are those of `statrs`; relative errors are below 1e-10 for up to 1e4 degrees of
//! freedom.

use statrs::distribution::{ContinuousCDF, Normal};
use statrs::function::beta::checked_beta_reg;
use statrs::function::gamma::checked_gamma_ur;

/// P(chi-square with `freedom` degrees of freedom > x): the false-alarm probability of a power `x / freedom` times the
/// mean of noise. 1 for x <= 0; NaN where `freedom` is not positive.
pub fn chi_square_tail(x: f64, freedom: f64) -> f64 {
    if x <= 0.0 {
        return 1.0;
    }
    checked_gamma_ur(0.5 * freedom, 0.5 * x).unwrap_or(f64::NAN)
}

/// The value that chi-square with `freedom` degrees of freedom stays below with probability `p` (0 to 1), by bisection;
/// p comes back to 1e-15; beyond 1e8 degrees of freedom, where that takes long, by the cube of E. B. Wilson and M. M. Hilferty,
/// Proc. Natl. Acad. Sci. 17 (1931) 684-688. Infinite for 1; NaN where `freedom` is not positive or p is not a probability.
pub fn chi_square_quantile(p: f64, freedom: f64) -> f64 {
    if !((0.0..=1.0).contains(&p) && freedom > 0.0 && freedom.is_finite()) {
        return f64::NAN;
    }
    if p == 1.0 {
        return f64::INFINITY;
    }
    if freedom > 1e8 {
        let variance = 2.0 / (9.0 * freedom);
        return freedom * (1.0 - variance + normal_quantile(p) * variance.sqrt()).powi(3).max(0.0);
    }
    let mut high = freedom.max(1.0);
    while 1.0 - chi_square_tail(high, freedom) < p && high < 1e9 {
        high *= 2.0;
    }
    let mut low = 0.0;
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if 1.0 - chi_square_tail(middle, freedom) < p {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// P(standard normal > z).
pub fn normal_tail(z: f64) -> f64 {
    // By the incomplete gamma function: statrs 0.19's erfc is good to 1e-10 only.
    let outer = 0.5 * chi_square_tail(z * z, 1.0);
    if z > 0.0 { outer } else { 1.0 - outer }
}

/// The value that the standard normal stays below with probability `p`; infinite for 0 and 1. Relative
/// error below 1e-15 for p from 1e-16 up.
///
/// # Panics
/// Where p is not between 0 and 1.
pub fn normal_quantile(p: f64) -> f64 {
    Normal::standard().inverse_cdf(p)
}

/// P(F > x) with `d1` and `d2` degrees of freedom: the false-alarm probability of a power of `d1` degrees of freedom
/// `x` times its mean, where that mean is itself estimated with `d2`. NaN where one of them is not positive.
pub fn f_tail(x: f64, d1: f64, d2: f64) -> f64 {
    if x <= 0.0 {
        return 1.0;
    }
    checked_beta_reg(0.5 * d2, 0.5 * d1, d2 / (d2 + d1 * x)).unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_exponential_and_erlang_tails() {
        for x in [0.1, 1.0, 7.0, 60.0] {
            assert!((chi_square_tail(2.0 * x, 2.0) / (-x).exp() - 1.0).abs() < 1e-12);
            let erlang = (-x).exp() * (1.0 + x + 0.5 * x * x);
            assert!((chi_square_tail(2.0 * x, 6.0) / erlang - 1.0).abs() < 1e-12);
            // F with two degrees of freedom above: (1 + 2 x / d2)^(-d2 / 2).
            let f = (1.0 + 2.0 * x / 30.0).powf(-15.0);
            assert!((f_tail(x, 2.0, 30.0) / f - 1.0).abs() < 1e-11);
        }
    }

    #[test]
    fn xval_normal_quantiles() {
        // SciPy 1.17.1, scipy.stats.norm.ppf.
        for (p, z) in [
            (0.5, 0.0),
            (0.75, 0.674_489_750_196_081_7),
            (0.025, -1.959_963_984_540_054_5),
            (0.999, 3.090_232_306_167_813),
            (1e-6, -4.753_424_308_822_899),
            (0.500_001, 2.506_628_274_705_705_2e-6),
        ] {
            let found = normal_quantile(p);
            assert!((found - z).abs() <= 1e-9 * z.abs().max(1e-6), "{p}: {found}");
            assert!((normal_tail(-found) - p).abs() < 1e-12 * p.max(1e-3), "{p}");
        }
        assert_eq!(normal_quantile(0.0), f64::NEG_INFINITY);
        assert_eq!(normal_quantile(1.0), f64::INFINITY);
    }

    #[test]
    fn prop_quantile_inverts_the_tail() {
        for freedom in [1.0, 2.0, 7.5, 300.0] {
            for p in [0.001, 0.025, 0.5, 0.975, 0.999] {
                let x = chi_square_quantile(p, freedom);
                assert!((1.0 - chi_square_tail(x, freedom) - p).abs() < 1e-12);
            }
        }
        // Where the cube begins it is off by less than a millionth of the scatter.
        for p in [1e-6, 0.5, 0.975] {
            let [below, above] = [1e8, 1.000_000_01e8].map(|n| (chi_square_quantile(p, n) - n) / (2.0 * n).sqrt());
            assert!((below - above).abs() < 1e-6, "{p}: {below} {above}");
        }
        assert_eq!(chi_square_quantile(0.5, 1e300), 1e300);
        assert_eq!(chi_square_quantile(1.0, 2.0), f64::INFINITY);
        for (p, freedom) in [(0.5, -3.0), (2.0, 2.0), (-0.1, 2.0), (f64::NAN, 2.0), (0.5, f64::NAN), (0.5, 0.0)] {
            assert!(chi_square_quantile(p, freedom).is_nan(), "{p} {freedom}");
        }
    }
}
