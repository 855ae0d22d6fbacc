//! The envelope spectra of many bands, averaged: the lines that all of them have.
//!
//! The range above three times the highest defect frequency is tiled by bands of equal width, each half over the next.
//! Power in the envelope spectrum of each is divided by the noise floor about it (a running median) and averaged over
//! the bands: every band counts alike, whatever its level, as in the integrated cyclic spectral coherence (J. Antoni,
//! "Cyclic spectral analysis in practice", Mech. Syst. Signal Process. 21 (2007) 597-630). Of several records of one
//! machine each counts by its length, whatever its level, and no segment holds parts of two.

use super::running_median::running_median;
use super::{AnalysisError, Options};
use crate::distribution::chi_square_quantile;
use crate::lengths::fast_up_to;
use crate::parallel;
use crate::psd::of_records;
use crate::spectrum::interpolate;
use crate::{Band, Spectrum, Thinned, Transformed, resample};

/// Harmonics of a defect frequency that are looked at.
pub const HARMONICS: usize = 5;
/// Bands side by side in the whole range at most; half as many again lie between them.
const BANDS: f64 = 12.0;
/// Revolutions of a segment: lines are then a fraction of 1/120 of the shaft's frequency wide. In longer ones slip
/// would smear them.
pub(super) const REVOLUTIONS: f64 = 120.0;
/// The envelope is sampled so many times as often as its highest line sought.
const ENVELOPE_RATE: f64 = 8.0;
/// Frequencies of public power supplies.
pub(super) const MAINS_HZ: [f64; 2] = [50.0, 60.0];
/// Bins to either side of a line of shaft or mains that count for nobody: half the main lobe of Hann's window.
const ASIDE: f64 = 2.0;
/// Powers of the three bins about a line's top over the line's, through Hann's window: 1.5 where it lies on a bin, 1.47
/// halfway between two.
const LOBE: f64 = 1.5;
/// Part of a simulation's spectrum that the shaft's lines may hide.
const HIDDEN: f64 = 0.1;
/// Width of the running median, in shaft's frequencies and in bins at least.
pub(super) const FLOOR: (f64, f64) = (3.0, 41.0);
/// Noise shows this much at a place once in 700 (three standard deviations).
const NOISE: f64 = 1.0 - 1.35e-3;
/// Power over floor from which a line is detected, however many bands are averaged: 3 dB.
const STANDS: f64 = 2.0;
/// Lines of the mains that have to be detected before they are set aside.
const OF_MAINS: usize = 3;
/// How well an inverter's frequency is known, relative.
pub(super) const SUPPLY_KNOWN: f64 = 0.005;
/// Lines of the shaft by which its comb is placed.
const OF_SHAFT: usize = 10;

/// A record, and the shaft's frequency in the analysis over its own: what its times are divided by, so that all turn
/// alike.
pub(super) type Paced = (Transformed, f64);

/// Shaft speed, and how far its lines may lie from it where they were found in the signal; both Hz.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shaft {
    pub(super) hz: f64,
    pub(super) tolerance: f64,
}

/// Power by frequency, averaged over the bands.
pub(super) struct Together {
    step: f64,
    /// Over the floor.
    ratio: Vec<f64>,
    /// Above the floor, over the envelope's mean squared.
    depth: Vec<f64>,
    /// Where lines of shaft or mains lie, or of what was taken out: nothing is seen there.
    hidden: Vec<bool>,
    /// Power over floor in each band alone.
    each: Vec<Vec<f64>>,
    /// Power over floor that noise alone hardly shows at a place.
    pub(super) noise: f64,
    /// How high a line rises over the noise, over what it does in segments of [`REVOLUTIONS`]: of several records, which
    /// average chance lines away; of one it is 1, whatever its length.
    pub(super) rise: f64,
}

/// What is at a frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    /// Power over floor; `None` where nothing is seen.
    pub(super) ratio: Option<f64>,
    /// Power of a line above the floor, over the envelope's mean squared: wherever it lies between the bins.
    pub(super) depth: f64,
}

