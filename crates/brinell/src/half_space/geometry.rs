//! The healthy gap under one contact: x along the rolling direction, z across from the row's middle, m.

use super::raster::Raster;
use crate::contact::ball::{Curvature, Ellipse};
use crate::defect::{Side, relative_radius};
use crate::scenario::{Bearing, Contact, Element, RollerProfile};
use crate::slices;
use crate::steel;

/// Bodies in contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    /// R_x of the two bodies, m.
    pub along: f64,
    /// How they fit across.
    pub across: Across,
    /// E* = E/(2 (1 - nu^2)), Pa.
    pub modulus: f64,
}

/// Bodies across the rolling direction.
#[derive(Debug, Clone, PartialEq)]
pub enum Across {
    /// A ball in a groove.
    Groove {
        /// R_y of the two bodies, m.
        radius: f64,
        /// The healthy contact's axis across over that along.
        kappa: f64,
        /// R_w, m: the half-axis across is sqrt(2 R_w delta).
        half_axis: f64,
    },
    /// A roller.
    Roller {
        /// L, m.
        length: f64,
        /// Drops p(z) (m) at equal steps from -L/2 to L/2, straight between; empty for a straight roller.
        drops: Vec<f64>,
    },
}

/// Least cells across damage that is narrower than the contact.
const CELLS_OVER_DAMAGE: f64 = 4.0;
/// The same under balls, over a class's rows: what a small pit takes of the force, a per cent or two, is all that shakes, so that 0.1 % of the
/// force is 5 % of a run's accelerations.
const CELLS_UNDER_BALLS: f64 = 0.45;
/// Rows of the coarser grid on one side at the most.
const MOST_ROWS: usize = 32;
/// The same under balls, over a class's rows.
const MOST_UNDER_BALLS: f64 = 1.3;

/// Steps of a roller's profile.
const PROFILE_STEPS: usize = 512;
/// z of a profile's ends over L/2: the logarithm has none at 1.
const PROFILE_END: f64 = 1.0 - 1e-3;

impl Geometry {
    /// One contact of a bearing. `None` where a ball does not touch its groove in an ellipse, or lacks a conformity.
    pub fn of_bearing(bearing: &Bearing, contact: &Contact, side: Side) -> Option<Self> {
        let modulus = 0.5 * contact.modulus().unwrap_or(steel::MODULUS);
        if bearing.element == Element::Roller {
            let (length, diameter) = (1e-3 * bearing.roller_length_mm, 1e-3 * bearing.roller_diameter_mm);
            let drops = match &bearing.profile {
                RollerProfile::Straight => Vec::new(),
                profile => (0..=PROFILE_STEPS)
                    .map(|k| {
                        let z = (k as f64 / PROFILE_STEPS as f64 - 0.5) * length * PROFILE_END;
                        slices::drop(profile, z, length, diameter)
                    })
                    .collect(),
            };
            let across = Across::Roller { length, drops };
            return Some(Self { along: relative_radius(bearing, side), across, modulus });
        }
        let (conformity, raceway) = match side {
            Side::Inner => (bearing.inner_groove_conformity?, bearing.inner_raceway_diameter_mm),
            Side::Outer => (bearing.outer_groove_conformity?, -bearing.outer_raceway_diameter_mm),
        };
        let of = Curvature::new(1e-3 * bearing.roller_diameter_mm, 1e-3 * raceway, conformity);
        let ellipse = Ellipse::new(of, 2.0 * modulus)?;
        let across = Across::Groove { radius: of.across, kappa: ellipse.kappa, half_axis: ellipse.across };
        Some(Self { along: of.along, across, modulus })
    }

    /// The same roller, tilted: the gap counts from its deepest end. `tilt` is the deformation's change along z.
    pub(super) fn tilted(&self, tilt: f64) -> Self {
        let mut of = self.clone();
        if let Across::Roller { length, drops } = &mut of.across
            && tilt != 0.0
        {
            if drops.len() < 2 {
                *drops = vec![0.0; 2];
            }
            let steps = (drops.len() - 1) as f64;
            for (k, drop) in drops.iter_mut().enumerate() {
                *drop += (0.5 * tilt.abs() - tilt * (k as f64 / steps - 0.5)) * *length;
            }
        }
        of
    }

    /// Half the width of the healthy contact along the rolling direction, m: exact of a ball, an estimate of a roller.
    pub fn half_width(&self, delta: f64) -> f64 {
        match &self.across {
            Across::Groove { kappa, half_axis, .. } => (2.0 * half_axis * delta).sqrt() / kappa,
            Across::Roller { length, .. } => {
                // delta = b^2/(4 R) (1 + 2 ln(L/b)), by iteration: the logarithm hardly moves.
                let mut half = (self.along * delta).sqrt();
                for _ in 0..20 {
                    half = (4.0 * self.along * delta / (1.0 + 2.0 * (length / half).ln().max(0.5))).sqrt();
                }
                half
            }
        }
    }

    /// Where bodies that do not deform would overlap, along the rolling direction, m.
    pub fn reach(&self, delta: f64) -> f64 {
        (2.0 * self.along * delta).sqrt()
    }

    /// Half the window across, m.
    pub(super) fn half_across(&self, delta: f64) -> f64 {
        match &self.across {
            Across::Groove { radius, .. } => (2.0 * radius * delta).sqrt(),
            Across::Roller { length, .. } => 0.5 * length,
        }
    }

    /// Whether gap and damage are alike on both sides of z = 0.
    pub(super) fn is_mirrored(&self, raster: &Raster) -> bool {
        let profile = match &self.across {
            Across::Groove { .. } => true,
            Across::Roller { drops, .. } => drops.iter().zip(drops.iter().rev()).all(|(a, b)| (a - b).abs() < 1e-12),
        };
        profile && raster.is_mirrored()
    }

    /// Rows of the coarser grid on one side of z = 0.
    pub(super) fn rows(&self, raster: &Raster, delta: f64, least: usize) -> usize {
        let [low, high] = raster.reach().z;
        let [mut cells, mut most] = [CELLS_OVER_DAMAGE, MOST_ROWS as f64];
        if let Across::Groove { .. } = self.across {
            cells = cells.max(CELLS_UNDER_BALLS * least as f64);
            most = most.max(MOST_UNDER_BALLS * least as f64);
        }
        let narrow = cells * self.half_across(delta) / (high - low).max(1e-9);
        (narrow.ceil() as usize).clamp(least / 2, (most as usize).max(least / 2))
    }

    /// Gap of the healthy contact at x, mean between two z, m; infinite off a roller.
    pub(super) fn gap(&self, x: f64, [low, high]: [f64; 2]) -> f64 {
        // Gauss's two points.
        let (middle, off) = (0.5 * (low + high), (high - low) / 12f64.sqrt());
        let mean = |of: &dyn Fn(f64) -> f64| 0.5 * (of(middle - off) + of(middle + off));
        let across = match &self.across {
            Across::Groove { radius, .. } => mean(&|z| z * z / (2.0 * radius)),
            Across::Roller { drops, length } if drops.len() > 1 => mean(&|z| {
                let place = (z / length + 0.5).clamp(0.0, 1.0) * (drops.len() - 1) as f64;
                let k = (place as usize).min(drops.len() - 2);
                drops[k] + (place - k as f64) * (drops[k + 1] - drops[k])
            }),
            Across::Roller { .. } => 0.0,
        };
        x * x / (2.0 * self.along) + across
    }
}
