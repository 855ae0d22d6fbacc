//! What a plot needs of a signal of any length: its latest part sample by sample, and the extremes of all of it.

use super::stretches::Stretches;
use std::collections::VecDeque;

/// Samples kept one by one.
#[doc(hidden)]
pub const KEPT: usize = 65_536;
/// Bins of the overview, at most.
const BINS: usize = 2048;

/// A signal on its way past.
#[derive(Debug, Clone, PartialEq)]
pub struct Waveform {
    latest: VecDeque<f64>,
    seen: u64,
    extremes: Stretches<[f64; 2]>,
}

impl Waveform {
    /// Empty.
    pub fn new() -> Self {
        Self { latest: VecDeque::new(), seen: 0, extremes: Stretches::new(BINS, 1) }
    }

    /// Takes one sample.
    pub fn push(&mut self, x: f64) {
        if self.latest.len() == KEPT {
            self.latest.pop_front();
        }
        self.latest.push_back(x);
        self.seen += 1;
        let join = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        let bin = &mut self.extremes.next([x, x], join)[0];
        *bin = join(*bin, [x, x]);
    }

    /// The latest samples and the index of the first of them.
    pub fn latest(&self) -> (u64, Vec<f64>) {
        (self.seen - self.latest.len() as u64, self.latest.iter().copied().collect())
    }

    /// (smallest, largest) of each bin, and the samples in a bin.
    pub fn overview(&self) -> (&[[f64; 2]], u64) {
        (&self.extremes.values, self.extremes.samples)
    }
}

impl Default for Waveform {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_overview_holds_the_extremes_and_stays_small() {
        let mut w = Waveform::new();
        for k in 0..1_000_000_u32 {
            w.push(if k == 123_456 { 7.0 } else { f64::from(k % 100) * 0.01 });
        }
        let (bins, per_bin) = w.overview();
        assert!(bins.len() <= BINS);
        assert_eq!(bins[(123_456 / per_bin) as usize][1], 7.0);
        assert_eq!(bins.iter().filter(|b| b[1] == 7.0).count(), 1);
        assert_eq!(w.latest().0, 1_000_000 - KEPT as u64);
    }
}
