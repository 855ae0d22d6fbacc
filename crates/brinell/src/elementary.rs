//! Powers x^n of the load-deflection law, for x >= 0.

/// The exponent n of Q = K delta^n, with the line contact's 10/9 done without `powf`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Exponent {
    /// n = 10/9: Palmgren's line contact.
    TenNinths,
    /// n = 1.
    One,
    /// Any other n > 0.
    Other(f64),
}

impl Exponent {
    /// Recognises 10/9 (to round-off of its decimal form) and 1.
    pub fn new(n: f64) -> Self {
        if (n - 10.0 / 9.0).abs() < 1e-12 {
            Self::TenNinths
        } else if n == 1.0 {
            Self::One
        } else {
            Self::Other(n)
        }
    }

    /// n.
    pub fn value(self) -> f64 {
        match self {
            Self::TenNinths => 10.0 / 9.0,
            Self::One => 1.0,
            Self::Other(n) => n,
        }
    }

    /// `[x]_+^n`.
    #[inline]
    pub fn of(self, x: f64) -> f64 {
        if x <= 0.0 {
            return 0.0;
        }
        match self {
            Self::TenNinths => x / inverse_ninth_root(x),
            Self::One => x,
            Self::Other(n) => x.powf(n),
        }
    }
}

/// x^(8/9) for x >= 0, relative error below 3e-15.
#[inline]
pub fn eight_ninths(x: f64) -> f64 {
    if x > 0.0 {
        x * inverse_ninth_root(x)
    } else {
        0.0
    }
}

/// x^(-1/9) for x > 0, relative error below 1e-15 for normal x. One number's share of
/// [`crate::lanes::ten_ninths`], which says how.
#[inline]
fn inverse_ninth_root(x: f64) -> f64 {
    use crate::lanes::ninth::{FIT, ORIGIN, SERIES};
    let upper = (x.to_bits() >> 32) as f64;
    let mut z = f64::from_bits(((ORIGIN - upper * (1.0 / 9.0)) as u64) << 32);
    for [c3, c2, c1, c0] in [FIT, SERIES] {
        let z3 = z * z * z;
        let e = 1.0 - x * (z3 * z3 * z3);
        z *= ((c3 * e + c2) * e + c1) * e + c0;
    }
    z
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_ten_ninths_agrees_with_powf_over_the_range_of_deflections() {
        let mut worst: f64 = 0.0;
        for i in 0..200_000 {
            let x = 10f64.powf(-20.0 + 26.0 * f64::from(i) / 200_000.0);
            let exact = x.powf(10.0 / 9.0);
            worst = worst.max((Exponent::TenNinths.of(x) / exact - 1.0).abs());
        }
        assert!(worst < 4e-15, "relative error {worst:e}");
    }

    #[test]
    fn analytic_eight_ninths_agrees_with_powf() {
        for i in 0..100_000 {
            let x = f64::from(i) / 1e5;
            assert!((eight_ninths(x) - x.powf(8.0 / 9.0)).abs() <= 3e-15 * x.powf(8.0 / 9.0));
        }
    }

    #[test]
    fn analytic_no_power_of_a_gap() {
        for n in [1.0, 10.0 / 9.0, 1.5] {
            assert_eq!(Exponent::new(n).of(0.0), 0.0);
            assert_eq!(Exponent::new(n).of(-1e-6), 0.0);
        }
    }
}
