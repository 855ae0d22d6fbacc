//! The fast kurtogram: which band, of which width, is the most impulsive.
//!
//! J. Antoni, "Fast computation of the kurtogram for the detection of transient faults", Mech. Syst. Signal Process. 21
//! (2007) 108-124. A tree of filters halves the band from zero to half the sampling rate again and again, and splits
//! each half once into thirds besides: 1, 2, 3, 4, 6, 8, 12, ... bands. The kurtosis of a band's complex envelope c is
//!
//! K = mean |c|^4 / (mean |c|^2)^2 - 2,
//!
//! zero for Gaussian noise, -1 for a sine, large where energy comes in bursts. The undivided band is judged by the
//! real signal's kurtosis less 3, its mean removed.
//!
//! The prototypes are Hamming-windowed low-passes, 6 dB down at a band's edges: 33 taps for halves, 49 for thirds. The
//! program published with the paper takes 17 and 25 taps and edges 1.6 times as wide, through which the lowest and the
//! highest band see their own mirror image: Gaussian noise then shows a kurtosis of 0.2 there, here below 0.01. Only
//! outputs that see the signal under every tap are used, so there is no transient to leave out.

use serde::Serialize;
use std::f64::consts::{PI, TAU};

use realfft::num_complex::Complex;

use super::band::Band;
use super::error::{SignalError, check};
use super::indicators::{Indicator, Moments};
use super::window::Window;

/// Fewest samples of a band's complex envelope from which a kurtosis is taken.
pub const FEWEST_IN_BAND: usize = 128;
/// Deepest halving, whatever the length: 512 bands.
pub const DEEPEST: usize = 9;

const HALF_TAPS: usize = 33;
/// Cycles per sample of a node, whose band is half a cycle per sample wide.
const HALF_EDGE: f64 = 1.0 / 8.0;
const THIRD_TAPS: usize = 49;
const THIRD_EDGE: f64 = 1.0 / 12.0;

/// Bands of one width.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// Width of each band, Hz; band i reaches from i to i + 1 times it.
    pub bandwidth: f64,
    /// Kurtosis of each band, in order of frequency; NaN where a band holds no power.
    pub kurtosis: Vec<f64>,
    /// Standard deviation of these values under Gaussian noise, 2 / sqrt n with n independent values of the envelope
    /// (sqrt(24 / n) for the undivided signal). The largest of many bands is above zero by several of these.
    pub noise_scatter: f64,
}

/// A band of the map.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct KurtogramBand {
    /// Its edges, Hz.
    #[serde(flatten)]
    pub band: Band,
    /// Its kurtosis.
    pub kurtosis: f64,
    /// Standard deviation of the kurtosis under Gaussian noise.
    pub noise_scatter: f64,
}

impl KurtogramBand {
    /// Width of the band, Hz.
    pub fn bandwidth(&self) -> f64 {
        self.band.high - self.band.low
    }
}

/// The whole map, from one band to the narrowest ones.
#[derive(Debug, Clone, PartialEq)]
pub struct Kurtogram {
    /// 1, 2, 3, 4, 6, 8, 12, ... bands.
    pub levels: Vec<Level>,
}

impl Kurtogram {
    /// Band `index` of level `level`, `None` where there is none.
    pub fn band(&self, level: usize, index: usize) -> Option<KurtogramBand> {
        let level = self.levels.get(level)?;
        let low = index as f64 * level.bandwidth;
        Some(KurtogramBand {
            band: Band::between(low, low + level.bandwidth),
            kurtosis: *level.kurtosis.get(index)?,
            noise_scatter: level.noise_scatter,
        })
    }

    /// Every band of every level.
    pub fn bands(&self) -> impl Iterator<Item = KurtogramBand> {
        (self.levels.iter().enumerate())
            .flat_map(move |(l, level)| (0..level.kurtosis.len()).filter_map(move |i| self.band(l, i)))
    }

