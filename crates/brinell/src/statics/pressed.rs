//! A bearing between rings that are held.

use super::newton::State;

/// The rolling elements of a bearing alone, between rings that are held.
pub(crate) struct Pressed {
    /// Over the rings' coordinates.
    pub(crate) state: State<Vec<f64>, Vec<Vec<f64>>>,
    /// Radial offset of each slot's element, m.
    pub(crate) r: Vec<f64>,
    /// Tilt of each slot's roller, rad; empty where nothing tilts.
    pub(crate) beta: Vec<f64>,
}
