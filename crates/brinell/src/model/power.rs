//! Flows of energy.

use std::ops::{AddAssign, Mul};

/// Flows of energy, W; integrated over time, J. Dissipations count positive.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Power {
    /// Work of the load on its ring, and of further forces of the user's own.
    pub load: f64,
    /// Work of the drive that turns the inner ring.
    pub drive: f64,
    /// Work of the guidance film on the bodies: dissipation and, at a turning guide, input.
    pub film: f64,
    /// Work left over by the levers of the centred bearing (section 8).
    pub lever: f64,
    /// Dissipated by contact damping.
    pub contact: f64,
    /// Dissipated by raceway friction.
    pub friction: f64,
    /// Dissipated by rolling resistance.
    pub rolling: f64,
    /// Dissipated by pocket damping.
    pub pocket: f64,
    /// Dissipated by pocket friction.
    pub pocket_friction: f64,
    /// Dissipated by the damping of the cages' lands.
    pub land: f64,
    /// Dissipated by supports.
    pub support: f64,
    /// Dissipated by drag.
    pub drag: f64,
}

impl Power {
    /// Net flow into the mechanical energy, without parametric work.
    pub fn net(&self) -> f64 {
        self.load + self.drive + self.film + self.lever - self.dissipated()
    }

    /// Everything dissipated, the film's share apart.
    pub fn dissipated(&self) -> f64 {
        self.contact
            + self.friction
            + self.rolling
            + self.pocket
            + self.pocket_friction
            + self.land
            + self.support
            + self.drag
    }

    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            load: f(self.load, other.load),
            drive: f(self.drive, other.drive),
            film: f(self.film, other.film),
            lever: f(self.lever, other.lever),
            contact: f(self.contact, other.contact),
            friction: f(self.friction, other.friction),
            rolling: f(self.rolling, other.rolling),
            pocket: f(self.pocket, other.pocket),
            pocket_friction: f(self.pocket_friction, other.pocket_friction),
            land: f(self.land, other.land),
            support: f(self.support, other.support),
            drag: f(self.drag, other.drag),
        }
    }
}

impl AddAssign for Power {
    fn add_assign(&mut self, other: Self) {
        *self = self.zip(other, |a, b| a + b);
    }
}

impl Mul<f64> for Power {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        self.zip(self, |a, _| a * factor)
    }
}
