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
mod rate;
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
#[doc(hidden)]
pub use frequencies::has_bore_in_mm;
pub use frequencies::{Component, DefectOrders, Measures, NAMED, NamedBearing, Wording, most_elements};
pub use json::to_json;
pub use levels::Levels;
pub use options::{MACHINE_NOISE, Options, SUPPLY_HZ, TOLERANCE};
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
use crate::{
    Band, Blocks, Estimate, Indicator, Kurtogram, Segments, Spectrum, Transformed, VelocityBands, kurtogram, psd,
};
use error::LARGEST;
use hypotheses::{Best, SpeedEvidence};
use severity::band_kurtosis;
use together::{Envelopes, Paced};
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
    analyze_records(&[(x, options.shaft)], fs, options)
}

/// Analyses several records of one machine by one sensor, each with the shaft's speed in it (Hz); a frequency of the
/// result is at the speed of the options. Each power spectrum is averaged over the records, in segments as long as the
/// shortest record allows. What one record alone can tell is that of the first: kurtogram, another sample rate, and
/// a drift of the speed where there is one record.
///
/// # Errors
/// As [`analyze`], of several [`AnalysisError::InRecord`]; where there is none, a speed is out of range, or
/// [`Options::rotation`] is given for several.
pub fn analyze_records(records: &[(&[f64], f64)], fs: f64, options: &Options) -> Result<Analysis, AnalysisError> {
    require(fs > 0.0 && fs.is_finite(), "sample rate (Hz)", fs, "above 0")?;
    let count = records.len();
    let most = if options.rotation.is_some() { 1 } else { usize::MAX };
    require((1..=most).contains(&count), "records", count as f64, "one or more, and one of a speed that is followed")?;
    options.check(records[0].0.len() as f64 / fs)?;
    let mut prepared = Vec::with_capacity(count);
    for (k, (x, speed)) in records.iter().enumerate() {
        prepared.push(Prepared::of(x, *speed, fs, options).map_err(|why| match count {
            1 => why,
            _ => AnalysisError::InRecord { number: k + 1, why: why.into() },
        })?);
    }
    let mut flaws: Vec<(usize, Flaw)> = Vec::new();
    for (k, record) in prepared.iter().enumerate() {
        flaws.extend(record.flaws.iter().map(|flaw| (k, *flaw)));
    }
    // What is missing has no speed.
    let whole = !(flaws.iter()).any(|(_, f)| matches!(f, Flaw::Held { .. }));
    let Told { map, evidence, transformed, other_rate } = tell(&prepared, fs, options, whole && count == 1)?;
    flaws.extend(other_rate.map(|(fits, lines)| (0, Flaw::OtherRate { fits, given: fs, lines })));
    let Best { mut record, envelopes, shaft_lines, drift, at_given } =
        hypotheses::best(&transformed, evidence, options)?;
    let view = view(&record, &envelopes, &transformed)?;
    let damaged = record.is_damage();
    // Several records, or one whose angle was followed, have no one rate.
    if let ([only], None) = (&prepared[..], &record.options.rotation) {
        for family in record.families.iter_mut().filter(|family| family.finding == Finding::Damage) {
            family.interval = rate::interval(&only.x, fs, view.band, family.frequency);
        }
    }
    let each: Vec<&[f64]> = prepared.iter().map(|r| &r.x[..]).collect();
    let silent = !damaged && !record.options.exact;
    let above = silent.then(|| Some((kurtosis_in(view.band, &each, fs, record.shaft)?, view.band.low))).flatten();
    let means: Vec<(Estimate, f64)> = (prepared.iter().zip(shares(&each)))
        .map(|(r, share)| (Estimate { value: r.mean, interval: None }, share))
        .collect();
    Ok(Analysis {
        sample_rate: fs,
        records: count,
        shortest: each.iter().map(|x| x.len()).min().unwrap_or(0) as f64 / fs,
        samples: each.iter().map(|x| x.len()).sum(),
        mean: Estimate::pooled(&means, 1).value,
        shaft: record.shaft,
        shaft_found: record.options.rotation.is_some() || !shaft_lines.is_empty(),
        shaft_lines,
        flaws,
        drift,
        // Over revolutions of the speed that is used.
        indicators: indicators(&each, fs / record.shaft),
        record_peak: each.iter().flat_map(|x| *x).fold(0.0, |m: f64, v| m.max(v.abs())),
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
        kurtosis_above: above,
        beside_damage: false,
        options: record.options,
    })
}

/// A record that can be analysed.
struct Prepared {
    /// Less its mean.
    x: Vec<f64>,
    mean: f64,
    /// The shaft's frequency in the analysis over that in the record.
    pace: f64,
    flaws: Vec<Flaw>,
}

impl Prepared {
    fn of(x: &[f64], speed: f64, fs: f64, options: &Options) -> Result<Self, AnalysisError> {
        require(speed > 0.0 && speed.is_finite(), "shaft speed (Hz)", speed, "above 0")?;
        let own = Options { shaft: speed, ..options.clone() };
        check(x, fs, &own)?;
        let repeats = repetition(x);
        let x = match repeats {
            None => x,
            // A stretch that is there again says nothing new, and its repetition has lines.
            Some(samples) => {
                let once = &x[..samples];
                check(once, fs, &own)?;
                once
            }
        };
        let mean = x.iter().sum::<f64>() / x.len() as f64;
        let x: Vec<f64> = x.iter().map(|v| v - mean).collect();
        let mut flaws = soundness::flaws(&x, fs, speed);
        flaws.extend(repeats.map(|samples| Flaw::Repeats { every: samples as f64 / fs }));
        Ok(Prepared { x, mean, pace: options.shaft / speed, flaws })
    }
}

