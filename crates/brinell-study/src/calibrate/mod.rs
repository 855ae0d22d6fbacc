//! Fitting keys of a scenario to numbers that are known: which values, how sure, and which the data do not determine.
//! Knows no files but the journal of its runs.
//!
//! [`Key`]s with bounds span the unit cube. [`fit`] asks for batches of points there, gets a run's [`Answer`]s to the
//! [`Target`]s, and searches: a Latin hypercube and a particle swarm over the whole, then Levenberg and Marquardt's
//! method from the best places ([`search`]). Differences around the best point give the Jacobian, from which
//! [`identify`] takes intervals, correlations, and the directions along which nothing changes. [`signature`] boils a
//! signal down to levels that can be compared with another's.
//!
//! A [`FitPlan`] says what is fitted to what, a [`Pattern`] what a measured signal adds; [`calibrate()`] makes the runs,
//! and its [`Outcome`] is what they say.

mod calibration;
mod error;
mod fit;
pub mod identify;
mod key;
mod outcome;
mod pattern;
mod plan;
mod runs;
#[doc(hidden)]
pub mod search;
#[doc(hidden)]
pub mod signature;
mod spacing;
mod target;

pub use calibration::calibrate;
pub use error::CalibrateError;
#[doc(hidden)]
pub use fit::least_budget;
pub use fit::{Evaluation, Fit, Run, Settings, Stage, Unfit, fit};
pub use key::Key;
#[doc(hidden)]
pub use key::check as check_keys;
#[doc(hidden)]
pub use outcome::{Found, Met, Open, Outcome};
#[doc(hidden)]
pub use pattern::{Measured, Pattern};
#[doc(hidden)]
pub use plan::{FitPlan, bounds, middle};
#[doc(hidden)]
pub use runs::{Load, Points, Unfinished};
pub use target::{Answer, Target};
