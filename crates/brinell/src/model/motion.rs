//! The model as a system that the solver can integrate.

use super::stability::stable_step;
use super::{Model, Power, Workspace};
use crate::solver::System;

/// A model and the workspace of its evaluations.
#[derive(Debug)]
pub struct Motion<'a> {
    /// The bearing.
    pub model: &'a Model,
    /// Forces and flows of the last evaluation.
    pub ws: Workspace,
}

impl<'a> Motion<'a> {
    /// With a fresh workspace.
    pub fn new(model: &'a Model) -> Self {
        Self {
            model,
            ws: Workspace::new(model),
        }
    }

    /// dy/dt, for solvers that know nothing of rates and accelerations.
    pub fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        self.model.derivative(t, y, dy, &mut self.ws);
    }
}

impl System for Motion<'_> {
    type Flow = Power;

    fn size(&self) -> usize {
        2 * self.model.layout.dof()
    }

    #[inline]
    fn accelerations(&mut self, t: f64, y: &[f64], a: &mut [f64]) {
        self.model.accelerations(t, y, a, &mut self.ws);
    }

    fn stable_step(&self) -> f64 {
        stable_step(self.model, self.ws.max_elastic(), self.ws.film_damping())
    }

    fn flow(&self) -> Power {
        self.ws.power
    }
}
