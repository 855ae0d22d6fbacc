//! A shaft speed that drifts during the record, by the lines that it moves.
//!
//! The record is cut into stretches of [`TURNS`] revolutions. In the spectrum of each, every speed near the one given
//! has a merit: power over the noise floor, summed over the harmonics of one comb - the shaft's in the signal or, where
//! its lines are not detected, a defect frequency's in the envelopes. The course of highest merit, changes of speed
//! weighed against it, is found by dynamic programming (A. J. Viterbi, IEEE Trans. Inf. Theory 13 (1967) 260-269);
//! several orders that tell one speed are the idea of Q. Leclère, H. André and J. Antoni, "A multi-order probabilistic
//! approach for instantaneous angular speed tracking", Mech. Syst. Signal Process. 81 (2016) 375-386.
//!
//! A course of many speeds always has more merit than one speed. It is a drift where it has far more, and where two
//! harmonics say so, each against the one speed that suits it best: a course that passes from one steady line to
//! another has no harmonic that moves along.

use super::Options;
use super::known_lines::near_mains;
use super::running_median::running_median;
use super::together::{Envelopes, FLOOR, HARMONICS, apart};
use crate::lengths::fast_from;
use crate::spectrum::SegmentTransform;
use crate::{Detrend, Rotation, SignalError, Window};

/// Revolutions of a stretch.
const TURNS: f64 = 16.0;
/// The same at least, where the record has few.
const FEWEST_TURNS: f64 = 10.0;
/// Stretches at least.
const FEWEST: usize = 4;
/// Harmonics of the shaft.
const OF_SHAFT: usize = 10;
/// A drift may lead so much farther from the speed given than the tolerance, relative.
const BEYOND: f64 = 0.02;
/// And so far at most, for the tenth harmonic not to meet its neighbours.
const FARTHEST: f64 = 0.045;
/// Where a course keeps to that bound, so many times as far is tried: there the lower harmonics decide.
const WIDER: f64 = 1.5;
/// Distance of the speeds tried: as a share of a bin at the highest order.
const FINE: f64 = 0.1;
/// Bins of a stretch's spectrum between two that are independent.
const PADDED: usize = 4;
/// Merit of a line at most: the peaks of a strong one are told to a small part of a bin, and it moves by more than
/// that.
const MOST: f64 = 200.0;
/// Change of speed from one stretch to the next that costs a merit of 1, relative; it goes as the square.
const CHANGE: f64 = 0.005;
/// Merit over that of one speed from which a course is a drift, for each stretch. Noise and steady rigs stay below 1
/// (tests/drift.rs).
const GAIN: f64 = 1.5;
/// The same of a single harmonic.
const OWN_GAIN: f64 = 0.4;
/// Harmonics that have to say so.
const AGREEING: usize = 2;
/// Change of a defect frequency, relative, that slip explains: no speed's.
const SLIP: f64 = 0.005;
/// Places from the bound of the speeds tried within which a course keeps to it.
const AT_BOUND: usize = 3;
/// Change from one stretch to the next, relative, at which a line of order 10 smears over two bins of a stretch: what
/// is faster is not followed well.
const FAST: f64 = 0.0125;
/// Bins over which a line of order 10 smears from which damage may be missed where the drift is not followed: the main
/// lobe of Hann's window has four, however steady the speed.
const SMEARS: f64 = 4.0;
/// Merit from which a stretch tells a speed.
const TELLS: f64 = 10.0;
/// Power over floor, where there is no floor.
const HIGHEST: f64 = 1e12;

/// A speed that changes during the record.
#[derive(Debug, Clone, PartialEq)]
pub struct Drift {
    /// Whose lines told it: `shaft`, or a defect frequency's name. A defect frequency tells changes, not the speed: its
    /// mean is then the speed given.
    pub by: &'static str,
    /// Middle of each stretch, s, and the speed there, Hz.
    pub course: Vec<(f64, f64)>,
    /// Bins of the envelope spectrum over which a line of order 10 smears where the drift is not followed.
    pub smear: f64,
    /// Whether the verdict rests on envelopes at equal angles of this course. Otherwise these told no more.
    pub followed: bool,
    /// Whether it leads beyond the speeds tried: the course is then wrong there.
    pub leaves: bool,
}

