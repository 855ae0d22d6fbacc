//! Eight numbers at a time, and the elementary functions that the right-hand side spends its time in.
//!
//! Plain arrays in plain loops: the compiler turns them into whatever registers the enclosing function's target features offer,
//! and into scalar code where there are none. `FUSED` says whether a product and a sum may be rounded once; it is set where
//! the processor fuses in hardware, for in software that costs more than everything else together. Nothing here branches on
//! a lane's value.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// Numbers in a group.
pub const WIDTH: usize = 8;

/// Eight numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub struct F8(pub [f64; WIDTH]);

macro_rules! lanewise {
    ($trait:ident, $method:ident, $op:tt) => {
        impl $trait for F8 {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                let mut out = [0.0; WIDTH];
                for i in 0..WIDTH {
                    out[i] = self.0[i] $op other.0[i];
                }
                Self(out)
            }
        }
    };
}
lanewise!(Add, add, +);
lanewise!(Sub, sub, -);
lanewise!(Mul, mul, *);
lanewise!(Div, div, /);

impl AddAssign for F8 {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for F8 {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl Neg for F8 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|x| -x)
    }
}

impl F8 {
    /// Zeros.
    pub const ZERO: Self = Self([0.0; WIDTH]);

    /// The same number in every lane.
    #[inline(always)]
    pub fn splat(x: f64) -> Self {
        Self([x; WIDTH])
    }

    /// The first eight of a slice.
    #[inline(always)]
    pub fn load(from: &[f64]) -> Self {
        let mut out = [0.0; WIDTH];
        out.copy_from_slice(&from[..WIDTH]);
        Self(out)
    }

    /// Into the first eight of a slice.
    #[inline(always)]
    pub fn store(self, to: &mut [f64]) {
        to[..WIDTH].copy_from_slice(&self.0);
    }

    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut out = [0.0; WIDTH];
        for i in 0..WIDTH {
            out[i] = f(self.0[i]);
        }
        Self(out)
    }

    /// self * b + c, rounded once where `FUSED`.
    #[inline(always)]
    pub fn times_plus<const FUSED: bool>(self, b: Self, c: Self) -> Self {
        let mut out = [0.0; WIDTH];
        for i in 0..WIDTH {
            out[i] =
                if FUSED { self.0[i].mul_add(b.0[i], c.0[i]) } else { self.0[i] * b.0[i] + c.0[i] };
        }
        Self(out)
    }

    /// |self|.
    #[inline(always)]
    pub fn abs(self) -> Self {
        self.map(f64::abs)
    }

    /// max(self, 0), and 0 for what is not a number.
    #[inline(always)]
    pub fn positive_part(self) -> Self {
        self.map(|x| if x > 0.0 { x } else { 0.0 })
    }

    /// `x` where self > other, else `y`.
    #[inline(always)]
    pub fn if_above(self, other: Self, x: Self, y: Self) -> Self {
        let mut out = [0.0; WIDTH];
        for i in 0..WIDTH {
            out[i] = if self.0[i] > other.0[i] { x.0[i] } else { y.0[i] };
        }
        Self(out)
    }

    /// |self| with the sign of `sign`.
    #[inline(always)]
    pub fn with_sign(self, sign: Self) -> Self {
        let mut out = [0.0; WIDTH];
        for i in 0..WIDTH {
            out[i] = self.0[i].copysign(sign.0[i]);
        }
        Self(out)
    }

    /// self with the sign of `other` multiplied in, and 0 where `other` is 0.
    #[inline(always)]
    pub fn with_sign_of(self, other: Self) -> Self {
        let mut out = [0.0; WIDTH];
        for i in 0..WIDTH {
            let signed = if other.0[i] < 0.0 { -self.0[i] } else { self.0[i] };
            out[i] = if other.0[i] == 0.0 { 0.0 } else { signed };
        }
        Self(out)
    }

    /// Whether any lane is above 0.
    #[inline(always)]
    pub fn any_positive(self) -> bool {
        let mut any = false;
        for i in 0..WIDTH {
            any |= self.0[i] > 0.0;
        }
        any
    }

    /// Sum of the lanes, in a fixed order.
    #[inline(always)]
    pub fn sum(self) -> f64 {
        let [a, b, c, d, e, f, g, h] = self.0;
        ((a + e) + (c + g)) + ((b + f) + (d + h))
    }

    #[inline(always)]
    fn bits(self) -> [u64; WIDTH] {
        let mut out = [0; WIDTH];
        for i in 0..WIDTH {
            out[i] = self.0[i].to_bits();
        }
        out
    }

    #[inline(always)]
    fn from_bits(bits: [u64; WIDTH]) -> Self {
        let mut out = [0.0; WIDTH];
        for i in 0..WIDTH {
            out[i] = f64::from_bits(bits[i]);
        }
        Self(out)
    }
}

/// 1.5 * 2^52: added to a number of moderate size, it leaves the nearest integer in the low bits of the sum.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// Horner's rule, highest coefficient first.
#[inline(always)]
fn polynomial<const FUSED: bool, const N: usize>(x: F8, coefficients: [f64; N]) -> F8 {
    let mut sum = F8::splat(coefficients[0]);
    for c in &coefficients[1..] {
        sum = sum.times_plus::<FUSED>(x, F8::splat(*c));
    }
    sum
}

