//! Damage on a 6205-2RS, and what an analysis calls.

use brinell_signal::analysis::{Analysis, Component};

/// Part, order of its impacts, and orders at which it turns through the load.
pub(crate) const CASES: [(Component, f64, f64); 3] =
    [(Component::OuterRace, 3.5848, 0.0), (Component::InnerRace, 5.4152, 1.0), (Component::Element, 4.7135, 0.39828)];

/// The part that leads.
pub(crate) fn first(analysis: &Analysis) -> Option<Component> {
    analysis.causes().next().map(|f| f.component)
}
