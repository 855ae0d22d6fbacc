//! The spectrogram: frequency over time, darker where there is more.

use crate::chart::{Chart, Domain, SCALE_MARGIN, Shades, Spec, range};
use crate::layout::{Layout, time_unit};
use crate::picture::{Anchor, Picture, Text};
use brinell::signal;

/// Power spectral density over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spectrogram {
    /// What it is of: "Outer ring acceleration, x (sensor)".
    pub label: String,
    /// Unit of the density: "(m/s^2)^2/Hz".
    pub unit: String,
    /// What is drawn.
    pub of: signal::Spectrogram,
    /// How it was made; may be empty.
    pub note: String,
}

/// Decibels from the darkest to the lightest shade, at most.
const RANGE_DB: f64 = 60.0;
/// Pixels of the image, at most.
const ROWS: usize = 128;

impl Spectrogram {
    fn frames(&self) -> usize {
        let known = |d: f64| d.is_finite() && d > 0.0;
        let sound = known(self.of.time_step) && known(self.of.frequency_step) && self.of.first_time.is_finite();
        if self.of.bins < 2 || !sound { 0 } else { self.of.frames() }
    }

    /// Levels in dB, columns by rows with the highest frequency on top: means over neighbours.
    fn levels(&self, most: usize) -> (usize, Vec<f64>) {
        let frames = self.frames();
        let (wide, tall) = (frames.div_ceil(most).max(1), self.of.bins.div_ceil(ROWS).max(1));
        let (columns, rows) = (frames.div_ceil(wide), self.of.bins.div_ceil(tall));
        let mut levels = Vec::with_capacity(columns * rows);
        for row in (0..rows).rev() {
            for column in 0..columns {
                let (mut sum, mut count) = (0.0, 0.0);
                for frame in column * wide..((column + 1) * wide).min(frames) {
                    for bin in row * tall..((row + 1) * tall).min(self.of.bins) {
                        sum += self.of.density[frame * self.of.bins + bin];
                        count += 1.0;
                    }
                }
                levels.push(10.0 * (sum / count).log10());
            }
        }
        (columns, levels)
    }
}

/// Frequency over time, with the scale of its shades.
pub fn spectrogram(view: &Spectrogram, layout: Layout) -> Picture {
    let size = layout.size(if layout.roomy() { 330.0 } else { 280.0 });
    let frames = view.frames();
    let (first, last) = if frames > 0 {
        (view.of.first_time - 0.5 * view.of.time_step, view.of.first_time + (frames as f64 - 0.5) * view.of.time_step)
    } else {
        (0.0, 1.0)
    };
    let (unit, scale) = time_unit(last - first);
    // A bin's shade covers half a bin to each side of it.
    let top = if frames > 0 { view.of.frequency_step * (view.of.bins as f64 - 0.5) } else { 1.0 };
    let mut chart = Chart::new(Spec {
        right: SCALE_MARGIN * size.font,
        ..Spec::new(
            "spectrogram",
            format!("Spectrogram: {}", view.label),
            size,
            (Domain::exact(first * scale, last * scale), "Time", unit),
            (Domain::exact(-0.5 * view.of.frequency_step * f64::from(u8::from(frames > 0)), top), "Frequency", "Hz"),
        )
    });
    let (columns, levels) = view.levels(if layout.roomy() { 400 } else { 200 });
    let Some((_, highest)) = range(levels.iter().copied()) else {
        chart.say("No spectrogram");
        return chart.finish();
    };
    // The scale's foot follows the bulk, not the deepest notch.
    let mut sorted: Vec<f64> = levels.iter().copied().filter(|l| l.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let highest = (highest / 5.0).ceil() * 5.0;
    let floor = sorted.get(sorted.len() / 50).copied().unwrap_or(highest);
    let lowest = ((floor / 5.0).floor() * 5.0).clamp(highest - RANGE_DB, highest - 10.0);
    let bar = chart.shades(&Shades { columns, values: &levels, range: (lowest, highest), ticks: 6, head: "dB" });
    if !view.unit.is_empty() {
        let words = format!("re 1 {}", view.unit);
        let middle = 0.5 * (bar.top + bar.bottom);
        let unit = Text::with_unit(size.width - 0.4 * size.font, middle, size.font, Anchor::Middle, &words);
        chart.picture.text(unit.upright());
    }
    chart.finish()
}
