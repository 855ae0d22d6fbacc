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
    let mut text = text.trim_ascii();
    if let Some(inner) = text.strip_prefix(b"\"").and_then(|t| t.strip_suffix(b"\"")) {
        text = inner.trim_ascii();
    }
    if text.is_empty() {
        return Some(f64::NAN);
    }
    let comma = memchr(b',', text).filter(|_| decimal != Some(Decimal::Point));
    match comma {
        Some(at) if text.len() <= 64 && memchr(b'.', text).is_none() => {
            let mut pointed = [0; 64];
            pointed[..text.len()].copy_from_slice(text);
            pointed[at] = b'.';
            fast_float2::parse(&pointed[..text.len()]).ok()
        }
        Some(_) => None,
        None if decimal == Some(Decimal::Comma) && memchr(b'.', text).is_some() => None,
        None => fast_float2::parse(text).ok(),
    }
}
