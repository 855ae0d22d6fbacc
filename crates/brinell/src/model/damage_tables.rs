//! Damage of a scenario in the model, and the tables by which it acts: those of files, and those that the half-space gives.

use super::{BroadPhase, Geometry, Inertia, Model, ModelError};
use crate::defect::{Defect, SIDES, Side};
use crate::effective::Table;
use crate::half_space::{self, error::BuildError};
use crate::operation::Rotation;
use crate::scenario::{DefectTable, Scenario, TableData, TableValues};
use crate::slices::Healthy;
use std::sync::Arc;

/// What energies of a table have to be.
const OF_ENERGIES: &str =
    "energies in J, at the first and the last s_mm those of the healthy contact: K delta^(n+1)/(n+1), all in SI units";

impl Model {
    /// Gives damage its tables (section 19), which say where its contacts are no longer healthy. `false`: one is not at hand, and
    /// `may_make` forbids to make it.
    pub(super) fn add_tables(&mut self, s: &Scenario, may_make: bool) -> Result<bool, ModelError> {
        self.use_given_tables(s)?;
        let force = heaviest(s, &self.geometry, &self.inertia);
        let contacts = [&self.inner_contact, &self.outer_contact];
        let deflection = |side: Side| {
            let law = contacts[side as usize];
            let least = law.deflection(force);
            self.slices.as_ref().map_or(least, |slices| slices.deflection(law, force, least))
        };
        let how = (self.tilt.is_some(), may_make);
        in_its_units(&self.defects, deflection)?;
        match half_space::add_tables(&mut self.defects, (&s.bearing, &s.contact), how, deflection) {
            Ok(()) => {}
            Err(BuildError::NotAtHand) => return Ok(false),
            Err(error) => {
                return Err(ModelError {
                    key: "defects".into(),
                    value: error.to_string(),
                    requirement: "damage that a table of the half-space can hold: shorter, of a smoother outline, or with contact.tables = \"coarse\"",
                });
            }
        }
        self.broad_phase = SIDES.map(|side| BroadPhase::new(&self.layout, &self.defects, side));
        Ok(true)
    }

    /// Gives damage the tables of files.
    fn use_given_tables(&mut self, s: &Scenario) -> Result<(), ModelError> {
        for (k, given) in s.defects.iter().enumerate() {
            let Some(DefectTable::Read(data)) = &given.table else { continue };
            let fault =
                |value: String, requirement| ModelError { key: format!("defects.{k}.table"), value, requirement };
            let in_m = |list: &[f64], unit: f64| -> Vec<f64> { list.iter().map(|x| unit * x).collect() };
            let (at, by) = (in_m(&data.s_mm, 1e-3), in_m(&data.delta_um, 1e-6));
            let made = |delta_eff_um: &[f64]| {
                let table = Table::from_grid(&at, &by, &in_m(delta_eff_um, 1e-6));
                table.map(Arc::new).map_err(|error| fault(error.to_string(), "a full grid whose s and delta rise"))
            };
            match &data.values {
                TableValues::DeltaEffUm(list) => {
                    let table = made(list)?;
                    SIDES.into_iter().for_each(|side| self.defects[k].use_table_at(side, table.clone()));
                }
                // Each side's healthy contact stores another energy.
                TableValues::EnergyJ(list) => {
                    for side in SIDES.into_iter().filter(|side| self.defects[k].meets_side(*side)).collect::<Vec<_>>() {
                        let values = effective(&self.healthy(side), &data.delta_um, list);
                        let alike = TableData { values: TableValues::DeltaEffUm(values), ..data.clone() };
                        alike.check().map_err(|error| fault(error.to_string(), OF_ENERGIES))?;
                        let table = made(alike.values.list())?;
                        self.defects[k].use_table_at(side, table);
                    }
                }
            }
        }
        Ok(())
    }
}

