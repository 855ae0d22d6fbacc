//! Seeded random numbers: SplitMix64 (G. L. Steele, D. Lea and C. H. Flood, "Fast splittable pseudorandom number
//! generators", OOPSLA 2014).
//!
//! Integers and uniform numbers are the same bits on every machine; normal numbers take a logarithm and a cosine, which
//! may round otherwise elsewhere. Not for secrets.

use std::f64::consts::TAU;

/// What the state grows by: 2^64 over the golden ratio.
const STEP: u64 = 0x9E37_79B9_7F4A_7C15;

/// The output of the state that follows `x`: neighbouring integers give unrelated ones.
pub fn mix(x: u64) -> u64 {
    let mut z = x.wrapping_add(STEP);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// A stream of random numbers, a function of its seed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Random(u64);

impl Random {
    /// The stream of a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        let out = mix(self.0);
        self.0 = self.0.wrapping_add(STEP);
        out
    }

    /// From 0 to just below 1, in steps of 2^-53.
    pub fn part(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Strictly between 0 and 1: the middles of 2^53 intervals.
    pub fn uniform(&mut self) -> f64 {
        ((self.bits() >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    /// Standard normal, by Box and Muller.
    pub fn normal(&mut self) -> f64 {
        (-2.0 * self.uniform().ln()).sqrt() * (TAU * self.uniform()).cos()
    }

    /// `n` standard normal numbers.
    #[cfg(test)]
    pub(crate) fn normals(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| self.normal()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lit_splitmix64_of_seed_1234567() {
        // The first outputs, as the authors' reference code gives them.
        let mut random = Random::new(1_234_567);
        let first = [random.bits(), random.bits(), random.bits()];
        assert_eq!(first, [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]);
    }

    #[test]
    fn analytic_moments_of_the_normal() {
        // Of n numbers, the mean strays by 1 / sqrt n, the variance by sqrt(2 / n), the fourth moment by sqrt(96 / n).
        let n = 200_000;
        let x = Random::new(3).normals(n);
        let moment = |k: i32| x.iter().map(|v| v.powi(k)).sum::<f64>() / n as f64;
        let unit = 1.0 / (n as f64).sqrt();
        assert!(moment(1).abs() < 4.0 * unit);
        assert!((moment(2) - 1.0).abs() < 4.0 * 2f64.sqrt() * unit);
        assert!((moment(4) - 3.0).abs() < 4.0 * 96f64.sqrt() * unit);
    }
}