    /// The band with the largest kurtosis at least `narrowest` Hz wide; `None` where no band is or none holds power.
    ///
    /// A band narrower than some three times a repetition frequency cannot show how its impacts repeat: give that.
    pub fn best(&self, narrowest: f64) -> Option<KurtogramBand> {
        self.bands()
            .filter(|b| b.bandwidth() >= narrowest && b.kurtosis.is_finite())
            .max_by(|a, b| a.kurtosis.total_cmp(&b.kurtosis))
    }
}

/// The kurtogram of `x`, sampled at `fs` Hz, halved at most `depth` times (cut down to [`DEEPEST`] and so that every
/// band has [`FEWEST_IN_BAND`] values).
///
/// # Errors
/// [`SignalError`] with fewer than 128 samples, samples that are not finite, or a constant signal.
pub fn kurtogram(x: &[f64], fs: f64, depth: usize) -> Result<Kurtogram, SignalError> {
    check(x, fs, FEWEST_IN_BAND, "a kurtogram")?;
    let mut moments = Moments::new();
    x.iter().for_each(|v| moments.push(*v));
    let constant = SignalError::Constant { what: "its kurtosis" };
    let whole = moments.get(Indicator::Kurtosis).ok_or(constant)? - 3.0;
    let filters = Filters {
        half: Branches::of(HALF_TAPS, HALF_EDGE, 2, 1.0 / 8.0),
        third: Branches::of(THIRD_TAPS, THIRD_EDGE, 3, 1.0 / 6.0),
    };
    // Samples of a node after so many halvings: the tree shortens every node alike. Thirds two levels up hold more.
    let mut lengths = vec![x.len()];
    while lengths.len() <= depth.min(DEEPEST) {
        let length = outputs(lengths[lengths.len() - 1], HALF_TAPS, 2);
        if length < FEWEST_IN_BAND {
            break;
        }
        lengths.push(length);
    }
    let depth = lengths.len() - 1;
    let mut tree = Tree {
        depth,
        halves: (0..=depth).map(|h| vec![f64::NAN; 1 << h]).collect(),
        thirds: (2..=depth).map(|h| vec![f64::NAN; 3 << (h - 2)]).collect(),
    };
    tree.halves[0][0] = whole;

    // Centred on zero frequency: turned back by a quarter of the sampling rate, exactly.
    let mean = moments.mean();
    let root: Vec<Complex<f64>> = (x.iter().enumerate())
        .map(|(i, v)| match i % 4 {
            0 => Complex::new(v - mean, 0.0),
            1 => Complex::new(0.0, mean - v),
            2 => Complex::new(mean - v, 0.0),
            _ => Complex::new(0.0, v - mean),
        })
        .collect();
    tree.descend(&filters, &root, 0, 0);

    let scatter = |variance: f64, n: usize| (variance / n as f64).sqrt();
    let mut levels = Vec::new();
    for (h, kurtosis) in tree.halves.into_iter().enumerate() {
        if h >= 2 {
            levels.push(Level {
                bandwidth: 0.5 * fs / (3 << (h - 2)) as f64,
                kurtosis: std::mem::take(&mut tree.thirds[h - 2]),
                noise_scatter: scatter(4.0, outputs(lengths[h - 2], THIRD_TAPS, 3)),
            });
        }
        levels.push(Level {
            bandwidth: 0.5 * fs / (1 << h) as f64,
            kurtosis,
            noise_scatter: scatter(if h == 0 { 24.0 } else { 4.0 }, lengths[h]),
        });
    }
    Ok(Kurtogram { levels })
}

/// Outputs of a filter of `taps` that see the signal under every tap, one in `factor`.
fn outputs(length: usize, taps: usize, factor: usize) -> usize {
    if length < taps { 0 } else { (length - taps) / factor + 1 }
}

struct Filters {
    half: Branches,
    third: Branches,
}

