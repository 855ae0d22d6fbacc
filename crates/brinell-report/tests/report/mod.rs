//! The page and its pictures.

mod calibrate;
mod checks;
mod damage;
mod page;
mod pictures;
pub(crate) mod print;
mod sample;
mod sweep;
