//! What an engineer would ask of rows, load and slices where rings and rollers tilt or have a profile.

use super::warning::{short, warning};
use crate::document::{Problem, toml_float};
use crate::lamina::FEWEST_SLICES;
use crate::model::Model;
use crate::scenario::{ModelKind, Scenario};

pub(super) fn warnings(scenario: &Scenario, model: &Model) -> Vec<Problem> {
    let tilting = scenario.simulation.model == ModelKind::Tilting;
    let mut all = Vec::new();
    if tilting {
        all.extend(rows_meet(scenario));
        all.extend(load_beside_the_bearing(scenario));
    }
    if tilting || model.profiled().is_some() {
        all.extend(few_slices(scenario));
    }
    all
}

/// Rows whose rollers overlap, or do not fit between the bearing's faces.
fn rows_meet(scenario: &Scenario) -> Option<Problem> {
    let b = &scenario.bearing;
    let (spacing, length) = (b.row_spacing_mm, b.roller_length_mm);
    let (reach, faces) = ((b.rows - 1) as f64 * spacing + length, b.width_mm);
    let (key, value, message, allowed) = if b.rows > 1 && spacing < length {
        (
            "bearing.row_spacing_mm",
            spacing,
            format!("rollers {} mm long overlap with those of the next row", short(length)),
            format!(">= {}", short(length)),
        )
    } else if reach > faces {
        (
            "bearing.width_mm",
            faces,
            format!("rollers reach over {} mm along the axis, beyond the bearing's faces", short(reach)),
            format!(">= {}", short(reach)),
        )
    } else {
        return None;
    };
    Some(warning(key, toml_float(value), message, allowed))
}

fn load_beside_the_bearing(scenario: &Scenario) -> Option<Problem> {
    let (offset, half) = (scenario.operation.load_offset_mm, 0.5 * scenario.bearing.width_mm);
    (offset.abs() > half).then(|| {
        warning(
            "operation.load_offset_mm",
            toml_float(offset),
            "the load acts beyond the bearing's faces: check the tilt supports, as this offset load is mostly a moment"
                .into(),
            format!("{} to {}", short(-half), short(half)),
        )
    })
}

/// Fewer than ISO/TS 16281 asks for: the load along a roller turns with the tilt, and is zero at a profile's ends.
fn few_slices(scenario: &Scenario) -> Option<Problem> {
    let slices = scenario.contact.slices;
    (slices < FEWEST_SLICES).then(|| {
        warning(
            "contact.slices",
            slices.to_string(),
            "few slices for a load that changes along the roller: its moment, and beside damage the acceleration, depend on their number".into(),
            format!(">= {FEWEST_SLICES}, as ISO/TS 16281"),
        )
    })
}
