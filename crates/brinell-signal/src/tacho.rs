//! Speed from a channel of pulses, `n` a turn: a tachometer's or an encoder's, analogue or TTL.
//!
//! A pulse is a rising edge through the middle of the two levels between which the signal lies, taken between two
//! samples by a straight line; it counts after the signal was well below. Speeds are averaged over whole turns, so that
//! the unequal spacing of an encoder's marks is none of the speed.

use crate::error::{SignalError, require};

/// A speed that strays from its mean by more than this share is followed; below, a usual tolerance covers it.
pub const VARIES: f64 = 0.005;
/// Rising edges that a speed takes.
const FEWEST: usize = 3;
/// Samples from one pulse to the next, at least: fewer may be another pulse's.
const LEAST_SAMPLES: f64 = 4.0;
/// An edge counts after the signal was below this share of the way between its levels, and is passed at this one.
const LOW: f64 = 0.3;
const HIGH: f64 = 0.7;
/// Share of the samples that may lie beyond the two levels: spikes.
const OUTLIERS: f64 = 1e-3;
/// Share of the intervals that may be no whole number of pulses.
const IRREGULAR: f64 = 0.05;
/// How far from a whole number of steps an interval of two and more may be, steps.
const LOST: f64 = 0.2;

/// Why pulses give no speed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoSpeed {
    /// Too few of them.
    #[error("it has {0} rising edges, and a speed takes {FEWEST} or more")]
    Few(usize),
    /// They follow each other too fast for the sample rate.
    #[error(
        "its pulses are {0:.1} samples apart, and they can be told apart from {LEAST_SAMPLES} on: record it faster"
    )]
    Fast(f64),
    /// They do not follow each other evenly.
    #[error(
        "its rising edges are uneven: {irregular} of {intervals} intervals are no whole number of the usual {usual_ms:.3} ms, the first at {first_s:.4} s{}",
        if 4 * irregular > *intervals { "; a channel without pulses looks so" } else { "" }
    )]
    Uneven {
        /// Intervals that are none.
        irregular: usize,
        /// Of how many.
        intervals: usize,
        /// The usual one, ms.
        usual_ms: f64,
        /// Where the first of them begins, s.
        first_s: f64,
    },
    /// The samples are no signal.
    #[error(transparent)]
    Signal(#[from] SignalError),
}

/// The times, s, of the rising edges of `x`, sampled at `fs` Hz.
fn edges(x: &[f64], fs: f64) -> Vec<f64> {
    let Some([low, high]) = levels(x) else {
        return Vec::new();
    };
    let at = |share: f64| low + share * (high - low);
    let (middle, rearm, passed) = (at(0.5), at(LOW), at(HIGH));
    let (mut edges, mut armed, mut crossing) = (Vec::new(), false, None);
    for (i, pair) in x.windows(2).enumerate() {
        if pair[0] <= rearm {
            (armed, crossing) = (true, None);
        }
        if armed && pair[0] < middle && pair[1] >= middle {
            crossing = Some((i as f64 + (middle - pair[0]) / (pair[1] - pair[0])) / fs);
        }
        if pair[1] >= passed && armed {
            edges.extend(crossing);
            armed = false;
        }
    }
    edges
}

/// The two levels about which the samples lie: the means of those above and below the middle between both.
fn levels(x: &[f64]) -> Option<[f64; 2]> {
    let mut sorted = x.to_vec();
    sorted.sort_by(f64::total_cmp);
    let outliers = (OUTLIERS * x.len() as f64) as usize;
    let within = &sorted[outliers..sorted.len() - outliers];
    // Pulses may be as short as spikes are few.
    let ends = |s: &[f64]| Some([*s.first()?, *s.last()?]).filter(|[low, high]| low < high);
    let [mut low, mut high] = ends(within).or_else(|| ends(&sorted))?;
    let all = if ends(within).is_some() { within } else { &sorted };
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        let (below, above) = all.split_at(all.partition_point(|v| *v < middle));
        if below.is_empty() || above.is_empty() {
            return None;
        }
        let next = [mean(below), mean(above)];
        if next == [low, high] {
            break;
        }
        [low, high] = next;
    }
    Some([low, high])
}

