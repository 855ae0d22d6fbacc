//! What follows from a machine before anything moves: what each bearing carries, natural frequencies, critical speeds.

use super::Derived;
use crate::coefficients::{Coefficients, coefficients};
use crate::machine::{Carried, Equations, Linear, Mode, Port, Whirl};
use crate::model::Model;
use crate::plausibility::carried;
use crate::scenario::Scenario;
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
    ports: Vec<Port>,
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
        let (equations, ports) = machine.linearised();
        Ok(Self {
            weight: machine.shaft_weight(),
            top_speed: simulation.model().rotation.max_speed(),
            bearings: each.map(bearing).collect(),
            equations,
            ports,
        })
    }

    /// The bearings at a speed, rad/s: stiffness and damping at the load that they carry at rest.
    fn linear(&self, speed: f64) -> Vec<Linear> {
        let one = |(bearing, port): (&DerivedBearing, &Port)| {
            let Coefficients { stiffness, damping, .. } = bearing.coefficients(speed);
            Linear { port: port.clone(), stiffness, damping }
        };
        self.bearings.iter().zip(&self.ports).map(one).collect()
    }

    /// Natural motions at a speed, rad/s, by rising frequency: of the shaft on the bearings' stiffness at the load that they carry, of
    /// housings and of rings on supports of their own.
    pub fn modes(&self, speed: f64) -> Vec<Mode> {
        self.equations.modes(&self.linear(speed), speed)
    }

    /// Speeds, rad/s and rising, that a natural frequency follows, without damping; bearings are as stiff as at the top speed.
    pub fn critical_speeds(&self) -> Vec<(f64, Whirl)> {
        self.equations.critical_speeds(&self.linear(self.top_speed))
    }

    /// The lines of a Campbell diagram at these speeds, rad/s: `count` of them, an entry a speed.
    pub fn campbell(&self, speeds: &[f64], count: usize) -> Vec<Vec<Option<Mode>>> {
        self.equations.campbell(|speed| self.linear(speed), speeds, count)
    }
}

impl DerivedBearing {
    /// Stiffness and damping between its rings at the load that it carries, without damage, at a speed of its inner ring, rad/s.
    pub fn coefficients(&self, speed: f64) -> Coefficients {
        if self.model.tilt.is_none() {
            return coefficients(&self.model, self.carried.force, speed).unwrap_or_default();
        }
        // Where rings tilt, those of the static balance at the top speed.
        let stiffness = self.derived.statics.as_ref().map_or([[0.0; 2]; 2], |zone| zone.stiffness);
        let time = self.scenario.contact.damping.time_us().map_or(0.0, |us| 1e-6 * us);
        Coefficients { stiffness, damping: stiffness.map(|row| row.map(|k| time * k)), ..Coefficients::default() }
    }
}

/// r/min of rad/s.
pub(super) fn rpm(speed: f64) -> f64 {
    60.0 * speed / TAU
}
