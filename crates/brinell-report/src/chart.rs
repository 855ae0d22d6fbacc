//! A Cartesian plot: scales, ticks, axis labels, curves thinned to the pixels there are, and lanes of marks above it.

use crate::font;
use crate::number::{linear_ticks, log_ticks, superscript, tick_labels};
use crate::picture::{Anchor, Paint, Picture, Rect, Shape, Text, coordinate, ink};
use crate::thin::{straightened, thinned};

/// How large a picture is drawn. The page holds both, and shows the one that fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Size {
    pub(crate) width: f64,
    pub(crate) height: f64,
    pub(crate) font: f64,
}

/// The part of a quantity that an axis shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Domain {
    pub(crate) lo: f64,
    pub(crate) hi: f64,
    pub(crate) log: bool,
}

/// Beyond this a double's square overflows, and below its inverse one vanishes; nothing physical comes near either.
const HUGE: f64 = 1e150;

/// The value that a plot computes with.
fn tame(value: f64) -> f64 {
    if value.abs() < 1.0 / HUGE {
        0.0
    } else {
        value.clamp(-HUGE, HUGE)
    }
}

/// Smallest and largest finite value.
pub(crate) fn range(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    values
        .into_iter()
        .filter(|v| v.is_finite())
        .map(tame)
        .fold(None, |range, v| {
            Some(range.map_or((v, v), |(lo, hi): (f64, f64)| (lo.min(v), hi.max(v))))
        })
}

impl Domain {
    pub(crate) fn exact(lo: f64, hi: f64) -> Self {
        let (lo, hi) = range([lo, hi]).unwrap_or((0.0, 1.0));
        let largest = lo.abs().max(hi.abs());
        // A span that rounding swallows shows nothing.
        let room = if hi - lo > 1e-12 * largest.max(1e-290) {
            0.0
        } else {
            (1e-9 * largest).max(0.5)
        };
        Self {
            lo: lo - room,
            hi: hi + room,
            log: false,
        }
    }

    /// Holds every value with some room; a constant gets room around it.
    pub(crate) fn around(values: impl IntoIterator<Item = f64>) -> Self {
        match range(values) {
            None => Self {
                lo: 0.0,
                hi: 1.0,
                log: false,
            },
            Some((lo, hi)) if hi - lo > 1e-9 * lo.abs().max(hi.abs()) => {
                let room = 0.06 * (hi - lo);
                Self {
                    lo: lo - room,
                    hi: hi + room,
                    log: false,
                }
            }
            Some((0.0, _)) => Self {
                lo: -1.0,
                hi: 1.0,
                log: false,
            },
            Some((lo, hi)) => {
                let room = 0.1 * lo.abs().max(hi.abs());
                Self {
                    lo: lo - room,
                    hi: hi + room,
                    log: false,
                }
            }
        }
    }

    /// From zero up, for what cannot be negative.
    pub(crate) fn from_zero(values: impl IntoIterator<Item = f64>) -> Self {
        let (lo, hi) = range(values).unwrap_or((0.0, 0.0));
        if lo < 0.0 {
            return Self::around([lo, hi.max(0.0)]);
        }
        Self {
            lo: 0.0,
            hi: if hi > 0.0 { hi * 1.08 } else { 1.0 },
            log: false,
        }
    }

    /// Whole decades, at most six of them below the largest value.
    pub(crate) fn decades(values: &[f64]) -> Self {
        let positive = || values.iter().copied().filter(|v| *v > 1e-300);
        let Some((lo, hi)) = range(positive()) else {
            return Self {
                lo: 0.1,
                hi: 1.0,
                log: true,
            };
        };
        // The floor follows the bulk of the lines, not the deepest notch.
        let mut sample: Vec<f64> = positive().step_by(values.len() / 4096 + 1).collect();
        sample.sort_by(f64::total_cmp);
        let floor = sample.get(sample.len() / 20).copied().unwrap_or(lo);
        let decade = hi.log10().floor();
        let tops = [2.0f64, 5.0, 10.0, 20.0].map(|m| m.log10() + decade);
        let top = tops
            .into_iter()
            .find(|top| *top > hi.log10() + 0.04)
            .unwrap_or(decade + 1.0);
        let bottom = floor.log10().floor().clamp(decade - 5.0, decade - 1.0);
        Self {
            lo: 10f64.powf(bottom),
            hi: 10f64.powf(top),
            log: true,
        }
    }
}

