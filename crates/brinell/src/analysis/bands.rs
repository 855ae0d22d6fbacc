//! Which bands are demodulated.

use super::{AnalysisError, Options};
use crate::signal::{Band, Kurtogram, KurtogramBand, kurtogram};

/// Multiple of the highest defect frequency above which a carrier is sought.
pub(super) const BROAD: f64 = 3.0;
/// Least width of a band over the highest defect frequency: its sidebands of first and second order fit in.
pub(super) const NARROWEST: f64 = 3.0;
/// Harmonics of the highest defect frequency that the envelope of a given band has to hold.
const HARMONICS_IN_BAND: f64 = 2.0;
/// Halvings of the kurtogram.
const DEPTH: usize = 6;
/// Longest part of a signal that the kurtogram looks at, samples: it chooses a band, and that takes no more.
const LONGEST: usize = 1 << 18;

/// Why a band was chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BandChoice {
    /// The user's.
    Given,
    /// The largest kurtosis of the fast kurtogram.
    Kurtogram,
    /// Everything above three times the highest defect frequency.
    Broad,
    /// The same, whitened: every line of the spectrum brought to one level, so that no tone outweighs impacts.
    Whitened,
    /// One octave of a tiling.
    Octave,
}

impl BandChoice {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            BandChoice::Given => "given",
            BandChoice::Kurtogram => "most impulsive by the fast kurtogram",
            BandChoice::Broad => "everything above three times the highest defect frequency",
            BandChoice::Whitened => {
                "everything above three times the highest defect frequency, whitened"
            }
            BandChoice::Octave => "an octave",
        }
    }
}

/// A band to demodulate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChosenBand {
    /// Its edges, Hz; the upper one at most half the sample rate.
    pub band: Band,
    /// Why.
    pub choice: BandChoice,
}

/// What is demodulated, and what that was chosen from.
pub(super) struct Choice {
    pub(super) bands: Vec<ChosenBand>,
    pub(super) best: Option<KurtogramBand>,
    pub(super) map: Option<Kurtogram>,
}

/// The highest defect frequency, Hz.
pub(super) fn highest(options: &Options) -> f64 {
    (options.orders.strikes()).fold(0.0, |m: f64, s| m.max(s.2)) * options.shaft
}

/// The bands, and the kurtogram.
pub(super) fn choose(x: &[f64], fs: f64, options: &Options) -> Result<Choice, AnalysisError> {
    let top = 0.5 * fs;
    if let Some(band) = options.band {
        let fits = band.low >= 0.0 && band.low < band.high && band.low < top;
        if !fits {
            let range = "0 to below the upper edge and half the sample rate";
            return Err(super::out_of_range(
                "lower edge of the band (Hz)",
                band.low,
                range,
            ));
        }
        if band.high > top && band.high.is_finite() {
            return Err(AnalysisError::BandTooHigh {
                high_hz: band.high,
                most_hz: top,
            });
        }
        // Everything above the lower edge.
        let band = Band::between(band.low, band.high.min(top));
        // An envelope holds nothing above its band's width.
        let needed = HARMONICS_IN_BAND * highest(options);
        if band.high - band.low < needed {
            return Err(AnalysisError::BandTooNarrow {
                width_hz: band.high - band.low,
                needed_hz: needed,
            });
        }
        let choice = BandChoice::Given;
        return Ok(Choice {
            bands: vec![ChosenBand { band, choice }],
            best: None,
            map: None,
        });
    }
    let highest = highest(options);
    let narrowest = NARROWEST * highest;
    let map = kurtogram(&x[..x.len().min(LONGEST)], fs, DEPTH)?;
    let best = map.best(narrowest);
    let mut bands = Vec::new();
    if let Some(best) = best
        && best.bandwidth() < 0.99 * top
    {
        bands.push(ChosenBand {
            band: best.band,
            choice: BandChoice::Kurtogram,
        });
    }
    let low = BROAD * highest;
    for choice in [BandChoice::Broad, BandChoice::Whitened] {
        bands.push(ChosenBand {
            band: Band::between(low, top),
            choice,
        });
    }
    let mut edge = low;
    while top - edge >= 2.0 * narrowest {
        let mut next = (2.0 * edge).max(edge + narrowest);
        if top - next < narrowest {
            next = top;
        }
        if edge > low || next < top {
            bands.push(ChosenBand {
                band: Band::between(edge, next),
                choice: BandChoice::Octave,
            });
        }
        edge = next;
    }
    Ok(Choice {
        bands,
        best,
        map: Some(map),
    })
}
