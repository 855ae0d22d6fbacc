//! The JSON Schema of a scenario file.

use super::schema::schema_of;
use super::{recorded, sections};
use crate::scenario::{Scenario, Unset};
use serde_json::Value as Json;

/// JSON Schema (draft 2020-12) of a scenario file; TOML tables are objects.
pub fn json_schema() -> Json {
    let doc = "one run of brinell, completely described";
    schema_of("brinell scenario", doc, |walk| {
        sections::scenario(walk, &mut Scenario::unset());
        recorded::provenance(walk, &mut None);
    })
}
