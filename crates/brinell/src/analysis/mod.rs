//! Analysis of one vibration signal: samples in, a verdict with its evidence out.
//!
//! The chain is that of R. B. Randall and J. Antoni, "Rolling element bearing diagnostics - a tutorial", Mech. Syst. Signal
//! Process. 25 (2011) 485-520: the mean is removed, several bands are demodulated (the most impulsive one by the fast
//! kurtogram, everything above three times the highest defect frequency, and a tiling by octaves), and each envelope
//! spectrum is searched for every defect frequency within the slip's tolerance, with harmonics and sidebands
//! ([`crate::signal::diagnosis`]), at two resolutions: jitter smears lines that a fine one would lose.
//!
//! Lines of the shaft's harmonics and of 50 and 60 Hz mains are taken out of the envelope spectrum before it is searched, so
//! that nobody's damage is made of them. Every search is one more chance for noise, so the level is shared among them
//! (Bonferroni): for noise whose spectrum is smooth, the chance that *any* damage is reported is at most [`Options::level`].
//!
//! Nothing here knows files. Times are s, frequencies Hz, amplitudes the signal's unit.
//!
//! ```
//! use brinell::analysis::{NamedBearing, Options, analyze};
//!
//! let fs = 12_000.0;
//! let bearing = NamedBearing::find("6205-2RS").unwrap().orders();
//! // Impacts on the outer race, 3.585 a revolution at 30 Hz, ringing at 3 kHz.
//! let x: Vec<f64> = (0..24_000)
//!     .map(|i| {
//!         let since = (f64::from(i) / fs) % (1.0 / (3.585 * 30.0));
//!         (-since / 4e-4).exp() * (6.283 * 3000.0 * since).sin() + 1e-3 * f64::from(i * 7919 % 101)
//!     })
//!     .collect();
//! let analysis = analyze(&x, fs, &Options::new(30.0, bearing)).unwrap();
//! assert_eq!(analysis.causes().next().unwrap().name, "BPFO");
//! ```

mod bands;
mod beyond;
mod compare;
mod error;
mod family;
mod frequencies;
mod json;
mod known_lines;
mod sensitivity;
mod severity;
mod unit;
mod verdict;
mod view;
mod words;

pub use bands::{BandChoice, ChosenBand};
pub use beyond::Beyond;
pub use compare::{Comparison, Difference, LineDifference, Side, compare};
pub use error::{AnalysisError, FEWEST_REVOLUTIONS};
pub use family::Family;
pub use frequencies::{Component, DefectOrders, NAMED, NamedBearing};
pub use json::to_json;
pub use known_lines::Mains;
pub use sensitivity::{FullScale, Sensitivity};
pub use severity::{
    BandLevel, MachineClass, NoVelocity, NoZone, SEVERITY_BAND, Zone, band_level, severity,
};
pub use unit::{Quantity, Unit};
pub use verdict::{Finding, Strength};
pub use view::View;

use crate::signal::lengths::fast_up_to;
use crate::signal::{
    Band, Blocks, Estimate, Indicator, Kurtogram, KurtogramBand, Rotation, Segments, Spectrum,
    VelocityBands, psd,
};
use std::thread::{self, ScopedJoinHandle};

/// What is known beside the samples, and how sure to be.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Shaft speed, Hz.
    pub shaft: f64,
    /// Defect frequencies over the shaft's.
    pub orders: DefectOrders,
    /// How far slip and an inexact speed may move a defect frequency, relative; 0.02 unless told.
    pub tolerance: f64,
    /// The band to demodulate; `None` searches for it.
    pub band: Option<Band>,
    /// Chance at most that noise alone is called damage; 0.01 unless told.
    pub level: f64,
    /// Harmonics of each defect frequency that are searched; 5 unless told.
    pub harmonics: usize,
    /// The shaft's angle over time, where its speed varies: envelopes are then taken at equal angles, and a frequency in Hz is
    /// its order times `shaft`, the mean speed. Time counts from the first sample.
    pub rotation: Option<Rotation>,
    /// Whether the signal is a simulation's without a sensor's noise: healthy rollers that enter the load are then heard too.
    pub silent: bool,
}

impl Options {
    /// With the usual tolerance, level and harmonics, for a measured signal.
    pub fn new(shaft: f64, orders: DefectOrders) -> Self {
        Options {
            shaft,
            orders,
            tolerance: 0.02,
            band: None,
            level: 0.01,
            harmonics: 5,
            rotation: None,
            silent: false,
        }
    }
}

/// Fourth powers of larger values, and of the inverse of smaller ones, leave a double's range.
const LARGEST: f64 = 1e60;

