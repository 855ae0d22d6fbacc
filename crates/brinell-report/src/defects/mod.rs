//! Damage as it is seen before it is simulated: extents, outlines, contact conditions during roller passage, pressures, the
//! ring's section.

mod along;
mod curves;
mod measures;
mod passage;
mod pressures;
mod seen;

pub(crate) use along::along_roller;
use brinell::derived::defect_passes;
use brinell::model::{Model, ModelError};
use brinell::plausibility::observed;
use brinell::scenario::Scenario;
use brinell::statics::static_load_zone;
pub use measures::Measures;
pub use seen::Damage;
use seen::Seen;

/// Every defect of a scenario in which [`Scenario::problems`] finds no error; `thickness_mm` is the ring's, 0.6 of the
/// roller's diameter where nobody states it.
///
/// # Errors
/// Where the scenario makes no model.
pub fn damage_of(s: &Scenario, thickness_mm: Option<f64>) -> Result<Vec<Damage>, ModelError> {
    if s.defects.is_empty() {
        return Ok(Vec::new());
    }
    // In a machine under the load that it carries there.
    let s = &observed(s);
    let model = Model::new(s)?;
    let healthy = Model::new(&Scenario { defects: Vec::new(), ..s.clone() })?;
    let passes = defect_passes(&model);
    let statics = static_load_zone(&healthy).ok();
    let seen =
        (0..model.defects.len()).map(|k| Seen::of((s, &model, k), passes[k], statics.as_ref(), thickness_mm).damage());
    Ok(seen.collect())
}
