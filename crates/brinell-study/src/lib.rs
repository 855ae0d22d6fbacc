//! Studies of many runs: sweeps and comparisons ([`campaign`]), fits to targets ([`calibrate`]), plans of data
//! sets ([`design`]) and the data sets themselves ([`dataset`]).
//!
//! A [`listener`] is informed of the runs.
//!
//! What one run is, and its numbers, is [`brinell::result`].

#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]

pub mod calibrate;
pub mod campaign;
pub mod dataset;
pub mod design;
pub mod listener;
#[doc(hidden)]
pub mod runner;
