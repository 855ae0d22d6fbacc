//! Condition indicators of a stream, each with the scatter that belongs to it.
//!
//! [`Moments`] gathers one pass over a signal; [`Blocks`] gathers one per block of whole revolutions and says how far
//! an indicator may be trusted: two equally accurate runs of half a second give accelerations whose RMS differs by
//! several per cent (model.md section 14), so an indicator without an interval says too little.
//!
//! Definitions, over n samples x with mean m and central moments M_p = sum (x - m)^p / n:
//! RMS sqrt(sum x^2 / n), about zero (ISO 20816-1, ISO 13373-2); standard deviation sqrt(M_2), the population's, so
//! that RMS^2 = m^2 + M_2; peak max |x|; crest factor peak / RMS; shape factor RMS / mean |x|; impulse factor
//! peak / mean |x|; skewness M_3 / M_2^1.5; kurtosis M_4 / M_2^2, which is 3 for a normal distribution.

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

    /// Name in files and reports: `rms`, `crest_factor`, and so on.
    pub fn name(self) -> &'static str {
        match self {
            Indicator::Rms => "rms",
            Indicator::Mean => "mean",
            Indicator::StandardDeviation => "standard_deviation",
            Indicator::Peak => "peak",
            Indicator::PeakToPeak => "peak_to_peak",
            Indicator::CrestFactor => "crest_factor",
            Indicator::Kurtosis => "kurtosis",
            Indicator::Skewness => "skewness",
            Indicator::ImpulseFactor => "impulse_factor",
            Indicator::ShapeFactor => "shape_factor",
        }
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
        self.sum4 += term * step2 * (n * n - 3.0 * n + 3.0) + 6.0 * step2 * self.sum2
            - 4.0 * step * self.sum3;
        self.sum3 += term * step * (n - 2.0) - 3.0 * step * self.sum2;
        self.sum2 += term;
        self.mean_absolute += (x.abs() - self.mean_absolute) / n;
        self.min = self.min.min(x);
        self.max = self.max.max(x);
    }

    /// Takes samples in their order: what [`push`](Self::push) of each makes of them but for rounding, several times as fast.
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
            mean_absolute: self.mean_absolute
                + (other.mean_absolute - self.mean_absolute) * (b / n),
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
        let peak = self.max.abs().max(self.min.abs());
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

/// A 95 % interval for the expected value of an indicator over one block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Mean over the blocks, the interval's centre.
    pub center: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// Whole blocks that it rests on.
    pub blocks: usize,
    /// Calls of `end_block` that make one of these blocks: 1, 2, 4, ...
    pub periods_per_block: u64,
}

/// An indicator of a whole run, with the scatter of its blocks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Value over all samples.
    pub value: f64,
    /// 95 % interval from the blocks; `None` with fewer than three whole blocks.
    pub interval: Option<Interval>,
}

/// Statistics over consecutive blocks, in bounded memory.
///
/// The caller says [`end_block`](Self::end_block) at each whole revolution of the inner ring. Where the 65th block
/// would begin, neighbours merge in pairs and from then on a block is twice as many revolutions; so at most 64 are
/// held, and at least 32 from then on. Samples after the last whole block count in the whole, not in the interval.
///
/// The interval is Student's, on the block values: mean +- t(0.975, B - 1) s / sqrt(B). It supposes blocks that
/// scatter independently; motion slower than a block (the cage's, at about 0.4 of the inner ring's speed) makes it too
/// narrow, and merging mends that in long runs. It is an interval for the mean of one block's value: for
/// averages (RMS, mean, standard deviation, and nearly for shape factor) that is the run's own value, but extremes
/// (peak, crest factor, impulse factor, and kurtosis of rare impacts) grow with the length looked at, so there the
/// whole's value may lie above the interval, which remains the right one to compare runs of different lengths by,
/// at the same `periods_per_block`.
#[derive(Debug, Clone)]
pub struct Blocks {
    closed: Vec<Moments>,
    open: Moments,
    periods_per_block: u64,
    periods_in_open: u64,
}

impl Default for Blocks {
    fn default() -> Self {
        Blocks::new()
    }
}

impl Blocks {
    /// Blocks held at most; even.
    pub const MOST: usize = 64;

    /// No samples, no blocks.
    pub fn new() -> Self {
        Blocks {
            closed: Vec::with_capacity(Self::MOST),
            open: Moments::new(),
            periods_per_block: 1,
            periods_in_open: 0,
        }
    }