impl Together {
    /// Of a signal's envelopes.
    pub(super) fn of(envelopes: &Envelopes, shaft: Shaft, options: &Options) -> Result<Self, AnalysisError> {
        let spectra = in_parallel(&envelopes.each, |(_, each)| envelopes.spectrum(each, shaft.hz, options))?;
        let bins = spectra.iter().map(|s| s.1.amplitude.len()).min().unwrap_or(0);
        let (step, freedom) = (spectra.first()).map_or((1.0, 2.0), |(_, s)| (s.frequency_step, s.degrees_of_freedom));
        let width = (FLOOR.0 * shaft.hz / step).max(FLOOR.1) as usize;
        let apart = apart(spectra.len());
        let mut together = Together {
            step,
            ratio: vec![0.0; bins],
            depth: vec![0.0; bins],
            hidden: vec![false; bins],
            each: Vec::new(),
            noise: chi_square_quantile(NOISE, apart * freedom) / (apart * freedom),
            rise: match envelopes.rates.len() {
                1 => 1.0,
                _ => (shaft.hz / (step * REVOLUTIONS)).min(1.0),
            },
        };
        // The median of a power with few degrees of freedom lies below its mean.
        let unbiased = 1.0 / (1.0 - 2.0 / (9.0 * freedom)).powi(3);
        let share = 1.0 / spectra.len() as f64;
        for (mean, spectrum) in &spectra {
            let mut power: Vec<f64> = (spectrum.amplitude[..bins].iter())
                .map(|a| 0.5 * a * a / (mean * mean).max(f64::MIN_POSITIVE))
                .collect();
            let floor = running_median(&power, width);
            for (k, (power, floor)) in power.iter_mut().zip(floor).enumerate() {
                let floor = (floor * unbiased).max(f64::MIN_POSITIVE);
                together.depth[k] += share * (*power - floor).max(0.0);
                *power /= floor;
                together.ratio[k] += share * *power;
            }
            together.each.push(power);
        }
        together.hide_known(shaft, options);
        Ok(together)
    }

    /// Lines of the shaft, which every machine has, and of the mains where they are detected.
    fn hide_known(&mut self, shaft: Shaft, options: &Options) {
        // Magnetic forces pull at twice the current's frequency.
        let mains = MAINS_HZ.into_iter().flat_map(|hz| [hz, 2.0 * hz]);
        let this = &*self;
        let lines = |f: f64, n: usize| (1..=n).map(move |k| this.at(k as f64 * f).ratio.unwrap_or(1.0));
        // A simulation has none.
        let stand = |f: &f64| !options.exact && lines(*f, OF_MAINS).all(|ratio| ratio >= this.detection_level());
        // Of the places at which lines may be, the one at which they are highest.
        let height = |f: f64| -> f64 { lines(f, OF_SHAFT).map(f64::ln).sum() };
        let highest = |f: f64, tolerance: f64| {
            let step = 0.25 * self.step / OF_SHAFT as f64;
            let steps = (tolerance / step) as i32;
            Highest::of((-steps..=steps).map(|k| f + f64::from(k) * step), height).map(|h| h.middle())
        };
        let of_shaft = (shaft.tolerance > 0.0).then(|| highest(shaft.hz, shaft.tolerance));
        let of_supply = options.supply.map(|hz| highest(hz, SUPPLY_KNOWN * hz));
        // Of a simulation the shaft has lines where its speed varies, too: elements that slip meet damage that turns at
        // places of the load zone.
        let with_shaft = !options.exact || options.rotation.is_some() && 2.0 * ASIDE * this.step < HIDDEN * shaft.hz;
        let combs: Vec<f64> = (mains.filter(stand))
            .chain(of_shaft.flatten())
            .chain(of_supply.flatten())
            .chain(with_shaft.then_some(shaft.hz))
            .collect();
        for comb in combs {
            let mut k = 1.0;
            while k * comb < self.top() {
                self.hide(k * comb);
                k += 1.0;
            }
        }
    }

    /// Power over floor from which a line is detected.
    pub(super) fn detection_level(&self) -> f64 {
        self.noise.max(STANDS)
    }

