//! The report's pictures, from its data: the signals' own, and the list of all.

mod headline;
mod healthy;
mod markers;
mod pass;
mod spectrum;
mod waveform;

use crate::axial::axial_section;
use crate::damage::{damage_passage, damage_photo, damage_plan, damage_pressure, damage_section};
use crate::data::Report;
use crate::layout::Layout;
use crate::load::load_distribution;
use crate::motion::bearing_motion;
use crate::orbit::cage_orbit;
use crate::picture::Picture;
use crate::sensor::sensor_response;
use crate::slip::{self, slip_over_angle, slip_over_time};
use crate::spectrogram::spectrogram;
pub use headline::headline;
pub(crate) use markers::marker_lanes;
pub(crate) use pass::pass;
pub(crate) use spectrum::{envelope_spectrum, order_spectrum, spectrum, spectrum_spec};
pub(crate) use waveform::waveform;
pub use waveform::{detail_window, overview};

/// Every picture of the report and, last, the one that says most on its own, for saving as files.
pub fn pictures(report: &Report, layout: Layout) -> Vec<Picture> {
    let mut pictures = vec![
        overview(report, layout),
        waveform(report, layout).picture(),
        spectrum(report, layout).picture(),
        envelope_spectrum(report, layout).picture(),
    ];
    if !report.envelope_orders.amplitude.is_empty() {
        pictures.push(order_spectrum(report, layout).picture());
    }
    for (index, view) in report.damage.iter().enumerate() {
        pictures.extend(damage_photo(view, index, layout));
        pictures.push(damage_plan(view, index, layout));
        if !view.passage.panels.is_empty() {
            pictures.push(damage_passage(view, index, layout));
        }
        pictures.extend(view.pressures.iter().map(|of| damage_pressure(view, of, index, layout)));
        if !view.section.panels.is_empty() {
            pictures.push(damage_section(view, index, layout));
        }
    }
    pictures.extend(report.passes.iter().enumerate().map(|(i, p)| pass(p, i, layout)));
    if !report.load_distribution.is_empty() {
        pictures.push(load_distribution(&report.load_distribution, layout));
    }
    if !report.spectrogram.of.density.is_empty() {
        pictures.push(spectrogram(&report.spectrogram, layout));
    }
    if !report.motion.rows.is_empty() {
        pictures.push(bearing_motion(&report.motion, usize::MAX, layout));
        if let Some(section) = &report.motion.section {
            pictures.push(axial_section(section, section.telling_frame(), layout));
        }
    }
    if !report.sensor.gain_db.is_empty() {
        pictures.push(sensor_response(&report.sensor, layout));
    }
    if !report.cage_orbits.rows.is_empty() {
        pictures.push(cage_orbit(&report.cage_orbits, layout));
    }
    if slip::there_is(&report.slip_rows) {
        pictures.push(slip_over_time(&report.slip_rows, layout));
        pictures.push(slip_over_angle(&report.slip_rows, layout));
    }
    pictures.push(headline(report, layout));
    layout.finished(pictures)
}
