//! Shaft and mains lines, excluded from damage; the shaft's tell its speed.

use super::running_median::running_median;
use super::together::{FLOOR, MAINS_HZ, REVOLUTIONS};
use super::{AnalysisError, Options};
use crate::distribution::chi_square_quantile;
use crate::psd::of_records;
use crate::{parallel, peak_near};

/// Chance under noise at which a peak counts as a line.
const LEVEL: f64 = 1e-4;
/// A line is higher than so many bins to either side: what is near it may be its skirt.
const APART: usize = 3;
/// Bins by which a line may miss a multiple of the speed: a peak is told to a fraction of a bin, and the speed of a
/// machine is never quite constant. With a whole bin, any two lines within the tolerance would agree.
const AGREE: f64 = 0.5;
/// Harmonics of the shaft's comb.
const OF_COMB: usize = 10;
/// How far off it may lie, relative: where the speed given is a tenth too low, the shaft's lies a ninth above it.
const FARTHEST: f64 = 0.12;
/// Lines of a comb within the tolerance that no other replaces, at least: the speed given speaks for it.
const FEWEST: usize = 2;
/// The same of one beyond.
const FEWEST_FAR: usize = 4;
/// The same of one at another sample rate, of which there are many.
const FEWEST_RATE: usize = 5;
const CHANCE_RATE: f64 = 1e-3;
/// Chance at most that lines of other sources, as many as there are, agree so well with any speed tried.
const CHANCE: f64 = 0.1;
/// What a line counts for at most, ln(power over floor): otherwise one that many places share would decide. A comb
/// farther from the speed given has so much more than one that is nearer.
const LINE: f64 = 4.0;
/// Bins that the tolerance spans at the fundamental; in a shorter record combs beyond it are not told apart.
const TELLING: f64 = 0.5;

/// Sample rates of usual instruments, Hz, from the highest down.
const RATES: [f64; 27] = [
    200e3, 102.4e3, 100e3, 97_656.25, 96e3, 65_536.0, 64e3, 51.2e3, 50e3, 48e3, 44.1e3, 40e3, 32e3, 25.6e3, 25e3, 24e3,
    20.48e3, 20e3, 16e3, 12.8e3, 12e3, 10.24e3, 10e3, 8e3, 6.4e3, 5.12e3, 5e3,
];
/// Speeds this near, relative, say nothing of which of two rates is right.
const ALIKE: f64 = 0.005;

/// A shaft's speed by lines at its harmonics.
pub(super) struct ShaftLines {
    /// Hz.
    pub(super) speed: f64,
    /// Which harmonics: two or more.
    pub(super) orders: Vec<usize>,
}

/// Shaft speed by its own harmonics in the spectrum, within the tolerance or, where few are detected there and far more
/// of a comb beyond it, there: the speed given is then wrong. `None` where they do not tell it. Each record has its rate
/// (Hz), as if all turned alike.
///
/// Another shaft's lines there look the same: nothing in the signal tells the two apart.
pub(super) fn shaft(records: &[(&[f64], f64)], options: &Options) -> Result<Option<ShaftLines>, AnalysisError> {
    let lines = Lines::of(records, options)?;
    let told = lines.dense(lines.chosen_comb());
    Ok(told.is_own().then(|| lines.told_by(&told)))
}

