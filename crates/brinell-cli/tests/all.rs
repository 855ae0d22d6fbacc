//! The crate's tests in one program, because each program links the library anew.

mod analyze;
mod analyze_bearings;
mod analyze_several;
mod analyze_units;
mod calibrate;
mod check;
mod common;
mod compare;
mod damage_files;
mod dataset;
mod defect;
mod exit_codes;
mod inputs;
mod look_up;
mod many;
mod outputs;
mod reproduce;
mod rerun;
mod sweep;
mod terminal;