    /// Of a slice, in blocks of `samples` samples (not necessarily whole), 1 or more: a revolution is the sample rate
    /// over the speed in Hz.
    pub fn of(x: &[f64], samples: f64) -> Self {
        let mut blocks = Blocks::new();
        let samples = samples.max(1.0);
        let mut end = samples;
        let mut from = 0;
        while end <= x.len() as f64 {
            let to = end.ceil() as usize;
            blocks.open.extend(&x[from..to]);
            blocks.end_block();
            (from, end) = (to, end + samples);
        }
        blocks.open.extend(&x[from..]);
        blocks
    }

    /// Takes one sample.
    pub fn push(&mut self, x: f64) {
        self.open.push(x);
    }

    /// Ends a period (a whole revolution). A period without samples is passed over.
    pub fn end_block(&mut self) {
        if self.open.count == 0 {
            return;
        }
        self.periods_in_open += 1;
        if self.periods_in_open < self.periods_per_block {
            return;
        }
        if self.closed.len() == Self::MOST {
            for i in 0..Self::MOST / 2 {
                self.closed[i] = self.closed[2 * i].merge(&self.closed[2 * i + 1]);
            }
            self.closed.truncate(Self::MOST / 2);
            self.periods_per_block *= 2;
            return;
        }
        self.closed.push(self.open);
        self.open = Moments::new();
        self.periods_in_open = 0;
    }

    /// Whole blocks held, and the periods that each stands for.
    pub fn whole_blocks(&self) -> (&[Moments], u64) {
        (&self.closed, self.periods_per_block)
    }

    /// Moments of all samples, those after the last whole block included.
    pub fn whole(&self) -> Moments {
        self.closed
            .iter()
            .fold(Moments::new(), |whole, block| whole.merge(block))
            .merge(&self.open)
    }

    /// An indicator of the whole with its interval; `None` where it is not defined (see [`Moments::get`]).
    pub fn estimate(&self, indicator: Indicator) -> Option<Estimate> {
        let value = self.whole().get(indicator)?;
        let mut values = Moments::new();
        for block in &self.closed {
            if let Some(value) = block.get(indicator) {
                values.push(value);
            }
        }
        let blocks = values.count as usize;
        let interval = (blocks >= 3 && blocks == self.closed.len()).then(|| {
            let freedom = (blocks - 1) as u32;
            let error = (values.sum2 / f64::from(freedom) / blocks as f64).sqrt();
            let half = student_t_quantile(0.975, freedom) * error;
            Interval {
                center: values.mean,
                low: values.mean - half,
                high: values.mean + half,
                blocks,
                periods_per_block: self.periods_per_block,
            }
        });
        Some(Estimate { value, interval })
    }
}

/// The value that Student's t with `freedom` degrees of freedom stays below with probability `p`.
///
/// Inverts the closed form for whole degrees of freedom (Abramowitz and Stegun 26.7.3 and 26.7.4) by bisection on
/// theta = atan(t / sqrt(freedom)); good to about 1e-12 for p within 0.001 to 0.999.
///
/// # Panics
/// Where `freedom` is zero or p is not between 0 and 1.
pub fn student_t_quantile(p: f64, freedom: u32) -> f64 {
    assert!(
        freedom > 0,
        "Student's t needs at least one degree of freedom"
    );
    assert!(0.0 < p && p < 1.0, "probability {p} is not between 0 and 1");
    let central = (2.0 * p - 1.0).abs();
    let (mut low, mut high) = (0.0, std::f64::consts::FRAC_PI_2);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if central_probability(middle, freedom) < central {
            low = middle;
        } else {
            high = middle;
        }
    }
    let t = f64::from(freedom).sqrt() * (0.5 * (low + high)).tan();
    t.copysign(p - 0.5)
}

/// P(|T| < sqrt(freedom) tan(theta)).
fn central_probability(theta: f64, freedom: u32) -> f64 {
    let (sine, cosine) = theta.sin_cos();
    let odd = freedom % 2 == 1;
    let mut term = if odd { cosine } else { 1.0 };
    let mut sum = 0.0;
    // Odd: cos + 2/3 cos^3 + 2.4/(3.5) cos^5 ...; even: 1 + 1/2 cos^2 + 1.3/(2.4) cos^4 ...
    let mut k = if odd { 1 } else { 0 };
    while k + 2 <= freedom {
        sum += term;
        term *= cosine * cosine * f64::from(k + 1) / f64::from(k + 2);
        k += 2;
    }
    if odd {
        std::f64::consts::FRAC_2_PI * (theta + sine * sum)
    } else {
        sine * sum
    }
}

#[cfg(test)]
mod tests;
