//! Which class each run is of, or each machine where it has a history.

use super::plan::Plan;
use super::stream::{Secret, unit, word};

/// Where a run is in its plan.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub(super) class: u32,
    /// Its number among the runs of its class that the design spreads; [`APART`] where its labels are held out.
    pub(super) number: u32,
}

/// No place in the design.
pub(super) const APART: u32 = u32::MAX;

/// Classes in turn by their shares: after any number of runs each class has its share to within one run. So every file
/// of a data set holds all classes, and a longer plan begins with the runs of a shorter one (but for a Latin
/// hypercube).
///
/// A run whose labels are held out draws its class by the secret, and takes no turn: neither its own place nor the gaps
/// between the others tell what it is.
pub(super) fn places(plan: &Plan, secret: Option<&Secret>) -> Vec<Place> {
    let total: f64 = plan.classes.iter().map(|class| class.share).sum();
    let mut counts = vec![0_u32; plan.classes.len()];
    let mut open = 0;
    (0..plan.units() as u64)
        .map(|run| {
            if let Some(secret) = secret {
                let draw = |what: &str| unit(secret.bits(&[word(what), run]));
                if draw("held_out") < plan.held_out {
                    return Place { class: drawn_class(plan, draw("class") * total), number: APART };
                }
            }
            open += 1;
            let behind = |c: usize| plan.classes[c].share / total * f64::from(open) - f64::from(counts[c]);
            let next = (0..counts.len()).fold(0, |best, c| if behind(c) > behind(best) { c } else { best });
            counts[next] += 1;
            Place { class: next as u32, number: counts[next] - 1 }
        })
        .collect()
}

/// The class at `place` of all shares laid end to end.
fn drawn_class(plan: &Plan, mut place: f64) -> u32 {
    let mut last = 0;
    for (c, class) in plan.classes.iter().enumerate() {
        if class.share > 0.0 {
            last = c as u32;
            if place < class.share {
                break;
            }
        }
        place -= class.share;
    }
    last
}
