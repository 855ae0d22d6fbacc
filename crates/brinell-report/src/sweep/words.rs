//! What is said of the plots of a sweep.

use super::plot::{IndicatorLine, IndicatorPlot};
use crate::number::{raised, significant};

/// Smallest and largest value of the first plot, and where they are.
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
    let described = |(value, x, line): &(f64, f64, String)| {
        let at = match plot.x_names.get(*x as usize) {
            Some(name) => name.clone(),
            None if plot.x_unit.is_empty() => significant(*x, 4),
            None => format!("{} {}", significant(*x, 4), raised(&plot.x_unit)),
        };
        let beside = match (plot.lines.len(), line.is_empty(), plot.legend.is_empty()) {
            (2.., false, false) => format!(", {} = {line}", plot.legend),
            (2.., false, true) => format!(", {line}"),
            _ => String::new(),
        };
        let unit = raised(&plot.unit);
        format!("{} {unit} ({} = {at}{beside})", significant(*value, 3), plot.x_label)
    };
    format!("{}: from {} to {}.", plot.label, described(least), described(most))
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
            "Dots: averages over whole revolutions, with their 95 % intervals, scatter only: levels hang on what is assumed too \
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
