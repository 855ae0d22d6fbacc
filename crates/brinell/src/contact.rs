//! Normal contact of a rolling element and a raceway: [`ContactLaw`] for a law of one's own; the program's load-deflection law, healthy and damaged.
//!
//! Section 2 of the model and Eqs. (21)-(23), (29), (36). All SI; delta > 0 is the elastic deformation, the approach of
//! the bodies beyond first touch.

#[doc(hidden)]
pub mod ball;
mod damping;
#[doc(hidden)]
pub mod film;
mod law;
mod side;

use crate::elementary::Exponent;
use crate::lanes::{Lanes, eight_ninths};
#[doc(hidden)]
pub use damping::{Damping, damped};
pub use law::{ContactLaw, Elastic, Place, check};
pub(crate) use law::{deflection, usual};
pub use side::{SIDES, Side};

/// Palmgren's line contact, K = 8.06e4 L^(8/9) N/mm^(10/9) with L in mm (Eq. 21 with its exponent mended): from
/// the effective contact length in mm to N/m^(10/9).
#[doc(hidden)]
pub fn palmgren_stiffness(length_mm: f64) -> f64 {
    8.06e4 * length_mm.powf(8.0 / 9.0) * 1e3f64.powf(10.0 / 9.0)
}

/// Whether n is that of line contact, 10/9.
pub(crate) fn is_line_exponent(n: f64) -> bool {
    Exponent::new(n) == Exponent::TenNinths
}

/// Share g = ((L - L_s)/L)^(8/9) of a contact's stiffness that the undamaged length keeps (Eq. 23); 1 where L_s = 0,
/// to the bit.
#[inline]
#[doc(hidden)]
pub fn remaining_share(length: f64, damaged: f64) -> f64 {
    let share = ((length - damaged) / length).max(0.0);
    if share == 1.0 { 1.0 } else { eight_ninths(share) }
}

/// What damage leaves of a contact at one instant: the share g and the depth h of the floor.
#[doc(hidden)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactReduction {
    /// g in [0, 1].
    pub share: f64,
    /// h, m.
    pub depth: f64,
    /// L_s, m.
    pub damaged_length: f64,
}

/// Load-deflection law of one raceway.
#[doc(hidden)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadDeflection {
    /// K of the healthy contact, N/m^n.
    pub stiffness: f64,
    /// n.
    pub exponent: Exponent,
    /// Damping.
    pub damping: Damping,
    /// R_w of a ball's ellipse, m, whose half-axis across the groove is sqrt(2 R_w delta); `None` of rollers.
    pub across: Option<f64>,
}

impl LoadDeflection {
    /// K `[delta]_+^n` of each lane, N: Eqs. (29), (36).
    #[inline(always)]
    pub fn healthy<L: Lanes>(&self, delta: L) -> L {
        L::splat(self.stiffness) * self.exponent.of(delta)
    }

    /// Law `ecl`: K (g `[delta]_+^n` + (1 - g) `[delta - h]_+^n`), N.
    #[inline]
    pub fn damaged(&self, delta: f64, floor: &ContactReduction) -> f64 {
        self.damaged_given(self.exponent.of(delta), delta, floor)
    }

    /// The same where `[delta]_+^n` is known already.
    #[inline]
    pub fn damaged_given(&self, power: f64, delta: f64, floor: &ContactReduction) -> f64 {
        let sunk = self.exponent.of(delta - floor.depth);
        self.stiffness * (floor.share * power + (1.0 - floor.share) * sunk)
    }

    /// c of healthy contacts deformed by `delta` that carry `elastic`, in each lane, N s/m: sections 2 and 20.
    #[inline(always)]
    pub fn damper<L: Lanes>(&self, elastic: L, delta: L) -> L {
        match self.damping {
            Damping::Constant(c) => L::splat(c),
            // tau x/(x + delta_s) K_t, with K_t = n Q/x.
            Damping::Time { tau, roughness } => {
                L::splat(tau * self.exponent.value()) * elastic / (delta.positive_part() + L::splat(roughness))
            }
        }
    }

    /// Elastic energy of the healthy contact, J.
    #[inline]
    pub fn energy(&self, delta: f64) -> f64 {
        self.healthy(delta) * delta.max(0.0) / (self.exponent.value() + 1.0)
    }

    /// Elastic energy of a damaged contact, J.
    #[inline]
    pub fn damaged_energy(&self, delta: f64, floor: &ContactReduction) -> f64 {
        floor.share * self.energy(delta) + (1.0 - floor.share) * self.energy(delta - floor.depth)
    }

