//! One indicator against a key: a line for each value of the other keys, with intervals.

use crate::chart::{Chart, Domain, LANE_HEIGHT, Lane, Mark, Size, Spec, range};
use crate::data::{Along, Tone};
use crate::embedded::{Curve, Plot};
use crate::font;
use crate::layout::{Layout, legend};
use crate::picture::{Anchor, Paint, Picture, Shape, Text, ink};

/// One point of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct IndicatorPoint {
    /// The varied key's value, or the place among [`IndicatorPlot::x_names`].
    pub x: f64,
    /// The dot. NaN where the point failed: the line has a gap there.
    pub value: f64,
    /// Ends of the 95 % interval.
    pub interval: Option<(f64, f64)>,
}

/// Points that differ in the key on the x axis alone.
#[derive(Clone, Debug, PartialEq)]
pub struct IndicatorLine {
    /// What the others have: "full, 10".
    pub label: String,
    /// In the order of x.
    pub points: Vec<IndicatorPoint>,
}

/// An indicator against a key.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct IndicatorPlot {
    /// Name of the picture's file.
    pub name: String,
    /// The quantity, for the y axis: "RMS of sensor_ax".
    pub label: String,
    /// Its unit; empty where it has none.
    pub unit: String,
    /// The key.
    pub x_label: String,
    /// Its unit; empty where it has none.
    pub x_unit: String,
    /// Names on the x axis where the key's values are no numbers; x then counts them from 0.
    pub x_names: Vec<String>,
    /// Whether there is an order in these names, so that points are joined.
    pub ordered: bool,
    /// What the lines' labels are values of; may be empty.
    pub legend: String,
    /// The lines.
    pub lines: Vec<IndicatorLine>,
    /// Values that the lines are compared with, each with a few words; dashed. Of those above all values only the
    /// lowest is shown.
    pub limits: Vec<(f64, String)>,
    /// Words at places of the x axis, such as dates, in place of its numbers.
    pub x_ticks: Vec<(f64, String)>,
    /// Changes: the earliest, the most likely and the latest place on the x axis.
    pub changes: Vec<[f64; 3]>,
    /// Whether points that share a place are drawn at it, and not beside one another.
    pub in_place: bool,
    /// Places on the x axis, marked above the plot: each kind with its words and colour.
    pub lanes: Vec<(String, Tone, Vec<f64>)>,
}

impl IndicatorPlot {
    /// The limits that are shown.
    fn shown_limits(&self) -> impl Iterator<Item = &(f64, String)> {
        let values = self.lines.iter().flat_map(|line| &line.points).map(|p| p.value);
        let highest = values.fold(f64::NEG_INFINITY, f64::max);
        let above = self.limits.iter().map(|l| l.0).filter(|l| *l > highest).fold(f64::INFINITY, f64::min);
        self.limits.iter().filter(move |l| l.0 <= above)
    }
}

/// Colours that the colour-blind distinguish too, then the same with dashes.
const COLORS: [&str; 6] = [ink::BLUE, ink::VERMILLION, ink::GREEN, ink::PURPLE, ink::ORANGE, ink::BLACK];
const DASHES: [&[f64]; 3] = [&[], &[6.0, 3.0], &[2.0, 2.5]];
/// Pixels between the same point of neighbouring lines, and of all lines together at most.
const BESIDE: f64 = 5.0;
const BESIDE_ALL: f64 = 30.0;
/// Values over so many decades are drawn on a logarithmic axis.
const DECADES: f64 = 1.3;

fn paint(line: usize) -> Paint {
    let color = COLORS[line % COLORS.len()];
    Paint::line(color, 1.6).dashed(DASHES[line / COLORS.len() % DASHES.len()])
}