/// A prototype moved up and down in frequency by one distance, and as it is.
///
/// With taps h_o about the middle and an angle t from sample to sample, the sum of h_o e^(-i t o) v_(c + o) is A - i B,
/// and with -t it is A + i B: A is that of h_o cos(t o) (v_(c + o) + v_(c - o)), B that of h_o sin(t o) (v_(c + o) -
/// v_(c - o)).
struct Branches {
    /// Tap in the middle.
    middle: f64,
    /// Taps to either side.
    half: usize,
    /// Samples from one output to the next.
    factor: usize,
    rows: Vec<Row>,
}

/// Two taps, unless zero.
struct Row {
    offset: usize,
    plain: f64,
    cosine: f64,
    sine: f64,
}

impl Branches {
    /// Of a low-pass of so many taps, up to `edge` and moved by `turn`, both in cycles a sample.
    fn of(taps: usize, edge: f64, factor: usize, turn: f64) -> Self {
        let h = low_pass(taps, edge);
        let half = taps / 2;
        let row = |offset: usize| {
            let (sin, cos) = (TAU * turn * offset as f64).sin_cos();
            let plain = h[half + offset];
            Row { offset, plain, cosine: plain * cos, sine: plain * sin }
        };
        // A low-pass has its zeros at multiples of half a period of its edge.
        let zero = |offset: usize| 2.0 * edge * offset as f64 % 1.0 == 0.0;
        Branches { middle: h[half], half, factor, rows: (1..=half).filter(|o| !zero(*o)).map(row).collect() }
    }

    /// Of every output: what passes the prototype below, where it is (with `MIDDLE`; else nothing of use), and above,
    /// moved to zero frequency but for the phase at the middle tap.
    fn outputs<const MIDDLE: bool>(&self, node: &[Complex<f64>], mut each: impl FnMut(usize, [Complex<f64>; 3])) {
        let windows = node.windows(2 * self.half + 1).step_by(self.factor);
        for (m, around) in windows.enumerate() {
            let center = around[self.half];
            let middle = [self.middle * center.re, self.middle * center.im];
            let (mut a, mut b, mut c) = (middle, [0.0; 2], middle);
            for row in &self.rows {
                let (u, v) = (around[self.half + row.offset], around[self.half - row.offset]);
                let (sum, difference) = ([u.re + v.re, u.im + v.im], [u.re - v.re, u.im - v.im]);
                for i in 0..2 {
                    a[i] += row.cosine * sum[i];
                    b[i] += row.sine * difference[i];
                    if MIDDLE {
                        c[i] += row.plain * sum[i];
                    }
                }
            }
            let below = Complex::new(a[0] - b[1], a[1] + b[0]);
            let above = Complex::new(a[0] + b[1], a[1] - b[0]);
            each(m, [below, Complex::new(c[0], c[1]), above]);
        }
    }
}

/// The ideal low-pass's impulse response, cut off by Hamming's window and of unit gain at zero frequency; an odd number
/// of taps, `edge` in cycles a sample. A. V. Oppenheim and R. W. Schafer, "Discrete-time signal processing", 3rd ed.
/// (2010), section 7.5.
fn low_pass(taps: usize, edge: f64) -> Vec<f64> {
    let half = (taps / 2) as f64;
    let ideal = |m: f64| if m == 0.0 { 2.0 * edge } else { (2.0 * PI * edge * m).sin() / (PI * m) };
    let window = Window::Hamming.symmetric(taps).into_iter().enumerate();
    let mut h: Vec<f64> = window.map(|(i, w)| w * ideal(i as f64 - half)).collect();
    let gain = h.iter().sum::<f64>();
    h.iter_mut().for_each(|h| *h /= gain);
    h
}

struct Tree {
    depth: usize,
    halves: Vec<Vec<f64>>,
    thirds: Vec<Vec<f64>>,
}

