//! Which contacts may be on damage, found for a group of rollers at a time before any of it is looked up.

use super::Layout;
use crate::defect::{Defect, Side};
use crate::lanes::{Column, Lanes};
use crate::scenario::Surface;

/// A raceway's defect as seen from the bearing's centre.
#[derive(Debug, Clone, PartialEq)]
struct Window {
    /// Its middle, rad; on the inner ring at W_i = 0.
    middle: f64,
    /// Whether it turns with the inner ring.
    turns: bool,
    /// For each slot the cosine of half the angle that it takes up: a roller whose direction has a smaller component
    /// along the middle's is off it. More than any cosine for the slots of other rows.
    least: Column,
}

/// What of a model's damage can meet the contacts of one side.
#[derive(Debug, Clone, PartialEq)]
pub struct BroadPhase {
    /// Slots whose contact some defect can meet.
    pub slots: Vec<usize>,
    windows: Vec<Window>,
    /// 1 for the slots of rollers that are damaged themselves, whose angles are looked at one by one; empty where none
    /// is.
    rollers: Column,
}

/// Above any cosine.
const NEVER: f64 = 2.0;
/// Round-off of a cosine near 1, with room.
const SLACK: f64 = 1e-14;

impl BroadPhase {
    /// For the defects of one model.
    pub(super) fn new(layout: &Layout, defects: &[Defect], side: Side) -> Self {
        let met_by = |defect: &Defect| -> Vec<bool> {
            let (row, roller) = (|slot| layout.row(slot), |slot| layout.roller(slot));
            (0..layout.slots)
                .map(|slot| slot < layout.rollers() && defect.meets(row(slot), roller(slot), side))
                .collect()
        };
        let mut all = Self {
            slots: (0..layout.rollers())
                .filter(|&slot| {
                    let (row, roller) = (layout.row(slot), layout.roller(slot));
                    defects.iter().any(|d| d.meets(row, roller, side))
                })
                .collect(),
            windows: Vec::new(),
            rollers: Column::default(),
        };
        for defect in defects {
            let met = met_by(defect);
            if !met.contains(&true) {
                continue;
            }
            if let Surface::Roller(_) = defect.surface {
                if all.rollers.is_empty() {
                    all.rollers = Column::new(layout.slots, 0.0);
                }
                for (roller, _) in all.rollers.iter_mut().zip(&met).filter(|(_, met)| **met) {
                    *roller = 1.0;
                }
                continue;
            }
            let (first, last) = defect.window(side);
            let half = (0.5 * (last - first)).min(std::f64::consts::PI);
            let cos_half = half.cos() - SLACK;
            let least = |met: &bool| if *met { cos_half } else { NEVER };
            all.windows.push(Window {
                middle: defect.center + 0.5 * (first + last),
                turns: defect.surface == Surface::InnerRaceway,
                least: met.iter().map(least).collect(),
            });
        }
        all
    }

    /// (cos, sin) of each window's middle at W_i = 0.
    pub(super) fn directions(&self) -> Vec<[f64; 2]> {
        self.windows.iter().map(|w| [w.middle.cos(), w.middle.sin()]).collect()
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

    /// Lanes of each group that may be on damage, a bit each: never too few.
    #[inline(always)]
    pub(super) fn lanes<L: Lanes>(
        &self,
        (sin, cos): (&[L::Group], &[L::Group]),
        directions: &[[f64; 2]],
        candidates: &mut [u8],
    ) {
        let rollers = L::groups(&self.rollers);
        for (group, candidates) in candidates.iter_mut().enumerate() {
            let (sin, cos) = (L::new(sin[group]), L::new(cos[group]));
            *candidates = rollers.get(group).map_or(0, |rollers| L::new(*rollers).above(L::zero()));
            for (window, [x, y]) in self.windows.iter().zip(directions) {
                let along = cos.times_plus(L::splat(*x), sin * L::splat(*y));
                *candidates |= along.above(L::new(L::groups(&window.least)[group]));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Portable;
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
            [simulation]
            laws = "li2023"
        "#;
        let scenario = crate::document::read(text, &[]).unwrap().scenario;
        let model = Model::new(&scenario).unwrap();
        let l = &model.layout;
        let mut met = [0, 0];
        for step in 0..40_000 {
            let (turn, ring) = (1e-4 * f64::from(step), 3.7e-3 * f64::from(step));
            for side in crate::defect::SIDES {
                let broad_phase = &model.broad_phase[side as usize];
                let mut directions = broad_phase.directions();
                broad_phase.turn(ring, &mut directions);
                let theta = |slot: usize| model.pocket_angle[slot] + turn;
                let (sin, cos): (Vec<f64>, Vec<f64>) = (0..l.slots).map(|slot| theta(slot).sin_cos()).unzip();
                let mut candidates = vec![0; l.slots / Portable::COUNT];
                broad_phase.lanes::<Portable>(
                    (Portable::groups(&sin), Portable::groups(&cos)),
                    &directions,
                    &mut candidates,
                );
                for (group, lanes) in candidates.into_iter().enumerate() {
                    for lane in 0..Portable::COUNT {
                        let slot = group * Portable::COUNT + lane;
                        let angles = crate::defect::Angles { orbit: theta(slot), spin: 0.0, ring };
                        let damaged = slot < l.rollers()
                            && model
                                .defects_of(slot, side)
                                .iter()
                                .any(|d| d.floor(d.local_angle(&angles, side), side).is_some());
                        let bit = lanes & (1 << lane) != 0;
                        assert!(bit || !damaged, "slot {slot} at {turn} on {side:?}");
                        met[0] += u32::from(damaged);
                        met[1] += u32::from(bit);
                    }
                }
            }
        }
        assert!(met[0] > 1000, "the case has no damage under rollers");
        assert!(met[1] < met[0] + met[0] / 50 + 100, "{met:?}: too many to look at");
    }
}