/// How well the shaft's own lines tell its speed, relative.
const SHAFT_KNOWN: f64 = 0.002;

/// Everything that was found.
#[derive(Debug, Clone)]
pub struct Analysis {
    /// What was asked.
    pub options: Options,
    /// Sample rate, Hz.
    pub sample_rate: f64,
    /// Samples analysed.
    pub samples: usize,
    /// Mean that was removed.
    pub mean: f64,
    /// Shaft speed, Hz, as refined from lines at its harmonics, or as given.
    pub shaft: f64,
    /// Whether it is known: from lines of the signal, or as it was followed.
    pub shaft_found: bool,
    /// Harmonics of the shaft whose lines told its speed; none where it was given or followed.
    pub shaft_lines: Vec<usize>,
    /// Indicators of the signal less its mean over whole revolutions, with intervals; peaks are those of a revolution.
    pub indicators: Vec<(Indicator, Estimate)>,
    /// The most impulsive band, where there is one.
    pub kurtogram: Option<KurtogramBand>,
    /// The kurtogram it was found in, unless the band was given.
    pub map: Option<Kurtogram>,
    /// Every envelope spectrum that was searched.
    pub views: Vec<View>,
    /// The one that shows most, by index.
    pub best: usize,
    /// Each defect frequency with its harmonics, over all bands together.
    pub families: Vec<Family>,
    /// What stands out, the strongest first; empty where nothing does.
    pub findings: Vec<Finding>,
    /// Where no damage is called: lines farther from a defect frequency than the tolerance, if any stand.
    pub beyond: Option<Beyond>,
}

impl Analysis {
    /// Findings that are called damage and that no stronger one explains, the strongest first.
    pub fn causes(&self) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(|f| f.is_cause())
    }

    /// The verdict in plain words.
    pub fn verdict(&self) -> String {
        words::verdict(self)
    }

    /// The envelope spectrum that shows most.
    pub fn view(&self) -> &View {
        &self.views[self.best]
    }

    /// Length of what was analysed, s.
    pub fn duration(&self) -> f64 {
        self.samples as f64 / self.sample_rate
    }
}

/// Analyses `x`, sampled at `fs` Hz.
///
/// # Errors
/// [`AnalysisError`] where a sample is not finite, the signal is constant, shorter than [`FEWEST_REVOLUTIONS`] revolutions, or
/// sampled too slowly for the defect frequencies, or an option is out of range.
pub fn analyze(x: &[f64], fs: f64, options: &Options) -> Result<Analysis, AnalysisError> {
    check(x, fs, options)?;
    let mean = x.iter().sum::<f64>() / x.len() as f64;
    let x: Vec<f64> = x.iter().map(|v| v - mean).collect();
    // What asks for nothing but the samples goes side by side.
    let (indicators, choice, shaft, transformed) = thread::scope(|scope| {
        let indicators = scope.spawn(|| indicators(&x, fs / options.shaft));
        let choice = scope.spawn(|| bands::choose(&x, fs, options));
        let shaft = scope.spawn(|| match options.rotation {
            // Followed, it is known.
            Some(_) => Ok(None),
            None => known_lines::shaft(&x, fs, options),
        });
        let transformed = view::transformed(&x, fs);
        (done(indicators), done(choice), done(shaft), transformed)
    });
    let choice = choice?;
    let (shaft, shaft_lines) = match shaft? {
        Some(found) => (found.speed, found.orders),
        None => (options.shaft, Vec::new()),
    };
    let shaft_found = options.rotation.is_some() || !shaft_lines.is_empty();
    let transformed = transformed?;
    let samples = x.len();
    drop(x);
    // Half a bin of the finest spectrum, or as far as the speed may be off.
    let known = view::Shaft {
        hz: shaft,
        tolerance: if shaft_found {
            (0.5 * fs / samples as f64).max(SHAFT_KNOWN * shaft)
        } else {
            options.tolerance * shaft
        },
    };
    let families = family::families(&transformed, known, options)?;
    let views = view::all(transformed, known, &choice.bands, options)?;
    // Half the main lobe of a Hann window over the whole record.
    let resolution = 2.0 * fs / samples as f64;
    let (findings, best) = verdict::find(&views, shaft, resolution, &families, options)?;
    let beyond = match findings.iter().any(Finding::is_cause) {
        true => None,
        false => beyond::find(&views, shaft, options)?,
    };
    Ok(Analysis {
        options: options.clone(),
        sample_rate: fs,
        samples,
        mean,
        shaft,
        shaft_found,
        shaft_lines,
        indicators,
        kurtogram: choice.best,
        map: choice.map,
        views,
        best,
        families: families.all,
        findings,
        beyond,
    })
}

