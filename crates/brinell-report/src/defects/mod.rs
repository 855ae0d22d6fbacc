//! Damage as it is seen before it is simulated: extents, outlines, what a roller meets, the ring's section.

mod along;
mod curves;
mod measures;
mod passage;
mod seen;

use crate::DamageView;
pub(crate) use along::along_healthy_roller;
use brinell::defect::{Shape, wrap};
use brinell::derived::defect_passes;
use brinell::lamina::AtRest;
use brinell::model::{Model, ModelError};
use brinell::scenario::{self, Scenario};
use brinell::statics::static_load_zone;
use brinell_damage::plan::{CORNERS, polygons_mm};
pub use measures::Measures;
use seen::Seen;

/// Thickness of a ring that nobody stated, over the roller's diameter.
const THICKNESS_SHARE: f64 = 0.6;
/// Approach where no static balance gives one, m.
const FALLBACK_APPROACH: f64 = 10e-6;

/// One defect with its pictures' data.
#[derive(Debug, Clone)]
pub struct Damage {
    /// Its numbers.
    pub measures: Measures,
    /// What its pictures show.
    pub view: DamageView,
}

/// Every defect of a scenario; `thickness_mm` is the ring's, 0.6 of the roller's diameter where nobody states it.
///
/// # Errors
/// Where the scenario makes no model.
pub fn damage_of(s: &Scenario, thickness_mm: Option<f64>) -> Result<Vec<Damage>, ModelError> {
    if s.defects.is_empty() {
        return Ok(Vec::new());
    }
    let model = Model::new(s)?;
    let healthy = Model::new(&Scenario {
        defects: Vec::new(),
        ..s.clone()
    })?;
    let passes = defect_passes(&model);
    let statics = static_load_zone(&healthy).ok();
    let at_rest = AtRest::of(s).ok().flatten();
    let seen = (0..model.defects.len()).map(|k| {
        Seen::of((s, &model, k), passes[k], statics.as_ref(), thickness_mm).damage(at_rest.as_ref())
    });
    Ok(seen.collect())
}

/// Width of the ring whose section is taken, m: a roller's length, or of a ball bearing its own.
fn ring_width(s: &Scenario) -> f64 {
    let b = &s.bearing;
    match b.has_balls() {
        true => 1e-3 * b.width_mm,
        false => 1e-3 * b.roller_length_mm,
    }
}

/// The damage seen from above where it lies, mm.
fn in_place(of: &scenario::Defect, shape: &Shape) -> Vec<Vec<[f64; 2]>> {
    let mut polygons = polygons_mm(of, shape, CORNERS);
    // An outline has been moved already.
    if !matches!(shape, Shape::Outline(_)) {
        for point in polygons.iter_mut().flatten() {
            point[1] += of.axial_offset_mm;
        }
    }
    polygons
}

/// First and last angle of the rollers of a row that the inner raceway loads, rad.
fn ends(points: &[(usize, f64, f64, f64)], shift: [f64; 2], row: usize) -> Option<[f64; 2]> {
    let middle = shift[1].atan2(shift[0]);
    let loaded = points.iter().filter(|p| p.0 == row && p.2 > 0.0);
    let (first, last) = loaded
        .map(|p| wrap(p.1 - middle))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| {
            (a.min(x), b.max(x))
        });
    (last > first).then_some([middle + first, middle + last])
}
