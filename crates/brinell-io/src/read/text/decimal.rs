//! Numbers such as `-12.3456` that most columns are made of, taken eight digits at a time.
//!
//! A general parser goes digit by digit, and on a column of noise the processor guesses wrong where each number ends: that took
//! half of the time of reading one.

/// Powers of ten by their exponents; all are exact, as are numbers of 15 digits.
const TENS: [u32; 8] = [1, 10, 100, 1000, 10_000, 100_000, 1_000_000, 10_000_000];

/// The number that `text` begins with, and its length: a sign or none, one to eight digits, a point and up to seven more. `None` for all else.
///
/// The value is the nearest `f64`: whole numbers of up to 15 digits and powers of ten up to 22 are exact, and their quotient is rounded once
/// (W. D. Clinger, "How to read floating point numbers accurately", PLDI 1990).
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
    let ten = u64::from(*TENS.get(digits)?);
    if matches!(text.get(end), Some(b'e' | b'E')) {
        return None;
    }
    let size = (high * ten + low) as f64 / ten as f64;
    // Without a branch: signs of noise cannot be foreseen either.
    let sign = u64::from(negative) << 63;
    Some((f64::from_bits(size.to_bits() | sign), end))
}

/// How many of the eight bytes from `at` on are digits before one is not, and the number they make; `None` where there are no
/// eight bytes and one more.
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
    let pairs =
        (10 * (values & 0x00ff_00ff_00ff_00ff)).wrapping_add(values >> 8) & 0x00ff_00ff_00ff_00ff;
    let fours =
        (100 * (pairs & 0xffff_0000_ffff)).wrapping_add(pairs >> 16) & 0x0000_ffff_0000_ffff;
    let eight = 10_000 * (fours & 0xffff_ffff) + (fours >> 32);
    Some((count, eight))
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
            assert_eq!(
                found.map(|f| f.0.to_bits()),
                expected.map(|f: (f64, _)| f.0.to_bits()),
                "{text}"
            );
            assert_eq!(found.map(|f| f.1), expected.map(|f| f.1), "{text}");
        }
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
        }
    }
}