/// (sin x, cos x) for |x| up to 1e5 (about 16 000 turns of a cage), absolute error below 3e-16.
///
/// pi/2 in three parts, short enough that their multiples are exact (Cody and Waite), and the minimax polynomials of
/// the Cephes library on [-pi/4, pi/4].
#[inline(always)]
pub fn sin_cos<const FUSED: bool>(x: F8) -> (F8, F8) {
    const PARTS: [f64; 3] =
        [1.570_796_251_296_997, 7.549_789_415_861_596e-8, 5.390_302_858_158_119e-15];
    let rounded = x.times_plus::<FUSED>(F8::splat(std::f64::consts::FRAC_2_PI), F8::splat(ROUNDER));
    let k = rounded - F8::splat(ROUNDER);
    let mut r = x;
    for part in PARTS {
        r = (-k).times_plus::<FUSED>(F8::splat(part), r);
    }
    let z = r * r;
    let sine = (z * r).times_plus::<FUSED>(
        polynomial::<FUSED, 6>(
            z,
            [
                1.589_623_015_765_465_68e-10,
                -2.505_074_776_285_780_7e-8,
                2.755_731_362_138_572_5e-6,
                -1.984_126_982_958_954e-4,
                8.333_333_333_322_118e-3,
                -1.666_666_666_666_663e-1,
            ],
        ),
        r,
    );
    let cosine = (z * z).times_plus::<FUSED>(
        polynomial::<FUSED, 6>(
            z,
            [
                -1.135_853_652_138_768_2e-11,
                2.087_570_084_197_473e-9,
                -2.755_731_417_929_674e-7,
                2.480_158_728_885_170_5e-5,
                -1.388_888_888_887_305_6e-3,
                4.166_666_666_666_659e-2,
            ],
        ),
        z.times_plus::<FUSED>(F8::splat(-0.5), F8::splat(1.0)),
    );
    // Quadrant k mod 4: odd ones swap the two, the second bit flips the sine, the next one on the cosine.
    let (rounded, sine, cosine) = (rounded.bits(), sine.bits(), cosine.bits());
    let (mut sin, mut cos) = ([0; WIDTH], [0; WIDTH]);
    for i in 0..WIDTH {
        let odd = (rounded[i] & 1).wrapping_neg();
        let swapped = (sine[i] ^ cosine[i]) & odd;
        sin[i] = (sine[i] ^ swapped) ^ ((rounded[i] & 2) << 62);
        cos[i] = (cosine[i] ^ swapped) ^ ((rounded[i].wrapping_add(1) & 2) << 62);
    }
    (F8::from_bits(sin), F8::from_bits(cos))
}

/// (e^x - 1 - (2^k - 1), 2^k) with k the nearest integer to x / ln 2: e^x - 1 is the first plus 2^k - 1. |x| <= 700.
#[inline(always)]
fn exp_parts<const FUSED: bool>(x: F8) -> (F8, F8) {
    const LN2_HIGH: f64 = 6.931_457_519_531_25e-1;
    const LN2_LOW: f64 = 1.428_606_820_309_417_3e-6;
    let rounded = x.times_plus::<FUSED>(F8::splat(std::f64::consts::LOG2_E), F8::splat(ROUNDER));
    let k = rounded - F8::splat(ROUNDER);
    let r = (-k).times_plus::<FUSED>(F8::splat(LN2_HIGH), x);
    let r = (-k).times_plus::<FUSED>(F8::splat(LN2_LOW), r);
    // Taylor's series of (e^r - 1 - r) / r^2 on |r| <= ln 2 / 2, to 2e-17 of e^r.
    let tail = polynomial::<FUSED, 12>(
        r,
        [
            1.0 / 6_227_020_800.0,
            1.0 / 479_001_600.0,
            1.0 / 39_916_800.0,
            1.0 / 3_628_800.0,
            1.0 / 362_880.0,
            1.0 / 40_320.0,
            1.0 / 5_040.0,
            1.0 / 720.0,
            1.0 / 120.0,
            1.0 / 24.0,
            1.0 / 6.0,
            0.5,
        ],
    );
    let p = (r * r).times_plus::<FUSED>(tail, r);
    let mut scale = rounded.bits();
    for bits in &mut scale {
        *bits = bits.wrapping_add(1023) << 52;
    }
    let scale = F8::from_bits(scale);
    (scale * p, scale)
}

/// e^x for |x| <= 700, relative error below 4e-16.
#[inline(always)]
pub fn exp<const FUSED: bool>(x: F8) -> F8 {
    let (rest, scale) = exp_parts::<FUSED>(x);
    rest + scale
}

