//! Two events in every period of a signal, as of an element that enters damage and leaves it: how far they are apart.
//!
//! The two events need not be alike, and what rings after them lasts longer than the time between them. So the signal is whitened by an autoregressive model,
//! which takes resonances out (N. Sawalhi and R. B. Randall, "Vibration response of spalled rolling element bearings", Mech. Syst. Signal Process. 25 (2011) 846-870, do
//! it so), and its envelope, smoothed over the shortest event, is correlated with itself. Both events of a period are of one element, so that the lag does not smear as
//! that from period to period does where elements slip. The lag of the highest peak between 0 and half a period is the spacing.
//!
//! A lag d and a period less d are the same pattern: two events apart by more than half a period are not told from two that are nearer.

use super::band::Band;
use super::envelope::envelope;
use super::error::SignalError;
use super::fft;
use super::lengths::fast_from;
use super::order::{Rotation, resample};
use realfft::num_complex::Complex;

/// Span of the autoregressive model, s, and its fewest and most coefficients: enough for a few resonances, and too short to predict the second event.
const SPAN: f64 = 0.5e-3;
const COEFFICIENTS: (f64, f64) = (8.0, 48.0);
/// Lags up to this share of the period are looked at; peaks count up to half of it.
const LAGS: f64 = 0.75;
/// Periods of a block, and how many blocks there are: their scatter says what a peak is worth.
const PERIODS: f64 = 8.0;
const BLOCKS: (usize, usize) = (6, 60);
/// A peak rises above its foot by so many standard errors.
const SURE: f64 = 5.0;
/// From the second event to the first of the next period is the period less the spacing, but for this share of it.
const REST: f64 = 0.05;
/// Clarity of a spacing below which none is told: of simulated damage, one in twenty is another spacing than that of its ends (`validation/size`).
const CLEAR: f64 = 0.15;
/// Standard deviations of the smoothing's bell that are summed.
const BELL: f64 = 4.0;
/// Samples of the envelope in one standard deviation of its smoothing.
const FINE: f64 = 1.5;

/// The spacing of two events, s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EventSpacing {
    /// Lag of the peak, s.
    pub seconds: f64,
    /// Its standard error, s, by the scatter of blocks.
    pub uncertainty: f64,
    /// Height of the peak above its foot over the envelope's variance, less the share of the next peak in it: 0 where another lag is as likely, 1 at the most.
    pub clarity: f64,
}

impl EventSpacing {
    /// Whether the spacing is to be told.
    pub fn is_clear(&self) -> bool {
        self.clarity >= CLEAR
    }
}

/// The events of a signal `x` sampled at `fs` Hz that repeat every `period` s, where two are told; each as short as `shortest` s. `rotation` follows a speed that varies,
/// and is as fast as `turn` Hz where the period counts.
///
/// # Errors
/// Where samples are too few, not finite, or the period takes no less than half the record.
pub fn event_spacing(
    x: &[f64],
    fs: f64,
    (period, shortest): (f64, f64),
    rotation: Option<(&Rotation, f64)>,
) -> Result<Option<EventSpacing>, SignalError> {
    let white = whitened(x, (SPAN * fs).clamp(COEFFICIENTS.0, COEFFICIENTS.1) as usize);
    let range = Band::between(fs / white.len() as f64, 0.5 * fs * (1.0 - 1e-9));
    let envelope: Vec<f64> = envelope(&white, fs, range)?.iter().map(|e| e * e).collect();
    let deviation = (shortest * fs).max(0.6);
    let (mut smooth, mut rate) = smoothed(&envelope, fs, deviation);
    smooth.iter_mut().for_each(|e| *e = e.max(0.0).sqrt());
    if let Some((rotation, turn)) = rotation {
        let a_turn = (rate / turn).round() as usize;
        let even = resample(&smooth, rate, rotation, a_turn)?;
        rate = turn * even.samples_per_revolution;
        smooth = even.values;
    }
    let lags = (LAGS * period * rate) as usize;
    let length = ((PERIODS * period * rate) as usize).max(2 * lags);
    let blocks = (smooth.len() / length.max(1)).min(BLOCKS.1);
    if blocks < BLOCKS.0 || lags < 8 {
        let need = (BLOCKS.0 as f64 * PERIODS * period * fs) as usize;
        return Err(SignalError::TooShort { what: "the spacing of events", have: x.len(), need });
    }
    let each = correlations(&smooth, blocks, lags);
    let half = (0.5 * period * rate) as usize;
    let least = (2.5 * rate / fs).max(2.0) as usize;
    Ok(highest(&each, [least, half, lags], period * rate).map(|found| EventSpacing {
        seconds: found.lag / rate,
        uncertainty: found.uncertainty / rate,
        clarity: found.clarity,
    }))
}

