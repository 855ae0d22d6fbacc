//! Many scenarios as one piece of work: which they are, what is kept of each, and running them side by side. Knows no
//! files.
//!
//! A [`Grid`] spans settings; each of its points is a list of overrides for [`brinell::document::read`].
//! [`run_all`] does a list of scenarios over threads. A [`Row`] is the numbers of a finished run ([`brinell::result`])
//! with what they belong to: it goes to JSON and comes back bit for bit, so that a finished point need not be run
//! again. [`fingerprint`] says whether it is the same point. [`compare()`] lays finished runs side by side.

mod axis;
mod beforehand;
mod columns;
mod compare;
mod error;
mod grid;
mod kernel;
mod row;
mod run;
mod sides;
mod spread;

pub use axis::Axis;
#[doc(hidden)]
pub use axis::split;
pub(crate) use axis::{assigned, number, syntax};
pub(crate) use beforehand::of_points;
#[doc(hidden)]
pub use beforehand::{BALANCED, BANDWIDTHS, Beforehand, Known, Misses, bandwidth, count, join, of_results};
pub use columns::{NumberColumn, columns};
pub use compare::{Compared, compare};
pub use error::PlanError;
pub use grid::Grid;
pub(crate) use grid::clash;
#[doc(hidden)]
pub use grid::is_inside;
pub(crate) use kernel::{DIFFER, kernel, other_kernel};
pub use row::{Row, fingerprint};
pub(crate) use row::{in_json, settings_json};
pub use run::run_all;
#[doc(hidden)]
pub use sides::{Differing, Side, SidesError, check_labels, differing, sides_json, sides_scenarios, sides_table};
#[doc(hidden)]
pub use spread::{Assumed, Bar, Ends, Level, SPREAD_MEANING, Spread, assumed, band_of, ratios, run_ends, run_spread};
