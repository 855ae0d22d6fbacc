//! Elementary functions over lanes.

use super::Lanes;
use super::ninth::{EIGHT, FIT, ORIGIN};

/// 1.5 * 2^52: added to a number of moderate size, it leaves the nearest integer in the low bits of the sum.
pub const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// A polynomial, highest coefficient first: odd and even powers apart, each by Horner's rule in x^2, so that the two do
/// not wait for each other.
#[inline(always)]
fn polynomial<L: Lanes, const N: usize>(x: L, coefficients: [f64; N]) -> L {
    let square = x * x;
    let sum = |first: usize| {
        let mut sum = L::splat(coefficients[first]);
        // A plain loop over a constant range, which compilers unroll; an iterator's steps were left a loop in long
        // series.
        let mut k = first + 2;
        while k < N {
            sum = sum.times_plus(square, L::splat(coefficients[k]));
            k += 2;
        }
        sum
    };
    let (odd, even) = if N.is_multiple_of(2) { (0, 1) } else { (1, 0) };
    sum(odd).times_plus(x, sum(even))
}

/// (sin x, cos x) for |x| up to 1e5 (about 16 000 turns of a cage), absolute error below 3e-16.
///
/// pi/2 in three parts, short enough that their multiples are exact (Cody and Waite), and the minimax polynomials of
/// the Cephes library on [-pi/4, pi/4].
#[inline(always)]
pub fn sin_cos<L: Lanes>(x: L) -> (L, L) {
    const PARTS: [f64; 3] = [1.570_796_251_296_997, 7.549_789_415_861_596e-8, 5.390_302_858_158_119e-15];
    let rounded = x.times_plus(L::splat(std::f64::consts::FRAC_2_PI), L::splat(ROUNDER));
    let k = rounded - L::splat(ROUNDER);
    let mut r = x;
    for part in PARTS {
        r = k.minus_times(L::splat(part), r);
    }
    let z = r * r;
    let sine = (z * r).times_plus(
        polynomial(
            z,
            [
                1.589_623_015_765_465_7e-10,
                -2.505_074_776_285_780_7e-8,
                2.755_731_362_138_572_5e-6,
                -1.984_126_982_958_954e-4,
                8.333_333_333_322_118e-3,
                -1.666_666_666_666_663e-1,
            ],
        ),
        r,
    );
    let cosine = (z * z).times_plus(
        polynomial(
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
        z.times_plus(L::splat(-0.5), L::splat(1.0)),
    );
    // Quadrant k mod 4: odd ones swap the two; the second bit flips the sine, that of k + 1 the cosine.
    let odd = rounded.and_bits(1).minus_bits();
    let swapped = sine.xor(cosine).and(odd);
    let sin = sine.xor(swapped).xor(rounded.and_bits(2).shift_up::<62>());
    let cos = cosine.xor(swapped).xor(rounded.add_bits(1).and_bits(2).shift_up::<62>());
    (sin, cos)
}

/// (e^x - 1 - (2^k - 1), 2^k) with k the nearest integer to x / ln 2: e^x - 1 is the first plus 2^k - 1. |x| <= 700.
#[inline(always)]
fn exp_parts<L: Lanes>(x: L) -> (L, L) {
    const LN2_HIGH: f64 = 6.931_457_519_531_25e-1;
    const LN2_LOW: f64 = 1.428_606_820_309_417_3e-6;
    let rounded = x.times_plus(L::splat(std::f64::consts::LOG2_E), L::splat(ROUNDER));
    let k = rounded - L::splat(ROUNDER);
    let r = k.minus_times(L::splat(LN2_HIGH), x);
    let r = k.minus_times(L::splat(LN2_LOW), r);
    // Chebyshev's fit of (e^r - 1 - r) / r^2 on |r| <= 1.0001 ln 2 / 2, to 2e-17 of e^r:
    // `validation/coefficients/fits.py`.
    let tail = polynomial(
        r,
        [
            2.510_038_549_551_032e-8,
            2.762_008_844_540_974_8e-7,
            2.755_726_845_999_706_5e-6,
            2.480_152_129_595_437_5e-5,
            1.984_126_986_305_361_7e-4,
            1.388_888_891_721_371_7e-3,
            8.333_333_333_330_062e-3,
            4.166_666_666_662_413e-2,
            1.666_666_666_666_666_7e-1,
            0.500_000_000_000_000_1,
        ],
    );
    let p = (r * r).times_plus(tail, r);
    let scale = rounded.add_bits(1023).shift_up::<52>();
    (scale * p, scale)
}

/// e^x for |x| <= 700, relative error below 4e-16.
#[inline(always)]
pub fn exp<L: Lanes>(x: L) -> L {
    let (rest, scale) = exp_parts(x);
    rest + scale
}

/// tanh x, error below 4e-16 relative.
#[inline(always)]
pub fn tanh<L: Lanes>(x: L) -> L {
    // Beyond 20 the result is 1 to the last bit; where it is in every lane, as of slips of spinning rollers, that is all.
    let limit = L::splat(20.0);
    let size = x.abs().at_most(limit);
    if limit.above(size) == 0 {
        return L::splat(1.0).with_sign(x);
    }
    let (rest, scale) = exp_parts(size + size);
    let less_one = rest + (scale - L::splat(1.0));
    (less_one / (less_one + L::splat(2.0))).with_sign(x)
}

/// 1 - x z^9.
#[inline(always)]
fn one_minus_ninth<L: Lanes>(x: L, z: L) -> L {
    let cube = z * z * z;
    (cube * cube).minus_times(cube * x, L::splat(1.0))
}

/// `[x]_+^(10/9)`, relative error below 5e-15 for normal x.
///
/// z = x^(-1/9) from the exponent bits to 3 %, then a step z (1 - e)^(-1/9) with e = 1 - x z^9 and a cubic. The result
/// is x^2 z^8 (1 - e)^(-8/9) with the e that is left: no division.
#[inline(always)]
pub fn ten_ninths<L: Lanes>(x: L) -> L {
    /// 2^52: integers below it are in the low bits of the sum.
    const INTEGER: f64 = 4_503_599_627_370_496.0;
    /// INTEGER - (INTEGER + upper) / 9 + SHIFTED has ORIGIN - upper / 9 in its low bits.
    const SHIFTED: f64 = ORIGIN + INTEGER + INTEGER / 9.0;
    let size = x.if_above(L::splat(f64::MIN_POSITIVE), x, L::splat(1.0));
    let upper = size.shift_down::<32>().or_bits(INTEGER.to_bits());
    let guess = upper.times_plus(L::splat(-1.0 / 9.0), L::splat(SHIFTED)).shift_up::<32>();
    let z = guess * polynomial(one_minus_ninth(size, guess), FIT);
    let square = z * z;
    let root = square * square * size;
    let rest = one_minus_ninth(size, z);
    let series = polynomial(rest, EIGHT);
    let result = root * root * series;
    x.if_above(L::splat(f64::MIN_POSITIVE), result, L::zero())
}

/// The elementary functions of [`Lanes`], for groups.
macro_rules! elementary {
    () => {
        #[inline(always)]
        fn sin_cos(self) -> (Self, Self) {
            super::functions::sin_cos(self)
        }

        #[inline(always)]
        fn exp(self) -> Self {
            super::functions::exp(self)
        }

        #[inline(always)]
        fn tanh(self) -> Self {
            super::functions::tanh(self)
        }

        #[inline(always)]
        fn ten_ninths(self) -> Self {
            super::functions::ten_ninths(self)
        }
    };
}
pub(super) use elementary;

#[cfg(test)]
mod tests {
    use super::super::{Portable, WIDTH};
    use super::*;

    type Group = [f64; WIDTH];
    type Function = fn(Group) -> Group;

    #[inline(always)]
    fn in_groups<L: Lanes>(mut x: Group, f: impl Fn(L) -> L) -> Group {
        for group in L::groups_mut(&mut x) {
            *group = f(L::new(*group)).array();
        }
        x
    }

    /// A function on arrays for each implementation that this processor has.
    macro_rules! each {
        ($function:expr) => {{
            let portable: Function = |x| in_groups(x, |x: Portable| $function(x));
            #[allow(unused_mut, reason = "other processors have one only")]
            let mut all = vec![("portable", portable)];
            #[cfg(target_arch = "x86_64")]
            {
                use super::super::{Avx2, Avx512, Rounded};
                #[target_feature(enable = "avx2,fma")]
                fn avx2(x: Group) -> Group {
                    in_groups(x, |x: Avx2| $function(x))
                }
                #[target_feature(enable = "avx2")]
                fn rounded(x: Group) -> Group {
                    in_groups(x, |x: Rounded| $function(x))
                }
                #[target_feature(enable = "avx2,fma")]
                fn avx2_pair(x: Group) -> Group {
                    in_groups(x, |x: <Avx2 as Lanes>::Pair| $function(x))
                }
                #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
                fn avx512(x: Group) -> Group {
                    in_groups(x, |x: Avx512| $function(x))
                }
                // SAFETY: asked for at once.
                if is_x86_feature_detected!("avx2") {
                    all.push(("rounded by avx2", |x| unsafe { rounded(x) }));
                }
                if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
                    all.push(("avx2", |x| unsafe { avx2(x) }));
                    all.push(("a pair of avx2", |x| unsafe { avx2_pair(x) }));
                }
                if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
                    all.push(("avx512", |x| unsafe { avx512(x) }));
                }
            }
            all
        }};
    }

    fn check(range: (f64, f64), all: Vec<(&'static str, Function)>, error: impl Fn(f64, f64) -> f64, limit: f64) {
        let n = 400_000;
        for (name, f) in all {
            let mut worst: f64 = 0.0;
            for k in (0..n).step_by(WIDTH) {
                let mut x = [0.0; WIDTH];
                for (i, x) in x.iter_mut().enumerate() {
                    *x = range.0 + (range.1 - range.0) * f64::from(k + i as i32) / f64::from(n);
                }
                for (x, value) in x.iter().zip(f(x)) {
                    worst = worst.max(error(*x, value));
                }
            }
            assert!(worst < limit, "{name} on {range:?}: {worst:e}");
        }
    }

    #[test]
    fn xval_sine_and_cosine_against_libm() {
        for range in [(-4.0, 4.0), (0.0, 1e3), (9e4, 1e5)] {
            check(range, each!((|x| sin_cos(x).0)), |x, v| (v - x.sin()).abs(), 3e-16);
            check(range, each!((|x| sin_cos(x).1)), |x, v| (v - x.cos()).abs(), 3e-16);
        }
    }

    #[test]
    fn xval_exponential_and_hyperbolic_tangent_against_libm() {
        check((-700.0, 700.0), each!(exp), |x, v| (v / x.exp() - 1.0).abs(), 1e-15);
        for range in [(-30.0, 30.0), (-1.0, 1.0), (-1e-6, 1e-6)] {
            let relative = |x: f64, v: f64| {
                if x == 0.0 { v.abs() } else { (v / x.tanh() - 1.0).abs() }
            };
            check(range, each!(tanh), relative, 6e-16);
        }
    }

    #[test]
    fn xval_ten_ninths_against_powf() {
        // Deflections over five decades, evenly spaced in each.
        for top in [1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1.0, 1e6] {
            let relative = |x: f64, v: f64| (v / x.powf(10.0 / 9.0) - 1.0).abs();
            check((0.1 * top, top), each!(ten_ninths), relative, 6e-15);
        }
        for (name, f) in each!(ten_ninths) {
            let nothing = f([0.0, -1.0, -1e-300, f64::NEG_INFINITY, -0.0, 0.0, -5.0, 0.0]);
            assert_eq!(nothing, [0.0; WIDTH], "{name}");
        }
    }
}
