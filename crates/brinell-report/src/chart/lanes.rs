//! Lanes: marks on a line of their own above a plot.

use super::{Chart, Domain};
use crate::font;
use crate::picture::{Anchor, Paint, Shape, Text, ink};

/// A mark on the x axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Mark {
    pub(crate) x: f64,
    /// Said when the reader points at it.
    pub(crate) name: String,
    /// Written beside it where there is room.
    pub(crate) label: String,
}

/// Marks of one kind, on a line of their own above the plot.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lane {
    pub(crate) label: String,
    /// Written at the right end.
    pub(crate) value: String,
    pub(crate) color: &'static str,
    pub(crate) dash: &'static [f64],
    /// Whether the marks run down through the plot.
    pub(crate) through: bool,
    pub(crate) marks: Vec<Mark>,
    /// Marks of less weight: half as high, thin, without words.
    pub(crate) minor: Vec<Mark>,
}

pub(crate) const LANE_HEIGHT: f64 = 17.0;

impl Chart {
    /// One lane over the curves, `index` from the top.
    pub(super) fn lane(&mut self, index: usize, lane: &Lane) {
        let font = self.spec.size.font;
        let Domain { lo, hi, .. } = self.spec.x;
        let frame = self.frame;
        let base = 5.0 + LANE_HEIGHT * (index as f64 + 1.0);
        let text = base - 0.5 * (LANE_HEIGHT - 0.72 * font);
        let color = if lane.through { ink::BLACK } else { ink::FAINT };
        let name = font::fitted(&lane.label, font, true, frame.left - 10.0);
        self.picture.text(Text::new(frame.left - 7.0, text, font, Anchor::End, &name).bold().color(color));
        self.picture.text(Text::new(frame.right + 7.0, text, font, Anchor::Start, &lane.value).color(color));
        let ruler = base - 0.5 * LANE_HEIGHT;
        self.picture.path(&[(frame.left, ruler), (frame.right, ruler)], Paint::line(ink::GRID, 1.0));

        let seen = || lane.marks.iter().filter(|mark| mark.x >= lo && mark.x <= hi);
        let across = |marks: &[Mark], top: f64, bottom: f64| -> Vec<Vec<(f64, f64)>> {
            let mut lines: Vec<Vec<(f64, f64)>> = vec![];
            for mark in marks.iter().filter(|mark| mark.x >= lo && mark.x <= hi) {
                let x = self.x.at(mark.x);
                // Two marks in a pixel look like one.
                if lines.last().is_none_or(|line| (line[0].0 - x).abs() >= 0.5) {
                    lines.push(vec![(x, top), (x, bottom)]);
                }
            }
            lines
        };
        let fade = if lane.through { 1.0 } else { 0.6 };
        let short = across(&lane.marks, ruler - 5.5, ruler + 5.5);
        let mut drawn = vec![(short, Paint::line(lane.color, 2.0).faded(fade), None)];
        if lane.through {
            let long = across(&lane.marks, frame.top, frame.bottom);
            drawn.push((long, Paint::line(lane.color, 1.0).dashed(lane.dash).faded(0.75), Some(frame)));
        }
        if !lane.minor.is_empty() {
            let half = across(&lane.minor, ruler, ruler + 5.5);
            drawn.push((half, Paint::line(lane.color, 1.0).faded(fade), None));
        }
        self.picture.shapes.push(Shape::Open("lane"));
        let paths = drawn.into_iter().map(|(lines, paint, clip)| Shape::Path { lines, close: false, paint, clip });
        self.picture.shapes.extend(paths);
        let mut free = f64::NEG_INFINITY;
        let mut next = seen().map(|mark| self.x.at(mark.x)).skip(1);
        let mut labels = vec![];
        for mark in seen() {
            let x = self.x.at(mark.x) + 4.0;
            let end = x + font::width(&mark.label, font - 1.0, false) + 4.0;
            let limit = next.next().unwrap_or(frame.right);
            if mark.label.is_empty() || x < free || end > limit + 2.0 {
                continue;
            }
            free = end;
            labels.push(Text::new(x, text - 0.4, font - 1.0, Anchor::Start, &mark.label).color(ink::TEXT));
        }
        self.picture.shapes.extend(labels.into_iter().map(Shape::Text));
        self.picture.shapes.push(Shape::Close);
    }
}
