//! The state at t = 0, section 9 of the model.

use crate::model::Model;
use crate::scenario::Start;
use crate::statics::{self, NoBalance, Problem};

/// Displacement of both rings in x and y for the starts that are not in balance (the paper), m.
pub(crate) const INITIAL_OFFSET: f64 = 1e-6;

/// The initial state (positions, then rates).
///
/// # Errors
/// Where the start is `equilibrium` and there is none.
pub fn state(model: &Model) -> Result<Vec<f64>, NoBalance> {
    let l = &model.layout;
    let mut y = off_balance(model);
    if model.start == Start::Equilibrium {
        let balance = statics::solve(model, &Problem::at_start(model))?;
        if model.kind.moves_every_part() {
            y[l.r()..l.r() + l.rollers()].copy_from_slice(&balance.r[..l.rollers()]);
        }
        if let Some(tilted) = &balance.tilting {
            y[l.beta()..][..l.rollers()].copy_from_slice(&tilted.rollers[..l.rollers()]);
            y[l.inner_tilt()..][..2].copy_from_slice(&tilted.rings[0]);
            y[l.outer_tilt()..][..2].copy_from_slice(&tilted.rings[1]);
        }
        let outer = if model.outer_ring_is_fixed() { [0.0; 2] } else { balance.outer };
        y[l.inner()..l.inner() + 2].copy_from_slice(&balance.inner);
        y[l.outer()..l.outer() + 2].copy_from_slice(&outer);
    }
    Ok(y)
}

/// The same with both rings [`INITIAL_OFFSET`] off and no element pressed, whatever the start but for rest.
pub(crate) fn off_balance(model: &Model) -> Vec<f64> {
    let l = &model.layout;
    let dof = l.dof();
    let mut y = vec![0.0; 2 * dof];
    let full = model.kind.moves_every_part();
    if full {
        for slot in 0..l.rollers() {
            y[l.theta() + slot] = model.pocket_angle[slot];
        }
    }
    if full && model.start != Start::Rest {
        let w = model.rotation.at(0.0).0;
        let (orbit, spin) = (model.rolling_orbit_speed(w), model.rolling_spin_speed(w));
        for slot in 0..l.rollers() {
            y[dof + l.theta() + slot] = orbit;
            y[dof + l.phi() + slot] = spin;
        }
        for row in 0..l.rows {
            y[dof + l.cage(row) + 2] = orbit;
        }
    }
    y[l.inner()..l.inner() + 2].fill(INITIAL_OFFSET);
    y[l.outer()..l.outer() + 2].fill(if model.outer_ring_is_fixed() { 0.0 } else { INITIAL_OFFSET });
    y
}
