//! The ADC: whole steps between plus and minus full scale.

/// An ideal converter of N bits over plus and minus full scale: 2^N codes, step 2 R / 2^N, a code at 0, so the highest
/// is R less a step.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Adc {
    step: f64,
    lowest: f64,
    highest: f64,
}

impl Adc {
    pub(super) fn new(bits: usize, full_scale: f64) -> Self {
        let half = 2f64.powi(bits as i32 - 1);
        Self { step: full_scale / half, lowest: -half, highest: half - 1.0 }
    }

    pub(super) fn step(&self) -> f64 {
        self.step
    }

    /// The value that is read, and whether it was beyond the ends.
    pub(super) fn read(&self, x: f64) -> (f64, bool) {
        let code = (x / self.step).round_ties_even();
        let held = code.clamp(self.lowest, self.highest);
        (held * self.step, code != held)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn analytic_steps_ends_and_count() {
        let c = Adc::new(3, 4.0);
        assert_eq!(c.step(), 1.0);
        let read: Vec<(f64, bool)> = [-9.0, -4.4, -0.2, 0.6, 3.4, 3.6].map(|x| c.read(x)).into();
        assert_eq!(read, [(-4.0, true), (-4.0, false), (0.0, false), (1.0, false), (3.0, false), (3.0, true)]);
    }

    #[test]
    fn analytic_error_has_a_twelfth_of_the_step_squared() {
        // Holds where the signal crosses many steps (B. Widrow, IRE Trans. Circuit Theory 3 (1956) 266-276).
        let c = Adc::new(12, 10.0);
        let mut random = Random::new(4);
        let n = 200_000;
        let errors: Vec<f64> = (0..n)
            .map(|_| {
                let x = random.normal();
                c.read(x).0 - x
            })
            .collect();
        let variance = errors.iter().map(|e| e * e).sum::<f64>() / f64::from(n);
        let due = c.step().powi(2) / 12.0;
        // The mean square of n uniform errors strays by sqrt(0.8 / n) of itself.
        assert!((variance / due - 1.0).abs() < 4.0 * (0.8 / f64::from(n)).sqrt());
        assert!(errors.iter().all(|e| e.abs() <= 0.5 * c.step() * (1.0 + 1e-12)));
    }
}
