//! Angles of a roller that decide where it meets damage.

use crate::contact::Side;
use crate::lanes::functions::ROUNDER;
use std::f64::consts::{PI, TAU};

/// An angle mapped to [-pi, pi).
#[inline]
pub fn wrap(angle: f64) -> f64 {
    // Adding it leaves the nearest whole number of turns: `floor` is a function call on processors of old.
    let turns = (angle * (1.0 / TAU) + ROUNDER) - ROUNDER;
    let wrapped = angle - TAU * turns;
    if wrapped >= PI {
        wrapped - TAU
    } else if wrapped < -PI {
        wrapped + TAU
    } else {
        wrapped
    }
}

/// Angles that decide where a roller is over damage, rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Angles {
    /// theta_j.
    pub orbit: f64,
    /// phi_j.
    pub spin: f64,
    /// W_i.
    pub ring: f64,
}

impl Angles {
    /// Where the contact on `side` is on the raceway and on the rolling element, rad: angles fixed to each of them, 0 where a defect with `center_deg = 0` lies.
    #[inline]
    pub fn on_surfaces(&self, side: Side) -> [f64; 2] {
        let (ring, half_turn) = match side {
            Side::Inner => (self.ring, PI),
            Side::Outer => (0.0, 0.0),
        };
        [self.orbit - ring, self.orbit + half_turn - self.spin]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_wrap_maps_to_a_half_open_turn() {
        assert_eq!(wrap(0.5), 0.5);
        assert!((wrap(TAU + 0.5) - 0.5).abs() < 1e-15);
        assert!((wrap(-7.0) - (TAU - 7.0)).abs() < 1e-15);
        assert_eq!(wrap(PI), -PI);
    }
}
