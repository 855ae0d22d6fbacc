//! What stands in many narrow bands together: the evidence that a verdict rests on.
//!
//! Damage excites structure over a wide range, so its lines stand in the envelopes of many bands; what else turns is heard in a few. The range
//! above three times the highest defect frequency is tiled by bands of equal width, each half over the next. Power in the envelope
//! spectrum of each is divided by the noise floor about it (a running median) and averaged over the bands: every band counts alike, whatever its
//! level, as in the integrated cyclic spectral coherence (J. Antoni, "Cyclic spectral analysis in practice", Mech. Syst. Signal
//! Process. 21 (2007) 597-630). Lines of shaft and mains count for nobody.
//!
//! A family is a defect frequency with its harmonics, all of one slip. It has
//! - a score, the sum over five harmonics of ln(power over floor): 0 for a silent family, about 5 for the best place in noise;
//! - a depth, the power of its lines over the envelope's mean squared, averaged over the bands: what a longer record does not change.
//!
//! The limits ([`Family::is_damage`]) were set on 72 public records of three rigs (docs/src/results/analyze.md): of 31 of sound bearings none goes
//! beyond them (the nearest: 17.4 with a depth of 1.4 %, and 14.0 with 0.4 %); of the damaged ones that show their damage the lowest has 16.5 with 1.7 %.

use super::frequencies::Component;
use super::known_lines;
use super::view::{Shaft, USUAL_FTF, at_angles, envelope_samples, side_by_side, top};
use super::{AnalysisError, Options, bands};
use crate::signal::lengths::fast_up_to;
use crate::signal::{Band, Segments, Spectrum, Transformed, psd};

/// Score from which a family is damage in a record of [`REVOLUTIONS`] or more. In a shorter one its lines stand less high over the noise: as the
/// length, in power.
pub(super) const SCORE: f64 = 15.0;
/// Least score, however short the record: noise comes to five.
const LEAST: f64 = 9.0;
/// Depth from which it is: a healthy machine's lines stand too, faintly.
const DEPTH: f64 = 0.015;
/// Depth from which [`LEAST`] is enough: where few bins lie between lines, the floor holds some of them.
const DEEP: f64 = 0.05;
/// Score from which evidence is very clear.
pub(super) const VERY_CLEAR: f64 = 19.0;
/// Harmonics that are counted.
const HARMONICS: usize = 5;
/// Bands side by side in the whole range at most; half as many again lie between them.
const BANDS: f64 = 12.0;
/// Revolutions of a segment: lines are then a fraction of 1/120 of the shaft's frequency wide. In longer ones slip would smear them.
const REVOLUTIONS: f64 = 120.0;
/// Bins to either side of a line of shaft or mains that count for nobody.
const ASIDE: f64 = 3.0;
/// Width of the running median, in shaft's frequencies and in bins at least.
const FLOOR: (f64, f64) = (3.0, 41.0);
/// An element's rate lies above pure rolling by less than this, relative: an element slips, and does not run ahead.
const AHEAD: f64 = 0.01;
/// Lead in score that an element needs over the races: its sidebands at the cage's frequency reach most lines.
const LEAD: f64 = 2.0;
/// Multiples of shaft and cage about the first's harmonics that are taken out before a second one is sought.
const SIDES: i32 = 3;

/// A defect frequency with its harmonics in all bands together.
#[derive(Debug, Clone, PartialEq)]
pub struct Family {
    /// What is struck.
    pub component: Component,
    /// `BPFO`, `BPFI`, `2 BSF` or `FTF`.
    pub name: &'static str,
    /// Where pure rolling has it, Hz.
    pub expected: f64,
    /// Where its lines stand highest, Hz.
    pub frequency: f64,
    /// Sum of ln(power over floor) over the harmonics.
    pub score: f64,
    /// The score from which a record of this length shows damage.
    pub limit: f64,
    /// Power over floor of each harmonic, dB.
    pub snr_db: Vec<f64>,
    /// Power of its lines over the envelope's mean squared.
    pub depth: f64,
}

impl Family {
    /// Whether it says damage by itself.
    pub fn is_damage(&self) -> bool {
        self.score >= self.limit && self.depth >= DEPTH || self.score >= LEAST && self.depth >= DEEP
    }
}

/// Power by frequency, averaged over the bands.
struct Together {
    step: f64,
    /// Over the floor.
    ratio: Vec<f64>,
    /// Above the floor, over the envelope's mean squared.
    depth: Vec<f64>,
}

/// The families, and which of them say damage.
pub(super) struct Families {
    pub(super) all: Vec<Family>,
    /// Of them, those that say damage: the first by itself, any other in what the first one's lines leave.
    pub(super) damage: Vec<Component>,
}

