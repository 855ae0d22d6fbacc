//! One number as a group of one lane, with the functions of the standard library: slow, and plain to follow in a
//! debugger.

use super::{Lanes, grouped, ninth};

impl Lanes for f64 {
    type Pair = Self;
    grouped!(1);

    #[inline(always)]
    fn splat(x: f64) -> Self {
        x
    }

    #[inline(always)]
    fn new(x: [f64; 1]) -> Self {
        x[0]
    }

    #[inline(always)]
    fn array(self) -> [f64; 1] {
        [self]
    }

    #[inline(always)]
    fn times_plus(self, b: Self, c: Self) -> Self {
        self * b + c
    }

    #[inline(always)]
    fn minus_times(self, b: Self, c: Self) -> Self {
        c - self * b
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }

    #[inline(always)]
    fn with_sign(self, sign: Self) -> Self {
        self.copysign(sign)
    }

    #[inline(always)]
    fn if_above(self, other: Self, x: Self, y: Self) -> Self {
        if self > other { x } else { y }
    }

    #[inline(always)]
    fn above(self, other: Self) -> u8 {
        u8::from(self > other)
    }

    #[inline(always)]
    fn and_bits(self, bits: u64) -> Self {
        f64::from_bits(self.to_bits() & bits)
    }

    #[inline(always)]
    fn or_bits(self, bits: u64) -> Self {
        f64::from_bits(self.to_bits() | bits)
    }

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        f64::from_bits(self.to_bits() & other.to_bits())
    }

    #[inline(always)]
    fn xor(self, other: Self) -> Self {
        f64::from_bits(self.to_bits() ^ other.to_bits())
    }

    #[inline(always)]
    fn add_bits(self, bits: u64) -> Self {
        f64::from_bits(self.to_bits().wrapping_add(bits))
    }

    #[inline(always)]
    fn minus_bits(self) -> Self {
        f64::from_bits(self.to_bits().wrapping_neg())
    }

    #[inline(always)]
    fn shift_up<const N: i32>(self) -> Self {
        f64::from_bits(self.to_bits() << N)
    }

    #[inline(always)]
    fn shift_down<const N: i32>(self) -> Self {
        f64::from_bits(self.to_bits() >> N)
    }

    #[inline(always)]
    fn positive_part(self) -> Self {
        self.at_least(0.0)
    }

    #[inline(always)]
    fn at_least(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> Self {
        if self < other { self } else { other }
    }

    #[inline(always)]
    fn sum(self) -> f64 {
        self
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        f64::sin_cos(self)
    }

    #[inline(always)]
    fn exp(self) -> Self {
        f64::exp(self)
    }

    #[inline(always)]
    fn tanh(self) -> Self {
        f64::tanh(self)
    }

    #[inline(always)]
    fn ten_ninths(self) -> Self {
        ninth::ten_ninths(self)
    }
}
