//! Lines that are nobody's damage: the shaft's harmonics and the mains'.

use super::verdict::LINE_LEVEL;
use super::{AnalysisError, Options};
use crate::signal::lengths::fast_up_to;
use crate::signal::{Candidate, DiagnosisOptions, Segments, Spectrum, diagnose, harmonics, psd};

/// A mains frequency.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mains {
    /// 50 Hz.
    Hz50,
    /// 60 Hz.
    Hz60,
}

impl Mains {
    /// Both.
    pub const ALL: [Mains; 2] = [Mains::Hz50, Mains::Hz60];

    /// Hz.
    pub fn frequency(self) -> f64 {
        match self {
            Mains::Hz50 => 50.0,
            Mains::Hz60 => 60.0,
        }
    }
}

/// Chance under noise at which a line of the shaft counts as found.
const SHAFT_LEVEL: f64 = 1e-4;
/// Bins by which a line that stands may miss a multiple of the speed: its peak is told to a fraction of a bin. With a whole bin, any line
/// within the tolerance would agree with any other.
const AGREE: f64 = 0.5;
/// Bins to either side of a known line that are filled with the noise about it: Hann's main lobe.
const FILL: f64 = 2.0;
/// A comb with fewer bins from line to line is left alone: filled, it would leave little of the spectrum.
const CLOSEST: f64 = 10.0;
/// Bins beyond the filled ones, to either side, whose median is that noise.
const AROUND: usize = 12;
/// Lines of a comb that are looked for.
const FAMILY: usize = 10;
/// Chance under noise at which a comb counts as standing.
const FAMILY_LEVEL: f64 = 1e-3;
/// A shaft whose speed is known to within this share may show any of its lines. The mains' frequency is known as well, but a
/// defect frequency near a multiple of 50 or 60 Hz must not pass for theirs.
const KNOWN: f64 = 0.0025;
/// How far the mains wander from their nominal frequency, relative, with the logger's clock.
const MAINS_WANDERS: f64 = 0.002;

/// A shaft's speed by lines at its harmonics.
pub(super) struct ShaftLines {
    /// Hz.
    pub(super) speed: f64,
    /// Which harmonics: two or more.
    pub(super) orders: Vec<usize>,
}

/// Shaft speed by its own harmonics in the spectrum within the tolerance; `None` where they do not stand.
///
/// Another shaft's lines within the tolerance look the same: nothing in the signal tells the two apart.
pub(super) fn shaft(
    x: &[f64],
    fs: f64,
    options: &Options,
) -> Result<Option<ShaftLines>, AnalysisError> {
    // Bins a fortieth of the shaft's frequency apart: 2 % are then a bin or so at the first harmonics.
    let length = (40.0 * fs / options.shaft).max(256.0) as usize;
    let length = fast_up_to(length.min(x.len()));
    let spectrum = psd(x, fs, &Segments::of(length))?;
    let step = spectrum.frequency_step;
    let reach = options.tolerance * options.shaft;
    let lines = harmonics(&spectrum, options.shaft, reach, options.harmonics)?;
    // What the mains could have made says nothing of the shaft.
    let near_mains = |f: f64| {
        let off = |mains: f64| (f - (f / mains).round() * mains).abs();
        Mains::ALL.iter().any(|m| off(m.frequency()) < 2.0 * step)
    };
    let mine: Vec<(f64, f64)> = (lines.standing(SHAFT_LEVEL))
        .filter(|l| !near_mains(l.frequency))
        .map(|l| (f64::from(l.order), l.frequency))
        .collect();
    // The speed that most lines agree on, then least squares of those.
    let agree = |f: f64| {
        mine.iter()
            .filter(move |(h, at)| (h * f - at).abs() <= AGREE * step)
    };
    let best = (mine.iter().map(|(h, at)| at / h))
        .rev()
        .max_by_key(|f| agree(*f).count());
    // Every third of the shaft's may be an outer race's.
    let own = |f: f64| {
        let orders = || agree(f).map(|(h, _)| *h as i32);
        let common = orders().fold(0, divisor);
        orders().count() >= 2 && orders().any(|o| o <= 2) && common <= 2
    };
    let Some(best) = best.filter(|f| own(*f)) else {
        return Ok(None);
    };
    let (above, below) = agree(best).fold((0.0, 0.0), |(a, b), (h, at)| (a + h * at, b + h * h));
    Ok(Some(ShaftLines {
        speed: above / below,
        orders: agree(best).map(|(h, _)| *h as usize).collect(),
    }))
}

