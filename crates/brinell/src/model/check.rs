//! What a model refuses of a scenario that was not checked as a file: the commonest values that it would divide by zero or
//! index out of range with. Everything else is [`Scenario::problems`]', which `brinell::simulate` asks first.

use crate::scenario::{Law, ModelKind, Scenario, Surface};

/// A scenario built in code that no model can be made of.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{key} = {value}: {requirement}")]
pub struct ModelError {
    /// Scenario key.
    pub key: String,
    /// Offending value.
    pub value: String,
    /// What it must be.
    pub requirement: &'static str,
}

/// Refuses these; what only the reader of files refuses, such as an empty profile of speeds, gets past.
pub(super) fn check(s: &Scenario) -> Result<(), ModelError> {
    let positive = [
        ("bearing.inner_raceway_diameter_mm", s.bearing.inner_raceway_diameter_mm),
        ("bearing.outer_raceway_diameter_mm", s.bearing.outer_raceway_diameter_mm),
        ("bearing.pitch_diameter_mm", s.bearing.pitch_diameter_mm),
        ("bearing.roller_diameter_mm", s.bearing.roller_diameter_mm),
        ("bearing.roller_length_mm", s.bearing.roller_length_mm),
        ("bearing.inner_ring_mass_kg", s.bearing.inner_ring_mass_kg),
        ("bearing.outer_ring_mass_kg", s.bearing.outer_ring_mass_kg),
        ("bearing.roller_mass_kg", s.bearing.roller_mass_kg),
        ("cage.mass_kg", s.cage.mass_kg),
        ("cage.inner_diameter_mm", s.cage.inner_diameter_mm),
        ("cage.outer_diameter_mm", s.cage.outer_diameter_mm),
        ("cage.guide_clearance_mm", s.cage.guide_clearance_mm),
        ("contact.exponent", s.contact.exponent),
        ("contact.inner_stiffness", s.contact.inner_stiffness),
        ("contact.outer_stiffness", s.contact.outer_stiffness),
        ("friction.slip_velocity_m_per_s", s.friction.slip_velocity_m_per_s),
        ("simulation.duration_s", s.simulation.duration_s),
        ("simulation.sample_rate_hz", s.simulation.sample_rate_hz),
    ];
    for (key, value) in positive {
        if !(value.is_finite() && value > 0.0) {
            return Err(ModelError {
                key: key.into(),
                value: value.to_string(),
                requirement: "must be finite and above 0",
            });
        }
    }
    let counts = [("bearing.rollers_per_row", s.bearing.rollers_per_row, 3), ("bearing.rows", s.bearing.rows, 1)];
    for (key, value, least) in counts {
        if value < least {
            return Err(ModelError {
                key: key.into(),
                value: value.to_string(),
                requirement: "a bearing has at least 1 row of at least 3 rollers",
            });
        }
    }
    if s.bearing.has_balls() && s.simulation.model == ModelKind::Tilting {
        return Err(ModelError {
            key: "simulation.model".into(),
            value: "Tilting".into(),
            requirement: "must be full or lumped for balls",
        });
    }
    if s.bearing.has_balls() && s.contact.law != Law::Sliced {
        return Err(ModelError {
            key: "contact.law".into(),
            value: format!("{:?}", s.contact.law),
            requirement: "must be sliced for balls",
        });
    }
    defects(s)
}

/// That damage lies in a row and on a roller that there is.
fn defects(s: &Scenario) -> Result<(), ModelError> {
    for (k, defect) in s.defects.iter().enumerate() {
        let roller_fits = match defect.on {
            Surface::Roller(roller) => (1..=s.bearing.rollers_per_row).contains(&roller),
            _ => true,
        };
        if !(1..=s.bearing.rows).contains(&defect.row) || !roller_fits {
            return Err(ModelError {
                key: format!("defects.{k}"),
                value: format!("row {} on {:?}, of defect {}", defect.row, defect.on, k + 1),
                requirement: "must be in a row and on a roller that the bearing has",
            });
        }
    }
    Ok(())
}
