//! Powers x^n of the load-deflection law, for x >= 0.

use crate::lanes::ninth;

/// The exponent n of Q = K delta^n, with the line contact's 10/9 done without `powf`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Exponent {
    /// n = 10/9: Palmgren's line contact.
    TenNinths,
    /// n = 3/2: Hertz's point contact.
    ThreeHalves,
    /// n = 1.
    One,
    /// Any other n > 0.
    Other(f64),
}

impl Exponent {
    /// Recognises 10/9 (to round-off of its decimal form), 3/2 and 1.
    pub fn new(n: f64) -> Self {
        if (n - 10.0 / 9.0).abs() < 1e-12 {
            Self::TenNinths
        } else if n == 1.5 {
            Self::ThreeHalves
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
            Self::ThreeHalves => 1.5,
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
            Self::TenNinths => ten_ninths(x),
            Self::ThreeHalves => x * x.sqrt(),
            Self::One => x,
            Self::Other(n) => x.powf(n),
        }
    }
}

/// x^(8/9) for x >= 0, relative error below 3e-15.
#[inline]
pub fn eight_ninths(x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    let (z, rest) = inverse_ninth_root(x);
    x * z * series(rest, ninth::ONE)
}

/// x^(10/9) for x > 0, relative error below 5e-15 for normal x: one number's share of [`crate::lanes::ten_ninths`], which says how.
#[inline]
fn ten_ninths(x: f64) -> f64 {
    let (z, rest) = inverse_ninth_root(x);
    let square = z * z;
    let root = square * square * x;
    root * root * series(rest, ninth::EIGHT)
}

/// z = x^(-1/9) to 3e-5, and 1 - x z^9.
#[inline]
fn inverse_ninth_root(x: f64) -> (f64, f64) {
    let upper = (x.to_bits() >> 32) as f64;
    let guess = f64::from_bits(((ninth::ORIGIN - upper * (1.0 / 9.0)) as u64) << 32);
    let rest = |z: f64| {
        let cube = z * z * z;
        1.0 - cube * cube * (cube * x)
    };
    let z = guess * series(rest(guess), ninth::FIT);
    (z, rest(z))
}

/// A polynomial, highest coefficient first.
#[inline]
fn series<const N: usize>(x: f64, coefficients: [f64; N]) -> f64 {
    coefficients.into_iter().fold(0.0, |sum, c| sum * x + c)
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
