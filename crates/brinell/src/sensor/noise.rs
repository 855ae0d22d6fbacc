//! Noise of a stated colour and level, a sample at a time.
//!
//! White noise is independent normal numbers. Coloured noise is a sum of independent Ornstein-Uhlenbeck processes, each
//! sampled exactly: x_k = p x_(k-1) + sqrt(1 - p^2) w_k with p = exp(-2 pi f_i / f_s) has unit variance and, as a
//! process in time, the power spectrum of a first-order low-pass with corner f_i. One, at the lowest corner, is brown
//! noise; equal shares at corners a factor apart add up to 1/f between them (A. van der Ziel, Physica 16 (1950)
//! 359-372). The states start from their stationary distribution, so there is no run-in, and the variance is exactly
//! the one requested. Below the lowest corner the spectrum is flat. From ten times that to a tenth of the sample rate
//! it keeps to its law within 0.3 dB; above, brown noise flattens (by 2.4 dB at 0.4 of the rate), because a sampled
//! process folds.

use std::f64::consts::TAU;

use crate::random::{Random, mix};
use crate::scenario::NoiseColour;

/// From one corner of pink noise to the next; the last lies below half the sample rate.
const APART: f64 = 2.0;

/// What noise is requested; fields as in the scenario, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Level {
    pub(super) rms: f64,
    pub(super) colour: NoiseColour,
    /// Hz; white noise does not use it.
    pub(super) corner: f64,
    pub(super) seed: u64,
}

impl Level {
    /// Corners of the processes, Hz; none for white noise.
    fn corners(&self, rate: f64) -> Vec<f64> {
        match self.colour {
            NoiseColour::White => Vec::new(),
            NoiseColour::Brown => vec![self.corner],
            NoiseColour::Pink => {
                std::iter::successors(Some(self.corner), |f| Some(f * APART)).take_while(|f| *f < 0.5 * rate).collect()
            }
        }
    }

    /// One-sided power spectral density at `f` Hz of samples at `rate` Hz, per Hz.
    #[cfg(test)]
    fn density(&self, f: f64, rate: f64) -> f64 {
        let corners = self.corners(rate);
        let white = 2.0 * self.rms.powi(2) / rate;
        if corners.is_empty() {
            return white;
        }
        let one = |corner: &f64| {
            let p = (-TAU * corner / rate).exp();
            (1.0 - p * p) / (1.0 - 2.0 * p * (TAU * f / rate).cos() + p * p)
        };
        white * corners.iter().map(one).sum::<f64>() / corners.len() as f64
    }
}

/// The noise of one channel.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Noise {
    random: Random,
    /// Of a single process, or of white noise.
    scale: f64,
    /// Memory, its share in the next value, and the new number's.
    processes: Vec<[f64; 3]>,
}

impl Noise {
    /// Noise of channel number `channel`; channels are independent of each other.
    pub(super) fn new(level: Level, rate: f64, channel: u64) -> Self {
        let mut random = Random::new(mix(level.seed ^ mix(channel)));
        let corners = level.corners(rate);
        let processes: Vec<[f64; 3]> = corners
            .iter()
            .map(|corner| {
                let angle = -TAU * corner / rate;
                [random.normal(), angle.exp(), (-(2.0 * angle).exp_m1()).sqrt()]
            })
            .collect();
        Self { scale: level.rms / (processes.len().max(1) as f64).sqrt(), random, processes }
    }

    pub(super) fn next(&mut self) -> f64 {
        if self.processes.is_empty() {
            return self.scale * self.random.normal();
        }
        let mut sum = 0.0;
        for [x, keeps, takes] in &mut self.processes {
            sum += *x;
            *x = *keeps * *x + *takes * self.random.normal();
        }
        self.scale * sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::{Segments, psd};

    const RATE: f64 = 25_600.0;

    fn level(colour: NoiseColour) -> Level {
        Level { rms: 2.5, colour, corner: 1.0, seed: 11 }
    }

    #[test]
    fn analytic_slopes_of_the_colours() {
        use NoiseColour::{Brown, Pink, White};
        for (colour, exponent) in [(White, 0.0), (Pink, 1.0), (Brown, 2.0)] {
            let level = level(colour);
            let density = |f: f64| level.density(f, RATE);
            // From ten times the corner to a tenth of the rate, against the law through their middle.
            let middle = 160.0;
            for k in 0..=300 {
                let f = 10.0 * 256f64.powf(f64::from(k) / 300.0);
                let law = density(middle) * (middle / f).powf(exponent);
                let db = 10.0 * (density(f) / law).log10();
                assert!(db.abs() < 0.3, "{colour:?} at {f} Hz: {db} dB");
            }
            // The whole of it is the variance requested.
            let n = 2_000_000;
            let df = 0.5 * RATE / f64::from(n);
            let power: f64 = (0..n).map(|k| density((f64::from(k) + 0.5) * df) * df).sum();
            assert!((power / level.rms.powi(2) - 1.0).abs() < 1e-6, "{power}");
        }
    }

    #[test]
    fn analytic_samples_have_the_density_stated() {
        for colour in [NoiseColour::White, NoiseColour::Pink, NoiseColour::Brown] {
            let level = level(colour);
            let mut noise = Noise::new(level, RATE, 0);
            let segment = 4096;
            let x: Vec<f64> = (0..400 * segment).map(|_| noise.next()).collect();
            let spectrum = psd(&x, RATE, &Segments::of(segment)).unwrap();
            // Octaves, away from the window's leakage at the lowest bins.
            let df = spectrum.frequency_step;
            let mut low = 64;
            while 2 * low < segment / 2 {
                let bins = low..2 * low;
                let got: f64 = bins.clone().map(|k| spectrum.density[k]).sum();
                let due: f64 = bins.map(|k| level.density(k as f64 * df, RATE)).sum();
                let db = 10.0 * (got / due).log10();
                assert!(db.abs() < 0.1, "{colour:?} from bin {low}: {db} dB");
                low *= 2;
            }
        }
    }

    #[test]
    fn prop_channels_and_seeds_are_apart_and_repeat() {
        let take = |seed: u64, channel: u64| {
            let level = Level { seed, ..level(NoiseColour::Pink) };
            let mut noise = Noise::new(level, RATE, channel);
            (0..64).map(|_| noise.next().to_bits()).collect::<Vec<_>>()
        };
        assert_eq!(take(5, 0), take(5, 0));
        assert_ne!(take(5, 0), take(5, 1));
        assert_ne!(take(5, 0), take(6, 0));
    }

    #[test]
    fn analytic_there_is_no_run_in() {
        // The variance of the first value over many seeds is that of any other: within 4 sqrt(2 / n).
        let n = 20_000_u32;
        let first = |seed: u32| {
            let level = Level { seed: seed.into(), ..level(NoiseColour::Brown) };
            Noise::new(level, RATE, 0).next().powi(2)
        };
        let variance = (0..n).map(first).sum::<f64>() / f64::from(n);
        assert!((variance / 6.25 - 1.0).abs() < 4.0 * (2.0 / f64::from(n)).sqrt());
    }
}
