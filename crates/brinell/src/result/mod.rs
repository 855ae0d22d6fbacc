//! One run from its scenario to its result: [`simulate()`] gives [`RunResult`], which [`quantities()`] boils down to named numbers with
//! intervals. Knows no files.

mod impacts;
mod quantities;
mod run;

pub use impacts::{Impacts, impacts};
pub use quantities::{LEAST_STIFFNESS, Quantity, Spread, indicator_name, names, quantities};
pub use run::{RunResult, finish, record, simulate, simulate_with};
