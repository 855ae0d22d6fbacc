//! A Cartesian plot: margins, axis labels, curves thinned to the pixels there are, and lanes of marks above it.

mod axis;
mod curves;
mod lanes;
mod shades;

use crate::font;
use crate::markup::{coordinate, escape};
use crate::picture::{Anchor, Paint, Picture, Rect, Shape, Text, ink};
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
    /// Words between lanes and curves; may be empty.
    pub(crate) remark: String,
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
            remark: String::new(),
        }
    }
}

/// Plots one above another, `height` each, on one x axis, below the last of them, and with one left edge; an x axis and
/// the y axes are given as to [`Spec::new`].
pub(crate) fn panels(
    size: Size,
    height: f64,
    x: (Domain, &str, &str),
    ys: impl ExactSizeIterator<Item = (Domain, String, String)>,
) -> Vec<Spec> {
    let last = ys.len().saturating_sub(1);
    let mut specs: Vec<Spec> = ys
        .enumerate()
        .map(|(k, (y, label, unit))| {
            let x_axis = k == last;
            let height = height + if x_axis { 3.4 * size.font } else { 0.0 };
            Spec { x_axis, ..Spec::new("", "", Size { height, ..size }, x, (y, &label, &unit)) }
        })
        .collect();
    let left = specs.iter().map(left_margin).fold(0.0, f64::max);
    specs.iter_mut().for_each(|spec| spec.left = left);
    specs
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
    if ends > 0.0 {
        return ends + 12.0;
    }
    // A number at the very end reaches half beyond it.
    let (_, numbers, _) = ticks(spec.x, 10);
    numbers.last().map_or(0.0, |last| 0.5 * font::width(last, font, false) + 2.0).max(1.2 * font)
}

/// From the picture's upper edge to the frame's: lanes, and the lines of a remark.
fn above(spec: &Spec) -> f64 {
    8.0 + LANE_HEIGHT * spec.lanes.len() as f64 + 1.3 * remark_font(spec) * remark(spec).len() as f64
}

fn remark_font(spec: &Spec) -> f64 {
    spec.size.font - 1.0
}

/// The remark in lines that fit.
fn remark(spec: &Spec) -> Vec<String> {
    if spec.remark.is_empty() {
        return Vec::new();
    }
    let font = remark_font(spec);
    if Text::with_unit(0.0, 0.0, font, Anchor::Start, &spec.remark).width() <= 0.8 * spec.size.width {
        return vec![spec.remark.clone()];
    }
    let (first, second) = halves(&spec.remark);
    vec![first, second]
}

