//! The names of all keys, for hints.

use super::machine::keys::machine as machine_keys;
use super::machine::tables::{OF_A_BEARING, SHARED};
use super::provenance::SECTION;
use super::schema::schema_of;
use super::sections;
use crate::scenario::{Machine, Scenario, Unset};
use serde_json::Value as Json;
use std::sync::LazyLock;

/// Every key as (section, name); the section of a table in a list is written without index.
pub(crate) fn known_keys() -> &'static [(String, String)] {
    static KEYS: LazyLock<Vec<(String, String)>> = LazyLock::new(|| {
        // The keys of its entries are no hint for anything else.
        let mut keys = vec![(String::new(), SECTION.to_owned())];
        let listed = schema_of("", "", |walk| sections::scenario(walk, &mut Scenario::unset()));
        collect("", &listed, &mut keys);
        keys
    });
    &KEYS
}

/// The same of a machine: what is around its bearings, and the keys of a bearing under `bearing`.
pub(crate) fn keys_of_machine() -> &'static [(String, String)] {
    static KEYS: LazyLock<Vec<(String, String)>> = LazyLock::new(|| {
        let mut keys = vec![(String::new(), SECTION.to_owned())];
        let listed = schema_of("", "", |walk| machine_keys(walk, &mut Machine::unset()));
        collect("", &listed, &mut keys);
        for (section, name) in known_keys() {
            let of = if section.is_empty() { name } else { section }.split('.').next().unwrap_or_default();
            if OF_A_BEARING.contains(&of) {
                let nested = if section.is_empty() { "bearing".into() } else { format!("bearing.{section}") };
                keys.push((nested, name.clone()));
            }
            if !OF_A_BEARING.contains(&of) || SHARED.contains(&of) {
                keys.push((section.clone(), name.clone()));
            }
        }
        keys
    });
    &KEYS
}

fn collect(section: &str, schema: &Json, keys: &mut Vec<(String, String)>) {
    for (name, inner) in schema["properties"].as_object().into_iter().flatten() {
        keys.push((section.to_string(), name.clone()));
        let path = match section {
            "" => name.clone(),
            section => format!("{section}.{name}"),
        };
        collect(&path, inner, keys);
        collect(&path, &inner["items"], keys);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::{
        Accelerometer, Bearing, Cage, Contact, Coupling, Defect, DepthGrid, Disc, Friction, Housing, Lubricant,
        MachineHousing, Operation, PathMode, Seat, Shaft, ShaftLoad, Simulation, Support, Unbalance,
    };

    /// A field without its line in the lists of keys would stay what nobody gave: NaN, or 0.
    #[test]
    fn prop_every_field_of_a_scenario_has_a_key() {
        // Two keys, of which one is given, and the sections of a machine.
        let is_two = |field: &str| field == "damping" || field == "machine";
        for (section, fields) in [
            ("", Scenario::FIELDS),
            ("bearing", Bearing::FIELDS),
            ("cage", Cage::FIELDS),
            ("contact", Contact::FIELDS),
            ("friction", Friction::FIELDS),
            ("lubricant", Lubricant::FIELDS),
            ("operation", Operation::FIELDS),
            ("housing", Housing::FIELDS),
            ("support", Support::FIELDS),
            ("defects", Defect::FIELDS),
            ("defects.shape.depth_map", DepthGrid::FIELDS),
            ("sensor.path", PathMode::FIELDS),
            ("simulation", Simulation::FIELDS),
        ] {
            for field in fields.iter().filter(|field| !is_two(field)) {
                let key = (section.to_owned(), (*field).to_owned());
                assert!(known_keys().contains(&key), "{section}.{field}: no line in document/sections.rs or its kin");
            }
        }
        for (section, fields) in [
            ("shaft", Shaft::FIELDS),
            ("shaft.disc", Disc::FIELDS),
            ("shaft.unbalance", Unbalance::FIELDS),
            ("shaft.load", ShaftLoad::FIELDS),
            ("shaft.coupling", Coupling::FIELDS),
            ("bearing", Seat::FIELDS),
            ("housing", MachineHousing::FIELDS),
            ("sensor", Accelerometer::FIELDS),
        ] {
            for field in fields {
                let key = (section.to_owned(), (*field).to_owned());
                assert!(keys_of_machine().contains(&key), "{section}.{field}: no line in document/machine/keys.rs");
            }
        }
        // Its tables are named otherwise: seats with their bearings, others among them.
        assert_eq!(Machine::FIELDS, ["shaft", "seats", "lead", "others", "housings", "sensors"]);
    }
}
