//! The walk that fills a scenario from a tree of values, and reports everything that does not fit.

mod walk;

use std::collections::HashMap;
use std::ops::Range;

use super::field::{Field, Kind};
use super::known_keys::known_keys;
use super::problem::{Problem, Severity};
use super::problems::Problems;
use super::provenance::{Origin, Provenance};
use super::recorded::{self, Assumed};
use super::source::{Entry, Node, Table, Value, brief_path, override_value};
use super::spec::{Spec, key_meant, unit_of_key};
use super::value_type::Misfit;
use super::walk::Fallback;
use crate::bearing::catalogue;
use crate::bearing::clearance::ClearanceClass;
use crate::did_you_mean::{boundary_dimension, did_you_mean, left_out};
use crate::scenario::Laws;

/// Tables of one list, such as `[[defects]]`, at most.
const MOST_TABLES: usize = 5000;
/// What begins the message of a key that is not there and has to be.
const MISSING: &str = "missing";

/// A table being read.
struct Frame<'a> {
    path: String,
    table: Option<&'a Table>,
    /// Where the table begins, for keys that are missing from it.
    header: Option<Range<usize>>,
    /// Keys that the walk has named so far.
    named: Vec<&'static str>,
    /// The table itself was unusable: what it lacks is not worth a word.
    broken: bool,
}

/// Fills a document from a tree of values.
pub struct Reader<'a> {
    frames: Vec<Frame<'a>>,
    preset: Option<&'static catalogue::Entry>,
    /// The set of laws that the preset's values are to hold with.
    laws: Laws,
    /// The class of clearance in the preset's name: C3 of `6205-2RS/C3`.
    named_clearance: Option<ClearanceClass>,
    /// A preset was requested and is unknown: what it would have filled is not worth a word.
    preset_unknown: bool,
    /// Section and name of every key there is, for hints on unknown ones.
    vocabulary: &'a [(String, String)],
    /// What the file says was assumed when it was written.
    recorded: HashMap<String, Assumed>,
    /// Those of them that tell how files of damage were read.
    recorded_of_files: Vec<Assumed>,
    /// What does not fit.
    pub problems: Problems<'a>,
    /// Where each value comes from.
    pub provenance: Vec<Provenance>,
    /// What the file says of each key that the walk has named.
    pub found: HashMap<String, &'a Node>,
}

fn join(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_string() } else { format!("{path}.{name}") }
}