fn plot_height(spec: &Spec) -> f64 {
    let below = if spec.x_axis { 3.4 * spec.size.font } else { 8.0 };
    (spec.size.height - above(spec) - below).max(20.0)
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
        let top = above(&spec);
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
        let font = remark_font(&chart.spec);
        for (line, words) in remark(&chart.spec).iter().rev().enumerate() {
            let y = top - (0.4 + 1.3 * line as f64) * font;
            chart.picture.text(Text::with_unit(frame.left, y, font, Anchor::Start, words));
        }
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
        for (k, name) in shown(names, |name| font::fitted(name, font, false, room)).iter().enumerate() {
            let (x, y) = (self.x.at(k as f64 + first), frame.bottom + 1.4 * font);
            self.picture.text(Text::new(x, y, font, Anchor::Middle, name));
        }
    }

    /// Words at places of the x axis with a line each; words that would meet are left out.
    pub(crate) fn ticks_at(&mut self, ticks: &[(f64, String)]) {
        let (font, frame) = (self.spec.size.font, self.frame);
        let mut free = f64::NEG_INFINITY;
        for (value, words) in ticks {
            let (x, half) = (self.x.at(*value), 0.5 * font::width(words, font, false));
            if x < frame.left || x > frame.right {
                continue;
            }
            self.picture.path(&[(x, frame.top), (x, frame.bottom)], Paint::line(ink::GRID, 1.0));
            let middle = x.min(self.spec.size.width - half - 2.0);
            if middle - half > free {
                self.picture.text(Text::new(middle, frame.bottom + 1.4 * font, font, Anchor::Middle, words));
                free = middle + half + 8.0;
            }
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

    /// The picture under a legend, which draws itself and returns its height; `plot` is the name to the page's script,
    /// empty for a still one.
    pub(crate) fn under(mut self, plot: &str, legend: impl FnOnce(&mut Picture) -> f64) -> Picture {
        let mut picture = Picture::new(&self.spec.name, &self.spec.title, self.spec.size.width, 0.0);
        let top = legend(&mut picture);
        if !plot.is_empty() {
            self.interactive_at(plot, top);
        }
        let drawn = self.finish();
        picture.height = top + drawn.height;
        picture.attributes.clone_from(&drawn.attributes);
        picture.place(drawn, 0.0, top);
        picture
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

/// Names as there is room for them: whole, or without what all share at their ends, or, where they would look alike
/// then, numbers from 1. `fitted` cuts one.
fn shown(names: &[String], fitted: impl Fn(&str) -> String) -> Vec<String> {
    let cut = |names: &[String]| names.iter().map(|name| fitted(name)).collect::<Vec<_>>();
    let whole = cut(names);
    if names.len() < 2 || whole == names {
        return whole;
    }
    let shorter = cut(&telling_parts(names));
    let distinct = |names: &[String]| names.iter().collect::<std::collections::BTreeSet<_>>().len();
    match distinct(&shorter) == distinct(names) {
        true => shorter,
        false => (1..=names.len()).map(|k| k.to_string()).collect(),
    }
}

/// Names without the words that all of them begin and end with.
fn telling_parts(names: &[String]) -> Vec<String> {
    let same = |letters: Vec<Vec<char>>| {
        let shared = (0..).take_while(|k| letters.iter().all(|l| l.get(*k).is_some_and(|c| *c == letters[0][*k])));
        // Up to the end of a word.
        let ends = shared.filter(|k| !letters[0][*k].is_alphanumeric());
        ends.last().map_or(0, |k| k + 1)
    };
    let first = same(names.iter().map(|name| name.chars().collect()).collect());
    let last = same(
        names.iter().map(|name| name.chars().skip(first).collect::<Vec<_>>().into_iter().rev().collect()).collect(),
    );
    let dots = |cut: usize| if cut > 0 { "…" } else { "" };
    let part = |name: &String| {
        let kept = name.chars().count() - first - last;
        format!("{}{}{}", dots(first), name.chars().skip(first).take(kept).collect::<String>(), dots(last))
    };
    names.iter().map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_a_remark_lies_outside_the_frame() {
        let size = Size { width: 360.0, height: 300.0, font: 11.0 };
        let axis = Domain::exact(0.0, 1.0);
        for words in
            ["short", "far more words than have room on one line of so narrow a picture, so that they take two"]
        {
            let plain = Spec::new("a", "b", size, (axis, "x", ""), (axis, "y", ""));
            let chart = Chart::new(Spec { remark: words.into(), ..plain.clone() });
            let part = |text: &str| text.len() > 3 && words.contains(text.trim());
            let said = |s: &&Shape| matches!(s, Shape::Text(t) if t.runs.iter().any(|r| part(&r.text)));
            let lines: Vec<&Shape> = chart.picture.shapes.iter().filter(said).collect();
            assert_eq!(lines.len(), if words == "short" { 1 } else { 2 });
            for line in lines {
                assert!(matches!(line, Shape::Text(t) if t.y < chart.frame.top && t.y > 8.0));
            }
            assert!(chart.frame.top > Chart::new(plain).frame.top);
        }
    }

    #[test]
    fn prop_numbers_on_an_axis_lie_within_the_picture() {
        for (width, top) in [(960.0, 12_500.0), (960.0, 20_000.0), (360.0, 1e6), (360.0, 6_000.0)] {
            let size = Size { width, height: 300.0, font: 12.5 };
            let spec =
                Spec::new("a", "b", size, (Domain::exact(0.0, top), "x", ""), (Domain::exact(0.0, 1.0), "y", ""));
            for shape in Chart::new(spec).picture.shapes {
                if let Shape::Text(text) = shape {
                    let end = text.x + text.start() + text.width();
                    assert!(text.upright || end <= width, "{top}: {end} of {width}");
                }
            }
        }
    }

    #[test]
    fn prop_names_on_an_axis_are_told_apart() {
        let names = |all: &[&str]| all.iter().map(|n| (*n).to_owned()).collect::<Vec<String>>();
        let room = |most: usize| move |name: &str| name.chars().take(most).collect::<String>();
        let files = names(&["rig_1730_or_12_de.npz", "rig_1730_or_3_de.npz", "rig_1730_b_de.npz"]);
        assert_eq!(shown(&files, room(30)), files);
        assert_eq!(shown(&files, room(9)), ["…or_12…", "…or_3…", "…b…"]);
        assert_eq!(shown(&files, room(3)), ["1", "2", "3"]);
        let nested = names(&["x_a.csv", "x_b_a.csv"]);
        assert_eq!(shown(&nested, room(5)), ["…a…", "…b_a…"]);
        // What is called the same cannot be told apart.
        let same = names(&["rig a", "rig a"]);
        assert_eq!(shown(&same, room(3)).len(), 2);
        assert_eq!(shown(&names(&["alone.csv"]), room(5)), ["alone"]);
    }
}
