//! Several numbers at a time, and the elementary functions that the right-hand side spends its time in.
//!
//! [`Lanes`] is what the equations of motion are written in: a group of numbers as wide as a register, or as two
//! ([`Lanes::Pair`]). `one` is a single number, `portable` an array (`wasm` two registers of WebAssembly), `x86` a
//! register of AVX2 (four) or AVX-512 (eight). Functions over lanes do not branch on a lane's value. The
//! implementations differ in round-off alone: the portable one rounds every product, the others fuse products with
//! sums. What the portable one computes, `Rounded` of `x86` computes to the bit, twice as fast.
//!
//! The lanes of `x86` are this crate's own: whoever makes one must have asked the processor first, which safe code
//! elsewhere need not.
//!
//! ```compile_fail
//! use brinell::lanes::{Avx512, Lanes};
//! Avx512::splat(2.0);
//! ```

mod blend;
mod column;
pub mod functions;
mod ninth;
mod one;
#[cfg(not(target_feature = "simd128"))]
mod portable;
#[cfg(target_feature = "simd128")]
mod wasm;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use blend::{blend, inner_products, positive, weighted_square};
pub use column::Column;
pub(crate) use ninth::eight_ninths;
#[cfg(not(target_feature = "simd128"))]
pub use portable::Portable;
#[cfg(target_feature = "simd128")]
pub use wasm::Portable;
#[cfg(target_arch = "x86_64")]
pub(crate) use x86::{Avx2, Avx512, Rounded};

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// Numbers in the widest group. Lists of numbers are padded to a multiple of it, so that each is a whole number of any
/// lanes' groups.
pub const WIDTH: usize = 8;

