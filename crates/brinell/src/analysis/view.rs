//! One band, one resolution: an envelope spectrum and what stands in it.

use super::bands::ChosenBand;
use super::frequencies::Component;
use super::known_lines;
use super::{AnalysisError, Options, fast_length};
use crate::signal::{
    Candidate, Diagnosis, DiagnosisOptions, Segments, Spectrum, diagnose, envelope, psd,
};

/// Bins from one line of the cage to the next, at the coarse and at the fine resolution.
const RESOLUTIONS: [f64; 2] = [8.0, 40.0];
/// The envelope is sampled so many times as often as its highest line sought.
const ENVELOPE_RATE: f64 = 8.0;
/// Part of the gap between two defect frequencies that a search for either covers.
const CLEAR: f64 = 0.4;
/// FTF over the shaft's frequency where nobody said.
const USUAL_FTF: f64 = 0.4;

/// An envelope spectrum and its diagnosis.
#[derive(Debug, Clone)]
pub struct View {
    /// The band demodulated.
    pub band: ChosenBand,
    /// Envelope spectrum as it is, up to where lines were sought; peak amplitudes in the signal's unit.
    pub spectrum: Spectrum,
    /// Mean of the envelope, in the signal's unit.
    pub mean: f64,
    /// Lines of shaft and mains that were taken out before the search, Hz.
    pub removed: Vec<f64>,
    /// What stands, among the candidates of `candidates`, in their order.
    pub diagnosis: Diagnosis,
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
fn top(shaft: f64, options: &Options) -> f64 {
    let highest = (options.orders.strikes()).fold(0.0, |m: f64, s| m.max(s.2));
    highest * shaft * (options.harmonics as f64 + 0.5) * (1.0 + options.tolerance)
}

/// Every band at every resolution that the signal's length allows; two bands at a time.
pub(super) fn all(
    x: &[f64],
    fs: f64,
    shaft: f64,
    bands: &[ChosenBand],
    options: &Options,
) -> Result<Vec<View>, AnalysisError> {
    let cage = options.orders.ftf.unwrap_or(USUAL_FTF) * shaft;
    let x = &x[..fast_length(x.len())];
    let factor = ((fs / (ENVELOPE_RATE * top(shaft, options))).floor() as usize).max(1);
    let rate = fs / factor as f64;
    let longest = x.len() / factor;
    let mut lengths: Vec<usize> = (RESOLUTIONS.iter())
        .map(|r| fast_length(((r * rate / cage) as usize).clamp(64, longest.max(64))))
        .collect();
    lengths.dedup();
    let tests = (bands.len() * lengths.len()) as f64;
    let one = |band: &ChosenBand| view(x, fs, shaft, *band, factor, &lengths, tests, options);
    let middle = bands.len().div_ceil(2);
    let (first, second) = bands.split_at(middle);
    let (first, second) = std::thread::scope(|scope| {
        let other = scope.spawn(|| second.iter().map(one).collect::<Result<Vec<_>, _>>());
        let mine = first.iter().map(one).collect::<Result<Vec<_>, _>>();
        (mine, other.join())
    });
    let second = second.unwrap_or_else(|panic| std::panic::resume_unwind(panic))?;
    Ok(first?.into_iter().chain(second).flatten().collect())
}

#[allow(clippy::too_many_arguments)]
fn view(
    x: &[f64],
    fs: f64,
    shaft: f64,
    band: ChosenBand,
    factor: usize,
    lengths: &[usize],
    tests: f64,
    options: &Options,
) -> Result<Vec<View>, AnalysisError> {
    let full = envelope(x, fs, band.band).unwrap_or_default();
    let mean = full.iter().sum::<f64>() / full.len().max(1) as f64;
    // The mean of `factor` neighbours is filter enough: what folds back is noise, and the floor is measured with it.
    let coarse: Vec<f64> = (full.chunks_exact(factor))
        .map(|part| part.iter().sum::<f64>() / factor as f64 - mean)
        .collect();
    let top = top(shaft, options);
    let candidates: Vec<Candidate> = (candidates(shaft, options).into_iter())
        .map(|c| c.2)
        .collect();
    let rate = fs / factor as f64;
    let mut views = Vec::new();
    for length in lengths {
        let mut spectrum = psd(&coarse, rate, &Segments::of(*length))?;
        let bins = (top / spectrum.frequency_step) as usize + 64;
        spectrum.amplitude.truncate(bins);
        spectrum.density.truncate(bins);
        let mut searched = spectrum.clone();
        let removed = known_lines::remove(&mut searched, shaft, top);
        let diagnosis = diagnose(
            &searched,
            &candidates,
            &DiagnosisOptions {
                harmonics: options.harmonics,
                sidebands: 2,
                level: options.level / tests,
            },
        )?;
        views.push(View {
            band,
            spectrum,
            mean,
            removed,
            diagnosis,
        });
    }
    Ok(views)
}