impl Tree {
    /// Fills in what lies below a node: its complex envelope, centred on zero frequency, with the band within a quarter
    /// of its sampling rate to either side.
    fn descend(&mut self, filters: &Filters, node: &[Complex<f64>], halvings: usize, index: usize) {
        if halvings + 2 <= self.depth {
            let mut thirds = [Powers::default(); 3];
            filters.third.outputs::<true>(node, |_, parts| {
                for (powers, value) in thirds.iter_mut().zip(&parts) {
                    powers.push(value);
                }
            });
            for (part, powers) in thirds.iter().enumerate() {
                self.thirds[halvings][3 * index + part] = powers.kurtosis();
            }
        }
        if halvings < self.depth {
            let mut children = [(); 2].map(|()| Vec::with_capacity(node.len() / 2));
            let mut powers = [Powers::default(); 2];
            filters.half.outputs::<false>(node, |m, [below, _, above]| {
                // An eighth of a cycle a sample is a quarter from one output to the next; at the first it is whole
                // turns.
                let [below, above] = match m % 4 {
                    0 => [below, above],
                    1 => [times_i(below), -times_i(above)],
                    2 => [-below, -above],
                    _ => [-times_i(below), times_i(above)],
                };
                children[0].push(below);
                children[1].push(above);
                powers[0].push(&below);
                powers[1].push(&above);
            });
            for (part, child) in children.into_iter().enumerate() {
                self.halves[halvings + 1][2 * index + part] = powers[part].kurtosis();
                self.descend(filters, &child, halvings + 1, 2 * index + part);
            }
        }
    }
}

fn times_i(c: Complex<f64>) -> Complex<f64> {
    Complex::new(-c.im, c.re)
}

/// Sums over a complex envelope.
#[derive(Clone, Copy, Default)]
struct Powers {
    count: usize,
    second: f64,
    fourth: f64,
}

impl Powers {
    fn push(&mut self, value: &Complex<f64>) {
        let power = value.norm_sqr();
        self.count += 1;
        self.second += power;
        self.fourth += power * power;
    }

    /// Less 2.
    fn kurtosis(&self) -> f64 {
        self.fourth * self.count as f64 / (self.second * self.second) - 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::super::test_signals::{ImpactTrain, Noise, cosine};
    use super::*;

    const FS: f64 = 25_600.0;

    fn train(resonance: f64, noise: f64) -> ImpactTrain {
        ImpactTrain { fs: FS, rate: 87.0, jitter: 0.01, resonance, decay: 4e-4, noise }
    }

    #[test]
    fn prop_impacts_are_found_where_they_ring() {
        for (resonance, seed) in [(2400.0, 1), (5200.0, 2), (9700.0, 3)] {
            let x = train(resonance, 0.3).generate(65_536, seed);
            let map = kurtogram(&x, FS, 5).unwrap();
            let best = map.best(300.0).unwrap();
            assert!(best.band.low < resonance + 600.0 && best.band.high > resonance - 600.0, "{best:?}");
            assert!(best.kurtosis > 8.0 * best.noise_scatter, "{best:?}");
        }
    }

    #[test]
    fn analytic_noise_has_none_and_a_sine_minus_one() {
        let noise = Noise::new(9).normals(100_000);
        let map = kurtogram(&noise, FS, 6).unwrap();
        assert_eq!(
            map.levels.iter().map(|l| l.kurtosis.len()).collect::<Vec<_>>(),
            [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64]
        );
        for band in map.bands() {
            assert!(band.kurtosis.abs() < 4.5 * band.noise_scatter + 0.01, "{band:?}");
        }
        let map = kurtogram(&cosine(10_000, FS, 4000.0, 1.0, 0.0), FS, 3).unwrap();
        assert!((map.levels[0].kurtosis[0] + 1.5).abs() < 1e-3);
        assert!((map.levels[3].kurtosis[1] + 1.0).abs() < 1e-2);
    }

    #[test]
    fn prop_short_or_constant_input() {
        assert!(kurtogram(&[1.0; 100], FS, 3).is_err());
        assert!(matches!(kurtogram(&[1.0; 1000], FS, 3), Err(SignalError::Constant { .. })));
        let map = kurtogram(&Noise::new(1).normals(128), FS, 9).unwrap();
        assert_eq!(map.levels.len(), 1);
        assert!(map.best(1e9).is_none());
    }
}
