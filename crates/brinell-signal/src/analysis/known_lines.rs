//! Lines that are nobody's damage: the mains', and the shaft's, which tell its speed.

use super::together::HARMONICS;
use super::{AnalysisError, Options};
use crate::lengths::fast_up_to;
use crate::{Segments, harmonics, psd};

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
/// Bins by which a line that stands may miss a multiple of the speed: its peak is told to a fraction of a bin. With a
/// whole bin, any line within the tolerance would agree with any other.
const AGREE: f64 = 0.5;

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
pub(super) fn shaft(x: &[f64], fs: f64, options: &Options) -> Result<Option<ShaftLines>, AnalysisError> {
    // Bins a fortieth of the shaft's frequency apart: 2 % are then a bin or so at the first harmonics.
    let length = (40.0 * fs / options.shaft).max(256.0) as usize;
    let length = fast_up_to(length.min(x.len()));
    let spectrum = psd(x, fs, &Segments::of(length))?;
    let step = spectrum.frequency_step;
    let reach = options.tolerance * options.shaft;
    let lines = harmonics(&spectrum, options.shaft, reach, HARMONICS)?;
    // On the skirt of a line farther off the spectrum rises to the end of what was searched, and beyond.
    let is_top = |f: f64| {
        let bin = (f / step).round() as usize;
        let around = spectrum.amplitude.get(bin.saturating_sub(2)..bin + 3);
        around.is_some_and(|a| a[1..4].iter().any(|v| *v >= a[0].max(a[4])))
    };
    // What the mains could have made says nothing of the shaft.
    let mine: Vec<(f64, f64)> = (lines.standing(SHAFT_LEVEL))
        .filter(|l| !near_mains(l.frequency, 2.0 * step) && is_top(l.frequency))
        .map(|l| (f64::from(l.order), l.frequency))
        .collect();
    // The speed that most lines agree on, then least squares of those.
    let agree = |f: f64| mine.iter().filter(move |(h, at)| (h * f - at).abs() <= AGREE * step);
    let best = (mine.iter().map(|(h, at)| at / h)).rev().max_by_key(|f| agree(*f).count());
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
    Ok(Some(ShaftLines { speed: above / below, orders: agree(best).map(|(h, _)| *h as usize).collect() }))
}

/// Whether a harmonic of the mains lies within `width` (Hz) of a frequency.
pub(super) fn near_mains(f: f64, width: f64) -> bool {
    let off = |mains: f64| (f - (f / mains).round() * mains).abs();
    Mains::ALL.iter().any(|m| off(m.frequency()) < width)
}

fn divisor(a: i32, b: i32) -> i32 {
    if b == 0 { a } else { divisor(b, a % b) }
}
