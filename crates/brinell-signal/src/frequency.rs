//! The precise rate of a train of impacts, with its uncertainty.
//!
//! The envelope of a resonance band repeats with the impacts, so its spectrum is a comb at h f, h = 1, 2, ... The
//! rate is where the comb is strongest: it maximises
//!
//! J(f) = sum over h of P(h f) / N_h,
//!
//! with P the power spectrum of the mean-free, Hann-windowed envelope, interpolated by zero padding, and N_h the
//! noise around harmonic h. For white noise this is the approximate maximum-likelihood estimate of a periodic
//! signal's frequency (B. G. Quinn and E. J. Hannan, "The estimation and tracking of frequency", Cambridge 2001,
//! chapter 5). Harmonic h sees a shift of f as one of h f, so a comb resolves far better than its first line.
//!
//! The uncertainty is the first-order perturbation of the maximum. With time n counted from the window's middle,
//! W0 = sum w, W1 = sum w^2, W2 = sum n^2 w, V = sum n^2 w^2, and E the transform under P, its variance in
//! (rad/sample)^2 is
//!
//! var = S V W0^2 / (W2 sum of h^2 |E(h f)|^2 / N_h)^2,
//!
//! where S is the variance per sample of the combined quadrature noise Im sum h E*(h f) nu_h / N_h. It is measured
//! where there is no line: Z(d) = sum h E*(h f) E(h f + d) / N_h at a common offset d from every harmonic, and
//! S = |Z(d) - Z*(-d)|^2 / (4 W1). Taking the harmonics together matters: an impact that comes late is late in every
//! harmonic, so timing errors do not average out over the comb as additive noise does. For one harmonic, a rectangular
//! window and white noise the formula is the Cramer-Rao bound 24 sigma^2 / (A^2 n^3).

mod padded;
mod wander;

use std::f64::consts::{LN_2, TAU};

use realfft::num_complex::Complex;

use self::padded::PADDING;
pub(super) use self::padded::Padded;
pub use self::wander::mean_rate_uncertainty;

use super::distribution::chi_square_tail;
use super::indicators::Moments;
use super::spectrum::FEWEST_SAMPLES;

/// Half-width of the band around a harmonic from which its noise is taken, in bins of the segment; in short records
/// less, so as to stay clear of the next harmonic.
const NOISE_BINS: usize = 48;
/// Bins on either side of a harmonic that its own line fills with Hann, and one for the width of a jittered line.
const LINE_BINS: usize = 3;
/// Shortest record, in periods of the nominal frequency: below it too little is left between the lines of a comb.
#[doc(hidden)]
pub const FEWEST_PERIODS: f64 = 24.0;
/// Highest nominal frequency, as a share of the sampling rate.
const HIGHEST_NOMINAL: f64 = 0.4;
/// Lowest noise that a line is weighed against, as a share of the strongest power: the round-off and leakage that a
/// noiseless signal still has.
const NOISE_FLOOR: f64 = 1e-9;
/// Independent places at which a comb may lie, for each bin of its highest harmonic: Hann's lines are smooth, but the
/// maximum is sought between bins too.
const PLACES_PER_BIN: f64 = 3.0;
/// What interpolation adds to the uncertainty, in bins of the highest harmonic that counts.
const INTERPOLATION_ERROR: f64 = 1e-3;
/// A slow wander f(t) of the rate moves the maximum by the integral of v(t) f(t), where v(t) is proportional to the
/// integral of n w(n) from t to the segment's end, and of integral 1: the phase's regression on time under the window.
/// With the segment as the unit of time and Hann's window, the integral of v^2, and that of v(t) v(t + 1/2).
const HANN_SQUARE: f64 = 1.684_784;
const HANN_OVERLAP: f64 = 0.165_977;
/// A comb that noise alone would show more often than this is not reported.
const FALSE_ALARM_LIMIT: f64 = 1e-4;
/// The same of its harmonics but the strongest, where that is not the fundamental, at the place that this one tells; and
/// of those between every second or third.
const OTHERS_LIMIT: f64 = 1e-2;
/// Distance from the place of a comb, relative, at which its fundamental may lie where the rate swings.
const LOBES: f64 = 0.02;

