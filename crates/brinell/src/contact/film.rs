//! Oil that a closing gap of roller and raceway squeezes out.
//!
//! Reynolds' equation for a rigid roller on the gap h + x^2/(2 R), long against its width and closing at the rate
//! -dh/dt, is h^3 dp/dx = 12 eta x dh/dt; its pressure -6 eta R (dh/dt)/h(x)^2 carries -3 sqrt(2) pi eta L (R/h)^(3/2)
//! dh/dt over both sides of the roller. While it rolls, the film cavitates where the gap widens, so that half of it
//! pushes (Guembel), S/h^(3/2) with S = (3/sqrt(2)) pi eta L R^(3/2). A gap that opens pulls nothing.
//!
//! Where the surfaces touch the contact's own damper c acts; the two in series, 1/(1/c + h^(3/2)/S), meet there without
//! a step. The film is taken to be full; neither the wedge that rolling drags in nor what pressure does to viscosity
//! and surfaces is in it.

use crate::lanes::Lanes;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// The film of every open gap on one side of the rollers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SqueezeFilm {
    /// S, N s m^(1/2).
    scale: f64,
}

impl SqueezeFilm {
    /// Of the viscosity eta (Pa s), a roller's length L and the relative radius R of roller and raceway (m).
    pub fn new(viscosity: f64, length: f64, radius: f64) -> Self {
        Self { scale: 3.0 * FRAC_1_SQRT_2 * PI * viscosity * length * radius.powf(1.5) }
    }

    /// Force of the film, N, in each lane, on a gap of `gap` (m, from 0) that closes at `closing` (m/s) before a
    /// contact of the `damping` c, N s/m.
    #[inline(always)]
    pub fn force<L: Lanes>(&self, damping: f64, gap: L, closing: L) -> L {
        let (scale, damping) = (L::splat(self.scale), L::splat(damping));
        let of_gap = (gap * gap.sqrt()).times_plus(damping, scale);
        (damping * scale * closing / of_gap).positive_part()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_half_of_reynolds_pressure_over_a_rigid_roller() {
        let (viscosity, length, radius, gap, closing) = (0.02, 9e-3, 3.6e-3, 5e-6, 2e-3);
        // The pressure integrated by the midpoint rule, over the side where the gap narrows.
        let reach = 400.0 * f64::sqrt(2.0 * radius * gap);
        let steps = 4_000_000;
        let dx = reach / f64::from(steps);
        let pressure: f64 = (0..steps)
            .map(|i| {
                let x = (f64::from(i) + 0.5) * dx;
                6.0 * viscosity * radius * closing / (gap + x * x / (2.0 * radius)).powi(2) * dx
            })
            .sum();
        // A damper that is so stiff that the film alone gives way.
        let film = SqueezeFilm::new(viscosity, length, radius);
        let force = film.force(1e12, gap, closing);
        assert!((force / (length * pressure) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn analytic_the_damper_where_surfaces_touch_and_nothing_while_they_part() {
        let film = SqueezeFilm::new(0.01, 9e-3, 3.6e-3);
        assert!((film.force(200.0, 0.0, 1e-3) - 0.2).abs() < 1e-15);
        assert_eq!(film.force(200.0, 1e-6, -1e-3), 0.0);
        assert_eq!(film.force(0.0, 1e-6, 1e-3), 0.0);
        assert_eq!(film.force(200.0, 1e3, 0.0), 0.0);
        assert_eq!(SqueezeFilm::new(0.0, 9e-3, 3.6e-3).force(200.0, 1e-6, 1e-3), 0.0);
    }

    #[test]
    fn analytic_what_the_film_takes_from_a_roller_that_crosses_the_gap() {
        // m dv/dt = -S v/h^(3/2) with dh/dt = -v gives v = v0 - (2 S/m) (h^(-1/2) - h0^(-1/2)).
        let (mass, start, end, speed) = (5e-3, 30e-6, 6e-6, 0.02);
        let film = SqueezeFilm::new(0.01, 9e-3, 3.6e-3);
        let (mut gap, mut now, dt) = (start, speed, 1e-8);
        while gap > end {
            // Halfway, to the second order.
            let half = now - 0.5 * dt * film.force(1e12, gap, now) / mass;
            now -= dt * film.force(1e12, gap - 0.5 * dt * now, half) / mass;
            gap -= dt * half;
        }
        let taken = 2.0 * film.scale / mass * (f64::powf(gap, -0.5) - f64::powf(start, -0.5));
        assert!(taken > 0.3 * speed);
        assert!(((speed - now) / taken - 1.0).abs() < 1e-6, "{now} {taken}");
    }

    #[test]
    fn prop_a_wider_gap_carries_less() {
        let film = SqueezeFilm::new(0.01, 9e-3, 3.6e-3);
        let forces: Vec<f64> = (0..100).map(|k| film.force(200.0, f64::from(k) * 5e-7, 1e-3)).collect();
        assert!(forces.windows(2).all(|pair| pair[1] < pair[0]));
    }
}