/// From a domain to pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale {
    domain: Domain,
    from: f64,
    to: f64,
}

impl Scale {
    pub(crate) fn at(&self, value: f64) -> f64 {
        let Domain { lo, hi, log } = self.domain;
        let part = if log {
            (value.max(lo * 1e-3).log10() - lo.log10()) / (hi.log10() - lo.log10())
        } else {
            (tame(value) - lo) / (hi - lo)
        };
        // A curve may leave the frame, but not by more than the clipping can take.
        self.from + part.clamp(-20.0, 20.0) * (self.to - self.from)
    }
}

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

pub(crate) const LANE_HEIGHT: f64 = 17.0;

/// A plot being drawn.
pub(crate) struct Chart {
    pub(crate) picture: Picture,
    pub(crate) frame: Rect,
    pub(crate) x: Scale,
    pub(crate) y: Scale,
    spec: Spec,
}

/// "Force (10³ N)", or what of it makes sense.
fn axis_label(label: &str, unit: &str, power: i32) -> String {
    match (unit, power) {
        ("", 0) => label.to_owned(),
        ("", _) => format!("{label} (10{})", superscript(power)),
        (_, 0) => format!("{label} ({unit})"),
        _ => format!("{label} (10{} {unit})", superscript(power)),
    }
}

/// Ticks with labels, and the power of ten left to the axis label.
fn ticks(domain: Domain, target: usize) -> (Vec<f64>, Vec<String>, i32) {
    if domain.log {
        let ticks = log_ticks(domain.lo, domain.hi, target);
        let labels = ticks
            .iter()
            .map(|t| match t.log10().round() as i32 {
                0 => "1".to_owned(),
                1 => "10".to_owned(),
                2 => "100".to_owned(),
                decade => format!("10{}", superscript(decade)),
            })
            .collect();
        return (ticks, labels, 0);
    }
    // Two numbers are hardly a scale: somewhat closer ones, where that gives more.
    let ticks = (target..=target + 2)
        .map(|target| linear_ticks(domain.lo, domain.hi, target))
        .find(|ticks| ticks.len() > 2)
        .unwrap_or_else(|| linear_ticks(domain.lo, domain.hi, target));
    let (labels, power) = tick_labels(&ticks);
    (ticks, labels, power)
}

/// Splits a label so that it fits in two lines: at the best space, but not inside the unit.
fn halves(label: &str) -> (String, String) {
    let unit = label.rfind(" (").map_or(label.len(), |at| at + 1);
    let middle = label.len() / 2;
    match label[..unit]
        .match_indices(' ')
        .map(|(at, _)| at)
        .min_by_key(|at| at.abs_diff(middle))
    {
        Some(at) => (label[..at].to_owned(), label[at + 1..].to_owned()),
        None => (label.to_owned(), String::new()),
    }
}

/// Margin that the y axis of a plot needs: numbers, label, and the names of its lanes.
pub(crate) fn left_margin(spec: &Spec) -> f64 {
    let font = spec.size.font;
    let (_, labels, _) = ticks(spec.y, y_target(spec));
    let numbers = labels
        .iter()
        .map(|l| font::width(l, font, false))
        .fold(font::width("−0.05", font, false), f64::max);
    let lanes = spec
        .lanes
        .iter()
        .map(|l| font::width(&l.label, font, true))
        .fold(0.0, f64::max);
    let lines = if label_is_long(spec) { 2.0 } else { 1.0 };
    (numbers + 10.0 + lines * 1.3 * font + 4.0).max((lanes + 14.0).min(0.3 * spec.size.width))
}

