//! Lines that are nobody's damage: the mains', and the shaft's, which tell its speed.

use super::together::{FLOOR, HARMONICS, REVOLUTIONS, running_median};
use super::{AnalysisError, Options};
use crate::distribution::chi_square_quantile;
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
/// Bins by which a detected line may miss a multiple of the speed: its peak is told to a fraction of a bin. With a
/// whole bin, any line within the tolerance would agree with any other.
const AGREE: f64 = 0.5;
/// Harmonics of a comb beyond the tolerance.
const OF_COMB: usize = 10;
/// How far off it may lie, relative: where the speed given is a tenth too low, the shaft's lies a ninth above it.
const FARTHEST: f64 = 0.12;
/// Lines that it has at least.
const FEWEST: usize = 4;
/// What a line counts for at most, ln(power over floor): otherwise one that many places share would decide. The comb
/// has so much more than any within the tolerance.
const LINE: f64 = 4.0;
/// Bins that the tolerance spans at the fundamental; in a shorter record combs are not told apart.
const TELLING: f64 = 0.5;

/// A shaft's speed by lines at its harmonics.
pub(super) struct ShaftLines {
    /// Hz.
    pub(super) speed: f64,
    /// Which harmonics: two or more.
    pub(super) orders: Vec<usize>,
}

/// Shaft speed by its own harmonics in the spectrum, within the tolerance or, where none are detected there, [`beyond`];
/// `None` where they do not.
///
/// Another shaft's lines there look the same: nothing in the signal tells the two apart.
pub(super) fn shaft(x: &[f64], fs: f64, options: &Options) -> Result<Option<ShaftLines>, AnalysisError> {
    match within(x, fs, options)? {
        None if !options.exact => beyond(x, fs, options),
        found => Ok(found),
    }
}

/// The highest comb, where it lies beyond the tolerance and far more of it is detected than of any within: the speed given
/// is then wrong.
fn beyond(x: &[f64], fs: f64, options: &Options) -> Result<Option<ShaftLines>, AnalysisError> {
    let shaft = options.shaft;
    let length = fast_up_to(((REVOLUTIONS * fs / shaft) as usize).min(x.len()));
    if options.tolerance * shaft < TELLING * fs / length as f64 {
        return Ok(None);
    }
    let mut spectrum = psd(x, fs, &Segments::of(length))?;
    let step = spectrum.frequency_step;
    spectrum.amplitude.truncate(((OF_COMB + 1) as f64 * (1.0 + FARTHEST) * shaft / step) as usize);
    let power: Vec<f64> = spectrum.amplitude.iter().map(|a| a * a).collect();
    let floor = running_median(&power, (FLOOR.0 * shaft / step).max(FLOOR.1) as usize);
    let quantile = |p: f64| chi_square_quantile(p, spectrum.degrees_of_freedom) / spectrum.degrees_of_freedom;
    let (median, detected) = (quantile(0.5), quantile(1.0 - SHAFT_LEVEL).ln());
    let others = |f: f64| {
        let off = |f0: f64| (f - (f / f0).round() * f0).abs() < 2.0 * step;
        near_mains(f, 2.0 * step) || options.supply.is_some_and(off)
    };
    let height = |(bin, (power, floor)): (usize, (&f64, f64))| match others(bin as f64 * step) {
        true => 0.0,
        false => (median * power / floor.max(f64::MIN_POSITIVE)).max(1.0).ln(),
    };
    // Skirts, of the mains' lines above all, are no lines: a peak and its two neighbours are.
    let near_peak = |bin: usize| {
        (bin.saturating_sub(1)..=bin + 1)
            .any(|b| b > 0 && b + 1 < power.len() && power[b] >= power[b - 1].max(power[b + 1]))
    };
    let heights: Vec<f64> =
        (power.iter().zip(floor).enumerate()).map(|bin| if near_peak(bin.0) { height(bin) } else { 0.0 }).collect();
    let at = |f: f64| heights.get((f / step).round() as usize).copied().unwrap_or(0.0);
    let score = |f: f64| (1..=OF_COMB).map(|h| at(h as f64 * f).min(LINE)).sum::<f64>();
    // A fifth of a bin at the highest order.
    let fine = 0.2 * step / OF_COMB as f64;
    let highest = |reach: f64| {
        let steps = (reach * shaft / fine) as i32;
        let scored = (-steps..=steps).map(|k| shaft + f64::from(k) * fine).map(|f| (f, score(f)));
        scored.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((shaft, 0.0))
    };
    let (speed, most) = highest(FARTHEST);
    let orders: Vec<usize> = (1..=OF_COMB).filter(|h| at(*h as f64 * speed) >= detected).collect();
    let clear = most >= highest(options.tolerance).1 + LINE;
    // A comb without its fundamental, or of few of its multiples, is another's.
    let is_whole = orders.len() >= FEWEST && orders[0] == 1 && 2 * orders.len() >= orders[orders.len() - 1];
    if !(clear && is_whole) {
        return Ok(None);
    }
    // To a fraction of a bin by the peaks themselves, where they agree.
    let near = Options { shaft: speed, tolerance: 0.25 * step / speed, ..options.clone() };
    let refined = within(x, fs, &near)?;
    Ok(Some(ShaftLines { speed: refined.map_or(speed, |r| r.speed), orders }))
}

fn within(x: &[f64], fs: f64, options: &Options) -> Result<Option<ShaftLines>, AnalysisError> {
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

#[cfg(test)]
mod tests {
    use super::super::DefectOrders;
    use super::*;
    use crate::test_signals::Noise;

    const FS: f64 = 6000.0;

    /// Four seconds of noise, with sines at the frequencies.
    fn speed(given: f64, sines: &[f64]) -> Option<f64> {
        let mut x = Noise::new(3).normals(24_000);
        for f in sines {
            for (i, v) in x.iter_mut().enumerate() {
                *v += 0.3 * (std::f64::consts::TAU * f * i as f64 / FS).sin();
            }
        }
        let options = Options::new(given, DefectOrders { bpfo: Some(3.6), ..DefectOrders::default() });
        shaft(&x, FS, &options).unwrap().map(|s| s.speed)
    }

    #[test]
    fn analytic_speed_beyond_the_tolerance() {
        let comb = |f: f64| [1.0, 2.0, 3.0, 5.0, 6.0].map(|h| h * f);
        // At 1.03 lines at the edge of the tolerance agree already, in the spectrum of forty turns.
        for off in [0.9, 0.95, 1.05, 1.1] {
            let speed = speed(31.3 * off, &comb(31.3)).unwrap();
            // A fifth of a quarter Hz at the tenth harmonic is the grid; noise moves it by a bin at the sixth.
            assert!((speed - 31.3).abs() < 0.25 / 6.0, "{off} {speed}");
        }
        // Lines of the mains are no comb of the shaft's, nor are three lines, nor noise.
        assert_eq!(speed(47.5, &[50.0, 100.0, 150.0, 200.0, 250.0]), None);
        assert_eq!(speed(29.8, &[31.3, 62.6, 93.9]), None);
        assert_eq!(speed(29.8, &[]), None);
    }
}