/// tanh x, error below 4e-16 relative.
#[inline(always)]
pub fn tanh<const FUSED: bool>(x: F8) -> F8 {
    // Beyond 20 the result is 1 to the last bit.
    let limit = F8::splat(20.0);
    let size = x.abs();
    let size = size.if_above(limit, limit, size);
    let (rest, scale) = exp_parts::<FUSED>(size + size);
    let less_one = rest + (scale - F8::splat(1.0));
    (less_one / (less_one + F8::splat(2.0))).with_sign(x)
}

/// `[x]_+^(10/9)`, relative error below 5e-15 for normal x.
///
/// z = x^(-1/9) from the exponent bits to 3 %, then two steps z (1 - e)^(-1/9) with e = 1 - x z^9 and the binomial series to the
/// fourth power: no division. The result is x^2 z^8.
#[inline(always)]
pub fn ten_ninths<const FUSED: bool>(x: F8) -> F8 {
    /// -1/9 of the upper half's distance from 1.0, plus what balances the error of the straight line at both ends.
    const ORIGIN: f64 = 1_191_820_186.0;
    /// 2^52: integers below it stand in the low bits of the sum.
    const INTEGER: f64 = 4_503_599_627_370_496.0;
    /// Coefficients of (1 - e)^(-1/9), highest first.
    const SERIES: [f64; 5] = [665.0 / 19_683.0, 95.0 / 2_187.0, 5.0 / 81.0, 1.0 / 9.0, 1.0];
    let size = x.if_above(F8::splat(f64::MIN_POSITIVE), x, F8::splat(1.0));
    let bits = size.bits();
    let mut guess = [0; WIDTH];
    for i in 0..WIDTH {
        let upper = f64::from_bits((bits[i] >> 32) | INTEGER.to_bits()) - INTEGER;
        guess[i] = (ORIGIN - upper * (1.0 / 9.0) + INTEGER).to_bits() << 32;
    }
    let mut z = F8::from_bits(guess);
    for _ in 0..2 {
        let z3 = z * z * z;
        let z9 = z3 * z3 * z3;
        let e = (-size).times_plus::<FUSED>(z9, F8::splat(1.0));
        z = z * polynomial::<FUSED, 5>(e, SERIES);
    }
    let z2 = z * z;
    let z4 = z2 * z2;
    let xz4 = size * z4;
    x.if_above(F8::splat(f64::MIN_POSITIVE), xz4 * xz4, F8::ZERO)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest error of a function over a range, by `error(x, value)`.
    fn worst(range: (f64, f64), f: impl Fn(F8) -> F8, error: impl Fn(f64, f64) -> f64) -> f64 {
        let n = 400_000;
        let mut worst: f64 = 0.0;
        for k in (0..n).step_by(WIDTH) {
            let mut x = [0.0; WIDTH];
            for (i, x) in x.iter_mut().enumerate() {
                *x = range.0 + (range.1 - range.0) * f64::from(k + i as i32) / f64::from(n);
            }
            for (x, value) in x.iter().zip(f(F8(x)).0) {
                worst = worst.max(error(*x, value));
            }
        }
        worst
    }

    fn both(range: (f64, f64), plain: impl Fn(F8) -> F8, fused: impl Fn(F8) -> F8, error: impl Fn(f64, f64) -> f64, limit: f64) {
        for (name, f) in [("plain", &plain as &dyn Fn(F8) -> F8), ("fused", &fused)] {
            let found = worst(range, f, &error);
            assert!(found < limit, "{name} on {range:?}: {found:e}");
        }
    }

    #[test]
    fn xval_sine_and_cosine_against_libm() {
        for range in [(-4.0, 4.0), (0.0, 1e3), (9e4, 1e5)] {
            both(range, |x| sin_cos::<false>(x).0, |x| sin_cos::<true>(x).0, |x, v| (v - x.sin()).abs(), 3e-16);
            both(range, |x| sin_cos::<false>(x).1, |x| sin_cos::<true>(x).1, |x, v| (v - x.cos()).abs(), 3e-16);
        }
    }

    #[test]
    fn xval_exponential_and_hyperbolic_tangent_against_libm() {
        both((-700.0, 700.0), exp::<false>, exp::<true>, |x, v| (v / x.exp() - 1.0).abs(), 1e-15);
        let relative = |x: f64, v: f64| if x == 0.0 { v.abs() } else { (v / x.tanh() - 1.0).abs() };
        for range in [(-30.0, 30.0), (-1.0, 1.0), (-1e-6, 1e-6)] {
            both(range, tanh::<false>, tanh::<true>, relative, 6e-16);
        }
    }

    #[test]
    fn xval_ten_ninths_against_powf() {
        let relative = |log: f64, v: f64| {
            let x = 10f64.powf(log);
            (v / x.powf(10.0 / 9.0) - 1.0).abs()
        };
        let of = |f: fn(F8) -> F8| move |log: F8| f(log.map(|l| 10f64.powf(l)));
        both((-20.0, 6.0), of(ten_ninths::<false>), of(ten_ninths::<true>), relative, 6e-15);
        let nothing = ten_ninths::<false>(F8([0.0, -1.0, -1e-300, f64::NEG_INFINITY, -0.0, 0.0, -5.0, 0.0]));
        assert_eq!(nothing, F8::ZERO);
    }
}
