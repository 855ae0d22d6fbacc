//! A number as a field of a text file holds it.

use memchr::memchr;

use super::format::Decimal;

/// A number, or NaN for an empty field; `None` for anything else.
#[inline]
pub(super) fn number(text: &[u8], decimal: Option<Decimal>) -> Option<f64> {
    if decimal != Some(Decimal::Comma)
        && let Ok(value) = fast_float2::parse::<f64, _>(text)
    {
        return Some(value);
    }
    let text = bare(text);
    if text.is_empty() {
        return Some(f64::NAN);
    }
    let comma = memchr(b',', text).filter(|_| decimal != Some(Decimal::Point));
    let point = memchr(b'.', text);
    match comma {
        Some(_) if decimal == Some(Decimal::Comma) && point.is_some() => grouped(text, b'.', b','),
        Some(at) if text.len() <= LONGEST && point.is_none() => {
            let mut pointed = [0; LONGEST];
            pointed[..text.len()].copy_from_slice(text);
            pointed[at] = b'.';
            fast_float2::parse(&pointed[..text.len()]).ok()
        }
        Some(_) => None,
        // Where commas are decimal a point is not.
        None if decimal == Some(Decimal::Comma) && point.is_some() => grouped(text, b'.', b','),
        None => fast_float2::parse(text).ok(),
    }
}

/// Bytes of the longest number with a decimal comma.
const LONGEST: usize = 64;

/// A number whose whole part is in groups of three digits, `-1.234.567,8` with `.` between them and `,` before the
/// fraction; `None` for anything else. A first group of zero is none: nobody writes 853 as `0.853`.
fn grouped(text: &[u8], between: u8, before_fraction: u8) -> Option<f64> {
    let unsigned = text.strip_prefix(b"-").or_else(|| text.strip_prefix(b"+")).unwrap_or(text);
    let end = memchr(before_fraction, unsigned).unwrap_or(unsigned.len());
    let (whole, fraction) = unsigned.split_at(end);
    let is_digits = |part: &[u8]| part.iter().all(u8::is_ascii_digit);
    let mut groups = whole.split(|b| *b == between);
    let first = groups.next().filter(|g| matches!(g.len(), 1..=3) && is_digits(g) && g[0] != b'0')?;
    let are_groups = groups.clone().next().is_some() && groups.all(|g| g.len() == 3 && is_digits(g));
    if first.is_empty() || !are_groups || !is_digits(fraction.get(1..).unwrap_or_default()) || text.len() > LONGEST {
        return None;
    }
    let mut plain = [0; LONGEST];
    let mut length = 0;
    for byte in text.iter().filter(|b| **b != between) {
        plain[length] = if *byte == before_fraction { b'.' } else { *byte };
        length += 1;
    }
    fast_float2::parse(&plain[..length]).ok()
}

/// Whether a number's only sign `between` may be one between groups of three digits: `1.332`, and not `0.5` or `12.25`.
pub(super) fn may_be_grouped(text: &[u8], between: u8) -> bool {
    grouped(bare(text), between, b' ').is_some()
}

/// Without blanks and quotes about it.
fn bare(text: &[u8]) -> &[u8] {
    let text = text.trim_ascii();
    text.strip_prefix(b"\"").and_then(|t| t.strip_suffix(b"\"")).map_or(text, <[u8]>::trim_ascii)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// DIN 1333 and the Duden: a point or a space between groups of three digits from the comma on.
    #[test]
    fn lit_points_beside_decimal_commas_are_between_groups_of_three_digits() {
        let comma = Some(Decimal::Comma);
        for (text, value) in [
            ("-1.332", -1332.0),
            ("1.332,25", 1332.25),
            ("12.345.678", 12_345_678.0),
            ("+999.001,5", 999_001.5),
            ("\"1.332\"", 1332.0),
            ("0,5", 0.5),
            ("-7", -7.0),
        ] {
            assert_eq!(number(text.as_bytes(), comma), Some(value), "{text}");
        }
        for text in ["0.853", "12.5", "1.33", "1234.567", "1.332e2", "1,332.5", ".332", "1.332.5", "-.332", "1.332,2,5"]
        {
            assert_eq!(number(text.as_bytes(), comma), None, "{text}");
        }
        // Where points are decimal, or nothing says, they are.
        assert_eq!(number(b"1.332", Some(Decimal::Point)), Some(1.332));
        assert_eq!(number(b"1.332", None), Some(1.332));
    }
}
