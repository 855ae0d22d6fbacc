//! Eight numbers at a time, and the elementary functions that the right-hand side spends its time in.
//!
//! [`Lanes`] is what the equations of motion are written in; `portable` holds it as an array, `x86` in the registers of AVX2
//! and AVX-512. Functions over lanes do not branch on a lane's value. The implementations differ in round-off alone: the
//! portable one rounds every product, the others fuse products with sums.

mod blend;
mod column;
mod functions;
mod portable;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use blend::{blend, inner_products, positive, weighted_square};
pub use column::Column;
pub(crate) use functions::ninth;
pub use functions::{exp, sin_cos, tanh, ten_ninths};
pub use portable::Portable;
#[cfg(target_arch = "x86_64")]
pub use x86::{Avx2, Avx512};

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// Numbers in a group.
pub const WIDTH: usize = 8;

/// Eight numbers.
pub trait Lanes:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
{
    /// The same number in every lane.
    fn splat(x: f64) -> Self;
    /// From an array.
    fn new(x: [f64; WIDTH]) -> Self;
    /// As an array.
    fn array(self) -> [f64; WIDTH];
    /// self * b + c, rounded once where the processor can.
    fn times_plus(self, b: Self, c: Self) -> Self;
    /// c - self * b, rounded once where the processor can.
    fn minus_times(self, b: Self, c: Self) -> Self;
    /// |self|.
    fn abs(self) -> Self;
    /// |self| with the sign of `sign`.
    fn with_sign(self, sign: Self) -> Self;
    /// `x` where self > other, else `y`.
    fn if_above(self, other: Self, x: Self, y: Self) -> Self;
    /// The lanes above `other`, a bit each.
    fn above(self, other: Self) -> u8;
    /// Bitwise and with a constant.
    fn and_bits(self, bits: u64) -> Self;
    /// Bitwise or with a constant.
    fn or_bits(self, bits: u64) -> Self;
    /// Bitwise and.
    fn and(self, other: Self) -> Self;
    /// Bitwise exclusive or.
    fn xor(self, other: Self) -> Self;
    /// Adds a constant to the bits, taken as an integer.
    fn add_bits(self, bits: u64) -> Self;
    /// Minus the bits, taken as an integer.
    fn minus_bits(self) -> Self;
    /// Shifts the bits up.
    fn shift_up<const N: i32>(self) -> Self;
    /// Shifts the bits down, filling with zeros.
    fn shift_down<const N: i32>(self) -> Self;

    /// Zeros.
    #[inline(always)]
    fn zero() -> Self {
        Self::splat(0.0)
    }

    /// Whether any lane is above 0.
    #[inline(always)]
    fn any_positive(self) -> bool {
        self.above(Self::zero()) != 0
    }

    /// max(self, 0), and 0 for what is not a number.
    fn positive_part(self) -> Self;
    /// max(self, other), and `other` for what is not a number.
    fn at_least(self, other: Self) -> Self;
    /// min(self, other), and `other` for what is not a number.
    fn at_most(self, other: Self) -> Self;

    /// self with the sign of `other` multiplied in, and 0 where `other` is 0.
    #[inline(always)]
    fn with_sign_of(self, other: Self) -> Self {
        let zero = Self::zero();
        other.if_above(zero, self, zero.if_above(other, -self, zero))
    }

    /// Sum of the lanes, in a fixed order.
    #[inline(always)]
    fn sum(self) -> f64 {
        let [a, b, c, d, e, f, g, h] = self.array();
        ((a + e) + (c + g)) + ((b + f) + (d + h))
    }
}
