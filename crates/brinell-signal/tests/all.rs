//! The crate's tests in one program, because each program links the library anew; `signal_allocations.rs` needs a
//! process of its own.

mod analysis;
mod beside;
mod cases;
mod drift;
mod rate;
mod rig;
mod signal_scipy;
mod together;
mod trend;
mod unknown;
mod verdicts;
mod wrong_speed;
