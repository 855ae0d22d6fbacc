//! Hertz's contact of a ball and a groove: stiffness and ellipse.
//!
//! SI. x is along the rolling direction, z across the groove from its bottom. The ellipse is in Hamrock's form
//! (Hamrock, Schmid, Jacobson: Fundamentals of Fluid Film Lubrication, chapter 17); ball and rings are of one elastic
//! material.

use crate::scenario::{Bearing, Contact};
use std::f64::consts::{FRAC_PI_2, PI};

/// Relative radii of curvature of two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Curvature {
    /// R_x, along the rolling direction, m.
    pub along: f64,
    /// R_y, across the groove, m.
    pub across: f64,
}

impl Curvature {
    /// Of a ball and a groove (diameters in m): the raceway's at its bottom, negative around the balls, and the
    /// groove's cross-section over the ball's.
    pub fn new(ball: f64, raceway: f64, conformity: f64) -> Self {
        let of_ball = 2.0 / ball;
        Self { along: 1.0 / (of_ball + 2.0 / raceway), across: 1.0 / (of_ball - 1.0 / (conformity * ball)) }
    }

    /// R of 1/R = 1/R_x + 1/R_y, m: Harris's sum of curvatures is 1/R.
    pub fn radius(&self) -> f64 {
        1.0 / (1.0 / self.along + 1.0 / self.across)
    }

    /// Gamma, Harris's F(rho).
    pub fn difference(&self) -> f64 {
        self.radius() * (1.0 / self.along - 1.0 / self.across)
    }
}

/// The healthy contact of a ball and one groove.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ellipse {
    /// K of Q = K delta^(3/2), N/m^1.5.
    pub stiffness: f64,
    /// Axis across the groove over the one along it.
    pub kappa: f64,
    /// R_w, m: the half-axis across is sqrt(2 R_w delta) at every load.
    pub across: f64,
}

impl Ellipse {
    /// Of bodies of the modulus E' = E/(1 - nu^2), Pa. `None` where they do not touch in an ellipse.
    pub fn new(of: Curvature, modulus: f64) -> Option<Self> {
        let (radius, gamma) = (of.radius(), of.difference());
        if !(of.along > 0.0 && of.across > 0.0 && modulus > 0.0 && gamma.abs() < 1.0) {
            return None;
        }
        let kappa = axis_ratio(gamma);
        let [first, second] = elliptic_integrals(kappa);
        let stiffness = PI * kappa * modulus * (2.0 * second * radius / (9.0 * first.powi(3))).sqrt();
        Some(Self { stiffness, kappa, across: kappa * kappa * radius * second / first })
    }

    /// Half-axes along the rolling direction and across the groove under the force Q, m.
    pub fn half_axes(&self, force: f64) -> [f64; 2] {
        let delta = (force.max(0.0) / self.stiffness).powf(2.0 / 3.0);
        let across = (2.0 * self.across * delta).sqrt();
        [across / self.kappa, across]
    }

    /// Largest pressure under the force Q, Pa: 3 Q / (2 pi a_x a_z).
    pub fn pressure(&self, force: f64) -> f64 {
        let [along, across] = self.half_axes(force);
        if across > 0.0 { 1.5 * force / (PI * along * across) } else { 0.0 }
    }
}

/// kappa of kappa^2 = (2 F - E (1 + Gamma)) / (E (1 - Gamma)), other than its root 1 that every Gamma has, by
/// bisection.
fn axis_ratio(gamma: f64) -> f64 {
    // Below 0 between the roots and above beyond.
    let excess = |log: f64| {
        let kappa = log.exp();
        let [first, second] = elliptic_integrals(kappa);
        kappa * kappa * (1.0 - gamma) + (1.0 + gamma) - 2.0 * first / second
    };
    // kappa > 1 where Gamma > 0. Nearer to a circle than 1e-6 nothing tells the roots apart.
    let sign = gamma.signum();
    let [mut near, mut far] = [1e-6, 40.0];
    if excess(sign * near) >= 0.0 {
        return 1.0;
    }
    loop {
        let middle = 0.5 * (near + far);
        if middle <= near || middle >= far {
            return (sign * middle).exp();
        }
        if excess(sign * middle) < 0.0 {
            near = middle;
        } else {
            far = middle;
        }
    }
}

/// Complete elliptic integrals of the first and second kind of the parameter m = 1 - 1/kappa^2 by the
/// arithmetic-geometric mean (Abramowitz and Stegun 17.6).
fn elliptic_integrals(kappa: f64) -> [f64; 2] {
    let (mut a, mut b) = (1.0, 1.0 / kappa);
    let mut squares = 0.5 * (1.0 - b * b);
    let mut power = 0.5;
    while f64::abs(a - b) > 4.0 * f64::EPSILON * a {
        let c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        power *= 2.0;
        squares += power * c * c;
    }
    let first = FRAC_PI_2 / a;
    [first, first * (1.0 - squares)]
}

/// The ellipses at the inner and the outer groove; `None` for rollers, or where radii make no ellipse.
pub fn ellipses(bearing: &Bearing, contact: &Contact) -> Option<[Ellipse; 2]> {
    let [inner, outer] = [bearing.inner_groove_conformity?, bearing.outer_groove_conformity?];
    let modulus = contact.modulus()?;
    let of = |raceway_mm: f64, conformity: f64| {
        let of = Curvature::new(1e-3 * bearing.roller_diameter_mm, 1e-3 * raceway_mm, conformity);
        Ellipse::new(of, modulus)
    };
    Some([of(bearing.inner_raceway_diameter_mm, inner)?, of(-bearing.outer_raceway_diameter_mm, outer)?])
}

#[cfg(test)]
mod tests;
