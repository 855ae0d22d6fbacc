//! The JSON Schema against the reader.

use brinell::document::{json_schema, template};
use brinell::scenario::Scenario;
use serde_json::{Value, json};

use super::{BARE, INNER, OUTER};

/// As much of JSON Schema as the scenario's uses; the path of the first value that does not fit.
fn misfit(schema: &Value, value: &Value, path: &str) -> Option<String> {
    let fail = || Some(path.to_string());
    for (keyword, rule) in schema.as_object().expect("a schema is an object") {
        let number = value.as_f64();
        let bad = match keyword.as_str() {
            "$schema" | "title" | "description" | "default" | "x-unit" => false,
            "type" => {
                let of = |word: &Value| match word.as_str().expect("type") {
                    "object" => value.is_object(),
                    "array" => value.is_array(),
                    "string" => value.is_string(),
                    "number" => value.is_number(),
                    "integer" => value.is_i64() || value.is_u64(),
                    other => panic!("type {other}"),
                };
                !rule.as_array().map_or_else(|| of(rule), |words| words.iter().any(of))
            }
            // The only one: a number, then a unit. Strings of TOML that are quantities here begin with a digit.
            "pattern" => value.as_str().is_some_and(|text| {
                let unit = text.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.');
                unit.len() == text.len() || unit.trim().is_empty()
            }),
            "const" => value != rule,
            "minimum" => number.is_some() && number < rule.as_f64(),
            "maximum" => number.is_some() && number > rule.as_f64(),
            "exclusiveMinimum" => number.is_some() && number <= rule.as_f64(),
            "exclusiveMaximum" => number.is_some() && number >= rule.as_f64(),
            "minItems" | "maxItems" | "minProperties" | "maxProperties" => {
                let count = value.as_array().map(Vec::len);
                let count = count.or(value.as_object().map(serde_json::Map::len)).expect("count");
                let limit = rule.as_u64().expect("limit") as usize;
                if keyword.starts_with("min") { count < limit } else { count > limit }
            }
            "required" => {
                let names = rule.as_array().expect("required");
                names.iter().any(|name| value.get(name.as_str().expect("name")).is_none())
            }
            "properties" => {
                for (name, inner) in value.as_object().into_iter().flatten() {
                    let inner_path = format!("{path}.{name}");
                    match rule.get(name) {
                        None => return Some(inner_path),
                        Some(rule) => {
                            if let Some(path) = misfit(rule, inner, &inner_path) {
                                return Some(path);
                            }
                        }
                    }
                }
                false
            }
            "additionalProperties" => *rule != json!(false),
            "items" => {
                for (i, item) in value.as_array().into_iter().flatten().enumerate() {
                    if let Some(path) = misfit(rule, item, &format!("{path}.{i}")) {
                        return Some(path);
                    }
                }
                false
            }
            "anyOf" | "oneOf" => {
                let ways = rule.as_array().expect("ways");
                let fits = ways.iter().filter(|way| misfit(way, value, path).is_none()).count();
                if keyword == "oneOf" { fits != 1 } else { fits == 0 }
            }
            other => panic!("the schema has grown a keyword: {other}"),
        };
        if bad {
            return fail();
        }
    }
    None
}

fn check(text: &str) -> Option<String> {
    let value: Value = toml::from_str(text).expect("TOML");
    misfit(&json_schema(), &value, "")
}

#[test]
fn regress_schema_accepts_what_reads() {
    for text in [&template(), &Scenario::example().to_toml(), OUTER, INNER, BARE] {
        assert_eq!(check(text), None);
    }
    let shapes = "[[defects]]\non = \"roller\"\nroller = 2\nshape = { li2023_irregular = {} }\ndepth_um = 3\n";
    assert_eq!(check(&format!("{BARE}{shapes}")), None);
    let units = BARE.replace("1800.0", "\"30 Hz\"").replace("43.0", "\"43 mm\"");
    assert_eq!(check(&units), None);
    let profile = BARE.replace("1800.0", "[[0.0, 10.0], [1, 20]]");
    assert_eq!(check(&profile), None);
}

#[test]
fn regress_schema_refuses_what_does_not() {
    for (from, to, path) in [
        ("43.0", "-43.0", ".bearing.inner_raceway_diameter_mm"),
        ("43.0", "\"43\"", ".bearing.inner_raceway_diameter_mm"),
        ("rollers_per_row = 19", "rollers_per_row = 2.5", ".bearing.rollers_per_row"),
        ("rollers_per_row = 19", "", ".bearing"),
        ("load_n", "load_kn", ".operation.load_kn"),
        ("[300.0, 0.0]", "[300.0]", ".operation.load_n"),
        ("1800.0", "[]", ".operation.speed_rpm"),
        ("[operation]", "[contact]\nlaw = \"slice\"\n[operation]", ".contact.law"),
    ] {
        assert_eq!(check(&BARE.replace(from, to)).as_deref(), Some(path));
    }
}