impl<'a> Reader<'a> {
    /// Of a scenario.
    pub(crate) fn new(text: &'a str, root: &'a Table) -> Reader<'a> {
        Reader::with_vocabulary(text, root, known_keys())
    }

    /// Of another document.
    pub fn with_vocabulary(text: &'a str, root: &'a Table, vocabulary: &'a [(String, String)]) -> Reader<'a> {
        let root = Frame { path: String::new(), table: Some(root), header: None, named: Vec::new(), broken: false };
        Reader {
            frames: vec![root],
            preset: None,
            laws: Laws::DEFAULT,
            named_clearance: None,
            preset_unknown: false,
            vocabulary,
            recorded: HashMap::new(),
            recorded_of_files: Vec::new(),
            problems: Problems::of(text),
            provenance: Vec::new(),
            found: HashMap::new(),
        }
    }

    /// Reads which values were assumed when the file was written; the walk over the scenario's keys comes after.
    pub(crate) fn read_recorded(&mut self) {
        let mut list = None;
        recorded::provenance(self, &mut list);
        self.recorded_of_files = recorded::of_files(list.as_ref());
        self.recorded = recorded::by_key(list);
        // The list itself is no value of the run.
        self.provenance.clear();
    }

    /// Ends the walk: what the file holds beyond the keys named is unknown.
    pub fn finish(&mut self) {
        self.leave();
    }

    fn frame(&mut self) -> &mut Frame<'a> {
        self.frames.last_mut().expect("the root frame stays until the walk ends")
    }

    /// Names a key of the present table; its path and what the file says of it.
    fn name(&mut self, spec: &Spec) -> (String, Option<&'a Entry>) {
        let frame = self.frame();
        frame.named.push(spec.name);
        let entry = frame.table.and_then(|table| table.get(spec.name));
        let path = join(&frame.path, spec.name);
        if let Some(entry) = entry {
            self.found.insert(path.clone(), &entry.node);
        }
        (path, entry)
    }

    fn enter(&mut self, path: String, node: Option<&'a Node>) {
        let header = node.and_then(|node| node.span.clone());
        let table = node.and_then(|node| match &node.value {
            Value::Table(table) => Some(table),
            _ => None,
        });
        self.frames.push(Frame { path, table, header, named: Vec::new(), broken: node.is_some() && table.is_none() });
    }

    fn leave(&mut self) {
        let Some(frame) = self.frames.pop() else {
            return;
        };
        for (name, entry) in frame.table.into_iter().flatten() {
            if !frame.named.contains(&name.as_str()) {
                self.unknown(&frame, name, entry);
            }
        }
    }

    fn unknown(&mut self, frame: &Frame<'_>, name: &str, entry: &Entry) {
        let vocabulary = self.vocabulary;
        let mut meant = None;
        self.problems.add_of(Severity::Error, "unknown key", || {
            let (problem, known) = unknown(vocabulary, frame, name, entry);
            meant = known;
            (problem, entry.key_span.clone())
        });
        // One slip is one problem: the key that was meant is not missing too.
        if let Some(known) = meant {
            self.problems.withdraw(&join(&frame.path, known), MISSING);
        }
    }

    fn misfit(&mut self, path: String, spec: &Spec, node: &Node, misfit: Misfit) {
        let element = misfit.element.as_deref().unwrap_or(node);
        let span = element.span.clone().or_else(|| node.span.clone());
        let source = if span.is_none() { " (given as an override)" } else { "" };
        let (path, unit) = match misfit.under.as_str() {
            "" => (path, spec.unit),
            under => {
                let path = join(&path, under);
                let unit = unit_of_key(&path);
                (path, unit)
            }
        };
        let problem =
            Problem::error(path, misfit.message + source).value(element.brief()).allowed(misfit.allowed).unit(unit);
        self.problems.add(problem, span);
    }

    fn missing(&mut self, path: String, unit: &'static str, expected: String, why: &str) {
        let frame = self.frame();
        if frame.broken {
            return;
        }
        let header = frame.header.clone();
        let problem = Problem::error(path, format!("{MISSING}: {expected} is required{why}"));
        self.problems.add(problem.unit(unit), header);
    }

    fn record(&mut self, path: &str, spec: &Spec, value: String, origin: Origin, assumed: bool) {
        let about = || Some(spec.plausible?.about(value.parse().ok()?, &spec.range));
        let plausible = if assumed { about() } else { None };
        self.provenance.push(Provenance { key: path.to_string(), value, unit: spec.unit, origin, assumed, plausible });
    }

    /// Reads a key that the file gives; what does not fit is reported.
    fn read(&mut self, path: &str, spec: &Spec, node: &Node, value: &mut dyn Field) {
        match value.read(node, spec) {
            Ok(()) => self.given(path, spec, node, value),
            Err(misfit) => {
                self.misfit(path.to_string(), spec, node, misfit);
                value.unset();
            }
        }
    }

    /// Records a value that the file gives.
    fn given(&mut self, path: &str, spec: &Spec, node: &Node, value: &dyn Field) {
        let written = value.write();
        let recorded = || {
            let entry = self.recorded.get(path)?;
            let was = value.as_written(&override_value(&entry.value).ok()?, spec).ok()?;
            (was == written).then(|| entry.reason.clone())
        };
        let (origin, assumed) = match node.span {
            None => (Origin::Override, false),
            Some(_) => match recorded() {
                Some(reason) => (Origin::Recorded(reason), true),
                None => (Origin::File, false),
            },
        };
        self.record(path, spec, written, origin, assumed);
    }

    /// Reads a key from the catalogue bearing, where that states it.
    fn catalogued(&mut self, path: &str, spec: &Spec, value: &mut dyn Field) -> bool {
        let Some(datum) = self.datum(path) else {
            return false;
        };
        let read = value.read(&Node::of_catalogue(&datum.value), spec);
        match &read {
            Ok(()) => self.record_datum(path, spec, value.write(), datum),
            Err(misfit) => {
                let message = format!("the catalogue's value does not fit: {}", misfit.message);
                self.problems.add(Problem::error(path, message), None);
            }
        }
        read.is_ok()
    }

    fn datum(&self, path: &str) -> Option<&'static catalogue::Value> {
        let entry = self.preset?;
        // The width is a fact of every bearing, and acts where rings tilt.
        let fact = || entry.facts.iter().find(|fact| fact.key == catalogue::WIDTH && path == "bearing.width_mm");
        entry.values.iter().find(|value| value.key == path && value.holds_with(self.laws)).or_else(fact)
    }

    fn record_datum(&mut self, path: &str, spec: &Spec, value: String, datum: &catalogue::Value) {
        let origin = Origin::Preset { source: datum.source.clone(), estimated: datum.estimated };
        self.record(path, spec, value, origin, datum.estimated);
    }

    /// Keeps what was assumed of the file that the geometry of a shape came of. Geometry that an override gives came of
    /// none, and a shape that names its file says itself how it is read.
    fn keep_of_file(&mut self, path: &str, variant: &str, node: &Node) {
        let Value::Table(table) = &node.value else {
            return;
        };
        let given = table.values().any(|entry| entry.node.span.is_none());
        if given || node.span.is_none() || table.contains_key("file") {
            return;
        }
        let of_file = self.recorded_of_files.iter();
        let kept = of_file.filter(|entry| entry.is_of(path, variant) && !self.found.contains_key(&entry.key));
        let kept = kept.map(|entry| Provenance {
            key: entry.key.clone(),
            value: entry.value.clone(),
            unit: unit_of_key(&entry.key),
            origin: Origin::Recorded(entry.reason.clone()),
            assumed: true,
            plausible: None,
        });
        self.provenance.extend(kept.collect::<Vec<_>>());
    }

    /// Whether the fallback's value stands in for the key's, recorded then; otherwise what is wrong is reported, and the
    /// value unset.
    fn fall_back(&mut self, path: String, spec: &Spec, fallback: Fallback<&dyn Field>, value: &mut dyn Field) -> bool {
        let stands = self.stands_in(path, spec, value.kind(), fallback);
        if !stands {
            value.unset();
        }
        stands
    }

    fn stands_in(
        &mut self,
        path: String,
        spec: &Spec,
        Kind { expected, range, .. }: Kind,
        fallback: Fallback<&dyn Field>,
    ) -> bool {
        let (value, origin, assumed) = match fallback {
            Fallback::Required => {
                self.missing(path, spec.unit, expected(spec), "");
                return false;
            }
            Fallback::Catalogued(_) if self.preset_unknown => return false,
            Fallback::Catalogued(or) => {
                let why = format!(" without a bearing.preset that states it{or}");
                self.missing(path, spec.unit, expected(spec), &why);
                return false;
            }
            Fallback::Needed(case) => {
                self.missing(path, spec.unit, expected(spec), &format!(" ({case})"));
                return false;
            }
            Fallback::Derived { value, how } if !value.fits(spec) => {
                // Otherwise what it derives from is at fault, and reported already.
                if value.is_defined() || self.problems.is_empty() {
                    let message = format!("cannot be derived ({how}): give it");
                    let problem = Problem::error(path, message).value(value.write());
                    let problem = problem.allowed(range(spec)).unit(spec.unit);
                    self.problems.add(problem, None);
                }
                return false;
            }
            Fallback::Derived { value, how } => (value, Origin::Derived(how), true),
            // What cannot be used comes of a key that is at fault itself, and reported.
            Fallback::Instead { value, .. } if !value.fits(spec) => return false,
            Fallback::Instead { value, how, assumed } => (value, Origin::Derived(how), assumed),
            Fallback::Fixed { value, why, assumed } => (value, Origin::Default(why), assumed),
        };
        self.record(&path, spec, value.write(), origin, assumed);
        true
    }
}

