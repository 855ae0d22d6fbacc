//! Why the solver could not go on: which body, which contact.

use crate::defect::SIDES;
use crate::error::Error;
use crate::machine::{Machine, Parts};
use crate::model::{Model, Workspace};
use crate::solver::StepError;

/// What the solver ran into, in words.
pub(super) fn explain(error: StepError, machine: &Machine, parts: &Parts) -> Error {
    let suspects = machine.bearings.iter().zip(&parts.each).map(|(seated, part)| suspect(&seated.model, &part.ws));
    let contact = suspects.max_by(|a, b| a.0.total_cmp(&b.0)).map_or(String::new(), |(_, words)| words);
    let body = |index: usize| body(machine, index);
    match error {
        StepError::NonFinite { t, index } => Error::NonFinite { t, body: body(index), contact },
        StepError::Vanished { t, index } => Error::StepVanished { t, body: body(index), contact },
    }
}

/// Body and coordinate of an entry of the state, in words.
pub(super) fn body(machine: &Machine, index: usize) -> String {
    machine.name(index % machine.dof())
}

/// The contact that is not finite, or else the one pressed hardest: its force, N, and in words.
fn suspect(model: &Model, ws: &Workspace) -> (f64, String) {
    let layout = &model.layout;
    let name =
        |slot: usize| format!("{} {} in row {}", model.element.word(), layout.roller(slot) + 1, layout.row(slot) + 1);
    let mut worst = (f64::NEG_INFINITY, String::from("no contact is closed"));
    for side in SIDES {
        let c = &ws.contacts[side as usize];
        for slot in 0..layout.rollers() {
            let force = c.force[slot];
            let size = if force.is_finite() { force } else { f64::INFINITY };
            if size > worst.0.max(0.0) {
                worst = (size, format!("{} contact of {} carries {force:.4e} N", side.word(), name(slot)));
            }
        }
    }
    for (slot, force) in ws.pocket_force[..layout.rollers()].iter().enumerate() {
        let size = if force.is_finite() { force.abs() } else { f64::INFINITY };
        if size > worst.0.max(0.0) {
            worst = (size, format!("the pocket of {} carries {size:.4e} N", name(slot)));
        }
    }
    worst
}
