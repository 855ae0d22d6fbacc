//! Lanes as an array: scalar code, or whatever the compiler makes of it.

use super::functions::elementary;
use super::{Lanes, assigning, grouped};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Numbers in a group: what fits the fewest registers without spilling.
const COUNT: usize = 4;

/// Numbers in an array. Products are rounded before they are added, but on 64-bit Arm, which always fuses.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(32))]
pub struct Portable(pub [f64; COUNT]);

impl Add for Portable {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl Sub for Portable {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl Mul for Portable {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl Div for Portable {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }
}

impl Neg for Portable {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.each(|a| -a)
    }
}

assigning!(Portable);

impl Lanes for Portable {
    type Pair = Self;
    grouped!(COUNT);
    elementary!();

    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self([x; COUNT])
    }

    #[inline(always)]
    fn new(x: [f64; COUNT]) -> Self {
        Self(x)
    }

    #[inline(always)]
    fn array(self) -> [f64; COUNT] {
        self.0
    }

    #[cfg(target_arch = "aarch64")]
    #[inline(always)]
    fn times_plus(self, b: Self, c: Self) -> Self {
        let mut out = [0.0; COUNT];
        for i in 0..COUNT {
            out[i] = self.0[i].mul_add(b.0[i], c.0[i]);
        }
        Self(out)
    }

    #[inline(always)]
    fn if_above(self, other: Self, x: Self, y: Self) -> Self {
        let mut out = [0.0; COUNT];
        for i in 0..COUNT {
            out[i] = if self.0[i] > other.0[i] { x.0[i] } else { y.0[i] };
        }
        Self(out)
    }
}