/// Damage, its files read before.
pub(super) fn defects(s: &Scenario) -> Result<Vec<Defect>, ModelError> {
    for (k, defect) in s.defects.iter().enumerate() {
        if let Some(file) = defect.shape.file() {
            return Err(ModelError {
                key: format!("defects.{k}.shape"),
                value: file.to_string(),
                requirement: "a shape, not a file: read it first, with brinell_damage::resolve",
            });
        }
    }
    for (k, defect) in s.defects.iter().enumerate() {
        if let Some(file) = defect.table_file() {
            return Err(ModelError {
                key: format!("defects.{k}.table"),
                value: file.to_string(),
                requirement: "a table, not a file: read it first, with brinell_damage::resolve",
            });
        }
    }
    Defect::all(&s.defects, &s.bearing, &s.contact).map_err(|k| ModelError {
        key: format!("defects.{k}"),
        // A scan has a million depths.
        value: format!("{:?}", s.defects[k]).chars().take(200).collect(),
        requirement: "rows and rollers count from 1, and the shape must make sense: lists equally long, arcs that do not go back, polygons with area, grids without holes",
    })
}

/// Force of the heaviest contact without clearance (Stribeck), N: of load and weight, or of the elements' own centrifugal force.
fn heaviest(s: &Scenario, g: &Geometry, m: &Inertia) -> f64 {
    let gravity = s.operation.gravity_m_per_s2;
    let count = (s.bearing.rows * s.bearing.rollers_per_row) as f64;
    let weight = gravity[0].hypot(gravity[1]) * (m.inner_ring + m.outer_ring + count * m.roller);
    let load = s.operation.load_n[0].hypot(s.operation.load_n[1]) + weight;
    let orbit = Rotation::new(&s.operation.speed_rpm).max_speed() * g.inner_radius / (2.0 * g.pitch_radius);
    (s.bearing.element.stribeck() * load / count).max(m.roller * g.pitch_radius * orbit * orbit)
}

/// delta_eff (um) of a table of energies on a healthy contact; where nothing touches, straight on down from the first two nodes that do.
fn effective(healthy: &Healthy, delta_um: &[f64], energies: &[f64]) -> Vec<f64> {
    let of = |energy: f64| if energy > 0.0 { 1e6 * healthy.deformation_of(energy) } else { 0.0 };
    let rows = energies.chunks(delta_um.len()).flat_map(|row| {
        let mut row: Vec<f64> = row.iter().map(|energy| of(*energy)).collect();
        let from = row.iter().position(|value| *value > 0.0).unwrap_or(0);
        let slope = match row[from..] {
            [first, second, ..] => (second - first) / (delta_um[from + 1] - delta_um[from]),
            _ => 1.0,
        };
        for k in 0..from {
            row[k] = (row[from] - slope * (delta_um[from] - delta_um[k])).min(0.0);
        }
        row
    });
    rows.collect()
}

/// That tables of files are in their units: none is meant for damage or a heaviest deformation ten times as large.
fn in_its_units(defects: &[Defect], deflection: impl Fn(Side) -> f64) -> Result<(), ModelError> {
    const SMALLEST: f64 = 0.1;
    for (k, defect) in defects.iter().enumerate() {
        let met = SIDES.into_iter().filter(|side| defect.meets_side(*side));
        let Some((side, table)) = met.filter_map(|side| Some((side, defect.table(side)?))).next() else { continue };
        let [begin, end] = table.range_s();
        let (from, to) = defect.shape.arc();
        let wrong = [
            ("s_mm go over", 1e3 * (end - begin), "the damage's length along the surface is", 1e3 * (to - from), "mm"),
            (
                "delta_um end at",
                1e6 * table.last_delta(),
                "the heaviest contact deforms by some",
                1e6 * deflection(side),
                "um",
            ),
        ];
        for (what, is, of, should, unit) in wrong {
            if is < SMALLEST * should {
                return Err(ModelError {
                    key: format!("defects.{k}.table"),
                    value: format!("its {what} {is:.3e} {unit}, and {of} {should:.3} {unit}"),
                    requirement: "columns in the units of their names: s_mm in mm, delta_um and delta_eff_um in um",
                });
            }
        }
    }
    Ok(())
}
