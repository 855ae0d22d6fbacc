//! Numbers laid out for whole groups: starting on a cache line, padded to a multiple of [`WIDTH`].

use super::WIDTH;
use std::ops::{Deref, DerefMut};

/// Eight numbers on one cache line.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C, align(64))]
struct Line([f64; WIDTH]);

/// A list of numbers that a group never straddles two cache lines of.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Column {
    lines: Vec<Line>,
    len: usize,
}

impl Column {
    /// `len` times `value`.
    pub fn new(len: usize, value: f64) -> Self {
        Self { lines: vec![Line([value; WIDTH]); len.div_ceil(WIDTH)], len }
    }
}

impl From<&[f64]> for Column {
    fn from(values: &[f64]) -> Self {
        let mut column = Self::new(values.len(), 0.0);
        column.copy_from_slice(values);
        column
    }
}

impl FromIterator<f64> for Column {
    fn from_iter<I: IntoIterator<Item = f64>>(values: I) -> Self {
        Self::from(values.into_iter().collect::<Vec<f64>>().as_slice())
    }
}

impl Deref for Column {
    type Target = [f64];

    #[inline(always)]
    fn deref(&self) -> &[f64] {
        // SAFETY: a `Line` is eight numbers without padding, and `len` of them are there.
        unsafe { std::slice::from_raw_parts(self.lines.as_ptr().cast(), self.len) }
    }
}

impl DerefMut for Column {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [f64] {
        // SAFETY: as above.
        unsafe { std::slice::from_raw_parts_mut(self.lines.as_mut_ptr().cast(), self.len) }
    }
}

impl<'a> IntoIterator for &'a Column {
    type Item = &'a f64;
    type IntoIter = std::slice::Iter<'a, f64>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_a_column_is_a_list_on_a_cache_line() {
        for len in [0, 1, 7, 8, 9, 130] {
            let values: Vec<f64> = (0..len).map(|k| k as f64).collect();
            let mut column = Column::from(values.as_slice());
            assert_eq!(column[..], values);
            assert!((column.as_ptr() as usize).is_multiple_of(64));
            column.fill(2.0);
            assert_eq!(column[..], *Column::new(len, 2.0));
            assert_eq!(values.iter().copied().collect::<Column>()[..], values);
        }
    }
}
