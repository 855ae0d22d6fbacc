//! Studies of many runs: sweeps and comparisons ([`campaign`]), fits to targets ([`calibrate`]), plans of data
//! sets ([`design`]) and the data sets themselves ([`dataset`]).
//!
//! [`runner`] makes the runs of a study that can be gone on with; a [`listener`] hears of them.
//!
//! What one run is, and its numbers, is [`brinell::result`].

pub mod calibrate;
pub mod campaign;
pub mod dataset;
pub mod design;
pub mod listener;
pub mod runner;
