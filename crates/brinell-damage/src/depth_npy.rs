//! NumPy's NPY, versions 1 to 3: two-dimensional arrays of floats or integers, in C or Fortran order.
//! Format: <https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html>

use crate::error::{DamageError, excerpt};
use crate::kind::FileKind;
use crate::scan::{MAX_POINTS, Raw};
use brinell_io::{Number, npy_entry, npy_number, npy_sides, npy_tuple, npy_word};

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
    let entry = |key| npy_entry(header, key).ok_or_else(|| broken("its header", format!("`{key}` is missing")));
    let (number, big) = number(entry("descr")?)?;
    let fortran = match entry("fortran_order")? {
        value if value.starts_with("True") => true,
        value if value.starts_with("False") => false,
        value => return Err(broken("fortran_order", format!("`{}`", excerpt(value)))),
    };
    let [rows, columns] = shape(entry("shape")?)?;
    let points = rows.checked_mul(columns).filter(|&n| n <= MAX_POINTS);
    let points = points.ok_or_else(|| Raw::too_large(format!("{rows} x {columns}")))?;
    let (data, wanted) = (&bytes[end..], points * number.bytes());
    if data.len() != wanted {
        return Err(broken("its data", format!("{} bytes where {rows} x {columns} values need {wanted}", data.len())));
    }
    let mut values = Vec::with_capacity(points);
    number.decode(big, data, &mut values);
    if fortran {
        values = (0..points).map(|i| values[i % columns * rows + i / columns]).collect();
    }
    Ok(Raw { width: columns, height: rows, values, ..Raw::default() })
}

fn shape(text: &str) -> Result<[usize; 2], DamageError> {
    let inside = npy_tuple(text).ok_or_else(|| broken("shape", format!("`{}`", excerpt(text))))?;
    let side = |side: u64| usize::try_from(side).unwrap_or(usize::MAX);
    match npy_sides(inside).as_deref() {
        Some(&[rows, columns]) => Ok([side(rows), side(columns)]),
        _ => Err(DamageError::Unsupported {
            at: "shape".to_owned(),
            what: format!("({})", excerpt(inside)),
            way_out: "save a two-dimensional array, rows by columns",
        }),
    }
}

/// The type of an array's numbers, and whether they have their highest byte first. Booleans and half-precision floats
/// are no heights.
fn number(descr: &str) -> Result<(Number, bool), DamageError> {
    let word = npy_word(descr).unwrap_or(descr);
    let no_height = word.ends_with("b1") || word.ends_with("f2");
    npy_number(word).filter(|_| !no_height).ok_or_else(|| DamageError::Unsupported {
        at: "descr".to_owned(),
        what: format!("`{}`", excerpt(word)),
        way_out: "save the array as float64",
    })
}
