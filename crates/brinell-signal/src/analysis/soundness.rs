//! What is wrong with a record itself, whatever the machine.

use crate::digits::short;
use std::fmt;

/// The least length of a stretch of one value, in revolutions: no vibration holds still for so long.
const STRETCH: f64 = 0.25;
/// Of a dropout, which is shorter: samples at least, so many times the length that 99 of 100 stretches of one value stay
/// below (a coarse ADC's noise, a slow signal's steps), and the share of the record that all of them take.
const DROPOUT: (usize, usize, f64) = (24, 8, 1e-3);
/// Share of the energy that a straight line holds from which levels are those of a drift.
const TREND: f64 = 0.5;
/// Share of the samples at the largest or the smallest value from which an ADC is taken to have been driven beyond its
/// range; and how many.
const AT_LIMITS: (f64, usize) = (1e-3, 20);
/// Share of the signal's energy in one revolution from which levels are that revolution's, and revolutions from which
/// it says something.
const ONE_EVENT: (f64, usize) = (0.5, 10);

/// A fault of a record, in words by its `Display`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Flaw {
    /// So many s of so many hold one value each: sensor or recorder was off.
    Held {
        /// s.
        seconds: f64,
        /// Length of the record, s.
        of: f64,
    },
    /// A straight line holds most of the energy: a sensor that is DC-coupled, or warms up.
    Trend {
        /// From the first sample to the last, in the signal's unit.
        by: f64,
        /// Of the energy, 0 to 1.
        share: f64,
    },
    /// Share of samples at the largest or the smallest value: clipped, or coarsely quantised.
    AtLimits {
        /// 0 to 1.
        share: f64,
    },
    /// One revolution holds most of the signal's energy.
    OneEvent {
        /// Where it begins, s.
        at: f64,
        /// Of the energy, 0 to 1.
        share: f64,
    },
    /// Lines are the shaft's at another sample rate than the one given.
    OtherRate {
        /// Hz.
        fits: f64,
        /// Hz.
        given: f64,
        /// How many of the shaft's first ten.
        lines: usize,
    },
    /// One stretch again and again, to the bit.
    Repeats {
        /// Its length, s.
        every: f64,
    },
}

impl fmt::Display for Flaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Flaw::Held { seconds, of } => write!(
                f,
                "{seconds:.3} s of {of:.3} s hold one value, as if sensor or recorder had been off, or samples were lost: levels are not right \
                 (an RMS may be too low, and the steps make a velocity too high), and a drift of the speed is not sought"
            ),
            Flaw::Trend { by, share } => write!(
                f,
                "the signal drifts by {} (in its unit) over the record, in a line that holds {:.0} % of its energy: RMS and peak are the drift's, and hide \
                 crest factor and kurtosis; use a high-pass filter or the sensor's AC coupling",
                short(*by, 3),
                100.0 * share
            ),
            Flaw::AtLimits { share } => write!(
                f,
                "{:.2} % of the samples are at the largest or the smallest value: clipped, or coarsely quantised",
                100.0 * share
            ),
            Flaw::OneEvent { at, share } => write!(
                f,
                "{:.0} % of the signal's energy lie in one revolution, from {at:.3} s on: levels are that event's, and lines may be lost in it; analyse a stretch without it",
                100.0 * share
            ),
            Flaw::OtherRate { fits, given, lines } => write!(
                f,
                "{lines} lines would be the shaft's first ten at a sample rate of {fits} Hz, and hardly any are at the {given} Hz given: is the rate right, or the speed? \
                 A shaft that turns {} times as fast has the same lines",
                short(given / fits, 3)
            ),
            Flaw::Repeats { every } => write!(f, "the record repeats the same {every:.3} s: these alone are judged"),
        }
    }
}

/// Of a signal less its mean, sampled at `fs` Hz on a machine whose shaft turns `shaft` times a second.
pub(super) fn flaws(x: &[f64], fs: f64, shaft: f64) -> Vec<Flaw> {
    let revolution = (fs / shaft).max(4.0);
    [held(x, fs, revolution), trend(x), at_limits(x), one_event(x, fs, revolution)].into_iter().flatten().collect()
}

fn held(x: &[f64], fs: f64, revolution: f64) -> Option<Flaw> {
    let is_off = |n: usize| n as f64 >= STRETCH * revolution;
    let (low, high) = limits(x);
    let mut lengths: Vec<usize> = x.chunk_by(|a, b| a == b).map(<[f64]>::len).collect();
    let usual = 99 * (lengths.len() - 1) / 100;
    let usual = *lengths.select_nth_unstable(usual).1;
    let least = DROPOUT.0.max(DROPOUT.1 * usual);
    let (mut off, mut dropped) = (0, 0);
    for run in x.chunk_by(|a, b| a == b) {
        match run.len() {
            n if is_off(n) => off += n,
            // At the limits it is clipped.
            n if n >= least && run[0] > low && run[0] < high => dropped += n,
            _ => {}
        }
    }
    let dropped = if dropped as f64 >= DROPOUT.2 * x.len() as f64 && !is_coarse(x) { dropped } else { 0 };
    let samples = off + dropped;
    (samples > 0).then(|| Flaw::Held { seconds: samples as f64 / fs, of: x.len() as f64 / fs })
}

/// The straight line of least squares, where it holds most of what there is.
fn trend(x: &[f64]) -> Option<Flaw> {
    let middle = 0.5 * (x.len() as f64 - 1.0);
    let (mut with_time, mut of_time, mut energy) = (0.0, 0.0, 0.0);
    for (i, v) in x.iter().enumerate() {
        let t = i as f64 - middle;
        with_time += t * v;
        of_time += t * t;
        energy += v * v;
    }
    let slope = with_time / of_time;
    let share = slope * with_time / energy;
    (share >= TREND).then_some(Flaw::Trend { by: 2.0 * middle * slope, share })
}