/// What an autoregressive model of so many coefficients does not predict (Levinson and Durbin's recursion).
fn whitened(x: &[f64], order: usize) -> Vec<f64> {
    let mean = x.iter().sum::<f64>() / x.len() as f64;
    let x: Vec<f64> = x.iter().map(|v| v - mean).collect();
    let lag = |k: usize| x.iter().zip(&x[k.min(x.len())..]).map(|(a, b)| a * b).sum::<f64>();
    let mut r: Vec<f64> = (0..=order).map(lag).collect();
    // A trace of noise: a signal without any is predicted to the last digit.
    r[0] *= 1.0 + 1e-6;
    let (mut a, mut error) = (vec![1.0], r[0]);
    for k in 1..=order {
        if error <= 0.0 {
            break;
        }
        let reflection = -(0..k).map(|j| a[j] * r[k - j]).sum::<f64>() / error;
        a.push(0.0);
        let before = a.clone();
        (1..=k).for_each(|j| a[j] += reflection * before[k - j]);
        error *= 1.0 - reflection * reflection;
    }
    x.windows(a.len()).map(|w| w.iter().rev().zip(&a).map(|(x, a)| x * a).sum()).collect()
}

/// Smoothed by a bell of so many samples' standard deviation, and thinned out as far as that allows; with its rate, Hz.
fn smoothed(x: &[f64], fs: f64, deviation: f64) -> (Vec<f64>, f64) {
    let reach = (BELL * deviation).ceil() as usize;
    let bell: Vec<f64> =
        (0..=2 * reach).map(|k| (-0.5 * ((k as f64 - reach as f64) / deviation).powi(2)).exp()).collect();
    let whole: f64 = bell.iter().sum();
    let step = ((deviation / FINE) as usize).max(1);
    let at = |w: &[f64]| w.iter().zip(&bell).map(|(x, b)| x * b).sum::<f64>() / whole;
    (x.windows(bell.len()).step_by(step).map(at).collect(), fs / step as f64)
}

/// Autocovariance of each block at lags from 0 on.
fn correlations(x: &[f64], blocks: usize, lags: usize) -> Vec<Vec<f64>> {
    let mean = x.iter().sum::<f64>() / x.len() as f64;
    let length = x.len() / blocks;
    let padded = fast_from(length + lags);
    let plan = fft::forward(padded);
    let mut bins = plan.make_output_vec();
    let mut one = |block: &[f64]| {
        let mut room = vec![0.0; padded];
        room.iter_mut().zip(block).for_each(|(to, x)| *to = x - mean);
        plan.process(&mut room, &mut bins).expect("buffers were made by the plan");
        // The power spectrum is even: its transform forwards is the one backwards.
        room.iter_mut().enumerate().for_each(|(k, to)| *to = power(&bins, padded, k));
        plan.process(&mut room, &mut bins).expect("buffers were made by the plan");
        (0..lags).map(|k| bins[k].re / (padded * (length - k)) as f64).collect()
    };
    x.chunks_exact(length).take(blocks).map(&mut one).collect()
}

fn power(bins: &[Complex<f64>], length: usize, k: usize) -> f64 {
    bins[k.min(length - k)].norm_sqr()
}

struct Found {
    lag: f64,
    uncertainty: f64,
    clarity: f64,
}

/// The peak from `least` to `half` that stands highest above its foot, of those that the blocks are sure of, beside the next one of all that are no part of the same pattern.
fn highest(each: &[Vec<f64>], [least, half, lags]: [usize; 3], period: f64) -> Option<Found> {
    let mean: Vec<f64> = (0..each[0].len()).map(|k| mean_of(each.iter().map(|a| a[k]))).collect();
    let mut peaks: Vec<(usize, f64)> = Vec::new();
    for k in least..lags {
        let at = mean[k];
        if !(k > 0 && k + 1 < mean.len() && at > mean[k - 1] && at >= mean[k + 1]) {
            continue;
        }
        let foot = foot(&mean, k);
        let rises: Vec<f64> = each.iter().map(|a| a[k] - a[foot]).collect();
        if mean_of(rises.iter().copied()) > SURE * standard_error(&rises) {
            peaks.push((k, at - mean[foot]));
        }
    }
    peaks.sort_by(|a, b| b.1.total_cmp(&a.1));
    let (peak, rise) = *peaks.iter().find(|(k, _)| *k < half)?;
    let is_rest = |k: usize| (period - (k + peak) as f64).abs() < REST * period;
    let next = peaks.iter().find(|(k, _)| *k != peak && !is_rest(*k)).map_or(0.0, |next| next.1);
    // Jackknife: where the peak is without one block.
    let count = each.len() as f64;
    let places: Vec<f64> = each
        .iter()
        .map(|left| {
            let without = |k: usize| (count * mean[k] - left[k]) / (count - 1.0);
            vertex(&without, peak)
        })
        .collect();
    let uncertainty = (count - 1.0) / count.sqrt() * deviation(&places);
    Some(Found { lag: vertex(&|k| mean[k], peak), uncertainty, clarity: (rise - next) / mean[0] })
}

