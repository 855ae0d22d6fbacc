//! The walk over the list of keys, as it reads a file.

use super::super::keys::{Case, Fallback, Keys, Variant};
use super::super::problem::{Problem, Severity};
use super::super::source::{Node, Value, brief_path};
use super::super::spec::{Spec, key};
use super::super::toml_text::quote;
use super::super::value_type::ValueType;
use super::{MOST_TABLES, Reader, join};
use crate::bearing::clearance::ClearanceClass;
use crate::bearing::{KnownBearing, catalogue, clearance_of};
use crate::did_you_mean::{did_you_mean, nearest_few, other_word};
use crate::scenario::Laws;

impl Keys for Reader<'_> {
    fn key<T: ValueType>(&mut self, spec: Spec, fallback: Fallback<T>, value: &mut T) {
        let (path, entry) = self.name(&spec);
        let read = match entry {
            Some(entry) => self.read(&path, &spec, &entry.node),
            None if matches!(fallback, Fallback::Instead { .. }) => self.fall_back(path, &spec, fallback),
            None => self.catalogued(&path, &spec).or_else(|| self.fall_back(path, &spec, fallback)),
        };
        *value = read.unwrap_or_else(T::unset);
    }

    fn optional<T: ValueType>(&mut self, spec: Spec, value: &mut Option<T>) {
        let (path, entry) = self.name(&spec);
        *value = entry.map(|entry| self.read(&path, &spec, &entry.node).unwrap_or_else(T::unset));
    }

    fn only_where<T: ValueType>(&mut self, spec: Spec, wanted: bool, case: &'static str, value: &mut T) {
        let (path, entry) = self.name(&spec);
        *value = T::unset();
        match entry {
            Some(entry) if wanted => {
                *value = self.read(&path, &spec, &entry.node).unwrap_or_else(T::unset);
            }
            Some(entry) => {
                let problem =
                    Problem::error(path, format!("has a meaning only where {case}")).value(entry.node.brief());
                self.problems.add(problem, entry.node.span.clone());
            }
            None if wanted => {
                let expected = T::expected(&spec);
                self.missing(path, spec.unit, expected, &format!(" where {case}"));
            }
            None => {}
        }
    }

    fn key_where<T: ValueType>(&mut self, spec: Spec, (wanted, case): Case, fallback: Fallback<T>, value: &mut T) {
        if wanted {
            self.key(spec, fallback, value);
        } else {
            self.only_where(spec, false, case, value);
        }
    }

    fn key_acting_where<T: ValueType>(
        &mut self,
        spec: Spec,
        (wanted, case): Case,
        fallback: Fallback<T>,
        value: &mut T,
    ) {
        if wanted {
            return self.key(spec, fallback, value);
        }
        let (path, entry) = self.name(&spec);
        *value = fallback.value().unwrap_or_else(T::unset);
        if let Some(entry) = entry {
            match T::read(&entry.node, &spec) {
                Ok(_) => {
                    let message = format!("has no effect: it acts only where {case}");
                    let problem = Problem::new(Severity::Warning, path, message);
                    let problem = problem.value(entry.node.brief());
                    self.problems.add(problem, entry.node.span.clone());
                }
                Err(misfit) => self.misfit(path, &spec, &entry.node, misfit),
            }
        }
    }

    fn foretold<T: ValueType>(&mut self, section: &str, name: &'static str) -> Option<T> {
        let section = self.frames.first()?.table?.get(section)?;
        let Value::Table(table) = &section.node.value else {
            return None;
        };
        T::read(&table.get(name)?.node, &key(name, "")).ok()
    }

    fn gives(&self, section: &str, name: &str) -> Option<bool> {
        let section = self.frames.first()?.table?.get(section);
        Some(
            section
                .is_some_and(|section| matches!(&section.node.value, Value::Table(table) if table.contains_key(name))),
        )
    }

    fn preset(&mut self, spec: Spec, laws: Laws, value: &mut Option<String>) {
        let before = self.problems.count();
        self.optional(spec, value);
        if self.problems.count() > before {
            self.preset_unknown = true;
            *value = None;
        }
        let Some(name) = value else {
            return;
        };
        if let Some(entry) = catalogue::find(name) {
            self.preset = Some(entry);
            self.laws = laws;
            self.named_clearance = clearance_of(name);
            value.replace(entry.name.clone());
            return;
        }
        self.preset_unknown = true;
        let names = catalogue::all().iter().map(|entry| entry.name.as_str());
        let hint = match KnownBearing::find(name) {
            Some(KnownBearing::DataSet(_)) => {
                ": of this bearing the defect frequencies are known (`brinell frequencies`, `analyze`), and not all that a run needs; \
                 give a bearing of the catalogue, or the keys of [bearing]"
                    .to_owned()
            }
            _ => match (KnownBearing::of_no_known_type(name), catalogue::nearest_name(name)) {
                (Some(why), _) => format!("; {why}"),
                (None, Some(known)) => format!("; did you mean {}?", quote(known)),
                (None, None) => String::new(),
            },
        };
        let path = join(&self.frame().path, spec.name);
        let span = self.found.get(&path).and_then(|node| node.span.clone());
        let problem = Problem::error(path, format!("not in the catalogue{hint}"))
            .value(quote(name))
            .allowed(nearest_few(name, names));
        self.problems.add(problem, span);
    }

    fn named_clearance(&self) -> Option<ClearanceClass> {
        self.named_clearance
    }

    fn section(&mut self, spec: Spec, mut keys: impl FnMut(&mut Self)) {
        let (path, entry) = self.name(&spec);
        if let Some(entry) = entry
            && !matches!(entry.node.value, Value::Table(_))
        {
            let message = format!("expected a section [{path}], found {}", entry.node.kind());
            let problem = Problem::error(path.clone(), message).value(entry.node.brief());
            self.problems.add(problem, entry.node.span.clone());
        }
        self.enter(path, entry.map(|entry| &entry.node));
        keys(self);
        self.leave();
    }

    fn tables<T>(&mut self, spec: Spec, items: &mut Vec<T>, blank: fn() -> T, mut keys: impl FnMut(&mut Self, &mut T)) {
        let (path, entry) = self.name(&spec);
        items.clear();
        let Some(entry) = entry else {
            return;
        };
        let wrong = |node: &Node| {
            let kind = node.kind();
            let message = format!("expected tables, each headed [[{path}]], found {kind}");
            Problem::error(path.clone(), message).value(node.brief())
        };
        let Value::Array(nodes) = &entry.node.value else {
            self.problems.add(wrong(&entry.node), entry.node.span.clone());
            return;
        };
        if nodes.len() > MOST_TABLES {
            let message = format!("there are {} [[{path}]]", nodes.len());
            let problem = Problem::error(path.clone(), message).allowed(format!("at most {MOST_TABLES} of them"));
            self.problems.add(problem, entry.node.span.clone());
            return;
        }
        for (i, node) in nodes.iter().enumerate() {
            if !matches!(node.value, Value::Table(_)) {
                self.problems.add(wrong(node), node.span.clone());
                continue;
            }
            let mut item = blank();
            self.enter(format!("{path}.{i}"), Some(node));
            keys(self, &mut item);
            self.leave();
            items.push(item);
        }
    }

    fn one_of<T: 'static>(
        &mut self,
        spec: Spec,
        variants: &'static [Variant<T>],
        value: &mut T,
        mut keys: impl FnMut(&mut Self, &mut T),
    ) {
        let (path, entry) = self.name(&spec);
        *value = (variants[0].blank)();
        let known: Vec<&str> = variants.iter().map(|variant| variant.name).collect();
        let list = known.join(", ");
        let Some(entry) = entry else {
            self.missing(path, "", format!("a table with one of {list}"), "");
            return;
        };
        let wrong = |message: String| {
            Problem::error(path.clone(), message).value(entry.node.brief()).allowed(format!("exactly one of {list}"))
        };
        let Value::Table(table) = &entry.node.value else {
            let message =
                format!("expected a table such as {{ {} = {{ ... }} }}, found {}", known[0], entry.node.kind());
            self.problems.add(wrong(message), entry.node.span.clone());
            return;
        };
        if table.len() != 1 {
            let problem = wrong(format!("it has {} keys", table.len()));
            self.problems.add(problem, entry.node.span.clone());
        }
        for (name, inner) in table {
            let inner_path = join(&path, name);
            let Some(variant) = variants.iter().find(|variant| variant.name == name) else {
                self.problems.add_of(Severity::Error, format!("unknown {}", spec.name), || {
                    let hint = did_you_mean(name, known.iter().copied())
                        .or_else(|| other_word(name).filter(|word| known.contains(word)))
                        .map(|known| format!("; did you mean `{known}`?"))
                        .unwrap_or_default();
                    let message = format!("unknown {}{hint}", spec.name);
                    let problem = Problem::error(brief_path(&inner_path), message)
                        .value(inner.node.brief())
                        .allowed(list.clone());
                    (problem, inner.key_span.clone())
                });
                continue;
            };
            if !matches!(inner.node.value, Value::Table(_)) {
                let message = format!("expected a table, found {}", inner.node.kind());
                let problem = Problem::error(inner_path.clone(), message).value(inner.node.brief());
                self.problems.add(problem, inner.node.span.clone());
            }
            *value = (variant.blank)();
            self.enter(inner_path, Some(&inner.node));
            keys(self, value);
            self.leave();
            self.keep_of_file(&path, name, &inner.node);
        }
    }
}
