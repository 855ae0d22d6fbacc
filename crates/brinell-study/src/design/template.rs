//! A piece of a scenario file in which any value may be a distribution.

use super::distribution::{Distribution, Value};
use brinell::document::reading::{Misfit, Node, Spec, Toml, ValueType, key_text};
use brinell::scenario::Unset;
use serde_json::{Map, Value as Json};
use std::collections::BTreeMap;

/// A value, a distribution, or a list or a table of these.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Template {
    /// As it is, TOML.
    Fixed(String),
    /// To be drawn.
    Drawn(Distribution),
    /// Elements in order.
    List(Vec<Template>),
    /// By key.
    Table(BTreeMap<String, Template>),
}

impl Template {
    /// Of the value of `key`, or of an element of it.
    fn of(key: &str, node: &Node) -> Result<Self, Misfit> {
        if let Some(distribution) = Distribution::read(key, node) {
            return distribution.map(Self::Drawn);
        }
        Ok(match &node.value {
            Toml::Array(items) => {
                let items = items
                    .iter()
                    .enumerate()
                    .map(|(k, item)| Self::of(key, item).map_err(|misfit| misfit.under(&k.to_string())));
                Self::List(items.collect::<Result<_, _>>()?)
            }
            Toml::Table(table) => {
                let pairs = table.iter().map(|(name, entry)| {
                    let inner = Self::of(name, &entry.node).map_err(|misfit| misfit.under(name))?;
                    Ok((name.clone(), inner))
                });
                Self::Table(pairs.collect::<Result<_, _>>()?)
            }
            _ => Self::Fixed(node.text()),
        })
    }

    /// The settings of a table: paths of keys, and what they are set to. Tables are gone into, so that keys beside the
    /// ones named stay; a list is one value.
    pub(super) fn settings(&self) -> Vec<(String, &Template)> {
        let mut all = Vec::new();
        self.gather("", &mut all);
        all
    }

    fn gather<'a>(&'a self, path: &str, all: &mut Vec<(String, &'a Template)>) {
        match self {
            Self::Table(table) => {
                for (name, inner) in table {
                    inner.gather(&join(path, name), all);
                }
            }
            other => all.push((path.to_owned(), other)),
        }
    }

    /// Every distribution with the path of its key, in the order of [`Template::toml`].
    pub(super) fn distributions<'a>(&'a self, path: &str, all: &mut Vec<(String, &'a Distribution)>) {
        match self {
            Self::Fixed(_) => {}
            Self::Drawn(distribution) => all.push((path.to_owned(), distribution)),
            Self::List(items) => {
                for (k, item) in items.iter().enumerate() {
                    item.distributions(&join(path, &k.to_string()), all);
                }
            }
            Self::Table(table) => {
                for (name, inner) in table {
                    inner.distributions(&join(path, name), all);
                }
            }
        }
    }

    /// As TOML on one line, with the values drawn in the order of [`Template::distributions`].
    pub(super) fn toml<'a>(&self, drawn: &mut impl Iterator<Item = &'a Value>) -> String {
        match self {
            Self::Fixed(text) => text.clone(),
            Self::Drawn(_) => drawn.next().map_or(String::new(), |value| value.toml.clone()),
            Self::List(items) => {
                let items: Vec<String> = items.iter().map(|item| item.toml(drawn)).collect();
                format!("[{}]", items.join(", "))
            }
            Self::Table(table) => {
                let pairs: Vec<String> =
                    table.iter().map(|(name, inner)| format!("{} = {}", key_text(name), inner.toml(drawn))).collect();
                format!("{{ {} }}", pairs.join(", "))
            }
        }
    }

    /// Whether a key is set, by itself or within a table: `defects.0.shape` is where `defects.0.shape.random.seed` is.
    pub(super) fn sets(&self, path: &str) -> bool {
        match (self, path.split_once('.').unwrap_or((path, ""))) {
            (_, ("", _)) => true,
            (Self::Table(table), (head, rest)) => {
                table.get(head).is_some_and(|inner| inner.sets(rest)) || table.contains_key(path)
            }
            (Self::List(items), (head, rest)) => {
                let item = head.parse::<usize>().ok().and_then(|k| items.get(k));
                item.is_some_and(|inner| inner.sets(rest))
            }
            _ => false,
        }
    }
}

fn join(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") }
}

impl Default for Template {
    /// Without a key.
    fn default() -> Self {
        Self::Table(BTreeMap::new())
    }
}

impl Unset for Template {
    fn unset() -> Self {
        Self::default()
    }
}

impl ValueType for Template {
    fn expected(_: &Spec) -> String {
        "keys of a scenario, each with a value or a distribution".into()
    }

    fn read(node: &Node, _: &Spec) -> Result<Self, Misfit> {
        Self::of("", node)
    }

    fn write(&self) -> String {
        self.toml(&mut std::iter::empty())
    }

    fn schema(_: &Spec) -> Json {
        Json::Object(Map::new())
    }
}
