//! Damaged contacts as elastic half-spaces (section 19): what a healthy contact would have to be pressed to store the
//! energy that the damaged one stores, as a table over deformation and place.

mod exchange;
mod spline;
pub mod table;

pub use table::{Effective, Table, TableError};
