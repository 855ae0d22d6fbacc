//! What one source accounts for: its lines taken out of a spectrum, and whose lines another's may be.

use super::super::error::{SignalError, require};
use super::super::lines::Floor;
use super::super::spectrum::Spectrum;
use super::{CLOSEST_SIDEBAND, DiagnosisOptions, Evidence, LINE_LEVEL, RANGE, REACH, mark};

/// Lines closer than this, in bins, are one.
const SAME_LINE: f64 = 1.5;
/// Orders of harmonics and sidebands to which a comb is followed when it comes to whose a line may be.
const FARTHEST_ORDER: i32 = 20;
/// Lines are explained where they would lie on the combs by chance less often than this.
const COINCIDENCE: f64 = 0.05;
/// Order of the sidebands to which a candidate accounts for lines.
const FARTHEST_SIDEBAND: f64 = 5.0;

/// Says of those that stand whose lines theirs may be.
pub(super) fn explain(
    evidence: &mut [Evidence],
    ranking: &[usize],
    spectrum: &Spectrum,
    options: &DiagnosisOptions,
) {
    let (step, bins) = (spectrum.frequency_step, spectrum.amplitude.len());
    // Harmonics alone cover little and so explain more; then with sidebands.
    let combs: [Vec<Vec<bool>>; 2] = [false, true].map(|wide| {
        let of = |i: &usize| comb(&evidence[*i], spectrum, options, wide);
        ranking.iter().map(of).collect()
    });
    for (rank, &i) in ranking.iter().enumerate() {
        let mine: Vec<usize> = (evidence[i].harmonics.standing(LINE_LEVEL))
            .chain(evidence[i].carrying())
            .map(|l| ((l.frequency / step).round() as usize).min(bins - 1))
            .collect();
        let held = |marks: &[bool]| mine.iter().filter(|bin| marks[**bin]).count();
        let others = (ranking.iter().zip(&combs[1])).map(|(j, marks)| (*j, held(marks)));
        let alternatives = others.filter(|(j, held)| *j != i && *held > 0).collect();
        let end = mine.iter().max().map_or(0, |bin| bin + 1);
        let explained = combs.iter().find_map(|combs| {
            let better = (0..rank)
                .filter(|r| evidence[ranking[*r]].explained_by.is_empty() && held(&combs[*r]) > 0);
            let by: Vec<usize> = better.collect();
            let marked = |bin: usize| by.iter().any(|r| combs[*r][bin]);
            let covered = (0..end).filter(|bin| marked(*bin)).count() as f64 / end.max(1) as f64;
            let unlikely = covered.powi(mine.len() as i32) <= COINCIDENCE;
            (unlikely && mine.iter().all(|bin| marked(*bin)))
                .then(|| by.iter().map(|r| ranking[*r]).collect())
        });
        evidence[i].alternatives = alternatives;
        evidence[i].explained_by = explained.unwrap_or_default();
    }
}

/// The bins that a candidate's comb may fill, its sidebands among them if `wide`.
fn comb(
    evidence: &Evidence,
    spectrum: &Spectrum,
    options: &DiagnosisOptions,
    wide: bool,
) -> Vec<bool> {
    let mut marks = vec![false; spectrum.amplitude.len()];
    let mut line =
        |frequency: f64| mark(&mut marks, frequency / spectrum.frequency_step, SAME_LINE);
    (1..=FARTHEST_ORDER).for_each(|h| line(f64::from(h) * evidence.frequency));
    let sidebands = evidence.sidebands.as_ref();
    if let Some(sidebands) = sidebands.filter(|s| wide && s.false_alarm <= options.level) {
        for h in 0..=options.harmonics {
            for m in -FARTHEST_ORDER..=FARTHEST_ORDER {
                line(h as f64 * evidence.frequency + f64::from(m) * sidebands.spacing);
            }
        }
    }
    marks
}

/// A spectrum without what damage at a frequency accounts for: lines on its harmonics and on their sidebands, spaced as any
/// of `spacings` (all Hz), brought down to the noise about them. What is left speaks for others.
///
/// # Errors
/// [`SignalError::OutOfRange`] where the frequency is not positive or the spectrum has fewer than 27 bins.
pub fn without(
    spectrum: &Spectrum,
    frequency: f64,
    spacings: &[f64],
) -> Result<Spectrum, SignalError> {
    require(
        frequency > 0.0 && frequency.is_finite(),
        "frequency (Hz)",
        frequency,
        "above 0",
    )?;
    let floor = Floor::within(spectrum, RANGE)?;
    let step = spectrum.frequency_step;
    let mut left = spectrum.clone();
    let top = step * spectrum.amplitude.len() as f64;
    let wide: Vec<f64> = (spacings.iter().copied())
        .filter(|s| *s >= CLOSEST_SIDEBAND * step)
        .collect();
    let farthest = FARTHEST_SIDEBAND * wide.iter().fold(0.0, |m: f64, s| m.max(*s));
    let mut place = |frequency: f64| {
        let middle = frequency / step;
        let first = (middle - REACH).ceil().max(1.0) as usize;
        let last = ((middle + REACH).floor().max(0.0) as usize).min(left.amplitude.len() - 2);
        if first > last {
            return;
        }
        let level = floor.level(first, last);
        for bin in first..=last {
            let limit = level.power.sqrt();
            left.amplitude[bin] = left.amplitude[bin].min(limit);
        }
    };
    let mut h = 0.0;
    while h * frequency < top + farthest {
        let carrier = h * frequency;
        if h > 0.0 {
            place(carrier);
        }
        for spacing in &wide {
            for m in 1..=FARTHEST_SIDEBAND as i32 {
                place(carrier + f64::from(m) * spacing);
                place(carrier - f64::from(m) * spacing);
            }
        }
        h += 1.0;
    }
    Ok(left)
}
