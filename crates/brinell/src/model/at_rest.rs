//! One contact at rest without tilt, even or along a profile: for what is said of a model before anything moves.

use super::Model;
use crate::defect::{Defect, Defects, Side, cover_slices, damaged_contact};
use crate::slices::{Approach, Cover, Slices};

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

    /// Elastic force (N) of a contact deformed by `delta` (m) at the roller's middle, at the angle `u` (rad) from the
    /// centre of `defect`, which need not be of this model; `cover` is room for what damage covers of the slices.
    pub fn force_over(&self, defect: &Defect, side: Side, u: f64, delta: f64, cover: &mut Cover) -> f64 {
        let (law, angles) = (self.contact(side), defect.met_at(side, u));
        let one = Defects::one(defect, side);
        match self.profiled() {
            Some(slices) => {
                let met = cover_slices(one, &angles, cover);
                let covered = met.then_some(&*cover);
                slices.carry(law, &Approach::pressed(delta), covered).force
            }
            None => damaged_contact(one, law, &angles, delta).map_or(law.healthy(delta), |a| a.elastic),
        }
    }

    /// Length (m) of the same contact that touches: of a ball the axis of its ellipse across the groove, along a profile
    /// what its drop lets touch, else the roller's length; less what `defect` takes.
    pub fn length_over(&self, defect: &Defect, side: Side, u: f64, delta: f64, cover: &mut Cover) -> f64 {
        let (law, one) = (self.contact(side), Defects::one(defect, side));
        if let Some(strips) = &law.strips {
            let axis = strips.pressed(delta).length([f64::MIN, f64::MAX]);
            let lost = damaged_contact(one, law, &defect.met_at(side, u), delta);
            return axis - lost.map_or(0.0, |d| d.floor.damaged_length);
        }
        match self.profiled() {
            Some(slices) => {
                let met = cover_slices(one, &defect.met_at(side, u), cover);
                defect.roller_length * slices.touching(delta, met.then_some(&*cover))
            }
            None => defect.roller_length - defect.damaged_length(u * defect.radius),
        }
    }

    /// The slices, where a profile keeps some of them back.
    pub fn profiled(&self) -> Option<&Slices> {
        let slices = self.slices.as_ref()?;
        let profiled = slices.drop[..slices.count].iter().any(|p| *p != 0.0);
        profiled.then_some(slices)
    }
}
