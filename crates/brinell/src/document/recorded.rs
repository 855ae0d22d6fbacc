//! The section `[provenance]` of a written scenario: which of its values are assumed, so that reading the file says so
//! again.
//!
//! A written scenario gives every key, so the file itself no longer tells what its author stated from what was assumed.
//! Each entry of `assumed` holds a key, the value that was assumed and the reason. A value of the file that equals its
//! entry's stays assumed. One that differs is its author's, as is any override. An entry whose key the file does not
//! hold says nothing, but for the keys of a file of damage: a written scenario holds the geometry that came of them,
//! and they stay beside it.

use std::collections::{HashMap, HashSet};

use serde_json::{Value as Json, json};

use super::keys::Keys;
use super::known_keys::{keys_of_machine, known_keys};
use super::provenance::Provenance;
pub(super) use super::provenance::SECTION;
use super::source::{Node, Value};
use super::spec::{Spec, key};
use super::toml_text::quote;
use super::value_type::{Misfit, ValueType, elements, wrong_type};
use crate::did_you_mean::did_you_mean;

const KEYS: [&str; 3] = ["key", "value", "reason"];

/// One value that was assumed when the scenario was written.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Assumed {
    pub(crate) key: String,
    /// As TOML.
    pub(crate) value: String,
    pub(crate) reason: String,
}

/// Names the section's key; nothing is written where nothing is assumed.
pub(crate) fn provenance(k: &mut Keys, assumed: &mut Option<Vec<Assumed>>) {
    let doc = "where values come from, as brinell writes it: not to be written by hand";
    k.section(key(SECTION, doc), |k| {
        let doc = "values that neither the author nor a cited source states; a value that differs from the one here is its author's";
        k.optional(key("assumed", doc), assumed);
    });
}

/// What a writer has to say of a scenario's values.
pub(crate) fn of(provenance: &[Provenance]) -> Option<Vec<Assumed>> {
    let assumed = provenance.iter().filter(|p| p.assumed);
    let list: Vec<Assumed> =
        assumed.map(|p| Assumed { key: p.key.clone(), value: p.value.clone(), reason: p.reason() }).collect();
    (!list.is_empty()).then_some(list)
}

/// The entries by their keys.
pub(crate) fn by_key(list: Option<Vec<Assumed>>) -> HashMap<String, Assumed> {
    let entries = list.into_iter().flatten();
    entries.map(|entry| (entry.key.clone(), entry)).collect()
}

/// The entries of a list that tell how a file of damage was read.
pub(crate) fn of_files(list: Option<&Vec<Assumed>>) -> Vec<Assumed> {
    let entries = list.into_iter().flatten();
    let of_file = |entry: &&Assumed| {
        let words: Vec<&str> = entry.key.split('.').collect();
        matches!(&words[..], ["defects", _, "shape", kind, _] if geometry_of(kind).is_some())
    };
    entries.filter(of_file).cloned().collect()
}

/// The shape that holds the geometry of a file of this kind.
fn geometry_of(kind: &str) -> Option<&'static str> {
    match kind {
        "image" | "svg" => Some("outline"),
        "depth_map" => Some("depth_map"),
        _ => None,
    }
}

impl Assumed {
    /// Whether it tells how the file was read that the geometry of the shape `variant` at `path` came of.
    pub(crate) fn is_of(&self, path: &str, variant: &str) -> bool {
        let below = self.key.strip_prefix(path);
        let below = below.and_then(|rest| rest.strip_prefix('.')?.split_once('.'));
        below.is_some_and(|(kind, _)| geometry_of(kind) == Some(variant))
    }

    fn read(node: &Node) -> Result<Self, Misfit> {
        let Value::Table(table) = &node.value else {
            return Err(Misfit::new(format!("expected a table, found {}", node.kind()), KEYS.join(", ")));
        };
        if let Some(unknown) = table.keys().find(|name| !KEYS.contains(&name.as_str())) {
            return Err(Misfit::new(format!("unknown key `{unknown}`"), KEYS.join(", ")));
        }
        let of = |name: &str| {
            let entry = table.get(name).map(|entry| &entry.node);
            entry.ok_or_else(|| Misfit::new(format!("missing: `{name}`"), KEYS.join(", ")))
        };
        let text = |name: &str| match &of(name)?.value {
            Value::Text(text) => Ok(text.clone()),
            _ => Err(Misfit::new(format!("`{name}` must be a string"), "")),
        };
        let key = text("key")?;
        exists(&key)?;
        Ok(Self { key, value: of("value")?.text(), reason: text("reason")? })
    }
}

/// Refuses a key that no scenario has. Numbers of list items are passed over.
fn exists(key: &str) -> Result<(), Misfit> {
    let words: Vec<&str> = key.split('.').filter(|word| word.parse::<usize>().is_err()).collect();
    let (name, section) = words.split_last().unwrap_or((&"", &[]));
    let section = section.join(".");
    if known_keys().iter().chain(keys_of_machine()).any(|(s, n)| *s == section && n == name) {
        return Ok(());
    }
    let near = did_you_mean(name, known_keys().iter().map(|(_, name)| name.as_str()));
    let hint = near.map(|known| format!("; did you mean `{known}`?"));
    Err(Misfit::new(format!("{} is no key of a scenario{}", quote(key), hint.unwrap_or_default()), ""))
}

impl ValueType for Vec<Assumed> {
    fn expected(_: &Spec) -> String {
        "a list of tables { key = ..., value = ..., reason = ... }".into()
    }

    fn read(node: &Node, spec: &Spec) -> Result<Self, Misfit> {
        if !matches!(node.value, Value::Array(_)) {
            return Err(wrong_type::<Self>(node, spec));
        }
        let mut seen = HashSet::new();
        let mut list = Vec::new();
        for item in elements::<Self>(node, spec)? {
            let entry = Assumed::read(item).map_err(|misfit| misfit.in_element(item))?;
            if !seen.insert(entry.key.clone()) {
                let message = format!("{} is here twice", quote(&entry.key));
                return Err(Misfit::new(message, "").in_element(item));
            }
            list.push(entry);
        }
        Ok(list)
    }

    fn write(&self) -> String {
        let mut text = String::from(
            "[\n  # Neither the author nor a cited source states these. Change a value above, and it is yours.\n",
        );
        for Assumed { key, value, reason } in self {
            let (key, reason) = (quote(key), quote(reason));
            text.push_str(&format!("  {{ key = {key}, value = {value}, reason = {reason} }},\n"));
        }
        text + "]"
    }

    fn schema(_: &Spec) -> Json {
        json!({
            "type": "array",
            "items": {
                "type": "object",
                "properties": { "key": { "type": "string" }, "value": {}, "reason": { "type": "string" } },
                "required": KEYS,
                "additionalProperties": false,
            },
        })
    }
}
