//! The curves of a plot: a signal's, and over it those of a second one.

use super::AnalysisReport;
use crate::chart::{Spec, range};
use crate::data::Along;
use crate::embedded::{Curve, Plot};
use crate::picture::{Paint, ink};

/// Of the signal and of what it is laid over: grey, as colours are those of the marks.
const PAINTS: [Paint; 2] = [Paint::line(ink::BLUE, 1.1), Paint::line(ink::FAINT, 1.1)];

/// A curve's first place, the distance of its places, and its values.
pub(super) type Values<'a> = (f64, f64, &'a [f64]);

/// The order in which curves are drawn: what reaches farther lies below, and hides nothing.
fn drawing_order(curves: &[Values], peak: bool) -> Vec<usize> {
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

/// A plot of all curves, with a legend where there are several; `id` is its name to the page's script, empty for a
/// still one.
pub(super) fn plot<'a>(
    report: &'a AnalysisReport,
    spec: Spec,
    id: &str,
    curves: Vec<Values<'a>>,
    peak: bool,
) -> Plot<'a> {
    let order = drawing_order(&curves, peak);
    let names = || report.names.iter().map(String::as_str);
    // What lies on top lets the rest shine through.
    let on_top = |index: usize| order.first() != Some(&index);
    let named = curves.iter().zip(names().chain(std::iter::repeat(""))).enumerate();
    let drawn = named.map(|(index, (&(first, step, values), name))| {
        let paint = PAINTS[index.min(1)];
        let paint = if on_top(index) { paint.faded(0.75) } else { paint };
        Curve { name, along: Along::Even { first, step }, values, paint }
    });
    let nothing = curves.iter().all(|c| range(c.2.iter().copied()).is_none());
    let drawn = drawn.collect();
    Plot {
        order,
        legend: if curves.len() > 1 { names().zip(PAINTS).collect() } else { Vec::new() },
        words: if nothing { "No samples" } else { "" },
        peak,
        ..Plot::new(spec, id, drawn)
    }
}
