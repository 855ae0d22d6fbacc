//! Stability limit of the explicit solver: the longest step in which it damps the fastest motions.

use super::{Model, Workspace};
use crate::defect::{SIDES, Side};
use crate::scenario::ModelKind;
use crate::solver::DAMPED_CONTACT;

impl Model {
    /// Stability limit of the step, s, of a roller whose contacts carry the elastic forces `elastic` (inner and outer,
    /// N) at most, and of the cages without a dynamic film.
    pub(crate) fn stable_step_at(&self, elastic: [f64; 2]) -> f64 {
        stable_step(self, elastic, 0.0)
    }

    /// The same at the last evaluation, with the cages' films.
    pub(crate) fn longest_step(&self, ws: &Workspace) -> f64 {
        stable_step(self, ws.max_elastic(), ws.film_damping())
    }
}

/// Stability limit of the step, s: of a roller whose contacts carry the elastic forces `max_elastic` (inner and outer,
/// N) at most, and of the cages in films that damp them by at most `film_damping`, N s/m.
fn stable_step(model: &Model, max_elastic: [f64; 2], film_damping: f64) -> f64 {
    if model.kind == ModelKind::Lumped {
        // The lumped model's rollers have no inertia.
        return f64::INFINITY;
    }
    // In rolling: friction's slope at no slip, mu Q / v_s of each contact, on the spin's I_r.
    let slope = model.friction.coefficient / model.friction.slip_velocity;
    let per_inertia = model.element.spin_inertia().recip();
    let rolling = per_inertia * slope * (max_elastic[0] + max_elastic[1]) / model.inertia.roller;
    // All cages against the ring that guides them.
    let ring = match model.land_on() {
        Side::Inner => model.inertia.inner_ring,
        Side::Outer => model.inertia.outer_ring,
    };
    let film = film_damping * (1.0 / model.inertia.cage + model.layout.rows as f64 / ring);
    // The squeeze film of raceways damps open contacts.
    let open =
        SIDES.map(|side| model.film.map_or(0.0, |_| model.contact(side).damping.constant()) / model.inertia.roller);
    let first_order = open.into_iter().fold(rolling.max(film), f64::max);
    let of_contacts = model.stable_steps.up_to(max_elastic[0].max(max_elastic[1]));
    of_contacts.min(DAMPED_CONTACT.stability_limit(first_order, f64::INFINITY))
}
