//! Damaged contacts as elastic half-spaces (section 19): the contact problem, and the tables that it makes of defects.

pub mod build;
pub mod damage;
pub mod error;
pub mod field;
pub mod geometry;
mod healthy;
pub mod influence;
mod level;
mod onset;
pub mod raster;
mod shelf;
pub mod solver;
mod surfaces;

pub use shelf::{Shelf, in_bytes, keep_on, take_in};
pub(crate) use surfaces::add_tables;
pub use surfaces::{healthy_pressure, pressure_over};

#[cfg(test)]
mod tests;
