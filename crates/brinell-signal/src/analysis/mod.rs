//! Analysis of one vibration signal: samples in, a verdict with its evidence out.
//!
//! The chain is that of R. B. Randall and J. Antoni, "Rolling element bearing diagnostics - a tutorial", Mech. Syst.
//! Signal Process. 25 (2011) 485-520: the mean is removed, the range above three times the highest defect frequency is
//! demodulated in one to two dozen bands, and their envelope spectra are averaged over their noise floors. In the
//! average each defect frequency is sought with its harmonics and sidebands, all of one slip: a [`Family`]. Line
//! present, source identified and damage likely are three statements; [`Finding`] says which holds. Lines of the
//! shaft's harmonics and of 50 and 60 Hz mains are set aside.
//!
//! Nothing here knows files. Times are s, frequencies Hz, amplitudes the signal's unit.
//!
//! The [crate] shows how to use it.

mod bands;
mod baseline;
mod compare;
mod drift;
mod elsewhere;
mod error;
mod family;
mod frequencies;
mod hypotheses;
mod json;
mod known_lines;
mod levels;
mod options;
mod recorded;
mod result;
mod running_median;
mod sensitivity;
mod severity;
mod soundness;
mod spacing;
mod together;
mod unit;
mod verdict;
mod words;

pub use bands::BandChoice;
pub use compare::{Comparison, Difference, LineDifference, Side, compare};
pub use drift::Drift;
pub use elsewhere::Elsewhere;
pub use error::{AnalysisError, FEWEST_REVOLUTIONS};
pub use family::{Family, Finding, Harmonic, Sidebands};
pub use frequencies::{Component, DefectOrders, Measures, NAMED, NamedBearing, Wording, most_elements};
pub use json::to_json;
pub use levels::Levels;
pub use options::{MACHINE_NOISE, Options, SUPPLY_HZ};
pub use recorded::{
    Called, Given, NoUnit, Numbers, Scaled, beyond_full_scale, once, other_bearing, other_speed, unit_of,
};
pub use result::{Analysis, Unexplained, Verdict, View};
pub use sensitivity::{FullScale, Sensitivity};
pub use severity::{BandLevel, MachineClass, NoVelocity, NoZone, SEVERITY_BAND, Zone, band_level, severity};
pub use soundness::{Flaw, repetition};
pub use together::HARMONICS;
pub use unit::{Quantity, STANDARD_GRAVITY, Unit};
pub use words::{COLUMNS, HEADLINES, indicator_words, level_words};

use crate::error::require;
use crate::lengths::fast_up_to;
use crate::parallel::join;
use crate::{Blocks, Estimate, Indicator, Kurtogram, Segments, Spectrum, Transformed, VelocityBands, kurtogram, psd};
use error::LARGEST;
use hypotheses::{Best, SpeedEvidence};
use together::Envelopes;
use verdict::Record;

/// Noise over the signal's RMS that is added to it: the last bit of an ADC of 32.
const DITHER: f64 = 1.0 / 4_294_967_296.0;
/// Halvings of the kurtogram.
const DEPTH: usize = 6;
/// Longest part of a signal that the kurtogram and other sample rates are looked at in, samples: it takes no more.
const LONGEST: usize = 1 << 18;

