//! The crate's tests in one program, because each program links the library anew.

mod calibrate;
mod campaign;
mod design;
