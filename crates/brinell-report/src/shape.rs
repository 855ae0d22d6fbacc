//! What a picture is made of: colours, lines, circles and words.

use crate::font;
use crate::number::{Height, Run, runs};

/// Colours: Okabe and Ito's set, told apart by the colour-blind, and greys.
pub(crate) mod ink {
    pub(crate) const BLUE: &str = "#0072B2";
    pub(crate) const SKY: &str = "#56B4E9";
    pub(crate) const VERMILLION: &str = "#D55E00";
    pub(crate) const GREEN: &str = "#009E73";
    pub(crate) const ORANGE: &str = "#E69F00";
    pub(crate) const PURPLE: &str = "#CC79A7";
    pub(crate) const BLACK: &str = "#1b1f24";
    pub(crate) const TEXT: &str = "#3a424c";
    pub(crate) const FAINT: &str = "#68727d";
    pub(crate) const GRID: &str = "#e3e7eb";
    pub(crate) const FRAME: &str = "#9aa4ae";
}

/// Of "#rrggbb".
pub(crate) fn rgb(color: &str) -> [u8; 3] {
    let part = |at| u8::from_str_radix(color.get(at..at + 2).unwrap_or("0"), 16).unwrap_or(0);
    [1, 3, 5].map(part)
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rect {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) right: f64,
    pub(crate) bottom: f64,
}

impl Rect {
    pub(crate) fn width(&self) -> f64 {
        self.right - self.left
    }
    pub(crate) fn height(&self) -> f64 {
        self.bottom - self.top
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// How a shape is drawn; a width of 0 means no line, no fill colour no fill.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Paint {
    pub(crate) stroke: &'static str,
    pub(crate) width: f64,
    pub(crate) dash: &'static [f64],
    pub(crate) fill: Option<(&'static str, f64)>,
    pub(crate) opacity: f64,
}

impl Paint {
    pub(crate) const fn line(stroke: &'static str, width: f64) -> Self {
        Self { stroke, width, dash: &[], fill: None, opacity: 1.0 }
    }
    pub(crate) const fn fill(color: &'static str, opacity: f64) -> Self {
        Self { stroke: color, width: 0.0, dash: &[], fill: Some((color, opacity)), opacity: 1.0 }
    }
    pub(crate) fn dashed(self, dash: &'static [f64]) -> Self {
        Self { dash, ..self }
    }
    pub(crate) fn filled(self, color: &'static str, opacity: f64) -> Self {
        Self { fill: Some((color, opacity)), ..self }
    }
    pub(crate) fn faded(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Text {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) size: f64,
    pub(crate) bold: bool,
    pub(crate) anchor: Anchor,
    pub(crate) color: &'static str,
    /// Reads upwards, as a vertical axis' label does.
    pub(crate) upright: bool,
    pub(crate) runs: Vec<Run>,
}

impl Text {
    pub(crate) fn new(x: f64, y: f64, size: f64, anchor: Anchor, text: &str) -> Self {
        let plain = vec![Run { text: text.to_owned(), height: Height::Line }];
        Self { x, y, size, bold: false, anchor, color: ink::TEXT, upright: false, runs: plain }
    }
    /// Text that may hold a unit with an exponent or a symbol with an index.
    pub(crate) fn with_unit(x: f64, y: f64, size: f64, anchor: Anchor, text: &str) -> Self {
        Self { runs: runs(text), ..Self::new(x, y, size, anchor, "") }
    }
    pub(crate) fn bold(self) -> Self {
        Self { bold: true, ..self }
    }
    pub(crate) fn color(self, color: &'static str) -> Self {
        Self { color, ..self }
    }
    pub(crate) fn upright(self) -> Self {
        Self { upright: true, ..self }
    }
    /// From the text's place to where its first letter begins.
    pub(crate) fn start(&self) -> f64 {
        match self.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => -0.5 * self.width(),
            Anchor::End => -self.width(),
        }
    }
    pub(crate) fn width(&self) -> f64 {
        self.runs.iter().map(|run| font::width(&run.text, run_size(self.size, run), self.bold)).sum()
    }
}

pub(crate) fn run_size(size: f64, run: &Run) -> f64 {
    match run.height {
        Height::Line => size,
        Height::Raised | Height::Lowered => size * 0.72,
    }
}

/// How far below the line a run's baseline lies; `size` is that of text on the line.
pub(crate) fn run_drop(size: f64, run: &Run) -> f64 {
    match run.height {
        Height::Line => 0.0,
        Height::Raised => -0.45 * run_size(size, run),
        Height::Lowered => 0.22 * run_size(size, run),
    }
}

#[derive(Clone, Debug)]
pub(crate) enum Shape {
    /// Lines through points; NaN-free. `close` joins the ends.
    Path {
        lines: Vec<Vec<(f64, f64)>>,
        close: bool,
        paint: Paint,
        clip: Option<Rect>,
    },
    Circle {
        x: f64,
        y: f64,
        r: f64,
        paint: Paint,
    },
    Text(Text),
    /// Pixels stretched over a rectangle without smoothing, from the top left on, row after row.
    Image {
        place: Rect,
        columns: usize,
        pixels: Vec<[u8; 3]>,
    },
    /// Start of a named group, which the page's script may redraw.
    Open(&'static str),
    /// Start of a group that is a picture of its own, with what it shows in words.
    Figure(String),
    Close,
}
