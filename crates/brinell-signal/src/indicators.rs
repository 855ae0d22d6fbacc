//! Condition indicators of samples, and the moments that they are made of.
//!
//! [`Moments`] gathers one pass over a signal. What a run or a measurement reports, with intervals, is made of one such
//! pass per revolution: [`Blocks`](super::blocks::Blocks).
//!
//! Definitions, over n samples x with mean m and central moments M_p = sum (x - m)^p / n: RMS sqrt(sum x^2 / n), about
//! zero (ISO 20816-1, ISO 13373-2); standard deviation sqrt(M_2), the population's, so that RMS^2 = m^2 + M_2; peak max
//! |x|; crest factor peak / RMS; shape factor RMS / mean |x|; impulse factor peak / mean |x|; skewness M_3 / M_2^1.5;
//! kurtosis M_4 / M_2^2, which is 3 for a normal distribution. Over a record of several revolutions the peaks are those
//! of a revolution, see [`blocks`](super::blocks).

/// A condition indicator. Values up to `PeakToPeak` carry the signal's unit, the others are pure numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Indicator {
    /// Root mean square, about zero.
    Rms,
    /// Mean.
    Mean,
    /// Standard deviation: root mean square about the mean.
    StandardDeviation,
    /// Largest absolute value.
    Peak,
    /// Largest less smallest value.
    PeakToPeak,
    /// Peak over RMS.
    CrestFactor,
    /// Fourth standardised moment; 3 for a normal distribution.
    Kurtosis,
    /// Third standardised moment.
    Skewness,
    /// Peak over mean absolute value.
    ImpulseFactor,
    /// RMS over mean absolute value.
    ShapeFactor,
}

impl Indicator {
    /// Every indicator, in the order of reports.
    pub const ALL: [Indicator; 10] = [
        Indicator::Rms,
        Indicator::Mean,
        Indicator::StandardDeviation,
        Indicator::Peak,
        Indicator::PeakToPeak,
        Indicator::CrestFactor,
        Indicator::Kurtosis,
        Indicator::Skewness,
        Indicator::ImpulseFactor,
        Indicator::ShapeFactor,
    ];

    /// Name, and what it is.
    fn row(self) -> (&'static str, &'static str) {
        match self {
            Indicator::Rms => ("rms", "root mean square, about zero"),
            Indicator::Mean => ("mean", "mean"),
            Indicator::StandardDeviation => ("standard_deviation", "root mean square about the mean"),
            Indicator::Peak => ("peak", "largest absolute value of a revolution, mean over the revolutions"),
            Indicator::PeakToPeak => {
                ("peak_to_peak", "largest less smallest value of a revolution, mean over the revolutions")
            }
            Indicator::CrestFactor => ("crest_factor", "mean peak of a revolution over RMS"),
            Indicator::Kurtosis => ("kurtosis", "fourth standardised moment; 3 for a normal distribution"),
            Indicator::Skewness => ("skewness", "third standardised moment"),
            Indicator::ImpulseFactor => ("impulse_factor", "mean peak of a revolution over mean absolute value"),
            Indicator::ShapeFactor => ("shape_factor", "RMS over mean absolute value"),
        }
    }

    /// Name in files and reports: `rms`, `crest_factor`, and so on.
    pub fn name(self) -> &'static str {
        self.row().0
    }

    /// What it is, in one sentence.
    pub fn meaning(self) -> &'static str {
        self.row().1
    }

    /// Whether the value cannot be negative; only mean and skewness can.
    pub fn is_positive(self) -> bool {
        !matches!(self, Indicator::Mean | Indicator::Skewness)
    }

    /// Unit of the value, of a signal in `signal`; empty of a pure number.
    pub fn unit(self, signal: &str) -> &str {
        if self.has_unit() { signal } else { "" }
    }

    /// Whether the value carries the signal's unit; otherwise it is a pure number.
    pub fn has_unit(self) -> bool {
        use Indicator::*;
        matches!(self, Rms | Mean | StandardDeviation | Peak | PeakToPeak)
    }
}

/// Moments and extremes of a stream, in one pass, mergeable.
///
/// Central moments are updated by the formulas of Chan, Golub and LeVeque (1983) and Pebay (Sandia report
/// SAND2008-6212, equations 1.5 to 3.1), which do not cancel where the mean is large against the scatter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moments {
    count: u64,
    mean: f64,
    /// Sums of (x - mean)^p, p = 2, 3, 4.
    sum2: f64,
    sum3: f64,
    sum4: f64,
    mean_absolute: f64,
    min: f64,
    max: f64,
}

impl Default for Moments {
    fn default() -> Self {
        Moments::new()
    }
}

impl Moments {
    /// Nothing seen yet.
    pub const fn new() -> Self {
        Moments {
            count: 0,
            mean: 0.0,
            sum2: 0.0,
            sum3: 0.0,
            sum4: 0.0,
            mean_absolute: 0.0,
            min: f64::INFINITY,
            max: f64::NEG_INFINITY,
        }
    }

    /// Takes one sample.
    pub fn push(&mut self, x: f64) {
        let before = self.count as f64;
        self.count += 1;
        let n = self.count as f64;
        let delta = x - self.mean;
        let step = delta / n;
        let step2 = step * step;
        let term = delta * step * before;
        self.mean += step;
        self.sum4 += term * step2 * (n * n - 3.0 * n + 3.0) + 6.0 * step2 * self.sum2 - 4.0 * step * self.sum3;
        self.sum3 += term * step * (n - 2.0) - 3.0 * step * self.sum2;
        self.sum2 += term;
        self.mean_absolute += (x.abs() - self.mean_absolute) / n;
        self.min = self.min.min(x);
        self.max = self.max.max(x);
    }

