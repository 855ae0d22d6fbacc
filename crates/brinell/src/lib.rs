//! Vibration of rolling bearings with real damage, from first principles.

pub mod scenario;
pub mod signal;