/// The higher one of the two lowest places to either side of a peak, each up to where the curve is as high again.
fn foot(curve: &[f64], peak: usize) -> usize {
    let lowest = |along: &mut dyn Iterator<Item = usize>| {
        along.take_while(|k| curve[*k] <= curve[peak]).min_by(|a, b| curve[*a].total_cmp(&curve[*b]))
    };
    let sides = [lowest(&mut (0..peak).rev()), lowest(&mut (peak + 1..curve.len()))];
    sides.into_iter().flatten().max_by(|a, b| curve[*a].total_cmp(&curve[*b])).unwrap_or(peak)
}

/// Of a parabola through a value and its neighbours.
fn vertex(curve: &dyn Fn(usize) -> f64, k: usize) -> f64 {
    let (a, b, c) = (curve(k - 1), curve(k), curve(k + 1));
    let bend = a - 2.0 * b + c;
    let off = if bend < 0.0 { (0.5 * (a - c) / bend).clamp(-1.0, 1.0) } else { 0.0 };
    k as f64 + off
}

fn mean_of(x: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = x.len() as f64;
    x.sum::<f64>() / count
}

fn deviation(x: &[f64]) -> f64 {
    let mean = mean_of(x.iter().copied());
    (x.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (x.len() - 1) as f64).sqrt()
}

fn standard_error(x: &[f64]) -> f64 {
    deviation(x) / (x.len() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;
    use std::f64::consts::TAU;

    const FS: f64 = 25_600.0;

    /// Impacts of these heights at these instants (s), each ringing at 3.1 kHz for 0.8 ms; with noise of a tenth of the highest.
    fn ringing(seconds: f64, events: &[(f64, f64)], seed: u64) -> Vec<f64> {
        let mut random = Random::new(seed);
        let mut x: Vec<f64> = (0..(seconds * FS) as usize).map(|_| 0.1 * random.normal()).collect();
        for (at, height) in events {
            let first = (at * FS).ceil() as usize;
            for (k, value) in x.iter_mut().enumerate().skip(first).take(200) {
                let since = k as f64 / FS - at;
                *value += height * (-since / 8e-4).exp() * (TAU * 3100.0 * since).sin();
            }
        }
        x
    }

    /// A pass every 1/90 of a turn's 20 Hz, early or late by a hundredth; a second event `apart` s after the first, or none.
    fn passes(apart: Option<f64>, seed: u64) -> Vec<f64> {
        let mut random = Random::new(seed);
        let first = (0..178).map(|k| ((k as f64 + 0.5 + 0.01 * random.normal()) / 90.0, 0.7)).collect::<Vec<_>>();
        let second = first.iter().filter_map(|(t, _)| Some((t + apart?, 1.0))).collect::<Vec<_>>();
        ringing(2.0, &[first, second].concat(), seed)
    }

    #[test]
    fn analytic_spacing_of_two_events_that_ring_longer_than_it() {
        for (seed, apart) in [(1, 0.6e-3), (2, 1.5625e-3), (3, 3.01e-3)] {
            let found = event_spacing(&passes(Some(apart), seed), FS, (1.0 / 90.0, 6e-5), None).unwrap().unwrap();
            let off = (found.seconds - apart).abs();
            assert!(off < 0.02 * apart && off < 5.0 * found.uncertainty + 0.1 / FS, "{apart}: {found:?}");
            assert!(found.clarity > 0.15, "{found:?}");
        }
    }

    #[test]
    fn prop_one_event_a_pass_has_no_clear_spacing() {
        for seed in 0..12 {
            let found = event_spacing(&passes(None, seed), FS, (1.0 / 90.0, 6e-5), None).unwrap();
            assert!(found.is_none_or(|found| found.clarity < 0.04), "{found:?}");
        }
    }

    #[test]
    fn analytic_spacing_at_a_speed_that_rises_is_that_at_the_speed_asked_for() {
        // 20 Hz plus 5 Hz/s, nine passes in two turns, the second event 0.03 turns after the first.
        let turns = |t: f64| 20.0 * t + 2.5 * t * t;
        let at = |angle: f64| (-20.0 + (400.0 + 10.0 * angle).sqrt()) / 5.0;
        let last = turns(1.95);
        let passes = (1..).map(|k| k as f64 / 4.5).take_while(|angle| angle + 0.03 < last);
        let events: Vec<(f64, f64)> = passes.flat_map(|angle| [(at(angle), 0.7), (at(angle + 0.03), 1.0)]).collect();
        let rotation = Rotation::from_speeds(&[(0.0, 20.0), (2.0, 30.0)]).unwrap();
        let of = (1.0 / (4.5 * 25.0), 6e-5);
        let found = event_spacing(&ringing(2.0, &events, 5), FS, of, Some((&rotation, 25.0))).unwrap().unwrap();
        assert!((found.seconds / (0.03 / 25.0) - 1.0).abs() < 0.03, "{found:?}");
    }

    #[test]
    fn prop_too_short_a_record_is_said_to_be() {
        let why = event_spacing(&passes(Some(1e-3), 1)[..8000], FS, (1.0 / 90.0, 6e-5), None);
        assert!(matches!(why, Err(SignalError::TooShort { .. })), "{why:?}");
    }
}