/// The sample rate of an instrument at which lines are the shaft's at the speed given, where they tell no speed at the
/// rate given; and how many of ten they are.
pub(super) fn other_rate(x: &[f64], fs: f64, options: &Options) -> Result<Option<(f64, usize)>, AnalysisError> {
    let lines = Lines::of(&[(x, fs)], options)?;
    let given = lines.chosen_comb();
    if lines.is_whole(&given, FEWEST_FAR) {
        return Ok(None);
    }
    let at = |rate: f64| -> Result<Option<(f64, Comb)>, AnalysisError> {
        let mut lines = Lines::of(&[(x, rate)], options)?;
        // Those that are the mains' at the rate given.
        let (given_hz, width) = (fs / rate, 2.0 * lines.step * fs / rate);
        lines.each.retain(|(f, _)| !near_mains(f * given_hz, width));
        let comb = lines.nearest_comb();
        // Every second or third line of one that is as dense tells nothing.
        let is_part = [2.0, 3.0].iter().any(|m| lines.comb(comb.speed / m).score >= comb.score);
        let fits = comb.score >= given.score + LINE && lines.is_whole(&comb, FEWEST_RATE) && !is_part;
        let is_chance = lines.chance(&comb) > CHANCE_RATE;
        Ok(Some((rate, comb)).filter(|_| fits && !is_chance))
    };
    let rates: Vec<f64> = RATES.into_iter().filter(|rate| (rate / fs - 1.0).abs() > FARTHEST).collect();
    let found = parallel::map(rates.len(), parallel::threads(rates.len()), |k| at(rates[k]));
    let found = found.into_iter().flat_map(Result::transpose).collect::<Result<Vec<_>, _>>()?;
    let highest = found.iter().map(|(_, comb)| comb.score).fold(0.0, f64::max);
    // At half the rate every second line is a harmonic.
    let off = |comb: &Comb| ((comb.speed / options.shaft - 1.0).abs() / ALIKE) as u32;
    let alike = found.iter().filter(|(_, comb)| comb.score > highest - LINE);
    Ok(alike.min_by_key(|(_, comb)| off(comb)).map(|(rate, comb)| (*rate, comb.orders.len())))
}

/// The lines of a spectrum that no mains make, up to the highest harmonic of the fastest shaft.
struct Lines<'a> {
    /// Hz, and ln(power over floor).
    each: Vec<(f64, f64)>,
    step: f64,
    /// The highest frequency, Hz.
    top: f64,
    options: &'a Options,
}

/// Lines at multiples of one frequency.
struct Comb {
    speed: f64,
    score: f64,
    orders: Vec<usize>,
}

impl Comb {
    /// Every second or third of the shaft's lines may be another part's, and so may its higher ones.
    fn is_own(&self) -> bool {
        self.orders.len() >= FEWEST && self.orders[0] <= 2 && self.orders.iter().fold(0, |d, h| divisor(d, *h)) == 1
    }
}

impl<'a> Lines<'a> {
    /// Of records, each with its rate, Hz.
    fn of(records: &[(&[f64], f64)], options: &'a Options) -> Result<Self, AnalysisError> {
        let shaft = options.shaft;
        let mut spectrum = of_records(records, (REVOLUTIONS, shaft))?;
        let step = spectrum.frequency_step;
        spectrum.amplitude.truncate(((OF_COMB + 1) as f64 * (1.0 + FARTHEST) * shaft / step) as usize);
        let power: Vec<f64> = spectrum.amplitude.iter().map(|a| a * a).collect();
        let floor = running_median(&power, (FLOOR.0 * shaft / step).max(FLOOR.1) as usize);
        let quantile = |p: f64| chi_square_quantile(p, spectrum.degrees_of_freedom) / spectrum.degrees_of_freedom;
        let (median, level) = (quantile(0.5), quantile(1.0 - LEVEL).ln());
        let is_peak = |bin: usize| {
            let around = bin.saturating_sub(APART)..(bin + APART + 1).min(power.len());
            bin + 1 < power.len() && around.clone().all(|b| power[b] <= power[bin]) && power[bin] > power[around.start]
        };
        let mut lines = Lines { each: Vec::new(), step, top: power.len() as f64 * step, options };
        for bin in (1..power.len()).filter(|bin| is_peak(*bin)) {
            let height = (median * power[bin] / floor[bin].max(f64::MIN_POSITIVE)).ln();
            let peak = peak_near(&spectrum, bin as f64 * step, 0.5 * step);
            let frequency = peak.map_or(bin as f64 * step, |p| p.frequency);
            if height >= level && !lines.is_hidden(frequency) {
                lines.each.push((frequency, height));
            }
        }
        Ok(lines)
    }

