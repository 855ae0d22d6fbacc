//! What follows from a machine before anything moves: what each bearing carries, natural frequencies, critical speeds.

use super::Derived;
use crate::machine::{Carried, Coefficients, Equations, Linear, Mode, Whirl};
use crate::model::Model;
use crate::plausibility::carried;
use crate::scenario::{ContactDamping, Scenario};
use crate::simulate::Simulation;
use crate::statics::NoBalance;
use std::f64::consts::TAU;

/// A bearing in the static balance of its machine.
#[derive(Debug)]
pub struct DerivedBearing {
    /// It alone, with the load that it carries on its inner ring.
    pub scenario: Scenario,
    /// Its model.
    pub model: Model,
    /// What follows for it.
    pub derived: Derived,
    /// What it carries.
    pub carried: Carried,
}

/// What follows from a machine.
#[derive(Debug)]
pub struct DerivedMachine {
    /// Its bearings, in the file's order.
    pub bearings: Vec<DerivedBearing>,
    /// Weight of the shaft and of what is on it, N.
    pub weight: f64,
    /// Highest speed, rad/s.
    pub top_speed: f64,
    equations: Equations,
    linear: Vec<Linear>,
}

impl DerivedMachine {
    /// Of a simulation of the scenario.
    ///
    /// # Errors
    /// Where something is not held against the load.
    pub fn new(scenario: &Scenario, simulation: &Simulation) -> Result<Self, NoBalance> {
        let machine = simulation.machine();
        let balance = machine.balance()?;
        let each = carried(scenario, machine, &balance).into_iter().zip(balance.bearings);
        let bearing = |((scenario, model), carried): ((Scenario, Model), Carried)| DerivedBearing {
            derived: Derived::new(&model, scenario.simulation.accuracy),
            scenario,
            model,
            carried,
        };
        let bearings: Vec<DerivedBearing> = each.map(bearing).collect();
        let coefficients: Vec<Coefficients> = bearings.iter().map(DerivedBearing::coefficients).collect();
        let (equations, linear) = machine.linearised(&coefficients);
        Ok(Self {
            weight: machine.shaft_weight(),
            top_speed: simulation.model().rotation.max_speed(),
            bearings,
            equations,
            linear,
        })
    }

    /// Natural motions at a speed, rad/s, by rising frequency: of the shaft on the bearings' stiffness at the load that they carry, of
    /// housings and of rings on supports of their own. The bearings' stiffness is that at rest at every speed.
    pub fn modes(&self, speed: f64) -> Vec<Mode> {
        self.equations.modes(&self.linear, speed)
    }

    /// Speeds, rad/s and rising, that a natural frequency follows, without damping.
    pub fn critical_speeds(&self) -> Vec<(f64, Whirl)> {
        self.equations.critical_speeds(&self.linear)
    }
}

impl DerivedBearing {
    /// Stiffness and damping between its rings at the load that it carries. Contacts that are damped by tau K in series act as tau times the
    /// bearing's stiffness; of constant dampers two in series act at the one end as a half of each.
    pub fn coefficients(&self) -> Coefficients {
        let stiffness = self.derived.statics.as_ref().map_or([[0.0; 2]; 2], |zone| zone.stiffness);
        let time = match self.scenario.contact.damping {
            ContactDamping::Time { us } => 1e-6 * us,
            // A time that does at the heaviest contact what the damper does.
            ContactDamping::Constant { ns_per_m } => {
                let [inner, outer] = self.derived.contact_stiffness;
                2.0 * ns_per_m / (inner + outer).max(f64::MIN_POSITIVE)
            }
        };
        Coefficients { stiffness, damping: stiffness.map(|row| row.map(|k| time * k)) }
    }

    /// Stiffness along the load that it carries, N/m.
    pub fn stiffness_along_load(&self) -> f64 {
        let [x, y] = self.carried.force;
        let size = x.hypot(y).max(f64::MIN_POSITIVE);
        let along = [x / size, y / size];
        let k = self.coefficients().stiffness;
        (0..2).map(|i| (0..2).map(|j| along[i] * k[i][j] * along[j]).sum::<f64>()).sum()
    }
}

/// r/min of rad/s.
pub(super) fn rpm(speed: f64) -> f64 {
    60.0 * speed / TAU
}
