//! One signal over another: how their indicators, spectra and defect lines differ.

use super::bands::{NARROWEST, highest, range};
use super::together::HARMONICS;
use super::{Analysis, AnalysisError};
use crate::integrate::{band_pass, fade};
use crate::{Band, Estimate, Indicator, Segments, Spectrum, envelope, harmonics, psd};
use serde::Serialize;

/// Half sample rates that differ by less, relative, hold one range.
const ONE_RATE: f64 = 0.01;

/// A quantity of both signals.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// What it is: an indicator's name.
    pub indicator: Indicator,
    /// Of the first signal.
    pub first: f64,
    /// Of the second.
    pub second: f64,
    /// Whether their 95 % intervals are apart; `None` where one has none.
    pub apart: Option<bool>,
}

/// One harmonic of a defect frequency in both envelope spectra.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LineDifference {
    /// Name of the frequency: `BPFO`.
    pub name: &'static str,
    /// Order of the harmonic.
    pub order: i32,
    /// Frequency in the first and in the second, Hz.
    #[serde(rename = "frequency_hz")]
    pub frequency: [f64; 2],
    /// Amplitude over the envelope's mean.
    pub modulation: [f64; 2],
    /// Power over the noise about it, dB.
    pub snr_db: [f64; 2],
}

/// Both signals side by side, in one unit and on one frequency axis.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// Indicators, of what lies in [`Comparison::range`].
    pub indicators: Vec<Difference>,
    /// What both hold, where that is not all of both, or the band given.
    pub range: Option<Band>,
    /// Amplitude spectra with lines equally far apart, up to the lower of the two half sample rates.
    pub spectra: [Spectrum; 2],
    /// Envelope spectra of one band.
    pub envelopes: [Spectrum; 2],
    /// The band, Hz.
    pub band: (f64, f64),
    /// Harmonics of the defect frequencies.
    pub lines: Vec<LineDifference>,
    /// Mean and root mean square difference of the spectra's levels, first over second, dB, over third octaves from 10 Hz
    /// up that lie below both half sample rates, each of equal weight whatever its level.
    pub level_db: (f64, f64),
}

/// A signal with its analysis.
#[derive(Debug, Clone, Copy)]
pub struct Side<'a> {
    /// Samples, in the unit of both.
    pub x: &'a [f64],
    /// What was found in it.
    pub analysis: &'a Analysis,
}

impl Side<'_> {
    /// That these can be the samples that were analysed.
    pub(super) fn check(&self) -> Result<(), AnalysisError> {
        let need = self.analysis.samples;
        Ok(crate::error::check(self.x, self.analysis.sample_rate, need, "the analysis of them")?)
    }
}

/// Lays `second` over `first`, in the band that shows most in the first, as far as both sample rates hold it. Where the
/// lower one does not, and the user gave no band, it is everything above three times the highest defect frequency.
///
/// # Errors
/// [`AnalysisError`] where the lower sample rate does not hold the band, a signal is too short for a spectrum, or its samples
/// are fewer than were analysed.
pub fn compare(first: Side, second: Side) -> Result<Comparison, AnalysisError> {
    let sides = [first, second];
    sides.iter().try_for_each(Side::check)?;
    let rates = sides.map(|s| s.analysis.sample_rate);
    let top = 0.5 * rates[0].min(rates[1]);
    let band = common_band(first.analysis, top)?;
    let shortest = sides.map(|s| s.analysis.duration()).into_iter().fold(f64::INFINITY, f64::min);
    let step = (4.0 / shortest).max(1.0);
    let view = &first.analysis.view;
    let envelope_step = (1.0 / shortest).max(view.spectrum.frequency_step);
    let lines_top = view.spectrum.frequency_step * view.spectrum.amplitude.len() as f64;
    let [a, b] = sides.map(|s| one(s, step, top, band, envelope_step, lines_top));
    let ((sa, ea, ma), (sb, eb, mb)) = (a?, b?);
    let spectra = [sa, sb];
    let envelopes = [ea, eb];
    let lines = lines(&sides, &envelopes, &[ma, mb])?;
    let range = common_range(first.analysis, second.analysis);
    Ok(Comparison {
        indicators: indicators(&sides, range),
        range,
        level_db: level(&spectra),
        spectra,
        envelopes,
        band: (band.low, band.high),
        lines,
    })
}

/// The first one's band, or another, up to `top` (Hz).
fn common_band(first: &Analysis, top: f64) -> Result<Band, AnalysisError> {
    let shown = first.view.band;
    let bands = match first.options.band {
        Some(_) => vec![shown],
        None => vec![shown, range(2.0 * top, &first.options)?],
    };
    let mut cut = bands.into_iter().map(|band| Band::between(band.low, band.high.min(top)));
    let least = NARROWEST * highest(&first.options);
    cut.find(|band| band.high - band.low >= least.min(shown.high - shown.low)).ok_or_else(|| {
        let range = "well below half of both sample rates; give a lower band that both hold";
        super::error::out_of_range("lower edge of the band (Hz)", shown.low, range)
    })
}

