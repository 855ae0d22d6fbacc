//! One band, one resolution: an envelope spectrum and what stands in it.

use super::bands::{BandChoice, ChosenBand};
use super::frequencies::Component;
use super::known_lines;
use super::{AnalysisError, Options};
use crate::many;
use crate::signal::lengths::fast_up_to;
use crate::signal::{
    Candidate, Diagnosis, DiagnosisOptions, Segments, Spectrum, Thinned, Transformed,
    diagnose_beside, psd, resample,
};

/// Bins from one line of the cage to the next, at the coarse and at the fine resolution.
const RESOLUTIONS: [f64; 2] = [8.0, 40.0];
/// The envelope is sampled so many times as often as its highest line sought.
const ENVELOPE_RATE: f64 = 8.0;
/// Part of the gap between two defect frequencies that a search for either covers.
const CLEAR: f64 = 0.4;
/// Noise over the signal's RMS that is added to it: the last bit of a converter of 32.
const DITHER: f64 = 1.0 / 4_294_967_296.0;
/// Lines this far below a defect frequency's strongest, in power, do not put it in doubt: a simulation without noise is full of them.
const RIVAL: f64 = 1e-2;
/// FTF over the shaft's frequency where nobody said.
pub(super) const USUAL_FTF: f64 = 0.4;

/// An envelope spectrum and its diagnosis.
#[derive(Debug, Clone)]
pub struct View {
    /// The band demodulated.
    pub band: ChosenBand,
    /// Envelope spectrum as it is, up to where lines were sought; peak amplitudes in the signal's unit.
    pub spectrum: Spectrum,
    /// The same less the lines of shaft and mains: what was searched.
    pub(super) searched: Spectrum,
    /// Mean of the envelope, in the signal's unit.
    pub mean: f64,
    /// Lines of shaft and mains that were taken out before the search, Hz.
    pub removed: Vec<f64>,
    /// What stands, among the candidates of `candidates`, in their order.
    pub diagnosis: Diagnosis,
}

/// Shaft speed and how far its lines may lie from it, both Hz.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shaft {
    pub(super) hz: f64,
    pub(super) tolerance: f64,
}

/// What is looked for: a candidate for each strike of the bearing.
pub(super) fn candidates(
    shaft: f64,
    options: &Options,
) -> Vec<(Component, &'static str, Candidate)> {
    let cage = options.orders.ftf.map(|o| o * shaft);
    // Two frequencies closer than their tolerances are each searched on their own side.
    let nearest = |order: f64| {
        (options.orders.strikes())
            .map(|s| (s.2 - order).abs())
            .filter(|gap| *gap > 0.0)
            .fold(f64::INFINITY, f64::min)
    };
    (options.orders.strikes())
        .map(|(component, name, order)| {
            let frequency = order * shaft;
            let candidate = Candidate {
                name: name.into(),
                frequency,
                tolerance: (options.tolerance * frequency).min(CLEAR * nearest(order) * shaft),
                sideband_spacing: match component {
                    Component::InnerRace => Some(shaft),
                    Component::Element => cage,
                    Component::OuterRace | Component::Cage => None,
                },
            };
            (component, name, candidate)
        })
        .collect()
}

/// Highest frequency looked at in an envelope spectrum, Hz.
pub(super) fn top(shaft: f64, options: &Options) -> f64 {
    let highest = (options.orders.strikes()).fold(0.0, |m: f64, s| m.max(s.2));
    highest * shaft * (options.harmonics as f64 + 0.5) * (1.0 + options.tolerance)
}

/// How every spectrum is searched, if so many are.
pub(super) fn looking(options: &Options, tests: f64) -> DiagnosisOptions {
    DiagnosisOptions {
        harmonics: options.harmonics,
        sidebands: 2,
        level: options.level / tests,
        rival: RIVAL,
    }
}

/// The transform of as much of a signal, sampled at `fs` Hz, as is transformed fast, with a trace of noise.
pub(super) fn transformed(x: &[f64], fs: f64) -> Result<Transformed, AnalysisError> {
    Ok(Transformed::of(&x[..fast_up_to(x.len())], fs)?.dithered(DITHER))
}

