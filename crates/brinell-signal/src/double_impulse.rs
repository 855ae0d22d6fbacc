//! Entry and exit of a defect: how far apart in time, and what length that implies.
//!
//! A rolling element that passes a spall causes two impulses: where it enters, and where it hits the far edge or
//! leaves. The time between the two is the spall's length over the speed of the contact: N. Sawalhi and R. B. Randall,
//! "Vibration response of spalled rolling element bearings: observations, simulations and signal processing techniques
//! to track the spall size", Mech. Syst. Signal Process. 25 (2011) 846-870.
//!
//! Three ways to the time, all from the squared envelope of a band: the [autocorrelation](Method::Autocorrelation), in
//! which every pair adds up at its separation; the power [cepstrum](Method::Cepstrum), in which the ripple that a pair
//! prints on the spectrum becomes a peak; and [pairs](Method::Pairs) of peaks, one in each repetition period. Each
//! compares parts of the signal with each other to say how far its peak is above what they scatter by. None can tell
//! entry and exit from two defects, or from two resonances that ring one after the other: the longest separation
//! searched should be that of the longest defect considered, well below half a repetition period.

use realfft::RealToComplex;
use realfft::num_complex::Complex;
use std::sync::Arc;

use super::envelope::{Band, envelope};
use super::error::{SignalError, check, require};
use super::indicators::Moments;

/// Parts that a signal is divided into.
const PARTS: usize = 16;
/// Fewest of them.
const FEWEST_PARTS: usize = 6;
/// A part lasts this many times the longest separation, at least.
const PART_LENGTH: f64 = 4.0;
/// A peak is reported from this many standard errors on.
const CLEAR: f64 = 5.0;
/// Pairs agree within this share of the separation, or two samples.
const AGREEMENT: f64 = 0.08;
/// A second peak counts from this share of the first on.
const SECOND_PEAK: f64 = 0.15;

/// Where to look.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeparationSearch {
    /// Band whose envelope is taken, Hz; wide, so that it resolves the separation: two pulses closer than about
    /// 1 / width merge.
    pub band: Band,
    /// Shortest separation, s: longer than an impact rings.
    pub shortest: f64,
    /// Longest separation, s: below half a repetition period.
    pub longest: f64,
    /// Repetition frequency of the pairs, Hz.
    pub repetition: f64,
}

/// Way in which a separation was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Method {
    /// Peak of the squared envelope's autocorrelation.
    Autocorrelation,
    /// Peak of its power cepstrum.
    Cepstrum,
    /// Median distance of the two highest peaks of each repetition period.
    Pairs,
}

/// A separation of two impulses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Separation {
    /// s.
    pub time: f64,
    /// Standard uncertainty, s, from the scatter over parts of the signal or over pairs, a tenth of a sample at the
    /// least. Systematic errors (which instant of a passage an impulse marks) are not in it.
    pub uncertainty: f64,
    /// How many standard errors the finding is above chance; 5 or more.
    pub clearance: f64,
    /// How it was found.
    pub method: Method,
}

/// Separations that the three methods find, in their order; those that find none are missing.
///
/// # Errors
/// [`SignalError`] where the signal is shorter than 24 times the longest separation or 6 periods, has samples that are
/// not finite, or the search is out of range.
pub fn separations(x: &[f64], fs: f64, search: &SeparationSearch) -> Result<Vec<Separation>, SignalError> {
    let squared = squared_envelope(x, fs, search)?;
    let lags = Lags::new(fs, search);
    let parts = Parts::new(&squared, fs, search);
    let found = [
        parts.peak(&squared, &lags, Method::Autocorrelation),
        parts.peak(&squared, &lags, Method::Cepstrum),
        pairs(&squared, fs, search, &lags),
    ];
    Ok(found.into_iter().flatten().collect())
}

/// The separation on which at least two methods agree, within three standard uncertainties and 3 %: that of the
/// smallest uncertainty among them. `None` where they do not agree.
pub fn consensus(separations: &[Separation]) -> Option<Separation> {
    let agrees = |a: &Separation, b: &Separation| {
        let allowed = 3.0 * a.uncertainty.hypot(b.uncertainty) + 0.03 * a.time.max(b.time);
        a.method != b.method && (a.time - b.time).abs() <= allowed
    };
    (separations.iter().copied())
        .filter(|a| separations.iter().any(|b| agrees(a, b)))
        .min_by(|a, b| a.uncertainty.total_cmp(&b.uncertainty))
}

/// What the two impulses mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Events {
    /// The contact reaches the near and the far edge: the roller follows the floor, or carries load again only past the
    /// far edge. Length = speed times separation.
    BothEdges,
    /// The contact reaches the near edge; later the roller, bridging the defect, hits the far edge when its centre is
    /// over the middle. Length = twice speed times separation (Sawalhi and Randall 2011, for defects in which the
    /// roller does not reach the floor).
    EdgeAndImpact,
}

