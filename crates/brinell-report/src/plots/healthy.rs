//! A run's curve with that of the healthy bearing behind it.

use crate::chart::Spec;
use crate::data::Along;
use crate::embedded::{Curve, Plot};
use crate::picture::{Paint, ink};

const CURVE: Paint = Paint::line(ink::BLUE, 1.2);
const HEALTHY: Paint = Paint::line(ink::FRAME, 1.2);

/// Values and, where it was run, the healthy bearing's behind them; `words` say why there is nothing, or are
/// empty.
pub(super) fn over_healthy<'a>(
    spec: Spec,
    id: &str,
    words: &'static str,
    along: Along,
    values: &'a [f64],
    healthy: &'a [f64],
) -> Plot<'a> {
    let curve = |name, values, paint| Curve { name, along: along.clone(), values, paint };
    let (curves, order) = match (words, healthy) {
        ("", []) => (vec![curve("", values, CURVE)], vec![]),
        ("", _) => (vec![curve("damaged", values, CURVE), curve("healthy", healthy, HEALTHY)], vec![1, 0]),
        _ => (vec![], vec![]),
    };
    let remark = if healthy.is_empty() { "" } else { "Grey: the same bearing without the damage" };
    Plot { order, words, ..Plot::new(Spec { remark: remark.into(), ..spec }, id, curves) }
}
