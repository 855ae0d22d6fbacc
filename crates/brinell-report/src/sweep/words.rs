//! What is said of the plots of a sweep.

use super::plot::{IndicatorLine, IndicatorPlot};
use crate::number::{raised, significant};

/// Smallest and largest value of the first plot, and where they are; and where its lines do not differ beyond scatter, that.
pub fn sweep_lead(plots: &[IndicatorPlot]) -> String {
    let Some(plot) = plots.first() else {
        return String::new();
    };
    let of_line = |line: &'_ IndicatorLine| {
        let points = line.points.iter().filter(|p| p.value.is_finite());
        points.map(|p| (p.value, p.x, line.label.clone())).collect::<Vec<_>>()
    };
    let all: Vec<(f64, f64, String)> = plot.lines.iter().flat_map(of_line).collect();
    let ends = (all.iter().min_by(|a, b| a.0.total_cmp(&b.0)), all.iter().max_by(|a, b| a.0.total_cmp(&b.0)));
    let (Some(least), Some(most)) = ends else {
        return String::new();
    };
    if all.len() < 2 {
        return String::new();
    }
    let alike = are_alike(&plot.lines);
    let described = |(value, x, line): &(f64, f64, String)| {
        let at = match plot.x_names.get(*x as usize) {
            Some(name) => name.clone(),
            None if plot.x_unit.is_empty() => significant(*x, 4),
            None => format!("{} {}", significant(*x, 4), raised(&plot.x_unit)),
        };
        let beside = match (plot.lines.len(), line.is_empty(), plot.legend.is_empty()) {
            _ if alike => String::new(),
            (2.., false, false) => format!(", {} = {line}", plot.legend),
            (2.., false, true) => format!(", {line}"),
            _ => String::new(),
        };
        let unit = raised(&plot.unit);
        format!("{} {unit} ({} = {at}{beside})", significant(*value, 3), plot.x_label)
    };
    let lines = match (alike, plot.legend.is_empty()) {
        (false, _) => String::new(),
        (true, true) => "; no difference beyond scatter between the lines".to_owned(),
        (true, false) => {
            let labels: Vec<&str> = plot.lines.iter().map(|line| &*line.label).collect();
            format!("; {} = {}: no difference beyond scatter", plot.legend, labels.join(", "))
        }
    };
    format!("{}: from {} to {}{lines}.", plot.label, described(least), described(most))
}

/// Whether, wherever several lines have a value, the 95 % intervals of all overlap.
fn are_alike(lines: &[IndicatorLine]) -> bool {
    let Some((first, others)) = lines.split_first() else { return false };
    let interval_at = |line: &IndicatorLine, x: f64| line.points.iter().find(|p| p.x == x).and_then(|p| p.interval);
    !others.is_empty()
        && !first.points.is_empty()
        && first.points.iter().all(|point| {
            let all: Option<Vec<(f64, f64)>> = lines.iter().map(|line| interval_at(line, point.x)).collect();
            all.is_some_and(|all| {
                let highest_low = all.iter().map(|i| i.0).fold(f64::NEG_INFINITY, f64::max);
                all.iter().all(|i| highest_low <= i.1)
            })
        })
}

/// What the marks of the plots mean, of those that are there.
pub fn sweep_legend(plots: &[IndicatorPlot]) -> String {
    if plots.is_empty() {
        return "No indicator was chosen, or no point has one.".into();
    }
    let lines = || plots.iter().flat_map(|plot| &plot.lines);
    let points = || lines().flat_map(|line| &line.points);
    let mut parts = Vec::new();
    if points().any(|p| p.interval.is_some()) {
        parts.push(
            "Dots: averages over whole revolutions, with their 95 % intervals, scatter only: levels depend on assumed values too \
             (`brinell run --spread`).",
        );
    }
    if points().any(|p| p.interval.is_none() && p.value.is_finite()) {
        parts.push("Rings: a value without an interval.");
    }
    if points().any(|p| !p.value.is_finite()) {
        parts.push("Crosses on the axis: no value.");
    }
    if plots.iter().any(|plot| plot.name.starts_with("envelope.")) {
        parts.push(
            "One line of an envelope spectrum says little of the size of damage: where entry and exit lie half a pass apart it vanishes, and its second \
             harmonic (`--plot envelope.bpfo_x2`) rises.",
        );
    }
    if plots.iter().any(|plot| plot.lines.len() > 1) {
        parts.push("Points are shifted a little sideways, so that their intervals do not overlap.");
    }
    parts.join(" ")
}
