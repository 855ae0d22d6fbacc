//! The answer of a tool, out of what its command printed.

use super::call::Ended;
use rmcp::model::{CallToolResult, ContentBlock};
use serde_json::{Map, Value};

pub(super) fn refused(words: String) -> CallToolResult {
    CallToolResult::error(vec![ContentBlock::text(words)])
}

/// The record that the command printed, or `only` these parts of it, as an object and as text; its warnings and errors as text.
pub(super) fn answer(ended: &Ended, only: &[String]) -> CallToolResult {
    let record: Option<Value> = serde_json::from_str(&ended.out).ok().filter(Value::is_object);
    let mut words: Vec<String> = Some(ended.err.trim().to_owned()).into_iter().filter(|err| !err.is_empty()).collect();
    let record = record.map(|record| parts(record, only, &mut words));
    let mut result = match (record, ended.succeeded) {
        (None, _) if words.is_empty() => return refused("error: the command ended without an answer".into()),
        (None, _) => return refused(words.join("\n")),
        // Of a sweep one of whose points failed, say.
        (Some(record), false) => CallToolResult::structured_error(record),
        (Some(record), true) => CallToolResult::structured(record),
    };
    result.content.extend(words.into_iter().map(ContentBlock::text));
    result
}

/// The parts of these names; what there is none of is null, and said.
fn parts(record: Value, only: &[String], words: &mut Vec<String>) -> Value {
    if only.is_empty() {
        return record;
    }
    let one = |name: &String| {
        let part = part(&record, name);
        if part.is_none() {
            let has: Vec<&str> = record.as_object().into_iter().flatten().map(|(key, _)| key.as_str()).collect();
            words.push(format!("only: {name} is not in the record, which has {}", has.join(", ")));
        }
        (name.clone(), part.unwrap_or_default())
    };
    only.iter().map(one).collect::<Map<_, _>>().into()
}

/// What lies at a name: keys from the outermost on, with points between them; keys have points too. Of a list the part of
/// each element.
fn part(value: &Value, name: &str) -> Option<Value> {
    match value {
        Value::Array(all) => {
            let parts: Vec<Option<Value>> = all.iter().map(|one| part(one, name)).collect();
            let some = parts.iter().any(Option::is_some);
            some.then(|| parts.into_iter().map(Option::unwrap_or_default).collect())
        }
        Value::Object(all) => all.get(name).cloned().or_else(|| {
            let within = |(key, value): (&String, &Value)| part(value, name.strip_prefix(key)?.strip_prefix('.')?);
            all.iter().find_map(within)
        }),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn prop_a_part_is_found_by_keys_that_have_points_themselves() {
        let record =
            json!({ "a": { "b.c": { "d": 1 }, "b": { "x": null } }, "rows": [{ "p.q": 1 }, {}, { "p.q": 2 }], "n": 3 });
        let of = |name: &str| part(&record, name);
        assert_eq!(of("a.b.c"), Some(json!({ "d": 1 })));
        assert_eq!(of("a.b.c.d"), Some(json!(1)));
        assert_eq!(of("a.b.x"), Some(Value::Null));
        assert_eq!(of("rows.p.q"), Some(json!([1, null, 2])));
        assert_eq!(of("n"), Some(json!(3)));
        for none in ["", "a.", "a.b.c.d.e", "rows.p", "n.m", "A", ".a"] {
            assert_eq!(of(none), None, "{none:?}");
        }
        let mut words = Vec::new();
        assert_eq!(parts(record, &["n".into(), "m".into()], &mut words), json!({ "n": 3, "m": null }));
        assert_eq!(words, ["only: m is not in the record, which has a, rows, n"]);
    }
}
