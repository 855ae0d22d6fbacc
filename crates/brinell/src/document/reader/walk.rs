//! The walk over the list of keys, as it reads a file.

use super::super::field::Field;
use super::super::problem::{Problem, Severity};
use super::super::source::{Node, Value, brief_path};
use super::super::spec::Spec;
use super::super::toml_text::quote;
use super::super::walk::{Case, Fallback, Keys, Offers, Tables, Walk};
use super::{MOST_TABLES, Reader, join};
use crate::bearing::clearance::ClearanceClass;
use crate::bearing::{KnownBearing, catalogue, clearance_of};
use crate::did_you_mean::{did_you_mean, nearest_few, other_word};
use crate::scenario::Laws;

impl Walk for Reader<'_> {
    fn at_key(&mut self, spec: Spec, fallback: Fallback<&dyn Field>, value: &mut dyn Field) -> bool {
        let (path, entry) = self.name(&spec);
        match entry {
            Some(entry) => self.read(&path, &spec, &entry.node, value),
            None if matches!(fallback, Fallback::Instead { .. }) => {
                return self.fall_back(path, &spec, fallback, value);
            }
            None if self.catalogued(&path, &spec, value) => {}
            None => return self.fall_back(path, &spec, fallback, value),
        }
        false
    }

    fn at_optional(&mut self, spec: Spec, _: bool, value: &mut dyn Field) -> bool {
        let (path, entry) = self.name(&spec);
        if let Some(entry) = entry {
            self.read(&path, &spec, &entry.node, value);
        }
        entry.is_some()
    }

    fn at_only_where(&mut self, spec: Spec, wanted: bool, case: &'static str, value: &mut dyn Field) {
        let (path, entry) = self.name(&spec);
        match entry {
            Some(entry) if wanted => return self.read(&path, &spec, &entry.node, value),
            Some(entry) => {
                let problem =
                    Problem::error(path, format!("has a meaning only where {case}")).value(entry.node.brief());
                self.problems.add(problem, entry.node.span.clone());
            }
            None if wanted => {
                let expected = (value.kind().expected)(&spec);
                self.missing(path, spec.unit, expected, &format!(" where {case}"));
            }
            None => {}
        }
        value.unset();
    }

    fn at_key_where(
        &mut self,
        spec: Spec,
        (wanted, case): Case,
        fallback: Fallback<&dyn Field>,
        value: &mut dyn Field,
    ) -> bool {
        if wanted {
            return self.at_key(spec, fallback, value);
        }
        self.at_only_where(spec, false, case, value);
        false
    }

    fn at_key_acting_where(
        &mut self,
        spec: Spec,
        (wanted, case): Case,
        fallback: Fallback<&dyn Field>,
        value: &mut dyn Field,
    ) -> bool {
        if wanted {
            return self.at_key(spec, fallback, value);
        }
        let (path, entry) = self.name(&spec);
        if let Some(entry) = entry {
            match value.as_written(&entry.node, &spec) {
                Ok(_) => {
                    let message = format!("has no effect: it acts only where {case}");
                    let problem = Problem::new(Severity::Warning, path, message);
                    let problem = problem.value(entry.node.brief());
                    self.problems.add(problem, entry.node.span.clone());
                }
                Err(misfit) => self.misfit(path, &spec, &entry.node, misfit),
            }
        }
        value.unset();
        fallback.value().is_some()
    }

    fn later(&self, section: &str, name: &str) -> Option<&Node> {
        let section = self.frames.first()?.table?.get(section)?;
        let Value::Table(table) = &section.node.value else {
            return None;
        };
        Some(&table.get(name)?.node)
    }

    fn gives(&self, section: &str, name: &str) -> Option<bool> {
        Some(self.later(section, name).is_some())
    }

    fn after_preset(&mut self, spec: Spec, laws: Laws, value: &mut Option<String>) {
        let path = join(&self.frame().path, spec.name);
        let node = self.found.get(&path).copied();
        if node.is_some_and(|node| value.as_ref().is_some_and(|value| value.as_written(node, &spec).is_err())) {
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
        let span = node.and_then(|node| node.span.clone());
        let problem = Problem::error(path, format!("not in the catalogue{hint}"))
            .value(quote(name))
            .allowed(nearest_few(name, names));
        self.problems.add(problem, span);
    }

    fn named_clearance(&self) -> Option<ClearanceClass> {
        self.named_clearance
    }

    fn at_section(&mut self, spec: Spec, keys: &mut dyn FnMut(&mut Keys)) {
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

    fn at_tables(&mut self, spec: Spec, items: &mut dyn Tables) {
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
            self.enter(format!("{path}.{i}"), Some(node));
            items.walk_new(self);
            self.leave();
        }
    }

    fn at_one_of(&mut self, spec: Spec, value: &mut dyn Offers) {
        let (path, entry) = self.name(&spec);
        value.choose(0);
        let known: Vec<&str> = value.all().into_iter().map(|(name, _)| name).collect();
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
            let Some(i) = known.iter().position(|known| known == name) else {
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
            value.choose(i);
            self.enter(inner_path, Some(&inner.node));
            value.walk(self);
            self.leave();
            self.keep_of_file(&path, name, &inner.node);
        }
    }
}
