//! The law of a contact without tilt: what it carries and stores at rest, healthy or on damage, by `half-space` (section 19), by the
//! paper's `ecl` (section 3), or by the user's own ([`Model::at_rest`]).

use super::{Layout, Model};
use crate::contact::{self, ContactLaw, Elastic, Place};
use crate::defect::{Angles, Defect, Defects, Met, Side, ecl};
use crate::scenario::Law;
use crate::slices::{Approach, Healthy, Slices};

/// The law of the contacts on one side that the scenario names.
#[derive(Debug, Clone, Copy)]
pub struct ScenarioLaw<'a> {
    law: Law,
    healthy: Healthy<'a>,
}

/// What a contact carries at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resting {
    /// Q, N.
    pub force: f64,
    /// dQ/d(delta), N/m.
    pub tangent: f64,
    /// P = dE/du, what it pushes along the damaged surfaces, N m; 0 under `ecl`.
    pub push: f64,
    /// What of that a damaged rolling element pushes.
    pub push_element: f64,
}

impl Resting {
    /// On damage by its table: section 19.
    #[inline]
    pub(super) fn on_table(healthy: &Healthy, met: &Met) -> Self {
        let [force, tangent] = healthy.force_and_tangent(met.delta);
        Self {
            force: force * met.by_delta,
            tangent: tangent * met.by_delta * met.by_delta + force * met.by_delta2,
            push: force * (met.by_raceway + met.by_element),
            push_element: force * met.by_element,
        }
    }
}

impl From<Elastic> for Resting {
    fn from(Elastic { force, tangent, by_raceway, by_element, .. }: Elastic) -> Self {
        Self { force, tangent, push: by_raceway + by_element, push_element: by_element }
    }
}

/// A contact by a law of the user's own.
pub(super) fn by_law(
    law: &dyn ContactLaw,
    (slot, side): (usize, Side),
    layout: &Layout,
    angles: &Angles,
    delta: f64,
) -> Elastic {
    let [on_raceway, on_element] = angles.on_surfaces(side);
    law.at(&Place { side, row: layout.row(slot), element: layout.roller(slot), on_raceway, on_element }, delta)
}

impl ScenarioLaw<'_> {
    /// A contact that may be on any of `defects` at a deformation, m.
    #[inline]
    pub fn at(&self, defects: Defects, angles: &Angles, delta: f64) -> Resting {
        let healthy = self.healthy;
        match self.law {
            Law::HalfSpace => match defects.effective(angles, delta, None) {
                None => self.undamaged(delta),
                Some(met) => Resting::on_table(&healthy, &met),
            },
            Law::Ecl => {
                let power = healthy.law.exponent.of(delta);
                match ecl::damaged_contact(defects, healthy.law, angles, (delta, power)) {
                    None => self.undamaged(delta),
                    Some(damaged) => Resting {
                        force: damaged.elastic,
                        tangent: healthy.law.damaged_tangent(delta, &damaged.floor),
                        push: 0.0,
                        push_element: 0.0,
                    },
                }
            }
        }
    }

    fn undamaged(&self, delta: f64) -> Resting {
        let [force, tangent] = self.healthy.force_and_tangent(delta);
        Resting { force, tangent, push: 0.0, push_element: 0.0 }
    }

    /// Its elastic energy, J.
    pub fn energy(&self, defects: Defects, angles: &Angles, delta: f64) -> f64 {
        match self.law {
            Law::HalfSpace => {
                let met = defects.effective(angles, delta, None);
                self.healthy.energy(met.map_or(delta, |met| met.delta))
            }
            Law::Ecl => ecl::energy(defects, self.healthy.law, angles, delta),
        }
    }

    /// Its length that touches, m: of a ball the axis of its ellipse across the groove, along a profile what its drop lets touch, else
    /// the roller's length; less what damage takes.
    pub fn touching(&self, defects: Defects, angles: &Angles, delta: f64) -> f64 {
        let whole = self.healthy.touching(delta);
        match self.law {
            Law::HalfSpace => whole - self.healthy.lost_length(delta, self.at(defects, angles, delta).force).min(whole),
            Law::Ecl => {
                let power = self.healthy.law.exponent.of(delta);
                let damaged = ecl::damaged_contact(defects, self.healthy.law, angles, (delta, power));
                whole - damaged.map_or(0.0, |damaged| damaged.floor.damaged_length)
            }
        }
    }
}