/// Of a signal whose shaft speed is known as well as it will be.
pub(super) fn families(
    transformed: &Transformed,
    shaft: Shaft,
    options: &Options,
) -> Result<Families, AnalysisError> {
    let Some(mut together) = together(transformed, shaft, options)? else {
        return Ok(Families {
            all: Vec::new(),
            damage: Vec::new(),
        });
    };
    let revolutions = transformed.samples() as f64 / transformed.sample_rate() * shaft.hz;
    let shorter = (revolutions / REVOLUTIONS).min(1.0);
    let limit = (SCORE + HARMONICS as f64 * shorter.ln()).max(LEAST);
    let all = read(&together, limit, shaft.hz, options);
    let mut damage = Vec::new();
    if let Some(first) = first(&all) {
        // What strikes once a turn of the cage is one element on its way through the load, more often than the cage.
        damage.extend(match first.component {
            Component::Cage => vec![Component::Element, Component::Cage],
            other => vec![other],
        });
        let cage = options.orders.ftf.unwrap_or(USUAL_FTF) * shaft.hz;
        together.take_out(first.frequency, [shaft.hz, cage]);
        let left = read(&together, limit, shaft.hz, options);
        // Frequencies that slip may bring together are not told apart.
        let apart =
            |f: &&Family| (f.expected / first.expected - 1.0).abs() > 2.0 * options.tolerance;
        let further = left.iter().filter(|f| f.is_damage()).filter(apart);
        let further: Vec<Component> = further
            .map(|f| f.component)
            .filter(|c| *c != Component::Cage && !damage.contains(c))
            .collect();
        damage.extend(further);
    }
    Ok(Families { all, damage })
}

/// The family that leads: the highest score, an element's only with a lead over the races', the cage's last.
fn first(all: &[Family]) -> Option<&Family> {
    let highest = |of: &dyn Fn(Component) -> bool| {
        let these = all.iter().filter(|f| f.is_damage() && of(f.component));
        these.max_by(|a, b| a.score.total_cmp(&b.score))
    };
    let race = highest(&|c| matches!(c, Component::OuterRace | Component::InnerRace));
    let element = highest(&|c| c == Component::Element);
    match (race, element) {
        (Some(race), Some(element)) if element.score > race.score + LEAD => Some(element),
        (Some(race), _) => Some(race),
        (None, Some(element)) => Some(element),
        (None, None) => highest(&|c| c == Component::Cage),
    }
}

/// `None` where no band holds the lines.
fn together(
    transformed: &Transformed,
    shaft: Shaft,
    options: &Options,
) -> Result<Option<Together>, AnalysisError> {
    let top = top(shaft.hz, options);
    let tiles = tiles(transformed.sample_rate(), top, options);
    let count = envelope_samples(transformed, top);
    let spectra = side_by_side(&tiles, |band| {
        spectrum(transformed, *band, count, shaft.hz, top, options)
    })?;
    let (means, spectra): (Vec<f64>, Vec<Spectrum>) = spectra.into_iter().unzip();
    let Some(shortest) = spectra.iter().map(|s| s.amplitude.len()).min() else {
        return Ok(None);
    };
    let step = spectra[0].frequency_step;
    let mut combs = known_lines::combs(&spectra, shaft.hz, shaft.tolerance)?;
    combs.push(shaft.hz);
    let width = (FLOOR.0 * shaft.hz / step).max(FLOOR.1) as usize;
    let mut ratio = vec![0.0; shortest];
    let mut depth = vec![0.0; shortest];
    let share = 1.0 / spectra.len() as f64;
    for (mean, spectrum) in means.iter().zip(&spectra) {
        let power: Vec<f64> = (spectrum.amplitude[..shortest].iter())
            .map(|a| 0.5 * a * a / (mean * mean).max(f64::MIN_POSITIVE))
            .collect();
        // The median of a power with few degrees of freedom lies below its mean.
        let unbiased = 1.0 / (1.0 - 2.0 / (9.0 * spectrum.degrees_of_freedom)).powi(3);
        for (k, (power, floor)) in power.iter().zip(running_median(&power, width)).enumerate() {
            let floor = (floor * unbiased).max(f64::MIN_POSITIVE);
            ratio[k] += share * power / floor;
            depth[k] += share * (power - floor).max(0.0);
        }
    }
    let mut together = Together { step, ratio, depth };
    for comb in combs {
        let mut k = 1.0;
        while k * comb < top {
            together.silence(k * comb);
            k += 1.0;
        }
    }
    Ok(Some(together))
}

/// Bands of one width, each half over the next.
fn tiles(fs: f64, top: f64, options: &Options) -> Vec<Band> {
    let nyquist = 0.5 * fs;
    let (low, high) = match options.band {
        Some(band) => (band.low, band.high.min(nyquist)),
        None => (bands::BROAD * bands::highest(options), nyquist),
    };
    let width = top.max((high - low) / BANDS).min(high - low);
    if width.is_nan() || width <= 0.0 {
        return Vec::new();
    }
    let count = ((high - low - width) / (0.5 * width)).floor() as usize + 1;
    (0..count)
        .map(|k| low + 0.5 * k as f64 * width)
        .map(|from| Band::between(from, (from + width).min(nyquist)))
        .collect()
}