impl Drift {
    /// Where in time (s) the speed is lowest, and the speed, Hz.
    pub fn lowest(&self) -> (f64, f64) {
        let lowest = self.course.iter().min_by(|a, b| a.1.total_cmp(&b.1));
        lowest.copied().unwrap_or_default()
    }

    /// The same where it is highest.
    pub fn highest(&self) -> (f64, f64) {
        let highest = self.course.iter().max_by(|a, b| a.1.total_cmp(&b.1));
        highest.copied().unwrap_or_default()
    }

    /// Mean speed, Hz.
    pub fn mean(&self) -> f64 {
        self.course.iter().map(|p| p.1).sum::<f64>() / self.course.len() as f64
    }

    /// Whether damage may be missed for it: it goes too far or too fast to be followed, no line of the shaft tells it,
    /// or it smears lines and following it showed no more.
    pub(super) fn may_hide(&self) -> bool {
        self.is_lost() || self.by != "shaft" || !self.followed && self.smear > SMEARS
    }

    /// Whether it goes too far or too fast to be followed.
    pub(super) fn is_lost(&self) -> bool {
        self.leaves || self.course.windows(2).any(|two| (two[1].1 / two[0].1 - 1.0).abs() > FAST)
    }

    /// For a sentence about the shaft's speed.
    pub fn words(&self) -> String {
        let (low, high) = (self.lowest(), self.highest());
        let (from, to) = if low.0 < high.0 { (low, high) } else { (high, low) };
        let by = match self.by {
            "shaft" => "its own lines".to_owned(),
            name => format!("the lines of {name}"),
        };
        if self.is_lost() && !self.followed {
            return format!("it changes, by {by}, farther or faster than can be followed");
        }
        let then = match self.followed {
            true if self.is_lost() => format!("by {by}: too far or too fast to be followed well"),
            true => format!("followed by {by}"),
            false => format!("by {by}; lines of order 10 smear over {:.0} bins", self.smear),
        };
        let farther = if self.leaves { " or farther" } else { "" };
        format!(
            "it drifts from {:.0} r/min at {:.1} s to {:.0} r/min at {:.1} s{farther}, {then}",
            60.0 * from.1,
            from.0,
            60.0 * to.1,
            to.0
        )
    }

    /// The shaft's angle over time; the ends go on as the stretches next to them.
    pub(super) fn rotation(&self) -> Result<Rotation, SignalError> {
        let c = &self.course;
        // Neighbours share the error of one.
        let smooth = |k: usize| match k {
            0 => c[0].1,
            k if k + 1 == c.len() => c[k].1,
            k => 0.25 * (c[k - 1].1 + 2.0 * c[k].1 + c[k + 1].1),
        };
        let mut points: Vec<(f64, f64)> = (0..c.len()).map(|k| (c[k].0, smooth(k))).collect();
        let (first, last) = (c[0].0, c.len() - 1);
        let outwards = |a: usize, b: usize| 1.5 * points[a].1 - 0.5 * points[b].1;
        let ends = (outwards(0, 1), outwards(last, last - 1));
        points.insert(0, (0.0, ends.0));
        points.push((c[last].0 + first, ends.1));
        Rotation::from_speeds(&points)
    }
}

/// Drift of the shaft's speed by lines at its harmonics in `x`, a signal less its mean.
pub(super) fn by_shaft(x: &[f64], fs: f64, options: &Options) -> Option<Drift> {
    let stretches = Stretches::of(&[x], fs, options)?;
    let orders: Vec<f64> = (1..=OF_SHAFT).map(|h| h as f64).collect();
    stretches.drift(&orders, "shaft", true).map(|found| found.1)
}

/// The same of one record by the lines of a defect frequency in the envelopes of all bands: of the one that gains most.
pub(super) fn by_families(envelopes: &Envelopes, options: &Options) -> Option<Drift> {
    let values: Vec<&[f64]> = envelopes.each.iter().map(|e| &e.1[0].values[..]).collect();
    let stretches = Stretches::of(&values, envelopes.rates[0], options)?;
    let drifts = (options.orders.defect_frequencies()).filter_map(|(_, name, order)| {
        let orders: Vec<f64> = (1..=HARMONICS).map(|h| h as f64 * order).collect();
        stretches.drift(&orders, name, false)
    });
    let highest = drifts.max_by(|a, b| a.0.total_cmp(&b.0));
    let beyond_slip = |d: &Drift| d.highest().1 - d.lowest().1 > SLIP * d.mean();
    let (_, mut drift) = highest.filter(|(_, d)| beyond_slip(d))?;
    let factor = options.shaft / drift.mean();
    drift.course.iter_mut().for_each(|p| p.1 *= factor);
    Some(drift)
}

