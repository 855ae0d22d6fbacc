//! The crate's tests in one program, because each program links the library anew; `fuzz.rs` needs a process of its own.

mod atomic;
mod bad_files;
mod common;
mod conventions;
mod csv;
mod documented;
mod measured;
mod memory;
mod parquet;
mod records;
mod table;
mod times;
mod written;
