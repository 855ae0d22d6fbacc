//! How tight the solver is held: the tolerance of `standard` and `reference`, and the longest step.

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

/// Fastest rate of a roller between both raceways, 1/s: |lambda| of m x'' + 2 c x' + 2 k x = 0 with k the tangent of the heaviest
/// contact.
fn fastest_rate(model: &Model) -> f64 {
    let law = &model.outer_contact;
    let heaviest = heaviest_contact(model, characteristic_force(model));
    let k = law.tangent(law.deflection(heaviest), None);
    let (m, c) = (model.inertia.roller, law.damping);
    let under_root = c * c - 2.0 * k * m;
    if under_root > 0.0 {
        (c + under_root.sqrt()) / m
    } else {
        (2.0 * k / m).sqrt()
    }
}

/// `standard`: see [`tolerance`]; measured to stay within 1.5 % of `reference` (tests/accuracy.rs).
const STANDARD: f64 = 4e-5;
/// `reference`: where a tighter tolerance no longer brings the two given trajectories closer.
const REFERENCE: f64 = 4e-8;

/// A roller moves at most this share of its pitch in a step, so that no damage is stepped over.
const PITCH_SHARE: f64 = 1.0 / 400.0;
/// Longest step, s, however slow the bearing.
const LONGEST_STEP: f64 = 5e-5;

/// Longest step times the fastest rate. The pair is stable up to about 2.5 and the error estimate alone holds steps there, where the
/// fast motion no longer decays but lingers at the size of the tolerance: above 10 kHz that drowned the rings' accelerations under
/// heavy loads (tests/accuracy.rs prints the table). Well inside, it dies away.
const DECAY: f64 = 1.5;

/// Settings of the solver for a model.
pub fn settings(model: &Model, accuracy: Accuracy) -> Settings {
    let orbit = model.rolling_orbit_speed(model.rotation.max_speed()).abs();
    let pitch = std::f64::consts::TAU / model.layout.rollers_per_row as f64;
    // The reference model's rollers have no inertia.
    let decay = match model.kind {
        ModelKind::Full => DECAY / fastest_rate(model),
        ModelKind::Reference => f64::INFINITY,
    };
    Settings {
        tableau: BOGACKI_SHAMPINE,
        tolerance: tolerance(model, accuracy),
        mass: model.mass(),
        max_step: (pitch * PITCH_SHARE / orbit).min(LONGEST_STEP).min(decay),
    }
}