fn one(
    side: Side,
    step: f64,
    top: f64,
    band: Band,
    envelope_step: f64,
    envelope_top: f64,
) -> Result<(Spectrum, Spectrum, f64), AnalysisError> {
    let fs = side.analysis.sample_rate;
    let x: Vec<f64> = side.x.iter().map(|v| v - side.analysis.mean).collect();
    let length = |step: f64| ((fs / step).round() as usize).clamp(64, x.len().max(64));
    let mut spectrum = psd(&x, fs, &Segments::of(length(step)))?;
    spectrum.amplitude.truncate((top / spectrum.frequency_step) as usize + 1);
    let mut e = envelope(&x, fs, band)?;
    let mean = e.iter().sum::<f64>() / e.len().max(1) as f64;
    e.iter_mut().for_each(|v| *v -= mean);
    let mut of_envelope = psd(&e, fs, &Segments::of(length(envelope_step)))?;
    let bins = (envelope_top / of_envelope.frequency_step) as usize + 1;
    of_envelope.amplitude.truncate(bins.max(64));
    Ok((spectrum, of_envelope, mean))
}

/// What two signals both hold, where that is not all of both: up to the lower half sample rate, in the band given. A
/// level of one record is none of the other's where its sensor hears farther.
pub(super) fn common_range(first: &Analysis, second: &Analysis) -> Option<Band> {
    let tops = [first, second].map(|a| 0.5 * a.sample_rate);
    let top = tops[0].min(tops[1]);
    match first.options.band {
        Some(band) => Some(Band::between(band.low, band.high.min(top))),
        None => ((tops[0] / tops[1] - 1.0).abs() > ONE_RATE).then(|| Band::between(0.0, top)),
    }
}

/// The indicators of what lies in a range, where there is one; else those of the whole.
pub(super) fn indicators_in(range: Option<Band>, side: Side) -> Vec<(Indicator, Estimate)> {
    let fs = side.analysis.sample_rate;
    let inside = |range: Band| {
        let mut x: Vec<f64> = side.x.iter().map(|v| v - side.analysis.mean).collect();
        // From the first bin up the whole is periodic enough: what its ends add is little beside it.
        let lowest = fs / x.len() as f64;
        let end = if range.low > lowest { fade(&mut x, fs, range.low) } else { 0 };
        let x = band_pass(&x, fs, Band::between(range.low.max(lowest), range.high)).ok()?;
        // As often as the other is sampled: between its samples peaks are missed.
        let each = (0.5 * fs / range.high).floor().max(1.0);
        let x: Vec<f64> = x[end..x.len() - end].iter().copied().step_by(each as usize).collect();
        Some(super::indicators(&[&x], fs / each / side.analysis.shaft))
    };
    range.and_then(inside).unwrap_or_else(|| side.analysis.indicators.clone())
}

fn indicators(sides: &[Side; 2], range: Option<Band>) -> Vec<Difference> {
    let all = sides.map(|side| indicators_in(range, side));
    let [first, second] = [0, 1].map(|k| {
        let these = &all[k];
        move |wanted: Indicator| these.iter().find(|(i, _)| *i == wanted).map(|found| found.1)
    });
    (Indicator::ALL.into_iter())
        .filter_map(|i| {
            let (a, b) = (first(i)?, second(i)?);
            let apart = (a.interval.zip(b.interval)).map(|(a, b)| a.high < b.low || b.high < a.low);
            Some(Difference { indicator: i, first: a.value, second: b.value, apart })
        })
        .collect()
}

fn lines(sides: &[Side; 2], envelopes: &[Spectrum; 2], means: &[f64; 2]) -> Result<Vec<LineDifference>, AnalysisError> {
    let mut all = Vec::new();
    let options = &sides[0].analysis.options;
    for (_, name, order) in options.orders.defect_frequencies().filter(|s| s.1 != "BSF") {
        let mut sets = Vec::new();
        for (side, spectrum) in sides.iter().zip(envelopes) {
            let analysis = side.analysis;
            // Where its comb is highest, or where pure rolling has it.
            let found = analysis.families.iter().find(|f| f.name == name);
            let place = (found.filter(|f| f.detected_harmonics() > 0)).map_or(order * analysis.shaft, |f| f.frequency);
            sets.push(harmonics(spectrum, place, 0.005 * place, HARMONICS)?);
        }
        for (a, b) in sets[0].iter().zip(&sets[1]) {
            if a.order == b.order {
                all.push(LineDifference {
                    name,
                    order: a.order,
                    frequency: [a.frequency, b.frequency],
                    modulation: [a.amplitude / means[0], b.amplitude / means[1]],
                    snr_db: [a.snr_db, b.snr_db],
                });
            }
        }
    }
    Ok(all)
}

/// Mean and RMS difference of levels over third octaves from 10 Hz up.
fn level(spectra: &[Spectrum; 2]) -> (f64, f64) {
    let top = spectra.iter().map(|s| s.frequency_step * s.amplitude.len() as f64).fold(f64::INFINITY, f64::min);
    let (mut low, mut count, mut sum, mut squares) = (10.0, 0.0f64, 0.0, 0.0);
    let third = 2f64.powf(1.0 / 3.0);
    while low * third < top {
        let [a, b] = [0, 1].map(|i| spectra[i].band_rms(low, low * third));
        if a > 0.0 && b > 0.0 {
            let db = 20.0 * (a / b).log10();
            (count, sum, squares) = (count + 1.0, sum + db, squares + db * db);
        }
        low *= third;
    }
    let count = count.max(1.0);
    (sum / count, (squares / count).sqrt())
}
