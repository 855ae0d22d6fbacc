//! A plot filled with shades of values, and the scale of the shades right of it.

use super::Chart;
use crate::number::{linear_ticks, tick_labels};
use crate::picture::{Anchor, Paint, Rect, Shape, Text, ink};
use crate::raster::{LEVELS, shade};

/// Margin on the right that the scale needs, in widths of the type.
pub(crate) const SCALE_MARGIN: f64 = 6.4;

/// What the shades represent.
pub(crate) struct Shades<'a> {
    /// Cells of a row.
    pub(crate) columns: usize,
    /// Row by row from the top.
    pub(crate) values: &'a [f64],
    /// Values of the lightest and the darkest shade.
    pub(crate) range: (f64, f64),
    /// Numbers on the scale, about.
    pub(crate) ticks: usize,
    /// Over the scale.
    pub(crate) head: &'a str,
}

impl Chart {
    /// Fills the frame with cells, and draws their scale into the right margin, which is [`SCALE_MARGIN`] wide. Gives
    /// the scale's place.
    pub(crate) fn shades(&mut self, shades: &Shades) -> Rect {
        let (low, high) = shades.range;
        let share = |value: f64| (value - low) / (high - low);
        let (frame, font) = (self.frame, self.spec.size.font);
        let cells = shades.values.iter();
        self.picture.shapes.push(Shape::Image {
            place: frame,
            columns: shades.columns,
            pixels: cells.map(|value| shade(share(*value))).collect(),
        });
        let bar = Rect {
            left: frame.right + 0.9 * font,
            right: frame.right + 1.9 * font,
            top: frame.top + 2.0 * font,
            ..frame
        };
        self.picture.shapes.push(Shape::Image {
            place: bar,
            columns: 1,
            pixels: (0..LEVELS).rev().map(|k| shade(k as f64 / (LEVELS - 1) as f64)).collect(),
        });
        self.picture.rect(bar, Paint::line(ink::FRAME, 1.0));
        let mut write = |x: f64, y: f64, words: &str| {
            let text = Text::new(x, y, font, Anchor::Start, words);
            self.picture.text(text);
        };
        let ticks = linear_ticks(low, high, shades.ticks);
        for (value, label) in ticks.iter().zip(tick_labels(&ticks).0) {
            let y = bar.bottom - share(*value) * bar.height() + 0.36 * font;
            write(bar.right + 0.4 * font, y, &label);
        }
        write(bar.left, frame.top + 1.1 * font, shades.head);
        bar
    }
}
