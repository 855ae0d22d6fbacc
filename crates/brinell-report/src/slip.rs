//! Slip against pure rolling, over time and over the place in the bearing.

use crate::chart::{self, Chart, Domain, range};
use crate::layout::{Layout, legend, time_unit};
use crate::number::bin_centres;
use crate::picture::{Paint, Picture, ink};
use brinell::observe::slip_course::Slips;

/// Slip of one row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SlipRow {
    /// "row 1".
    pub name: String,
    /// Length of a stretch of time; the first begins at 0.
    pub dt_s: f64,
    /// Stretch by stretch.
    pub over_time: Slips,
    /// Over the rollers' place in the bearing, by equal bins of the orbit angle from +X on.
    pub over_angle: Slips,
}

const ROWS: [(&str, &[f64]); 4] =
    [(ink::BLUE, &[]), (ink::VERMILLION, &[6.0, 3.0]), (ink::GREEN, &[2.0, 2.0]), (ink::BLACK, &[9.0, 2.0, 2.0, 2.0])];

fn paint(row: usize) -> Paint {
    let (color, dash) = ROWS[row % ROWS.len()];
    Paint::line(color, 1.6).dashed(dash)
}

/// A curve's points.
type Curve = (Vec<f64>, Vec<f64>);

/// Swings across the picture that come closer than this are one blot, px.
const SWING: f64 = 8.0;
/// Means over this fraction of the picture represent such a curve.
const MEANS: usize = 60;
/// Of the shade behind them.
const SHADE: f64 = 0.28;

/// Whether a curve swings, over a quarter of its range and back, too often for the width (px).
fn crowded(curves: &[Curve], width: f64) -> bool {
    curves.iter().any(|(_, ys)| {
        let Some((lo, hi)) = range(ys.iter().copied()) else {
            return false;
        };
        let reach = 0.25 * (hi - lo);
        let (mut swings, mut up) = (0, true);
        let mut turned = lo;
        for y in ys.iter().copied().filter(|y| y.is_finite()) {
            if up {
                turned = turned.max(y);
            } else {
                turned = turned.min(y);
            }
            if (y - turned).abs() > reach {
                (swings, up, turned) = (swings + 1, !up, y);
            }
        }
        f64::from(swings) * SWING > width
    })
}

/// From smallest to largest in each of as many groups as can be told apart.
fn shade(chart: &mut Chart, (xs, ys): &Curve, paint: Paint) {
    let (Some(first), Some(second)) = (xs.first(), xs.get(1)) else {
        return;
    };
    let groups = ((chart.frame.width() / SWING) as usize).clamp(1, ys.len());
    let (low, high): (Vec<f64>, Vec<f64>) = (0..groups)
        .map(|k| &ys[k * ys.len() / groups..(k + 1) * ys.len() / groups])
        .map(|g| range(g.iter().copied()).unwrap_or((f64::NAN, f64::NAN)))
        .unzip();
    let dx = second - first;
    let group = dx * ys.len() as f64 / groups as f64;
    let fill = Paint::fill(paint.stroke, SHADE);
    chart.band(first - 0.5 * dx, group, &low, &high, fill);
}

/// Means of groups, at their middles.
fn means(xs: &[f64], ys: &[f64]) -> Curve {
    let group = ys.len().div_ceil(MEANS).max(1);
    let mean = |g: &[f64]| {
        let known = || g.iter().filter(|v| v.is_finite());
        known().sum::<f64>() / known().count() as f64
    };
    xs.chunks(group).zip(ys.chunks(group)).map(|(x, y)| (mean(x), mean(y))).unzip()
}

