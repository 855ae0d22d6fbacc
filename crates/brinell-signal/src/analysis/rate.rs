//! How well a record tells the frequency of a part that is damaged.

use crate::{Band, Interval, LineFrequency, LineSearch, line_frequency, mean_rate_uncertainty};

/// 95 % interval about a frequency (Hz) that an analysis found, as an estimate of the mean rate of impacts over the record: noise and timing
/// errors of impacts ([`line_frequency()`]), wander of the rate, and how far the frequency lies from the mean of the rates between pieces
/// of the record ([`mean_rate_uncertainty()`]). `None` where the envelope of the band has no line there that is significant by itself.
pub(super) fn interval(x: &[f64], fs: f64, band: Band, frequency: f64) -> Option<Interval> {
    let line = line_frequency(x, fs, band, &LineSearch::new(frequency))?;
    // Else it is another comb's.
    let is_same = (line.frequency - frequency).abs() <= line.resolution;
    let found = LineFrequency { frequency, ..line };
    let uncertainty = is_same.then(|| mean_rate_uncertainty(x, fs, band, &found).ok())??;
    Some(Interval::normal(frequency, uncertainty)).filter(|i| i.low > 0.0 && i.high.is_finite())
}
