//! Signals in and out.
