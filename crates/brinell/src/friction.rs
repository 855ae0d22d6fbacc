//! Friction of rollers on raceways, Eqs. (33), (39), and the drag of rollers through the oil (section 7).

/// Regularised Coulomb friction: f = mu Q tanh(s / v_s).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// mu.
    pub coefficient: f64,
    /// v_s, m/s.
    pub slip_velocity: f64,
    /// k_r: rolling resistance (section 22).
    pub rolling: f64,
}

/// w_0, rad/s: the rolling over which rolling resistance reaches its size.
pub(crate) const ROLLING_SPEED: f64 = 5.0;

/// Drag coefficient area 0.5 C_d rho_f L d of one roller, kg/m: F_d = that times v_t |v_t|, against the orbit.
pub(crate) fn drag_factor(coefficient: f64, density: f64, length: f64, diameter: f64) -> f64 {
    0.5 * coefficient * density * length * diameter
}
