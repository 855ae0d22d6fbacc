//! Static balance: ring offsets under the full load, with every roller in equilibrium between its raceways.
//!
//! The potential energy of contacts, supports and loads is minimised over the ring offsets by a damped Newton method.
//! Centrifugal force and gravity act on the rollers, damage is taken as it lies at the given angles. SI; frame as in
//! [`crate::model`].

mod balance;
mod load_zone;
mod newton;
mod planar;
mod tilting;

use crate::model::Model;
pub use balance::NoBalance;
#[doc(hidden)]
pub use balance::{Balance, Problem, Tilted};
pub(crate) use load_zone::PHASES;
pub use load_zone::{StaticLoadZone, static_load_zone};
pub(crate) use planar::RingAt;

/// Approach to draw contacts at where no static balance gives one, m.
#[doc(hidden)]
pub const FALLBACK_APPROACH: f64 = 10e-6;

/// Solves a static problem.
///
/// # Errors
/// Where the rings are not held against the load.
#[doc(hidden)]
pub fn solve(model: &Model, problem: &Problem) -> Result<Balance, NoBalance> {
    match &model.tilt {
        Some(tilt) => tilting::solve(model, tilt, problem),
        None => planar::solve(model, problem),
    }
}
