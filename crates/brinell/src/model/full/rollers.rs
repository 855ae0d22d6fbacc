//! The rollers, a group of lanes at a time, in passes: how each contact moves and what may be on damage; the elementary
//! functions; damage; and forces, pockets and what the bodies feel. Padded slots never close a contact and never move.

use super::sums::{Sums, Turn};
use super::view::column;
use super::{contacts, exact, forces, waves};
use crate::defect::SIDES;
use crate::lanes::Lanes;
use crate::model::{Model, Workspace};

/// The rollers' accelerations, into `a`, and what they do to everything else.
#[inline(always)]
pub(super) fn rollers<L: Lanes, const TILT: bool>(
    model: &Model,
    (q, v): (&[f64], &[f64]),
    a: &mut [f64],
    turn: Turn,
    ws: &mut Workspace,
) -> Sums {
    for (broad_phase, directions) in model.broad_phase.iter().zip(&mut ws.directions) {
        broad_phase.turn(turn.angle, directions);
    }
    // A pass for each function that is a long chain of operations which wait for one another: with little in between,
    // the processor works on several groups at once.
    directions::<L::Pair>(model, q, ws);
    if model.exact {
        exact::motion::<L, TILT>(model, (q, v), turn, ws);
    } else {
        contacts::motion::<L, TILT>(model, (q, v), turn.speed, ws);
    }
    contacts::candidates::<L::Pair>(model, ws);
    waves::waviness(model, (q, turn.angle), ws);
    if let Some(slices) = &model.slices {
        contacts::slices::<L::Pair, TILT>(model, slices, ws);
    } else {
        contacts::functions::<L::Pair>(model, ws);
    }
    contacts::damage::<L::Pair, TILT>(model, q, turn.angle, ws);
    if model.exact {
        SIDES.into_iter().for_each(|side| waves::push(model, side, &mut ws.contacts[side as usize]));
        exact::forces::<L, TILT>(model, (q, v), a, turn, ws)
    } else {
        forces::forces::<L, TILT>(model, (q, v), a, turn.speed, ws)
    }
}

/// Sine and cosine of every orbit angle.
#[inline(always)]
fn directions<L: Lanes>(model: &Model, q: &[f64], ws: &mut Workspace) {
    let count = model.layout.slots / L::COUNT;
    let theta = column::<L>(q, 1, count);
    let sin = &mut L::groups_mut(&mut ws.sin)[..count];
    let cos = &mut L::groups_mut(&mut ws.cos)[..count];
    for group in 0..count {
        let (s, c) = L::new(theta[group]).sin_cos();
        sin[group] = s.array();
        cos[group] = c.array();
    }
}
