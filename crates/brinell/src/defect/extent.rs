//! What slices divide along z.

use crate::slices::borders;

/// What slices divide along z, m: a roller's length, or the extent of the damage under balls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Extent {
    pub(super) middle: f64,
    pub(super) length: f64,
    /// Whether balls meet it.
    pub(super) of_balls: bool,
}

impl Extent {
    /// A roller of length L, m.
    pub(super) fn of_roller(length: f64) -> Self {
        Self { middle: 0.0, length, of_balls: false }
    }

    /// Damage between two z, m.
    pub(super) fn of_damage([low, high]: [f64; 2]) -> Self {
        Self { middle: 0.5 * (low + high), length: high - low, of_balls: true }
    }
}

/// First and last z of slice k (from 0) of n_s, m.
pub(super) fn slice_borders(k: usize, slices: usize, extent: Extent) -> [f64; 2] {
    borders(k, slices, extent.length).map(|z| extent.middle + z)
}