    /// Distance between bins, Hz.
    pub(super) fn step(&self) -> f64 {
        self.step
    }

    /// The highest frequency, Hz.
    pub(super) fn top(&self) -> f64 {
        self.ratio.len() as f64 * self.step
    }

    /// Nothing is seen there from now on.
    pub(super) fn hide(&mut self, frequency: f64) {
        let at = frequency / self.step;
        let last = self.ratio.len().saturating_sub(1);
        let low = ((at - ASIDE).ceil().max(0.0) as usize).min(last);
        let high = ((at + ASIDE).floor() as usize).min(last);
        self.hidden[low..=high].fill(true);
    }

    /// What is read where nothing is hidden.
    pub(super) fn revealed<R>(&mut self, read: impl FnOnce(&Self) -> R) -> R {
        let hidden = std::mem::take(&mut self.hidden);
        let result = read(self);
        self.hidden = hidden;
        result
    }

    fn is_hidden(&self, bin: usize) -> bool {
        self.hidden.get(bin).is_some_and(|h| *h)
    }

    /// Those of a bin and its neighbours that are seen.
    fn seen(&self, bin: usize) -> impl Iterator<Item = usize> {
        (bin.saturating_sub(1)..bin + 2).filter(|b| *b < self.ratio.len() && !self.is_hidden(*b))
    }

    /// The highest of them.
    fn highest(&self, bin: usize) -> usize {
        self.seen(bin).max_by(|a, b| self.ratio[*a].total_cmp(&self.ratio[*b])).unwrap_or(bin)
    }

    /// The highest of the three bins at a frequency; beyond the spectrum nothing is seen, nor on the skirt of a line that
    /// is hidden.
    pub(super) fn at(&self, frequency: f64) -> Place {
        let nothing = Place { ratio: None, depth: 0.0 };
        let bin = self.bin(frequency.max(0.0));
        if self.is_hidden(bin) || bin == 0 || bin + 1 >= self.ratio.len() {
            return nothing;
        }
        let top = self.highest(bin);
        // A line whose top is the first of the hidden bins is its own.
        let rises = |a: Option<usize>, b: Option<usize>| self.rises(Some(top), a) && self.rises(a, b);
        if rises(top.checked_sub(1), top.checked_sub(2)) || rises(Some(top + 1), Some(top + 2)) {
            return nothing;
        }
        Place { ratio: Some(self.ratio[top]), depth: self.seen(top).map(|b| self.depth[b]).sum::<f64>() / LOBE }
    }

    /// Whether power rises from a bin to another that is hidden.
    fn rises(&self, from: Option<usize>, to: Option<usize>) -> bool {
        from.zip(to).is_some_and(|(a, b)| self.is_hidden(b) && self.ratio[b] > self.ratio[a])
    }

    /// The line at a frequency, of the three bins there, to a fraction of a bin: Hz. `None` where its top is hidden.
    pub(super) fn line(&self, frequency: f64) -> Option<f64> {
        let top = self.highest(self.bin(frequency));
        let around = [top.saturating_sub(1), top, top + 1].map(|b| self.ratio.get(b).map_or(0.0, |r| r.sqrt()));
        let is_peak = around[1] > around[0].min(around[2]) && around[1] >= around[0].max(around[2]);
        let offset = if is_peak { interpolate(around).0 } else { 0.0 };
        let is_hidden = self.rises(Some(top), top.checked_sub(1)) || self.rises(Some(top), Some(top + 1));
        (!is_hidden).then_some((top as f64 + offset) * self.step)
    }

    /// Power over floor at a frequency, whatever is hidden there.
    pub(super) fn unhidden(&self, frequency: f64) -> Option<f64> {
        peak(&self.ratio, self.bin(frequency))
    }

    /// Bins over which a line of order 10 smears where the speed (Hz) takes these values.
    pub(super) fn smear(&self, course: &[(f64, f64)]) -> f64 {
        let speeds = || course.iter().map(|p| p.1);
        10.0 * (speeds().fold(0.0, f64::max) - speeds().fold(f64::INFINITY, f64::min)) / self.step
    }

