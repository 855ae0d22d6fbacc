//! Two groups as one: what is worked on side by side shares its constants and does not wait for itself.

use super::{Avx2, Lanes, assigning, grouped};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Eight numbers in two registers of AVX2.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Avx2Pair(Avx2, Avx2);

macro_rules! by_halves {
    ($($trait:ident $method:ident $operator:tt;)*) => {
        $(impl $trait for Avx2Pair {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0 $operator other.0, self.1 $operator other.1)
            }
        })*
    };
}

by_halves! {
    Add add +;
    Sub sub -;
    Mul mul *;
    Div div /;
}

impl Neg for Avx2Pair {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

assigning!(Avx2Pair);

/// Functions of [`Lanes`] that do the same to both halves.
macro_rules! halved {
    ($($method:ident($($lanes:ident),*; $($bits:ident)?);)*) => {
        $(#[inline(always)]
        fn $method(self, $($lanes: Self,)* $($bits: u64)?) -> Self {
            Self(
                self.0.$method($($lanes.0,)* $($bits)?),
                self.1.$method($($lanes.1,)* $($bits)?),
            )
        })*
    };
}

impl Lanes for Avx2Pair {
    type Pair = Self;
    grouped!(8);

    #[inline(always)]
    fn splat(x: f64) -> Self {
        let half = Avx2::splat(x);
        Self(half, half)
    }

    #[inline(always)]
    fn new(x: [f64; 8]) -> Self {
        let halves = Avx2::groups(&x);
        Self(Avx2::new(halves[0]), Avx2::new(halves[1]))
    }

    #[inline(always)]
    fn array(self) -> [f64; 8] {
        let mut out = [0.0; 8];
        let halves = Avx2::groups_mut(&mut out);
        (halves[0], halves[1]) = (self.0.array(), self.1.array());
        out
    }

    halved! {
        times_plus(b, c;);
        minus_times(b, c;);
        abs(;);
        sqrt(;);
        with_sign(sign;);
        if_above(other, x, y;);
        and_bits(; bits);
        or_bits(; bits);
        and(other;);
        xor(other;);
        add_bits(; bits);
        minus_bits(;);
        positive_part(;);
        at_least(other;);
        at_most(other;);
    }

    #[inline(always)]
    fn above(self, other: Self) -> u8 {
        self.0.above(other.0) | self.1.above(other.1) << Avx2::COUNT
    }

    #[inline(always)]
    fn shift_up<const N: i32>(self) -> Self {
        Self(self.0.shift_up::<N>(), self.1.shift_up::<N>())
    }

    #[inline(always)]
    fn shift_down<const N: i32>(self) -> Self {
        Self(self.0.shift_down::<N>(), self.1.shift_down::<N>())
    }

    #[inline(always)]
    fn sum(self) -> f64 {
        (self.0 + self.1).sum()
    }
}
