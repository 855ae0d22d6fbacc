//! Numbers such as `-12.3456` that most columns are made of, taken eight digits at a time.
//!
//! A general parser goes digit by digit, and on a column of noise the processor guesses wrong where each number ends:
//! that took half of the time of reading one.

/// As [`decimal`], of the number at a place of a text: up to eight digits, a digit or more on either side of the point.
/// `None` also near the text's ends. The number is the first value over the second, which is left to be done for many
/// at once: what waits for one division after the other falls behind with finding the next number.
///
/// Sixteen bytes are compared at once, which tells where the point is and where the number ends; its digits are then
/// put side by side, as if there were no point.
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
#[inline]
pub(super) fn short(text: &[u8], at: usize) -> Option<([f64; 2], usize)> {
    const ZEROS: u64 = 0x3030_3030_3030_3030;
    // The number begins at the ninth byte.
    let around: &[u8; 32] = text.get(at.checked_sub(8)?..)?.first_chunk()?;
    let word = |from: usize| {
        let bytes = around.get(from..)?.first_chunk()?;
        Some(u64::from_le_bytes(*bytes))
    };
    // SAFETY: every such processor has SSE2, and the build takes it for granted.
    let digits = unsafe { digits_among(word(8)?, word(16)?) };
    let minus = u32::from(around[8] == b'-');
    let others = !digits ^ minus;
    let point = others.trailing_zeros();
    let end = (others & (others - 1)).trailing_zeros();
    let (whole, fraction) = (point.wrapping_sub(minus), end - point - 1);
    let fits = whole.wrapping_sub(1) < 7 && fraction.wrapping_sub(1) < 8 - whole;
    if !fits || around[8 + point as usize] != b'.' || around[8 + end as usize] | 0x20 == b'e' {
        return None;
    }
    // Each with its last digit in the highest byte.
    let (high, low) = (word(point as usize)? ^ ZEROS, word(end as usize)? ^ ZEROS);
    let digits = high >> (8 * fraction) | low & u64::MAX << (64 - 8 * fraction);
    let digits = digits & u64::MAX << (64 - 8 * (whole + fraction));
    // Where it is 0, this makes -0 of -0.0 as it should be.
    let under = SIGNED_TENS[minus as usize][fraction as usize];
    Some(([eight(digits) as f64, under], end as usize))
}

/// Which of sixteen bytes are digits: a bit for each, the first in the lowest.
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
#[inline]
#[target_feature(enable = "sse2")]
fn digits_among(first: u64, second: u64) -> u32 {
    use std::arch::x86_64::{
        _mm_cmpeq_epi8, _mm_min_epu8, _mm_movemask_epi8, _mm_set_epi64x, _mm_set1_epi8, _mm_xor_si128,
    };
    let bytes = _mm_set_epi64x(second.cast_signed(), first.cast_signed());
    let values = _mm_xor_si128(bytes, _mm_set1_epi8(0x30));
    let digits = _mm_cmpeq_epi8(_mm_min_epu8(values, _mm_set1_epi8(9)), values);
    _mm_movemask_epi8(digits).cast_unsigned()
}

/// Without such comparisons there is no short way.
#[cfg(not(all(target_arch = "x86_64", target_feature = "sse2")))]
#[inline]
pub(super) fn short(_: &[u8], _: usize) -> Option<([f64; 2], usize)> {
    None
}

/// Powers of ten by their exponents; all are exact, as are numbers of 15 digits.
const TENS: [f64; 8] = [1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6, 1e7];

/// The same of either sign.
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
const SIGNED_TENS: [[f64; 8]; 2] = [TENS, [-1.0, -10.0, -100.0, -1e3, -1e4, -1e5, -1e6, -1e7]];

/// The number that `text` begins with, and its length: a sign or none, one to eight digits, a point and up to seven
/// more. `None` for all else.
///
/// The value is the nearest `f64`: whole numbers of up to 15 digits and powers of ten up to 22 are exact, and their
/// quotient is rounded once (W. D. Clinger, "How to read floating point numbers accurately", PLDI 1990).
#[inline]
pub(super) fn decimal(text: &[u8]) -> Option<(f64, usize)> {
    let negative = *text.first()? == b'-';
    let whole = usize::from(negative);
    let (digits, high) = digits(text, whole)?;
    let point = whole + digits;
    if digits == 0 || text[point] != b'.' {
        return None;
    }
    let (digits, low) = self::digits(text, point + 1)?;
    let end = point + 1 + digits;
    let ten = *TENS.get(digits)?;
    if matches!(text.get(end), Some(b'e' | b'E')) {
        return None;
    }
    // Whole numbers of up to 15 digits: the sum is exact.
    let size = (high as f64 * ten + low as f64) / ten;
    // Without a branch: signs of noise cannot be foreseen either.
    let sign = u64::from(negative) << 63;
    Some((f64::from_bits(size.to_bits() | sign), end))
}