/// What to look for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineSearch {
    /// Expected repetition frequency, Hz.
    pub nominal: f64,
    /// Half the range searched, as a share of `nominal`; above 0, at most 0.3.
    pub tolerance: f64,
    /// Harmonics of the comb, the fundamental included, 1 or more; those above half the sampling rate are left out.
    pub harmonics: usize,
}

impl LineSearch {
    /// A comb of eight harmonics within 2 % of `nominal` (Hz).
    pub fn new(nominal: f64) -> Self {
        LineSearch { nominal, tolerance: 0.02, harmonics: 8 }
    }

    /// Whether so many samples at `fs` Hz hold what the search needs: 24 periods of the nominal frequency, that below
    /// 0.4 `fs`, and the range below half of `fs`.
    pub fn fits(&self, samples: usize, fs: f64) -> bool {
        let fewest = (FEWEST_PERIODS * fs / self.nominal).max(FEWEST_SAMPLES as f64);
        let top = self.nominal * (1.0 + self.tolerance);
        samples as f64 >= fewest && self.nominal < HIGHEST_NOMINAL * fs && top < 0.5 * fs
    }
}

/// A repetition frequency found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineFrequency {
    /// Hz.
    pub frequency: f64,
    /// Standard uncertainty (one sigma), Hz. From one segment, the spread that noise and independent timing errors of
    /// the impacts cause; slow wander of the rate within the segment is not in it. From three segments on, the
    /// observed spread of their estimates instead, wander included.
    pub uncertainty: f64,
    /// The part of the uncertainty that noise and independent timing errors cause, Hz; slow wander of the rate is not
    /// in it.
    pub noise: f64,
    /// Time over which a slow wander of the rate is averaged, s: where the rate has spectral density S at frequency
    /// zero (two-sided), the frequency scatters by sqrt(S / span). Hann's window makes it shorter than the record.
    pub span: f64,
    /// Distance at which two trains of impacts would show two fundamentals, Hz: two bins of the segment.
    pub resolution: f64,
}

/// The mean of estimates from segments that overlap by half.
///
/// The uncertainty counts two overlapping segments as one, which is on the safe side, and never falls below a
/// thousandth of a bin: the interpolation's error is the same in every segment of a steady signal.
#[derive(Debug, Clone, Default)]
pub(super) struct LineAverage {
    frequencies: Moments,
    sum_of_variances: f64,
    latest: Option<LineFrequency>,
}

impl LineAverage {
    pub(super) fn add(&mut self, found: Option<LineFrequency>) {
        let Some(found) = found else { return };
        self.frequencies.push(found.frequency);
        self.sum_of_variances += found.uncertainty * found.uncertainty;
        self.latest = Some(found);
    }

    /// `None` where no segment showed the line.
    pub(super) fn finish(&self) -> Option<LineFrequency> {
        let latest = self.latest?;
        let count = self.frequencies.count();
        if count == 1 {
            return Some(latest);
        }
        let n = count as f64;
        let interpolation = INTERPOLATION_ERROR * 0.5 * latest.resolution;
        let of_mean = |variance: f64| (variance / (0.5 * (n + 1.0))).sqrt().hypot(interpolation);
        let noise = of_mean(self.sum_of_variances / n);
        let uncertainty =
            if count >= 3 { of_mean(self.frequencies.standard_deviation().powi(2) * n / (n - 1.0)) } else { noise };
        Some(LineFrequency {
            frequency: self.frequencies.mean(),
            uncertainty,
            noise,
            span: latest.span * HANN_SQUARE * n * n / (n * HANN_SQUARE + 2.0 * (n - 1.0) * HANN_OVERLAP),
            ..latest
        })
    }
}

/// The estimate for segments of one length.
pub(super) struct Comb {
    fs: f64,
    length: usize,
    search: LineSearch,
    /// W0 / W2 (V / W1)^(1/2), in Hz: the factor between noise and uncertainty.
    spread: f64,
    /// Offsets from a harmonic, in bins of the segment, where its noise is looked for: to this one.
    farthest: usize,
    /// N_h of each harmonic.
    noise: Vec<f64>,
    /// Room for medians.
    values: Vec<f64>,
}

