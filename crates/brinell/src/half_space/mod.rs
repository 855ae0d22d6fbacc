//! Damaged contacts as elastic half-spaces (section 19): what a healthy contact would have to be pressed to store the
//! energy that the damaged one stores, as a table over deformation and place.

pub mod build;
pub mod damage;
mod exchange;
pub mod field;
pub mod geometry;
mod healthy;
pub mod influence;
mod level;
pub mod raster;
pub mod solver;
mod spline;
pub mod table;

pub use table::{Effective, Table, TableError};

#[cfg(test)]
mod tests;
