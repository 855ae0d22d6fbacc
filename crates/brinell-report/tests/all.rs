//! The crate's tests in one program, because each program links the library anew.

mod analysis;
mod customer;
mod report;
