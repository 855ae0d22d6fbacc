//! One run from its scenario to its result: [`run()`] gives [`Finished`], which [`quantities()`] boils down to named numbers with
//! intervals, as the list in [`fields`] says. Knows no files.

pub mod fields;
mod impacts;
mod quantities;
mod run;

pub use impacts::{Impacts, impacts};
pub use quantities::{
    Quantity, Spread, UnknownName, check_name, indicator_name, names, quantities,
};
pub use run::{Finished, Unfinished, finish, run};
