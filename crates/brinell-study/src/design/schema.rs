//! A plan file as a JSON Schema (draft 2020-12): the plan's own keys, and those of a scenario in which any value may be
//! a distribution.

use super::plan::{Plan, keys};
use brinell::document::json_schema;
use brinell::document::reading::schema_of;
use serde_json::{Map, Value as Json, json};

/// A table with the name of a distribution as its key.
const DISTRIBUTION: &str = include_str!("distribution.schema.json");

/// Where the plan's own keys hold a piece of a scenario, and which.
const PIECES: [(&str, &str); 4] = [
    ("/properties/vary", "vary"),
    ("/properties/history/properties/snapshot", "vary"),
    ("/properties/classes/items/properties/vary", "vary"),
    ("/properties/classes/items/properties/defects", "defects"),
];

/// JSON Schema (draft 2020-12) of a plan file; TOML tables are objects. What no single key can say is not in it: that
/// shares leave runs to train with, that a drawn value makes a scenario.
pub fn plan_schema() -> Json {
    let mut schema = schema_of("brinell plan", "the plan of a data set", |walk| {
        keys(walk, &mut Plan::default());
    });
    for (place, piece) in PIECES {
        if let Some(Json::Object(at)) = schema.pointer_mut(place) {
            at.insert("$ref".into(), format!("#/$defs/{piece}").into());
        }
    }
    let none = json!({ "machines": false, "snapshots": false, "history": false });
    schema["oneOf"] =
        json!([{ "required": ["runs"], "properties": none }, { "required": ["machines", "snapshots", "history"] }]);
    let mut scenario = json_schema();
    if let Some(Json::Object(keys)) = scenario.get_mut("properties") {
        keys.remove("provenance");
    }
    // `signals` says it.
    if let Some(Json::Object(keys)) = scenario.pointer_mut("/properties/simulation/properties") {
        keys.remove("record");
    }
    schema["$defs"]["vary"] = opened(&scenario, Sets::Some);
    schema["$defs"]["defects"] = opened(&scenario["properties"]["defects"], Sets::All);
    schema["$defs"]["distribution"] = serde_json::from_str(DISTRIBUTION).unwrap_or_default();
    schema
}

/// Whether a table names some keys of one that is there, or replaces it.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Sets {
    Some,
    All,
}

/// The schema of a piece of a scenario in which any value may be a distribution.
fn opened(schema: &Json, sets: Sets) -> Json {
    let Json::Object(schema) = schema else {
        return schema.clone();
    };
    let mut open = Map::new();
    for (key, value) in schema {
        let value = match (key.as_str(), value) {
            ("$schema" | "title", _) => continue,
            // A base scenario has the others.
            ("required" | "anyOf", _) if sets == Sets::Some => continue,
            ("properties", Json::Object(keys)) => {
                let keys = keys.iter().map(|(k, v)| (k.clone(), drawn(v, sets)));
                keys.collect::<Map<_, _>>().into()
            }
            ("items", item) => drawn(item, Sets::All),
            ("oneOf", Json::Array(forms)) => forms.iter().map(|f| opened(f, sets)).collect(),
            (_, value) => value.clone(),
        };
        open.insert(key.clone(), value);
    }
    if sets == Sets::Some && open.contains_key("properties") {
        // Keys may be quoted with their dots: "operation.speed_rpm".
        open.insert("patternProperties".into(), json!({ "\\.": {} }));
    }
    match schema.get("items") {
        // One element, by its number.
        Some(item) if sets == Sets::Some => json!({ "anyOf": [open, {
            "type": "object",
            "patternProperties": { "^[0-9]+(\\.|$)": drawn(item, Sets::Some) },
            "additionalProperties": false,
        }] }),
        _ => open.into(),
    }
}

/// A value or a distribution.
fn drawn(schema: &Json, sets: Sets) -> Json {
    let mut open = opened(schema, sets);
    let mut either = Map::new();
    // Editors show what is outside.
    for key in ["description", "x-unit", "default"] {
        if let Some(value) = schema.get(key) {
            either.insert(key.into(), value.clone());
        }
        if let Json::Object(open) = &mut open {
            open.remove(key);
        }
    }
    either.insert("anyOf".into(), json!([open, { "$ref": "#/$defs/distribution" }]));
    either.into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::distribution::KINDS;

    #[test]
    fn prop_every_kind_of_distribution_and_every_piece_of_a_scenario_is_in_the_schema() {
        let schema = plan_schema();
        let kinds = schema["$defs"]["distribution"]["oneOf"].as_array().unwrap();
        let kinds: Vec<&str> = kinds.iter().map(|kind| kind["required"][0].as_str().unwrap()).collect();
        assert_eq!(kinds, KINDS);
        for (place, piece) in PIECES {
            let to = format!("#/$defs/{piece}");
            assert_eq!(schema.pointer(place).unwrap()["$ref"], to.as_str());
            assert!(schema["$defs"][piece].is_object(), "{piece}");
        }
        let defects = &schema["$defs"]["defects"]["items"]["anyOf"][0];
        assert!(defects["required"].as_array().unwrap().contains(&json!("on")));
        assert!(schema["$defs"]["vary"].get("required").is_none());
    }
}
