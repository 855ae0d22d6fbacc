//! A Cartesian plot: margins, axis labels, curves thinned to the pixels there are, and lanes of marks above it.

mod axis;
mod curves;
mod lanes;
mod shades;

use crate::font;
use crate::picture::{Anchor, Paint, Picture, Rect, Shape, Text, coordinate, escape, ink};
pub(crate) use axis::{Domain, Scale, range};
use axis::{axis_label, halves, ticks};
pub(crate) use lanes::{LANE_HEIGHT, Lane, Mark};
pub(crate) use shades::{SCALE_MARGIN, Shades};

/// How large a picture is drawn. The page holds both, and shows the one that fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Size {
    pub(crate) width: f64,
    pub(crate) height: f64,
    pub(crate) font: f64,
}

/// What a plot needs before anything is drawn on it.
#[derive(Clone, Debug)]
pub(crate) struct Spec {
    pub(crate) name: String,
    pub(crate) title: String,
    pub(crate) size: Size,
    pub(crate) x: Domain,
    pub(crate) y: Domain,
    pub(crate) x_label: String,
    pub(crate) x_unit: String,
    pub(crate) y_label: String,
    pub(crate) y_unit: String,
    pub(crate) lanes: Vec<Lane>,
    /// Margins at least, to line plots up.
    pub(crate) left: f64,
    pub(crate) right: f64,
    /// Whether the x axis carries numbers and a label.
    pub(crate) x_axis: bool,
}

impl Spec {
    /// Axes of these parts of quantities, with labels and units; nothing else.
    pub(crate) fn new(
        name: impl Into<String>,
        title: impl Into<String>,
        size: Size,
        (x, x_label, x_unit): (Domain, &str, &str),
        (y, y_label, y_unit): (Domain, &str, &str),
    ) -> Self {
        Self {
            name: name.into(),
            title: title.into(),
            size,
            x,
            y,
            x_label: x_label.into(),
            x_unit: x_unit.into(),
            y_label: y_label.into(),
            y_unit: y_unit.into(),
            lanes: Vec::new(),
            left: 0.0,
            right: 0.0,
            x_axis: true,
        }
    }
}

/// A plot being drawn.
pub(crate) struct Chart {
    pub(crate) picture: Picture,
    pub(crate) frame: Rect,
    pub(crate) x: Scale,
    pub(crate) y: Scale,
    spec: Spec,
    /// Of the curves that are drawn next; may be empty.
    curve: String,
}

/// Margin that the y axis of a plot needs: numbers, label, and the names of its lanes.
pub(crate) fn left_margin(spec: &Spec) -> f64 {
    let font = spec.size.font;
    let (_, labels, _) = ticks(spec.y, y_target(spec));
    let numbers = labels.iter().map(|l| font::width(l, font, false)).fold(font::width("−0.05", font, false), f64::max);
    let lanes = spec.lanes.iter().map(|l| font::width(&l.label, font, true)).fold(0.0, f64::max);
    let lines = if label_is_long(spec) { 2.0 } else { 1.0 };
    (numbers + 10.0 + lines * 1.3 * font + 4.0).max((lanes + 14.0).min(0.3 * spec.size.width))
}

/// Margin that the values of a plot's lanes need.
pub(crate) fn right_margin(spec: &Spec) -> f64 {
    let font = spec.size.font;
    let ends = spec.lanes.iter().map(|l| font::width(&l.value, font, false)).fold(0.0, f64::max);
    if ends > 0.0 { ends + 12.0 } else { 1.2 * font }
}

fn plot_height(spec: &Spec) -> f64 {
    let below = if spec.x_axis { 3.4 * spec.size.font } else { 8.0 };
    (spec.size.height - 8.0 - LANE_HEIGHT * spec.lanes.len() as f64 - below).max(20.0)
}

fn y_target(spec: &Spec) -> usize {
    ((plot_height(spec) / (2.1 * spec.size.font)) as usize).clamp(2, 8)
}

fn label_is_long(spec: &Spec) -> bool {
    let label = axis_label(&spec.y_label, &spec.y_unit, 0);
    font::width(&label, spec.size.font, false) > plot_height(spec) + 4.0
}

impl Chart {
    pub(crate) fn new(spec: Spec) -> Self {
        let Size { width, height, .. } = spec.size;
        let left = left_margin(&spec).max(spec.left);
        let right = right_margin(&spec).max(spec.right);
        let top = 8.0 + LANE_HEIGHT * spec.lanes.len() as f64;
        let frame = Rect { left, top, right: (width - right).max(left + 20.0), bottom: top + plot_height(&spec) };
        let x = Scale { domain: spec.x, from: frame.left, to: frame.right };
        let y = Scale { domain: spec.y, from: frame.bottom, to: frame.top };
        let mut chart = Self {
            picture: Picture::new(&spec.name, &spec.title, width, height),
            frame,
            x,
            y,
            spec,
            curve: String::new(),
        };
        let y_power = chart.ticks_y();
        let x_power = chart.ticks_x();
        chart.axis_labels(x_power, y_power);
        chart
    }

