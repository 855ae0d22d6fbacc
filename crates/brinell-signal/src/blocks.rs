//! Condition indicators of a stream with their 95 % intervals, in bounded memory.
//!
//! [`Blocks`] gathers moments and extremes per revolution of the shaft. Every indicator is a function of averages over
//! whole revolutions, so that records of different length estimate one number, and value and interval are of the same
//! quantity:
//!
//! - mean, mean square, central moments and mean |x| are averaged over all samples of the whole revolutions; the root
//!   of the RMS and of the standard deviation and the ratios (kurtosis M_4 / M_2^2, skewness, shape factor) are taken
//!   after averaging;
//! - `peak` and `peak_to_peak` are averages over revolutions of the largest |x| and of the largest less the smallest x
//!   of a revolution; crest and impulse factor are that average peak over the RMS and over mean |x|.
//!
//! The largest |x| of the whole record grows with its length and has no interval; [`Blocks::record`] has it.
//!
//! # Interval
//!
//! A function g of averages has, to first order, the scatter of the average of its influence values z_i = sum_j
//! (dg/dmu_j)(v_ij - mu_j), one for each block i with block averages v_ij (the infinitesimal jackknife; B. Efron, "The
//! jackknife, the bootstrap and other resampling plans", SIAM 1982, chapter 6). The series z_i is correlated, because a
//! cage turns in about 2.3 revolutions of the shaft; [`scatter`](super::scatter()) measures the standard error of its
//! average in spite of that. Quantities that are positive by definition are taken on a logarithmic scale, g = ln of the
//! indicator: their interval is value / f to value * f and never reaches zero. Mean and skewness are taken as they are:
//! value +- half width. Either way the value lies within its interval.

use super::estimate::Estimate;
use super::indicators::{Indicator, Moments};
use super::scatter::{drift, scatter};
use super::series::{Merge, Series};

/// Name of the largest |x| of a whole record, in files and reports.
pub const RECORD_PEAK: &str = "record_peak";
/// Name of that over the RMS.
pub const RECORD_CREST_FACTOR: &str = "record_crest_factor";
/// Name of its largest less its smallest x.
pub const RECORD_PEAK_TO_PEAK: &str = "record_peak_to_peak";

/// One or more whole revolutions.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Block {
    moments: Moments,
    /// Sum over revolutions of the largest |x|.
    peaks: f64,
    /// Sum over revolutions of the largest less the smallest x.
    ranges: f64,
    revolutions: u64,
}

impl Merge for Block {
    fn merge(&self, later: &Block) -> Block {
        Block {
            moments: self.moments.merge(&later.moments),
            peaks: self.peaks + later.peaks,
            ranges: self.ranges + later.ranges,
            revolutions: self.revolutions + later.revolutions,
        }
    }
}

impl Block {
    /// Of the samples of one revolution.
    fn of(moments: Moments) -> Self {
        Block { peaks: moments.peak(), ranges: moments.max() - moments.min(), moments, revolutions: 1 }
    }

    fn peak(&self) -> f64 {
        self.peaks / self.revolutions as f64
    }

    fn range(&self) -> f64 {
        self.ranges / self.revolutions as f64
    }

    /// `None` where it is not defined or not finite.
    fn get(&self, indicator: Indicator) -> Option<f64> {
        use Indicator::*;
        let of_record = self.moments.get(indicator)?;
        let value = match indicator {
            Peak => self.peak(),
            PeakToPeak => self.range(),
            CrestFactor => self.peak() / self.moments.rms(),
            ImpulseFactor => self.peak() / self.moments.mean_absolute(),
            Rms | Mean | StandardDeviation | Kurtosis | Skewness | ShapeFactor => of_record,
        };
        value.is_finite().then_some(value)
    }
}

/// Statistics over consecutive blocks, in bounded memory.
///
/// The caller says [`end_block`](Self::end_block) at each whole revolution of the inner ring. Where one more than
/// [`MOST_BLOCKS`](super::series::MOST_BLOCKS) blocks would begin, neighbours merge in pairs and from then on a block
/// is twice as many revolutions. Samples before the end of the last whole revolution count; those after it count only
/// where there is no whole one.
#[derive(Debug, Clone, Default)]
pub struct Blocks {
    series: Series<Block>,
    /// The revolution that has not ended.
    current: Moments,
}

/// Round-off of a revolution's end, samples.
const END: f64 = 1e-6;