/// Mean and spectrum of a band's envelope.
fn spectrum(
    transformed: &Transformed,
    band: Band,
    count: usize,
    shaft: f64,
    top: f64,
    options: &Options,
) -> Result<(f64, Spectrum), AnalysisError> {
    let envelope = transformed.envelope(band, count);
    let mean = envelope.mean;
    let (values, rate) = at_angles(envelope, transformed, shaft, options)?;
    let length = ((REVOLUTIONS * rate / shaft) as usize).min(values.len());
    let mut spectrum = psd(&values, rate, &Segments::of(fast_up_to(length)))?;
    let bins = (1.03 * top / spectrum.frequency_step) as usize;
    spectrum.amplitude.truncate(bins);
    spectrum.density.truncate(bins);
    Ok((mean, spectrum))
}

/// Medians over `width` neighbours, taken at every eighth of that and joined by lines.
fn running_median(values: &[f64], width: usize) -> Vec<f64> {
    let n = values.len();
    let every = (width / 8).max(1);
    let median = |center: usize| {
        let from = center
            .saturating_sub(width / 2)
            .min(n.saturating_sub(width));
        let mut near = values[from..(from + width).min(n)].to_vec();
        let middle = near.len() / 2;
        *near.select_nth_unstable_by(middle, f64::total_cmp).1
    };
    let knots: Vec<f64> = (0..n.div_ceil(every) + 1)
        .map(|k| median((k * every).min(n - 1)))
        .collect();
    (0..n)
        .map(|k| {
            let (knot, part) = (k / every, (k % every) as f64 / every as f64);
            knots[knot] + part * (knots[knot + 1] - knots[knot])
        })
        .collect()
}

impl Together {
    /// Nothing at a frequency.
    fn silence(&mut self, frequency: f64) {
        let at = frequency / self.step;
        let last = (at + ASIDE).floor() as usize;
        for k in ((at - ASIDE).ceil().max(0.0) as usize)..=last.min(self.ratio.len() - 1) {
            (self.ratio[k], self.depth[k]) = (1.0, 0.0);
        }
    }

    /// Without harmonics of a frequency and their sidebands.
    fn take_out(&mut self, frequency: f64, [shaft, cage]: [f64; 2]) {
        let most = self.ratio.len() as f64 * self.step;
        let mut k = 0.0;
        while k * frequency < most + f64::from(SIDES) * (shaft + cage) {
            for a in -SIDES..=SIDES {
                for b in -SIDES..=SIDES {
                    let at = k * frequency + f64::from(a) * shaft + f64::from(b) * cage;
                    if (0.0..most).contains(&at) {
                        self.silence(at);
                    }
                }
            }
            k += 1.0;
        }
    }

    /// The highest of a line's three bins; 1 and 0 beyond the spectrum.
    fn line(&self, frequency: f64) -> (f64, f64) {
        let at = (frequency / self.step).round() as usize;
        let highest = |of: &[f64], none: f64| {
            let bins = of.get(at.saturating_sub(1)..at + 2).unwrap_or(&[]);
            bins.iter().copied().fold(none, f64::max)
        };
        (highest(&self.ratio, 1.0), highest(&self.depth, 0.0))
    }

    fn score(&self, frequency: f64) -> f64 {
        (1..=HARMONICS)
            .map(|k| self.line(k as f64 * frequency).0.ln())
            .sum()
    }
}

/// Each family at the slip at which it stands highest.
fn read(together: &Together, limit: f64, shaft: f64, options: &Options) -> Vec<Family> {
    let strikes = options.orders.strikes();
    // Damage on an element strikes twice a turn; a ball that turns about another axis, once, at lines that 2 BSF has as well.
    let strikes = strikes.filter(|(_, name, _)| *name != "BSF");
    strikes
        .map(|(component, name, order)| {
            let expected = order * shaft;
            let ahead = match component {
                Component::Element => AHEAD.min(options.tolerance),
                _ => options.tolerance,
            };
            let step = 0.25 * together.step / (HARMONICS as f64 * expected);
            let steps = ((ahead + options.tolerance) / step) as usize;
            let places =
                (0..=steps).map(|k| expected * (1.0 - options.tolerance + k as f64 * step));
            let scored = places.map(|f| (f, together.score(f)));
            let (frequency, score) = scored
                .max_by(|a, b| a.1.total_cmp(&b.1))
                .unwrap_or((expected, 0.0));
            let lines: Vec<(f64, f64)> = (1..=HARMONICS)
                .map(|k| together.line(k as f64 * frequency))
                .collect();
            Family {
                component,
                name,
                expected,
                frequency,
                score,
                limit,
                snr_db: lines.iter().map(|l| 10.0 * l.0.log10()).collect(),
                depth: lines.iter().map(|l| l.1).sum(),
            }
        })
        .collect()
}
