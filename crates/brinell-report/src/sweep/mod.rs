//! The page of a sweep: indicators with intervals against the key that varies, what failed, and the table of points.

mod heat;
mod plot;

use std::fmt::Write as _;

use crate::fact::Fact;
use crate::frame::{close, figure, lead, none, open, scenario, section, unit_html};
use crate::layout::Layout;
use crate::markup::escape;
use crate::number::significant;
use crate::picture::Picture;
use crate::tables::{Table, facts, failures, table};
pub use heat::HeatMap;
use heat::heat_map;
pub use plot::{IndicatorLine, IndicatorPlot, IndicatorPoint};
pub(crate) use plot::{embed, indicator_plot};

/// Everything that the page of a sweep shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SweepReport {
    /// The sweep's name.
    pub title: String,
    /// What varies.
    pub subtitle: String,
    /// The version of the program.
    pub version: String,
    /// Why points are missing, where some are.
    pub partial: Option<String>,
    /// Headline numbers.
    pub facts: Vec<Fact>,
    /// The plots.
    pub plots: Vec<IndicatorPlot>,
    /// The same as maps, where two keys make a grid.
    pub maps: Vec<HeatMap>,
    /// Point and reason of everything that failed.
    pub failures: Vec<(String, String)>,
    /// The points.
    pub table: Table,
    /// The scenario that the points vary.
    pub scenario_toml: String,
}

/// The page's pictures, for saving as files.
pub fn sweep_pictures(report: &SweepReport, layout: Layout) -> Vec<Picture> {
    let drawn = report.plots.iter().map(|p| indicator_plot(p, layout));
    let maps = report.maps.iter().filter_map(|map| heat_map(map, layout));
    layout.finished(drawn.chain(maps).collect())
}

/// The self-contained page.
pub fn sweep_html(report: &SweepReport) -> String {
    let mut page = open(
        &report.title,
        &report.subtitle,
        ("Simulated", &report.version),
        report.partial.as_deref().map(|why| ("This sweep is incomplete.", why)),
    );
    page.push_str("<main>\n");
    lead(&mut page, &extremes(&report.plots));
    facts(&mut page, &report.facts);
    if !report.maps.is_empty() {
        section(&mut page, "maps", "Over both keys", |page| {
            for (index, map) in report.maps.iter().enumerate() {
                let unit = match map.unit.is_empty() {
                    true => String::new(),
                    false => format!(" ({})", unit_html(&map.unit)),
                };
                let _ = writeln!(page, "<h3>{}{unit}</h3>", escape(&map.label));
                let empty = || Picture::new("", "", 0.0, 0.0);
                let draw = |layout| heat_map(map, layout).unwrap_or_else(empty);
                figure(page, &format!("map{index}"), draw, "");
            }
        });
    }
    section(&mut page, "indicators", "Indicators", |page| {
        if report.plots.is_empty() {
            none(page, "No indicator was chosen, or no point has one.");
        }
        none(page, &legend(&report.plots));
        for (index, plot) in report.plots.iter().enumerate() {
            let _ = writeln!(page, "<h3>{}</h3>", escape(&plot.label));
            let draw = |layout| indicator_plot(plot, layout);
            figure(page, &format!("plot{index}"), draw, "");
            embed(page, plot);
        }
    });
    if !report.failures.is_empty() {
        section(&mut page, "failures", "Points that failed", |page| failures(page, "Point", &report.failures));
    }
    table(&mut page, &report.table);
    scenario(&mut page, "Base scenario", &report.scenario_toml);
    let footer = "The whole table, with every indicator, is in sweep.csv and sweep.parquet beside this page.";
    close(page, footer, &[])
}

/// Smallest and largest value of the first plot, and where they are.
fn extremes(plots: &[IndicatorPlot]) -> String {
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
            None => significant(*x, 4),
        };
        let beside = match (plot.lines.len(), line.is_empty()) {
            (2.., false) => format!(", {line}"),
            _ => String::new(),
        };
        let unit = plot.unit.replace("^2", "²");
        format!("{} {unit} ({} = {at}{beside})", significant(*value, 3), plot.x_label)
    };
    format!("{}: from {} to {}.", plot.label, described(least), described(most))
}

/// What the marks mean, of those that are there.
fn legend(plots: &[IndicatorPlot]) -> String {
    let lines = || plots.iter().flat_map(|plot| &plot.lines);
    let points = || lines().flat_map(|line| &line.points);
    let mut parts = Vec::new();
    if points().any(|p| p.interval.is_some()) {
        parts.push("Dots: averages over whole revolutions, with their 95 % intervals.");
    }
    if points().any(|p| p.interval.is_none() && p.value.is_finite()) {
        parts.push("Rings: a value without an interval.");
    }
    if points().any(|p| !p.value.is_finite()) {
        parts.push("Crosses on the axis: no value.");
    }
    if plots.iter().any(|plot| plot.lines.len() > 1) {
        parts.push("Points are shifted a little sideways, so that their intervals do not overlap.");
    }
    parts.join(" ")
}
