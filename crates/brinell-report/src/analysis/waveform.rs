//! The waveform of a measured signal: whole, and a stretch of it close up.

use super::AnalysisReport;
use super::curves::draw;
use crate::chart::{Domain, Spec};
use crate::data::Series;
use crate::embedded::KEPT;
use crate::layout::{Layout, time_unit};
use crate::picture::Picture;

/// The stretch that is shown close up, s, and how far from its middle samples are kept for zooming.
fn close_up(report: &AnalysisReport) -> (f64, f64, f64) {
    let spans = report.waveforms.iter().map(|s| s.dt_s * s.values.len() as f64);
    let shortest = spans.fold(f64::INFINITY, f64::min);
    let from = (0.5 * (shortest - report.close_up_s)).max(0.0);
    let finest = (report.waveforms.iter().map(|s| s.dt_s)).fold(f64::INFINITY, f64::min);
    (from, from + report.close_up_s.min(shortest), 0.5 * KEPT as f64 * finest)
}

/// Units a second of the close-up's axis, with their name.
pub(super) fn close_up_unit(report: &AnalysisReport) -> (&'static str, f64) {
    let (from, to, _) = close_up(report);
    time_unit(to - from)
}

/// Samples about the middle of each waveform: no more than the page keeps as they are.
pub(super) fn about_middle(report: &AnalysisReport) -> Vec<(f64, f64, &[f64])> {
    let (from, to, reach) = close_up(report);
    let (middle, scale) = (0.5 * (from + to), close_up_unit(report).1);
    (report.waveforms.iter())
        .map(|s| {
            let (dt, values) = (s.dt_s, &s.values);
            let bin = |t: f64| ((t / dt).max(0.0) as usize).min(values.len());
            let (first, end) = (bin(middle - reach), bin(middle + reach));
            (first as f64 * dt * scale, dt * scale, &values[first.min(end)..end])
        })
        .collect()
}

pub(super) fn close_up_domain(report: &AnalysisReport) -> Domain {
    let (from, to, _) = close_up(report);
    let shown = |s: &Series| -> Vec<f64> {
        let bin = |t: f64| ((t / s.dt_s).max(0.0) as usize).min(s.values.len());
        let end = bin(to);
        s.values[bin(from).min(end)..end].to_vec()
    };
    Domain::around(report.waveforms.iter().flat_map(shown))
}

fn waveform_spec(
    report: &AnalysisReport,
    layout: Layout,
    (name, height): (&str, f64),
    x: Domain,
    x_unit: &str,
    y: Domain,
) -> Spec {
    let first = report.waveforms.first().cloned().unwrap_or_default();
    Spec::new(
        name,
        format!("Waveform: {}", first.label),
        layout.size(height),
        (x, "Time", x_unit),
        (y, &first.label, &first.unit),
    )
}

pub(super) fn whole(report: &AnalysisReport, layout: Layout) -> Picture {
    let spans = report.waveforms.iter().map(|s| s.dt_s * s.values.len() as f64);
    let longest = spans.fold(0.0, f64::max);
    let (unit, scale) = time_unit(longest);
    let x = Domain::exact(0.0, longest * scale);
    let y = Domain::around(report.waveforms.iter().flat_map(|s| s.values.iter().copied()));
    let curves: Vec<(f64, f64, &[f64])> =
        (report.waveforms.iter()).map(|s| (0.0, s.dt_s * scale, &s.values[..])).collect();
    let spec = waveform_spec(report, layout, ("waveform", 200.0), x, unit, y);
    draw(report, spec, "", &curves, false, None)
}

pub(super) fn close(report: &AnalysisReport, layout: Layout) -> Picture {
    let (from, to, _) = close_up(report);
    let (unit, scale) = close_up_unit(report);
    let x = Domain::exact(from * scale, to * scale);
    let y = close_up_domain(report);
    let spec = waveform_spec(report, layout, ("close-up", 300.0), x, unit, y);
    draw(report, spec, "close-up", &about_middle(report), false, None)
}
