//! Why the solver could not go on: which body, which contact.

use crate::defect::SIDES;
use crate::error::Error;
use crate::model::{Layout, Workspace};
use crate::solver::StepError;

/// What the solver ran into, in words.
pub(super) fn explain(error: StepError, l: &Layout, ws: &Workspace) -> Error {
    let contact = suspect(l, ws);
    match error {
        StepError::NonFinite { t, index } => Error::NonFinite { t, body: l.name(index % l.dof()), contact },
        StepError::Vanished { t, index } => Error::StepVanished { t, body: l.name(index % l.dof()), contact },
    }
}

/// The contact that is not finite, or else the one pressed hardest, in words.
fn suspect(layout: &Layout, ws: &Workspace) -> String {
    let mut worst = (f64::NEG_INFINITY, String::from("no contact is closed"));
    for side in SIDES {
        let c = &ws.contacts[side as usize];
        for slot in 0..layout.rollers() {
            let force = c.force[slot];
            let size = if force.is_finite() { force } else { f64::INFINITY };
            if size > worst.0.max(0.0) {
                let (roller, row) = (layout.roller(slot) + 1, layout.row(slot) + 1);
                let side = side.word();
                worst = (size, format!("{side} contact of roller {roller} in row {row} carries {force:.4e} N"));
            }
        }
    }
    for (slot, force) in ws.pocket_force[..layout.rollers()].iter().enumerate() {
        let size = if force.is_finite() { force.abs() } else { f64::INFINITY };
        if size > worst.0.max(0.0) {
            let (roller, row) = (layout.roller(slot) + 1, layout.row(slot) + 1);
            worst = (size, format!("the pocket of roller {roller} in row {row} carries {size:.4e} N"));
        }
    }
    worst.1
}
