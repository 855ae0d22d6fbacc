//! A tilting contact by its tables (section 19): E = E_H(delta_eff(delta, tilt, s), tilt), with the healthy slices' E_H.
//!
//! Forces are the gradient of E: Q along delta, the moment T along tilt, the push P along the damaged surface.

use super::Model;
use crate::defect::{Angles, Defects, Side};
use crate::slices::{Approach, Carried, Slices};

/// A tilting contact on damage.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Leaned {
    /// What it carries at rest; stiffness is the Hessian of E over (delta, tilt).
    pub(crate) carried: Carried,
    /// P of a damaged raceway and of a damaged rolling element, N m.
    pub(crate) push: [f64; 2],
    /// delta or delta_eff, whichever is more, m.
    pub(crate) largest: f64,
}

impl Model {
    /// A contact on damage; `None` off it, and where nothing tilts. Rates do not matter.
    pub(crate) fn leaned(&self, defects: Defects, side: Side, angles: &Angles, at: &Approach) -> Option<Leaned> {
        let slices = self.slices.as_ref()?;
        let met = defects.effective(angles, at.deformation, Some(at.tilt))?;
        let there = Approach { deformation: met.delta, tilt: at.tilt, ..Approach::default() };
        let healthy = slices.carry(self.contact(side), &there);
        let ([k0, k1, k2], q) = (healthy.stiffness, healthy.force);
        let (a, b) = (met.by_delta, met.by_tilt);
        let carried = Carried {
            force: q * a,
            moment: healthy.moment + q * b,
            stiffness: [
                a * a * k0 + q * met.by_delta2,
                a * (k0 * b + k1) + q * met.by_delta_tilt,
                b * (k0 * b + 2.0 * k1) + k2 + q * met.by_tilt2,
            ],
            energy: healthy.energy,
        };
        let push = [q * met.by_raceway, q * met.by_element];
        Some(Leaned { carried, push, largest: at.deformation.max(met.delta) })
    }

    /// How a healthy contact would have to be deformed to hold the energy of this one: what its slices show of damage.
    pub(crate) fn shown_in_slices(&self, (slot, side): (usize, Side), angles: &Angles, at: Approach) -> Approach {
        let tilt = self.layout.tilts.then_some(at.tilt);
        let met = self.defects_of(slot, side).effective(angles, at.deformation, tilt);
        Approach { deformation: met.map_or(at.deformation, |met| met.delta), ..at }
    }

    /// A tilting contact at rest, healthy or damaged.
    pub(crate) fn carried(
        &self,
        slices: &Slices,
        (slot, side): (usize, Side),
        angles: &Angles,
        at: &Approach,
    ) -> Carried {
        let leaned = self.leaned(self.defects_of(slot, side), side, angles, at);
        leaned.map_or_else(|| slices.carry(self.contact(side), at), |leaned| leaned.carried)
    }
}

/// The nearest matrix without negative eigenvalues to a Hessian over (delta, tilt), lengths as delta and tilt times
/// `half`, L/2: [K_t]_+ of section 20 in two dimensions. Entries 11, 12, 22.
pub(crate) fn positive([a, b, c]: [f64; 3], half: f64) -> [f64; 3] {
    let (b, c) = (b / half, c / (half * half));
    let (mean, apart) = (0.5 * (a + c), (0.25 * (a - c) * (a - c) + b * b).sqrt());
    let (low, high) = (mean - apart, mean + apart);
    if high <= 0.0 {
        return [0.0; 3];
    }
    let [a, b, c] = match low < 0.0 {
        true => [a - low, b, c - low].map(|x| x * high / (high - low)),
        false => [a, b, c],
    };
    [a, b * half, c * half * half]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_the_positive_part_of_a_matrix() {
        // Without negative eigenvalues: itself; with them alone: nothing; diagonal: the positive entry.
        assert_eq!(positive([2.0, 0.5, 1.0], 1.0), [2.0, 0.5, 1.0]);
        assert_eq!(positive([-2.0, 0.5, -1.0], 1.0), [0.0; 3]);
        assert_eq!(positive([3.0, 0.0, -2.0], 0.25), [3.0, 0.0, 0.0]);
        // [[0, 1], [1, 0]]: eigenvalue 1 along (1, 1).
        assert_eq!(positive([0.0, 1.0, 0.0], 1.0), [0.5, 0.5, 0.5]);
    }
}