/// A defect's length along the rolling direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DefectLength {
    /// m.
    pub length: f64,
    /// Standard uncertainty from the separation's and the speed's, m; which events were seen is not in it.
    pub uncertainty: f64,
}

/// The length that a separation implies, where the contact moves along the damaged surface at `speed` (m/s, either
/// sense, with its standard uncertainty): R_o times the orbit speed on an outer raceway at rest, R_i times the
/// orbit speed relative to the inner ring on an inner raceway.
pub fn defect_length(separation: &Separation, speed: f64, speed_uncertainty: f64, events: Events) -> DefectLength {
    let factor = match events {
        Events::BothEdges => 1.0,
        Events::EdgeAndImpact => 2.0,
    };
    DefectLength {
        length: factor * speed.abs() * separation.time,
        uncertainty: factor * (speed * separation.uncertainty).hypot(speed_uncertainty * separation.time),
    }
}

fn squared_envelope(x: &[f64], fs: f64, search: &SeparationSearch) -> Result<Vec<f64>, SignalError> {
    check(x, fs, 64, "a search for double impulses")?;
    let SeparationSearch { band, shortest, longest, repetition } = *search;
    require(
        band.low >= 0.0 && band.low < band.high && band.low < 0.5 * fs,
        "lower edge of the band (Hz)",
        band.low,
        "0 to below the upper edge and half the sampling rate",
    )?;
    require(
        repetition > 0.0 && repetition < 0.25 * fs,
        "repetition frequency (Hz)",
        repetition,
        "above 0, below a quarter of the sampling rate",
    )?;
    require(longest <= 0.5 / repetition, "longest separation (s)", longest, "at most half a repetition period")?;
    require(
        shortest > 0.0 && shortest * fs >= 2.0 && longest * fs >= shortest * fs + 4.0,
        "shortest separation (s)",
        shortest,
        "at least 2 samples, and 4 samples below the longest",
    )?;
    let need = (FEWEST_PARTS as f64 * fs * (PART_LENGTH * longest).max(1.0 / repetition)).ceil();
    check(x, fs, need as usize, "a search for double impulses")?;
    let mut e = envelope(x, fs, band).unwrap_or_default();
    e.iter_mut().for_each(|e| *e *= *e);
    Ok(e)
}

/// The search in samples.
struct Lags {
    fs: f64,
    first: usize,
    last: usize,
}

impl Lags {
    fn new(fs: f64, search: &SeparationSearch) -> Self {
        Lags { fs, first: (search.shortest * fs).ceil() as usize, last: (search.longest * fs).floor() as usize }
    }
}

/// Parts of a signal, transformed one by one.
struct Parts {
    length: usize,
    count: usize,
    fft: Arc<dyn RealToComplex<f64>>,
}

impl Parts {
    fn new(x: &[f64], fs: f64, search: &SeparationSearch) -> Self {
        let shortest = fs * (PART_LENGTH * search.longest).max(1.0 / search.repetition);
        let count = ((x.len() as f64 / shortest) as usize).clamp(FEWEST_PARTS, PARTS);
        let length = x.len() / count;
        let fft = crate::fft::forward((2 * length).next_power_of_two());
        Parts { length, count, fft }
    }

    /// By lag: the function's mean over the parts and its standard error, in units of its value at lag 0; then its most
    /// prominent peak.
    fn peak(&self, x: &[f64], lags: &Lags, method: Method) -> Option<Separation> {
        let curves: Vec<Vec<f64>> =
            x.chunks_exact(self.length).take(self.count).map(|part| self.curve(part, lags.last + 2, method)).collect();
        let mut mean = vec![0.0; lags.last + 2];
        let mut error = vec![0.0; lags.last + 2];
        for lag in 0..mean.len() {
            let mut moments = Moments::new();
            curves.iter().for_each(|c| moments.push(c[lag]));
            mean[lag] = moments.mean();
            error[lag] = moments.standard_deviation() / ((self.count - 1) as f64).sqrt();
        }
        let (lag, prominence) = most_prominent(&mean, lags.first, lags.last)?;
        // The scatter of one lag is itself uncertain: take the neighbourhood's.
        let about = &error[lag.saturating_sub(8).max(1)..(lag + 9).min(error.len())];
        let scatter = (about.iter().map(|e| e * e).sum::<f64>() / about.len() as f64).sqrt();
        let clearance = prominence / scatter;
        if clearance.is_nan() || clearance < CLEAR {
            return None;
        }
        let time = refine(&mean, lag);
        // Where each part has its own peak nearby.
        let reach = ((AGREEMENT * lag as f64) as usize).max(2);
        let mut places = Moments::new();
        for curve in &curves {
            let range = (lag - reach).max(1)..=(lag + reach).min(lags.last);
            let top = range.max_by(|&a, &b| curve[a].total_cmp(&curve[b]))?;
            places.push(refine(curve, top));
        }
        let spread = places.standard_deviation() / ((self.count - 1) as f64).sqrt();
        Some(Separation { time: time / lags.fs, uncertainty: spread.max(0.1) / lags.fs, clearance, method })
    }