/// Analyses `x`, sampled at `fs` Hz.
///
/// # Errors
/// [`AnalysisError`] where a sample is not finite, the signal, or the stretch that it repeats, is constant or shorter
/// than [`FEWEST_REVOLUTIONS`] revolutions, or sampled too slowly for the defect frequencies, or an option is out of range.
pub fn analyze(x: &[f64], fs: f64, options: &Options) -> Result<Analysis, AnalysisError> {
    require(fs > 0.0 && fs.is_finite(), "sample rate (Hz)", fs, "above 0")?;
    options.check(x.len() as f64 / fs)?;
    check(x, fs, options)?;
    let repeats = repetition(x);
    let x = match repeats {
        None => x,
        // A stretch that is there again says nothing new, and its repetition has lines.
        Some(samples) => {
            let once = &x[..samples];
            check(once, fs, options)?;
            once
        }
    };
    let mean = x.iter().sum::<f64>() / x.len() as f64;
    let x: Vec<f64> = x.iter().map(|v| v - mean).collect();
    let mut flaws = soundness::flaws(&x, fs, options.shaft);
    flaws.extend(repeats.map(|samples| Flaw::Repeats { every: samples as f64 / fs }));
    // What is missing has no speed.
    let whole = !(flaws.iter()).any(|f| matches!(f, Flaw::Held { .. }));
    let Prepared { map, evidence, transformed, other_rate } = prepare(&x, fs, options, whole)?;
    flaws.extend(other_rate.map(|(fits, lines)| Flaw::OtherRate { fits, given: fs, lines }));
    let samples = x.len();
    let record_peak = x.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let Best { record, envelopes, shaft_lines, drift, at_given } = hypotheses::best(&transformed, evidence, options)?;
    let view = view(&record, &envelopes, &transformed)?;
    let damaged = record.is_damage();
    Ok(Analysis {
        sample_rate: fs,
        samples,
        mean,
        shaft: record.shaft,
        shaft_found: record.options.rotation.is_some() || !shaft_lines.is_empty(),
        shaft_lines,
        flaws,
        drift,
        // Over revolutions of the speed that is used.
        indicators: indicators(&x, fs / record.shaft),
        record_peak,
        kurtogram: (map.as_ref()).and_then(|m| m.best(bands::NARROWEST * bands::highest(options))),
        map,
        view,
        bands: record.together.bands(),
        families: record.families,
        at_given: at_given.filter(|_| !damaged),
        elsewhere: record.elsewhere,
        passing_known: false,
        level_growth: None,
        level_range: None,
        kurtosis_beside: None,
        beside_damage: false,
        options: record.options,
    })
}

/// What is taken from the samples themselves.
struct Prepared {
    map: Option<Kurtogram>,
    evidence: SpeedEvidence,
    transformed: Transformed,
    /// Sample rate at which lines would be the shaft's, Hz, and how many.
    other_rate: Option<(f64, usize)>,
}

/// All that asks for nothing but the samples, side by side; the speed's drift is sought where the record is `whole`.
fn prepare(x: &[f64], fs: f64, options: &Options, whole: bool) -> Result<Prepared, AnalysisError> {
    let may_drift = whole && options.rotation.is_none() && !options.exact;
    let part = &x[..x.len().min(LONGEST)];
    let map = || match options.band {
        Some(_) => Ok(None),
        None => kurtogram(part, fs, DEPTH).map(Some),
    };
    // Followed or exact, it is known: a fifth of BPFI is near the speed of many shafts.
    let is_known = options.rotation.is_some() || options.exact;
    let lines = || if is_known { Ok(None) } else { known_lines::shaft(x, fs, options) };
    let other_rate = || if is_known { Ok(None) } else { known_lines::other_rate(part, fs, options) };
    let drift = || may_drift.then(|| drift::by_shaft(x, fs, options))?;
    // As much as is transformed fast, with a trace of noise, and a machine's where a simulation has none.
    let noise = options.silent.unwrap_or(0.0);
    let transformed = || Transformed::of(&x[..fast_up_to(x.len())], fs);
    let rest = || join(other_rate, || join(drift, transformed));
    let (map, (lines, (other_rate, (drift, transformed)))) = join(map, || join(lines, rest));
    Ok(Prepared {
        map: map?,
        evidence: SpeedEvidence { lines: lines?, drift, may_drift },
        other_rate: other_rate?,
        transformed: transformed?.dithered(DITHER, noise),
    })
}