/// Speed at each sample, in turns a second, by the rising edges of `x`, sampled at `fs` Hz, of which there are
/// `a_turn`: the mean of each turn at its middle, and straight lines between.
///
/// # Errors
/// [`NoSpeed`] says why there is none.
pub fn speed_by_pulses(x: &[f64], fs: f64, a_turn: u32) -> Result<Vec<f64>, NoSpeed> {
    require(fs > 0.0 && fs.is_finite(), "sample rate (Hz)", fs, "above 0")?;
    require(a_turn > 0, "pulses a turn", f64::from(a_turn), "1 or more")?;
    if let Some(index) = x.iter().position(|v| !v.is_finite()) {
        return Err(SignalError::NotFinite { index }.into());
    }
    let edges = edges(x, fs);
    if edges.len() < FEWEST {
        return Err(NoSpeed::Few(edges.len()));
    }
    let counted = counted(&edges, fs)?;
    // Whole turns, or all there is of one.
    let last = counted.len() - 1;
    let each = (a_turn as usize).min(last);
    let points: Vec<(f64, f64)> = (0..=last - each)
        .map(|i| {
            let ((from, first), (to, end)) = (counted[i], counted[i + each]);
            (0.5 * (from + to), (end - first) / f64::from(a_turn) / (to - from))
        })
        .collect();
    let mut next = 0;
    let speeds = (0..x.len()).map(|i| {
        let t = i as f64 / fs;
        while next < points.len() && points[next].0 <= t {
            next += 1;
        }
        match (next.checked_sub(1).map(|k| points[k]), points.get(next).copied()) {
            (Some((from, a)), Some((to, b))) => a + (b - a) * (t - from) / (to - from),
            (Some((_, only)), None) | (None, Some((_, only))) => only,
            (None, None) => f64::NAN,
        }
    });
    Ok(speeds.collect())
}

/// Every edge with its number, which leaves out what was lost; edges that are none are dropped.
fn counted(edges: &[f64], fs: f64) -> Result<Vec<(f64, f64)>, NoSpeed> {
    let steps: Vec<f64> = edges.windows(2).map(|w| w[1] - w[0]).collect();
    let middle = |steps: &[f64]| {
        let mut steps = steps.to_vec();
        let half = steps.len() / 2;
        *steps.select_nth_unstable_by(half, f64::total_cmp).1
    };
    let usual = middle(&steps);
    if usual * fs < LEAST_SAMPLES {
        return Err(NoSpeed::Fast(usual * fs));
    }
    let (mut counted, mut irregular, mut first) = (vec![(edges[0], 0.0)], 0, None);
    for (i, edge) in edges.iter().enumerate().skip(1) {
        // Speeds vary: the usual step is that of the neighbours.
        let near = middle(&steps[i.saturating_sub(6)..steps.len().min(i + 5)]);
        let (before, number) = counted[counted.len() - 1];
        let turns = (edge - before) / near;
        // One that is lost leaves a whole number of steps.
        let off = if turns < 1.5 { (turns - 1.0).abs() / 0.4 } else { (turns - turns.round()).abs() / LOST };
        if off > 1.0 {
            irregular += 1;
            first = first.or(Some(before));
        }
        if turns > 0.5 {
            counted.push((*edge, number + turns.round().max(1.0)));
        }
    }
    match first {
        Some(first_s) if irregular as f64 > IRREGULAR * steps.len() as f64 => {
            Err(NoSpeed::Uneven { irregular, intervals: steps.len(), usual_ms: 1e3 * usual, first_s })
        }
        _ => Ok(counted),
    }
}

/// Whether a channel that is to hold speeds holds pulses: it keeps coming from near 0, or from below, to a level above.
pub fn are_pulses(x: &[f64], fs: f64) -> bool {
    let from_zero = levels(x).is_some_and(|[low, high]| low <= 0.2 * high && high > 0.0);
    from_zero && speed_by_pulses(x, fs, 1).is_ok()
}

/// The course of speeds sampled at `rate` Hz, whose unit is r/min and whose mean is `mean`: times, s, and means over a
/// tenth of a second or two turns, whichever is longer; none where they stay within [`VARIES`] of the mean.
pub fn course(values: &[f64], rate: f64, mean: f64) -> Vec<(f64, f64)> {
    let seconds = f64::max(0.1, 120.0 / mean.abs().max(1.0));
    let each = ((seconds * rate).round() as usize).max(1);
    let points: Vec<(f64, f64)> = (values.chunks(each).enumerate())
        .map(|(i, part)| {
            let middle = (i * each) as f64 + 0.5 * part.len() as f64;
            (middle / rate, part.iter().sum::<f64>() / part.len() as f64)
        })
        .collect();
    if varies(&points, mean) { points } else { Vec::new() }
}

