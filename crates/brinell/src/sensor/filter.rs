//! The chain's analogue parts at the rate of the fast grid, as second-order sections that run.
//!
//! A mode's transfer is N(s) / (s^2 + 2 zeta w s + w^2). The section has its poles mapped exactly, z = exp(s T), so
//! frequency and decay are the mode's own at any w below half the fast rate, and a numerator of three taps that makes
//! the response exact at frequency 0 (a real number) and at the passband's end (a complex one), 0.4 of the output's
//! rate. What lies above is the anti-alias filter's to remove, so the frequencies between are those that count. There
//! the error, relative to the response, stays below 5e-4 where N = w^2 (below 1e-4 for zeta up to 0.1), and below 9e-3
//! where N = 2 zeta w s + w^2 (0.08 dB; that much only far above the mode). The tests hold the section to that.

use std::f64::consts::TAU;

use realfft::num_complex::Complex;

/// One second-order section, `(b0 + b1 z^-1 + b2 z^-2) / (1 + a1 z^-1 + a2 z^-2)`; of first order where b2 = a2 = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Section {
    b: [f64; 3],
    a: [f64; 2],
}

/// What a mode passes on, N(s).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Passes {
    /// w^2: the relative displacement, which a seismic sensor reads, or a low-pass of second order.
    Deflection,
    /// 2 zeta w s + w^2: the acceleration of a mass on a spring and a damper whose foot is moved.
    Transmitted,
}

/// One mode: its frequency (Hz) and share of critical damping, 0 < zeta < 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mode {
    pub(super) frequency: f64,
    pub(super) damping: f64,
    pub(super) passes: Passes,
}

impl Mode {
    /// Transfer at `f` Hz; 1 at 0.
    pub(super) fn response(&self, f: f64) -> Complex<f64> {
        let ratio = f / self.frequency;
        let viscous = Complex::new(0.0, 2.0 * self.damping * ratio);
        let numerator = match self.passes {
            Passes::Deflection => Complex::new(1.0, 0.0),
            Passes::Transmitted => viscous + 1.0,
        };
        numerator / (viscous + (1.0 - ratio * ratio))
    }

    /// As a section at `rate` Hz, of which frequencies up to `edge` count.
    pub(super) fn section(&self, rate: f64, edge: f64) -> Section {
        let w = TAU * self.frequency / rate;
        let pole = Complex::new(-self.damping * w, w * (1.0 - self.damping.powi(2)).sqrt());
        // 1 + a1 z^-1 + a2 z^-2 at the angle, without the loss of digits near z = 1.
        let denominator = |angle: f64| {
            let turned = Complex::new(0.0, angle);
            expm1(pole - turned) * expm1(pole.conj() - turned)
        };
        let angle = TAU * edge / rate;
        // b0 + b1 z^-1 + b2 z^-2, turned by one sample, is b1 + (b0 + b2) cos + i (b0 - b2) sin.
        let sum = denominator(0.0).re;
        let turned = self.response(edge) * denominator(angle) * Complex::from_polar(1.0, angle);
        let even = (sum - turned.re) / (2.0 * (0.5 * angle).sin().powi(2));
        let odd = turned.im / angle.sin();
        Section {
            b: [0.5 * (even + odd), sum - even, 0.5 * (even - odd)],
            a: [-2.0 * pole.re.exp() * pole.im.cos(), (2.0 * pole.re).exp()],
        }
    }
}

/// exp(z) - 1, with all digits near 0.
fn expm1(z: Complex<f64>) -> Complex<f64> {
    let half = (0.5 * z.im).sin();
    Complex::new(z.re.exp_m1() * z.im.cos() - 2.0 * half * half, z.re.exp() * z.im.sin())
}