/// A key that a table has and should not, with the one of the same table that was meant where that can be guessed.
fn unknown(
    vocabulary: &[(String, String)],
    frame: &Frame<'_>,
    name: &str,
    entry: &Entry,
) -> (Problem, Option<&'static str>) {
    let mut meant = None;
    let home = |section: &str| match section {
        "" => "the top of the file, before any section".to_string(),
        "defects" => "[[defects]]".to_string(),
        section => format!("[{section}]"),
    };
    let elsewhere = |wanted: &str| {
        let mut sections: Vec<&str> =
            vocabulary.iter().filter(|(_, name)| name == wanted).map(|(section, _)| section.as_str()).collect();
        // What is likeliest first.
        sections.sort_by_key(|section| section.matches('.').count());
        // The path of one of several tables has a number.
        let of_defects = sections.first().and_then(|section| section.strip_prefix("defects"));
        let path = of_defects.map_or(String::new(), |rest| format!(" (its path is defects.0{rest}.{wanted})"));
        let homes: Vec<String> = sections.into_iter().map(home).collect();
        homes.join(" or ") + &path
    };
    let boundary = boundary_dimension(name).filter(|_| frame.path == "bearing");
    let hint = if let Some((raceway, what)) = boundary {
        format!("; a bearing's {what} is not asked for: elements run on the raceway, `{raceway}`")
    } else if vocabulary.iter().any(|(_, known)| known == name) {
        format!("; it belongs in {}", elsewhere(name))
    } else if let Some(why) = left_out(name) {
        format!("; {why}")
    } else if let Some(known) = key_meant(name, &frame.named) {
        meant = Some(known);
        format!("; did you mean `{known}`?")
    } else if let Some(known) = did_you_mean(name, vocabulary.iter().map(|(_, k)| k.as_str())) {
        format!("; did you mean `{known}` in {}?", elsewhere(known))
    } else {
        String::new()
    };
    let allowed = if hint.is_empty() { frame.named.join(", ") } else { String::new() };
    let path = join(&frame.path, name);
    let problem = Problem::error(brief_path(&path), format!("unknown key{hint}"));
    (problem.value(entry.node.brief()).allowed(allowed), meant)
}