/// Spectra of successive stretches.
struct Stretches<'a> {
    /// Power over floor, less 1, over its scatter in noise.
    heights: Vec<Vec<f64>>,
    /// Between bins, Hz.
    step: f64,
    /// Length of a stretch, s.
    seconds: f64,
    options: &'a Options,
}

impl<'a> Stretches<'a> {
    /// Of signals of one length, as bands' envelopes, that count alike; `None` where they are too short.
    fn of(signals: &[&[f64]], fs: f64, options: &'a Options) -> Option<Self> {
        let samples = signals.first()?.len();
        let revolutions = samples as f64 / fs * options.shaft;
        let count = ((revolutions / TURNS) as usize).max(FEWEST);
        if revolutions < FEWEST as f64 * FEWEST_TURNS {
            return None;
        }
        let length = samples / count;
        let padded = fast_from(PADDED * length);
        let step = fs / padded as f64;
        let top = (OF_SHAFT as f64).max(HARMONICS as f64 * options.orders.highest()) * (1.0 + WIDER * FARTHEST) + 1.0;
        let bins = (top * options.shaft / step) as usize;
        let independent = PADDED as f64;
        let width = (FLOOR.0 * options.shaft / step).max(FLOOR.1 * independent) as usize;
        let weight = apart(signals.len()).sqrt() / signals.len() as f64;
        let mut window = Window::Hann.periodic(length);
        window.resize(padded, 0.0);
        // Planned once: there are hundreds of spectra of one length.
        let mut transform = SegmentTransform::new(window);
        let mut heights = Vec::with_capacity(count);
        for k in 0..count {
            let mut sum: Vec<f64> = Vec::new();
            for signal in signals {
                let part = &mut transform.input[..length];
                part.copy_from_slice(&signal[k * length..(k + 1) * length]);
                Detrend::Mean.apply(part);
                // The window is zero beyond; what an earlier transform left there is not.
                transform.input[length..].fill(0.0);
                let spectrum = transform.windowed_input();
                let power: Vec<f64> = (spectrum.iter().take(bins)).map(|line| line.norm_sqr()).collect();
                sum.resize(power.len(), 0.0);
                // The median of an exponential distribution is ln 2 of its mean.
                let floor = running_median(&power, width.min(power.len()));
                for ((s, p), f) in sum.iter_mut().zip(&power).zip(floor) {
                    let over = p * std::f64::consts::LN_2 / f.max(f64::MIN_POSITIVE);
                    *s += weight * (over.min(HIGHEST) - 1.0);
                }
            }
            heights.push(sum);
        }
        Some(Stretches { heights, step, seconds: length as f64 / fs, options })
    }

    /// The course that lines at `orders` tell, where it is a drift, and what it gains.
    fn drift(&self, orders: &[f64], by: &'static str, mains: bool) -> Option<(f64, Drift)> {
        let reach = (self.options.tolerance + BEYOND).min(FARTHEST);
        let near = self.drift_within(reach, orders, by, mains)?;
        let wider = || self.drift_within(WIDER * reach, orders, by, mains).filter(|(_, drift)| !drift.leaves);
        Some(if near.1.leaves { wider().unwrap_or(near) } else { near })
    }

