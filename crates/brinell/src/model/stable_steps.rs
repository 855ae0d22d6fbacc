//! Longest steps in which the explicit solver damps a roller on its contacts, by the largest contact force.

use crate::contact::{SIDES, Side};
use crate::solver::DAMPED_CONTACT;

/// Binary orders of the contact forces that [`StableSteps`] lists: 1 mN to 16 MN.
const LEAST: i32 = -10;
const ORDERS: usize = 35;
/// Orders by which lighter loads count: what grows at a hundredth of the load opens its contact, and stays as small.
const LIGHTER: usize = 7;

/// Longest steps, s, of a roller under any contact forces up to a largest.
///
/// Under a lighter load a contact is softer, but section 20 damps it less, and the solver's limit is least at damping ratios of 0.2 to
/// 0.4: the heaviest contact is not always the one that sets the step.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StableSteps {
    /// By the largest force, 2^(LEAST + k) N.
    steps: [f64; ORDERS],
}

impl StableSteps {
    /// Of a roller of this mass, kg; `spring` gives the tangent stiffness (N/m) and the damping (N s/m) of a contact under an elastic force, N.
    pub(super) fn new(spring: impl Fn(Side, f64) -> [f64; 2], mass: f64) -> Self {
        let of_one: [f64; ORDERS] = std::array::from_fn(|k| {
            let force = f64::from(LEAST + k as i32).exp2();
            let [inner, outer] = SIDES.map(|side| spring(side, force));
            // Between the raceways, or on one of them.
            let springs = [[inner[0] + outer[0], inner[1] + outer[1]], inner, outer];
            springs.map(|spring| decaying_step(spring, mass)).into_iter().fold(f64::INFINITY, f64::min)
        });
        Self {
            steps: std::array::from_fn(|k| {
                of_one[k.saturating_sub(LIGHTER)..=k].iter().copied().fold(f64::INFINITY, f64::min)
            }),
        }
    }

    /// Where no contact carries more than `force`, N.
    pub(super) fn up_to(&self, force: f64) -> f64 {
        if force <= 0.0 {
            return f64::INFINITY;
        }
        let at = (f64::from((force as f32).log2()) - f64::from(LEAST)).clamp(0.0, (ORDERS - 1) as f64);
        let k = (at as usize).min(ORDERS - 2);
        self.steps[k] + (at - k as f64) * (self.steps[k + 1] - self.steps[k])
    }
}

/// Longest step in which m x'' + c x' + k x = 0 decays, s.
fn decaying_step([k, c]: [f64; 2], m: f64) -> f64 {
    let under_root = 0.25 * c * c - k * m;
    let rate = if under_root > 0.0 { (0.5 * c + under_root.sqrt()) / m } else { (k / m).sqrt() };
    DAMPED_CONTACT.stability_limit(rate, 0.5 * c / (k * m).sqrt())
}
