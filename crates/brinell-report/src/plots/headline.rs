//! The run in one picture.

use super::spectrum::{draw_envelope, envelope_spec};
use super::waveform::{draw_waveform, waveform_spec};
use crate::chart::{Size, left_margin, right_margin};
use crate::data::Report;
use crate::font;
use crate::picture::{Anchor, Error, Picture, Text, ink};

/// Waveform over envelope spectrum under the report's title: the run in one picture.
pub fn headline(report: &Report) -> Picture {
    const WIDTH: f64 = 1400.0 / HEADLINE_SCALE;
    const HEIGHT: f64 = 700.0 / HEADLINE_SCALE;
    let mut picture = Picture::new("headline", &report.title, WIDTH, HEIGHT);
    let size = |height| Size {
        width: WIDTH - 12.0,
        height,
        font: 12.5,
    };
    let height = 0.5 * (HEIGHT - 34.0);
    let mut upper = waveform_spec(report, size(height));
    let mut lower = envelope_spec(report, size(height));
    if lower.lanes.iter().any(|lane| lane.through) {
        lower.lanes.retain(|lane| lane.through);
    }
    let left = left_margin(&upper).max(left_margin(&lower));
    let right = right_margin(&upper).max(right_margin(&lower));
    for spec in [&mut upper, &mut lower] {
        (spec.left, spec.right) = (left, right);
    }
    let title = font::fitted(&report.title, 16.0, true, 0.45 * WIDTH);
    let used = font::width(&title, 16.0, true);
    let subtitle = font::fitted(&report.subtitle, 13.0, false, WIDTH - used - left - 40.0);
    picture.text(
        Text::new(left, 24.0, 16.0, Anchor::Start, &title)
            .bold()
            .color(ink::BLACK),
    );
    picture.text(Text::new(
        left + used + 14.0,
        24.0,
        13.0,
        Anchor::Start,
        &subtitle,
    ));
    picture.place(draw_waveform(report, upper), 0.0, 32.0);
    picture.place(draw_envelope(report, lower), 0.0, 32.0 + height);
    picture
}

const HEADLINE_SCALE: f64 = 1.5;

/// [`headline`] as a PNG of 1400 x 700 pixels.
pub fn headline_png(report: &Report) -> Result<Vec<u8>, Error> {
    headline(report).png(HEADLINE_SCALE)
}
