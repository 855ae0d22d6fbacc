//! Static balance: ring offsets under the full load, with every roller in equilibrium between its raceways.
//!
//! The potential energy of contacts, supports and loads is minimised over the ring offsets by a damped Newton method.
//! Centrifugal force and gravity act on the rollers, damage is taken as it lies at the given angles. SI; frame as in
//! [`crate::model`].

mod balance;
mod load_zone;
mod newton;
mod planar;
mod pressed;
mod tilting;

use crate::model::Model;
pub use balance::NoBalance;
#[doc(hidden)]
pub use balance::{Balance, Problem, Tilted};
pub(crate) use load_zone::PHASES;
pub use load_zone::{StaticLoadZone, static_load_zone};
pub(crate) use newton::{State, minimise};
pub(crate) use planar::RingAt;
pub(crate) use pressed::Pressed;

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

/// Damping of a bearing whose rings do not tilt, between these, about a balance, N s/m: its elements condensed out.
pub(crate) fn damping(model: &Model, problem: &Problem, balance: &Balance) -> [[f64; 2]; 2] {
    planar::damping(model, problem, balance)
}

/// Springs to the ground and forces of a bearing's ring coordinates: shifts of the inner and the outer ring, m, each followed by its tilts times
/// the pitch radius where it tilts.
pub(crate) fn held_by(model: &Model) -> [Vec<f64>; 2] {
    match &model.tilt {
        Some(tilt) => tilting::held_by(model, tilt).map(|of| of.to_vec()),
        None => planar::held_by(model).map(|of| of.to_vec()),
    }
}

/// Its elements alone between rings at these coordinates, under forces of the size `scale`, N.
///
/// # Panics
/// Where there are not as many coordinates.
pub(crate) fn pressed(model: &Model, problem: &Problem, scale: f64, x: &[f64]) -> Pressed {
    let all = "as many coordinates as its rings have";
    match &model.tilt {
        Some(tilt) => tilting::pressed(model, tilt, problem, scale, x.try_into().expect(all)),
        None => planar::pressed(model, problem, x.try_into().expect(all)),
    }
}
