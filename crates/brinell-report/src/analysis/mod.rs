//! The page of an analysed signal: verdict, waveform, spectrum, envelope spectrum; and a second signal over it.

mod content;
mod curves;
mod evidence;
mod level;
mod page;
mod waveform;
mod words;

use crate::data::{Marker, Series, Spectrum, Tone};
use crate::fact::Fact;
use crate::kurtogram::Kurtogram;
use crate::tables::Table;
pub(crate) use content::with_interval;
pub use content::{Analyzed, Findings};
pub use evidence::Evidence;
pub(crate) use evidence::{highest_score, weight};
pub use level::{ZONES, level_lines, scaled};
pub(crate) use page::envelope_of_size;
pub(crate) use waveform::close_of_size;
pub use words::{called, orders_in_hz, ratio};

/// Everything the page of an analysis shows. Curves come in the order of `names`, one or two of each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AnalysisReport {
    /// The verdict in a few words.
    pub title: String,
    /// File and channel, length, speed.
    pub subtitle: String,
    /// The version of the program, and what else made the page.
    pub version: String,
    /// The verdict in a paragraph.
    pub verdict: String,
    /// What colour it has.
    pub tone: Tone,
    /// What deserves attention.
    pub warnings: Vec<String>,
    /// Where rate, unit, speed and bearing come from.
    pub notes: Vec<String>,
    /// Headline numbers.
    pub facts: Vec<Fact>,
    /// What the curves are: "measured", "simulated".
    pub names: Vec<String>,
    /// Waveforms, thinned or not.
    pub waveforms: Vec<Series>,
    /// Seconds shown close up, from the middle of the signal.
    pub close_up_s: f64,
    /// Amplitude spectra.
    pub spectra: Vec<Spectrum>,
    /// Envelope spectra.
    pub envelopes: Vec<Spectrum>,
    /// Whether envelope spectra are of equal angles: their frequencies are orders times the mean speed.
    pub order_tracked: bool,
    /// Defect frequencies; `present` for those that are detected.
    pub markers: Vec<Marker>,
    /// The band demodulated, Hz: shaded in the spectrum.
    pub band_hz: Option<(f64, f64)>,
    /// Which bands are how impulsive.
    pub kurtogram: Option<Kurtogram>,
    /// Findings, indicators, differences.
    pub tables: Vec<Table>,
}
