//! Reference signals that the tests of several rooms share.

use std::f64::consts::TAU;

pub(crate) use crate::random::Random as Noise;

/// `amplitude * cos(2 pi f t + phase)`, n samples from t = 0.
pub(crate) fn cosine(n: usize, fs: f64, f: f64, amplitude: f64, phase: f64) -> Vec<f64> {
    (0..n).map(|i| amplitude * (TAU * f * i as f64 / fs + phase).cos()).collect()
}

/// Impacts at `rate` Hz with independent timing errors of standard deviation `jitter` periods, each ringing a
/// resonance at `resonance` Hz that decays with time constant `decay` s; unit height, plus white noise.
pub(crate) struct ImpactTrain {
    pub(crate) fs: f64,
    pub(crate) rate: f64,
    pub(crate) jitter: f64,
    pub(crate) resonance: f64,
    pub(crate) decay: f64,
    pub(crate) noise: f64,
}

impl ImpactTrain {
    pub(crate) fn generate(&self, n: usize, seed: u64) -> Vec<f64> {
        let mut random = Noise::new(seed);
        let mut x: Vec<f64> = (0..n).map(|_| self.noise * random.normal()).collect();
        let start = random.uniform();
        let count = (n as f64 / self.fs * self.rate).ceil() as usize + 1;
        for k in 0..count {
            let at = (start + k as f64 + self.jitter * random.normal()) / self.rate;
            let first = (at * self.fs).ceil().max(0.0) as usize;
            let last = n.min(first + (12.0 * self.decay * self.fs) as usize);
            for (i, value) in x.iter_mut().enumerate().take(last).skip(first) {
                let since = i as f64 / self.fs - at;
                *value += (-since / self.decay).exp() * (TAU * self.resonance * since).sin();
            }
        }
        x
    }
}

/// Asserts that a value is there and within `relative` of the expected one.
pub(crate) fn close(value: Option<f64>, expected: f64, relative: f64) {
    let value = value.expect("defined");
    assert!((value - expected).abs() <= relative * expected.abs(), "{value} for {expected}");
}
