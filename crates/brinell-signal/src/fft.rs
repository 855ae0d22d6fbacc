//! Plans of Fourier transforms of real signals. Here alone is the planner called for them: each crate that called it
//! would compile all of the transforms' code again, a third of a minute.

use realfft::{RealFftPlanner, RealToComplex};
use std::sync::Arc;

/// The transform of `length` real samples to the positive frequencies.
pub fn forward(length: usize) -> Arc<dyn RealToComplex<f64>> {
    RealFftPlanner::new().plan_fft_forward(length)
}
