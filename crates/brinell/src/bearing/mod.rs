//! Bearings as such: the catalogue of real ones, classes of clearance, static load ratings, and the speeds at which parts turn.

pub mod catalogue;
pub mod clearance;
pub mod kinematics;
pub mod rating;

pub use kinematics::Kinematics;