impl Comb {
    pub(super) fn new(fs: f64, window: &[f64], search: &LineSearch) -> Self {
        let length = window.len();
        assert!(
            search.nominal > 0.0 && search.nominal.is_finite(),
            "nominal frequency {} Hz is not positive",
            search.nominal
        );
        assert!(
            search.tolerance > 0.0 && search.tolerance <= 0.3,
            "tolerance {} is not above 0 and at most 0.3",
            search.tolerance
        );
        let periods = length as f64 * search.nominal / fs;
        assert!(search.fits(length, fs), "a segment lasts {periods} nominal periods, fewer than {FEWEST_PERIODS}");
        assert!(search.harmonics > 0, "a comb of no harmonics");
        let highest = (0.5 * fs / (search.nominal * (1.0 + search.tolerance))).ceil() as usize;
        // Below half the sampling rate: one at least, or the search would not fit.
        let harmonics = search.harmonics.min(highest - 1);

        let (mut w0, mut w1, mut w2, mut v) = (0.0, 0.0, 0.0, 0.0);
        for (i, w) in window.iter().enumerate() {
            // The periodic Hann window is symmetric about length / 2.
            let n = i as f64 - 0.5 * length as f64;
            w0 += w;
            w1 += w * w;
            w2 += n * n * w;
            v += n * n * w * w;
        }
        Comb {
            fs,
            length,
            search: *search,
            spread: fs / TAU * w0 / w2 * (v / w1).sqrt(),
            farthest: NOISE_BINS.min((0.5 * periods) as usize - LINE_BINS),
            noise: vec![0.0; harmonics],
            values: Vec::with_capacity(2 * NOISE_BINS + 1),
        }
    }

    /// Distance between bins of a segment, Hz.
    fn bin(&self) -> f64 {
        self.fs / self.length as f64
    }

    /// Highest frequency that it looks at, Hz.
    pub(super) fn highest(&self) -> f64 {
        let harmonic = self.noise.len() as f64 * self.search.nominal;
        harmonic * (1.0 + self.search.tolerance) + self.farthest as f64 * self.bin()
    }

    fn resolution(&self) -> f64 {
        2.0 * self.bin()
    }

    pub(super) fn estimate(&mut self, e: &Padded) -> Option<LineFrequency> {
        self.measure_noise(e);

        let harmonics = self.noise.len() as f64;
        let bin = self.bin();
        let half_range = self.search.tolerance * self.search.nominal;
        let half_steps = (half_range * harmonics * PADDING as f64 / bin).ceil().max(2.0);
        let step = half_range / half_steps;
        let start = self.search.nominal - half_range;
        let steps = 2 * half_steps as usize;
        let comb = |i: usize| self.height(e, start + step * i as f64);

        let (mut top, mut highest) = (0, comb(0));
        for i in 1..=steps {
            let height = comb(i);
            if height > highest {
                (top, highest) = (i, height);
            }
        }
        if top == 0 || top == steps || !highest.is_finite() {
            return None;
        }
        let (left, right) = (comb(top - 1), comb(top + 1));
        let offset = 0.5 * (left - right) / (left - 2.0 * highest + right);
        let frequency = start + step * (top as f64 + offset);

        let trials = 1.0 + PLACES_PER_BIN * 2.0 * half_range * harmonics / bin;
        // Of noise, each harmonic's power over its mean is exponentially distributed.
        if trials * chi_square_tail(2.0 * highest, 2.0 * harmonics) > FALSE_ALARM_LIMIT || self.is_another(e, frequency)
        {
            return None;
        }
        let uncertainty = self.uncertainty(e, frequency);
        Some(LineFrequency {
            frequency,
            uncertainty,
            noise: uncertainty,
            span: self.length as f64 / self.fs / HANN_SQUARE,
            resolution: self.resolution(),
        })
    }

