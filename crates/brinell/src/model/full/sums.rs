//! What bodies and rollers hand to one another.

use crate::model::Power;

/// Angle and speed of the inner ring.
#[derive(Clone, Copy)]
pub(super) struct Turn {
    /// w_i, rad/s.
    pub(super) speed: f64,
    /// W_i, rad.
    pub(super) angle: f64,
}

/// What the rollers do to everything else.
pub(super) struct Sums {
    pub(super) on_inner: [f64; 2],
    pub(super) on_outer: [f64; 2],
    /// Moments on the inner and on the outer ring that tilt them, N m.
    pub(super) moments: [[f64; 2]; 2],
    /// Torque of the drive and of the housing that holds the outer ring, N m.
    pub(super) torques: [f64; 2],
    pub(super) power: Power,
}
