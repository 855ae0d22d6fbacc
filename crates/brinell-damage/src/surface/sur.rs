//! MountainsMap's surface: a header of 512 bytes, a comment, then whole numbers line by line, plain or in zlib streams.

use super::{broken, map, points, spacing, unsupported};
use crate::bytes::{f32, i16, i32, u16, u32};
use crate::error::{DamageError, excerpt};
use crate::kind::FileKind;
use crate::scan::Raw;
use brinell_io::Number;
use std::borrow::Cow;

const KIND: FileKind = FileKind::Sur;
const HEADER: usize = 512;
/// Kinds of study that hold one surface.
const SURFACE: i16 = 2;
const SERIES: i16 = 5;

pub(crate) fn read(bytes: &[u8]) -> Result<Raw, DamageError> {
    let short = || broken(KIND, "its header", "it ends here");
    if bytes.len() < HEADER {
        return Err(short());
    }
    let number = number(bytes)?;
    let side = |place| i32(bytes, place).and_then(|n| usize::try_from(n).ok()).unwrap_or(0);
    let (columns, rows) = (side(108), side(112));
    let count = points(columns, rows)?;
    let skipped = [334, 336].map(|place| usize::from(u16(bytes, place).unwrap_or(0)));
    let data = bytes.get(HEADER + skipped[0] + skipped[1]..).ok_or_else(short)?;
    let wanted = count * number.bytes();
    let data = match bytes.starts_with(b"DSCOMPRESSED") {
        true => unpacked(data, wanted)?,
        false => Cow::Borrowed(data),
    };
    let data = data
        .get(..wanted)
        .ok_or_else(|| broken(KIND, "its data", format!("{} bytes where {count} points need {wanted}", data.len())))?;
    let scale = |place: usize, unit: usize| -> Result<f64, DamageError> {
        let value = f64::from(f32(bytes, place).ok_or_else(short)?);
        Ok(value * metres(&bytes[unit..unit + 16])?)
    };
    let z = scale(128, 212)?;
    if !(z.is_finite() && z != 0.0) {
        return Err(broken(KIND, "its scale of heights", format!("{z}")));
    }
    // Beside the measured ones.
    let missing = (i16(bytes, 86) == Some(1)).then(|| f64::from(i32(bytes, 100).unwrap_or(0)) - 2.0);
    let mut values = Vec::with_capacity(count);
    number.decode(false, data, &mut values);
    values.iter_mut().for_each(|v| *v = if missing == Some(*v) { f64::NAN } else { z * *v });
    let between = [
        spacing(KIND, "its spacing along x", scale(120, 180)?)?,
        spacing(KIND, "its spacing along y", scale(124, 196)?)?,
    ];
    Ok(map(columns, between, values))
}

/// What its points are written as, where it is a surface that can be read.
fn number(bytes: &[u8]) -> Result<Number, DamageError> {
    if i16(bytes, 12) != Some(0) {
        return Err(unsupported(KIND, "the byte order of a Macintosh", "save it as SDF or X3P"));
    }
    if !matches!(i16(bytes, 18), Some(SURFACE | SERIES)) {
        return Err(unsupported(KIND, "a study that is no surface", "save the surface alone"));
    }
    match i16(bytes, 98) {
        Some(16) => Ok(Number::I16),
        Some(32) => Ok(Number::I32),
        other => Err(broken(KIND, "the bits of a point", format!("{}", other.unwrap_or(0)))),
    }
}

/// Metres of a unit, as written in 16 bytes of Latin-1.
fn metres(unit: &[u8]) -> Result<f64, DamageError> {
    let text: String = unit.iter().take_while(|b| **b != 0).map(|b| char::from(*b)).collect();
    Ok(match text.trim() {
        "m" => 1.0,
        "cm" => 1e-2,
        "mm" => 1e-3,
        "\u{b5}m" | "um" => 1e-6,
        "nm" => 1e-9,
        other => {
            return Err(unsupported(KIND, format!("the unit `{}`", excerpt(other)), "save it in mm or um"));
        }
    })
}

/// The streams one after the other; never more than is wanted.
fn unpacked(data: &[u8], wanted: usize) -> Result<Cow<'_, [u8]>, DamageError> {
    let short = || broken(KIND, "its streams", "they end here");
    let streams = u32(data, 0).ok_or_else(short)? as usize;
    let mut at = streams.checked_mul(8).and_then(|n| n.checked_add(4)).ok_or_else(short)?;
    let mut all = Vec::new();
    for k in 0..streams {
        let packed = u32(data, 8 + 8 * k).ok_or_else(short)? as usize;
        let end = at.checked_add(packed).ok_or_else(short)?;
        let stream = data.get(at..end).ok_or_else(short)?;
        let room = wanted.saturating_sub(all.len());
        let part = miniz_oxide::inflate::decompress_to_vec_zlib_with_limit(stream, room);
        all.extend(part.map_err(|e| broken(KIND, "its streams", format!("{:?}", e.status)))?);
        at = end;
    }
    Ok(Cow::Owned(all))
}