/// A group of numbers. What is given here goes lane by lane; the lanes of registers have an instruction for most of it.
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
    /// Two groups at once, for long chains of operations that wait for one another; a group itself where it is the
    /// widest, or two of them would not fit the registers.
    type Pair: Lanes;
    /// Numbers in a group: 1, 4 or 8.
    const COUNT: usize;
    /// An array of them.
    type Group: Copy + AsRef<[f64]> + AsMut<[f64]>;

    /// The groups of a list; an incomplete one at the end is left out.
    fn groups(list: &[f64]) -> &[Self::Group];
    /// The same to write to.
    fn groups_mut(list: &mut [f64]) -> &mut [Self::Group];
    /// The same number in every lane.
    fn splat(x: f64) -> Self;
    /// From an array.
    fn new(x: Self::Group) -> Self;
    /// As an array.
    fn array(self) -> Self::Group;
    /// `x` where self > other, else `y`.
    fn if_above(self, other: Self, x: Self, y: Self) -> Self;

    /// Each lane through a function of single numbers.
    #[inline(always)]
    fn each(self, f: impl Fn(f64) -> f64) -> Self {
        let mut group = self.array();
        for x in group.as_mut() {
            *x = f(*x);
        }
        Self::new(group)
    }

    /// Each lane with that of `other` through a function of single numbers.
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let (mut group, other) = (self.array(), other.array());
        for (x, y) in group.as_mut().iter_mut().zip(other.as_ref()) {
            *x = f(*x, *y);
        }
        Self::new(group)
    }

    /// The bits of each lane through a function.
    #[inline(always)]
    fn bits(self, f: impl Fn(u64) -> u64) -> Self {
        self.each(|x| f64::from_bits(f(x.to_bits())))
    }

    /// self * b + c, rounded once where the processor can.
    #[inline(always)]
    fn times_plus(self, b: Self, c: Self) -> Self {
        self * b + c
    }

    /// c - self * b, rounded once where the processor can.
    #[inline(always)]
    fn minus_times(self, b: Self, c: Self) -> Self {
        (-self).times_plus(b, c)
    }

    /// |self|.
    #[inline(always)]
    fn abs(self) -> Self {
        self.and_bits(!(1 << 63))
    }

    /// Square root.
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.each(f64::sqrt)
    }

    /// |self| with the sign of `sign`.
    #[inline(always)]
    fn with_sign(self, sign: Self) -> Self {
        self.abs().xor(sign.and_bits(1 << 63))
    }

    /// The lanes above `other`, a bit each.
    #[inline(always)]
    fn above(self, other: Self) -> u8 {
        let (group, other) = (self.array(), other.array());
        let mut bits = 0;
        for (lane, (x, y)) in group.as_ref().iter().zip(other.as_ref()).enumerate() {
            bits |= u8::from(x > y) << lane;
        }
        bits
    }

    /// Bitwise and with a constant.
    #[inline(always)]
    fn and_bits(self, bits: u64) -> Self {
        self.bits(|x| x & bits)
    }

    /// Bitwise or with a constant.
    #[inline(always)]
    fn or_bits(self, bits: u64) -> Self {
        self.bits(|x| x | bits)
    }

    /// Bitwise and.
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        self.zip(other, |a, b| f64::from_bits(a.to_bits() & b.to_bits()))
    }

    /// Bitwise exclusive or.
    #[inline(always)]
    fn xor(self, other: Self) -> Self {
        self.zip(other, |a, b| f64::from_bits(a.to_bits() ^ b.to_bits()))
    }

    /// Adds a constant to the bits, taken as an integer.
    #[inline(always)]
    fn add_bits(self, bits: u64) -> Self {
        self.bits(|x| x.wrapping_add(bits))
    }

    /// Minus the bits, taken as an integer.
    #[inline(always)]
    fn minus_bits(self) -> Self {
        self.bits(u64::wrapping_neg)
    }

    /// Shifts the bits up.
    #[inline(always)]
    fn shift_up<const N: i32>(self) -> Self {
        self.bits(|x| x << N)
    }

    /// Shifts the bits down, filling with zeros.
    #[inline(always)]
    fn shift_down<const N: i32>(self) -> Self {
        self.bits(|x| x >> N)
    }

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
    #[inline(always)]
    fn positive_part(self) -> Self {
        self.at_least(Self::zero())
    }

    /// max(self, other), and `other` for what is not a number.
    #[inline(always)]
    fn at_least(self, other: Self) -> Self {
        self.if_above(other, self, other)
    }

    /// min(self, other), and `other` for what is not a number.
    #[inline(always)]
    fn at_most(self, other: Self) -> Self {
        other.if_above(self, self, other)
    }

    /// self with the sign of `other` multiplied in, and 0 where `other` is 0.
    #[inline(always)]
    fn with_sign_of(self, other: Self) -> Self {
        let zero = Self::zero();
        other.if_above(zero, self, zero.if_above(other, -self, zero))
    }

    /// Sum of the lanes, in a fixed order.
    #[inline(always)]
    fn sum(self) -> f64 {
        let mut group = self.array();
        let list = group.as_mut();
        let mut half = Self::COUNT / 2;
        while half > 0 {
            for k in 0..half {
                list[k] += list[k + half];
            }
            half /= 2;
        }
        list[0]
    }

    /// (sin x, cos x), |x| <= 1e5.
    fn sin_cos(self) -> (Self, Self);
    /// e^x, |x| <= 700.
    fn exp(self) -> Self;
    /// tanh x.
    fn tanh(self) -> Self;
    /// `[x]_+^(10/9)`.
    fn ten_ninths(self) -> Self;
}

/// `+=` and `-=` by `+` and `-`.
macro_rules! assigning {
    ($type:ident) => {
        impl std::ops::AddAssign for $type {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }
        impl std::ops::SubAssign for $type {
            #[inline(always)]
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }
    };
}
use assigning;

/// What [`Lanes`] says of groups, for arrays of `$count`.
macro_rules! grouped {
    ($count:expr) => {
        const COUNT: usize = $count;
        type Group = [f64; $count];

        #[inline(always)]
        fn groups(list: &[f64]) -> &[Self::Group] {
            list.as_chunks().0
        }

        #[inline(always)]
        fn groups_mut(list: &mut [f64]) -> &mut [Self::Group] {
            list.as_chunks_mut().0
        }
    };
}
use grouped;
