//! The page and its pictures.

mod calibrate;
mod checks;
mod damage;
mod page;
mod pictures;
mod print;
mod sample;
mod sweep;
