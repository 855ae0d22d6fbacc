//! Many scenarios as one piece of work: which they are, what is kept of each, and running them side by side. Knows no files.
//!
//! A [`Plan`] spans a grid of settings; each of its points is a list of overrides for [`crate::document::read`]. [`run()`] is one scenario
//! from start to [`Finished`]; [`run_all`] does a list of them over threads. [`quantities()`] boils a finished run down to named numbers with
//! intervals, and a [`Row`] is those with what they belong to: it goes to JSON and comes back bit for bit, so that a finished point
//! need not be run again. [`fingerprint`] says whether it is the same point. [`compare()`] lays finished runs side by side.

mod axis;
mod columns;
mod compare;
mod impacts;
mod plan;
mod quantities;
mod row;
mod run;

pub use axis::{Axis, split};
pub use columns::{NumberColumn, columns};
pub use compare::{Compared, compare};
pub use impacts::{Impacts, impacts};
pub use plan::{MOST_POINTS, Plan, PlanError};
pub use quantities::{Quantity, Spread, indicator_name, names, quantities};
pub use row::{Row, digest, fingerprint};
pub use run::{Finished, Unfinished, finish, run, run_all};
