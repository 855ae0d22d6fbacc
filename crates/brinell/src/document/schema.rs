//! The walk that describes a scenario file as a JSON Schema (draft 2020-12).

use serde_json::{Map, Value as Json, json};

use super::field::Field;
use super::spec::Spec;
use super::walk::{Case, Fallback, Keys, Offers, Tables, Walk};
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
            Fallback::Catalogued(or) => {
                self.object().catalogued.push(spec.name);
                doc.push_str(&format!("; required without a preset that states it{or}"));
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

    fn nested(&mut self, keys: &mut dyn FnMut(&mut Self)) -> Object {
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

impl Walk for Schema {
    fn at_key(&mut self, spec: Spec, fallback: Fallback<&dyn Field>, value: &mut dyn Field) -> bool {
        // What is written as TOML here is also JSON: numbers, plain strings and lists of them.
        let written = match &fallback {
            Fallback::Fixed { value, .. } => value.write(),
            _ => String::new(),
        };
        self.describe(&spec, (value.kind().schema)(&spec), fallback.map(|_| written.as_str()));
        false
    }

    fn at_optional(&mut self, spec: Spec, given: bool, value: &mut dyn Field) -> bool {
        self.put(&spec, (value.kind().schema)(&spec), describe(&spec));
        given
    }

    fn at_only_where(&mut self, spec: Spec, _: bool, case: &'static str, value: &mut dyn Field) {
        let doc = format!("{}; required where {case}, and only there", describe(&spec));
        self.put(&spec, (value.kind().schema)(&spec), doc);
    }

    fn at_key_where(
        &mut self,
        spec: Spec,
        (_, case): Case,
        fallback: Fallback<&dyn Field>,
        value: &mut dyn Field,
    ) -> bool {
        let required = matches!(fallback, Fallback::Required);
        let catalogued = matches!(fallback, Fallback::Catalogued(_));
        self.at_key(spec, fallback, value);
        let object = self.object();
        if required {
            object.required.pop();
        }
        if catalogued {
            object.catalogued.pop();
        }
        let word = if required { "required where" } else { "where" };
        self.say_more(spec.name, &format!("; {word} {case}, and only there"));
        false
    }

    fn at_key_acting_where(
        &mut self,
        spec: Spec,
        (_, case): Case,
        fallback: Fallback<&dyn Field>,
        value: &mut dyn Field,
    ) -> bool {
        self.at_key(spec, fallback, value);
        self.say_more(spec.name, &format!("; acts only where {case}"));
        false
    }

    fn after_preset(&mut self, spec: Spec, _: Laws, _: &mut Option<String>) {
        self.object().preset = Some(spec.name);
    }

    fn at_section(&mut self, spec: Spec, keys: &mut dyn FnMut(&mut Keys)) {
        let object = self.nested(&mut |schema| keys(schema));
        if object.needs_anything() {
            self.object().required.push(spec.name);
        }
        let schema = object.schema(spec.doc);
        self.object().properties.insert(spec.name.into(), schema);
    }

    fn at_tables(&mut self, spec: Spec, items: &mut dyn Tables) {
        let object = self.nested(&mut |schema| items.walk_blank(schema));
        let schema = json!({ "type": "array", "items": object.schema(spec.doc) });
        self.put(&spec, schema, spec.doc.to_string());
    }

    fn at_one_of(&mut self, spec: Spec, value: &mut dyn Offers) {
        let shapes = self.nested(&mut |schema| {
            for (i, (name, doc)) in value.all().into_iter().enumerate() {
                let inner = schema.nested(&mut |schema| value.walk_blank(i, schema));
                let inner = inner.schema(doc);
                schema.object().properties.insert(name.into(), inner);
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
