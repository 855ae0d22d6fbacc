//! The page and its pictures.

mod checks;
mod damage;
mod page;
mod pictures;
mod sample;
mod sweep;
