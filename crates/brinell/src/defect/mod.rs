//! Damage where it lies: which contact it meets, at which angle, and what it leaves of that contact (section 3).

mod shape;

pub use shape::{Profile, Shape};

use crate::contact::{Floor, Hertz, remaining_share};
use crate::scenario::{self, Surface};
use std::f64::consts::{PI, TAU};

/// Side of a roller: the raceway that it meets there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Side {
    /// Inner raceway.
    Inner,
    /// Outer raceway.
    Outer,
}

/// Both sides, in the order of arrays indexed by side.
pub const SIDES: [Side; 2] = [Side::Inner, Side::Outer];

/// An angle mapped to [-pi, pi).
#[inline]
pub fn wrap(angle: f64) -> f64 {
    angle - TAU * ((angle + PI) / TAU).floor()
}

/// Angles that decide where a roller stands over damage, rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Angles {
    /// theta_j.
    pub orbit: f64,
    /// phi_j.
    pub spin: f64,
    /// W_i.
    pub ring: f64,
}

/// One defect on its surface, SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Defect {
    /// Damaged surface; a roller counts from 0 here.
    pub surface: Surface,
    /// Row, from 0.
    pub row: usize,
    /// psi, rad.
    pub center: f64,
    /// h, m, where the shape has no depths of its own.
    pub depth: f64,
    /// Outline.
    pub shape: Shape,
    /// R of the surface, m.
    pub radius: f64,
    /// L of the roller, m.
    pub roller_length: f64,
}

impl Defect {
    /// From the scenario. `None` where a profile's lists do not fit.
    pub fn new(defect: &scenario::Defect, bearing: &scenario::Bearing) -> Option<Self> {
        let (surface, diameter) = match defect.on {
            Surface::OuterRaceway => (defect.on, bearing.outer_raceway_diameter_mm),
            Surface::InnerRaceway => (defect.on, bearing.inner_raceway_diameter_mm),
            Surface::Roller(k) => (
                Surface::Roller(k.checked_sub(1)?),
                bearing.roller_diameter_mm,
            ),
        };
        Some(Self {
            surface,
            row: defect.row.checked_sub(1)?,
            center: defect.center_deg.to_radians(),
            depth: 1e-6 * defect.depth_um,
            shape: Shape::new(&defect.shape)?,
            radius: 0.5e-3 * diameter,
            roller_length: 1e-3 * bearing.roller_length_mm,
        })
    }

    /// Whether the defect meets roller `roller` (from 0) of row `row` on `side` at all.
    pub fn meets(&self, row: usize, roller: usize, side: Side) -> bool {
        self.row == row
            && match self.surface {
                Surface::OuterRaceway => side == Side::Outer,
                Surface::InnerRaceway => side == Side::Inner,
                Surface::Roller(k) => k == roller,
            }
    }

    /// Local angle u of a roller on `side`, rad.
    #[inline]
    pub fn local_angle(&self, angles: &Angles, side: Side) -> f64 {
        let Angles { orbit, spin, ring } = *angles;
        wrap(match (self.surface, side) {
            (Surface::OuterRaceway, _) => orbit - self.center,
            (Surface::InnerRaceway, _) => orbit - self.center - ring,
            (Surface::Roller(_), Side::Outer) => orbit - spin - self.center,
            (Surface::Roller(_), Side::Inner) => orbit + PI - spin - self.center,
        })
    }

    /// What the damage leaves at the local angle u; `None` outside its arc.
    #[inline]
    pub fn floor(&self, u: f64) -> Option<Floor> {
        let s = u * self.radius;
        let (first, last) = self.shape.arc();
        if s < first || s > last {
            return None;
        }
        let damaged_length = self.shape.damaged_length(s).clamp(0.0, self.roller_length);
        Some(Floor {
            share: remaining_share(self.roller_length, damaged_length),
            depth: self.shape.own_depth(s).unwrap_or(self.depth),
            damaged_length,
        })
    }
}

/// The damage that one contact stands on, for the approach delta and its power `[delta]_+^n`: where several defects meet it, the one with the smallest elastic sum acts.
pub fn acting<'a>(
    defects: impl Iterator<Item = &'a Defect>,
    law: &Hertz,
    angles: &Angles,
    side: Side,
    delta: f64,
    power: f64,
) -> Option<(f64, Floor)> {
    defects
        .filter_map(|d| d.floor(d.local_angle(angles, side)))
        .map(|floor| (law.damaged_given(power, delta, &floor), floor))
        .reduce(|a, b| {
            // With no force on either (a gap, or both floors below), the shorter remaining length stands for the contact.
            if b.0 < a.0 || (b.0 == a.0 && b.1.share < a.1.share) {
                b
            } else {
                a
            }
        })
}

/// Elastic energy of a contact that stands on any of `defects`, J: the integral of the acting elastic sum up to delta.
pub fn energy<'a>(
    defects: impl Iterator<Item = &'a Defect> + Clone,
    law: &Hertz,
    angles: &Angles,
    side: Side,
    delta: f64,
) -> f64 {
    if delta <= 0.0 {
        return 0.0;
    }
    let mut floors = defects.filter_map(|d| d.floor(d.local_angle(angles, side)));
    let all = floors.clone();
    match (floors.next(), floors.next()) {
        (None, _) => law.energy(delta),
        (Some(floor), None) => law.damaged_energy(delta, &floor),
        _ => {
            // Overlapping damage: the acting defect may change on the way, so the work is integrated (midpoint rule).
            const CELLS: u32 = 64;
            let dx = delta / f64::from(CELLS);
            let force = |x: f64| {
                all.clone()
                    .map(|f| law.damaged(x, &f))
                    .fold(f64::INFINITY, f64::min)
            };
            (0..CELLS)
                .map(|k| force((f64::from(k) + 0.5) * dx) * dx)
                .sum()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_wrap_maps_to_a_half_open_turn() {
        assert_eq!(wrap(0.5), 0.5);
        assert!((wrap(TAU + 0.5) - 0.5).abs() < 1e-15);
        assert!((wrap(-7.0) - (TAU - 7.0)).abs() < 1e-15);
        assert_eq!(wrap(PI), -PI);
    }
}
