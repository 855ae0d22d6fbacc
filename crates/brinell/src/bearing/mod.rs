//! Bearings as such: the catalogue of real ones, and the speeds at which their parts turn.

pub mod catalogue;
pub mod kinematics;

pub use kinematics::Kinematics;
