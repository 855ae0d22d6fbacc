//! The names of all keys, for hints.

use super::provenance::SECTION;
use super::schema::schema_of;
use super::sections;
use crate::scenario::{Scenario, Unset};
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
