//! ISO 25178-71: a header of 13 entries, in text or in 81 bytes, then the heights profile by profile. The same layout
//! as BCR-STM, from which the standard took it: versions `aISO-1.0`, `bISO-1.0`, `aBCR-1.0`, `bBCR-1.0`.

use super::{broken, map, points, spacing, unsupported};
use crate::bytes::{f64, u16};
use crate::error::{DamageError, excerpt};
use crate::kind::FileKind;
use crate::scan::Raw;
use brinell_io::Number;

const KIND: FileKind = FileKind::Sdf;
const BINARY_HEADER: usize = 81;

struct Header {
    columns: usize,
    rows: usize,
    /// m.
    x: f64,
    y: f64,
    z: f64,
    compression: f64,
    number: u8,
}

pub(crate) fn read(bytes: &[u8]) -> Result<Raw, DamageError> {
    if bytes.first() == Some(&b'b') { binary(bytes) } else { text(bytes) }
}

fn number(code: u8) -> Result<Number, DamageError> {
    Ok(match code {
        0 => Number::U8,
        1 => Number::U16,
        2 => Number::U32,
        3 => Number::F32,
        4 => Number::I8,
        5 => Number::I16,
        6 => Number::I32,
        7 => Number::F64,
        other => return Err(broken(KIND, "DataType", format!("{other} is unknown"))),
    })
}

/// Of whole numbers the smallest means a missing point.
fn is_missing(number: Number, value: f64) -> bool {
    match number {
        Number::I16 => value == f64::from(i16::MIN),
        Number::I32 => value == f64::from(i32::MIN),
        _ => !value.is_finite(),
    }
}

fn finished(header: &Header, mut values: Vec<f64>) -> Result<Raw, DamageError> {
    if header.compression != 0.0 {
        return Err(unsupported(KIND, "compression", "save it without compression"));
    }
    if !(header.z.is_finite() && header.z != 0.0) {
        return Err(broken(KIND, "Zscale", format!("{} is no scale", header.z)));
    }
    values.iter_mut().for_each(|v| *v *= header.z);
    let between = [spacing(KIND, "Xscale", header.x)?, spacing(KIND, "Yscale", header.y)?];
    Ok(map(header.columns, between, values))
}

fn binary(bytes: &[u8]) -> Result<Raw, DamageError> {
    let short = || broken(KIND, "its header", "it ends here");
    let code = *bytes.get(79).ok_or_else(short)?;
    let scale = |place: usize| f64(bytes, place).ok_or_else(short);
    let header = Header {
        columns: usize::from(u16(bytes, 42).ok_or_else(short)?),
        rows: usize::from(u16(bytes, 44).ok_or_else(short)?),
        x: scale(46)?,
        y: scale(54)?,
        z: scale(62)?,
        compression: f64::from(*bytes.get(78).ok_or_else(short)?),
        number: code,
    };
    let number = number(header.number)?;
    let count = points(header.columns, header.rows)?;
    let data = bytes.get(BINARY_HEADER..).ok_or_else(short)?;
    // A trailer may follow.
    let wanted = count * number.bytes();
    let data = data.get(..wanted).ok_or_else(|| {
        let why = format!("{} bytes where {count} points need {wanted}", data.len());
        broken(KIND, "its data", why)
    })?;
    let mut values = Vec::with_capacity(count);
    number.decode(false, data, &mut values);
    values.iter_mut().filter(|v| is_missing(number, **v)).for_each(|v| *v = f64::NAN);
    finished(&header, values)
}

fn text(bytes: &[u8]) -> Result<Raw, DamageError> {
    let text =
        std::str::from_utf8(bytes).map_err(|e| broken(KIND, &format!("byte {}", e.valid_up_to()), "not text"))?;
    let mut parts = text.splitn(2, '*');
    let head = parts.next().unwrap_or_default();
    let body = parts.next().ok_or_else(|| broken(KIND, "its header", "no `*` ends it"))?;
    let entry = |name: &str| -> Result<f64, DamageError> {
        let lines = head.lines().filter_map(|line| line.split_once('='));
        let value = lines.filter(|(key, _)| key.trim().eq_ignore_ascii_case(name)).map(|(_, v)| v).next();
        let value = value.ok_or_else(|| broken(KIND, name, "it is missing"))?;
        let value = value.split(';').next().unwrap_or_default().trim();
        value.parse().map_err(|_| broken(KIND, name, format!("`{}`", excerpt(value))))
    };
    let count = |name: &str| -> Result<usize, DamageError> {
        let value = entry(name)?;
        let whole = (0.0..=1e9).contains(&value) && value.fract() == 0.0;
        whole.then_some(value as usize).ok_or_else(|| broken(KIND, name, format!("{value}")))
    };
    let header = Header {
        columns: count("NumPoints")?,
        rows: count("NumProfiles")?,
        x: entry("Xscale")?,
        y: entry("Yscale")?,
        z: entry("Zscale")?,
        compression: entry("Compression").unwrap_or(0.0),
        number: 7,
    };
    let wanted = points(header.columns, header.rows)?;
    let mut values = Vec::with_capacity(wanted.min(body.len()));
    let body = body.split('*').next().unwrap_or_default();
    for (k, word) in body.split_whitespace().enumerate() {
        if k >= wanted {
            return Err(broken(KIND, "its data", format!("more than {wanted} heights")));
        }
        let value = match word.eq_ignore_ascii_case("bad") {
            true => f64::NAN,
            false => word.parse().map_err(|_| {
                broken(KIND, &format!("height {}", k + 1), format!("`{}` is not a number", excerpt(word)))
            })?,
        };
        values.push(value);
    }
    if values.len() < wanted {
        let why = format!("{} heights where {} x {} belong", values.len(), header.columns, header.rows);
        return Err(broken(KIND, "its data", why));
    }
    finished(&header, values)
}
