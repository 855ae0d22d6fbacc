//! How tight the solver is held: the tolerance of `standard` and `reference`.

use crate::model::Model;
use crate::scenario::Accuracy;
use crate::solver::Settings;

/// Tolerance of a step's error norm, sqrt(J): a fraction of the square root of the elastic energy that the bearing
/// holds under its load, so that one number serves a bearing of any size.
pub fn tolerance(model: &Model, accuracy: Accuracy) -> f64 {
    tolerance_under(model, accuracy, model.load.size())
}

/// The same of a bearing that carries `load`, N.
fn tolerance_under(model: &Model, accuracy: Accuracy, load: f64) -> f64 {
    let fraction = match accuracy {
        Accuracy::Standard => STANDARD,
        Accuracy::Reference if model.has_smooth_forces() => SMOOTH_REFERENCE,
        Accuracy::Reference => REFERENCE,
    };
    let force = characteristic_force(model, load);
    let deflection = model.series_contact.deflection(heaviest_contact(model, force));
    fraction * (force * deflection).sqrt()
}

/// The largest of load, weight and the rollers' centrifugal force, N.
fn characteristic_force(model: &Model, load: f64) -> f64 {
    let m = &model.inertia;
    let rollers = model.layout.rollers() as f64;
    let weight = model.gravity[0].hypot(model.gravity[1]) * (m.inner_ring + m.outer_ring + rollers * m.roller);
    let orbit = model.rolling_orbit_speed(model.rotation.max_speed());
    let centrifugal = rollers * m.roller * model.geometry.pitch_radius * orbit * orbit;
    load.max(weight).max(centrifugal)
}

/// By Stribeck, without clearance.
fn heaviest_contact(model: &Model, force: f64) -> f64 {
    model.element.stribeck() * force / model.layout.rollers() as f64
}

/// The integrator in words, for whoever reports it.
pub const METHOD: &str = "Runge-Kutta-Nystrom 3(2), adaptive, dense output";

/// `standard`: see [`tolerance`]; measured to stay within 1.5 % of `reference` (tests/accuracy.rs).
const STANDARD: f64 = 2.4e-4;
/// `reference`: where a tighter tolerance no longer brings the two given trajectories closer.
const REFERENCE: f64 = 2e-7;
/// The same where nothing jumps: the given trajectories of the default laws ask for 0.5 % of the force of a roller that now and then
/// touches, and a tighter tolerance comes nearer to them.
const SMOOTH_REFERENCE: f64 = 2e-9;

/// A roller moves at most this share of its pitch in a step, so that no damage is stepped over.
const PITCH_SHARE: f64 = 1.0 / 200.0;
/// Longest step, s, however slow the bearing.
const LONGEST_STEP: f64 = 5e-5;

/// How much more an error of a ring's rate weighs than that of a roller or a cage of the same energy. Accelerations of
/// rings are what is measured; they add up the rollers' forces, whose errors they share. Chosen on the rectangle case
/// and a healthy bearing: at as many right-hand sides outer_ax of the one comes out nearer by half, and no channel of
/// either further off by more than a tenth.
const RING: f64 = 30.0;

/// Settings of the solver for a model.
pub fn settings(model: &Model, accuracy: Accuracy) -> Settings {
    settings_under(model, accuracy, model.load.size())
}

/// Settings of the solver for bearings that carry loads, N, on structures with these coordinates of mass 1, and as many
/// positions in all: errors add up as energies do.
pub(crate) fn settings_together(
    bearings: &[(usize, &Model, f64)],
    structures: std::ops::Range<usize>,
    positions: usize,
    accuracy: Accuracy,
) -> Settings {
    let mut whole = Settings { tolerance: 0.0, mass: vec![0.0; positions], max_step: LONGEST_STEP };
    for &(first, model, load) in bearings {
        let of = settings_under(model, accuracy, load);
        whole.tolerance = whole.tolerance.hypot(of.tolerance);
        whole.max_step = whole.max_step.min(of.max_step);
        whole.mass[first..][..of.mass.len()].copy_from_slice(&of.mass);
    }
    whole.mass[structures].fill(RING);
    whole
}

fn settings_under(model: &Model, accuracy: Accuracy, load: f64) -> Settings {
    let orbit = model.rolling_orbit_speed(model.rotation.max_speed()).abs();
    let pitch = std::f64::consts::TAU / model.layout.rollers_per_row as f64;
    let mut mass = model.mass();
    for weight in &mut mass[model.layout.inner()..] {
        *weight *= RING;
    }
    Settings {
        tolerance: tolerance_under(model, accuracy, load),
        mass,
        max_step: (pitch * PITCH_SHARE / orbit).min(LONGEST_STEP),
    }
}