/// Whether most steps are one step of the ADC: then a slow signal stays at a value without being off.
fn is_coarse(x: &[f64]) -> bool {
    let steps = || x.windows(2).map(|w| (w[1] - w[0]).abs()).filter(|d| *d > 0.0);
    let least = steps().fold(f64::INFINITY, f64::min);
    let (all, small) = steps().fold((0, 0), |(all, small), d| (all + 1, small + usize::from(d < 1.5 * least)));
    2 * small >= all
}

fn limits(x: &[f64]) -> (f64, f64) {
    (x.iter()).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(*v), b.max(*v)))
}

fn at_limits(x: &[f64]) -> Option<Flaw> {
    let (low, high) = limits(x);
    let count = x.iter().filter(|v| **v == low || **v == high).count();
    let share = count as f64 / x.len() as f64;
    (share >= AT_LIMITS.0 && count >= AT_LIMITS.1).then_some(Flaw::AtLimits { share })
}

fn one_event(x: &[f64], fs: f64, revolution: f64) -> Option<Flaw> {
    let blocks = x.chunks(revolution as usize);
    if blocks.len() < ONE_EVENT.1 {
        return None;
    }
    let energies = blocks.map(|b| b.iter().map(|v| v * v).sum::<f64>());
    let (mut whole, mut largest) = (0.0, (0, 0.0));
    for (k, energy) in energies.enumerate() {
        whole += energy;
        if energy > largest.1 {
            largest = (k, energy);
        }
    }
    let share = largest.1 / whole;
    (share >= ONE_EVENT.0).then(|| Flaw::OneEvent { at: (largest.0 * revolution as usize) as f64 / fs, share })
}

/// How many samples a signal repeats to the bit, from its first on; the last time not to the end, where need be. `None`
/// where the stretch is there less than twice, and of a constant. By the longest beginning that is an end too (D. E.
/// Knuth, J. H. Morris and V. R. Pratt, SIAM J. Comput. 6 (1977) 323-350).
pub fn repetition(x: &[f64]) -> Option<usize> {
    // Of the samples up to each.
    let mut borders = vec![0_u32; x.len()];
    let mut border = 0;
    for i in 1..x.len() {
        while border > 0 && x[i] != x[border] {
            border = borders[border - 1] as usize;
        }
        border += usize::from(x[i] == x[border]);
        borders[i] = border as u32;
    }
    let period = x.len() - border;
    // A constant repeats nothing.
    (period > 1 && 2 * period <= x.len()).then_some(period)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    const FS: f64 = 10_000.0;
    const SHAFT: f64 = 25.0;

    fn noise() -> Vec<f64> {
        let mut random = Random::new(1);
        (0..20_000).map(|_| random.normal()).collect()
    }

    #[test]
    fn analytic_each_flaw_is_reported_and_noise_has_none() {
        assert_eq!(flaws(&noise(), FS, SHAFT), []);
        let mut off = noise();
        off[10_000..].fill(0.0);
        let held = Flaw::Held { seconds: 1.0, of: 2.0 };
        assert_eq!(flaws(&off, FS, SHAFT), [held]);
        // As many as a recorder loses by the packet.
        let mut lost = noise();
        for k in 0..10 {
            let value = lost[1_000 + 1_900 * k];
            lost[1_000 + 1_900 * k..1_060 + 1_900 * k].fill(value);
        }
        let dropouts = Flaw::Held { seconds: 0.06, of: 2.0 };
        assert_eq!(flaws(&lost, FS, SHAFT), [dropouts]);
        // An ADC of a few steps, and a slow line on one of many: no dropouts, whatever else.
        let coarse: Vec<f64> = noise().iter().map(|v| (0.3 * v).round()).collect();
        let slow: Vec<f64> = (0..20_000).map(|i| (50.0 * (1e-3 * f64::from(i)).sin()).round()).collect();
        for x in [coarse, slow] {
            assert!(!flaws(&x, FS, 5.0).iter().any(|f| matches!(f, Flaw::Held { .. })));
        }
        // A ramp of 30 from end to end has a variance of 75 beside 1.
        let ramp: Vec<f64> =
            (noise().iter().enumerate()).map(|(i, v)| v + 30.0 * (i as f64 / 20_000.0 - 0.5)).collect();
        let found = flaws(&ramp, FS, SHAFT);
        assert!(
            matches!(found[..], [Flaw::Trend { by, share }] if (by - 30.0).abs() < 0.3 && (share - 75.0 / 76.0).abs() < 2e-3)
        );
        // 4.55 % of normal numbers lie beyond two standard deviations.
        let clipped: Vec<f64> = noise().iter().map(|v| v.clamp(-2.0, 2.0)).collect();
        let found = flaws(&clipped, FS, SHAFT);
        assert!(matches!(found[..], [Flaw::AtLimits { share }] if (share - 0.0455).abs() < 0.006));
        // The last time not to its end.
        let looped: Vec<f64> = noise()[..5000].iter().cycle().take(18_000).copied().collect();
        assert_eq!((repetition(&looped), repetition(&noise())), (Some(5000), None));
        // An energy of 40 000 beside 20 000.
        let mut struck = noise();
        struck[8_100] = 200.0;
        let found = flaws(&struck, FS, SHAFT);
        assert!(matches!(found[..], [Flaw::OneEvent { at, share }] if at == 0.8 && (share - 2.0 / 3.0).abs() < 0.02));
    }
}
