//! Powers x^n of the load-deflection law, for x >= 0.

use crate::lanes::Lanes;

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
    /// Recognises 10/9 (to nine decimals, as people write it), 3/2 and 1.
    pub fn new(n: f64) -> Self {
        if (n - 10.0 / 9.0).abs() < 1e-9 {
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

    /// `[x]_+^n` of each lane.
    #[inline(always)]
    pub fn of<L: Lanes>(self, x: L) -> L {
        match self {
            Self::TenNinths => x.ten_ninths(),
            Self::ThreeHalves => {
                let x = x.positive_part();
                x * x.sqrt()
            }
            Self::One => x.positive_part(),
            Self::Other(n) => x.each(|x| if x > 0.0 { x.powf(n) } else { 0.0 }),
        }
    }
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
    fn prop_ten_ninths_is_recognised_as_people_write_it() {
        for n in [10.0 / 9.0, 1.111111111, 1.1111111111, 1.111_111_111_111_111] {
            assert_eq!(Exponent::new(n), Exponent::TenNinths, "{n}");
        }
        assert_eq!(Exponent::new(1.1111), Exponent::Other(1.1111));
    }

    #[test]
    fn analytic_no_power_of_a_gap() {
        for n in [1.0, 10.0 / 9.0, 1.5] {
            assert_eq!(Exponent::new(n).of(0.0), 0.0);
            assert_eq!(Exponent::new(n).of(-1e-6), 0.0);
        }
    }
}
