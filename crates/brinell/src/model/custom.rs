//! What a user's program adds to the model: a contact law of its own, further forces on the bodies.

use super::{Inertia, Layout};
use crate::contact::{ContactLaw, Side};
use std::sync::Arc;

/// A contact law and further forces of the user's own: [`simulate_custom`](crate::simulate_custom).
#[derive(Debug, Clone, Default)]
pub struct Custom {
    /// In place of the program's normal contact law, damage included.
    pub contact: Option<Arc<dyn ContactLaw>>,
    /// Beside the program's forces.
    pub forces: Vec<Arc<dyn Force>>,
}

impl PartialEq for Custom {
    /// Whether both are the very same objects.
    fn eq(&self, other: &Self) -> bool {
        let law = |custom: &Self| custom.contact.as_ref().map(Arc::as_ptr).map(<*const _>::cast::<()>);
        let forces =
            |custom: &Self| -> Vec<*const ()> { custom.forces.iter().map(|f| Arc::as_ptr(f).cast()).collect() };
        law(self) == law(other) && forces(self) == forces(other)
    }
}

/// A further force on rings, cages and rolling elements, for [`Custom`].
///
/// It acts from t = 0; the balance that a run starts from does not know it. Its work is booked with that of the load, and forces and moments count as external
/// ones in the audit of momentum: what acts between two bodies has to be added to both. It is called at every evaluation and must not allocate. The solver's
/// longest step does not know it: a stiff spring or damper costs steps.
pub trait Force: std::fmt::Debug + Send + Sync {
    /// Adds the forces at time `t` (s).
    fn add(&self, t: f64, bodies: &Bodies<'_>, forces: &mut Forces<'_>);
}

/// A body in the plane of the bearing, SI: x to the right, y up, angles counter-clockwise, from the bearing's centre.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Body {
    /// Of its centre, m.
    pub position: [f64; 2],
    /// Of its centre, m/s.
    pub velocity: [f64; 2],
    /// It has turned by, rad.
    pub angle: f64,
    /// It turns at, rad/s.
    pub speed: f64,
}

/// Where every body is. Rows and rolling elements count from 0.
#[derive(Debug)]
pub struct Bodies<'a> {
    pub(super) layout: &'a Layout,
    pub(super) pitch: f64,
    pub(super) q: &'a [f64],
    pub(super) v: &'a [f64],
    /// sin and cos of the orbit angles.
    pub(super) directions: [&'a [f64]; 2],
    /// Angle and speed of the inner ring.
    pub(super) turn: (f64, f64),
}

impl Bodies<'_> {
    /// Rows of rolling elements, a cage each.
    pub fn rows(&self) -> usize {
        self.layout.rows
    }

    /// Rolling elements of a row.
    pub fn elements(&self) -> usize {
        self.layout.rollers_per_row
    }

    /// A ring.
    pub fn ring(&self, side: Side) -> Body {
        let (at, (angle, speed)) = match side {
            Side::Inner => (self.layout.inner(), self.turn),
            Side::Outer => (self.layout.outer(), (0.0, 0.0)),
        };
        Body { position: [self.q[at], self.q[at + 1]], velocity: [self.v[at], self.v[at + 1]], angle, speed }
    }

    /// The cage of a row.
    pub fn cage(&self, row: usize) -> Body {
        let (x, v) = (&self.q[self.layout.cage(row)..], &self.v[self.layout.cage(row)..]);
        Body { position: [x[0], x[1]], velocity: [v[0], v[1]], angle: x[2], speed: v[2] }
    }

    /// A rolling element of a row.
    pub fn element(&self, row: usize, element: usize) -> Body {
        let (l, slot) = (self.layout, self.layout.slot(row, element));
        let (sin, cos) = self.axes(slot);
        let arm = self.arm(slot);
        let (dr, along) = (self.v[l.r() + slot], arm * self.v[l.theta() + slot]);
        Body {
            position: [arm * cos, arm * sin],
            velocity: [dr * cos - along * sin, dr * sin + along * cos],
            angle: self.q[l.phi() + slot],
            speed: self.v[l.phi() + slot],
        }
    }

    fn arm(&self, slot: usize) -> f64 {
        self.pitch + self.q[self.layout.r() + slot]
    }

    fn axes(&self, slot: usize) -> (f64, f64) {
        (self.directions[0][slot], self.directions[1][slot])
    }
}

/// External forces of one evaluation, for the audit of momentum.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct External {
    /// Their sum, N.
    pub force: [f64; 2],
    /// Their moment about the bearing's centre, N m.
    pub torque: f64,
    /// Sums of Z times the force over the bodies of a row, N m.
    pub moment: [f64; 2],
}

/// Takes up forces. Forces act at a body's centre, at the middle of its row; moments about its axis.
#[derive(Debug)]
pub struct Forces<'a> {
    pub(super) bodies: &'a Bodies<'a>,
    pub(super) inertia: &'a Inertia,
    /// Z of the rows, where rings tilt.
    pub(super) levers: &'a [f64],
    /// Accelerations.
    pub(super) a: &'a mut [f64],
    /// Work on the bodies, W.
    pub(super) power: f64,
    pub(super) external: External,
}

impl Forces<'_> {
    /// A force on a ring, N. What turns the inner ring is the drive's.
    pub fn on_ring(&mut self, side: Side, force: [f64; 2]) {
        let (l, m) = (self.bodies.layout, self.inertia);
        let (at, mass) = match side {
            Side::Inner => (l.inner(), m.inner_ring),
            Side::Outer => (l.outer(), m.outer_ring),
        };
        self.push(at, mass, force);
        self.book(&self.bodies.ring(side), force, 0.0, 0.0);
    }

    /// A force, N, and a moment, N m, on the cage of a row.
    pub fn on_cage(&mut self, row: usize, force: [f64; 2], moment: f64) {
        let (at, m) = (self.bodies.layout.cage(row), self.inertia);
        self.push(at, m.cage, force);
        self.a[at + 2] += moment / m.cage_spin;
        self.book(&self.bodies.cage(row), force, moment, self.lever(row));
    }

    /// A force, N, and a moment, N m, on a rolling element of a row.
    pub fn on_element(&mut self, row: usize, element: usize, force: [f64; 2], moment: f64) {
        let (l, m) = (self.bodies.layout, self.inertia);
        let slot = l.slot(row, element);
        let (sin, cos) = self.bodies.axes(slot);
        self.a[l.r() + slot] += (force[0] * cos + force[1] * sin) / m.roller;
        self.a[l.theta() + slot] += (force[1] * cos - force[0] * sin) / (m.roller * self.bodies.arm(slot));
        self.a[l.phi() + slot] += moment / m.roller_spin;
        self.book(&self.bodies.element(row, element), force, moment, self.lever(row));
    }

    fn push(&mut self, at: usize, mass: f64, force: [f64; 2]) {
        self.a[at] += force[0] / mass;
        self.a[at + 1] += force[1] / mass;
    }

    fn lever(&self, row: usize) -> f64 {
        self.levers.get(row).copied().unwrap_or_default()
    }

    fn book(&mut self, body: &Body, force: [f64; 2], moment: f64, lever: f64) {
        let (x, v, sum) = (body.position, body.velocity, &mut self.external);
        for k in 0..2 {
            sum.force[k] += force[k];
            sum.moment[k] += lever * force[k];
        }
        sum.torque += x[0] * force[1] - x[1] * force[0] + moment;
        self.power += v[0] * force[0] + v[1] * force[1] + body.speed * moment;
    }
}