impl Model {
    /// The law of the contacts on `side` that the scenario names.
    #[inline]
    pub fn scenario_law(&self, side: Side) -> ScenarioLaw<'_> {
        ScenarioLaw { law: self.law, healthy: self.healthy(side) }
    }

    /// Whether what changes a contact's energy along the surface pushes along it; damage under `ecl` does not.
    pub fn has_pushing_law(&self) -> bool {
        self.law == Law::HalfSpace || self.custom.contact.is_some()
    }

    /// The contact of a slot at a deformation, m.
    #[inline]
    pub fn at_rest(&self, at: (usize, Side), angles: &Angles, delta: f64) -> Resting {
        match &self.custom.contact {
            Some(law) => by_law(&**law, at, &self.layout, angles, delta).into(),
            None => self.scenario_law(at.1).at(self.defects_of(at.0, at.1), angles, delta),
        }
    }

    /// Its elastic energy, J.
    pub fn energy_at_rest(&self, at: (usize, Side), angles: &Angles, delta: f64) -> f64 {
        match &self.custom.contact {
            Some(law) => by_law(&**law, at, &self.layout, angles, delta).energy,
            None => self.scenario_law(at.1).energy(self.defects_of(at.0, at.1), angles, delta),
        }
    }

    /// The law of the user's own, and the contact on `side` that statics and the longest step are for.
    fn own_law(&self, side: Side) -> Option<(&dyn ContactLaw, &Place)> {
        Some((&**self.custom.contact.as_ref()?, &self.usual.as_ref()?[side as usize]))
    }

    /// Deformation at the roller's middle of a healthy contact under `force` (N), m.
    pub fn deflection(&self, side: Side, force: f64) -> f64 {
        if let Some((law, usual)) = self.own_law(side) {
            return contact::deflection(law, usual, force);
        }
        let even = self.contact(side).deflection(force);
        match self.profiled() {
            Some(slices) => slices.deflection(self.contact(side), force, even),
            None => even,
        }
    }

    /// dQ/d(delta) of a healthy contact under `force` (N), N/m.
    pub fn stiffness_at(&self, side: Side, force: f64) -> f64 {
        let (law, delta) = (self.contact(side), self.deflection(side, force));
        if let Some((own, usual)) = self.own_law(side) {
            return own.at(usual, delta).tangent;
        }
        match self.profiled() {
            Some(slices) => slices.carry(law, &Approach::pressed(delta)).stiffness[0],
            None => law.tangent(delta),
        }
    }

    /// Elastic force (N) of a contact deformed by `delta` (m) at the roller's middle, at the angle `u` (rad) from the
    /// centre of `defect`, which need not be of this model.
    pub fn force_over(&self, defect: &Defect, side: Side, u: f64, delta: f64) -> f64 {
        self.scenario_law(side).at(Defects::one(defect, side), &defect.met_at(side, u), delta).force
    }

    /// Length of the same contact that touches, m.
    pub fn length_over(&self, defect: &Defect, side: Side, u: f64, delta: f64) -> f64 {
        self.scenario_law(side).touching(Defects::one(defect, side), &defect.met_at(side, u), delta)
    }

    /// delta_eff (m) under `half-space` and the elastic force (N) of a contact deformed by `delta` (m), at the angle `u` (rad) from the
    /// centre of `defect`, over all damage of its surface.
    pub fn effective_over(&self, defect: &Defect, side: Side, u: f64, delta: f64) -> [f64; 2] {
        let (surface, angles) = (Defects::beside(&self.defects, defect, side), defect.met_at(side, u));
        let effective = surface.effective(&angles, delta, None).map_or(delta, |met| met.delta);
        [effective, self.scenario_law(side).at(surface, &angles, delta).force]
    }

    /// The slices, where a profile keeps some of them back.
    pub fn profiled(&self) -> Option<&Slices> {
        let slices = self.slices.as_ref()?;
        let profiled = slices.drop[..slices.count].iter().any(|p| *p != 0.0);
        profiled.then_some(slices)
    }
}
