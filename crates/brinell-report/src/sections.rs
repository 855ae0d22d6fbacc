//! Sections of a run's page that show one picture or table of its data.

use crate::axial::axial_section;
use crate::data::Report;
use crate::frame::{figure, none, unit_html};
use crate::markup::escape;
use crate::motion::{bearing_motion, frames_for_script};
use crate::number::significant;
use crate::orbit::cage_orbit;
use crate::sensor::sensor_response;
use crate::slip::{slip_over_angle, slip_over_time, there_is};
use crate::spectrogram::spectrogram as shades_of;
use crate::tables::fact_table;
use std::fmt::Write as _;

pub(crate) fn motion(page: &mut String, report: &Report) {
    let motion = &report.motion;
    let frames = motion.frames();
    if frames == 0 || motion.rows.is_empty() {
        return none(page, "The motion was not recorded.");
    }
    let end = motion.t0_s + motion.dt_s * (frames - 1) as f64;
    let caption = format!(
        "The end of the run, {} s to {} s, in {frames} frames. Raceways, rollers and cage are to scale, clearances and \
         displacements too small to see. The marks on the inner ring and on the rollers show how they turn. Lines from the contacts: \
         contact forces, as long as the forces are large.",
        significant(motion.t0_s, 5),
        significant(end, 5)
    );
    figure(page, "motion", |layout| bearing_motion(motion, frames - 1, layout), &escape(&caption));
    if let Some(section) = motion.section.as_ref().filter(|s| s.frames() >= frames) {
        figure(page, "tilt", |layout| axial_section(section, frames - 1, layout), &escape(&section.caption()));
    }
    frames_for_script(page, motion, frames);
}

pub(crate) fn orbit(page: &mut String, report: &Report) {
    let orbits = &report.cage_orbits;
    if orbits.rows.is_empty() {
        return none(page, "The motion of the cages was not recorded.");
    }
    figure(page, "orbit", |layout| cage_orbit(orbits, layout), &escape(&orbits.note));
}

pub(crate) fn sensor(page: &mut String, report: &Report) {
    let view = &report.sensor;
    fact_table(page, &view.facts, "");
    if view.gain_db.is_empty() {
        return;
    }
    figure(
        page,
        "sensor-response",
        |layout| sensor_response(view, layout),
        "From the outer ring’s acceleration to the sensor’s, before the anti-alias filter.",
    );
}

pub(crate) fn slip(page: &mut String, report: &Report) {
    fact_table(page, &report.slip, "Slip was not recorded.");
    if !there_is(&report.slip_rows) {
        return;
    }
    figure(
        page,
        "slip-time",
        |layout| slip_over_time(&report.slip_rows, layout),
        "How far speeds stay behind pure rolling, as a share of it: means over short stretches of time, of all rolling elements of a row.",
    );
    figure(
        page,
        "slip-angle",
        |layout| slip_over_angle(&report.slip_rows, layout),
        "The same over the rolling element’s place, counter-clockwise from +X: means after the start-up.",
    );
}

pub(crate) fn spectrogram(page: &mut String, report: &Report) {
    let view = &report.spectrogram;
    if view.of.density.is_empty() {
        return none(page, "No spectrogram was made.");
    }
    let mut caption = escape(&view.note);
    let _ = write!(caption, " Shades: power spectral density in dB re 1 {}.", unit_html(&view.unit));
    figure(page, "spectrogram", |layout| shades_of(view, layout), &caption);
}