/// The combs of shaft and mains that stand in any of several spectra, Hz: what modulates one band modulates others, if more
/// faintly. The shaft is sought within `tolerance` of `shaft` (Hz).
pub(super) fn combs(
    spectra: &[Spectrum],
    shaft: f64,
    tolerance: f64,
) -> Result<Vec<f64>, AnalysisError> {
    let sought = (Mains::ALL.map(|m| (m.frequency(), MAINS_WANDERS * m.frequency(), false)))
        .into_iter()
        .chain([(shaft, tolerance, tolerance <= KNOWN * shaft)]);
    let mut combs = Vec::new();
    for (fundamental, tolerance, known) in sought {
        let mut best: Option<(f64, f64)> = None;
        for spectrum in spectra {
            if fundamental < CLOSEST * spectrum.frequency_step {
                continue;
            }
            if let Some((chance, at)) = family(spectrum, fundamental, tolerance, known)?
                && best.is_none_or(|b| chance < b.0)
            {
                best = Some((chance, at));
            }
        }
        let enough = FAMILY_LEVEL / spectra.len() as f64;
        combs.extend(best.filter(|b| b.0 <= enough).map(|b| b.1));
    }
    Ok(combs)
}

/// Takes combs out of a spectrum, up to `top` Hz; the places taken.
pub(super) fn remove(spectrum: &mut Spectrum, combs: &[f64], top: f64) -> Vec<f64> {
    let mut removed = Vec::new();
    for fundamental in combs {
        if *fundamental < CLOSEST * spectrum.frequency_step {
            continue;
        }
        let mut k = 1.0;
        while k * fundamental < top {
            if fill(spectrum, k * fundamental) {
                removed.push(k * fundamental);
            }
            k += 1.0;
        }
    }
    removed.sort_by(f64::total_cmp);
    removed
}

/// Chance and frequency of a comb that stands; where its frequency is not `known`, with its first or second line, and not
/// merely as every third of another's.
fn family(
    spectrum: &Spectrum,
    fundamental: f64,
    tolerance: f64,
    known: bool,
) -> Result<Option<(f64, f64)>, AnalysisError> {
    let candidate = Candidate {
        name: String::new(),
        frequency: fundamental,
        tolerance,
        sideband_spacing: None,
    };
    let options = DiagnosisOptions {
        harmonics: FAMILY,
        sidebands: 0,
        level: FAMILY_LEVEL,
        rival: 0.0,
    };
    let found = diagnose(spectrum, &[candidate], &options)?;
    let evidence = &found.evidence[0];
    let orders: Vec<i32> = (evidence.harmonics.standing(LINE_LEVEL))
        .map(|l| l.order)
        .collect();
    let common = orders.iter().fold(0, |a, b| divisor(a, *b));
    let own = known || orders.first().is_some_and(|o| *o <= 2) && common <= 2;
    Ok((evidence.stands && own).then_some((evidence.false_alarm, evidence.frequency)))
}

fn divisor(a: i32, b: i32) -> i32 {
    if b == 0 { a } else { divisor(b, a % b) }
}

/// Fills the place of a line with the noise about it; `false` beyond the spectrum.
fn fill(spectrum: &mut Spectrum, frequency: f64) -> bool {
    let a = &spectrum.amplitude;
    let at = frequency / spectrum.frequency_step;
    let first = (at - FILL).ceil().max(1.0) as usize;
    let last = (at + FILL).floor() as usize;
    if last + AROUND + 1 >= a.len() {
        return false;
    }
    let mut around: Vec<f64> = (first.saturating_sub(AROUND)..first)
        .chain(last + 1..=last + AROUND)
        .map(|i| a[i])
        .collect();
    let middle = around.len() / 2;
    let median = *around.select_nth_unstable_by(middle, f64::total_cmp).1;
    for value in &mut spectrum.amplitude[first..=last] {
        *value = value.min(median);
    }
    true
}
