//! Vibration of rolling bearings with real damage, from first principles.

pub mod cage;
pub mod contact;
pub mod defect;
pub mod friction;
pub mod model;
pub mod operation;
pub mod power;
pub mod scenario;
pub mod solver;
pub mod start;
pub mod statics;
