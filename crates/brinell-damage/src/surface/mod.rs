//! Surfaces as instruments save them, with their spacing: ISO 25178-71 (`.sdf`), ISO 5436-2 (`.x3p`), MountainsMap
//! (`.sur`).

mod archive;
mod sdf;
mod sur;
mod x3p;

pub(crate) use sdf::read as read_sdf;
pub(crate) use sur::read as read_sur;
pub(crate) use x3p::read as read_x3p;

use crate::error::DamageError;
use crate::kind::FileKind;
use crate::scan::{MAX_POINTS, Raw};

fn broken(kind: FileKind, at: &str, why: impl Into<String>) -> DamageError {
    DamageError::Broken { kind, at: at.to_owned(), why: why.into() }
}

fn unsupported(kind: FileKind, what: impl Into<String>, way_out: &'static str) -> DamageError {
    DamageError::Unsupported { at: format!("this {kind} file"), what: what.into(), way_out }
}

/// Points of a grid that is not too large.
fn points(columns: usize, rows: usize) -> Result<usize, DamageError> {
    let points = columns.checked_mul(rows).filter(|&n| n <= MAX_POINTS);
    points.ok_or_else(|| Raw::too_large(format!("{columns} x {rows}")))
}

/// A distance of points from m to mm.
fn spacing(kind: FileKind, name: &str, metres: f64) -> Result<f64, DamageError> {
    let mm = 1e3 * metres.abs();
    if mm > 0.0 && mm <= 10.0 {
        return Ok(mm);
    }
    let why = format!("{metres} m is no distance of points");
    Err(broken(kind, name, why))
}

/// Heights in m as the map of a file that says its own spacing.
fn map(columns: usize, spacing_mm: [f64; 2], metres: Vec<f64>) -> Raw {
    Raw {
        width: columns,
        height: metres.len() / columns.max(1),
        values: metres,
        spacing_mm: Some(spacing_mm),
        unit_um: Some(1e6),
        ..Raw::default()
    }
}
