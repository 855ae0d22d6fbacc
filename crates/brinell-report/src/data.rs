//! What a report is made of: numbers and words, and what the engine has in the shape that is drawn.
//!
//! Times are seconds, frequencies hertz and angles degrees; every other quantity carries its unit as text. A unit may
//! hold an exponent as `N/m^(10/9)` or `m/s^2`; it is typeset, not computed with. Missing data is an empty vector or
//! `None`, and a value that could not be computed is NaN: both are shown as such.

use brinell::observe::passes::PassPoint;

/// Where the values of a curve are.
#[derive(Clone, Debug, PartialEq)]
pub enum Along {
    /// From a first place on, evenly.
    Even {
        /// Place of the first value.
        first: f64,
        /// From one value to the next.
        step: f64,
    },
    /// Each in its own place.
    At(Vec<f64>),
}

/// How a verdict is coloured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tone {
    /// It holds; nothing was found.
    Good,
    /// It does not; something is damaged.
    Bad,
    /// Neither can be said.
    #[default]
    Open,
}

impl Tone {
    pub(crate) fn class(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::Bad => "bad",
            Self::Open => "open",
        }
    }
}

/// The signal of a run at the sensor, in all of its pictures.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Signals {
    /// The run's name.
    pub title: String,
    /// Bearing, defect, speed, load.
    pub subtitle: String,
    /// The healthy bearing beside it; empty where it was not run.
    pub healthy: Healthy,
    /// The sensor acceleration.
    pub waveform: Waveform,
    /// Its amplitude spectrum.
    pub spectrum: Spectrum,
    /// The amplitude spectrum of its envelope; the band belongs in the label.
    pub envelope_spectrum: Spectrum,
    /// The same over orders of the shaft, where its speed varies: `df_hz` is then in orders.
    pub envelope_orders: Spectrum,
    /// The bearing's defect frequencies as orders, in `frequency_hz`.
    pub order_markers: Vec<Marker>,
    /// The bearing's defect frequencies.
    pub markers: Vec<Marker>,
}

/// The same bearing without its damage, drawn behind it in grey: values at the places of the run's own curves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Healthy {
    /// As `waveform.series`; this and the others empty where there is none.
    pub waveform: Vec<f64>,
    /// As `spectrum`.
    pub spectrum: Vec<f64>,
    /// As `envelope_spectrum`.
    pub envelope_spectrum: Vec<f64>,
    /// As `envelope_orders`.
    pub envelope_orders: Vec<f64>,
}

/// An evenly sampled signal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// The axis label without unit: "Outer ring acceleration, x (sensor)".
    pub label: String,
    /// Its unit: "m/s^2".
    pub unit: String,
    /// Time of the first sample.
    pub t0_s: f64,
    /// Sample interval.
    pub dt_s: f64,
    /// The samples.
    pub values: Vec<f64>,
}

/// Smallest and largest value in each of a row of equal time bins.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MinMax {
    /// Start of the first bin.
    pub t0_s: f64,
    /// Width of a bin.
    pub dt_s: f64,
    /// Smallest value of each bin.
    pub min: Vec<f64>,
    /// Largest value of each bin.
    pub max: Vec<f64>,
}

/// An instant to mark on the waveform.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// When.
    pub t_s: f64,
    /// Whether a roller enters a defect; it leaves one otherwise.
    pub enters: bool,
    /// Which roller, briefly: "1·07" for row 1, roller 7.
    pub label: String,
}

/// The sensor signal: a part of it sample by sample, all of it as an envelope.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Waveform {
    /// The part that is kept sample by sample, usually the end of the run (65 536 samples are plenty).
    pub series: Series,
    /// The whole run; without it the overview shows `series`.
    pub overview: Option<MinMax>,
    /// Rollers entering and leaving defects.
    pub events: Vec<Event>,
}

/// One-sided amplitude spectrum, first line at 0 Hz.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spectrum {
    /// What the amplitude is of, without unit: "Acceleration amplitude".
    pub label: String,
    /// Distance between lines.
    pub df_hz: f64,
    /// Amplitude of each line.
    pub amplitude: Vec<f64>,
    /// Unit of the amplitude.
    pub unit: String,
    /// How it was made: window, averages, demodulation band; may be empty.
    pub note: String,
}

/// A frequency to look for, with its harmonics.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// The field's name: "BPFO", "BPFI", "2 BSF", "FTF".
    pub label: String,
    /// What it is in words: "roller passes a point of the outer raceway".
    pub meaning: String,
    /// Where it lies.
    pub frequency_hz: f64,
    /// Where it would lie in pure rolling, if `frequency_hz` is what was found.
    pub pure_rolling_hz: Option<f64>,
    /// How many multiples to mark, the first included.
    pub harmonics: usize,
    /// Whether the scenario holds damage with impacts at this frequency.
    pub present: bool,
    /// Sidebands to mark: where each lies, and what it is.
    pub sidebands: Vec<(f64, String)>,
}

/// One roller on its way over a defect.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pass {
    /// Which roller, which defect.
    pub title: String,
    /// The damaged contact on the way.
    pub points: Vec<PassPoint>,
    /// Unit of its stiffness: "N/m^(10/9)".
    pub stiffness_unit: String,
    /// Which contact that is: "outer contact".
    pub contact: String,
}

/// Contact force of one row's rollers around the bearing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RowLoad {
    /// "Row 1, outer contact".
    pub title: String,
    /// Mean force of the rollers in each of equal bins around the circle, counter-clockwise from +X.
    pub mean_n: Vec<f64>,
    /// Largest force in each bin.
    pub max_n: Vec<f64>,
    /// Static equilibrium: one (angle in degrees, force in newtons) per roller.
    pub static_points: Vec<(f64, f64)>,
}

/// A value and its interval.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Low and high end of its interval, where there is one.
    pub interval: Option<(f64, f64)>,
    /// Its unit; empty where it has none.
    pub unit: String,
}

/// The indicators of one signal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct IndicatorRow {
    /// Channel name: "outer_ax".
    pub channel: String,
    /// "anti-aliased" or "instantaneous".
    pub kind: String,
    /// One for each column of the table.
    pub cells: Vec<Estimate>,
}

/// Indicators: signals down, kinds of indicator across.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct IndicatorTable {
    /// Column heads: "RMS", "Peak to peak", "Crest factor", "Kurtosis".
    pub columns: Vec<String>,
    /// The signals.
    pub rows: Vec<IndicatorRow>,
    /// What the intervals are: "in brackets 95 % intervals".
    pub note: String,
}
