//! Bearings as such: the catalogue of real ones, classes of clearance, static load ratings, the speeds at which parts
//! turn, and orders of their defect frequencies.

pub mod catalogue;
pub mod clearance;
mod designation;
pub mod kinematics;
pub mod orders;
pub mod rating;

pub use clearance::clearance_of;
pub use kinematics::Kinematics;
pub use orders::{KnownBearing, estimated_elements, frequencies_of, orders_of};

/// Radius of a groove over the ball's diameter, where a scenario gives none.
#[doc(hidden)]
pub const USUAL_CONFORMITY: f64 = 0.52;
