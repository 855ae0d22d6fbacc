//! The raceway's own form under a scan, as it was found.

/// What a fit found. The form is subtracted along the depth, not along its normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FormReport {
    /// The rise of the surface along `s` at the grid's centre, um per mm.
    pub slope_s_um_per_mm: f64,
    /// The rise of the surface along `z`, um per mm.
    pub slope_z_um_per_mm: f64,
    /// The cylinder's radius: positive where the surface is hollow (an outer raceway), negative where it bulges.
    pub radius_mm: Option<f64>,
    /// The angle between the cylinder's axis and `z`, degrees.
    pub axis_turn_deg: f64,
    /// Root mean square of what remains on the undamaged points that were used, um.
    pub residual_rms_um: f64,
    /// Undamaged points used for the fit.
    pub used: usize,
    /// Points kept out of it: damage, as it lies apart from the surface.
    pub excluded: usize,
}