    /// Whether the mains or the supply could have made a line there.
    fn is_hidden(&self, f: f64) -> bool {
        let width = 2.0 * self.step;
        near_mains(f, width) || self.options.supply.is_some_and(|f0| near_multiple(f, f0, width))
    }

    /// The highest line that agrees with a frequency.
    fn at(&self, f: f64) -> Option<&(f64, f64)> {
        let agree = self.each.iter().filter(|(at, _)| (at - f).abs() <= AGREE * self.step);
        agree.max_by(|a, b| a.1.total_cmp(&b.1))
    }

    fn comb(&self, speed: f64) -> Comb {
        let mut comb = Comb { speed, score: 0.0, orders: Vec::new() };
        for order in 1..=OF_COMB {
            if let Some((_, height)) = self.at(order as f64 * speed) {
                comb.score += height.min(LINE);
                comb.orders.push(order);
            }
        }
        comb
    }

    /// Speeds that a line says, within `reach` of the one given, relative.
    fn speeds(&self, reach: f64) -> impl Iterator<Item = f64> {
        let said = |order: usize| self.each.iter().map(move |(at, _)| at / order as f64);
        let is_near = move |f: &f64| (f / self.options.shaft - 1.0).abs() <= reach;
        (1..=OF_COMB).rev().flat_map(said).filter(is_near)
    }

    /// Chance that lines anywhere make a comb of so many, of which one said the speed: a binomial tail for each speed
    /// tried.
    fn chance(&self, comb: &Comb) -> f64 {
        let one = (2.0 * AGREE * self.step * self.each.len() as f64 / self.top).min(1.0);
        let others = self.seen(comb, OF_COMB).saturating_sub(1);
        let mut ways = 1.0;
        let mut tail = 0.0;
        for k in 0..=others {
            if k + 1 >= comb.orders.len() {
                tail += ways * one.powi(k as i32) * (1.0 - one).powi((others - k) as i32);
            }
            ways *= (others - k) as f64 / (k + 1) as f64;
        }
        tail * self.speeds(FARTHEST).count() as f64
    }

    /// Those that two lines or more say, within `reach` of the speed given, relative.
    fn combs(&self, reach: f64) -> Vec<Comb> {
        self.speeds(reach).map(|f| self.comb(f)).filter(Comb::is_own).collect()
    }

    /// The highest as far off as may be; without a score where there is none.
    fn highest_comb(&self) -> Comb {
        let highest = self.combs(FARTHEST).into_iter().max_by(|a, b| a.score.total_cmp(&b.score));
        highest.unwrap_or(self.no_comb())
    }

    /// Within the tolerance: the nearest to the speed given of those that no other has a line more than.
    fn nearest_comb(&self) -> Comb {
        let combs = self.combs(self.options.tolerance);
        let highest = combs.iter().map(|comb| comb.score).fold(0.0, f64::max);
        let off = |comb: &Comb| (comb.speed / self.options.shaft - 1.0).abs();
        let alike = combs.into_iter().filter(|comb| comb.score > highest - LINE);
        alike.min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(self.no_comb())
    }

    /// The nearest, or where it may be another's the highest.
    fn chosen_comb(&self) -> Comb {
        let near = self.nearest_comb();
        let is_told = self.options.tolerance * self.options.shaft >= TELLING * self.step;
        if is_told && !self.is_whole(&near, FEWEST) {
            let far = self.highest_comb();
            if far.score >= near.score + LINE && self.is_whole(&far, FEWEST_FAR) && self.chance(&far) <= CHANCE {
                return far;
            }
        }
        near
    }

    fn no_comb(&self) -> Comb {
        Comb { speed: self.options.shaft, score: 0.0, orders: Vec::new() }
    }

    /// A comb without its fundamental, or of few of its multiples, is another's.
    fn is_whole(&self, comb: &Comb, fewest: usize) -> bool {
        let Some(last) = comb.orders.last() else {
            return false;
        };
        comb.orders.len() >= fewest && comb.orders[0] == 1 && 2 * comb.orders.len() >= self.seen(comb, *last)
    }