/// How many of the eight bytes from `at` on are digits before one is not, and the number they make; `None` where there
/// are no eight bytes and one more.
#[inline]
fn digits(text: &[u8], at: usize) -> Option<(usize, u64)> {
    let bytes = text.get(at..)?.first_chunk::<9>()?;
    let word = u64::from_le_bytes(*bytes.first_chunk()?);
    // Digits become 0 to 9; what is none has a high bit, or gets one when 0x76 is added.
    let values = word ^ 0x3030_3030_3030_3030;
    let others = (values | values.wrapping_add(0x7676_7676_7676_7676)) & 0x8080_8080_8080_8080;
    let count = others.trailing_zeros() as usize / 8;
    // Zeros in front, the last digit in the highest byte.
    let values = values.checked_shl(64 - 8 * count as u32).unwrap_or(0);
    Some((count, eight(values)))
}

/// The number that eight digits make, the first in the lowest byte.
#[inline]
fn eight(values: u64) -> u64 {
    let pairs = (10 * (values & 0x00ff_00ff_00ff_00ff)).wrapping_add(values >> 8) & 0x00ff_00ff_00ff_00ff;
    let fours = (100 * (pairs & 0xffff_0000_ffff)).wrapping_add(pairs >> 16) & 0x0000_ffff_0000_ffff;
    10_000 * (fours & 0xffff_ffff) + (fours >> 32)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn regress_what_is_taken_and_what_is_left() {
        for (text, expected) in [
            ("-0.00000,3.1415", Some((-0.0, 8))),
            ("12345678.7654321\n0.0\n", Some((12_345_678.765_432_1, 16))),
            ("5.\n12345678901", Some((5.0, 2))),
            ("1.5.3 and so on", Some((1.5, 3))),
            ("123456789.5 and so on", None),
            ("0.12345678 and so on", None),
            ("1.5e3 and so on", None),
            ("7 and no point", None),
            (".5 and so on..", None),
            ("-.5 and so on..", None),
            ("+1.5 and so on", None),
            ("nan and so on", None),
            ("1.5\n", None),
            ("-", None),
            ("", None),
        ] {
            let found = decimal(text.as_bytes());
            assert_eq!(found.map(|f| f.0.to_bits()), expected.map(|f: (f64, _)| f.0.to_bits()), "{text}");
            assert_eq!(found.map(|f| f.1), expected.map(|f| f.1), "{text}");
        }
    }

    #[test]
    fn regress_what_the_short_way_takes() {
        for (text, expected) in [
            ("-0.00000,3.1415", Some((-0.0, 8))),
            ("1.2345678\n", Some((1.234_567_8, 9))),
            ("1.23456789\n", None),
            ("1.234567\n", Some((1.234_567, 8))),
            ("-1234567.8\n", Some((-1_234_567.8, 10))),
            ("12345678.9\n", None),
            ("5.\n", None),
            (".5\n", None),
            ("-.5\n", None),
            ("+1.5\n", None),
            ("--1.5\n", None),
            ("75\n", None),
            ("1,5\n", None),
            ("nan\n", None),
            ("\n1.5\n", None),
            ("1.5e3\n", None),
            ("1.5E3\n", None),
        ] {
            let padded = format!("1.25\n0.5\n{text}{}", "7".repeat(24));
            let found = short(padded.as_bytes(), 9);
            let expected = expected.filter(|_| cfg!(all(target_arch = "x86_64", target_feature = "sse2")));
            assert_eq!(
                found.map(|([over, under], length)| ((over / under).to_bits(), length)),
                expected.map(|f: (f64, _)| (f.0.to_bits(), f.1)),
                "{text}"
            );
        }
        assert_eq!(short(b"1.5\n", 0), None);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(5000))]
        /// Bit for bit what the general parser makes of the same bytes, wherever it takes them at all.
        #[test]
        fn xval_fast_float(text in "-?[0-9]{0,9}[.e]?[0-9]{0,9}[ ,\n.e+:/;\u{e9}-]?[0-9.]{0,12}") {
            if let Some((value, length)) = decimal(text.as_bytes()) {
                let (expected, taken) = fast_float2::parse_partial::<f64, _>(&text).unwrap();
                prop_assert_eq!(value.to_bits(), expected.to_bits(), "{}", text);
                prop_assert_eq!(length, taken, "{}", text);
            }
            let padded = format!("98765.4\n{text}\n{}", "-1.5\n".repeat(6));
            if let Some(([over, under], length)) = short(padded.as_bytes(), 8) {
                let value = over / under;
                let (expected, taken) = fast_float2::parse_partial::<f64, _>(&padded[8..8 + length]).unwrap();
                prop_assert_eq!(value.to_bits(), expected.to_bits(), "{}", text);
                prop_assert_eq!(length, taken, "{}", text);
            }
        }
    }
}
