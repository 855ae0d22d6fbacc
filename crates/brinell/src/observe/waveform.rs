//! What a plot needs of a signal of any length: its latest part sample by sample, and the extremes of all of it.

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
    /// Samples a full bin.
    per_bin: u64,
    extremes: Vec<[f64; 2]>,
    in_bin: u64,
}

impl Waveform {
    /// Empty.
    pub fn new() -> Self {
        Self { latest: VecDeque::new(), seen: 0, per_bin: 1, extremes: Vec::new(), in_bin: 0 }
    }

    /// Takes one sample.
    pub fn push(&mut self, x: f64) {
        if self.latest.len() == KEPT {
            self.latest.pop_front();
        }
        self.latest.push_back(x);
        self.seen += 1;
        if self.in_bin == 0 {
            if self.extremes.len() == BINS {
                let merged = self.extremes.chunks(2).map(|c| [c[0][0].min(c[1][0]), c[0][1].max(c[1][1])]);
                self.extremes = merged.collect();
                self.per_bin *= 2;
            }
            self.extremes.push([x, x]);
        } else if let Some(last) = self.extremes.last_mut() {
            *last = [last[0].min(x), last[1].max(x)];
        }
        self.in_bin = (self.in_bin + 1) % self.per_bin;
    }

    /// The latest samples and the index of the first of them.
    pub fn latest(&self) -> (u64, Vec<f64>) {
        (self.seen - self.latest.len() as u64, self.latest.iter().copied().collect())
    }

    /// (smallest, largest) of each bin, and the samples in a bin.
    pub fn overview(&self) -> (&[[f64; 2]], u64) {
        (&self.extremes, self.per_bin)
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
