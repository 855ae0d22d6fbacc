//! A profilometer's grid: as written in a file, and as depths in `s` and `z`.

use crate::error::DamageError;

/// The largest grid that is read: 4096 x 4096.
pub(crate) const MAX_POINTS: usize = 1 << 24;
/// How far a spacing may be from the one that is stated, relative.
pub(crate) const SAME: f64 = 0.01;

/// Numbers as written in a file; NaN is missing.
#[derive(Default)]
pub(crate) struct Raw {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) values: Vec<f64>,
    pub(crate) warnings: Vec<String>,
    /// What was understood of the file.
    pub(crate) notes: Vec<String>,
    /// Distance of columns and of rows, where the file says it.
    pub(crate) spacing_mm: Option<[f64; 2]>,
    /// What one of the numbers is, where the file says it.
    pub(crate) unit_um: Option<f64>,
}

impl Raw {
    pub(crate) fn too_large(points: String) -> DamageError {
        DamageError::TooLarge {
            what: "the number of points",
            value: points,
            limit: format!("{MAX_POINTS} (4096 x 4096)"),
            way_out: "cut out the damage or thin the scan out, and adapt `ds_mm` and `dz_mm`",
        }
    }
}

/// Depths in `s` and `z`, the grid's centre at the origin.
pub(crate) struct Scan {
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    pub(crate) ds_mm: f64,
    pub(crate) dz_mm: f64,
    pub(crate) depth_um: Vec<f64>,
}

impl Scan {
    /// `(s, z)` of a point, mm.
    pub(crate) fn place(&self, column: usize, row: usize) -> (f64, f64) {
        let from_middle = |i: usize, n: usize| i as f64 - 0.5 * (n - 1) as f64;
        (from_middle(column, self.columns) * self.ds_mm, from_middle(row, self.rows) * self.dz_mm)
    }
}
