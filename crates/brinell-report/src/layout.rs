//! What every picture shares: its size on a page or a phone, the unit of time, the legend.

use crate::chart::Size;
use crate::font::fitted;
use crate::picture::{Anchor, Paint, Picture, Shape, Text};

/// What a picture is drawn for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Layout {
    /// A desktop page, a file: 960 pixels across.
    Wide,
    /// A phone: 360 pixels across.
    Narrow,
    /// Print, so many mm wide, 80 to 200: text of 7 to 9 pt at that width.
    Print(f64),
}

/// Pixels of a drawing to a mm of print: type of 11 px is 7.8 pt high there.
pub(crate) const PX_PER_MM: f64 = 4.0;
/// Print at least this wide has room for two circles side by side, mm.
const ROOMY_MM: f64 = 140.0;

impl Layout {
    /// Widths that a picture can be printed at, mm: those of a narrow column and of a page.
    pub const WIDTHS_MM: std::ops::RangeInclusive<f64> = 80.0..=200.0;

    /// Whether pictures may spread out.
    pub(crate) fn roomy(self) -> bool {
        match self {
            Self::Wide => true,
            Self::Narrow => false,
            Self::Print(mm) => mm >= ROOMY_MM,
        }
    }

    /// So many squares, one or two to a line, with the same space between and beside them: their side, `wide` px where
    /// there is room, and of each the left edge, px, and the line, from 0.
    pub(crate) fn grid(self, count: usize, wide: f64) -> (f64, Vec<(f64, f64)>) {
        let (side, per_line) = if self.roomy() { (wide, count.clamp(1, 2)) } else { (350.0, 1) };
        let width = self.size(0.0).width;
        let cell = side.min(width / per_line as f64 - 10.0);
        let gap = (width - cell * per_line as f64) / (per_line as f64 + 1.0);
        let place = |k: usize| (gap + (k % per_line) as f64 * (cell + gap), (k / per_line) as f64);
        (cell, (0..count).map(place).collect())
    }

    /// The pictures as they go to files.
    pub fn finished(self, mut pictures: Vec<Picture>) -> Vec<Picture> {
        if let Self::Print(mm) = self {
            pictures.iter_mut().for_each(|p| p.print_mm = Some(mm));
        }
        pictures
    }

    pub(crate) fn size(self, height: f64) -> Size {
        match self {
            Self::Wide => Size { width: 960.0, height, font: 12.5 },
            Self::Narrow => Size { width: 360.0, height, font: 11.0 },
            Self::Print(mm) => Size { width: PX_PER_MM * mm, height, font: 11.0 },
        }
    }
}

/// Seconds or milliseconds, whichever reads better over `span`.
pub(crate) fn time_unit(span: f64) -> (&'static str, f64) {
    if span.is_finite() && span >= 0.5 { ("s", 1.0) } else { ("ms", 1e3) }
}

pub(super) fn known(spacing: f64) -> bool {
    spacing.is_finite() && spacing > 0.0
}

/// A spacing to lay a plot out with, even where there is none to draw with.
pub(super) fn spacing(d: f64) -> f64 {
    if known(d) { d } else { 1.0 }
}

pub(super) fn start(t0: f64) -> f64 {
    if t0.is_finite() { t0 } else { 0.0 }
}

/// Boxes of line and text, from `left` on, wrapped at `right`; returns the height used.
pub(crate) fn legend(
    picture: &mut Picture,
    entries: &[(&str, Paint)],
    left: f64,
    right: f64,
    top: f64,
    font: f64,
) -> f64 {
    let (mut x, mut y) = (left, top + font);
    for (label, paint) in entries {
        let lines = wrapped(label, font, right - left - 32.0);
        let lines: Vec<Text> = lines.iter().map(|line| Text::with_unit(0.0, 0.0, font, Anchor::Start, line)).collect();
        let width = 26.0 + lines.iter().map(Text::width).fold(0.0, f64::max) + 18.0;
        if x > left && x + width > right + 12.0 {
            x = left;
            y += 1.6 * font;
        }
        let middle = y - 0.36 * font;
        if paint.width > 0.0 || paint.fill.is_none() {
            picture.path(&[(x, middle), (x + 20.0, middle)], Paint { fill: None, ..*paint });
        } else {
            picture.shapes.push(Shape::Circle { x: x + 10.0, y: middle, r: 3.5, paint: *paint });
        }
        for (k, words) in lines.into_iter().enumerate() {
            y += if k > 0 { 1.25 * font } else { 0.0 };
            picture.text(Text { x: x + 26.0, y, ..words });
        }
        x += width;
    }
    y - top + 0.6 * font
}

/// A label on as many lines as it needs; a word that no line has room for is cut.
fn wrapped(label: &str, font: f64, room: f64) -> Vec<String> {
    let fits = |text: &str| Text::with_unit(0.0, 0.0, font, Anchor::Start, text).width() <= room;
    let mut lines: Vec<String> = Vec::new();
    for word in label.split(' ') {
        let longer = lines.last().map(|line| format!("{line} {word}"));
        match (longer.filter(|longer| fits(longer)), lines.last_mut()) {
            (Some(longer), Some(last)) => *last = longer,
            _ => lines.push(fitted(word, font, false, room)),
        }
    }
    lines
}
