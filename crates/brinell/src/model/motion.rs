//! The model as a system that the solver can integrate.

use super::{Model, Power, Workspace};
use crate::solver::System;
use std::borrow::BorrowMut;

/// A model and the workspace of its evaluations, its own or somebody's.
#[derive(Debug)]
pub struct Motion<'a, W = Workspace> {
    /// The bearing.
    pub model: &'a Model,
    /// Forces and flows of the last evaluation.
    pub ws: W,
}

impl<'a> Motion<'a> {
    /// With a fresh workspace.
    pub fn new(model: &'a Model) -> Self {
        Self { model, ws: Workspace::new(model) }
    }

    /// dy/dt, for solvers that know nothing of rates and accelerations.
    pub fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        self.model.derivative(t, y, dy, &mut self.ws);
    }
}

impl<W: BorrowMut<Workspace>> System for Motion<'_, W> {
    type Flow = Power;

    fn size(&self) -> usize {
        2 * self.model.layout.dof()
    }

    #[inline]
    fn accelerations(&mut self, t: f64, y: &[f64], a: &mut [f64]) {
        self.model.accelerations(t, y, a, self.ws.borrow_mut());
    }

    fn stable_step(&self) -> f64 {
        self.model.longest_step(self.ws.borrow())
    }

    fn flow(&self) -> Power {
        self.ws.borrow().power
    }
}
