//! The deformation at which a healthy contact would store as much energy as the damaged one stores, as a table over deformation
//! and place (section 19): what the equations of motion look up, and its CSV.

mod bytes;
mod exchange;
pub mod spline;
pub mod table;
mod tilted;

pub use table::{Effective, Table, TableError};
pub use tilted::{Leaning, Tilted};
