//! Which contacts may stand on damage, found for eight rollers at a time before any of it is looked up.

use super::Layout;
use crate::defect::{Defect, Side};
use crate::lanes::{Lanes, WIDTH};
use crate::scenario::Surface;

/// A raceway's defect as seen from the bearing's centre.
#[derive(Debug, Clone, PartialEq)]
struct Window {
    /// Its middle, rad; on the inner ring at W_i = 0.
    middle: f64,
    /// Cosine of half the angle that it takes up. Rollers whose direction has a smaller component along the middle's are off it.
    cos_half: f64,
    /// Whether it turns with the inner ring.
    turns: bool,
    /// The lanes of its row, a bit each, by group.
    lanes: Vec<u8>,
}

/// What of a model's damage can meet the contacts of one side.
#[derive(Debug, Clone, PartialEq)]
pub struct Exposure {
    /// Slots whose contact some defect can meet.
    pub slots: Vec<usize>,
    windows: Vec<Window>,
    /// Lanes of the rollers that are damaged themselves, by group; their angles are looked at one by one.
    rollers: Vec<u8>,
}

/// Round-off of a cosine near 1, with room.
const SLACK: f64 = 1e-14;

impl Exposure {
    /// For the defects of one model.
    pub(super) fn new(layout: &Layout, defects: &[Defect], side: Side) -> Self {
        let groups = layout.slots / WIDTH;
        let met_by = |defect: &Defect| {
            let mut lanes = vec![0_u8; groups];
            for slot in 0..layout.rollers() {
                if defect.meets(layout.row(slot), layout.roller(slot), side) {
                    lanes[slot / WIDTH] |= 1 << (slot % WIDTH);
                }
            }
            lanes
        };
        let mut all = Self {
            slots: (0..layout.rollers())
                .filter(|&slot| {
                    let (row, roller) = (layout.row(slot), layout.roller(slot));
                    defects.iter().any(|d| d.meets(row, roller, side))
                })
                .collect(),
            windows: Vec::new(),
            rollers: vec![0; groups],
        };
        for defect in defects {
            let lanes = met_by(defect);
            if lanes.iter().all(|l| *l == 0) {
                continue;
            }
            if let Surface::Roller(_) = defect.surface {
                for (sum, l) in all.rollers.iter_mut().zip(lanes) {
                    *sum |= l;
                }
                continue;
            }
            let (first, last) = defect.window(side);
            let half = (0.5 * (last - first)).min(std::f64::consts::PI);
            all.windows.push(Window {
                middle: defect.center + 0.5 * (first + last),
                cos_half: half.cos() - SLACK,
                turns: defect.surface == Surface::InnerRaceway,
                lanes,
            });
        }
        all
    }

    /// (cos, sin) of each window's middle at W_i = 0.
    pub(super) fn directions(&self) -> Vec<[f64; 2]> {
        self.windows
            .iter()
            .map(|w| [w.middle.cos(), w.middle.sin()])
            .collect()
    }

    /// Turns the directions of what sits on the inner ring to the angle W_i.
    #[inline]
    pub(super) fn turn(&self, ring_angle: f64, directions: &mut [[f64; 2]]) {
        for (window, direction) in self.windows.iter().zip(directions) {
            if window.turns {
                let (sin, cos) = (window.middle + ring_angle).sin_cos();
                *direction = [cos, sin];
            }
        }
    }

    /// Lanes of a group that may stand on damage, a bit each: never too few.
    #[inline(always)]
    pub(super) fn lanes<L: Lanes>(
        &self,
        group: usize,
        (sin, cos): (L, L),
        directions: &[[f64; 2]],
    ) -> u8 {
        let mut exposed = self.rollers[group];
        for (window, [x, y]) in self.windows.iter().zip(directions) {
            let along = cos.times_plus(L::splat(*x), sin * L::splat(*y));
            exposed |= along.above(L::splat(window.cos_half)) & window.lanes[group];
        }
        exposed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{Portable, sin_cos};
    use crate::model::Model;

    #[test]
    fn prop_no_contact_on_damage_is_missed() {
        let text = r#"
            [bearing]
            preset = "NN3007"
            [operation]
            speed_rpm = 1800
            load_n = [300, 0]
            [[defects]]
            on = "outer-raceway"
            row = 1
            center_deg = 179
            depth_um = 20
            shape = { rectangle = { length_mm = 0.01, width_mm = 4 } }
            [[defects]]
            on = "inner-raceway"
            row = 2
            center_deg = -33
            depth_um = 20
            shape = { circle = { diameter_mm = 4.5 } }
            [[defects]]
            on = "inner-raceway"
            row = 1
            center_deg = 90
            depth_um = 20
            shape = { rectangle = { length_mm = 90, width_mm = 4 } }
        "#;
        let scenario = crate::document::read(text, &[]).unwrap().scenario;
        let model = Model::new(&scenario).unwrap();
        let l = &model.layout;
        let mut met = [0, 0];
        for step in 0..40_000 {
            let (turn, ring) = (1e-4 * f64::from(step), 3.7e-3 * f64::from(step));
            for side in crate::defect::SIDES {
                let exposure = &model.exposure[side as usize];
                let mut directions = exposure.directions();
                exposure.turn(ring, &mut directions);
                for group in 0..l.slots / WIDTH {
                    let theta: [f64; WIDTH] =
                        std::array::from_fn(|lane| model.pocket_angle[group * WIDTH + lane] + turn);
                    let (sin, cos) = sin_cos(Portable::new(theta));
                    let lanes = exposure.lanes(group, (sin, cos), &directions);
                    for (lane, orbit) in theta.into_iter().enumerate() {
                        let slot = group * WIDTH + lane;
                        let angles = crate::defect::Angles {
                            orbit,
                            spin: 0.0,
                            ring,
                        };
                        let stands = slot < l.rollers()
                            && model
                                .defects_of(slot, side)
                                .any(|d| d.floor(d.local_angle(&angles, side), side).is_some());
                        let bit = lanes & (1 << lane) != 0;
                        assert!(bit || !stands, "slot {slot} at {orbit} on {side:?}");
                        met[0] += u32::from(stands);
                        met[1] += u32::from(bit);
                    }
                }
            }
        }
        assert!(met[0] > 1000, "the case has no damage under rollers");
        assert!(
            met[1] < met[0] + met[0] / 50 + 100,
            "{met:?}: too many to look at"
        );
    }
}