/// The plot.
pub(crate) fn indicator_plot(plot: &IndicatorPlot, layout: Layout) -> Picture {
    let height = if layout.roomy() { 340.0 } else { 300.0 };
    let mut size = layout.size(height + LANE_HEIGHT * plot.lanes.len() as f64);
    let named = !plot.x_names.is_empty();
    let axis_room = 3.4 * size.font - 8.0;
    if named {
        size.height -= axis_room;
    }
    let spec = spec(plot, size);
    let mut chart = Chart::new(spec);
    if named {
        chart.clear("ticks-x");
        chart.name_x(&plot.x_names, 0.0, 6.0);
        chart.label_x(&plot.x_label);
    }
    if !plot.x_ticks.is_empty() {
        chart.clear("ticks-x");
        chart.ticks_at(&plot.x_ticks);
    }
    for [low, at, high] in &plot.changes {
        chart.highlight(*low, *high);
        let (frame, x) = (chart.frame, chart.x.at(*at));
        chart.picture.path(&[(x, frame.top), (x, frame.bottom)], Paint::line(ink::BLACK, 1.0).dashed(&[2.0, 2.5]));
    }
    let mut points = plot.lines.iter().flat_map(|line| &line.points);
    if points.all(|p| !p.value.is_finite()) {
        chart.say("No point has a value");
    }
    for (value, words) in plot.shown_limits() {
        let (frame, y) = (chart.frame, chart.y.at(*value));
        chart.picture.path(&[(frame.left, y), (frame.right, y)], Paint::line(ink::FAINT, 1.2).dashed(&[6.0, 4.0]));
        let words = Text::new(frame.right + 6.0, y + 0.36 * size.font, size.font, Anchor::Start, words);
        chart.picture.text(words.color(ink::FAINT));
    }
    let count = plot.lines.len();
    let step = if plot.in_place { 0.0 } else { BESIDE.min(BESIDE_ALL / count.max(1) as f64) };
    for (k, line) in plot.lines.iter().enumerate() {
        let beside = (k as f64 - 0.5 * (count as f64 - 1.0)) * step;
        draw(&mut chart, line, paint(k), beside, !named || plot.ordered);
    }
    if named {
        chart.picture.height += axis_room;
    }
    if count < 2 {
        chart.interactive(&plot.name);
        return chart.finish();
    }
    let entries: Vec<(&str, Paint)> =
        plot.lines.iter().enumerate().map(|(k, line)| (line.label.as_str(), paint(k))).collect();
    chart.under(&plot.name, |picture| {
        let mut top = 2.0;
        if !plot.legend.is_empty() {
            let words = Text::new(12.0, top + size.font, size.font, Anchor::Start, &plot.legend);
            picture.text(words.color(ink::FAINT));
            top += 1.6 * size.font;
        }
        top + legend(picture, &entries, 12.0, size.width - 12.0, top, size.font)
    })
}

/// What the page's script needs to read it out.
pub(crate) fn embed(page: &mut String, plot: &IndicatorPlot) {
    let columns = |line: &IndicatorLine| {
        let points = line.points.iter();
        points.map(|p| (p.x, p.value)).unzip::<f64, f64, Vec<f64>, Vec<f64>>()
    };
    let lines: Vec<(Vec<f64>, Vec<f64>)> = plot.lines.iter().map(columns).collect();
    let curves = plot.lines.iter().zip(&lines).enumerate().map(|(k, (line, (places, values)))| Curve {
        name: &line.label,
        along: Along::At(places.clone()),
        values,
        paint: paint(k),
    });
    let spec = spec(plot, Layout::Wide.size(0.0));
    Plot { still: true, x_names: &plot.x_names, ..Plot::new(spec, &plot.name, curves.collect()) }.embed(page);
}

/// Its axes.
fn spec(plot: &IndicatorPlot, size: Size) -> Spec {
    let named = !plot.x_names.is_empty();
    let points = || plot.lines.iter().flat_map(|line| &line.points);
    let heights = || {
        let heights = points().flat_map(|p| {
            let (low, high) = p.interval.unwrap_or((p.value, p.value));
            [p.value, low, high]
        });
        heights.chain(plot.shown_limits().map(|l| l.0))
    };
    // The values say whether; the ends of intervals are shown, and those of 0 or less only a linear axis shows.
    let spread = Domain::over_decades(points().map(|p| p.value), DECADES);
    let y = spread.and_then(|_| Domain::over_decades(heights(), DECADES)).unwrap_or_else(|| y_domain(heights()));
    // Of several plots some are and others are not.
    let label = if y.log { format!("{}, logarithmic", plot.label) } else { plot.label.clone() };
    let beside = plot.shown_limits().map(|(_, words)| font::width(words, size.font, false)).fold(0.0, f64::max);
    let x = if named {
        Domain::exact(-0.5, plot.x_names.len() as f64 - 0.5)
    } else {
        Domain::around(points().map(|p| p.x))
    };
    Spec {
        lanes: plot.lanes.iter().map(lane).collect(),
        x_axis: !named,
        right: if beside > 0.0 { beside + 12.0 } else { 0.0 },
        ..Spec::new(
            plot.name.clone(),
            format!("{} over {}", plot.label, plot.x_label),
            size,
            (x, &plot.x_label, &plot.x_unit),
            (y, &label, &plot.unit),
        )
    }
}

