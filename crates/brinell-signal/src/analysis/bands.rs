//! Which bands are demodulated.

use super::error::{AnalysisError, out_of_range};
use super::options::Options;
use crate::Band;

/// Multiple of the highest defect frequency above which a carrier is sought.
pub(super) const BROAD: f64 = 3.0;
/// Least width of a band over the highest defect frequency: its sidebands of first and second order fit in.
pub(super) const NARROWEST: f64 = 3.0;
/// Impacts ring below this frequency on every machine, Hz: no part of the range that ends lower is looked at by itself.
pub(super) const LOWEST_TOP: f64 = 5000.0;
/// Harmonics of the highest defect frequency that the envelope of a given band has to hold.
const HARMONICS_IN_BAND: f64 = 2.0;

/// Why a band is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BandChoice {
    /// The user's.
    Given,
    /// The one in which the lines of what is called damage are highest.
    Clearest,
    /// Everything above three times the highest defect frequency.
    Broad,
    /// Everything above three times what that may be, where the bearing is not known.
    OfUnknown,
}

impl BandChoice {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            BandChoice::Given => "given",
            BandChoice::Clearest => "where its lines are strongest",
            BandChoice::Broad => "everything above three times the highest defect frequency",
            BandChoice::OfUnknown => "everything above 36 turns of the shaft, as no bearing is given",
        }
    }
}

/// Lower parts of a range, each half as wide as the last: where the sample rate is high, bands with nothing but noise
/// outnumber those in which impacts ring, and hide them in an average over all.
pub(super) fn lower(range: Band) -> impl Iterator<Item = Band> {
    let tops = (1..).map(move |k| range.high * 0.5_f64.powi(k));
    tops.take_while(move |top| *top >= LOWEST_TOP && *top > 2.0 * range.low)
        .map(move |top| Band::between(range.low, top))
}

/// The highest defect frequency, Hz.
pub(super) fn highest(options: &Options) -> f64 {
    options.orders.highest() * options.shaft
}

/// The range that is looked through: the user's band, or everything above [`BROAD`].
pub(super) fn range(fs: f64, options: &Options) -> Result<Band, AnalysisError> {
    let top = 0.5 * fs;
    let Some(band) = options.band else {
        return Ok(Band::between(BROAD * highest(options), top));
    };
    let fits = band.low >= 0.0 && band.low < band.high && band.low < top;
    if !fits {
        let range = "0 to below the upper edge and half the sample rate";
        return Err(out_of_range("lower edge of the band (Hz)", band.low, range));
    }
    if band.high > top && band.high.is_finite() {
        return Err(AnalysisError::BandTooHigh { high_hz: band.high, most_hz: top });
    }
    // Everything above the lower edge.
    let band = Band::between(band.low, band.high.min(top));
    // An envelope holds nothing above its band's width.
    let needed = HARMONICS_IN_BAND * highest(options);
    if band.high - band.low < needed {
        return Err(AnalysisError::BandTooNarrow { width_hz: band.high - band.low, needed_hz: needed });
    }
    Ok(band)
}
