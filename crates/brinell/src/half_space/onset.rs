//! delta_0(s), at which bodies that do not deform begin to touch (section 19): where the deepest level of a table does not reach a floor,
//! delta_eff is delta - delta_0, as on a wide floor.

use super::geometry::Geometry;
use super::raster::Raster;

/// Places across the damage.
const ACROSS: u32 = 128;
/// Error that the steps along s may leave, m, and their number at most.
const SHARP: f64 = 20e-9;
const MOST: f64 = 2e4;

/// The damaged surface's highest places across, with the element's own shape, along s.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Onset {
    /// First and last s, m; beyond, the surface is healthy.
    ends: [f64; 2],
    step: f64,
    /// Least gap of each column of a contact whose middle lies there, m.
    least: Vec<f64>,
    /// R_x, m.
    radius: f64,
}

impl Onset {
    pub(super) fn new(geometry: &Geometry, raster: &Raster) -> Self {
        let reach = raster.reach();
        // Of a ball without end.
        let end = geometry.half_across(f64::INFINITY);
        let [low, high] = reach.z.map(|z| z.clamp(-end, end));
        let across = |z: f64| geometry.gap(0.0, [z, z]);
        // Beside the damage the nearest to the middle is the highest.
        let beside = [(-end, low), (high, end)].into_iter().filter(|(from, to)| from < to);
        let beside = beside.map(|(from, to)| across(0f64.clamp(from, to))).fold(f64::INFINITY, f64::min);
        let [first, last] = reach.s;
        let columns = ((last - first) / (2.0 * geometry.along * SHARP).sqrt()).ceil().clamp(1.0, MOST);
        let step = (last - first) / columns;
        let place = |k: u32| low + (high - low) * (f64::from(k) + 0.5) / f64::from(ACROSS);
        let places: Vec<[f64; 2]> = (0..ACROSS).map(|k| [place(k), across(place(k))]).collect();
        let least = (0..=columns as usize).map(|column| {
            let s = first + column as f64 * step;
            let within = places.iter().map(|[z, gap]| gap + raster.rounded(s, *z));
            within.fold(beside, f64::min)
        });
        Self { ends: [first, last], step, least: least.collect(), radius: geometry.along }
    }

    /// delta_0 of a contact whose middle lies at s, m.
    pub(super) fn at(&self, s: f64) -> f64 {
        let lifted = |x: f64| x * x / (2.0 * self.radius);
        let [first, last] = self.ends;
        let healthy = [(first - s).min(0.0), (last - s).max(0.0)].map(lifted);
        let columns = self.least.iter().enumerate();
        let damaged = columns.map(|(k, least)| least + lifted(first + k as f64 * self.step - s));
        damaged.fold(healthy[0].min(healthy[1]), f64::min)
    }
}
