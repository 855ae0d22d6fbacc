//! Stability limit of the explicit solver: the longest step in which it damps the fastest motions.

use super::Model;
use crate::defect::{SIDES, Side};
use crate::scenario::ModelKind;
use crate::solver::DAMPED_CONTACT;

impl Model {
    /// Stability limit of the step, s, of a roller whose contacts carry the elastic forces `elastic` (inner and outer,
    /// N), and of the cages without a dynamic film.
    pub(crate) fn stable_step_at(&self, elastic: [f64; 2]) -> f64 {
        stable_step(self, elastic, 0.0)
    }
}

/// Stability limit of the step, s: of a roller whose contacts carry the elastic forces `max_elastic` (inner and outer,
/// N), and of the cages in films that damp them by at most `film_damping`, N s/m.
pub(super) fn stable_step(model: &Model, max_elastic: [f64; 2], film_damping: f64) -> f64 {
    if model.kind == ModelKind::Lumped {
        // The lumped model's rollers have no inertia.
        return f64::INFINITY;
    }
    let [inner, outer] = SIDES.map(|side| spring(model, side, max_elastic[side as usize]));
    let mass = model.inertia.roller;
    // Between the raceways, or on one of them.
    let between = [[inner[0] + outer[0], inner[1] + outer[1]], inner, outer].map(|spring| decaying_step(spring, mass));
    // In rolling: friction's slope at no slip, mu Q / v_s of each contact, on the spin's I_r.
    let slope = model.friction.coefficient / model.friction.slip_velocity;
    let per_inertia = model.element.spin_inertia().recip();
    let rolling = per_inertia * slope * (max_elastic[0] + max_elastic[1]) / mass;
    // All cages against the ring that guides them.
    let ring = match model.land_on() {
        Side::Inner => model.inertia.inner_ring,
        Side::Outer => model.inertia.outer_ring,
    };
    let film = film_damping * (1.0 / model.inertia.cage + model.layout.rows as f64 / ring);
    between.into_iter().fold(DAMPED_CONTACT.stability_limit(rolling.max(film), f64::INFINITY), f64::min)
}

/// Tangent stiffness (N/m) and damping (N s/m) of a contact under the elastic force `force`, N; where it is open, what
/// its film damps at most.
fn spring(model: &Model, side: Side, force: f64) -> [f64; 2] {
    let law = model.contact(side);
    if force > 0.0 {
        let tangent = law.tangent_at(force);
        [tangent, law.damping.at_most(tangent)]
    } else {
        [0.0, model.film.map_or(0.0, |_| law.damping.constant())]
    }
}

/// Longest step in which m x'' + c x' + k x = 0 decays, s.
fn decaying_step([k, c]: [f64; 2], m: f64) -> f64 {
    let under_root = 0.25 * c * c - k * m;
    let rate = if under_root > 0.0 { (0.5 * c + under_root.sqrt()) / m } else { (k / m).sqrt() };
    // k = 0 and c = 0: no motion, and any step.
    DAMPED_CONTACT.stability_limit(rate, 0.5 * c / (k * m).sqrt())
}
