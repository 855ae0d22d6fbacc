//! How tight the solver is held: the tolerance of `standard` and `reference`, and the longest step.

use crate::defect::{SIDES, Side};
use crate::model::Model;
use crate::scenario::{Accuracy, ModelKind};
use crate::solver::{DAMPED_CONTACT, Settings, Tableau};

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

/// Longest step in which the fastest motions still decay, s: of a roller whose contacts carry the elastic forces `heaviest` (inner and outer,
/// N), and of the cages in films that damp them by at most `film_damping`, N s/m.
pub fn longest_step(model: &Model, heaviest: [f64; 2], film_damping: f64) -> f64 {
    if model.kind == ModelKind::Lumped {
        // The lumped model's rollers have no inertia.
        return f64::INFINITY;
    }
    let [inner, outer] = SIDES.map(|side| spring(model, side, heaviest[side as usize]));
    let mass = model.inertia.roller;
    // Between the raceways, or on one of them.
    let between = [[inner[0] + outer[0], inner[1] + outer[1]], inner, outer]
        .map(|spring| decaying_step(spring, mass));
    // In rolling: friction's slope at no slip, mu Q / v_s of each contact, on the spin's I_r = m r^2 / 2.
    let slope = model.friction.coefficient / model.friction.slip_velocity;
    let rolling = 2.0 * slope * (heaviest[0] + heaviest[1]) / mass;
    // All cages against the ring that guides them.
    let ring = match model.land_on() {
        Side::Inner => model.inertia.inner_ring,
        Side::Outer => model.inertia.outer_ring,
    };
    let film = film_damping * (1.0 / model.inertia.cage + model.layout.rows as f64 / ring);
    between.into_iter().fold(
        PAIR.longest_step(rolling.max(film), f64::INFINITY),
        f64::min,
    )
}

/// Tangent stiffness (N/m) and damping (N s/m) of a contact under the elastic force `force`, N; none where it is open.
fn spring(model: &Model, side: Side, force: f64) -> [f64; 2] {
    let law = model.contact(side);
    if force > 0.0 {
        [law.tangent_at(force), law.damping]
    } else {
        [0.0; 2]
    }
}

/// Longest step in which m x'' + c x' + k x = 0 decays, s.
fn decaying_step([k, c]: [f64; 2], m: f64) -> f64 {
    let under_root = 0.25 * c * c - k * m;
    let rate = if under_root > 0.0 {
        (0.5 * c + under_root.sqrt()) / m
    } else {
        (k / m).sqrt()
    };
    // k = 0 and c = 0: no motion, and any step.
    PAIR.longest_step(rate, 0.5 * c / (k * m).sqrt())
}

/// The pair that integrates.
const PAIR: Tableau = DAMPED_CONTACT;

/// The integrator in words, for whoever reports it.
pub const METHOD: &str = "Runge-Kutta-Nystrom 3(2), adaptive, dense output";

/// `standard`: see [`tolerance`]; measured to stay within 1.5 % of `reference` (tests/accuracy.rs).
const STANDARD: f64 = 2.4e-4;
/// `reference`: where a tighter tolerance no longer brings the two given trajectories closer.
const REFERENCE: f64 = 2e-7;

/// A roller moves at most this share of its pitch in a step, so that no damage is stepped over.
const PITCH_SHARE: f64 = 1.0 / 200.0;
/// Longest step, s, however slow the bearing.
const LONGEST_STEP: f64 = 5e-5;

/// How much more an error of a ring's rate weighs than that of a roller or a cage of the same energy. Accelerations of rings are what is
/// measured; they add up the rollers' forces, whose errors they share. Chosen on the rectangle case and a healthy bearing: at as many
/// right-hand sides outer_ax of the one comes out nearer by half, and no channel of either further off by more than a tenth.
const RING: f64 = 30.0;

/// Settings of the solver for a model.
pub fn settings(model: &Model, accuracy: Accuracy) -> Settings {
    let orbit = model.rolling_orbit_speed(model.rotation.max_speed()).abs();
    let pitch = std::f64::consts::TAU / model.layout.rollers_per_row as f64;
    let mut mass = model.mass();
    for weight in &mut mass[model.layout.inner()..] {
        *weight *= RING;
    }
    Settings {
        tableau: PAIR,
        tolerance: tolerance(model, accuracy),
        mass,
        max_step: (pitch * PITCH_SHARE / orbit).min(LONGEST_STEP),
    }
}
