//! Where each coordinate is in the state vector.
//!
//! The state is y = (q, dq/dt): `dof` positions, then their rates in the same order. Positions are structures of
//! arrays, so that one operation on all rollers runs over contiguous memory: r of every slot, theta of every slot, phi
//! of every slot and, where they tilt, beta of every slot; then (x, y, theta) of each cage, then (x, y) of the inner
//! and of the outer ring and, where they tilt, their (tau_x, tau_y). Roller j of row i (both from 0) has slot j N_r +
//! i: rows are interleaved, and slots are padded to a multiple of eight with inert ones.

use crate::lanes::WIDTH;
use crate::scenario::Element;

/// Index arithmetic of the state vector.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layout {
    /// N_r.
    pub rows: usize,
    /// Z.
    pub rollers_per_row: usize,
    /// Padded number of roller slots.
    pub slots: usize,
    /// Whether rollers and rings tilt.
    pub tilts: bool,
}

impl Layout {
    /// For N_r rows of Z rollers.
    pub fn new(rows: usize, rollers_per_row: usize, tilts: bool) -> Self {
        Self { rows, rollers_per_row, slots: (rows * rollers_per_row).next_multiple_of(WIDTH), tilts }
    }

    /// Rollers of all rows: the slots below this number are real.
    pub fn rollers(&self) -> usize {
        self.rows * self.rollers_per_row
    }

    /// Slot of roller `roller` (from 0) in `row` (from 0).
    pub fn slot(&self, row: usize, roller: usize) -> usize {
        roller * self.rows + row
    }

    /// Row of a slot.
    pub fn row(&self, slot: usize) -> usize {
        slot % self.rows
    }

    /// Roller of a slot within its row.
    pub fn roller(&self, slot: usize) -> usize {
        slot / self.rows
    }

    /// Slots after which the pattern of rows over groups of lanes repeats.
    pub fn row_period(&self) -> usize {
        let mut period = WIDTH;
        while !period.is_multiple_of(self.rows) {
            period += WIDTH;
        }
        period
    }

    /// Number of positions; the state has twice as many entries.
    ///
    /// Padded to a multiple of eight, so that the rates are on cache lines if the positions are; the last few are
    /// inert.
    pub fn dof(&self) -> usize {
        (self.outer() + if self.tilts { 6 } else { 2 }).next_multiple_of(WIDTH)
    }

    /// First r.
    pub fn r(&self) -> usize {
        0
    }

    /// First theta.
    pub fn theta(&self) -> usize {
        self.slots
    }

    /// First phi.
    pub fn phi(&self) -> usize {
        2 * self.slots
    }

    /// First beta, where rollers tilt.
    pub fn beta(&self) -> usize {
        3 * self.slots
    }

    /// Coordinates of a roller.
    fn columns(&self) -> usize {
        if self.tilts { 4 } else { 3 }
    }

    /// x of the cage of `row`; y and theta follow.
    pub fn cage(&self, row: usize) -> usize {
        self.columns() * self.slots + 3 * row
    }

    /// x of the inner ring; y follows.
    pub fn inner(&self) -> usize {
        self.cage(self.rows)
    }

    /// x of the outer ring; y follows.
    pub fn outer(&self) -> usize {
        self.inner() + 2
    }

    /// tau_x of the inner ring, where rings tilt; tau_y follows.
    pub fn inner_tilt(&self) -> usize {
        self.outer() + 2
    }

    /// tau_x of the outer ring; tau_y follows.
    pub fn outer_tilt(&self) -> usize {
        self.outer() + 4
    }

    /// Name of the body and coordinate behind entry `index` of the positions, rows and rollers or balls counted from 1.
    pub fn name(&self, index: usize, element: Element) -> String {
        let axis = |k: usize| ["x", "y", "theta"][k];
        if index < self.cage(0) {
            let slot = index % self.slots;
            let coordinate = ["r", "theta", "phi", "beta"][index / self.slots];
            format!("{coordinate} of {} {} in row {}", element.word(), self.roller(slot) + 1, self.row(slot) + 1)
        } else if index < self.inner() {
            let k = index - self.cage(0);
            format!("{} of cage {}", axis(k % 3), k / 3 + 1)
        } else if index < self.outer() {
            format!("{} of the inner ring", axis(index - self.inner()))
        } else if index < self.inner_tilt() {
            format!("{} of the outer ring", axis(index - self.outer()))
        } else if index < self.outer_tilt() {
            format!("tilt {} of the inner ring", axis(index - self.inner_tilt()))
        } else {
            format!("tilt {} of the outer ring", axis(index - self.outer_tilt()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_every_position_has_its_own_name() {
        for (tilts, coordinates) in [(false, 3 * 21 + 3 * 3 + 4), (true, 4 * 21 + 3 * 3 + 8)] {
            let layout = Layout::new(3, 7, tilts);
            let end = layout.outer() + if tilts { 6 } else { 2 };
            let real = (0..end).filter(|&k| k >= layout.cage(0) || k % layout.slots < layout.rollers());
            let names: std::collections::BTreeSet<String> = real.map(|k| layout.name(k, Element::Roller)).collect();
            assert_eq!(names.len(), coordinates);
        }
        assert_eq!(Layout::new(2, 19, false).slots, 40);
    }
}
