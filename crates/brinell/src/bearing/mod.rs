//! Bearings as such: the catalogue of real ones, classes of clearance, and the speeds at which parts turn.

pub mod catalogue;
pub mod clearance;
pub mod kinematics;

pub use kinematics::Kinematics;
