//! One contact at rest without tilt, even or along a profile: for what is said of a model before anything moves.

use super::Model;
use crate::defect::Side;
use crate::slices::{Approach, Slices};

impl Model {
    /// Deformation at the roller's middle of a healthy contact under `force` (N), m.
    pub fn deflection(&self, side: Side, force: f64) -> f64 {
        let even = self.contact(side).deflection(force);
        match self.profiled() {
            Some(slices) => slices.deflection(self.contact(side), force, even),
            None => even,
        }
    }

    /// dQ/d(delta) of a healthy contact under `force` (N), N/m.
    pub fn stiffness_at(&self, side: Side, force: f64) -> f64 {
        let (law, delta) = (self.contact(side), self.deflection(side, force));
        match self.profiled() {
            Some(slices) => slices.carry(law, &Approach::pressed(delta), None).stiffness[0],
            None => law.tangent(delta, None),
        }
    }

    /// The slices, where a profile keeps some of them back.
    pub fn profiled(&self) -> Option<&Slices> {
        let slices = self.slices.as_ref()?;
        let profiled = slices.drop[..slices.count].iter().any(|p| *p != 0.0);
        profiled.then_some(slices)
    }
}
