//! Lines that are nobody's damage: the shaft's harmonics and the mains'.

use super::{AnalysisError, Options};
use crate::signal::{Segments, Spectrum, harmonics, psd};

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
/// Bins to either side of a known line that are filled with the noise about it: Hann's main lobe.
const FILL: usize = 2;
/// A comb with fewer bins from line to line is left alone: filled, it would leave little of the spectrum.
const CLOSEST: f64 = 10.0;
/// Bins beyond the filled ones, to either side, whose median is that noise.
const AROUND: usize = 12;
/// A maximum within so many bins of a known line is that line.
const SAME: f64 = 0.6;
/// Powers over the median from which a maximum is a line: noise goes beyond in one of 500 (two degrees of freedom).
const STANDS: f64 = 9.0;

/// Shaft speed, Hz, by its own harmonics in the spectrum within the tolerance; as given where they do not stand.
pub(super) fn shaft(x: &[f64], fs: f64, options: &Options) -> Result<(f64, bool), AnalysisError> {
    // Bins a fortieth of the shaft's frequency apart: 2 % are then a bin or so at the first harmonics.
    let length = (40.0 * fs / options.shaft).max(256.0) as usize;
    let length = super::fast_length(length.min(x.len()));
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
    // The speed that most lines agree on to within a bin, then least squares of those.
    let agree = |f: f64| {
        mine.iter()
            .filter(move |(h, at)| (h * f - at).abs() <= step)
    };
    let best = (mine.iter().map(|(h, at)| at / h))
        .rev()
        .max_by_key(|f| agree(*f).count());
    let Some(best) = best.filter(|f| agree(*f).count() >= 2) else {
        return Ok((options.shaft, false));
    };
    let (above, below) = agree(best).fold((0.0, 0.0), |(a, b), (h, at)| (a + h * at, b + h * h));
    Ok((above / below, true))
}

/// Takes the lines of shaft and mains out of a spectrum, up to `top` Hz; the places where one stood. A comb counts only where
/// its first or second line stands: others would meet its places by coincidence.
pub(super) fn remove(spectrum: &mut Spectrum, shaft: f64, top: f64) -> Vec<f64> {
    let mut removed = Vec::new();
    let combs = Mains::ALL.map(Mains::frequency).into_iter().chain([shaft]);
    for fundamental in combs {
        let wide = fundamental >= CLOSEST * spectrum.frequency_step;
        let present = |k: f64| stands(spectrum, k * fundamental).is_some();
        if !wide || !(present(1.0) || present(2.0)) {
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
    removed
}

/// Fills a line at a frequency with the noise about it; whether there was one.
fn fill(spectrum: &mut Spectrum, frequency: f64) -> bool {
    let Some((bin, median)) = stands(spectrum, frequency) else {
        return false;
    };
    let first = bin.saturating_sub(FILL).max(1);
    spectrum.amplitude[first..=bin + FILL].fill(median.sqrt());
    true
}

/// The bin of a line at a frequency and the noise about it (power), where there is one.
fn stands(spectrum: &Spectrum, frequency: f64) -> Option<(usize, f64)> {
    let a = &spectrum.amplitude;
    let at = frequency / spectrum.frequency_step;
    let bin = at.round() as usize;
    if bin < 2 || bin + FILL + AROUND + 1 >= a.len() {
        return None;
    }
    let peak = (bin - 1..=bin + 1).max_by(|i, j| a[*i].total_cmp(&a[*j]))?;
    if a[peak] < a[peak - 1] || a[peak] < a[peak + 1] {
        return None;
    }
    // Parabola through the logarithms, as Hann's main lobe nearly is.
    let ln = |i: usize| a[i].max(f64::MIN_POSITIVE).ln();
    let (l, c, r) = (ln(peak - 1), ln(peak), ln(peak + 1));
    let bend = l - 2.0 * c + r;
    let shift = if bend < 0.0 {
        0.5 * (l - r) / bend
    } else {
        0.0
    };
    let mut around: Vec<f64> = (bin.saturating_sub(FILL + AROUND)..bin.saturating_sub(FILL))
        .chain(bin + FILL + 1..=bin + FILL + AROUND)
        .map(|i| a[i] * a[i])
        .collect();
    let middle = around.len() / 2;
    let median = *around.select_nth_unstable_by(middle, f64::total_cmp).1;
    let is_line = (peak as f64 + shift - at).abs() <= SAME && a[peak] * a[peak] >= STANDS * median;
    is_line.then_some((bin, median))
}
