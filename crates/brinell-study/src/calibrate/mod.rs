//! Fitting keys of a scenario to numbers that are known: which values, how sure, and which the data do not determine.
//! Knows no files.
//!
//! [`Key`]s with bounds span the unit cube. [`fit`] asks for batches of points there, gets a run's [`Answer`]s to the
//! [`Target`]s, and searches: a Latin hypercube and a particle swarm over the whole, then Levenberg and Marquardt's
//! method from the best places ([`search`]). Differences around the best point give the Jacobian, from which
//! [`identify`] takes intervals, correlations, and the directions along which nothing changes. [`signature`] boils a
//! signal down to levels that can be compared with another's.

mod error;
mod fit;
pub mod identify;
mod key;
#[doc(hidden)]
pub mod search;
#[doc(hidden)]
pub mod signature;
mod target;

pub use error::CalibrateError;
pub use fit::{Evaluation, Fit, Run, Settings, Stage, Unfit, fit};
#[doc(hidden)]
pub use fit::{least_budget, start_size};
pub use key::Key;
#[doc(hidden)]
pub use key::check as check_keys;
pub use target::{Answer, Target};
#[doc(hidden)]
pub use target::{MISSING, check as check_targets, residuals};
