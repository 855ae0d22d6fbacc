//! Levels and scores of several files, over their names.

use super::rows::{Each, Found, Row};
use brinell::signal::Estimate;
use brinell_report::{IndicatorLine, IndicatorPlot, IndicatorPoint, scaled};

/// Whether the files' names have room on the axis of a trend; else they are numbered.
fn named(rows: &[Row]) -> bool {
    const MOST: usize = 8;
    rows.len() <= MOST
}

/// A point for each file, named or numbered from 1.
fn line(rows: &[Row], label: &str, of: impl Fn(&Found) -> Option<Estimate>) -> IndicatorLine {
    let point = |(i, row): (usize, &Row)| {
        let e = row.found.as_ref().ok().and_then(&of);
        IndicatorPoint {
            x: if named(rows) { i } else { i + 1 } as f64,
            value: e.map_or(f64::NAN, |e| e.value),
            interval: e.and_then(|e| e.interval).map(|i| (i.low, i.high)),
        }
    };
    IndicatorLine { label: label.into(), points: rows.iter().enumerate().map(point).collect() }
}

/// Files may follow one another; channels stand side by side.
pub(super) fn plots(rows: &[Row], each: Each) -> Vec<IndicatorPlot> {
    let found = || rows.iter().filter_map(|r| r.found.as_ref().ok());
    let plot = |name: &str, label: &str, unit: &str, lines: Vec<IndicatorLine>| IndicatorPlot {
        name: format!("trend-{name}"),
        label: label.into(),
        unit: unit.into(),
        x_label: each.heading().into(),
        x_names: match named(rows) {
            true => rows.iter().map(|row| row.name.clone()).collect(),
            false => Vec::new(),
        },
        ordered: each == Each::File,
        lines,
        ..IndicatorPlot::default()
    };
    let other = |of: fn(&(String, f64, f64)) -> f64| -> Vec<(f64, String)> {
        let other = found().find_map(|f| f.other.as_ref()).map(|o| (of(o), "the other".to_owned()));
        other.filter(|o| o.0.is_finite()).into_iter().collect()
    };
    let mut plots = Vec::new();
    if let Some(first) = found().next() {
        // In the first one's unit, where that can be.
        let unit = &first.unit;
        let rms = line(rows, "RMS", |f| {
            let factor = f.unit.to_si / unit.to_si;
            let same = f.unit.name == unit.name || f.unit.quantity == unit.quantity;
            f.rms.filter(|_| same).map(|e| scaled(&e, factor))
        });
        plots.push(IndicatorPlot { limits: other(|o| o.1), ..plot("rms", "RMS", &unit.name, vec![rms]) });
    }
    let kurtosis = vec![line(rows, "Kurtosis", |f| f.kurtosis)];
    plots.push(IndicatorPlot { limits: other(|o| o.2), ..plot("kurtosis", "Kurtosis", "", kurtosis) });
    if found().any(|f| f.velocity.is_some()) {
        let lines = vec![line(rows, "RMS velocity", |f| f.velocity)];
        let class = found().find_map(|f| f.zone.and(f.class));
        let limits = class.iter().flat_map(|class| class.boundaries().into_iter().zip(["A/B", "B/C", "C/D"]));
        let limits = limits.map(|(limit, zones)| (limit, format!("{zones} {limit}"))).collect();
        plots.push(IndicatorPlot { limits, ..plot("velocity", "RMS velocity, 10 to 1000 Hz", "mm/s", lines) });
    }
    let mut families: Vec<&str> = Vec::new();
    for (name, _) in found().flat_map(|f| &f.scores) {
        if !families.contains(&name.as_str()) {
            families.push(name);
        }
    }
    let lines = families.into_iter().map(|name| {
        line(rows, name, |f| {
            let score = f.scores.iter().find(|(n, _)| n == name)?.1;
            Some(Estimate { value: score, interval: None })
        })
    });
    let most = |of: fn(&Found) -> f64| found().map(of).fold(0.0, f64::max);
    let limits = [(most(|f| f.noise), "noise"), (most(|f| f.high), "high")];
    let limits = limits.map(|(limit, words)| (limit, format!("{words} {limit:.1}"))).to_vec();
    if lines.len() == 0 {
        return plots;
    }
    plots.push(IndicatorPlot { limits, ..plot("score", "Detection score", "", lines.collect()) });
    plots
}
