//! What follows from a scenario before anything moves: stiffnesses, time scales, the static load zone. SI.

mod json;
mod machine;

use crate::accuracy::settings;
use crate::bearing::Kinematics;
use crate::defect::{Defect, SIDES, Side};
use crate::model::Model;
use crate::scenario::{Accuracy, Surface};
use crate::statics::{NoBalance, StaticLoadZone, static_load_zone};
pub use json::{frequencies, machine_to_json, to_json};
pub use machine::{DerivedBearing, DerivedMachine};
use std::f64::consts::TAU;

/// Derived quantities, as `brinell check` prints them.
#[derive(Debug, Clone, PartialEq)]
pub struct Derived {
    /// Largest |speed| of the run, rad/s; the frequencies below hold there.
    pub top_speed: f64,
    /// Pure-rolling speeds and defect frequencies at the top speed.
    pub kinematics: Kinematics,
    /// Static load distribution under the full load.
    pub statics: Result<StaticLoadZone, NoBalance>,
    /// Force of the heaviest contact that the linear quantities below are taken at, N.
    pub contact_force: f64,
    /// d Q/d delta of the inner and the outer contact at that force, N/m.
    pub contact_stiffness: [f64; 2],
    /// Natural frequency of a roller between its raceways, Hz.
    pub roller_frequency: f64,
    /// Damping ratio of that motion.
    pub roller_damping_ratio: f64,
    /// Natural frequencies of the rings on their supports alone, inner and outer, Hz.
    pub support_frequencies: [f64; 2],
    /// Centrifugal force of a roller, N.
    pub centrifugal_force: f64,
    /// Time between rollers at a point of the outer raceway, s.
    pub roller_period: f64,
    /// Time that a roller takes over each defect at the top speed, s.
    pub defect_passes: Vec<f64>,
    /// Longest step that the solver may take while the static load's heaviest contacts carry it, s; under an impact it
    /// is shorter.
    pub longest_step: f64,
}

/// Which way rollers pass damage along its own s, or, of damage on a roller, its contacts with the raceways.
///
/// s is counter-clockwise on every surface, seen in that surface's own frame. Where everything rolls, rollers run ahead of
/// the outer ring, the inner ring runs ahead of them, and a roller turns backwards faster than it travels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Passing {
    /// The shaft stands still.
    #[default]
    Never,
    /// From the first s to the last.
    TowardsPlus,
    /// From the last s to the first.
    TowardsMinus,
    /// Towards +s or -s, as the sign of the speed changes. `plus_at_positive`: towards +s at positive speed.
    Both {
        /// Towards +s while the speed is positive.
        plus_at_positive: bool,
    },
}

impl Passing {
    /// Over the whole run.
    pub fn of(model: &Model, surface: Surface) -> Self {
        // The contact's speed along s over the shaft's: orbit less the speed of the surface.
        let shaft = 1.0;
        let orbit = model.rolling_orbit_speed(shaft);
        let along = match surface {
            Surface::OuterRaceway => orbit,
            Surface::InnerRaceway => orbit - shaft,
            Surface::Roller(_) => orbit - model.rolling_spin_speed(shaft),
        };
        let [lowest, highest] = model.rotation.speeds();
        match (lowest < 0.0, highest > 0.0) {
            (false, false) => Self::Never,
            (true, true) => Self::Both { plus_at_positive: along > 0.0 },
            (_, forwards) if forwards == (along > 0.0) => Self::TowardsPlus,
            _ => Self::TowardsMinus,
        }
    }
}

/// Time that a roller takes over each defect at the top speed, s.
#[doc(hidden)]
pub fn defect_passes(model: &Model) -> Vec<f64> {
    let kinematics = model.kinematics(model.rotation.max_speed());
    let pass = |d: &Defect| {
        let (first, last) = d.shape.arc();
        let (_, frequency) = kinematics.defect_frequency(d.surface);
        // One turn of the surface past the contacts takes Z (raceways) or 2 (a roller) impacts.
        let impacts = match d.surface {
            Surface::Roller(_) => 2.0,
            _ => model.layout.rollers_per_row as f64,
        };
        (last - first) / (TAU * d.radius * frequency / impacts)
    };
    model.defects.iter().map(pass).collect()
}

impl Derived {
    /// Of a model.
    pub fn new(model: &Model, accuracy: Accuracy) -> Self {
        let g = &model.geometry;
        let m = &model.inertia;
        let top_speed = model.rotation.max_speed();
        let kinematics = model.kinematics(top_speed);
        let statics = static_load_zone(model);
        let centrifugal_force = m.roller * g.pitch_radius * kinematics.orbit_speed.powi(2);
        let contact_force = statics.as_ref().map_or(0.0, |z| z.largest).max(centrifugal_force);
        let elastic = statics.as_ref().map_or([0.0, centrifugal_force], StaticLoadZone::heaviest);
        let contact_stiffness = SIDES.map(|side| model.stiffness_at(side, contact_force));
        let between = contact_stiffness[0] + contact_stiffness[1];
        let roller_angular = (between / m.roller).sqrt();
        let damper = |(side, k): (&Side, f64)| {
            let law = model.contact(*side);
            law.damping.of(k, law.deflection(contact_force))
        };
        let damping: f64 = SIDES.iter().zip(contact_stiffness).map(damper).sum();
        let natural = |stiffness: f64, mass: f64| (stiffness / mass).sqrt() / TAU;
        Self {
            top_speed,
            kinematics,
            contact_force,
            contact_stiffness,
            roller_frequency: roller_angular / TAU,
            roller_damping_ratio: if roller_angular > 0.0 { damping / (2.0 * m.roller * roller_angular) } else { 0.0 },
            support_frequencies: [
                natural(model.inner_support.stiffness, m.inner_ring),
                natural(model.acting_outer_support().stiffness, m.outer_ring),
            ],
            centrifugal_force,
            roller_period: 1.0 / kinematics.bpfo,
            defect_passes: defect_passes(model),
            longest_step: settings(model, accuracy).max_step.min(model.stable_step_at(elastic)),
            statics,
        }
    }
}