/// What is taken from the samples themselves.
struct Told {
    map: Option<Kurtogram>,
    evidence: SpeedEvidence,
    transformed: Vec<Paced>,
    /// Sample rate at which lines would be the shaft's, Hz, and how many.
    other_rate: Option<(f64, usize)>,
}

/// All that asks for nothing but the samples, side by side; the speed's drift is sought where there is one record,
/// and that `whole`.
fn tell(records: &[Prepared], fs: f64, options: &Options, whole: bool) -> Result<Told, AnalysisError> {
    let first = &records[0].x;
    let may_drift = whole && options.rotation.is_none() && !options.exact;
    let part = &first[..first.len().min(LONGEST)];
    let map = || match options.band {
        Some(_) => Ok(None),
        None => kurtogram(part, fs, DEPTH).map(Some),
    };
    // Followed or exact, it is known: a fifth of BPFI is near the speed of many shafts.
    let is_known = options.rotation.is_some() || options.exact;
    let paced: Vec<(&[f64], f64)> = records.iter().map(|r| (&r.x[..], r.pace * fs)).collect();
    let lines = || if is_known { Ok(None) } else { known_lines::shaft(&paced, options) };
    let other_rate = || if is_known { Ok(None) } else { known_lines::other_rate(part, fs, options) };
    let drift = || may_drift.then(|| drift::by_shaft(first, fs, options))?;
    // As much as is transformed fast, with a trace of noise, and a machine's where a simulation has none.
    let noise = options.silent.unwrap_or(0.0);
    let one = |r: &Prepared| {
        let transformed = Transformed::of(&r.x[..fast_up_to(r.x.len())], fs)?;
        Ok((transformed.dithered(DITHER, noise), r.pace))
    };
    let transformed = || records.iter().map(one).collect::<Result<Vec<Paced>, AnalysisError>>();
    let rest = || join(other_rate, || join(drift, transformed));
    let (map, (lines, (other_rate, (drift, transformed)))) = join(map, || join(lines, rest));
    Ok(Told {
        map: map?,
        evidence: SpeedEvidence { lines: lines?, drift, may_drift },
        other_rate: other_rate?,
        transformed: transformed?,
    })
}

/// The envelope spectrum to show: of the band in which the family that leads is highest; of the whole range where
/// none leads.
fn view(record: &Record, envelopes: &Envelopes, records: &[Paced]) -> Result<View, AnalysisError> {
    let (shaft, options) = (record.shaft, &record.options);
    let seen = record
        .lead()
        .map(|lead| lead.harmonics.iter().filter(|h| h.snr_db.is_some()).map(|h| h.frequency).collect::<Vec<f64>>());
    // Without a bearing it is the comb that is asked about.
    let of_comb = || {
        let comb = record.elsewhere.filter(|_| options.orders.is_empty())?;
        Some((1..=HARMONICS).map(|k| k as f64 * comb.frequency).collect())
    };
    let (band, choice, (mean, spectrum)) = match (options.band, seen.or_else(of_comb)) {
        (None, Some(lines)) => {
            let (band, of_band) = &envelopes.each[record.together.clearest(lines.into_iter())];
            let spectrum = envelopes.spectrum(of_band, shaft, options)?;
            (*band, BandChoice::Clearest, spectrum)
        }
        (given, _) => {
            let choice = match given {
                Some(_) => BandChoice::Given,
                None if options.orders.is_empty() => BandChoice::OfUnknown,
                None => BandChoice::Broad,
            };
            let range = bands::range(records[0].0.sample_rate(), options)?;
            let spectrum = together::envelope_spectrum(records, range, shaft, options)?;
            (range, choice, spectrum)
        }
    };
    Ok(View { band, choice, spectrum, mean })
}

/// Kurtosis of what lies in a band, averaged over records by their length.
fn kurtosis_in(band: Band, records: &[&[f64]], fs: f64, shaft: f64) -> Option<f64> {
    let each = records.iter().zip(shares(records)).map(|(x, share)| Some((band_kurtosis(x, fs, band, shaft)?, share)));
    Some(Estimate::pooled(&each.collect::<Option<Vec<_>>>()?, 1).value)
}

/// Of records less their means, averaged over revolutions of `revolution` samples.
fn indicators(records: &[&[f64]], revolution: f64) -> Vec<(Indicator, Estimate)> {
    let blocks: Vec<Blocks> = records.iter().map(|x| Blocks::of(x, revolution)).collect();
    let of = |i: Indicator| {
        let each = blocks.iter().zip(shares(records)).map(|(b, share)| Some((b.estimate(i)?, share)));
        let exponent = if i == Indicator::Rms { 2 } else { 1 };
        Some((i, Estimate::pooled(&each.collect::<Option<Vec<_>>>()?, exponent)))
    };
    (Indicator::ALL.into_iter())
        .filter(|i| *i != Indicator::Mean && *i != Indicator::StandardDeviation)
        .filter_map(of)
        .collect()
}

/// Of each record in all samples.
fn shares(records: &[&[f64]]) -> Vec<f64> {
    let samples: usize = records.iter().map(|x| x.len()).sum();
    records.iter().map(|x| x.len() as f64 / samples as f64).collect()
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
    let one_way = |rising: bool| x.windows(2).all(|w| w[0] == w[1] || (w[0] < w[1]) == rising);
    if let Some(rises) = [true, false].into_iter().find(|rises| one_way(*rises)) {
        return Err(AnalysisError::OneWay(if rises { "rise" } else { "fall" }));
    }
    let all = options.orders.defect_frequencies();
    let highest = all.max_by(|a, b| a.2.total_cmp(&b.2)).map(|(_, name, _)| name);
    let (name, frequency) = (highest.unwrap_or("BPFI, where the bearing is not known,"), bands::highest(options));
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