    /// Autocorrelation or cepstrum of a part, lags 0 to `count` - 1.
    fn curve(&self, part: &[f64], count: usize, method: Method) -> Vec<f64> {
        const MADE: &str = "buffers were made by the plan";
        let mean = part.iter().sum::<f64>() / part.len() as f64;
        let mut input = self.fft.make_input_vec();
        for (to, v) in input.iter_mut().zip(part) {
            *to = v - mean;
        }
        let mut output = self.fft.make_output_vec();
        self.fft.process(&mut input, &mut output).expect(MADE);
        let total: f64 = output.iter().map(|v| v.norm_sqr()).sum::<f64>() / output.len() as f64;
        let smallest = (1e-12 * total).max(f64::MIN_POSITIVE);
        // A real, even sequence: its transform is the inverse one, over its length.
        for (k, v) in output.iter().enumerate() {
            let power = v.norm_sqr();
            let value = if method == Method::Cepstrum { power.max(smallest).ln() } else { power };
            input[k] = value;
            let mirrored = (self.fft.len() - k) % self.fft.len();
            input[mirrored] = value;
        }
        let mut result: Vec<Complex<f64>> = self.fft.make_output_vec();
        self.fft.process(&mut input, &mut result).expect(MADE);
        let scale = match method {
            Method::Cepstrum => 1.0 / self.fft.len() as f64,
            _ if result[0].re > 0.0 => 1.0 / result[0].re,
            _ => 0.0,
        };
        (result.iter().take(count)).map(|v| v.re * scale).collect()
    }
}

/// The local maximum within `first..=last` that rises most above the higher of the lowest values to its two sides.
fn most_prominent(curve: &[f64], first: usize, last: usize) -> Option<(usize, f64)> {
    let n = last + 1;
    // Lowest to the left of each, from the last higher value on, would be the strict definition; the lowest from the
    // start of the search on is the same for the highest peak and kinder to a peak on a falling flank.
    let mut left = vec![f64::INFINITY; n + 1];
    for i in first..n {
        left[i + 1] = left[i].min(curve[i]);
    }
    let mut right = f64::INFINITY;
    let mut best: Option<(usize, f64)> = None;
    for i in (first..n).rev() {
        let is_top = i > first && i < last && curve[i] > curve[i - 1] && curve[i] >= curve[i + 1];
        if is_top {
            let prominence = curve[i] - left[i].max(right);
            if prominence > best.map_or(0.0, |b| b.1) {
                best = Some((i, prominence));
            }
        }
        right = right.min(curve[i]);
    }
    best
}

/// A maximum between samples, by a parabola.
fn refine(curve: &[f64], top: usize) -> f64 {
    if top == 0 || top + 1 >= curve.len() {
        return top as f64;
    }
    let (left, middle, right) = (curve[top - 1], curve[top], curve[top + 1]);
    let bend = left - 2.0 * middle + right;
    let offset = if bend < 0.0 { 0.5 * (left - right) / bend } else { 0.0 };
    top as f64 + offset.clamp(-0.5, 0.5)
}

/// Distances of the two highest peaks of each period.
fn pairs(x: &[f64], fs: f64, search: &SeparationSearch, lags: &Lags) -> Option<Separation> {
    let period = fs / search.repetition;
    let count = (x.len() as f64 / period) as usize;
    let mut distances = Vec::with_capacity(count);
    for k in 0..count {
        let start = (k as f64 * period) as usize;
        let end = ((k + 1) as f64 * period) as usize;
        // A pair may straddle the period's end, so the partner is sought outside as well.
        let top = (start..end.min(x.len())).max_by(|&a, &b| x[a].total_cmp(&x[b]))?;
        let before = top.saturating_sub(lags.last).max(1)..(top + 1).saturating_sub(lags.first);
        let after = top + lags.first..(top + lags.last + 1).min(x.len() - 1);
        let partner = before
            .chain(after)
            .filter(|&i| x[i] > x[i - 1] && x[i] >= x[i + 1] && x[i] >= SECOND_PEAK * x[top])
            .max_by(|&a, &b| x[a].total_cmp(&x[b]));
        distances.extend(partner.map(|p| (refine(x, p) - refine(x, top)).abs()));
    }
    // The distance about which the most of them gather.
    distances.sort_by(f64::total_cmp);
    let width = |d: f64| (AGREEMENT * d).max(2.0);
    let gathered = |d: f64| {
        let from = distances.partition_point(|v| *v < d - width(d));
        let to = distances.partition_point(|v| *v <= d + width(d));
        from..to
    };
    let densest = (distances.iter().map(|d| gathered(*d))).max_by_key(|r| r.len())?;
    let near = &distances[densest.clone()];
    let time = near[near.len() / 2];
    // By chance they would lie anywhere in the range searched.
    let share = (2.0 * width(time) / (lags.last - lags.first) as f64).min(1.0);
    let n = distances.len() as f64;
    let expected = n * share;
    let clearance = (near.len() as f64 - expected) / (expected * (1.0 - share)).max(1.0).sqrt();
    if near.len() < 5 || clearance < CLEAR {
        return None;
    }
    let mut scatter = Moments::new();
    near.iter().for_each(|d| scatter.push(*d));
    let spread = scatter.standard_deviation() / (near.len() as f64).sqrt();
    Some(Separation { time: time / fs, uncertainty: spread.max(0.1) / fs, clearance, method: Method::Pairs })
}