    /// Axis of a ball's ellipse across the groove at a deformation, m; `None` of rollers.
    #[inline]
    pub fn axis_across(&self, delta: f64) -> Option<f64> {
        self.across.map(|radius| 2.0 * (2.0 * radius * delta.max(0.0)).sqrt())
    }

    /// d(elastic)/d(delta) of the healthy contact, N/m.
    #[inline]
    pub fn tangent(&self, delta: f64) -> f64 {
        if delta > 0.0 { self.exponent.value() * self.healthy(delta) / delta } else { 0.0 }
    }

    /// d(elastic)/d(delta) of a damaged contact, N/m.
    pub fn damaged_tangent(&self, delta: f64, floor: &ContactReduction) -> f64 {
        floor.share * self.tangent(delta) + (1.0 - floor.share) * self.tangent(delta - floor.depth)
    }

    /// d(elastic)/d(delta) of a healthy contact that carries `force` > 0, N/m: n K^(1/n) Q^(1 - 1/n). To seven digits:
    /// it is a scale.
    #[inline]
    pub fn tangent_at(&self, force: f64) -> f64 {
        let n = self.exponent.value();
        n * force * f64::from(((self.stiffness / force) as f32).powf((1.0 / n) as f32))
    }

    /// Elastic deformation that carries `force` on the healthy contact, m.
    pub fn deflection(&self, force: f64) -> f64 {
        (force.max(0.0) / self.stiffness).powf(1.0 / self.exponent.value())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NN3007: LoadDeflection = LoadDeflection {
        stiffness: 1.898e8,
        exponent: Exponent::TenNinths,
        damping: Damping::Constant(200.0),
        across: None,
    };

    #[test]
    fn analytic_palmgren_inverts_his_deflection_formula() {
        // delta = 3.84e-5 Q^0.9 / l^0.8 in N and mm; the rounded 8.06e4 departs from the exact inverse by 0.1 %.
        let length = 6.0_f64;
        for force in [1.0, 30.0, 500.0, 2e4] {
            let delta = 3.84e-5 * f64::powf(force, 0.9) / length.powf(0.8) * 1e-3;
            let law = LoadDeflection { stiffness: palmgren_stiffness(length), ..NN3007 };
            assert!((law.healthy(delta) / force - 1.0).abs() < 2e-3);
        }
        assert!((palmgren_stiffness(length) / 8.54e8 - 1.0).abs() < 1e-3);
    }

    #[test]
    fn analytic_deflection_inverts_the_law() {
        for force in [1e-3, 1.0, 1e4] {
            let tangent = NN3007.tangent(NN3007.deflection(force));
            assert!((NN3007.tangent_at(force) / tangent - 1.0).abs() < 1e-6);
            assert!((NN3007.healthy(NN3007.deflection(force)) / force - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn analytic_energy_is_the_integral_of_the_force() {
        let floor = ContactReduction { share: 0.4, depth: 3e-6, damaged_length: 4e-3 };
        let steps = 200_000;
        let top = 1.1e-5;
        let dx = top / f64::from(steps);
        let work: f64 = (0..steps).map(|i| NN3007.damaged((f64::from(i) + 0.5) * dx, &floor) * dx).sum();
        assert!((NN3007.damaged_energy(top, &floor) / work - 1.0).abs() < 1e-9);
    }

    #[test]
    fn analytic_ecl_limits() {
        let length = 6e-3;
        let shallow = 4e-6;
        // Below the floor: K (L_e/L)^(8/9) delta^n, which is Palmgren's law for the length L_e.
        let damaged = 4e-3;
        let floor = ContactReduction { share: remaining_share(length, damaged), depth: 20e-6, damaged_length: damaged };
        let ratio = palmgren_stiffness(1e3 * (length - damaged)) / palmgren_stiffness(1e3 * length);
        assert!((NN3007.damaged(shallow, &floor) / (ratio * NN3007.healthy(shallow)) - 1.0).abs() < 1e-13);
        // Full width: the displacement law.
        let full = ContactReduction { share: remaining_share(length, length), depth: 1e-6, damaged_length: length };
        assert_eq!(NN3007.damaged(shallow, &full), NN3007.healthy(shallow - 1e-6));
        // No width: healthy, bit for bit.
        let none = ContactReduction { share: remaining_share(length, 0.0), depth: 1e-6, damaged_length: 0.0 };
        assert_eq!(NN3007.damaged(shallow, &none).to_bits(), NN3007.healthy(shallow).to_bits());
    }
}
