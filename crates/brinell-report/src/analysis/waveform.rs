//! The waveform of a measured signal: whole, and a stretch of it close up.

use super::AnalysisReport;
use super::curves::plot;
use crate::chart::{Domain, Size, Spec};
use crate::data::Series;
use crate::embedded::{KEPT, Plot};
use crate::layout::{Layout, time_unit};

/// The stretch that is shown close up, s, and how far from its middle samples are kept for zooming.
fn close_up(report: &AnalysisReport) -> (f64, f64, f64) {
    let spans = report.waveforms.iter().map(|s| s.dt_s * s.values.len() as f64);
    let shortest = spans.fold(f64::INFINITY, f64::min);
    let from = (0.5 * (shortest - report.close_up_s)).max(0.0);
    let finest = (report.waveforms.iter().map(|s| s.dt_s)).fold(f64::INFINITY, f64::min);
    (from, from + report.close_up_s.min(shortest), 0.5 * KEPT as f64 * finest)
}

/// From the place `t`, s, on: of a signal's values the first.
fn bin(s: &Series, t: f64) -> usize {
    ((t / s.dt_s).max(0.0) as usize).min(s.values.len())
}

fn spec(report: &AnalysisReport, (name, size): (&str, Size), x: Domain, x_unit: &str, y: Domain) -> Spec {
    let first = report.waveforms.first().cloned().unwrap_or_default();
    let title = format!("Waveform: {}", first.label);
    Spec::new(name, title, size, (x, "Time", x_unit), (y, &first.label, &first.unit))
}

pub(super) fn whole(report: &AnalysisReport, layout: Layout) -> Plot<'_> {
    let spans = report.waveforms.iter().map(|s| s.dt_s * s.values.len() as f64);
    let longest = spans.fold(0.0, f64::max);
    let (unit, scale) = time_unit(longest);
    let x = Domain::exact(0.0, longest * scale);
    let y = Domain::around(report.waveforms.iter().flat_map(|s| s.values.iter().copied()));
    let curves = report.waveforms.iter().map(|s| (0.0, s.dt_s * scale, &s.values[..]));
    plot(report, spec(report, ("waveform", layout.size(200.0)), x, unit, y), "", curves.collect(), false)
}

pub(super) fn close(report: &AnalysisReport, layout: Layout) -> Plot<'_> {
    close_of_size(report, layout.size(300.0))
}

/// About the middle, with no more samples of each waveform than the page keeps as they are.
pub(crate) fn close_of_size(report: &AnalysisReport, size: Size) -> Plot<'_> {
    let (from, to, reach) = close_up(report);
    let (unit, scale) = time_unit(to - from);
    let x = Domain::exact(from * scale, to * scale);
    let shown = |s: &Series, from: f64, to: f64| {
        let end = bin(s, to);
        bin(s, from).min(end)..end
    };
    let y = Domain::around(report.waveforms.iter().flat_map(|s| s.values[shown(s, from, to)].iter().copied()));
    let middle = 0.5 * (from + to);
    let curves = report.waveforms.iter().map(|s| {
        let first = bin(s, middle - reach) as f64 * s.dt_s * scale;
        (first, s.dt_s * scale, &s.values[shown(s, middle - reach, middle + reach)])
    });
    let spec = spec(report, ("close-up", size), x, unit, y);
    Plot { called: ["", "Signal"], ..plot(report, spec, "close-up", curves.collect(), false) }
}
