//! The bearing in motion as numbers: what is where, frame after frame.

use crate::axial::AxialSection;
use brinell::scenario::Surface;

/// Evenly spaced instants of a bearing. Lengths in mm, angles in rad counter-clockwise from +X, forces in N.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// Of the first frame.
    pub t0_s: f64,
    /// From frame to frame.
    pub dt_s: f64,
    /// Of the inner raceway.
    pub inner_radius_mm: f64,
    /// Of the outer raceway.
    pub outer_radius_mm: f64,
    /// Of the circle on which the rollers go round.
    pub pitch_radius_mm: f64,
    /// Of a roller.
    pub roller_radius_mm: f64,
    /// Angle of the inner ring, a frame each.
    pub ring: Vec<f32>,
    /// The rows.
    pub rows: Vec<MotionRow>,
    /// Where the damage is.
    pub damage: Vec<MotionDamage>,
    /// The same instants from the side, where anything tilts.
    pub section: Option<AxialSection>,
}

/// One row; all but `pockets` frame after frame, a value for each roller.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MotionRow {
    /// "Row 1".
    pub title: String,
    /// Angle of each pocket in the cage.
    pub pockets: Vec<f32>,
    /// Angle of the cage, one a frame.
    pub cage: Vec<f32>,
    /// Where the rollers are.
    pub orbit: Vec<f32>,
    /// How far they have turned about themselves.
    pub spin: Vec<f32>,
    /// Force at the inner contact.
    pub inner_n: Vec<f32>,
    /// Force at the outer contact.
    pub outer_n: Vec<f32>,
}

/// Damage from an angle of its surface to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionDamage {
    /// From 0.
    pub row: usize,
    /// Of what.
    pub surface: Surface,
    /// Its ends.
    pub angle: [f64; 2],
}

impl Motion {
    /// Frames that every list holds.
    pub(crate) fn frames(&self) -> usize {
        let radii = [self.inner_radius_mm, self.outer_radius_mm, self.pitch_radius_mm, self.roller_radius_mm];
        let sound = radii.iter().all(|r| r.is_finite() && *r > 0.0 && *r < 1e6);
        let times = self.t0_s.is_finite() && self.dt_s.is_finite() && self.dt_s > 0.0;
        if !sound || !times || self.roller_radius_mm >= self.pitch_radius_mm {
            return 0;
        }
        let of = |row: &MotionRow| {
            let n = row.pockets.len().max(1);
            [&row.orbit, &row.spin, &row.inner_n, &row.outer_n]
                .map(|v| v.len() / n)
                .into_iter()
                .fold(row.cage.len(), usize::min)
        };
        self.rows.iter().map(of).fold(self.ring.len(), usize::min)
    }

    /// Largest contact force.
    pub(super) fn largest(&self) -> f64 {
        let forces = self.rows.iter().flat_map(|row| row.inner_n.iter().chain(&row.outer_n));
        let largest = forces.copied().filter(|f| f.is_finite()).fold(0.0f32, f32::max);
        f64::from(largest)
    }
}
