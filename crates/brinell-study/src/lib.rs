//! Studies of many runs: sweeps and comparisons ([`campaign`]), fits to targets ([`calibrate`]), and plans of data sets ([`design`]).
//!
//! What one run is, and its numbers, is [`brinell::result`].

pub mod calibrate;
pub mod campaign;
pub mod design;
