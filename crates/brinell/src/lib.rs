//! Vibration of rolling bearings with real damage, from first principles.
//!
//! [`signal`], [`analysis`], [`random`] and [`many`] are those of the crate `brinell-signal`, which knows nothing of the rest.

#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]

pub mod accuracy;
pub mod bearing;
pub mod cage;
pub mod channel;
pub mod contact;
pub mod defect;
pub mod derived;
pub mod document;
pub mod elementary;
pub mod friction;
pub mod kernel;
pub mod lanes;
pub mod model;
pub mod observe;
pub mod operation;
pub mod plausibility;
pub mod pressure;
pub mod result;
pub mod scenario;
pub mod sensor;
pub mod simulate;
pub mod solver;
pub mod start;
pub mod statics;
pub mod summary;

pub use brinell_signal as signal;
pub use brinell_signal::{analysis, parallel as many, random};

/// Version of this library, as results carry it.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
