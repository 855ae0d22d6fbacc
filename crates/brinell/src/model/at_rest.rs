//! One contact at rest without tilt, even or along a profile: for what is said of a model before anything moves.

use super::Model;
use crate::defect::{Angles, Defect, Defects, Side, cover_slices, damaged_contact};
use crate::scenario::Law;
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

    /// Elastic force (N), tangent stiffness (N/m) and push P = dE/du (N m) of a contact under `half-space` at a deformation, m.
    pub(crate) fn resting(&self, slot: usize, side: Side, angles: &Angles, delta: f64) -> [f64; 3] {
        self.on_table(self.defects_of(slot, side), side, angles, delta)
    }

    fn on_table(&self, defects: Defects, side: Side, angles: &Angles, delta: f64) -> [f64; 3] {
        let healthy = self.healthy(side);
        match defects.effective(angles, delta, None) {
            None => {
                let [force, tangent] = healthy.force_and_tangent(delta);
                [force, tangent, 0.0]
            }
            Some(met) => {
                let [force, tangent] = healthy.force_and_tangent(met.delta);
                let stiffness = tangent * met.by_delta * met.by_delta + force * met.by_delta2;
                [force * met.by_delta, stiffness, force * (met.by_raceway + met.by_element)]
            }
        }
    }

    /// Elastic energy of the same contact, J.
    pub(crate) fn resting_energy(&self, slot: usize, side: Side, angles: &Angles, delta: f64) -> f64 {
        let met = self.defects_of(slot, side).effective(angles, delta, None);
        self.healthy(side).energy(met.map_or(delta, |met| met.delta))
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
        if self.rules.law == Law::HalfSpace {
            return self.on_table(one, side, &angles, delta)[0];
        }
        match self.profiled() {
            Some(slices) => {
                let met = cover_slices(one, &angles, cover);
                let covered = met.then_some(&*cover);
                slices.carry(law, &Approach::pressed(delta), covered).force
            }
            None => damaged_contact(one, law, &angles, delta).map_or(law.healthy(delta), |a| a.elastic),
        }
    }

    /// delta_eff (m) under `half-space` and the elastic force (N) of a contact deformed by `delta` (m), at the angle `u` (rad) from the
    /// centre of `defect`, over all damage of its surface.
    pub fn effective_over(&self, defect: &Defect, side: Side, u: f64, delta: f64) -> [f64; 2] {
        let (surface, angles) = (Defects::beside(&self.defects, defect, side), defect.met_at(side, u));
        let effective = surface.effective(&angles, delta, None).map_or(delta, |met| met.delta);
        [effective, self.on_table(surface, side, &angles, delta)[0]]
    }

    /// Length (m) of the same contact that touches: of a ball the axis of its ellipse across the groove, along a profile
    /// what its drop lets touch, else the roller's length; less what `defect` takes.
    pub fn length_over(&self, defect: &Defect, side: Side, u: f64, delta: f64, cover: &mut Cover) -> f64 {
        let (law, one) = (self.contact(side), Defects::one(defect, side));
        if self.rules.law == Law::HalfSpace {
            let healthy = self.healthy(side);
            let force = self.on_table(one, side, &defect.met_at(side, u), delta)[0];
            let whole = match (&law.strips, self.profiled()) {
                (Some(strips), _) => strips.pressed(delta).length([f64::MIN, f64::MAX]),
                (None, Some(slices)) => defect.roller_length * slices.touching(delta, None),
                (None, None) => defect.roller_length,
            };
            return whole - healthy.lost_length(delta, force).min(whole);
        }
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