/// Whether a course strays from its mean by more than [`VARIES`].
pub fn varies(course: &[(f64, f64)], mean: f64) -> bool {
    (course.iter()).any(|(_, v)| (v - mean).abs() > VARIES * mean.abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;
    use std::f64::consts::TAU;

    /// Pulses of a shaft whose angle in turns is given: level, width as a share, and noise.
    fn pulses(n: usize, fs: f64, a_turn: f64, angle: impl Fn(f64) -> f64, width: f64, noise: f64) -> Vec<f64> {
        let mut rng = Random::new(7);
        (0..n)
            .map(|i| {
                let phase = (a_turn * angle(i as f64 / fs)).rem_euclid(1.0);
                5.0 * f64::from(u8::from(phase < width)) + noise * rng.normal()
            })
            .collect()
    }

    #[test]
    fn analytic_pulses_give_the_speed() {
        let fs = 10_000.0;
        for (a_turn, width) in [(1, 0.02), (1, 0.5), (1, 0.98), (16, 0.5)] {
            let x = pulses(30_000, fs, f64::from(a_turn), |t| 24.3 * t, width, 0.2);
            let speed = speed_by_pulses(&x, fs, a_turn).unwrap();
            assert_eq!(speed.len(), x.len());
            // An edge is known to half a sample or so.
            assert!(speed.iter().all(|v| (v / 24.3 - 1.0).abs() < 0.01), "{a_turn} {width}");
            let mean = speed.iter().sum::<f64>() / speed.len() as f64;
            assert!((mean / 24.3 - 1.0).abs() < 1e-3, "{mean}");
        }
        // Analogue: a sine, and a falling pulse.
        let sine: Vec<f64> = (0..30_000).map(|i| 0.3 * (TAU * 24.3 * i as f64 / fs).sin()).collect();
        assert!(speed_by_pulses(&sine, fs, 1).unwrap().iter().all(|v| (v / 24.3 - 1.0).abs() < 1e-3));
        let falling: Vec<f64> = pulses(30_000, fs, 1.0, |t| 24.3 * t, 0.1, 0.1).iter().map(|v| -v).collect();
        assert!(speed_by_pulses(&falling, fs, 1).unwrap().iter().all(|v| (v / 24.3 - 1.0).abs() < 0.01));
    }

    /// A run-up from 10 to 30 turns a second in 4 s.
    #[test]
    fn analytic_pulses_follow_a_run_up() {
        let fs = 20_000.0;
        for a_turn in [1, 8] {
            let x = pulses(80_000, fs, f64::from(a_turn), |t| 10.0 * t + 2.5 * t * t, 0.3, 0.1);
            let speed = speed_by_pulses(&x, fs, a_turn).unwrap();
            // Beyond the middle of the first and the last whole turn nothing is known.
            for (i, v) in speed.iter().enumerate().skip(4000).take(74_000) {
                let expected = 10.0 + 5.0 * i as f64 / fs;
                assert!((v / expected - 1.0).abs() < 0.015, "{i}: {v} {expected}");
            }
        }
    }

    #[test]
    fn prop_spikes_and_lost_pulses_leave_the_speed() {
        let fs = 10_000.0;
        let mut x = pulses(60_000, fs, 1.0, |t| 20.0 * t, 0.2, 0.1);
        x[30_700] = 50.0;
        x[45_100] = -40.0;
        // A pulse is lost.
        x[24_990..25_110].fill(0.0);
        let speed = speed_by_pulses(&x, fs, 1).unwrap();
        let worst = speed.iter().map(|v| (v / 20.0 - 1.0).abs()).fold(0.0, f64::max);
        assert!(worst < 0.02, "{worst}");
    }

    #[test]
    fn prop_what_is_no_train_of_pulses_gives_no_speed() {
        let fs = 10_000.0;
        let mut rng = Random::new(3);
        let noise: Vec<f64> = (0..20_000).map(|_| rng.normal()).collect();
        assert!(speed_by_pulses(&noise, fs, 1).is_err());
        assert_eq!(speed_by_pulses(&[0.0; 100], fs, 1), Err(NoSpeed::Few(0)));
        let fast = pulses(10_000, fs, 1000.0, |t| 3.0 * t, 0.5, 0.0);
        assert!(matches!(speed_by_pulses(&fast, fs, 1000), Err(NoSpeed::Fast(_))));
        // Speeds are no pulses.
        let speeds: Vec<f64> = (0..10_000).map(|i| 1500.0 + 30.0 * (i as f64 / 500.0).sin()).collect();
        assert!(!are_pulses(&speeds, fs) && are_pulses(&pulses(20_000, fs, 1.0, |t| 24.0 * t, 0.1, 0.1), fs));
    }
}