    /// The same so far from the speed given, relative.
    fn drift_within(&self, reach: f64, orders: &[f64], by: &'static str, mains: bool) -> Option<(f64, Drift)> {
        let shaft = self.options.shaft;
        let highest = orders.iter().fold(0.0, |m: f64, o| m.max(*o));
        let fine = FINE / (self.seconds * highest * shaft);
        let half = (reach / fine) as i32;
        let speeds: Vec<f64> = (-half..=half).map(|k| shaft * (1.0 + f64::from(k) * fine)).collect();
        let orders: Vec<f64> = (orders.iter().copied()).filter(|o| !(mains && self.meets_mains(*o, &speeds))).collect();
        // Of each order: of each stretch: of each speed.
        let merits: Vec<Vec<Vec<f64>>> =
            (orders.iter()).map(|o| self.heights.iter().map(|h| self.merits(h, *o, &speeds)).collect()).collect();
        let total: Vec<Vec<f64>> = (0..self.heights.len())
            .map(|k| (0..speeds.len()).map(|i| merits.iter().map(|m| m[k][i]).sum()).collect())
            .collect();
        let (path, merit) = course(&total, CHANGE / fine);
        let along = |of: &[Vec<f64>]| path.iter().zip(of).map(|(i, m)| m[*i]).sum::<f64>();
        let stretches = total.len() as f64;
        let own = |m: &&Vec<Vec<f64>>| along(m) - steady(m) >= OWN_GAIN * stretches;
        let telling = path.iter().zip(&total).filter(|(i, m)| m[**i] >= TELLS);
        let gain = merit - steady(&total);
        let is_drift =
            gain >= GAIN * stretches && merits.iter().filter(own).count() >= AGREEING && telling.count() >= FEWEST;
        let middle = |k: usize| (k as f64 + 0.5) * self.seconds;
        let course = path.iter().enumerate().map(|(k, i)| (middle(k), speeds[*i]));
        let leaves = path.iter().any(|i| *i < AT_BOUND || *i + AT_BOUND >= speeds.len());
        let drift = Drift { by, course: course.collect(), smear: 0.0, followed: false, leaves };
        is_drift.then_some((gain, drift))
    }

    /// Whether a line of the mains may pass for one of this order.
    fn meets_mains(&self, order: f64, speeds: &[f64]) -> bool {
        let width = 2.0 / self.seconds;
        speeds.iter().any(|speed| near_mains(order * speed, width))
    }

    /// Of each speed by the line of an order.
    fn merits(&self, heights: &[f64], order: f64, speeds: &[f64]) -> Vec<f64> {
        let at = |speed: &f64| {
            let place = order * speed / self.step;
            let (bin, part) = (place as usize, place.fract());
            match heights.get(bin..bin + 2) {
                Some(two) => two[0] + part * (two[1] - two[0]),
                None => 0.0,
            }
        };
        let mut merits: Vec<f64> = speeds.iter().map(at).collect();
        let highest = merits.iter().fold(MOST, |m: f64, v| m.max(*v));
        merits.iter_mut().for_each(|m| *m *= MOST / highest);
        merits
    }
}

/// The merit of the one speed that suits all stretches best.
fn steady(merits: &[Vec<f64>]) -> f64 {
    let speeds = merits.first().map_or(0, Vec::len);
    let of = |i: usize| merits.iter().map(|m| m[i]).sum::<f64>();
    (0..speeds).map(of).fold(f64::NEG_INFINITY, f64::max)
}

/// The course of highest merit, where a change by `change` places costs 1; and its merit.
fn course(merits: &[Vec<f64>], change: f64) -> (Vec<usize>, f64) {
    let Some((first, later)) = merits.split_first() else {
        return (Vec::new(), 0.0);
    };
    let reach = (3.0 * change) as usize;
    let mut best = first.clone();
    let mut from: Vec<Vec<usize>> = Vec::with_capacity(later.len());
    for merits in later {
        let came: Vec<(usize, f64)> = (0..best.len())
            .map(|i| {
                let near = i.saturating_sub(reach)..(i + reach + 1).min(best.len());
                let value = |j: usize| best[j] - ((i.abs_diff(j)) as f64 / change).powi(2);
                let places = near.map(|j| (j, value(j)));
                places.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((i, best[i]))
            })
            .collect();
        best = came.iter().zip(merits).map(|(c, m)| c.1 + m).collect();
        from.push(came.into_iter().map(|c| c.0).collect());
    }
    let last = (best.iter().enumerate()).max_by(|a, b| a.1.total_cmp(b.1));
    let (mut at, merit) = last.map_or((0, 0.0), |(i, m)| (i, *m));
    let mut path = vec![at];
    for from in from.iter().rev() {
        at = from[at];
        path.push(at);
    }
    path.reverse();
    (path, merit)
}
