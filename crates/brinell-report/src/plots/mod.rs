//! The pictures of a run's signals, and of a roller's pass.

mod headline;
mod healthy;
mod markers;
mod pass;
mod spectrum;
mod waveform;

pub use headline::headline;
pub(crate) use markers::marker_lanes;
pub(crate) use pass::pass;
pub(crate) use spectrum::{envelope_spectrum, order_spectrum, spectrum, spectrum_spec};
pub(crate) use waveform::waveform;
pub use waveform::{detail_window, overview};
