//! The curves of a plot: a signal's, and over it those of a second one.

use super::AnalysisReport;
use crate::chart::{Chart, Spec, range};
use crate::data::Along;
use crate::embedded::{self, Curve};
use crate::layout::legend;
use crate::picture::{Paint, Picture, ink};

/// Of the signal and of what it is laid over: grey, as colours are those of the marks.
fn paints() -> [Paint; 2] {
    [Paint::line(ink::BLUE, 1.1), Paint::line(ink::FAINT, 1.1)]
}

/// The order in which curves are drawn: what reaches farther lies below, and hides nothing.
fn drawing_order(curves: &[(f64, f64, &[f64])], peak: bool) -> Vec<usize> {
    let mut order: Vec<usize> = (0..curves.len()).collect();
    if !peak {
        let size = |i: &usize| {
            let finite = curves[*i].2.iter().filter(|v| v.is_finite());
            finite.fold(0.0, |m: f64, v| m.max(v.abs()))
        };
        order.sort_by(|a, b| size(b).total_cmp(&size(a)));
    }
    order
}

/// A plot of all curves, with a legend where there are several; `plot` is its name to the page's script, empty for a
/// still one.
pub(super) fn draw(
    report: &AnalysisReport,
    spec: Spec,
    plot: &str,
    curves: &[(f64, f64, &[f64])],
    peak: bool,
    highlight: Option<(f64, f64)>,
) -> Picture {
    let size = spec.size;
    let mut chart = Chart::new(spec);
    if curves.iter().all(|c| range(c.2.iter().copied()).is_none()) {
        chart.say("No samples");
    }
    if let Some((lo, hi)) = highlight {
        chart.highlight(lo, hi);
    }
    // What lies on top lets the rest shine through.
    for (above, index) in drawing_order(curves, peak).into_iter().enumerate() {
        let (x0, dx, values) = curves[index];
        let paint = paints()[index.min(1)];
        let paint = if above > 0 { paint.faded(0.75) } else { paint };
        if curves.len() > 1 {
            chart.of(&report.names[index.min(1)]);
        }
        chart.curve(x0, dx, values, peak, paint);
    }
    let entries: Vec<(&str, Paint)> =
        (report.names.iter().zip(paints())).map(|(name, paint)| (name.as_str(), paint)).collect();
    chart.under(plot, |picture| match curves.len() {
        0 | 1 => 0.0,
        _ => legend(picture, &entries, 12.0, size.width - 12.0, 2.0, size.font),
    })
}

/// Writes what the page's script needs of a plot drawn by [`draw`]: `chart` without its curves.
pub(super) fn embed(page: &mut String, names: &[String], curves: &[(f64, f64, &[f64])], chart: embedded::Chart) {
    let order = drawing_order(curves, chart.peak);
    let drawn: Vec<usize> = (0..curves.len()).filter_map(|i| order.iter().position(|o| *o == i)).collect();
    let named = names.iter().map(String::as_str).chain(std::iter::repeat(""));
    let curves: Vec<Curve> = (curves.iter().zip(named))
        .map(|((x0, dx, values), name)| Curve { name, along: Along::Even { first: *x0, step: *dx }, values })
        .collect();
    embedded::Chart { curves: &curves, drawn: &drawn, ..chart }.write(page);
}
