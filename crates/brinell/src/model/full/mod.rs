//! The equations of motion of every part, section 8 of the model: Eqs. (28), (35), (41), (51).
//!
//! Levers are those of displaced rings (section 18, [`exact`]), or of the centred bearing, as in the paper; the energy that
//! these leave over is booked as [`Power::lever`]. All is written once, over lanes: as many rollers at a time as the kernel has, or one.

mod bodies;
mod contacts;
pub(super) mod exact;
mod forces;
mod pockets;
mod rollers;
mod sums;
mod view;
mod waves;

use super::{Kernel, Model, Workspace};
use crate::defect::Side;
#[cfg(target_arch = "x86_64")]
use crate::lanes::{Avx2, Avx512};
use crate::lanes::{Lanes, Portable};
use sums::Turn;

/// Accelerations at (t, y), compiled for the instructions that the workspace's kernel names.
pub(super) fn accelerations(model: &Model, t: f64, y: &[f64], a: &mut [f64], ws: &mut Workspace) {
    match ws.kernel() {
        #[cfg(target_arch = "x86_64")]
        // SAFETY: a workspace holds a kernel only where the processor has its instructions.
        Kernel::Avx512 => unsafe { with_avx512(model, t, y, a, ws) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        Kernel::Avx2 => unsafe { with_avx2(model, t, y, a, ws) },
        Kernel::Plain => equations::<f64>(model, t, y, a, ws),
        _ => equations::<Portable>(model, t, y, a, ws),
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
fn with_avx512(model: &Model, t: f64, y: &[f64], a: &mut [f64], ws: &mut Workspace) {
    equations::<Avx512>(model, t, y, a, ws);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn with_avx2(model: &Model, t: f64, y: &[f64], a: &mut [f64], ws: &mut Workspace) {
    equations::<Avx2>(model, t, y, a, ws);
}

/// Accelerations at (t, y).
#[inline(always)]
pub(super) fn equations<L: Lanes>(model: &Model, t: f64, y: &[f64], a: &mut [f64], ws: &mut Workspace) {
    let dof = model.layout.dof();
    let (q, v) = y.split_at(dof);
    let (speed, angle) = model.rotation.at(t);
    let turn = Turn { speed, angle };
    bodies::guidance(model, (q, v), speed, ws);
    let mut sums = if model.tilt.is_some() {
        rollers::rollers::<L, true>(model, (q, v), a, turn, ws)
    } else {
        rollers::rollers::<L, false>(model, (q, v), a, turn, ws)
    };
    let ring_speed = if model.land_on() == Side::Inner { speed } else { 0.0 };
    bodies::cages(model, (q, v), (a, ring_speed), &ws.guidance, &mut sums);
    bodies::rings(model, t, (q, v), a, &mut sums);
    if let Some(tilt) = &model.tilt {
        bodies::tilting_rings(model, tilt, (t, speed), (q, v), a, &mut sums);
    }
    if !model.custom.forces.is_empty() {
        bodies::further(model, (t, turn), (q, v), a, ws, &mut sums.power);
    }
    ws.torques = sums.torques;
    ws.power = sums.power;
}
