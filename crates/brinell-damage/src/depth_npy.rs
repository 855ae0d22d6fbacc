//! NumPy's NPY, versions 1 to 3: two-dimensional arrays of floats or integers, in C or Fortran order.
//! Format: <https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html>

use crate::bytes::{Kind, Number};
use crate::error::{DamageError, excerpt};
use crate::kind::FileKind;
use crate::scan::{MAX_POINTS, Raw};

fn broken(at: &str, why: impl Into<String>) -> DamageError {
    DamageError::Broken { kind: FileKind::Npy, at: at.to_owned(), why: why.into() }
}

pub(crate) fn read(bytes: &[u8]) -> Result<Raw, DamageError> {
    let short = || broken("its header", "it ends here");
    let version = *bytes.get(6).ok_or_else(short)?;
    let (start, length) = match version {
        1 => {
            let b = bytes.get(8..10).ok_or_else(short)?;
            (10, usize::from(u16::from_le_bytes([b[0], b[1]])))
        }
        2 | 3 => {
            let b = bytes.get(8..12).ok_or_else(short)?;
            (12, u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as usize)
        }
        other => return Err(broken("its header", format!("version {other} is unknown"))),
    };
    let end = start + length;
    let header = bytes.get(start..end).ok_or_else(short)?;
    let header = std::str::from_utf8(header).map_err(|_| broken("its header", "not UTF-8"))?;
    let (kind, big) = number(quoted(entry(header, "descr")?))?;
    let fortran = match entry(header, "fortran_order")? {
        value if value.starts_with("True") => true,
        value if value.starts_with("False") => false,
        value => return Err(broken("fortran_order", format!("`{}`", excerpt(value)))),
    };
    let [rows, columns] = shape(entry(header, "shape")?)?;
    let points = rows.checked_mul(columns).filter(|&n| n <= MAX_POINTS);
    let points = points.ok_or_else(|| Raw::too_large(format!("{rows} x {columns}")))?;
    let data = &bytes[end..];
    if data.len() != points * kind.size {
        return Err(broken(
            "its data",
            format!("{} bytes where {rows} x {columns} values need {}", data.len(), points * kind.size),
        ));
    }
    let mut values = vec![0.0; points];
    for (i, item) in data.chunks_exact(kind.size).enumerate() {
        let at = if fortran { i % rows * columns + i / rows } else { i };
        let mut bytes = [0; 8];
        let bytes = &mut bytes[..kind.size];
        bytes.copy_from_slice(item);
        if big {
            bytes.reverse();
        }
        values[at] = kind.value(bytes);
    }
    Ok(Raw { width: columns, height: rows, values, ..Raw::default() })
}

/// What follows a key of the header, a Python dictionary of three known keys.
fn entry<'a>(header: &'a str, key: &'static str) -> Result<&'a str, DamageError> {
    for quote in ['\'', '"'] {
        if let Some((_, rest)) = header.split_once(&format!("{quote}{key}{quote}"))
            && let Some(value) = rest.trim_start().strip_prefix(':')
        {
            return Ok(value.trim_start());
        }
    }
    Err(broken("its header", format!("`{key}` is missing")))
}

fn quoted(text: &str) -> &str {
    let mut parts = text.splitn(3, ['\'', '"']);
    match (parts.next(), parts.next()) {
        (Some(""), Some(inside)) => inside,
        // A structured type.
        _ => text,
    }
}

fn shape(text: &str) -> Result<[usize; 2], DamageError> {
    let inside = text.strip_prefix('(').and_then(|t| t.split_once(')')).map(|t| t.0);
    let inside = inside.ok_or_else(|| broken("shape", format!("`{}`", excerpt(text))))?;
    let sides: Option<Vec<usize>> =
        inside.split(',').map(str::trim).filter(|side| !side.is_empty()).map(|side| side.parse().ok()).collect();
    match sides.as_deref() {
        Some(&[rows, columns]) => Ok([rows, columns]),
        _ => Err(DamageError::Unsupported {
            at: "shape".to_owned(),
            what: format!("({})", excerpt(inside)),
            way_out: "save a two-dimensional array, rows by columns",
        }),
    }
}

/// What NumPy calls the type of an array's numbers, and whether they have their highest byte first.
fn number(descr: &str) -> Result<(Number, bool), DamageError> {
    let mut letters = descr.chars();
    let big = match letters.next() {
        Some('>') => Some(true),
        Some('<' | '=' | '|') => Some(false),
        _ => None,
    };
    let kind = match letters.next() {
        Some('f') => Some(Kind::Float),
        Some('i') => Some(Kind::Signed),
        Some('u') => Some(Kind::Unsigned),
        _ => None,
    };
    let number = letters.as_str().parse().ok().zip(kind).and_then(|(size, kind)| Number::new(kind, size));
    number.zip(big).ok_or_else(|| DamageError::Unsupported {
        at: "descr".to_owned(),
        what: format!("`{}`", excerpt(descr)),
        way_out: "save the array as float64",
    })
}
