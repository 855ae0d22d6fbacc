//! A series of blocks of whole revolutions in bounded memory, and averages over them.

use super::estimate::Estimate;
use super::scatter::{drift, scatter};

/// Blocks held at most; even.
pub const MOST_BLOCKS: usize = 128;

/// What two consecutive blocks make together; the default is of no samples.
pub(super) trait Merge: Copy + Default {
    fn merge(&self, later: &Self) -> Self;
}

/// Consecutive blocks of equally many revolutions. Where one more than [`MOST_BLOCKS`] would begin, neighbours merge in
/// pairs, and from then on a block is twice as many revolutions.
#[derive(Debug, Clone)]
pub(super) struct Series<B> {
    pub(super) closed: Vec<B>,
    /// Whole revolutions of the block that is not full.
    pub(super) open: B,
    revolutions_in_open: u64,
    pub(super) per_block: u64,
}

impl<B: Merge> Default for Series<B> {
    fn default() -> Self {
        Series { closed: Vec::with_capacity(MOST_BLOCKS), open: B::default(), revolutions_in_open: 0, per_block: 1 }
    }
}

impl<B: Merge> Series<B> {
    /// Takes a whole revolution.
    pub(super) fn push(&mut self, revolution: &B) {
        self.open = self.open.merge(revolution);
        self.revolutions_in_open += 1;
        if self.revolutions_in_open < self.per_block {
            return;
        }
        if self.closed.len() == MOST_BLOCKS {
            for i in 0..MOST_BLOCKS / 2 {
                self.closed[i] = self.closed[2 * i].merge(&self.closed[2 * i + 1]);
            }
            self.closed.truncate(MOST_BLOCKS / 2);
            self.per_block *= 2;
            return;
        }
        self.closed.push(self.open);
        self.open = B::default();
        self.revolutions_in_open = 0;
    }

    pub(super) fn revolutions(&self) -> u64 {
        self.closed.len() as u64 * self.per_block + self.revolutions_in_open
    }

    /// All whole revolutions together.
    pub(super) fn all(&self) -> B {
        let fold = |all: B, block: &B| all.merge(block);
        self.closed.iter().fold(B::default(), fold).merge(&self.open)
    }
}

/// A weighted sum and its weights.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Sum {
    sum: f64,
    weight: f64,
}

impl Merge for Sum {
    fn merge(&self, later: &Sum) -> Sum {
        Sum { sum: self.sum + later.sum, weight: self.weight + later.weight }
    }
}

/// The average of a quantity over the whole revolutions of a run, with its 95 % interval (see
/// [`scatter`](super::scatter())).
#[derive(Debug, Clone, Default)]
pub struct Averages {
    series: Series<Sum>,
    current: Sum,
}

impl Averages {
    /// Nothing seen yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes a value.
    pub fn push(&mut self, value: f64) {
        self.current.sum += value;
        self.current.weight += 1.0;
    }

    /// Takes what a quantity adds up to over some time (or another weight): its rate is averaged.
    pub fn add(&mut self, sum: f64, weight: f64) {
        self.current.sum += sum;
        self.current.weight += weight;
    }

    /// Ends a whole revolution. One without values is passed over.
    pub fn end_block(&mut self) {
        if self.current.weight > 0.0 {
            self.series.push(&self.current);
            self.current = Sum::default();
        }
    }

    /// All whole revolutions; without one, what has been seen.
    fn all(&self) -> Sum {
        match self.series.all() {
            Sum { weight: 0.0, .. } => self.current,
            all => all,
        }
    }

    /// The average over whole revolutions, or without one, over what has been seen, and its interval; `None` of
    /// nothing.
    pub fn estimate(&self) -> Option<Estimate> {
        let all = self.all();
        let value = all.sum / all.weight;
        (all.weight > 0.0 && value.is_finite())
            .then(|| Estimate::signed(value, scatter(&self.influence(value, all.weight))))
    }

    /// Sum of the weights of the whole revolutions; without one, of what has been seen.
    pub fn weight(&self) -> f64 {
        self.all().weight
    }

    /// Deviations of the blocks from `mean`.
    fn influence(&self, mean: f64, weight: f64) -> Vec<f64> {
        let revolutions = self.series.revolutions() as f64;
        let each = weight / revolutions * self.series.per_block as f64;
        let blocks = self.series.closed.iter();
        blocks.map(|b| (b.sum - mean * b.weight) / each).collect()
    }

    /// Spectral density of the average at frequency zero (two-sided, in its unit squared times that of the weight),
    /// from all blocks but the first share `skipped` of them, with its degrees of freedom; `None` of a series too short
    /// to tell, and where nothing is left.
    pub fn density(&self, skipped: f64) -> Option<(f64, u32)> {
        let all = self.all();
        let influence = self.influence(all.sum / all.weight, all.weight);
        let rest = influence.get((skipped * influence.len() as f64) as usize..)?;
        let found = scatter(rest)?;
        let revolutions = rest.len() as u64 * self.series.per_block;
        let weight = all.weight * revolutions as f64 / self.series.revolutions() as f64;
        Some((found.error * found.error * weight, found.freedom))
    }

    /// By how much the average began above its later value, where that is more than its scatter explains; see
    /// [`drift`].
    pub fn drift(&self) -> Option<f64> {
        let all = self.all();
        drift(&self.influence(all.sum / all.weight, all.weight))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_shares_that_leave_nothing_have_no_density() {
        let mut averages = Averages::new();
        for k in 0..40 {
            averages.push(f64::from(k % 7));
            averages.end_block();
        }
        assert!(averages.density(0.2).is_some());
        for share in [1.0, 1.5, f64::INFINITY] {
            assert_eq!(averages.density(share), None);
        }
        assert_eq!(Averages::new().density(0.0), None);
    }
}