/// Every band at every resolution that the signal's length allows.
pub(super) fn all(
    transformed: Transformed,
    shaft: Shaft,
    bands: &[ChosenBand],
    options: &Options,
) -> Result<Vec<View>, AnalysisError> {
    let fs = transformed.sample_rate();
    let cage = options.orders.ftf.unwrap_or(USUAL_FTF) * shaft.hz;
    let samples = transformed.samples();
    let count = envelope_samples(&transformed, top(shaft.hz, options));
    let rate = fs * count as f64 / samples as f64;
    let mut lengths: Vec<usize> = (RESOLUTIONS.iter())
        .map(|r| fast_up_to(((r * rate / cage) as usize).clamp(64, count.max(64))))
        .collect();
    lengths.dedup();
    let parts = side_by_side(bands, |band| {
        spectra(&transformed, *band, count, &lengths, shaft.hz, options)
    })?;
    drop(transformed);
    let plain: Vec<(ChosenBand, f64, Spectrum)> = parts.into_iter().flatten().collect();
    let only: Vec<Spectrum> = plain.iter().map(|p| p.2.clone()).collect();
    let combs = known_lines::combs(&only, shaft.hz, shaft.tolerance)?;
    let tests = plain.len() as f64;
    side_by_side(&plain, |part| {
        search(part, &combs, shaft.hz, tests, options)
    })
}

/// A job for each, as many at a time as there are cores; results in the order of what they are of.
pub(super) fn side_by_side<T: Sync, R: Send>(
    of: &[T],
    one: impl Fn(&T) -> Result<R, AnalysisError> + Sync,
) -> Result<Vec<R>, AnalysisError> {
    let mut results: Vec<_> = of.iter().map(|_| None).collect();
    many::each(
        of.len(),
        many::threads(of.len()),
        |k| one(&of[k]),
        |k, result| results[k] = Some(result),
    );
    results.into_iter().flatten().collect()
}

/// How often an envelope is taken, for lines up to `top` (Hz).
pub(super) fn envelope_samples(transformed: &Transformed, top: f64) -> usize {
    let samples = transformed.samples();
    let factor = ((transformed.sample_rate() / (ENVELOPE_RATE * top)).floor() as usize).max(1);
    fast_up_to((samples / factor).max(64.min(samples)))
}

/// An envelope less its mean, at equal angles of the shaft where its speed varies; and the rate that it is then sampled at, Hz.
pub(super) fn at_angles(
    envelope: Thinned,
    transformed: &Transformed,
    shaft: f64,
    options: &Options,
) -> Result<(Vec<f64>, f64), AnalysisError> {
    let mut values = envelope.values;
    values.iter_mut().for_each(|v| *v -= envelope.mean);
    let rate = transformed.sample_rate() * values.len() as f64 / transformed.samples() as f64;
    let Some(rotation) = &options.rotation else {
        return Ok((values, rate));
    };
    let per_turn = (rate / shaft).round().max(4.0) as usize;
    let values = resample(&values, rate, rotation, per_turn)?.values;
    Ok((values, per_turn as f64 * shaft))
}

/// The envelope spectra of a band, with the envelope's mean.
fn spectra(
    transformed: &Transformed,
    band: ChosenBand,
    count: usize,
    lengths: &[usize],
    shaft: f64,
    options: &Options,
) -> Result<Vec<(ChosenBand, f64, Spectrum)>, AnalysisError> {
    // Triangles over two stretches are filter enough: of the envelope as it is taken, what folds back onto the highest line sought has been
    // brought down by 34 dB.
    let envelope = match band.choice {
        BandChoice::Whitened => transformed.whitened_envelope(band.band, count),
        _ => transformed.envelope(band.band, count),
    };
    let mean = envelope.mean;
    let (coarse, rate) = at_angles(envelope, transformed, shaft, options)?;
    let top = top(shaft, options);
    let of = |length: &usize| {
        let mut spectrum = psd(&coarse, rate, &Segments::of(*length))?;
        let bins = (top / spectrum.frequency_step) as usize + 64;
        spectrum.amplitude.truncate(bins);
        spectrum.density.truncate(bins);
        Ok((band, mean, spectrum))
    };
    lengths.iter().map(of).collect()
}

fn search(
    (band, mean, spectrum): &(ChosenBand, f64, Spectrum),
    combs: &[f64],
    shaft: f64,
    tests: f64,
    options: &Options,
) -> Result<View, AnalysisError> {
    let mut searched = spectrum.clone();
    let removed = known_lines::remove(&mut searched, combs, top(shaft, options));
    let sought: Vec<Candidate> = (candidates(shaft, options).into_iter())
        .map(|c| c.2)
        .collect();
    let diagnosis = diagnose_beside(&searched, &sought, &looking(options, tests), &removed)?;
    Ok(View {
        band: *band,
        spectrum: spectrum.clone(),
        searched,
        mean: *mean,
        removed,
        diagnosis,
    })
}