/// Panels over one another on one x axis, a curve a row in each.
fn panels(
    (name, title): (&str, &str),
    layout: Layout,
    axis: (&str, &str),
    rows: &[SlipRow],
    panels: &[(&str, Vec<Curve>)],
) -> Picture {
    let size = layout.size(0.0);
    let part = if layout.roomy() { 140.0 } else { 130.0 };
    let xs = panels.iter().flat_map(|p| &p.1).flat_map(|c| &c.0);
    let (lo, hi) = range(xs.copied()).unwrap_or((0.0, 1.0));
    let ys = panels.iter().map(|(label, curves)| {
        let values = curves.iter().flat_map(|c| &c.1).copied();
        (Domain::around(values), (*label).to_owned(), "%".to_owned())
    });
    let specs = chart::panels(size, part, (Domain::exact(lo, hi), axis.0, axis.1), ys);
    let left = specs.first().map_or(0.0, |spec| spec.left);
    let mut picture = Picture::new(name, title, size.width, 0.0);
    let any_close = panels.iter().any(|(_, curves)| crowded(curves, size.width - left));
    let names: Vec<String> = rows
        .iter()
        .map(|row| match any_close {
            true => format!("{}, mean", row.name),
            false => row.name.clone(),
        })
        .collect();
    let mut entries: Vec<(&str, Paint)> = names.iter().enumerate().map(|(k, name)| (name.as_str(), paint(k))).collect();
    if any_close {
        entries.push(("shade: smallest to largest", Paint::line(paint(0).stroke, 9.0).faded(SHADE)));
    }
    let mut top = legend(&mut picture, &entries, left, size.width, 2.0, size.font);
    for (spec, (_, curves)) in specs.into_iter().zip(panels) {
        let height = spec.size.height;
        let mut chart = Chart::new(spec);
        if range(curves.iter().flat_map(|c| &c.1).copied()).is_none() {
            chart.say("Not recorded");
        }
        let close = crowded(curves, chart.frame.width());
        for (row, curve) in curves.iter().enumerate().filter(|_| close) {
            chart.of(&rows[row].name);
            shade(&mut chart, curve, paint(row));
        }
        for (row, (xs, ys)) in curves.iter().enumerate() {
            chart.of(&rows[row].name);
            if close {
                chart.of(&format!("{} mean", rows[row].name));
                let (xs, ys) = means(xs, ys);
                chart.points(&xs, &ys, paint(row));
            } else {
                chart.points(xs, ys, paint(row));
            }
        }
        picture.place(chart.finish(), 0.0, top);
        top += height;
    }
    picture.height = top;
    picture
}

/// Cage, orbit and spin from the start of the run on.
pub fn slip_over_time(rows: &[SlipRow], layout: Layout) -> Picture {
    let middle = |row: &SlipRow, k: f64| 0.5 * row.dt_s + k * row.dt_s;
    let end = |row: &SlipRow| middle(row, row.over_time.cage.len() as f64);
    let last = range(rows.iter().map(end)).map_or(0.0, |r| r.1);
    let (unit, scale) = time_unit(last);
    let curves = |pick: fn(&Slips) -> &Vec<f64>| -> Vec<Curve> {
        let curve = |row: &SlipRow| {
            let percent = pick(&row.over_time).iter().map(|slip| 100.0 * slip).enumerate();
            percent.map(|(k, slip)| (middle(row, k as f64) * scale, slip)).unzip()
        };
        rows.iter().map(curve).collect()
    };
    panels(
        ("slip-time", "Slip over time"),
        layout,
        ("Time", unit),
        rows,
        &[
            ("Cage slip", curves(|s| &s.cage)),
            ("Rolling elements’ orbit slip", curves(|s| &s.orbit)),
            ("Rolling elements’ spin slip", curves(|s| &s.spin)),
        ],
    )
}

/// Orbit and spin over the place in the bearing.
pub(crate) fn slip_over_angle(rows: &[SlipRow], layout: Layout) -> Picture {
    let curves = |pick: fn(&Slips) -> &Vec<f64>| -> Vec<Curve> {
        let curve = |row: &SlipRow| {
            let slips = pick(&row.over_angle);
            // From -180° on, so that the +X direction, where load often is, lies in the middle.
            let angles = bin_centres(slips.len()).into_iter().map(|a| if a > 180.0 { a - 360.0 } else { a });
            let mut points: Vec<(f64, f64)> = angles.zip(slips.iter().map(|slip| 100.0 * slip)).collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            points.into_iter().unzip()
        };
        rows.iter().map(curve).collect()
    };
    panels(
        ("slip-angle", "Slip over the place in the bearing"),
        layout,
        ("Orbit angle of the rolling element", "°"),
        rows,
        &[("Rolling elements’ orbit slip", curves(|s| &s.orbit)), ("Rolling elements’ spin slip", curves(|s| &s.spin))],
    )
}

/// Whether there is anything to draw.
pub(crate) fn there_is(rows: &[SlipRow]) -> bool {
    rows.iter().any(|row| !row.over_time.orbit.is_empty())
}
