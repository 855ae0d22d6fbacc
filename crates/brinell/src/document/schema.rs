//! The walk that describes a scenario file as a JSON Schema (draft 2020-12).

use serde_json::{Map, Value as Json, json};

use super::keys::{Case, Fallback, Keys, Variant};
use super::spec::Spec;
use super::value_type::ValueType;
use crate::scenario::Laws;

/// Keys of a table, as far as the walk has come.
#[derive(Default)]
struct Object {
    properties: Map<String, Json>,
    required: Vec<&'static str>,
    /// Required unless a catalogue bearing states them.
    catalogued: Vec<&'static str>,
    preset: Option<&'static str>,
}

impl Object {
    fn needs_anything(&self) -> bool {
        !self.required.is_empty() || !self.catalogued.is_empty()
    }

    fn schema(self, doc: &str) -> Json {
        let mut schema = json!({
            "type": "object",
            "description": doc,
            "properties": self.properties,
            "additionalProperties": false,
        });
        if !self.required.is_empty() {
            schema["required"] = self.required.into();
        }
        if !self.catalogued.is_empty() {
            let ways = self.preset.map(|preset| vec![preset]).into_iter().chain([self.catalogued]);
            schema["anyOf"] = ways.map(|keys| json!({ "required": keys })).collect();
        }
        schema
    }
}

/// The walk; [`schema_of`] makes it.
pub struct Schema {
    objects: Vec<Object>,
}

impl Schema {
    fn object(&mut self) -> &mut Object {
        self.objects.last_mut().expect("the root object stays until the walk ends")
    }

    fn put(&mut self, spec: &Spec, mut schema: Json, doc: String) {
        schema["description"] = doc.into();
        if !spec.unit.is_empty() {
            schema["x-unit"] = spec.unit.into();
        }
        self.object().properties.insert(spec.name.into(), schema);
    }

    /// A key with its default as written.
    fn describe(&mut self, spec: &Spec, mut schema: Json, fallback: Fallback<&str>) {
        let mut doc = describe(spec);
        match fallback {
            Fallback::Required => self.object().required.push(spec.name),
            Fallback::Catalogued => {
                self.object().catalogued.push(spec.name);
                doc.push_str("; required without a preset that states it");
            }
            Fallback::Needed(case) => doc.push_str(&format!("; required: {case}")),
            Fallback::Derived { how, .. } | Fallback::Instead { how, .. } => doc.push_str(&format!("; default: {how}")),
            Fallback::Fixed { value, why, .. } => {
                if let Ok(value) = serde_json::from_str::<Json>(value) {
                    schema["default"] = value;
                }
                doc.push_str(&format!("; default: {why}"));
            }
        }
        if let Some(plausible) = spec.plausible {
            doc.push_str(&format!("; where it is assumed, plausible from {plausible}"));
        }
        self.put(spec, schema, doc);
    }

    fn say_more(&mut self, name: &str, more: &str) {
        let schema = self.object().properties.get_mut(name);
        if let Some(Json::String(doc)) = schema.and_then(|s| s.get_mut("description")) {
            doc.push_str(more);
        }
    }

    fn nested(&mut self, keys: impl FnOnce(&mut Self)) -> Object {
        self.objects.push(Object::default());
        keys(self);
        self.objects.pop().unwrap_or_default()
    }
}

fn describe(spec: &Spec) -> String {
    match spec.unit {
        "" => spec.doc.to_string(),
        unit => format!("{} ({unit})", spec.doc),
    }
}

impl Keys for Schema {
    fn key<T: ValueType>(&mut self, spec: Spec, fallback: Fallback<T>, _: &mut T) {
        // What is written as TOML here is also JSON: numbers, plain strings and lists of them.
        let written = match &fallback {
            Fallback::Fixed { value, .. } => value.write(),
            _ => String::new(),
        };
        self.describe(&spec, T::schema(&spec), fallback.map(|_| written.as_str()));
    }

    fn optional<T: ValueType>(&mut self, spec: Spec, _: &mut Option<T>) {
        self.put(&spec, T::schema(&spec), describe(&spec));
    }

    fn only_where<T: ValueType>(&mut self, spec: Spec, _: bool, case: &'static str, _: &mut T) {
        let doc = format!("{}; required where {case}, and only there", describe(&spec));
        self.put(&spec, T::schema(&spec), doc);
    }

    fn key_where<T: ValueType>(&mut self, spec: Spec, (_, case): Case, fallback: Fallback<T>, value: &mut T) {
        let required = matches!(fallback, Fallback::Required);
        let catalogued = matches!(fallback, Fallback::Catalogued);
        self.key(spec, fallback, value);
        let object = self.object();
        if required {
            object.required.pop();
        }
        if catalogued {
            object.catalogued.pop();
        }
        let word = if required { "required where" } else { "where" };
        self.say_more(spec.name, &format!("; {word} {case}, and only there"));
    }

    fn key_acting_where<T: ValueType>(&mut self, spec: Spec, (_, case): Case, fallback: Fallback<T>, value: &mut T) {
        self.key(spec, fallback, value);
        self.say_more(spec.name, &format!("; acts only where {case}"));
    }

    fn preset(&mut self, spec: Spec, _: Laws, value: &mut Option<String>) {
        self.object().preset = Some(spec.name);
        self.optional(spec, value);
    }

    fn section(&mut self, spec: Spec, mut keys: impl FnMut(&mut Self)) {
        let object = self.nested(|schema| keys(schema));
        if object.needs_anything() {
            self.object().required.push(spec.name);
        }
        let schema = object.schema(spec.doc);
        self.object().properties.insert(spec.name.into(), schema);
    }

    fn tables<T>(&mut self, spec: Spec, _: &mut Vec<T>, blank: fn() -> T, mut keys: impl FnMut(&mut Self, &mut T)) {
        let object = self.nested(|schema| keys(schema, &mut blank()));
        let schema = json!({ "type": "array", "items": object.schema(spec.doc) });
        self.put(&spec, schema, spec.doc.to_string());
    }

    fn one_of<T: 'static>(
        &mut self,
        spec: Spec,
        variants: &'static [Variant<T>],
        _: &mut T,
        mut keys: impl FnMut(&mut Self, &mut T),
    ) {
        let shapes = self.nested(|schema| {
            for variant in variants {
                let inner = schema.nested(|schema| keys(schema, &mut (variant.blank)()));
                let inner = inner.schema(variant.doc);
                schema.object().properties.insert(variant.name.into(), inner);
            }
        });
        let mut schema = shapes.schema(spec.doc);
        schema["minProperties"] = 1.into();
        schema["maxProperties"] = 1.into();
        self.object().required.push(spec.name);
        self.object().properties.insert(spec.name.into(), schema);
    }
}

/// JSON Schema (draft 2020-12) of the file whose keys `list` names; TOML tables are objects.
pub fn schema_of(title: &str, doc: &str, list: impl FnOnce(&mut Schema)) -> Json {
    let mut walk = Schema { objects: vec![Object::default()] };
    list(&mut walk);
    let root = walk.objects.pop().unwrap_or_default();
    let mut schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": title,
    });
    if let (Json::Object(schema), Json::Object(body)) = (&mut schema, root.schema(doc)) {
        schema.extend(body);
    }
    schema
}