/// s / (s + w), its pole mapped exactly, no response at frequency 0 and 1 at half the rate. Its error below the
/// passband's end is less than 0.035 w T.
pub(super) fn low_cut(frequency: f64, rate: f64) -> Section {
    let pole = (-TAU * frequency / rate).exp();
    let gain = 0.5 * (1.0 + pole);
    Section { b: [gain, -gain, 0.0], a: [-pole, 0.0] }
}

/// Transfer of [`low_cut`]'s original at `f` Hz.
pub(super) fn low_cut_response(frequency: f64, f: f64) -> Complex<f64> {
    let s = Complex::new(0.0, f / frequency);
    s / (s + 1.0)
}

/// A section with its memory, transposed direct form II.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Running {
    section: Section,
    memory: [f64; 2],
}

impl Running {
    /// At rest.
    pub(super) fn new(section: Section) -> Self {
        Self { section, memory: [0.0; 2] }
    }

    pub(super) fn push(&mut self, x: f64) -> f64 {
        let Section { b, a } = &self.section;
        let y = b[0] * x + self.memory[0];
        self.memory = [b[1] * x - a[0] * y + self.memory[1], b[2] * x - a[1] * y];
        y
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    impl Section {
        /// Its response at z = e^(i `angle`), the angle in radians a sample.
        fn response(&self, angle: f64) -> Complex<f64> {
            let z = Complex::from_polar(1.0, -angle);
            let [b0, b1, b2] = self.b;
            let [a1, a2] = self.a;
            (b0 + z * (b1 + z * b2)) / (1.0 + z * (a1 + z * a2))
        }
    }

    /// Output rate 1, fast rate 8, so frequencies are in units of the output rate.
    const RATE: f64 = 8.0;
    const EDGE: f64 = 0.4;

    #[test]
    fn analytic_modes_keep_their_response_in_the_passband() {
        for damping in [0.005, 0.02, 0.1, 0.5f64.sqrt(), 0.95] {
            let deflection = if damping > 0.1 { 5e-4 } else { 1e-4 };
            for (passes, limit) in [(Passes::Deflection, deflection), (Passes::Transmitted, 9e-3)] {
                for frequency in [1e-4, 1e-2, 0.1, 0.3, 0.45, 0.7, 1.5, 3.9] {
                    let mode = Mode { frequency, damping, passes };
                    let section = mode.section(RATE, EDGE);
                    for k in 1..=2000 {
                        let f = EDGE * f64::from(k) / 2000.0;
                        let exact = mode.response(f);
                        let error = (section.response(TAU * f / RATE) - exact).norm();
                        assert!(error < limit * exact.norm(), "{mode:?} at {f}: {}", error / exact.norm());
                    }
                }
            }
        }
    }

    #[test]
    fn analytic_step_response_of_a_mode() {
        // 1 - exp(-zeta w t) (cos + zeta / sqrt(1 - zeta^2) sin), for a step at t = 0.
        let (frequency, damping) = (0.05, 0.05);
        let mode = Mode { frequency, damping, passes: Passes::Deflection };
        let mut running = Running::new(mode.section(RATE, EDGE));
        let (w, root) = (TAU * frequency, (1.0 - damping * damping).sqrt());
        let mut worst: f64 = 0.0;
        for k in 0..4000 {
            // A sampled step represents one half a sample earlier.
            let t = (f64::from(k) + 0.5) / RATE;
            let turn = w * root * t;
            let exact = 1.0 - (-damping * w * t).exp() * (turn.cos() + damping / root * turn.sin());
            worst = worst.max((running.push(1.0) - exact).abs());
        }
        assert!(worst < 1e-3, "{worst:e}");
    }

    #[test]
    fn analytic_low_cut() {
        for frequency in [1e-5, 1e-3, 1e-2] {
            let section = low_cut(frequency, RATE);
            for k in 0..=4000 {
                let f = EDGE * f64::from(k) / 4000.0;
                let error = section.response(TAU * f / RATE) - low_cut_response(frequency, f);
                assert!(error.norm() < 0.035 * TAU * frequency / RATE);
            }
        }
    }
}
