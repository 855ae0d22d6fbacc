//! The walk that makes a tree of values of a scenario, as a file with every key would give it.

use super::keys::{Case, Fallback, Keys, Variant, variant_of};
use super::source::{Entry, Node, Table, Value};
use super::spec::Spec;
use super::value_type::ValueType;

/// A key that has no meaning here, and what its field holds.
pub(crate) struct LeftOut {
    pub(crate) key: String,
    /// Where it has one.
    pub(crate) case: &'static str,
    pub(crate) value: String,
}

#[derive(Default)]
pub(crate) struct Tree {
    /// What has been walked of the table at hand.
    pub(crate) table: Table,
    path: Vec<String>,
    pub(crate) left_out: Vec<LeftOut>,
}

impl Tree {
    fn add(&mut self, name: &str, node: Node) {
        self.table.insert(name.into(), Entry { key_span: None, node });
    }

    /// The table that a walk below `steps` makes.
    fn below(&mut self, steps: &[&str], walk: impl FnOnce(&mut Self)) -> Node {
        let outer = std::mem::take(&mut self.table);
        self.path.extend(steps.iter().map(|step| (*step).to_owned()));
        walk(self);
        self.path.truncate(self.path.len() - steps.len());
        Node::table(std::mem::replace(&mut self.table, outer))
    }
}

impl Keys for Tree {
    fn key<T: ValueType>(&mut self, spec: Spec, _: Fallback<T>, value: &mut T) {
        self.add(spec.name, value.node());
    }

    fn optional<T: ValueType>(&mut self, spec: Spec, value: &mut Option<T>) {
        if let Some(value) = value {
            self.add(spec.name, value.node());
        }
    }

    fn only_where<T: ValueType>(&mut self, spec: Spec, wanted: bool, case: &'static str, value: &mut T) {
        if wanted {
            return self.add(spec.name, value.node());
        }
        let key = self.path.iter().map(String::as_str).chain([spec.name]).collect::<Vec<_>>().join(".");
        self.left_out.push(LeftOut { key, case, value: value.write() });
    }

    fn key_where<T: ValueType>(&mut self, spec: Spec, (wanted, case): Case, _: Fallback<T>, value: &mut T) {
        self.only_where(spec, wanted, case, value);
    }

    fn key_acting_where<T: ValueType>(&mut self, spec: Spec, (wanted, _): Case, _: Fallback<T>, value: &mut T) {
        if wanted {
            self.add(spec.name, value.node());
        }
    }

    fn section(&mut self, spec: Spec, keys: impl FnMut(&mut Self)) {
        let section = self.below(&[spec.name], keys);
        if !matches!(&section.value, Value::Table(table) if table.is_empty()) {
            self.add(spec.name, section);
        }
    }

    fn tables<T>(&mut self, spec: Spec, items: &mut Vec<T>, _: fn() -> T, mut keys: impl FnMut(&mut Self, &mut T)) {
        let item = |(k, item): (usize, &mut T)| self.below(&[spec.name, &k.to_string()], |tree| keys(tree, item));
        let all: Vec<Node> = items.iter_mut().enumerate().map(item).collect();
        if !all.is_empty() {
            self.add(spec.name, Node::unplaced(Value::Array(all)));
        }
    }

    fn one_of<T: 'static>(
        &mut self,
        spec: Spec,
        variants: &'static [Variant<T>],
        value: &mut T,
        mut keys: impl FnMut(&mut Self, &mut T),
    ) {
        let chosen = variant_of(variants, value).name;
        let inner = self.below(&[spec.name, chosen], |tree| keys(tree, value));
        self.add(spec.name, Node::record([(chosen, inner)]));
    }
}
