//! The walk that makes a tree of values of a scenario, as a file with every key would give it.

use super::field::Field;
use super::source::{Entry, Node, Table, Value};
use super::spec::Spec;
use super::walk::{Case, Fallback, Keys, Offers, Tables, Walk};

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

impl Walk for Tree {
    fn at_key(&mut self, spec: Spec, _: Fallback<&dyn Field>, value: &mut dyn Field) -> bool {
        self.add(spec.name, value.node());
        false
    }

    fn at_optional(&mut self, spec: Spec, given: bool, value: &mut dyn Field) -> bool {
        if given {
            self.add(spec.name, value.node());
        }
        given
    }

    fn at_only_where(&mut self, spec: Spec, wanted: bool, case: &'static str, value: &mut dyn Field) {
        if wanted {
            return self.add(spec.name, value.node());
        }
        let key = self.path.iter().map(String::as_str).chain([spec.name]).collect::<Vec<_>>().join(".");
        self.left_out.push(LeftOut { key, case, value: value.write() });
    }

    fn at_key_where(
        &mut self,
        spec: Spec,
        (wanted, case): Case,
        _: Fallback<&dyn Field>,
        value: &mut dyn Field,
    ) -> bool {
        self.at_only_where(spec, wanted, case, value);
        false
    }

    fn at_key_acting_where(
        &mut self,
        spec: Spec,
        (wanted, _): Case,
        _: Fallback<&dyn Field>,
        value: &mut dyn Field,
    ) -> bool {
        if wanted {
            self.add(spec.name, value.node());
        }
        false
    }

    fn at_section(&mut self, spec: Spec, keys: &mut dyn FnMut(&mut Keys)) {
        let section = self.below(&[spec.name], |tree| keys(tree));
        if !matches!(&section.value, Value::Table(table) if table.is_empty()) {
            self.add(spec.name, section);
        }
    }

    fn at_tables(&mut self, spec: Spec, items: &mut dyn Tables) {
        let count = items.count();
        let item = |k: usize| self.below(&[spec.name, &k.to_string()], |tree| items.walk(k, tree));
        let all: Vec<Node> = (0..count).map(item).collect();
        if !all.is_empty() {
            self.add(spec.name, Node::unplaced(Value::Array(all)));
        }
    }

    fn at_one_of(&mut self, spec: Spec, value: &mut dyn Offers) {
        let (chosen, _) = value.all()[value.chosen()];
        let inner = self.below(&[spec.name, chosen], |tree| value.walk(tree));
        self.add(spec.name, Node::record([(chosen, inner)]));
    }
}