    /// Lines and numbers of the y axis; the power of ten of its numbers.
    fn ticks_y(&mut self) -> i32 {
        let font = self.spec.size.font;
        let (values, labels, y_power) = ticks(self.spec.y, y_target(&self.spec));
        self.picture.shapes.push(Shape::Open("ticks-y"));
        for (value, label) in values.iter().zip(&labels) {
            let at = self.y.at(*value);
            self.picture.path(&[(self.frame.left, at), (self.frame.right, at)], Paint::line(ink::GRID, 1.0));
            self.picture.text(Text::new(self.frame.left - 7.0, at + 0.36 * font, font, Anchor::End, label));
        }
        self.picture.shapes.push(Shape::Close);
        y_power
    }

    /// Lines and numbers of the x axis, as many as have room; the power of ten of its numbers.
    fn ticks_x(&mut self) -> i32 {
        let font = self.spec.size.font;
        let widest = |labels: &[String]| labels.iter().map(|l| font::width(l, font, false)).fold(0.0, f64::max);
        let mut target = ((self.frame.width() / 60.0) as usize).clamp(3, 10);
        while target > 1 {
            let (values, labels, _) = ticks(self.spec.x, target);
            if (widest(&labels) + 14.0) * values.len() as f64 <= self.frame.width() {
                break;
            }
            target -= 1;
        }
        let (values, labels, x_power) = ticks(self.spec.x, target);
        self.picture.shapes.push(Shape::Open("ticks-x"));
        for (value, label) in values.iter().zip(&labels) {
            let at = self.x.at(*value);
            self.picture.path(&[(at, self.frame.top), (at, self.frame.bottom)], Paint::line(ink::GRID, 1.0));
            if self.spec.x_axis {
                self.picture.text(Text::new(at, self.frame.bottom + 1.4 * font, font, Anchor::Middle, label));
            }
        }
        self.picture.shapes.push(Shape::Close);
        x_power
    }

    fn axis_labels(&mut self, x_power: i32, y_power: i32) {
        let (font, frame) = (self.spec.size.font, self.frame);
        if self.spec.x_axis {
            self.label_x(&axis_label(&self.spec.x_label, &self.spec.x_unit, x_power));
        }
        let label = axis_label(&self.spec.y_label, &self.spec.y_unit, y_power);
        let middle = 0.5 * (frame.top + frame.bottom);
        self.picture.shapes.push(Shape::Open("label-y"));
        let mut line = |x: f64, text: &str| {
            self.picture.text(Text::with_unit(x, middle, font, Anchor::Middle, text).upright());
        };
        if label_is_long(&self.spec) {
            let (first, second) = halves(&label);
            line(1.05 * font, &first);
            line(2.3 * font, &second);
        } else {
            line(1.05 * font, &label);
        }
        self.picture.shapes.push(Shape::Close);
    }

    /// Names in place of numbers under the x axis, the first of them at `first`, with so many px between two.
    pub(crate) fn name_x(&mut self, names: &[String], first: f64, gap: f64) {
        let (font, frame) = (self.spec.size.font, self.frame);
        let room = frame.width() / names.len() as f64 - gap;
        for (k, name) in names.iter().enumerate() {
            let name = font::fitted(name, font, false, room);
            let (x, y) = (self.x.at(k as f64 + first), frame.bottom + 1.4 * font);
            self.picture.text(Text::new(x, y, font, Anchor::Middle, &name));
        }
    }

    /// What the names are of.
    pub(crate) fn label_x(&mut self, label: &str) {
        let (font, frame) = (self.spec.size.font, self.frame);
        let middle = 0.5 * (frame.left + frame.right);
        self.picture.text(Text::with_unit(middle, frame.bottom + 3.0 * font, font, Anchor::Middle, label));
    }

    /// Takes the lines and numbers of an axis out: between names there is nothing to divide.
    pub(crate) fn clear(&mut self, ticks: &str) {
        let shapes = &mut self.picture.shapes;
        if let Some(open) = shapes.iter().position(|s| matches!(s, Shape::Open(name) if *name == ticks)) {
            let length = shapes[open..].iter().take_while(|s| !matches!(s, Shape::Close)).count();
            shapes.drain(open + 1..open + length);
        }
    }

    /// Frame and lanes, over the curves.
    pub(crate) fn finish(mut self) -> Picture {
        self.picture.rect(self.frame, Paint::line(ink::FRAME, 1.0));
        for (index, lane) in std::mem::take(&mut self.spec.lanes).iter().enumerate() {
            self.lane(index, lane);
        }
        self.picture
    }

    /// Tells the page's script where the plot is; of an axis in decades, in their exponents.
    pub(crate) fn interactive(&mut self, plot: &str) {
        self.interactive_at(plot, 0.0);
    }

    /// The same where the plot is placed `top` below the picture's upper edge; the picture it is placed in takes its
    /// attributes.
    pub(crate) fn interactive_at(&mut self, plot: &str, top: f64) {
        let Rect { left, top: upper, right, bottom } = self.frame;
        let [l, t, r, b] = [left, upper + top, right, bottom + top].map(coordinate);
        let Domain { lo, hi, log } = self.spec.x;
        let [lo, hi] = [lo, hi].map(|x| if log { x.log10() } else { x });
        self.picture.attributes = format!(
            " data-plot=\"{}\" data-frame=\"{l} {t} {r} {b}\" data-view=\"{} {}\" data-font=\"{}\" data-top=\"{}\"",
            escape(plot),
            lo,
            hi,
            self.spec.size.font,
            coordinate(top)
        );
    }
}
