//! Lanes in a register of x86-64: eight numbers with AVX-512, four with AVX2. [`Rounded`] computes what the portable
//! lanes do, to the bit.
//!
//! Values of these types must only be used in functions compiled for their instructions; the equations of motion are
//! entered through such functions alone, after the processor has been asked.

use super::functions::elementary;
use super::{Lanes, assigning, grouped};
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

macro_rules! operators {
    ($type:ident $floats:ident $ints:ident, $($trait:ident $method:ident $body:expr;)*) => {
        $(impl $trait for $type {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: see the module.
                unsafe { $body(self, other) }
            }
        })*
        impl Neg for $type {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                self.xor(Self::splat(-0.0))
            }
        }
        assigning!($type);
        impl $type {
            #[inline(always)]
            fn int(self) -> $ints {
                // SAFETY: same size, every bit pattern is valid.
                unsafe { std::mem::transmute::<$floats, $ints>(self.0) }
            }

            #[inline(always)]
            fn from_int(x: $ints) -> Self {
                // SAFETY: as above.
                Self(unsafe { std::mem::transmute::<$ints, $floats>(x) })
            }
        }
    };
}

/// Functions of [`Lanes`] that are one instruction of either width.
macro_rules! alike {
    ($count:literal; splat $splat:ident new $new:ident array $array:ident times_plus $times_plus:ident minus_times $minus_times:ident
     at_least $at_least:ident at_most $at_most:ident sqrt $sqrt:ident) => {
        grouped!($count);
        elementary!();

        #[inline(always)]
        fn splat(x: f64) -> Self {
            unsafe { Self($splat(x)) }
        }

        #[inline(always)]
        fn new(x: [f64; $count]) -> Self {
            unsafe { Self($new(x.as_ptr())) }
        }

        #[inline(always)]
        fn array(self) -> [f64; $count] {
            let mut out = [0.0; $count];
            unsafe { $array(out.as_mut_ptr(), self.0) };
            out
        }

        #[inline(always)]
        fn times_plus(self, b: Self, c: Self) -> Self {
            unsafe { Self($times_plus(self.0, b.0, c.0)) }
        }

        #[inline(always)]
        fn minus_times(self, b: Self, c: Self) -> Self {
            unsafe { Self($minus_times(self.0, b.0, c.0)) }
        }

        #[inline(always)]
        fn at_least(self, other: Self) -> Self {
            unsafe { Self($at_least(self.0, other.0)) }
        }

        #[inline(always)]
        fn at_most(self, other: Self) -> Self {
            unsafe { Self($at_most(self.0, other.0)) }
        }

        #[inline(always)]
        fn sqrt(self) -> Self {
            unsafe { Self($sqrt(self.0)) }
        }
    };
}

/// Sum in the order of [`Lanes::sum`].
///
/// # Safety
/// As for the module.
#[inline(always)]
unsafe fn sum_of_four(x: __m256d) -> f64 {
    unsafe {
        let two = _mm_add_pd(_mm256_castpd256_pd128(x), _mm256_extractf128_pd::<1>(x));
        _mm_cvtsd_f64(_mm_add_sd(two, _mm_unpackhi_pd(two, two)))
    }
}

/// Eight numbers in one register of AVX-512.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Avx512(__m512d);

operators! {
    Avx512 __m512d __m512i,
    Add add |a: Self, b: Self| Self(_mm512_add_pd(a.0, b.0));
    Sub sub |a: Self, b: Self| Self(_mm512_sub_pd(a.0, b.0));
    Mul mul |a: Self, b: Self| Self(_mm512_mul_pd(a.0, b.0));
    Div div |a: Self, b: Self| Self(_mm512_div_pd(a.0, b.0));
}

// SAFETY of every block: see the module.
impl Lanes for Avx512 {
    type Pair = Self;
    alike! {
        8; splat _mm512_set1_pd new _mm512_loadu_pd array _mm512_storeu_pd times_plus _mm512_fmadd_pd minus_times _mm512_fnmadd_pd
        at_least _mm512_max_pd at_most _mm512_min_pd sqrt _mm512_sqrt_pd
    }

    #[inline(always)]
    fn sum(self) -> f64 {
        unsafe {
            let low = _mm512_castpd512_pd256(self.0);
            let high = _mm512_extractf64x4_pd::<1>(self.0);
            sum_of_four(_mm256_add_pd(low, high))
        }
    }

    #[inline(always)]
    fn if_above(self, other: Self, x: Self, y: Self) -> Self {
        unsafe {
            let above = _mm512_cmp_pd_mask::<_CMP_GT_OQ>(self.0, other.0);
            Self(_mm512_mask_blend_pd(above, y.0, x.0))
        }
    }

    #[inline(always)]
    fn above(self, other: Self) -> u8 {
        unsafe { _mm512_cmp_pd_mask::<_CMP_GT_OQ>(self.0, other.0) }
    }

    #[inline(always)]
    fn and_bits(self, bits: u64) -> Self {
        unsafe { Self::from_int(_mm512_and_si512(self.int(), _mm512_set1_epi64(bits as i64))) }
    }