impl Blocks {
    /// No samples, no blocks.
    pub fn new() -> Self {
        Self::default()
    }

    /// Of a slice, in blocks of `samples` samples (not necessarily whole), 1 or more: a revolution is the sample rate
    /// over the speed in Hz.
    pub fn of(x: &[f64], samples: f64) -> Self {
        let mut blocks = Blocks::new();
        let samples = samples.max(1.0);
        let mut from = 0;
        // A revolution that ends within round-off of a sample ends there.
        let ends = (1..).map(|k| (f64::from(k) * samples - END).ceil() as usize);
        for to in ends.take_while(|to| *to <= x.len()) {
            blocks.current.extend(&x[from..to]);
            blocks.end_block();
            from = to;
        }
        blocks.current.extend(&x[from..]);
        blocks
    }

    /// Takes one sample.
    pub fn push(&mut self, x: f64) {
        self.current.push(x);
    }

    /// Ends a whole revolution. One without samples is passed over.
    pub fn end_block(&mut self) {
        if self.current.count() == 0 {
            return;
        }
        self.series.push(&Block::of(self.current));
        self.current = Moments::new();
    }

    /// Whole revolutions.
    pub fn revolutions(&self) -> u64 {
        self.series.revolutions()
    }

    /// Moments and extremes of all samples, those after the last whole revolution included.
    pub fn record(&self) -> Moments {
        self.series.all().moments.merge(&self.current)
    }

    /// All whole revolutions; without one, what has been seen.
    fn all(&self) -> Block {
        match self.series.all() {
            Block { revolutions: 0, .. } => Block::of(self.current),
            all => all,
        }
    }

    /// An indicator with its interval; `None` where it is not defined (see [`Moments::get`]). Of a record shorter than
    /// one revolution it is the indicator of all samples, without an interval.
    pub fn estimate(&self, indicator: Indicator) -> Option<Estimate> {
        let all = self.all();
        let value = all.get(indicator)?;
        let scatter = scatter(&self.influence(&all, indicator));
        Some(if indicator.is_positive() {
            Estimate::positive(value, scatter)
        } else {
            Estimate::signed(value, scatter)
        })
    }

    /// By how much, on a logarithmic scale, the mean square began above its later value, where that is more than its
    /// scatter explains; see [`drift`].
    pub fn level_drift(&self) -> Option<f64> {
        let half = drift(&self.influence(&self.all(), Indicator::Rms))?;
        Some(2.0 * half)
    }

    /// The influence values of the whole blocks on an indicator of `all`, or on its logarithm where it is positive by
    /// definition; in order of time, their mean about 0.
    fn influence(&self, all: &Block, indicator: Indicator) -> Vec<f64> {
        use Indicator::*;
        let (mean, [m2, m3, m4]) = (all.moments.mean(), all.moments.central(all.moments.mean()));
        let square = mean * mean + m2;
        let samples = all.moments.count() as f64 / all.revolutions as f64;
        let blocks = self.series.closed.iter();
        blocks
            .map(|block| {
                let b = &block.moments;
                // Revolutions of a varying speed hold different numbers of samples.
                let weight = b.count() as f64 / block.revolutions as f64 / samples;
                let shift = weight * (b.mean() - mean);
                let [b2, b3, b4] = b.central(mean);
                let d2 = weight * (b2 - m2);
                let of_square = (d2 + 2.0 * mean * shift) / square;
                let of_absolute = || weight * (b.mean_absolute() / all.moments.mean_absolute() - 1.0);
                let of_peak = || block.peak() / all.peak() - 1.0;
                match indicator {
                    Mean => shift,
                    Rms => 0.5 * of_square,
                    StandardDeviation => 0.5 * d2 / m2,
                    Peak => of_peak(),
                    PeakToPeak => block.range() / all.range() - 1.0,
                    CrestFactor => of_peak() - 0.5 * of_square,
                    ImpulseFactor => of_peak() - of_absolute(),
                    ShapeFactor => 0.5 * of_square - of_absolute(),
                    Kurtosis => (weight * (b4 - m4) - 4.0 * m3 * shift) / m4 - 2.0 * d2 / m2,
                    Skewness => {
                        let third = weight * (b3 - m3) - 3.0 * m2 * shift;
                        (third - 1.5 * m3 / m2 * d2) / m2.powf(1.5)
                    }
                }
            })
            .collect()
    }
}

#[cfg(test)]
mod tests;