/// Margin that the values of a plot's lanes need.
pub(crate) fn right_margin(spec: &Spec) -> f64 {
    let font = spec.size.font;
    let ends = spec
        .lanes
        .iter()
        .map(|l| font::width(&l.value, font, false))
        .fold(0.0, f64::max);
    if ends > 0.0 { ends + 12.0 } else { 1.2 * font }
}

fn plot_height(spec: &Spec) -> f64 {
    let below = if spec.x_axis {
        3.4 * spec.size.font
    } else {
        8.0
    };
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
        let Size {
            width,
            height,
            font,
        } = spec.size;
        let left = left_margin(&spec).max(spec.left);
        let right = right_margin(&spec).max(spec.right);
        let top = 8.0 + LANE_HEIGHT * spec.lanes.len() as f64;
        let frame = Rect {
            left,
            top,
            right: (width - right).max(left + 20.0),
            bottom: top + plot_height(&spec),
        };
        let x = Scale {
            domain: spec.x,
            from: frame.left,
            to: frame.right,
        };
        let y = Scale {
            domain: spec.y,
            from: frame.bottom,
            to: frame.top,
        };
        let mut picture = Picture::new(&spec.name, &spec.title, width, height);

        let (values, labels, y_power) = ticks(spec.y, y_target(&spec));
        picture.shapes.push(Shape::Open("ticks-y"));
        for (value, label) in values.iter().zip(&labels) {
            let at = y.at(*value);
            picture.path(
                &[(frame.left, at), (frame.right, at)],
                Paint::line(ink::GRID, 1.0),
            );
            picture.text(Text::new(
                frame.left - 7.0,
                at + 0.36 * font,
                font,
                Anchor::End,
                label,
            ));
        }
        picture.shapes.push(Shape::Close);

        let widest = |labels: &[String]| {
            labels
                .iter()
                .map(|l| font::width(l, font, false))
                .fold(0.0, f64::max)
        };
        let mut target = ((frame.width() / 60.0) as usize).clamp(3, 10);
        while target > 1 {
            let (values, labels, _) = ticks(spec.x, target);
            if (widest(&labels) + 14.0) * values.len() as f64 <= frame.width() {
                break;
            }
            target -= 1;
        }
        let (values, labels, x_power) = ticks(spec.x, target);
        picture.shapes.push(Shape::Open("ticks-x"));
        for (value, label) in values.iter().zip(&labels) {
            let at = x.at(*value);
            picture.path(
                &[(at, frame.top), (at, frame.bottom)],
                Paint::line(ink::GRID, 1.0),
            );
            if spec.x_axis {
                picture.text(Text::new(
                    at,
                    frame.bottom + 1.4 * font,
                    font,
                    Anchor::Middle,
                    label,
                ));
            }
        }
        picture.shapes.push(Shape::Close);

        if spec.x_axis {
            let label = axis_label(&spec.x_label, &spec.x_unit, x_power);
            let middle = 0.5 * (frame.left + frame.right);
            picture.text(Text::with_unit(
                middle,
                frame.bottom + 3.0 * font,
                font,
                Anchor::Middle,
                &label,
            ));
        }
        let label = axis_label(&spec.y_label, &spec.y_unit, y_power);
        let middle = 0.5 * (frame.top + frame.bottom);
        let mut line = |x: f64, text: &str| {
            picture.text(Text::with_unit(x, middle, font, Anchor::Middle, text).upright());
        };
        if label_is_long(&spec) {
            let (first, second) = halves(&label);
            line(1.05 * font, &first);
            line(2.3 * font, &second);
        } else {
            line(1.05 * font, &label);
        }
        Self {
            picture,
            frame,
            x,
            y,
            spec,
        }
    }

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

    /// Words where a curve should be.
    pub(crate) fn say(&mut self, words: &str) {
        let x = 0.5 * (self.frame.left + self.frame.right);
        let y = 0.5 * (self.frame.top + self.frame.bottom);
        self.picture.text(
            Text::new(x, y, self.spec.size.font + 1.0, Anchor::Middle, words).color(ink::FAINT),
        );
    }

    /// Frame and lanes, over the curves.
    pub(crate) fn finish(mut self) -> Picture {
        let font = self.spec.size.font;
        let Domain { lo, hi, .. } = self.spec.x;
        let frame = self.frame;
        self.picture.rect(frame, Paint::line(ink::FRAME, 1.0));
        for (index, lane) in self.spec.lanes.iter().enumerate() {
            let base = 5.0 + LANE_HEIGHT * (index as f64 + 1.0);
            let text = base - 0.5 * (LANE_HEIGHT - 0.72 * font);
            let color = if lane.through { ink::BLACK } else { ink::FAINT };
            let name = font::fitted(&lane.label, font, true, frame.left - 10.0);
            self.picture.text(
                Text::new(frame.left - 7.0, text, font, Anchor::End, &name)
                    .bold()
                    .color(color),
            );
            self.picture.text(
                Text::new(frame.right + 7.0, text, font, Anchor::Start, &lane.value).color(color),
            );
            let ruler = base - 0.5 * LANE_HEIGHT;
            self.picture.path(
                &[(frame.left, ruler), (frame.right, ruler)],
                Paint::line(ink::GRID, 1.0),
            );

            let seen = || {
                lane.marks
                    .iter()
                    .filter(|mark| mark.x >= lo && mark.x <= hi)
            };
            let across = |top: f64, bottom: f64| -> Vec<Vec<(f64, f64)>> {
                let mut lines: Vec<Vec<(f64, f64)>> = vec![];
                for mark in seen() {
                    let x = self.x.at(mark.x);
                    // Two marks in a pixel look like one.
                    if lines.last().is_none_or(|line| (line[0].0 - x).abs() >= 0.5) {
                        lines.push(vec![(x, top), (x, bottom)]);
                    }
                }
                lines
            };
            self.picture.shapes.push(Shape::Open("lane"));
            let fade = if lane.through { 1.0 } else { 0.6 };
            self.picture.shapes.push(Shape::Path {
                lines: across(ruler - 5.5, ruler + 5.5),
                close: false,
                paint: Paint::line(lane.color, 2.0).faded(fade),
                clip: None,
            });
            if lane.through {
                self.picture.shapes.push(Shape::Path {
                    lines: across(frame.top, frame.bottom),
                    close: false,
                    paint: Paint::line(lane.color, 1.0).dashed(lane.dash).faded(0.75),
                    clip: Some(frame),
                });
            }
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
                labels.push(
                    Text::new(x, text - 0.4, font - 1.0, Anchor::Start, &mark.label)
                        .color(ink::TEXT),
                );
            }
            self.picture
                .shapes
                .extend(labels.into_iter().map(Shape::Text));
            self.picture.shapes.push(Shape::Close);
        }
        self.picture
    }

    /// Tells the page's script where the plot stands.
    pub(crate) fn interactive(&mut self, plot: &str) {
        let Rect {
            left,
            top,
            right,
            bottom,
        } = self.frame;
        let [l, t, r, b] = [left, top, right, bottom].map(coordinate);
        self.picture.attributes = format!(
            " data-plot=\"{plot}\" data-frame=\"{l} {t} {r} {b}\" data-view=\"{} {}\" data-font=\"{}\"",
            self.spec.x.lo, self.spec.x.hi, self.spec.size.font
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_domains_hold_odd_data() {
        for values in [
            vec![],
            vec![f64::NAN],
            vec![0.0],
            vec![3.0; 4],
            vec![f64::INFINITY, 1e308, -1e308],
            vec![1e-320],
        ] {
            for domain in [
                Domain::around(values.clone()),
                Domain::from_zero(values.clone()),
                Domain::decades(&values),
                Domain::exact(
                    values.first().copied().unwrap_or(0.0),
                    values.last().copied().unwrap_or(0.0),
                ),
            ] {
                assert!(
                    domain.lo < domain.hi && (domain.hi - domain.lo).is_finite(),
                    "{values:?} {domain:?}"
                );
            }
        }
    }
}
