//! What is drawn on a plot: curves, bands, a shaded stretch, words.

use super::{Chart, Domain};
use crate::picture::{Anchor, Paint, Rect, Shape, Text, ink};
use crate::thin::{straightened, thinned};

impl Chart {
    /// A curve through evenly spaced values; `peak` keeps the largest value where there are several to a pixel.
    pub(crate) fn curve(&mut self, x0: f64, dx: f64, values: &[f64], peak: bool, paint: Paint) {
        let Domain { lo, hi, .. } = self.spec.x;
        let index = |x: f64| {
            if dx > 0.0 {
                ((x - x0) / dx).clamp(-1.0, values.len() as f64)
            } else {
                0.0
            }
        };
        let first = (index(lo).floor() - 1.0).max(0.0) as usize;
        let last = ((index(hi).ceil() + 2.0).max(0.0) as usize).min(values.len());
        let points = values[first.min(last)..last]
            .iter()
            .enumerate()
            .map(|(i, v)| {
                (
                    self.x.at(x0 + (first + i) as f64 * dx),
                    v.is_finite().then(|| self.y.at(*v)),
                )
            });
        let lines = thinned(points, peak);
        self.lines(lines, paint);
    }

    /// A curve through points.
    pub(crate) fn points(&mut self, xs: &[f64], ys: &[f64], paint: Paint) {
        let points = xs.iter().zip(ys).map(|(x, y)| (*x, *y)).map(|(x, y)| {
            let seen = x.is_finite() && y.is_finite();
            (
                if x.is_finite() { self.x.at(x) } else { 0.0 },
                seen.then(|| self.y.at(y)),
            )
        });
        let lines = straightened(thinned(points, false));
        self.lines(lines, paint);
    }

    /// The area between two curves of bins.
    pub(crate) fn band(&mut self, x0: f64, dx: f64, low: &[f64], high: &[f64], paint: Paint) {
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
        self.picture.shapes.push(Shape::Path {
            lines,
            close: true,
            paint,
            clip,
        });
    }

    fn lines(&mut self, mut lines: Vec<Vec<(f64, f64)>>, paint: Paint) {
        let dots: Vec<(f64, f64)> = lines
            .iter()
            .filter(|line| line.len() == 1)
            .map(|line| line[0])
            .collect();
        lines.retain(|line| line.len() > 1);
        self.picture.shapes.push(Shape::Open("series"));
        self.picture.shapes.push(Shape::Path {
            lines,
            close: false,
            paint,
            clip: Some(self.frame),
        });
        for (x, y) in dots {
            self.picture.shapes.push(Shape::Circle {
                x,
                y,
                r: 2.0,
                paint: Paint::fill(paint.stroke, 1.0),
            });
        }
        self.picture.shapes.push(Shape::Close);
    }

    /// A shaded stretch of the x axis.
    pub(crate) fn highlight(&mut self, lo: f64, hi: f64) {
        let (left, right) = (self.x.at(lo), self.x.at(hi));
        let widen = (3.0 - (right - left)).max(0.0) / 2.0;
        let (left, right) = (
            (left - widen).max(self.frame.left),
            (right + widen).min(self.frame.right),
        );
        if right > left {
            let rect = Rect {
                left,
                right,
                ..self.frame
            };
            self.picture.shapes.push(Shape::Open("window"));
            self.picture.rect(
                rect,
                Paint::line(ink::ORANGE, 1.5).filled(ink::ORANGE, 0.25),
            );
            self.picture.shapes.push(Shape::Close);
        }
    }

    /// Words over the curves, at the top left.
    pub(crate) fn remark(&mut self, words: &str) {
        let font = self.spec.size.font - 1.0;
        let (x, y) = (self.frame.left + 6.0, self.frame.top + 1.4 * font);
        let text = Text::with_unit(x, y, font, Anchor::Start, words);
        let back = Rect {
            left: self.frame.left + 1.0,
            right: (x + text.width() + 5.0).min(self.frame.right),
            top: self.frame.top + 1.0,
            bottom: y + 0.5 * font,
        };
        self.picture.rect(back, Paint::fill("#ffffff", 0.85));
        self.picture.text(text);
    }

    /// Words where a curve should be.
    pub(crate) fn say(&mut self, words: &str) {
        let x = 0.5 * (self.frame.left + self.frame.right);
        let y = 0.5 * (self.frame.top + self.frame.bottom);
        self.picture.text(
            Text::new(x, y, self.spec.size.font + 1.0, Anchor::Middle, words).color(ink::FAINT),
        );
    }
}