    /// Takes samples in their order: what [`push`](Self::push) of each makes of them but for rounding, several times as
    /// fast.
    pub fn extend(&mut self, x: &[f64]) {
        // As many as stay in the nearest cache from one pass to the next.
        for part in x.chunks(1024) {
            *self = self.merge(&Moments::of(part));
        }
    }

    /// Of a few samples, at least one: the mean first, then sums about it.
    fn of(x: &[f64]) -> Moments {
        let n = x.len() as f64;
        // About the first, so that the scatter of a constant is 0.
        let first = x[0];
        let [off, absolute] = sums(x, |v| [v - first, v.abs()]);
        let mean = first + off / n;
        let [sum2, sum3, sum4] = sums(x, |v| {
            let d = v - mean;
            let square = d * d;
            [square, square * d, square * square]
        });
        Moments {
            count: x.len() as u64,
            mean,
            sum2,
            sum3,
            sum4,
            mean_absolute: absolute / n,
            min: x.iter().fold(f64::INFINITY, |m, v| m.min(*v)),
            max: x.iter().fold(f64::NEG_INFINITY, |m, v| m.max(*v)),
        }
    }

    /// The moments of this stream followed by `other`.
    pub fn merge(&self, other: &Moments) -> Moments {
        if self.count == 0 {
            return *other;
        }
        if other.count == 0 {
            return *self;
        }
        let (a, b) = (self.count as f64, other.count as f64);
        let n = a + b;
        let delta = other.mean - self.mean;
        let step = delta / n;
        let sum2 = self.sum2 + other.sum2 + delta * step * a * b;
        let sum3 = self.sum3
            + other.sum3
            + delta * step * step * a * b * (a - b)
            + 3.0 * step * (a * other.sum2 - b * self.sum2);
        let sum4 = self.sum4
            + other.sum4
            + delta * step * step * step * a * b * (a * a - a * b + b * b)
            + 6.0 * step * step * (a * a * other.sum2 + b * b * self.sum2)
            + 4.0 * step * (a * other.sum3 - b * self.sum3);
        Moments {
            count: self.count + other.count,
            mean: self.mean + step * b,
            sum2,
            sum3,
            sum4,
            mean_absolute: self.mean_absolute + (other.mean_absolute - self.mean_absolute) * (b / n),
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// Samples seen.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Mean; zero where nothing was seen.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Standard deviation, M_2 over n (not n - 1); NaN where nothing was seen.
    pub fn standard_deviation(&self) -> f64 {
        (self.sum2 / self.count as f64).sqrt()
    }

    /// Root mean square about zero; NaN where nothing was seen.
    pub fn rms(&self) -> f64 {
        (self.mean * self.mean + self.sum2 / self.count as f64).sqrt()
    }

    /// Mean absolute value; zero where nothing was seen.
    pub fn mean_absolute(&self) -> f64 {
        self.mean_absolute
    }

    /// Moments of orders 2, 3 and 4 about `center`; NaN where nothing was seen.
    pub fn central(&self, center: f64) -> [f64; 3] {
        let n = self.count as f64;
        let [m2, m3, m4] = [self.sum2 / n, self.sum3 / n, self.sum4 / n];
        let d = self.mean - center;
        let d2 = d * d;
        [m2 + d2, m3 + 3.0 * d * m2 + d * d2, m4 + 4.0 * d * m3 + 6.0 * d2 * m2 + d2 * d2]
    }

    /// Largest |x|; infinite where nothing was seen.
    pub fn peak(&self) -> f64 {
        self.max.abs().max(self.min.abs())
    }

    /// Smallest sample; +infinity where nothing was seen.
    pub fn min(&self) -> f64 {
        self.min
    }

    /// Largest sample; -infinity where nothing was seen.
    pub fn max(&self) -> f64 {
        self.max
    }

    /// An indicator's value, or `None` where it is not defined or not finite: nothing seen, a pure number of a
    /// constant or zero signal, or samples that were not finite.
    pub fn get(&self, indicator: Indicator) -> Option<f64> {
        if self.count == 0 {
            return None;
        }
        let n = self.count as f64;
        let variance = self.sum2 / n;
        let peak = self.peak();
        let value = match indicator {
            Indicator::Rms => self.rms(),
            Indicator::Mean => self.mean,
            Indicator::StandardDeviation => variance.sqrt(),
            Indicator::Peak => peak,
            Indicator::PeakToPeak => self.max - self.min,
            Indicator::CrestFactor => peak / self.rms(),
            Indicator::Kurtosis => self.sum4 / n / (variance * variance),
            Indicator::Skewness => self.sum3 / n / (variance * variance.sqrt()),
            Indicator::ImpulseFactor => peak / self.mean_absolute,
            Indicator::ShapeFactor => self.rms() / self.mean_absolute,
        };
        // NaN compares false with every extreme, so only the sums show that a sample was not a number.
        (value.is_finite() && self.sum2.is_finite()).then_some(value)
    }
}

/// Sums of several terms of each sample, in lanes that the compiler can use.
fn sums<const TERMS: usize>(x: &[f64], terms: impl Fn(f64) -> [f64; TERMS]) -> [f64; TERMS] {
    const LANES: usize = 4;
    let mut sums = [[0.0; LANES]; TERMS];
    let mut add = |lane: usize, v: f64| {
        for (sum, term) in sums.iter_mut().zip(terms(v)) {
            sum[lane] += term;
        }
    };
    let (groups, rest) = x.as_chunks::<LANES>();
    for group in groups {
        (0..LANES).for_each(|lane| add(lane, group[lane]));
    }
    (rest.iter().enumerate()).for_each(|(lane, v)| add(lane, *v));
    sums.map(|lanes| lanes.iter().sum())
}

#[cfg(test)]
mod tests;
