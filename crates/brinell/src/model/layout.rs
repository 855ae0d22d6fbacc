//! Where each coordinate is in the state vector.
//!
//! The state is y = (q, dq/dt): `dof` positions, then their rates in the same order. Positions are structures of arrays,
//! so that one operation on all rollers runs over contiguous memory: r of every slot, theta of every slot, phi of every
//! slot, then (x, y, theta) of each cage, then (x, y) of the inner and of the outer ring. Roller j of row i (both from 0)
//! has slot j N_r + i: rows are interleaved, and slots are padded to a multiple of eight with inert ones.

use crate::lanes::WIDTH;

/// Index arithmetic of the state vector.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layout {
    /// N_r.
    pub rows: usize,
    /// Z.
    pub rollers_per_row: usize,
    /// Padded number of roller slots.
    pub slots: usize,
}

impl Layout {
    /// For N_r rows of Z rollers.
    pub fn new(rows: usize, rollers_per_row: usize) -> Self {
        Self {
            rows,
            rollers_per_row,
            slots: (rows * rollers_per_row).next_multiple_of(WIDTH),
        }
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
    /// Padded to a multiple of eight, so that the rates are on cache lines if the positions are; the last few are inert.
    pub fn dof(&self) -> usize {
        (self.outer() + 2).next_multiple_of(WIDTH)
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

    /// x of the cage of `row`; y and theta follow.
    pub fn cage(&self, row: usize) -> usize {
        3 * self.slots + 3 * row
    }

    /// x of the inner ring; y follows.
    pub fn inner(&self) -> usize {
        3 * self.slots + 3 * self.rows
    }

    /// x of the outer ring; y follows.
    pub fn outer(&self) -> usize {
        self.inner() + 2
    }

    /// Name of the body and coordinate behind entry `index` of the positions, rows and rollers counted from 1.
    pub fn name(&self, index: usize) -> String {
        let axis = |k: usize| ["x", "y", "theta"][k];
        if index < 3 * self.slots {
            let slot = index % self.slots;
            let coordinate = ["r", "theta", "phi"][index / self.slots];
            format!(
                "{coordinate} of roller {} in row {}",
                self.roller(slot) + 1,
                self.row(slot) + 1
            )
        } else if index < self.inner() {
            let k = index - 3 * self.slots;
            format!("{} of cage {}", axis(k % 3), k / 3 + 1)
        } else if index < self.outer() {
            format!("{} of the inner ring", axis(index - self.inner()))
        } else {
            format!("{} of the outer ring", axis(index - self.outer()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_every_position_has_its_own_name() {
        let layout = Layout::new(3, 7);
        let real = (0..layout.outer() + 2)
            .filter(|&k| k >= 3 * layout.slots || k % layout.slots < layout.rollers());
        let names: std::collections::BTreeSet<String> = real.map(|k| layout.name(k)).collect();
        assert_eq!(names.len(), 3 * 21 + 3 * 3 + 4);
        assert_eq!(Layout::new(2, 19).slots, 40);
    }
}
