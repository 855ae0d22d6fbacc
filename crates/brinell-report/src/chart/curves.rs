//! What is drawn on a plot: curves, bands, a shaded stretch, words.

use super::{Chart, Domain};
use crate::picture::{Anchor, Axis, Curve, Paint, Rect, Shape, Text, ink};
use crate::thin::{straightened, thinned};

/// Points of a curve that are kept as numbers, at most.
const MOST_KEPT: usize = 65_536;

/// Which values of a curve are kept: all, or of so long a curve the smallest and the largest of each of as many
/// stretches as there is room for.
fn telling(values: &[f64]) -> Box<dyn Iterator<Item = usize> + '_> {
    if values.len() <= MOST_KEPT {
        return Box::new(0..values.len());
    }
    let stretch = values.len().div_ceil(MOST_KEPT / 2);
    let ends = move |k: usize| {
        let first = k * stretch;
        let part = first..(first + stretch).min(values.len());
        let known = || part.clone().filter(|i| values[*i].is_finite());
        let by = |a: &usize, b: &usize| values[*a].total_cmp(&values[*b]);
        let (low, high) = (known().min_by(by), known().max_by(by));
        let mut ends = [low.unwrap_or(first), high.unwrap_or(first)];
        ends.sort_unstable();
        let [one, other] = ends;
        std::iter::once(one).chain((one != other).then_some(other))
    };
    Box::new((0..values.len().div_ceil(stretch)).flat_map(ends))
}

impl Chart {
    /// What the curves drawn from here on are of, where there are several on the axes.
    pub(crate) fn of(&mut self, name: &str) {
        name.clone_into(&mut self.curve);
    }

    /// Keeps what a curve is drawn from; `kind` is said after its name.
    pub(crate) fn keep(&mut self, kind: &str, xs: Vec<f64>, ys: Vec<f64>) {
        let axis = |label: &str, unit: &str| Axis { label: label.to_owned(), unit: unit.to_owned() };
        let both = !self.curve.is_empty() && !kind.is_empty();
        self.picture.curves.push(Curve {
            name: format!("{}{}{kind}", self.curve, if both { " " } else { "" }),
            x: axis(&self.spec.x_label, &self.spec.x_unit),
            y: axis(&self.spec.y_label, &self.spec.y_unit),
            xs,
            ys,
        });
    }

    /// A curve through evenly spaced values; `peak` keeps the largest value where there are several to a pixel.
    pub(crate) fn curve(&mut self, x0: f64, dx: f64, values: &[f64], peak: bool, paint: Paint) {
        let Domain { lo, hi, .. } = self.spec.x;
        let index = |x: f64| {
            if dx > 0.0 { ((x - x0) / dx).clamp(-1.0, values.len() as f64) } else { 0.0 }
        };
        let first = (index(lo).floor() - 1.0).max(0.0) as usize;
        let last = ((index(hi).ceil() + 2.0).max(0.0) as usize).min(values.len());
        let points = values[first.min(last)..last]
            .iter()
            .enumerate()
            .map(|(i, v)| (self.x.at(x0 + (first + i) as f64 * dx), v.is_finite().then(|| self.y.at(*v))));
        let lines = thinned(points, peak);
        let seen = telling(&values[first.min(last)..last]).map(|i| first + i);
        let (xs, ys) = seen.map(|i| (x0 + i as f64 * dx, values[i])).unzip();
        self.keep("", xs, ys);
        self.lines(lines, paint);
    }

    /// A curve through points.
    pub(crate) fn points(&mut self, xs: &[f64], ys: &[f64], paint: Paint) {
        let points = xs.iter().zip(ys).map(|(x, y)| (*x, *y)).map(|(x, y)| {
            let seen = x.is_finite() && y.is_finite();
            (if x.is_finite() { self.x.at(x) } else { 0.0 }, seen.then(|| self.y.at(y)))
        });
        let lines = straightened(thinned(points, false));
        let count = xs.len().min(ys.len());
        self.keep("", xs[..count].to_vec(), ys[..count].to_vec());
        self.lines(lines, paint);
    }

    /// The area between two curves of bins.
    pub(crate) fn band(&mut self, x0: f64, dx: f64, low: &[f64], high: &[f64], paint: Paint) {
        let bins = low.len().min(high.len());
        for (kind, edge) in [("smallest", low), ("largest", high)] {
            let xs = (0..bins).map(|bin| x0 + (bin as f64 + 0.5) * dx);
            self.keep(kind, xs.collect(), edge[..bins].to_vec());
        }
        let mut columns: Vec<(f64, f64, f64)> = vec![];
        let mut lines = vec![];
        let mut flush = |columns: &mut Vec<(f64, f64, f64)>| {
            if columns.len() == 1 {
                let (x, low, high) = columns[0];
                columns.push((x + 1.0, low, high));
            }
            let there = columns.iter().map(|(x, _, high)| (*x, *high));
            let back = columns.iter().rev().map(|(x, low, _)| (*x, *low));
            let outline: Vec<_> = there.chain(back).collect();
            if !outline.is_empty() {
                lines.push(outline);
            }
            columns.clear();
        };
        for (bin, (low, high)) in low.iter().zip(high).enumerate() {
            if !(low.is_finite() && high.is_finite()) {
                flush(&mut columns);
                continue;
            }
            let x = self.x.at(x0 + (bin as f64 + 0.5) * dx);
            let (low, high) = (self.y.at(*low), self.y.at(*high));
            match columns.last_mut() {
                Some(column) if x - column.0 < 0.7 => {
                    column.1 = column.1.max(low);
                    column.2 = column.2.min(high);
                }
                _ => columns.push((x, low, high)),
            }
        }
        flush(&mut columns);
        let clip = Some(self.frame);
        self.picture.shapes.push(Shape::Path { lines, close: true, paint, clip });
    }

    fn lines(&mut self, mut lines: Vec<Vec<(f64, f64)>>, paint: Paint) {
        let dots: Vec<(f64, f64)> = lines.iter().filter(|line| line.len() == 1).map(|line| line[0]).collect();
        lines.retain(|line| line.len() > 1);
        self.picture.shapes.push(Shape::Open("series"));
        self.picture.shapes.push(Shape::Path { lines, close: false, paint, clip: Some(self.frame) });
        for (x, y) in dots {
            self.picture.shapes.push(Shape::Circle { x, y, r: 2.0, paint: Paint::fill(paint.stroke, 1.0) });
        }
        self.picture.shapes.push(Shape::Close);
    }

    /// A shaded stretch of the x axis.
    pub(crate) fn highlight(&mut self, lo: f64, hi: f64) {
        let (left, right) = (self.x.at(lo), self.x.at(hi));
        let widen = (3.0 - (right - left)).max(0.0) / 2.0;
        let (left, right) = ((left - widen).max(self.frame.left), (right + widen).min(self.frame.right));
        if right > left {
            let rect = Rect { left, right, ..self.frame };
            self.picture.shapes.push(Shape::Open("window"));
            self.picture.rect(rect, Paint::line(ink::ORANGE, 1.5).filled(ink::ORANGE, 0.25));
            self.picture.shapes.push(Shape::Close);
        }
    }

    /// Words where a curve should be.
    pub(crate) fn say(&mut self, words: &str) {
        let x = 0.5 * (self.frame.left + self.frame.right);
        let y = 0.5 * (self.frame.top + self.frame.bottom);
        self.picture.text(Text::new(x, y, self.spec.size.font + 1.0, Anchor::Middle, words).color(ink::FAINT));
    }
}
