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
use crate::lanes::Lanes;
#[cfg(any(test, not(target_arch = "x86_64")))]
use crate::lanes::Portable;
#[cfg(target_arch = "x86_64")]
use crate::lanes::{Avx2, Avx512, Rounded};
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
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        Kernel::Portable => unsafe { with_rounded(model, t, y, a, ws) },
        #[cfg(not(target_arch = "x86_64"))]
        Kernel::Portable => equations::<Portable>(model, t, y, a, ws),
        _ => equations::<f64>(model, t, y, a, ws),
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

/// What the portable lanes compute, to the bit.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn with_rounded(model: &Model, t: f64, y: &[f64], a: &mut [f64], ws: &mut Workspace) {
    equations::<Rounded>(model, t, y, a, ws);
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

#[cfg(test)]
mod tests {
    /// The equations on AVX2's registers are those on the portable lanes, to the bit.
    #[test]
    #[cfg(target_arch = "x86_64")]
    fn prop_the_portable_kernel_has_the_same_bits_with_avx2() {
        use super::*;
        if !is_x86_feature_detected!("avx2") {
            return;
        }
        let damage = r#"
            bearing.waviness = { amplitude_um = 0.5, exponent = 1.5, waves = [2, 100] }
            [operation]
            speed_rpm = 1800
            load_n = [300, -900]
            [[defects]]
            on = "outer-raceway"
            center_deg = -70
            depth_um = 20
            shape = { rectangle = { length_mm = 3, width_mm = 4 } }
            [[defects]]
            on = "inner-raceway"
            center_deg = -90
            depth_um = 20
            shape = { circle = { diameter_mm = 3 } }
        "#;
        for (bearing, more) in
            [("NN3007", "laws = \"li2023\""), ("NU206", ""), ("NU206", "model = \"tilting\""), ("6205", "")]
        {
            let text =
                format!("bearing.preset = \"{bearing}\"\n{damage}\n[simulation]\nstart = \"equilibrium\"\n{more}\n");
            let scenario = crate::document::read(&text, &[]).unwrap().scenario;
            let model = Model::new(&scenario).unwrap();
            let dof = model.layout.dof();
            let start = crate::start::state(&model).unwrap();
            let (mut same, mut wide) =
                (Workspace::with_kernel(&model, Kernel::Portable), Workspace::with_kernel(&model, Kernel::Portable));
            let mut touched = 0;
            for step in 0..400 {
                let t = 1e-4 * f64::from(step);
                // Parts displaced by some um and mrad, each by its own way.
                let y: Vec<f64> = (start.iter().enumerate())
                    .map(|(k, y)| {
                        y + (if k < dof { 2e-6 } else { 1e-2 }) * (1.7 * k as f64 + 0.9 * f64::from(step)).sin()
                    })
                    .collect();
                let (mut a, mut b) = (vec![0.0; dof], vec![0.0; dof]);
                equations::<Portable>(&model, t, &y, &mut a, &mut same);
                // SAFETY: the processor has been asked.
                unsafe { with_rounded(&model, t, &y, &mut b, &mut wide) };
                touched += usize::from(same.contacts.iter().flat_map(|c| &c.elastic[..]).sum::<f64>() > 0.0);
                let bits = |list: &[f64]| list.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
                assert_eq!(bits(&a), bits(&b), "{bearing} {more} at {t}");
            }
            assert!(touched > 100, "{bearing} {more}: nothing is pressed");
        }
    }
}
