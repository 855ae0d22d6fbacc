//! The bearing as an immutable set of SI parameters, and its equations of motion.
//!
//! Planar; X right, Y up, angles counter-clockwise from +X, origin at the bearing's centre. Rows, rollers and cages
//! count from 0 in code and from 1 in names and scenarios.

mod broad_phase;
mod contact_law;
mod custom;
mod damage_tables;
pub(crate) mod energy;
mod error;
mod from_scenario;
mod full;
mod geometry;
mod layout;
mod leaning;
pub(crate) mod lumped;
mod momentum;
mod motion;
mod parameters;
mod power;
mod stability;
mod stable_steps;
mod tilt;
mod workspace;

pub use crate::kernel::Kernel;
pub use broad_phase::BroadPhase;
pub use contact_law::{Resting, ScenarioLaw};
pub use custom::{Bodies, Body, Custom, External, Force, Forces};
pub use energy::Energy;
pub use error::ModelError;
pub use from_scenario::series_stiffness;
pub use geometry::{Geometry, Inertia, Support};
pub use layout::Layout;
pub use momentum::imbalance;
pub use motion::Motion;
pub use parameters::{Land, Model};
pub use power::Power;
pub use tilt::{Tilt, TiltingRing};
pub use workspace::Workspace;

use crate::scenario::ModelKind;

impl Model {
    /// Second time derivatives `a` of the positions at the state `y` and `t` (section 8, or section 10); forces and
    /// energies stay in `ws`.
    #[inline]
    pub fn accelerations(&self, t: f64, y: &[f64], a: &mut [f64], ws: &mut Workspace) {
        match self.kind {
            ModelKind::Full | ModelKind::Tilting => full::accelerations(self, t, y, a, ws),
            ModelKind::Lumped => lumped::accelerations(self, t, y, a, ws),
        }
    }

    /// Time derivative of the whole state: its rates, and [`Self::accelerations`].
    pub fn derivative(&self, t: f64, y: &[f64], dy: &mut [f64], ws: &mut Workspace) {
        let dof = self.layout.dof();
        dy[..dof].copy_from_slice(&y[dof..]);
        self.accelerations(t, y, &mut dy[dof..], ws);
    }
}
