//! Geometry, masses and supports, SI.

/// Stiffness and damping of a ring's support, isotropic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// N/m.
    pub stiffness: f64,
    /// N s/m.
    pub damping: f64,
}

/// Geometry, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Geometry {
    /// R_i, m.
    pub inner_radius: f64,
    /// R_o, m.
    pub outer_radius: f64,
    /// R_m, m.
    pub pitch_radius: f64,
    /// r, m.
    pub roller_radius: f64,
    /// L, m; of a ball its diameter.
    pub roller_length: f64,
    /// C_r, m, on one side, at the inner contact.
    pub clearance: f64,
    /// Gap at the outer contact, m.
    pub outer_gap: f64,
}

/// Masses (kg) and moments of inertia (kg m^2).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inertia {
    /// m_i.
    pub inner_ring: f64,
    /// m_o.
    pub outer_ring: f64,
    /// m.
    pub roller: f64,
    /// I_r = m r^2 / 2; of a ball 2/5 m r^2.
    pub roller_spin: f64,
    /// m_c.
    pub cage: f64,
    /// I_c = m_c (a^2 + b^2) / 2.
    pub cage_spin: f64,
}
