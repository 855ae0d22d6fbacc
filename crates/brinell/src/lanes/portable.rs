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

impl Portable {
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut out = [0.0; COUNT];
        for i in 0..COUNT {
            out[i] = f(self.0[i]);
        }
        Self(out)
    }

    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut out = [0.0; COUNT];
        for i in 0..COUNT {
            out[i] = f(self.0[i], other.0[i]);
        }
        Self(out)
    }

    #[inline(always)]
    fn bits(self, f: impl Fn(u64) -> u64) -> Self {
        self.map(|x| f64::from_bits(f(x.to_bits())))
    }
}

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
        self.map(|a| -a)
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

    #[inline(always)]
    fn times_plus(self, b: Self, c: Self) -> Self {
        let mut out = [0.0; COUNT];
        for i in 0..COUNT {
            out[i] = if cfg!(target_arch = "aarch64") {
                self.0[i].mul_add(b.0[i], c.0[i])
            } else {
                self.0[i] * b.0[i] + c.0[i]
            };
        }
        Self(out)
    }

    #[inline(always)]
    fn minus_times(self, b: Self, c: Self) -> Self {
        (-self).times_plus(b, c)
    }

    #[inline(always)]
    fn positive_part(self) -> Self {
        self.map(|x| if x > 0.0 { x } else { 0.0 })
    }

    #[inline(always)]
    fn at_least(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.map(f64::abs)
    }

    #[inline(always)]
    fn with_sign(self, sign: Self) -> Self {
        self.zip(sign, f64::copysign)
    }

    #[inline(always)]
    fn if_above(self, other: Self, x: Self, y: Self) -> Self {
        let mut out = [0.0; COUNT];
        for i in 0..COUNT {
            out[i] = if self.0[i] > other.0[i] { x.0[i] } else { y.0[i] };
        }
        Self(out)
    }

    #[inline(always)]
    fn above(self, other: Self) -> u8 {
        let mut bits = 0;
        for (lane, (x, y)) in self.0.into_iter().zip(other.0).enumerate() {
            bits |= u8::from(x > y) << lane;
        }
        bits
    }

    #[inline(always)]
    fn and_bits(self, bits: u64) -> Self {
        self.bits(|x| x & bits)
    }

    #[inline(always)]
    fn or_bits(self, bits: u64) -> Self {
        self.bits(|x| x | bits)
    }

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        self.zip(other, |a, b| f64::from_bits(a.to_bits() & b.to_bits()))
    }

    #[inline(always)]
    fn xor(self, other: Self) -> Self {
        self.zip(other, |a, b| f64::from_bits(a.to_bits() ^ b.to_bits()))
    }

    #[inline(always)]
    fn add_bits(self, bits: u64) -> Self {
        self.bits(|x| x.wrapping_add(bits))
    }

    #[inline(always)]
    fn minus_bits(self) -> Self {
        self.bits(u64::wrapping_neg)
    }

    #[inline(always)]
    fn shift_up<const N: i32>(self) -> Self {
        self.bits(|x| x << N)
    }

    #[inline(always)]
    fn shift_down<const N: i32>(self) -> Self {
        self.bits(|x| x >> N)
    }

    #[inline(always)]
    fn sum(self) -> f64 {
        let mut list = self.0;
        let mut half = COUNT / 2;
        while half > 0 {
            for k in 0..half {
                list[k] += list[k + half];
            }
            half /= 2;
        }
        list[0]
    }
}