    /// Of a comb, the lines up to which half are there: what lies above may be anybody's.
    fn dense(&self, mut comb: Comb) -> Comb {
        let most = comb.orders.iter().zip(1..).take_while(|(order, so_far)| 2 * so_far >= self.seen(&comb, **order));
        comb.orders.truncate(most.count());
        comb
    }

    /// How many harmonics up to one nothing hides.
    fn seen(&self, comb: &Comb, last: usize) -> usize {
        (1..=last).filter(|h| !self.is_hidden(*h as f64 * comb.speed)).count()
    }

    /// Least squares of a comb's lines.
    fn told_by(&self, comb: &Comb) -> ShaftLines {
        let (mut above, mut below) = (0.0, 0.0);
        for order in &comb.orders {
            let h = *order as f64;
            if let Some((at, _)) = self.at(h * comb.speed) {
                above += h * at;
                below += h * h;
            }
        }
        ShaftLines { speed: above / below, orders: comb.orders.clone() }
    }
}

/// Whether a harmonic of the mains lies within `width` (Hz) of a frequency.
pub(super) fn near_mains(f: f64, width: f64) -> bool {
    MAINS_HZ.iter().any(|hz| near_multiple(f, *hz, width))
}

/// Whether a multiple of one frequency lies within `width` (Hz) of another.
pub(super) fn near_multiple(f: f64, of: f64, width: f64) -> bool {
    (f - (f / of).round() * of).abs() < width
}

fn divisor(a: usize, b: usize) -> usize {
    if b == 0 { a } else { divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::super::DefectOrders;
    use super::*;
    use crate::test_signals::Noise;

    const FS: f64 = 6000.0;

    /// Four seconds of noise, with sines at the frequencies, and what is known.
    fn record(given: f64, sines: &[f64]) -> (Vec<f64>, Options) {
        let mut x = Noise::new(3).normals(24_000);
        for f in sines {
            for (i, v) in x.iter_mut().enumerate() {
                *v += 0.3 * (std::f64::consts::TAU * f * i as f64 / FS).sin();
            }
        }
        (x, Options::new(given, DefectOrders { bpfo: Some(3.6), ..DefectOrders::default() }))
    }

    fn speed(given: f64, sines: &[f64]) -> Option<f64> {
        let (x, options) = record(given, sines);
        shaft(&[(&x, FS)], &options).unwrap().map(|s| s.speed)
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
        // Two of ten, or none below the half of them, say nothing; what lies above two that do moves nothing.
        assert_eq!(speed(31.3, &[31.6, 316.0]), None);
        assert_eq!(speed(31.3, &[31.6, 7.0 * 31.6, 9.0 * 31.6]), None);
        let two = [31.6, 63.2];
        assert!((speed(31.3, &two).unwrap() / 31.6 - 1.0).abs() < 2e-3);
        let moved = speed(31.3, &[31.6, 63.2, 10.0 * 31.605]).unwrap() / speed(31.3, &two).unwrap() - 1.0;
        assert!(moved.abs() < 1e-6, "{moved}");
    }

    /// Seven harmonics of the shaft's, as they lie where the rate given is too high or too low.
    #[test]
    fn analytic_lines_tell_another_sample_rate() {
        let at = |times: f64, harmonics: &[f64]| {
            let sines: Vec<f64> = harmonics.iter().map(|h| times * h * 31.3).collect();
            let (x, options) = record(31.3, &sines);
            other_rate(&x, FS, &options).unwrap()
        };
        let seven = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
        for rate in [12_000.0, 25_600.0] {
            assert_eq!(at(FS / rate, &seven), Some((rate, 7)));
        }
        // At the rate given they are the shaft's; four say too little; every second one is not the shaft's.
        assert_eq!(at(1.0, &seven), None);
        assert_eq!(at(0.5, &seven[..4]), None);
        assert_eq!(at(2.0, &seven[..4]), None);
    }
}
