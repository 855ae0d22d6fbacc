//! One run from its scenario to its result: [`simulate()`] gives [`RunResult`], which [`quantities()`] boils down to
//! named numbers with intervals, as the list in [`fields`] says. Knows no files.

pub mod fields;
mod healthy;
mod impacts;
mod parts;
mod quantities;
mod run;

#[doc(hidden)]
pub use fields::can_be_negative;
#[doc(hidden)]
pub use healthy::{Stretch, beside_healthy};
#[doc(hidden)]
pub use impacts::{Impacts, impacts};
#[doc(hidden)]
pub use parts::Parts;
pub use quantities::{Quantity, Spread};
#[doc(hidden)]
pub use quantities::{UnknownName, by_name, check_name, listed, named, names, quantities};
pub use run::{RunResult, finish, record, simulate, simulate_custom, simulate_with};
