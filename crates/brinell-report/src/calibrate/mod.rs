//! A calibration as its page shows it: what was found, how sure it is, what the data do not determine, and the runs that
//! say so.

mod content;
mod words;

pub use words::{calibration_undetermined, calibration_verdict, interval_text};