    /// How many bands.
    pub(super) fn bands(&self) -> usize {
        self.each.len()
    }

    /// The band in which lines at these frequencies are highest, by index.
    pub(super) fn clearest(&self, lines: impl Iterator<Item = f64> + Clone) -> usize {
        let height =
            |ratio: &[f64]| -> f64 { lines.clone().map(|hz| peak(ratio, self.bin(hz)).unwrap_or(1.0).ln()).sum() };
        let heights = self.each.iter().map(|ratio| height(ratio)).enumerate();
        let highest = heights.max_by(|a, b| a.1.total_cmp(&b.1));
        highest.map_or(0, |h| h.0)
    }

    fn bin(&self, frequency: f64) -> usize {
        (frequency / self.step).round() as usize
    }
}

/// Where a height is largest: a stretch, as places a fraction of a bin apart share their lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Highest {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) height: f64,
}

impl Highest {
    /// Of places in order; the first stretch where there are more.
    pub(super) fn of(places: impl Iterator<Item = f64>, height: impl Fn(f64) -> f64) -> Option<Self> {
        let (mut best, mut goes_on): (Option<Highest>, bool) = (None, false);
        for (place, height) in places.map(|f| (f, height(f))) {
            match &mut best {
                Some(best) if goes_on && height == best.height => best.to = place,
                Some(best) if height <= best.height => goes_on = false,
                _ => (best, goes_on) = (Some(Highest { from: place, to: place, height }), true),
            }
        }
        best
    }

    pub(super) fn middle(&self) -> f64 {
        0.5 * (self.from + self.to)
    }
}

/// The highest of a bin and its neighbours; `None` at the ends of a spectrum and beyond.
fn peak(of: &[f64], bin: usize) -> Option<f64> {
    let bins = of.get(bin.checked_sub(1)?..bin + 2)?;
    Some(bins.iter().fold(0.0, |m: f64, v| m.max(*v)))
}

/// Highest frequency looked at in an envelope spectrum, Hz.
fn top(shaft: f64, options: &Options) -> f64 {
    options.orders.highest() * shaft * (HARMONICS as f64 + 0.5) * (1.0 + options.tolerance)
}

/// Bands of one width, each half over the next.
fn tiles(range: Band, top: f64) -> Vec<Band> {
    let whole = range.high - range.low;
    let width = top.max(whole / BANDS).min(whole);
    if width.is_nan() || width <= 0.0 {
        return Vec::new();
    }
    let count = ((whole - width) / (0.5 * width)).floor() as usize + 1;
    (0..count)
        .map(|k| range.low + 0.5 * k as f64 * width)
        .map(|from| Band::between(from, (from + width).min(range.high)))
        .collect()
}

/// Bands that lie side by side and say as much as so many, each half over the next.
pub(super) fn apart(bands: usize) -> f64 {
    0.5 * (bands as f64 + 1.0)
}

/// Mean of a band's envelopes, in the signal's unit, and their spectrum up to the highest line sought.
pub(super) fn envelope_spectrum(
    records: &[Paced],
    band: Band,
    shaft: f64,
    options: &Options,
) -> Result<(f64, Spectrum), AnalysisError> {
    let top = top(shaft, options);
    let each: Vec<Thinned> = records.iter().map(|(transformed, _)| thinned(transformed, band, top)).collect();
    spectrum_of(&each, &rates_of(&each, records), shaft, options)
}

/// As if the envelopes had one mean.
fn spectrum_of(
    envelopes: &[Thinned],
    rates: &[f64],
    shaft: f64,
    options: &Options,
) -> Result<(f64, Spectrum), AnalysisError> {
    let mean = envelopes.iter().map(|e| e.mean).sum::<f64>() / envelopes.len() as f64;
    let each = envelopes.iter().zip(rates).map(|(envelope, rate)| {
        let (mut values, rate) = at_angles(envelope, *rate, shaft, options)?;
        if envelope.mean > 0.0 {
            values.iter_mut().for_each(|v| *v *= mean / envelope.mean);
        }
        Ok((values, rate))
    });
    let each = each.collect::<Result<Vec<_>, AnalysisError>>()?;
    let each: Vec<(&[f64], f64)> = each.iter().map(|(values, rate)| (&values[..], *rate)).collect();
    let mut spectrum = of_records(&each, (REVOLUTIONS, shaft))?;
    let bins = (1.03 * top(shaft, options) / spectrum.frequency_step) as usize;
    spectrum.amplitude.truncate(bins);
    spectrum.density.truncate(bins);
    Ok((mean, spectrum))
}

