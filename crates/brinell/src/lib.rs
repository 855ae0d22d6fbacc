//! Vibration of rolling bearings with real damage, from first principles.

pub mod bearing;
pub mod scenario;
