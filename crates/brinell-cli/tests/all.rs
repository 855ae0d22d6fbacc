//! The crate's tests in one program, because each program links the library anew.

mod analyze;
mod analyze_bearings;
mod analyze_several;
mod analyze_units;
mod analyze_warnings;
mod calibrate;
mod check;
mod common;
mod compare;
mod damage_files;
mod dataset;
mod defect;
mod diff;
mod exit_codes;
mod init;
mod inputs;
mod look_up;
mod many;
mod names;
mod outputs;
mod reproduce;
mod rerun;
mod shell;
mod spread;
mod sweep;
mod terminal;