/// The envelopes of all bands.
pub(super) struct Envelopes {
    /// Of each record.
    pub(super) each: Vec<(Band, Vec<Thinned>)>,
    /// How often those of each record are sampled, at the pace of all, Hz.
    pub(super) rates: Vec<f64>,
}

impl Envelopes {
    pub(super) fn of(records: &[Paced], range: Band, shaft: f64, options: &Options) -> Result<Self, AnalysisError> {
        let top = top(shaft, options);
        let each = in_parallel(&tiles(range, top), |band| {
            Ok((*band, records.iter().map(|(transformed, _)| thinned(transformed, *band, top)).collect::<Vec<_>>()))
        })?;
        let rates = each.first().map_or(vec![1.0], |(_, e)| rates_of(e, records));
        Ok(Envelopes { each, rates })
    }

    /// Length of the shortest record, s.
    pub(super) fn shortest(&self) -> f64 {
        let each = self.each.first().map_or(&[][..], |(_, each)| each);
        let seconds = each.iter().zip(&self.rates).map(|(e, rate)| e.values.len() as f64 / rate);
        seconds.reduce(f64::min).unwrap_or(0.0)
    }

    /// Mean of those of a band, in the signal's unit, and their spectrum up to the highest line sought.
    pub(super) fn spectrum(
        &self,
        envelopes: &[Thinned],
        shaft: f64,
        options: &Options,
    ) -> Result<(f64, Spectrum), AnalysisError> {
        spectrum_of(envelopes, &self.rates, shaft, options)
    }
}

fn rates_of(envelopes: &[Thinned], records: &[Paced]) -> Vec<f64> {
    let rate = |(envelope, (transformed, pace)): (&Thinned, &Paced)| {
        pace * (transformed.sample_rate() * envelope.values.len() as f64 / transformed.samples() as f64)
    };
    envelopes.iter().zip(records).map(rate).collect()
}

/// A band's envelope, thinned out as far as lines up to `top` Hz allow.
fn thinned(transformed: &Transformed, band: Band, top: f64) -> Thinned {
    let samples = transformed.samples();
    // Triangles over two stretches are filter enough: of the envelope as it is taken, what folds back onto the highest
    // line sought has been brought down by 34 dB.
    let factor = ((transformed.sample_rate() / (ENVELOPE_RATE * top)).floor() as usize).max(1);
    let count = fast_up_to((samples / factor).max(64.min(samples)));
    transformed.envelope(band, count)
}

/// An envelope less its mean, at equal angles of the shaft where its speed varies; and the rate that it is then sampled
/// at, Hz.
fn at_angles(envelope: &Thinned, rate: f64, shaft: f64, options: &Options) -> Result<(Vec<f64>, f64), AnalysisError> {
    let values: Vec<f64> = (envelope.values.iter()).map(|v| v - envelope.mean).collect();
    let Some(rotation) = &options.rotation else {
        return Ok((values, rate));
    };
    let per_turn = (rate / shaft).round().max(4.0) as usize;
    let values = resample(&values, rate, rotation, per_turn)?.values;
    Ok((values, per_turn as f64 * shaft))
}

/// A job for each, as many at a time as there are cores; results in the order of what they are of.
fn in_parallel<T: Sync, R: Send>(
    of: &[T],
    one: impl Fn(&T) -> Result<R, AnalysisError> + Sync,
) -> Result<Vec<R>, AnalysisError> {
    parallel::map(of.len(), parallel::threads(of.len()), |k| one(&of[k])).into_iter().collect()
}
