//! Four numbers in two registers of WebAssembly's `simd128`, rounded as the array of `portable` rounds: the same bits
//! in every browser, and with or without these instructions.

use super::functions::elementary;
use super::{Lanes, assigning, grouped};
use std::arch::wasm32::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// What [`Kernel::Portable`](crate::kernel::Kernel) computes with where there is `simd128`.
#[derive(Debug, Clone, Copy)]
pub struct Portable(v128, v128);

/// The same with both halves.
macro_rules! halved {
    ($(fn $method:ident($($x:ident),*) $body:expr;)*) => {
        $(#[inline(always)]
        fn $method(self, $($x: Self),*) -> Self {
            Self($body(self.0, $($x.0),*), $body(self.1, $($x.1),*))
        })*
    };
}

macro_rules! operators {
    ($($trait:ident $method:ident $body:expr;)*) => {
        $(impl $trait for Portable {
            type Output = Self;
            halved! { fn $method(other) $body; }
        })*
    };
}

operators! {
    Add add f64x2_add;
    Sub sub f64x2_sub;
    Mul mul f64x2_mul;
    Div div f64x2_div;
}

impl Neg for Portable {
    type Output = Self;
    halved! { fn neg() f64x2_neg; }
}

assigning!(Portable);

impl Portable {
    #[inline(always)]
    fn constant(bits: u64) -> v128 {
        u64x2_splat(bits)
    }
}

impl Lanes for Portable {
    type Pair = Self;
    grouped!(4);
    elementary!();

    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self(f64x2_splat(x), f64x2_splat(x))
    }

    #[inline(always)]
    fn new(x: [f64; 4]) -> Self {
        Self(f64x2(x[0], x[1]), f64x2(x[2], x[3]))
    }

    #[inline(always)]
    fn array(self) -> [f64; 4] {
        let two = |x| [f64x2_extract_lane::<0>(x), f64x2_extract_lane::<1>(x)];
        let ([a, b], [c, d]) = (two(self.0), two(self.1));
        [a, b, c, d]
    }

    halved! {
        fn at_least(other) |a, b| f64x2_pmax(b, a);
        fn at_most(other) |a, b| f64x2_pmin(b, a);
        fn sqrt() f64x2_sqrt;
        fn abs() f64x2_abs;
        fn with_sign(sign) |x, s| v128_bitselect(s, x, f64x2_splat(-0.0));
        fn and(other) v128_and;
        fn xor(other) v128_xor;
        fn minus_bits() i64x2_neg;
    }

    #[inline(always)]
    fn if_above(self, other: Self, x: Self, y: Self) -> Self {
        Self(v128_bitselect(x.0, y.0, f64x2_gt(self.0, other.0)), v128_bitselect(x.1, y.1, f64x2_gt(self.1, other.1)))
    }

    #[inline(always)]
    fn above(self, other: Self) -> u8 {
        let mask = |a, b| i64x2_bitmask(f64x2_gt(a, b));
        mask(self.0, other.0) | mask(self.1, other.1) << 2
    }

    #[inline(always)]
    fn and_bits(self, bits: u64) -> Self {
        let with = Self::constant(bits);
        Self(v128_and(self.0, with), v128_and(self.1, with))
    }

    #[inline(always)]
    fn or_bits(self, bits: u64) -> Self {
        let with = Self::constant(bits);
        Self(v128_or(self.0, with), v128_or(self.1, with))
    }

    #[inline(always)]
    fn add_bits(self, bits: u64) -> Self {
        let with = Self::constant(bits);
        Self(i64x2_add(self.0, with), i64x2_add(self.1, with))
    }

    #[inline(always)]
    fn shift_up<const N: i32>(self) -> Self {
        Self(i64x2_shl(self.0, N as u32), i64x2_shl(self.1, N as u32))
    }

    #[inline(always)]
    fn shift_down<const N: i32>(self) -> Self {
        Self(u64x2_shr(self.0, N as u32), u64x2_shr(self.1, N as u32))
    }

    #[inline(always)]
    fn sum(self) -> f64 {
        let two = f64x2_add(self.0, self.1);
        f64x2_extract_lane::<0>(two) + f64x2_extract_lane::<1>(two)
    }
}
