//! Positions of cage, inner ring and rollers over which a static load distribution is taken.

use crate::model::Model;
use crate::scenario::Surface;
use std::f64::consts::TAU;

/// Positions of the cage over one pitch, where nothing that is damaged turns: least and most.
const OVER_A_PITCH: [usize; 2] = [16, 256];
/// How many of them a defect's arc holds.
const OVER_A_DEFECT: f64 = 8.0;
/// Positions of a group where damage turns, and groups of them.
const ALL_AROUND: [usize; 2] = [64, 4];

/// Turns of the cage, the inner ring and the rollers, rad.
pub(super) struct Positions {
    pub(super) places: Vec<[f64; 3]>,
    /// Position k belongs to group k modulo this number, and each group covers all there are.
    pub(super) groups: usize,
}

impl Positions {
    pub(super) fn of(model: &Model) -> Self {
        let pitch = TAU / model.layout.rollers_per_row as f64;
        let any = |is: &dyn Fn(Surface) -> bool| model.defects.iter().any(|d| is(d.surface));
        let ring = any(&|surface| surface == Surface::InnerRaceway);
        let rollers = any(&|surface| matches!(surface, Surface::Roller(_)));
        if !ring && !rollers {
            return Self::over_a_pitch(model, pitch);
        }
        // What damage does not turn with need not turn; the rollers of a row are alike but for their own damage.
        let cage = if rollers { TAU } else { pitch };
        let reach = [cage, if ring { TAU } else { 0.0 }, if rollers { TAU } else { 0.0 }];
        let dimensions = 1 + usize::from(ring) + usize::from(rollers);
        // Roberts's sequence fills the cube of turns evenly; each group is moved by its own shift.
        let ratio: f64 = match dimensions {
            2 => 1.324_717_957_244_746,
            _ => 1.220_744_084_605_759_5,
        };
        let [count, groups] = ALL_AROUND;
        let places = (0..count * groups).map(|k| {
            let (group, k) = (k % groups, k / groups);
            let mut power = 0;
            reach.map(|reach| {
                if reach == 0.0 {
                    return 0.0;
                }
                power += 1;
                let shift = group as f64 / groups as f64 * f64::from(2 * power - 1);
                reach * (shift + k as f64 * ratio.powi(-power)).fract()
            })
        });
        Self { places: places.collect(), groups }
    }

    fn over_a_pitch(model: &Model, pitch: f64) -> Self {
        let arcs = model.defects.iter().map(|d| {
            let (first, last) = d.shape.arc();
            (last - first) / d.radius
        });
        let shortest = arcs.fold(pitch, f64::min);
        let [least, most] = OVER_A_PITCH;
        let count = (OVER_A_DEFECT * pitch / shortest).ceil() as usize;
        let count = count.clamp(least, most);
        let at = |k: usize| [pitch * k as f64 / count as f64, 0.0, 0.0];
        Self { places: (0..count).map(at).collect(), groups: 1 }
    }
}