/// The envelope spectrum to show: of the band in which the family that leads is highest; of the whole range where
/// none leads.
fn view(record: &Record, envelopes: &Envelopes, transformed: &Transformed) -> Result<View, AnalysisError> {
    let (shaft, options) = (record.shaft, &record.options);
    let (band, choice, (mean, spectrum)) = match (options.band, record.lead()) {
        (None, Some(lead)) => {
            let lines = lead.harmonics.iter().filter(|h| h.snr_db.is_some()).map(|h| h.frequency);
            let (band, envelope) = &envelopes.each[record.together.clearest(lines)];
            let spectrum = envelopes.spectrum(envelope, shaft, options)?;
            (*band, BandChoice::Clearest, spectrum)
        }
        (given, _) => {
            let choice = match given {
                Some(_) => BandChoice::Given,
                None => BandChoice::Broad,
            };
            let range = bands::range(transformed.sample_rate(), options)?;
            let spectrum = together::envelope_spectrum(transformed, range, shaft, options)?;
            (range, choice, spectrum)
        }
    };
    Ok(View { band, choice, spectrum, mean })
}

/// Of a signal less its mean, averaged over revolutions of `revolution` samples.
fn indicators(x: &[f64], revolution: f64) -> Vec<(Indicator, Estimate)> {
    let blocks = Blocks::of(x, revolution);
    (Indicator::ALL.into_iter())
        .filter(|i| *i != Indicator::Mean && *i != Indicator::StandardDeviation)
        .filter_map(|i| Some((i, blocks.estimate(i)?)))
        .collect()
}

/// Amplitude spectrum of `x` less its mean, sampled at `fs` Hz, averaged: lines about 1 Hz apart, eight averages where
/// the signal is long enough. No verdict rests on it.
///
/// # Errors
/// As [`crate::psd()`].
pub fn shown_spectrum(x: &[f64], fs: f64) -> Result<Spectrum, AnalysisError> {
    let wanted = (fs as usize).clamp(256, 1 << 16);
    let length = fast_up_to(wanted.min((x.len() / 4).max(256)));
    let mean = x.iter().sum::<f64>() / x.len() as f64;
    let x: Vec<f64> = x.iter().map(|v| v - mean).collect();
    Ok(psd(&x, fs, &Segments::of(length))?)
}

/// RMS velocity in the bands of ISO 15242, m/s, of an acceleration in m/s^2 sampled at `fs` Hz; see
/// [`crate::velocity_bands()`] for what differs from a measurement by the standard.
///
/// # Errors
/// As [`crate::velocity_bands()`].
pub fn velocity(x: &[f64], fs: f64, shaft: f64) -> Result<VelocityBands, AnalysisError> {
    use crate::velocity_bands::NOMINAL;
    Ok(crate::velocity_bands(x, fs, &NOMINAL, 1.0 / shaft)?)
}

fn check(x: &[f64], fs: f64, options: &Options) -> Result<(), AnalysisError> {
    let missing = x.iter().filter(|v| !v.is_finite()).count();
    if let Some(first) = x.iter().position(|v| !v.is_finite()) {
        return Err(AnalysisError::NotFinite { count: missing, samples: x.len(), first: first + 1 });
    }
    let largest = x.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    if largest > LARGEST || largest > 0.0 && largest < 1.0 / LARGEST {
        return Err(AnalysisError::Scale { largest });
    }
    if let Some(&value) = x.first()
        && x.iter().all(|v| *v == value)
    {
        return Err(AnalysisError::Constant { samples: x.len(), value });
    }
    let all = options.orders.defect_frequencies();
    let Some((_, name, highest)) = all.max_by(|a, b| a.2.total_cmp(&b.2)) else {
        return Err(AnalysisError::NoFrequencies);
    };
    let frequency = highest * options.shaft;
    // Below: a band to demodulate that is twice as wide as the second harmonic, above three times the frequency.
    let needed = 2.0 * (bands::BROAD + bands::NARROWEST) * frequency;
    if fs < needed {
        return Err(AnalysisError::RateTooLow { rate_hz: fs, name, frequency_hz: frequency, needed_hz: needed });
    }
    let seconds = x.len() as f64 / fs;
    let revolutions = seconds * options.shaft;
    if revolutions < FEWEST_REVOLUTIONS {
        return Err(AnalysisError::TooShort { seconds, revolutions, needed_s: FEWEST_REVOLUTIONS / options.shaft });
    }
    Ok(())
}
