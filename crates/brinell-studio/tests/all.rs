//! Every test of the crate in one program.

mod malformed;
mod measured;
mod messages;
mod studio;
