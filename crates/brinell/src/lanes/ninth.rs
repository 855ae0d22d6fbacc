//! x^(8/9) and x^(10/9) of one number, and the constants that groups share with it.

/// -1/9 of the upper half's distance from 1.0, plus what balances the error of the straight line at both ends.
pub(super) const ORIGIN: f64 = 1_191_820_186.0;
/// (1 - e)^(-1/9) for |e| <= 0.263, which is as far as the guess is off: Chebyshev's fit, to 3e-5; highest first
/// (`validation/coefficients/fits.py`).
pub(super) const FIT: [f64; 4] =
    [4.550_793_648_527_396_7e-2, 6.415_495_782_232_466e-2, 1.110_914_322_528_898_1e-1, 9.999_790_091_846_329e-1];
/// The series of (1 - e)^(-1/9), for the e below 3e-4 that is left.
pub(super) const ONE: [f64; 4] = [95.0 / 2_187.0, 5.0 / 81.0, 1.0 / 9.0, 1.0];
/// The same of (1 - e)^(-8/9).
pub(super) const EIGHT: [f64; 5] = [15_470.0 / 19_683.0, 1_768.0 / 2_187.0, 68.0 / 81.0, 8.0 / 9.0, 1.0];

/// x^(8/9) for x >= 0, relative error below 3e-15.
#[inline]
pub(crate) fn eight_ninths(x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    let (z, rest) = inverse_ninth_root(x);
    x * z * series(rest, ONE)
}

/// `[x]_+^(10/9)`, relative error below 5e-15 for normal x: one number's share of [`Lanes::ten_ninths`], whose code
/// says how.
#[inline]
pub(super) fn ten_ninths(x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    let (z, rest) = inverse_ninth_root(x);
    let square = z * z;
    let root = square * square * x;
    root * root * series(rest, EIGHT)
}

/// z = x^(-1/9) to 3e-5, and 1 - x z^9.
#[inline]
fn inverse_ninth_root(x: f64) -> (f64, f64) {
    let upper = (x.to_bits() >> 32) as f64;
    let guess = f64::from_bits(((ORIGIN - upper * (1.0 / 9.0)) as u64) << 32);
    let rest = |z: f64| {
        let cube = z * z * z;
        1.0 - cube * cube * (cube * x)
    };
    let z = guess * series(rest(guess), FIT);
    (z, rest(z))
}

/// A polynomial, highest coefficient first.
#[inline]
fn series<const N: usize>(x: f64, coefficients: [f64; N]) -> f64 {
    coefficients.into_iter().fold(0.0, |sum, c| sum * x + c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_eight_ninths_agrees_with_powf() {
        for i in 0..100_000 {
            let x = f64::from(i) / 1e5;
            assert!((eight_ninths(x) - x.powf(8.0 / 9.0)).abs() <= 3e-15 * x.powf(8.0 / 9.0));
        }
    }
}