/// Of a signal less its mean, averaged over revolutions of `revolution` samples.
fn indicators(x: &[f64], revolution: f64) -> Vec<(Indicator, Estimate)> {
    let blocks = Blocks::of(x, revolution);
    (Indicator::ALL.into_iter())
        .filter(|i| *i != Indicator::Mean && *i != Indicator::StandardDeviation)
        .filter_map(|i| Some((i, blocks.estimate(i)?)))
        .collect()
}

/// What a thread came to; its panic goes on here.
fn done<T>(thread: ScopedJoinHandle<T>) -> T {
    (thread.join()).unwrap_or_else(|panic| std::panic::resume_unwind(panic))
}

/// Amplitude spectrum of `x` less its mean, sampled at `fs` Hz, averaged: lines about 1 Hz apart, eight averages where the signal is long
/// enough. No verdict rests on it.
///
/// # Errors
/// As [`crate::signal::psd()`].
pub fn shown_spectrum(x: &[f64], fs: f64) -> Result<Spectrum, AnalysisError> {
    let wanted = (fs as usize).clamp(256, 1 << 16);
    let length = fast_up_to(wanted.min((x.len() / 4).max(256)));
    let mean = x.iter().sum::<f64>() / x.len() as f64;
    let x: Vec<f64> = x.iter().map(|v| v - mean).collect();
    Ok(psd(&x, fs, &Segments::of(length))?)
}

/// RMS velocity in the bands of ISO 15242, m/s, of an acceleration in m/s^2 sampled at `fs` Hz; see
/// [`crate::signal::velocity_bands()`] for what differs from a measurement by the standard.
///
/// # Errors
/// As [`crate::signal::velocity_bands()`].
pub fn velocity(x: &[f64], fs: f64, shaft: f64) -> Result<VelocityBands, AnalysisError> {
    use crate::signal::velocity_bands::NOMINAL;
    Ok(crate::signal::velocity_bands(x, fs, &NOMINAL, 1.0 / shaft)?)
}

fn check(x: &[f64], fs: f64, options: &Options) -> Result<(), AnalysisError> {
    let positive = |name, value: f64| match value > 0.0 && value.is_finite() {
        true => Ok(()),
        false => Err(out_of_range(name, value, "above 0")),
    };
    positive("sample rate (Hz)", fs)?;
    positive("shaft speed (Hz)", options.shaft)?;
    if !(options.tolerance > 0.0 && options.tolerance <= 0.1) {
        let range = "above 0 to 0.1";
        return Err(out_of_range("tolerance", options.tolerance, range));
    }
    let missing = x.iter().filter(|v| !v.is_finite()).count();
    if let Some(first) = x.iter().position(|v| !v.is_finite()) {
        return Err(AnalysisError::NotFinite {
            count: missing,
            samples: x.len(),
            first: first + 1,
        });
    }
    let largest = x.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    if largest > LARGEST || largest > 0.0 && largest < 1.0 / LARGEST {
        return Err(AnalysisError::Scale { largest });
    }
    if let Some(&value) = x.first()
        && x.iter().all(|v| *v == value)
    {
        return Err(AnalysisError::Constant {
            samples: x.len(),
            value,
        });
    }
    let strikes = || options.orders.strikes();
    for (_, name, order) in strikes() {
        positive(name, order)?;
    }
    let Some((_, name, highest)) = strikes().max_by(|a, b| a.2.total_cmp(&b.2)) else {
        return Err(AnalysisError::NoFrequencies);
    };
    let frequency = highest * options.shaft;
    // Below: a band to demodulate that is twice as wide as the second harmonic, above three times the frequency.
    let needed = 2.0 * (bands::BROAD + bands::NARROWEST) * frequency;
    if fs < needed {
        return Err(AnalysisError::RateTooLow {
            rate_hz: fs,
            name,
            frequency_hz: frequency,
            needed_hz: needed,
        });
    }
    let seconds = x.len() as f64 / fs;
    let revolutions = seconds * options.shaft;
    if revolutions < FEWEST_REVOLUTIONS {
        return Err(AnalysisError::TooShort {
            seconds,
            revolutions,
            needed_s: FEWEST_REVOLUTIONS / options.shaft,
        });
    }
    Ok(())
}

fn out_of_range(name: &'static str, value: f64, range: &'static str) -> AnalysisError {
    crate::signal::SignalError::OutOfRange { name, value, range }.into()
}