    /// Whether it is a comb of something else, whose rate has harmonics there: one harmonic alone makes it, and is not the
    /// fundamental, or every second or third one. These tell the place, so that the others are looked for at one place
    /// alone.
    fn is_another(&self, e: &Padded, f: f64) -> bool {
        let strongest = (1..=self.noise.len()).map(|h| (h, self.ratio(e, f, h))).max_by(|a, b| a.1.total_cmp(&b.1));
        strongest.is_some_and(|(h, ratio)| {
            let others = 2.0 * (self.noise.len() as f64 - 1.0);
            h > 1 && chi_square_tail(2.0 * (self.height(e, f) - ratio), others) > OTHERS_LIMIT
        }) || [2, 3].into_iter().any(|every| {
            let between = (1..=self.noise.len()).filter(|h| h % every != 0).map(|h| self.ratio(e, f, h));
            let (count, sum) = between.fold((0.0, 0.0), |(count, sum), ratio| (count + 1.0, sum + ratio));
            chi_square_tail(2.0 * sum, 2.0 * count) > OTHERS_LIMIT
        }) && !self.fundamental_near(e, f)
    }

    /// Whether the fundamental rises near `f`, if not there. A rate that swings splits each line into lobes: the highest of
    /// every second harmonic may lie where the fundamental has none. Higher harmonics are not asked, because lines of
    /// others lie within their reach.
    fn fundamental_near(&self, e: &Padded, f: f64) -> bool {
        let bins = LOBES * f / self.bin();
        let steps = (bins * PADDING as f64).ceil();
        let places = (-steps as isize..=steps as isize).map(|i| f * (1.0 + LOBES * i as f64 / steps));
        let highest = places.map(|f| self.ratio(e, f, 1)).fold(0.0, f64::max);
        (1.0 + PLACES_PER_BIN * 2.0 * bins) * chi_square_tail(2.0 * highest, 2.0) < FALSE_ALARM_LIMIT
    }

    /// N_h: the median power around a harmonic, over ln 2 (exponentially distributed powers). The median passes over
    /// the line itself and its sidebands.
    fn measure_noise(&mut self, e: &Padded) {
        let powers = e.values.iter().map(|e| e.norm_sqr());
        let strongest = powers.fold(0.0, f64::max);
        let points = (PADDING * self.length) as f64;
        for (h, noise) in self.noise.iter_mut().enumerate() {
            let center = (h + 1) as f64 * self.search.nominal / self.fs * points;
            let reach = self.farthest as isize;
            self.values.clear();
            for offset in -reach..=reach {
                let at = (center + (offset * PADDING as isize) as f64) as usize;
                self.values.extend(e.values.get(at).map(|e| e.norm_sqr()));
            }
            *noise = (median(&mut self.values) / LN_2).max(NOISE_FLOOR * strongest);
        }
    }

    /// J(f).
    fn height(&self, e: &Padded, f: f64) -> f64 {
        (1..=self.noise.len()).map(|h| self.ratio(e, f, h)).sum()
    }

    /// P(h f) / N_h.
    fn ratio(&self, e: &Padded, f: f64, h: usize) -> f64 {
        e.at(h as f64 * f).norm_sqr() / self.noise[h - 1]
    }

    /// Standard uncertainty of a maximum of J, Hz (see the module).
    fn uncertainty(&mut self, e: &Padded, f: f64) -> f64 {
        let bin = self.bin();
        let (mut information, mut highest_order) = (0.0, 1.0);
        for h in 1..=self.noise.len() {
            let order = h as f64;
            let ratio = self.ratio(e, f, h);
            if ratio > 2.0 {
                highest_order = order;
            }
            information += order * order * ratio;
        }
        let mut values = std::mem::take(&mut self.values);
        values.clear();
        for offset in LINE_BINS..=self.farthest {
            let offset = offset as f64 * bin;
            let mut quadrature = Complex::new(0.0, 0.0);
            for (h, noise) in self.noise.iter().enumerate() {
                let order = (h + 1) as f64;
                let line = e.at(order * f);
                let above = line.conj() * e.at(order * f + offset);
                let below = line * e.at(order * f - offset).conj();
                quadrature += (above - below) * (0.5 * order / noise);
            }
            values.push(quadrature.norm_sqr());
        }
        let noise = (median(&mut values) / LN_2).sqrt();
        self.values = values;
        (self.spread * noise / information).hypot(INTERPOLATION_ERROR * bin / highest_order)
    }
}

/// The middle value, the upper of two; reorders.
pub(crate) fn median(values: &mut [f64]) -> f64 {
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

#[cfg(test)]
mod tests;