#[cfg(test)]
mod tests {
    use super::super::test_signals::{ImpactTrain, Noise};
    use super::*;

    const FS: f64 = 51_200.0;

    fn search() -> SeparationSearch {
        SeparationSearch { band: Band::between(4000.0, 16_000.0), shortest: 4e-4, longest: 4e-3, repetition: 87.0 }
    }

    /// Impacts at 87 Hz, each followed by one of `second` times its height, `separation` s later.
    fn double(separation: f64, second: f64, noise: f64, seed: u64) -> Vec<f64> {
        let n = 102_400;
        let train = ImpactTrain { fs: FS, rate: 87.0, jitter: 0.005, resonance: 9000.0, decay: 1e-4, noise: 0.0 };
        let single = train.generate(n, seed);
        let shift = (separation * FS).round() as usize;
        let mut random = Noise::new(seed + 77);
        (0..n)
            .map(|i| {
                let later = if i >= shift { single[i - shift] } else { 0.0 };
                single[i] + second * later + noise * random.normal()
            })
            .collect()
    }

    #[test]
    fn analytic_separation_is_found_by_each_method() {
        for (separation, seed) in [(1e-3, 1), (1.7e-3, 2), (2.9e-3, 3)] {
            let exact = (separation * FS).round() / FS;
            let found = separations(&double(separation, 0.8, 0.05, seed), FS, &search()).unwrap();
            assert_eq!(found.len(), 3, "{separation} {found:?}");
            for s in &found {
                assert!((s.time - exact).abs() < 1.5 / FS, "{exact} {s:?}");
                assert!(s.uncertainty < 1.0 / FS, "{s:?}");
            }
            let one = consensus(&found).unwrap();
            assert!((one.time - exact).abs() < 1.0 / FS);
        }
    }

    #[test]
    fn prop_single_impulses_and_noise_have_no_consensus() {
        for seed in 0..20 {
            for x in [double(1e-3, 0.0, 0.05, seed), Noise::new(seed).normals(102_400)] {
                let found = separations(&x, FS, &search()).unwrap();
                assert_eq!(consensus(&found), None, "{seed} {found:?}");
            }
        }
    }

    #[test]
    fn analytic_length() {
        let separation = Separation { time: 1e-3, uncertainty: 1e-5, clearance: 9.0, method: Method::Pairs };
        let length = defect_length(&separation, -2.0, 0.0, Events::BothEdges);
        assert!((length.length - 2e-3).abs() < 1e-18 && (length.uncertainty - 2e-5).abs() < 1e-18);
        let length = defect_length(&separation, 2.0, 0.02, Events::EdgeAndImpact);
        assert!((length.length - 4e-3).abs() < 1e-18);
        assert!((length.uncertainty - 2f64.sqrt() * 4e-5).abs() < 1e-18);
    }

    #[test]
    fn prop_bad_input_is_an_error() {
        let x = Noise::new(1).normals(102_400);
        let bad = |change: fn(&mut SeparationSearch)| {
            let mut search = search();
            change(&mut search);
            separations(&x, FS, &search).is_err()
        };
        assert!(bad(|s| s.longest = 1e-2));
        assert!(bad(|s| s.shortest = 0.0));
        assert!(bad(|s| s.shortest = f64::NAN));
        assert!(bad(|s| s.shortest = 5e-3));
        assert!(bad(|s| s.band = Band::above(30_000.0)));
        assert!(bad(|s| s.repetition = f64::INFINITY));
        assert!(separations(&x[..2000], FS, &search()).is_err());
        assert!(separations(&[f64::NAN; 9000], FS, &search()).is_err());
        let zero = separations(&vec![0.0; 102_400], FS, &search()).unwrap();
        assert!(zero.is_empty(), "{zero:?}");
    }
}
