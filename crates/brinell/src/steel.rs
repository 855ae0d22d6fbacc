//! Rolling bearing steel, of which elements and rings are where a scenario says nothing else.

/// Young's modulus, GPa (ISO/TS 16281).
pub(crate) const YOUNGS_MODULUS_GPA: f64 = 206.0;
/// Poisson's ratio.
pub(crate) const POISSONS_RATIO: f64 = 0.3;
/// E' = E/(1 - nu^2), Pa.
pub(crate) const MODULUS: f64 = 1e9 * YOUNGS_MODULUS_GPA / (1.0 - POISSONS_RATIO * POISSONS_RATIO);
/// Density, kg/mm^3.
pub(crate) const DENSITY: f64 = 7.85e-6;
/// Yield strength where it is hardened, Pa: an assumption.
pub(crate) const YIELD: f64 = 1.9e9;
