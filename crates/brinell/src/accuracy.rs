//! How tight the solver is held: the tolerance of `standard` and `reference`, and the longest step.

use crate::defect::SIDES;
use crate::model::Model;
use crate::scenario::{Accuracy, ModelKind};
use crate::solver::{BOGACKI_SHAMPINE, Settings};

/// Tolerance of a step's error norm, sqrt(J): a fraction of the square root of the elastic energy that the bearing holds under its
/// load, so that one number serves a bearing of any size.
pub fn tolerance(model: &Model, accuracy: Accuracy) -> f64 {
    let fraction = match accuracy {
        Accuracy::Standard => STANDARD,
        Accuracy::Reference => REFERENCE,
    };
    let force = characteristic_force(model);
    let deflection = model
        .series_contact
        .deflection(heaviest_contact(model, force));
    fraction * (force * deflection).sqrt()
}

/// The largest of load, weight and the rollers' centrifugal force, N.
fn characteristic_force(model: &Model) -> f64 {
    let m = &model.inertia;
    let rollers = model.layout.rollers() as f64;
    let load = model.load.full[0].hypot(model.load.full[1]);
    let weight = model.gravity[0].hypot(model.gravity[1])
        * (m.inner_ring + m.outer_ring + rollers * m.roller);
    let orbit = model.rolling_orbit_speed(model.rotation.max_speed());
    let centrifugal = rollers * m.roller * model.geometry.pitch_radius * orbit * orbit;
    load.max(weight).max(centrifugal)
}

/// Stribeck's line contact without clearance: the heaviest roller carries 4.08 F / Z.
fn heaviest_contact(model: &Model, force: f64) -> f64 {
    4.08 * force / model.layout.rollers() as f64
}

/// Fastest rate of a roller whose contacts carry the elastic forces `heaviest` (inner and outer, N), 1/s. Between the raceways: |lambda|
/// of m x'' + c x' + k x = 0 with the damping and the tangents of both closed contacts. In rolling: friction's slope at no slip,
/// mu Q / v_s of each contact, on the spin's I_r = m r^2 / 2.
fn fastest_rate(model: &Model, heaviest: [f64; 2]) -> f64 {
    let m = model.inertia.roller;
    let (mut c, mut k) = (0.0, 0.0);
    for side in SIDES {
        let (law, force) = (model.contact(side), heaviest[side as usize]);
        if force > 0.0 {
            c += law.damping;
            k += law.tangent_at(force);
        }
    }
    let under_root = 0.25 * c * c - k * m;
    let radial = if under_root > 0.0 {
        (0.5 * c + under_root.sqrt()) / m
    } else {
        (k / m).sqrt()
    };
    let slope = model.friction.coefficient / model.friction.slip_velocity;
    radial.max(2.0 * slope * (heaviest[0] + heaviest[1]) / m)
}

/// Longest step in which the fastest motions of a roller still decay, s.
pub fn longest_step(model: &Model, heaviest: [f64; 2]) -> f64 {
    match model.kind {
        ModelKind::Full => DECAY / fastest_rate(model, heaviest),
        // The reference model's rollers have no inertia.
        ModelKind::Reference => f64::INFINITY,
    }
}

/// `standard`: see [`tolerance`]; measured to stay within 1.5 % of `reference` (tests/accuracy.rs).
const STANDARD: f64 = 8e-5;
/// `reference`: where a tighter tolerance no longer brings the two given trajectories closer.
const REFERENCE: f64 = 4e-8;

/// A roller moves at most this share of its pitch in a step, so that no damage is stepped over.
const PITCH_SHARE: f64 = 1.0 / 400.0;
/// Longest step, s, however slow the bearing.
const LONGEST_STEP: f64 = 5e-5;

/// Longest step times the fastest rate, which is found anew after every step. The pair is stable up to about 2.5 and the error estimate
/// alone holds steps there, where the fast motion no longer decays but lingers at the size of the tolerance: that drowned the rings'
/// accelerations under heavy loads (tests/accuracy.rs prints the table). At 2 a step halves it.
const DECAY: f64 = 2.0;

/// Settings of the solver for a model.
pub fn settings(model: &Model, accuracy: Accuracy) -> Settings {
    let orbit = model.rolling_orbit_speed(model.rotation.max_speed()).abs();
    let pitch = std::f64::consts::TAU / model.layout.rollers_per_row as f64;
    Settings {
        tableau: BOGACKI_SHAMPINE,
        tolerance: tolerance(model, accuracy),
        mass: model.mass(),
        max_step: (pitch * PITCH_SHARE / orbit).min(LONGEST_STEP),
    }
}