fn lane((words, tone, places): &(String, Tone, Vec<f64>)) -> Lane {
    Lane {
        label: words.clone(),
        value: String::new(),
        color: match tone {
            Tone::Good => ink::GREEN,
            Tone::Bad => ink::VERMILLION,
            Tone::Open => ink::ORANGE,
        },
        dash: &[],
        through: false,
        marks: places.iter().map(|x| Mark { x: *x, name: words.clone(), label: String::new() }).collect(),
        minor: Vec::new(),
    }
}

/// From zero where the values come near it, and otherwise around them: a sweep is about differences.
fn y_domain(values: impl Iterator<Item = f64>) -> Domain {
    match range(values) {
        Some((lo, hi)) if lo >= 0.0 && lo < 0.5 * hi => Domain::from_zero([lo, hi]),
        Some((lo, hi)) => Domain::around([lo, hi]),
        None => Domain::from_zero([]),
    }
}

fn draw(chart: &mut Chart, line: &IndicatorLine, paint: Paint, beside: f64, joined: bool) {
    let at = |chart: &Chart, p: &IndicatorPoint| chart.x.at(p.x) + beside;
    let solid = Paint { dash: &[], ..Paint::line(paint.stroke, 1.4) };
    let clip = Some(chart.frame);
    let mut strokes: Vec<Vec<(f64, f64)>> = vec![vec![]];
    let (mut bars, mut crosses) = (vec![], vec![]);
    for p in &line.points {
        let x = at(chart, p);
        if !p.value.is_finite() {
            strokes.push(vec![]);
            let y = chart.frame.bottom;
            crosses.push(vec![(x - 4.0, y - 4.0), (x + 4.0, y + 4.0)]);
            crosses.push(vec![(x - 4.0, y + 4.0), (x + 4.0, y - 4.0)]);
            continue;
        }
        if let Some(stroke) = strokes.last_mut() {
            stroke.push((x, chart.y.at(p.value)));
        }
        if let Some((low, high)) = p.interval {
            let (low, high) = (chart.y.at(low), chart.y.at(high));
            bars.push(vec![(x, low), (x, high)]);
            bars.push(vec![(x - 3.5, low), (x + 3.5, low)]);
            bars.push(vec![(x - 3.5, high), (x + 3.5, high)]);
        }
    }
    chart.of(&line.label);
    let places = || line.points.iter().map(|p| p.x).collect();
    chart.keep("", places(), line.points.iter().map(|p| p.value).collect());
    if line.points.iter().any(|p| p.interval.is_some()) {
        for (end, pick) in [("low", 0), ("high", 1)] {
            let of = |p: &IndicatorPoint| p.interval.map_or(f64::NAN, |i| [i.0, i.1][pick]);
            let kind = format!("{end} end of the interval");
            chart.keep(&kind, places(), line.points.iter().map(of).collect());
        }
    }
    // Between names there is nothing.
    strokes.retain(|stroke| joined && stroke.len() > 1);
    let mut path = |lines: Vec<Vec<(f64, f64)>>, paint: Paint, clip| {
        if !lines.is_empty() {
            chart.picture.shapes.push(Shape::Path { lines, close: false, paint, clip });
        }
    };
    path(strokes, paint.faded(0.7), clip);
    path(bars, solid, clip);
    path(crosses, Paint::line(paint.stroke, 2.0), None);
    for p in line.points.iter().filter(|p| p.value.is_finite()) {
        let ring = p.interval.is_none();
        chart.picture.shapes.push(Shape::Circle {
            x: at(chart, p),
            y: chart.y.at(p.value),
            r: 3.4,
            paint: if ring {
                Paint::line(paint.stroke, 1.5).filled("#ffffff", 1.0)
            } else {
                Paint::fill(paint.stroke, 1.0)
            },
        });
    }
}
