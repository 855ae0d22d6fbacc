//! Stiffnesses and dampings whose motions no run can follow.

use super::{Checker, short};

/// Fastest motion of a body on one spring or damper, 1/s. The solver's steps stay below some 2 over it, so a simulated
/// second beyond takes about 1e9 steps, hours to days. A roller of 1 g on steel stays below 1e6 1/s; this leaves a
/// factor of a million in stiffness.
const FASTEST: f64 = 1e9;
/// Force on a contact that is pressed by next to nothing, N.
const LEAST_FORCE: f64 = 1.0;

impl Checker<'_> {
    /// What makes the longest step so short that the run would take for ever.
    pub(super) fn rates(&mut self) {
        let s = self.s;
        let (b, contact, cage, support) = (&s.bearing, &s.contact, &s.cage, &s.support);
        let roller = (b.roller_mass_kg, "bearing.roller_mass_kg");
        let lighter = match cage.mass_kg < b.roller_mass_kg {
            true => (cage.mass_kg, "cage.mass_kg"),
            false => roller,
        };
        let inner_ring = (b.inner_ring_mass_kg, "bearing.inner_ring_mass_kg");
        let outer_ring = (b.outer_ring_mass_kg, "bearing.outer_ring_mass_kg");
        // The heaviest roller or ball.
        let load = s.operation.load_n[0].hypot(s.operation.load_n[1]);
        let force = (b.element.stribeck() * load / (b.rows * b.rollers_per_row) as f64).max(LEAST_FORCE);
        let n = contact.exponent;
        // The tangent n Q (K / Q)^(1/n) is at most m w^2.
        for (key, value) in
            [("contact.inner_stiffness", contact.inner_stiffness), ("contact.outer_stiffness", contact.outer_stiffness)]
        {
            let most = force * (roller.0 * FASTEST.powi(2) / (n * force)).powf(n);
            self.at_most(key, value, most, " N/m^n", roller.1);
        }
        // Pockets are met now and then, and their stiffness ends a run at once rather than slowing it down.
        for (key, value, body) in [
            ("support.inner_stiffness_n_per_m", support.inner_stiffness_n_per_m, inner_ring),
            ("support.outer_stiffness_n_per_m", support.outer_stiffness_n_per_m, outer_ring),
        ] {
            self.at_most(key, value, body.0 * FASTEST.powi(2), "", body.1);
        }
        for (key, value, body) in [
            ("contact.damping_ns_per_m", contact.damping.constant_ns_per_m().unwrap_or(0.0), roller),
            ("cage.contact_damping_ns_per_m", cage.contact_damping_ns_per_m, lighter),
            ("support.inner_damping_ns_per_m", support.inner_damping_ns_per_m, inner_ring),
            ("support.outer_damping_ns_per_m", support.outer_damping_ns_per_m, outer_ring),
        ] {
            self.at_most(key, value, body.0 * FASTEST, "", body.1);
        }
        // By default the pockets', of which it was said.
        if cage.land_damping_ns_per_m != cage.contact_damping_ns_per_m {
            let most = cage.mass_kg * FASTEST;
            self.at_most("cage.land_damping_ns_per_m", cage.land_damping_ns_per_m, most, "", "cage.mass_kg");
        }
        // Friction's slope at no slip, mu Q / v_s at both contacts, on the spin's inertia.
        let friction = &s.friction;
        let inertia = b.element.spin_inertia() * roller.0;
        let least = 2.0 * friction.raceway_coefficient * force / (inertia * FASTEST);
        if friction.slip_velocity_m_per_s < least && least.is_finite() {
            self.error(
                "friction.slip_velocity_m_per_s",
                too_fast(roller.1),
                format!(">= {}", short(least)),
                &["friction.raceway_coefficient", roller.1],
            );
        }
    }

    fn at_most(&mut self, key: &str, value: f64, most: f64, unit: &str, mass: &str) {
        if most > 0.0 && value > most {
            self.error(key, too_fast(mass), format!("<= {}{unit}", short(most)), &[mass]);
        }
    }
}

fn too_fast(mass: &str) -> String {
    format!(
        "on this the body of {mass} moves faster than {FASTEST:e} 1/s: a simulated second would take more than about 1e9 steps of the solver"
    )
}
