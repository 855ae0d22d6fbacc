//! Damaged contacts as elastic half-spaces (section 19): the contact problem, and the tables that it makes of defects.

pub mod build;
pub mod damage;
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

pub use shelf::{Shelf, keep_on};
pub use surfaces::{add_tables, healthy_pressure, pressure_over};

#[cfg(test)]
mod tests;
