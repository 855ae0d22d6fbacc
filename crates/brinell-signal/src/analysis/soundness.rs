//! What is wrong with a record itself, whatever the machine.

use std::fmt;

/// The least length of a stretch of one value, in revolutions: no vibration holds still for so long.
const STRETCH: f64 = 0.25;
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
                "{seconds:.3} s of {of:.3} s hold one value, as if sensor or recorder had been off: levels are too low, and a drift of the speed is not sought"
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
            Flaw::Repeats { every } => write!(f, "the record repeats the same {every:.3} s: these alone are judged"),
        }
    }
}

/// Of a signal less its mean, sampled at `fs` Hz on a machine whose shaft turns `shaft` times a second.
pub(super) fn flaws(x: &[f64], fs: f64, shaft: f64) -> Vec<Flaw> {
    let revolution = (fs / shaft).max(4.0);
    [held(x, fs, revolution), at_limits(x), one_event(x, fs, revolution)].into_iter().flatten().collect()
}

fn held(x: &[f64], fs: f64, revolution: f64) -> Option<Flaw> {
    let runs = x.chunk_by(|a, b| a == b).map(<[f64]>::len);
    let samples: usize = runs.filter(|n| *n as f64 >= STRETCH * revolution).sum();
    (samples > 0).then(|| Flaw::Held { seconds: samples as f64 / fs, of: x.len() as f64 / fs })
}

fn at_limits(x: &[f64]) -> Option<Flaw> {
    let (low, high) = (x.iter()).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(*v), b.max(*v)));
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
