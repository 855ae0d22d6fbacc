//! What rollers and rings tilt with, section 16.

use super::{Geometry, Inertia, Layout, Support};
use crate::lanes::Column;
use crate::scenario::Scenario;

/// A ring's tilting: SI, about the bearing's middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TiltingRing {
    /// J = m (R^2/2 + B^2/12), kg m^2.
    pub inertia: f64,
    /// I_p = m R^2 of the ring that turns, kg m^2; 0 of the other.
    pub polar_inertia: f64,
    /// k_t (N m/rad) and c_t (N m s/rad).
    pub support: Support,
}

/// Levers and inertias of what tilts.
#[derive(Debug, Clone, PartialEq)]
pub struct Tilt {
    /// Z_i of each row, m.
    pub rows: Vec<f64>,
    /// The same of each slot.
    pub levers: Column,
    /// J_r = m (3 r^2 + L^2)/12 of a roller, kg m^2.
    pub roller_inertia: f64,
    /// Inner ring.
    pub inner: TiltingRing,
    /// Outer ring.
    pub outer: TiltingRing,
    /// Z_F, m.
    pub load_offset: f64,
}

impl Tilt {
    pub(super) fn new(s: &Scenario, layout: &Layout, g: &Geometry, m: &Inertia) -> Self {
        let spacing = 1e-3 * s.bearing.row_spacing_mm;
        let lever = |row: usize| (row as f64 - 0.5 * (layout.rows as f64 - 1.0)) * spacing;
        let width = 1e-3 * s.bearing.width_mm;
        let inertia = |mass: f64, radius: f64| mass * (0.5 * radius * radius + width * width / 12.0);
        let support = |stiffness, damping| Support { stiffness, damping };
        Self {
            rows: (0..layout.rows).map(lever).collect(),
            levers: (0..layout.slots).map(|slot| lever(layout.row(slot))).collect(),
            roller_inertia: m.roller * (3.0 * g.roller_radius.powi(2) + g.roller_length.powi(2)) / 12.0,
            inner: TiltingRing {
                inertia: inertia(m.inner_ring, g.inner_radius),
                polar_inertia: m.inner_ring * g.inner_radius.powi(2),
                support: support(s.support.inner_tilt_stiffness_nm_per_rad, s.support.inner_tilt_damping_nms_per_rad),
            },
            outer: TiltingRing {
                inertia: inertia(m.outer_ring, g.outer_radius),
                polar_inertia: 0.0,
                support: support(s.support.outer_tilt_stiffness_nm_per_rad, s.support.outer_tilt_damping_nms_per_rad),
            },
            load_offset: 1e-3 * s.operation.load_offset_mm,
        }
    }
}
