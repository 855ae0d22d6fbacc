//! Damping of a closed contact: section 2's damper, or the viscoelastic half-space of section 20.

use crate::lanes::Lanes;

/// How a closed contact is damped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Damping {
    /// A damper c, N s/m, from first touch on (the paper).
    Constant(f64),
    /// tau sigma K_t with sigma = x/(x + delta_s): a viscoelastic half-space of one relaxation time (Kuwabara and Kono 1987).
    Time {
        /// tau, s.
        tau: f64,
        /// delta_s, m: the contact's damper rises over it.
        roughness: f64,
    },
}

impl Damping {
    /// c of a damper of its own, N s/m; 0 where damping goes with the stiffness.
    pub fn constant(self) -> f64 {
        match self {
            Self::Constant(c) => c,
            Self::Time { .. } => 0.0,
        }
    }

    /// c, N s/m, of a contact of the tangent stiffness K_t (N/m) that is deformed by x > 0 (m).
    #[inline]
    pub fn of(self, tangent: f64, x: f64) -> f64 {
        match self {
            Self::Constant(c) => c,
            Self::Time { tau, roughness } => tau * tangent.max(0.0) * x / (x + roughness),
        }
    }

    /// The same of both contacts in series.
    pub fn in_series(self) -> Self {
        match self {
            Self::Constant(c) => Self::Constant(0.5 * c),
            time => time,
        }
    }
}

/// `[elastic + c ddelta]_+` where the elastic sum is positive, else 0, in each lane, N: Eqs. (30), (37).
#[inline(always)]
pub fn damped<L: Lanes>(elastic: L, damper: L, ddelta: L) -> L {
    let pressed = ddelta.times_plus(damper, elastic);
    elastic.if_above(L::zero(), pressed.positive_part(), L::zero())
}
