//! Bearings: the catalogue.

pub mod catalogue;