    #[inline(always)]
    fn or_bits(self, bits: u64) -> Self {
        unsafe { Self::from_int(_mm512_or_si512(self.int(), _mm512_set1_epi64(bits as i64))) }
    }

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        unsafe { Self::from_int(_mm512_and_si512(self.int(), other.int())) }
    }

    #[inline(always)]
    fn xor(self, other: Self) -> Self {
        unsafe { Self::from_int(_mm512_xor_si512(self.int(), other.int())) }
    }

    #[inline(always)]
    fn add_bits(self, bits: u64) -> Self {
        unsafe { Self::from_int(_mm512_add_epi64(self.int(), _mm512_set1_epi64(bits as i64))) }
    }

    #[inline(always)]
    fn minus_bits(self) -> Self {
        unsafe { Self::from_int(_mm512_sub_epi64(_mm512_setzero_si512(), self.int())) }
    }

    #[inline(always)]
    fn shift_up<const N: i32>(self) -> Self {
        unsafe { Self::from_int(_mm512_sll_epi64(self.int(), _mm_cvtsi32_si128(N))) }
    }

    #[inline(always)]
    fn shift_down<const N: i32>(self) -> Self {
        unsafe { Self::from_int(_mm512_srl_epi64(self.int(), _mm_cvtsi32_si128(N))) }
    }
}

/// What lanes of four numbers in one register of AVX2 have in common: all but how a product meets a sum.
macro_rules! four {
    ($type:ident, $pair:ident; times_plus $times_plus:ident minus_times $minus_times:ident) => {
        operators! {
            $type __m256d __m256i,
            Add add |a: Self, b: Self| Self(_mm256_add_pd(a.0, b.0));
            Sub sub |a: Self, b: Self| Self(_mm256_sub_pd(a.0, b.0));
            Mul mul |a: Self, b: Self| Self(_mm256_mul_pd(a.0, b.0));
            Div div |a: Self, b: Self| Self(_mm256_div_pd(a.0, b.0));
        }

        // SAFETY of every block: see the module.
        impl Lanes for $type {
            type Pair = $pair;
            alike! {
                4; splat _mm256_set1_pd new _mm256_loadu_pd array _mm256_storeu_pd times_plus $times_plus minus_times $minus_times
                at_least _mm256_max_pd at_most _mm256_min_pd sqrt _mm256_sqrt_pd
            }

            #[inline(always)]
            fn sum(self) -> f64 {
                unsafe { sum_of_four(self.0) }
            }

            #[inline(always)]
            fn if_above(self, other: Self, x: Self, y: Self) -> Self {
                unsafe {
                    let above = _mm256_cmp_pd::<_CMP_GT_OQ>(self.0, other.0);
                    Self(_mm256_blendv_pd(y.0, x.0, above))
                }
            }

            #[inline(always)]
            fn above(self, other: Self) -> u8 {
                unsafe { _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_GT_OQ>(self.0, other.0)) as u8 }
            }

            #[inline(always)]
            fn and_bits(self, bits: u64) -> Self {
                self.and(Self::splat(f64::from_bits(bits)))
            }

            #[inline(always)]
            fn or_bits(self, bits: u64) -> Self {
                unsafe { Self(_mm256_or_pd(self.0, Self::splat(f64::from_bits(bits)).0)) }
            }

            #[inline(always)]
            fn and(self, other: Self) -> Self {
                unsafe { Self(_mm256_and_pd(self.0, other.0)) }
            }

            #[inline(always)]
            fn xor(self, other: Self) -> Self {
                unsafe { Self(_mm256_xor_pd(self.0, other.0)) }
            }

            #[inline(always)]
            fn add_bits(self, bits: u64) -> Self {
                unsafe { Self::from_int(_mm256_add_epi64(self.int(), _mm256_set1_epi64x(bits as i64))) }
            }

            #[inline(always)]
            fn minus_bits(self) -> Self {
                unsafe { Self::from_int(_mm256_sub_epi64(_mm256_setzero_si256(), self.int())) }
            }

            #[inline(always)]
            fn shift_up<const N: i32>(self) -> Self {
                unsafe { Self::from_int(_mm256_slli_epi64::<N>(self.int())) }
            }

            #[inline(always)]
            fn shift_down<const N: i32>(self) -> Self {
                unsafe { Self::from_int(_mm256_srli_epi64::<N>(self.int())) }
            }
        }
    };
}

/// Four numbers in one register of AVX2.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Avx2(__m256d);

four!(Avx2, Avx2Pair; times_plus _mm256_fmadd_pd minus_times _mm256_fnmadd_pd);

/// Four numbers in one register of AVX2 that computes as [`Portable`](super::Portable) does: every product is rounded,
/// and sums come in the same order. Whoever makes one has asked the processor for AVX2.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rounded(__m256d);

four!(Rounded, Self; times_plus product_plus minus_times minus_product);

/// a b + c, each rounded.
///
/// # Safety
/// As for the module.
#[inline(always)]
unsafe fn product_plus(a: __m256d, b: __m256d, c: __m256d) -> __m256d {
    unsafe { _mm256_add_pd(_mm256_mul_pd(a, b), c) }
}

/// c - a b, each rounded.
///
/// # Safety
/// As for the module.
#[inline(always)]
unsafe fn minus_product(a: __m256d, b: __m256d, c: __m256d) -> __m256d {
    unsafe { _mm256_sub_pd(c, _mm256_mul_pd(a, b)) }
}

/// Eight numbers in two registers of AVX2: the two share constants and do not wait for each other.
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
    elementary!();

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
        sqrt(;);
        if_above(other, x, y;);
        and_bits(; bits);
        or_bits(; bits);
        and(other;);
        xor(other;);
        add_bits(; bits);
        minus_bits(;);
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
