//! From a file's text to a scenario, and back.

use std::collections::HashMap;

use super::checks::{self, Finder};
use super::problem::{Place, Problem, Severity};
use super::provenance::{Origin, Provenance, by_key};
use super::reader::Reader;
use super::spec::unit_of;
use super::tree::{LeftOut, Tree};
use super::writer::{Style, Writer};
use super::{recorded, sections, source, toml_text};
use crate::scenario::{Scenario, Shape, Unset};

/// A scenario that can run, and where its values come from.
#[derive(Debug, Clone, PartialEq)]
pub struct Loaded {
    /// The scenario with every default filled in.
    pub scenario: Scenario,
    /// Origin of every value, in the order of the file format.
    pub provenance: Vec<Provenance>,
    /// What the author should know.
    pub warnings: Vec<Problem>,
}

/// Reads a scenario file's text. Overrides are pairs of a dotted path and a TOML value, a bare word being a string;
/// elements of lists go by number from 0 (`defects.0.depth_um`).
///
/// # Errors
/// Every problem of the text at once, warnings after errors.
pub fn read(text: &str, overrides: &[(String, String)]) -> Result<Loaded, Vec<Problem>> {
    read_tree(text, &source::parse(text, overrides)?)
}

/// The tree of a text, or of a scenario, which has none.
fn read_tree(text: &str, root: &source::Table) -> Result<Loaded, Vec<Problem>> {
    let mut scenario = Scenario::unset();
    let mut reader = Reader::new(text, root);
    reader.read_recorded();
    sections::scenario(&mut reader, &mut scenario);
    reader.finish();
    let finder = Finder::new(text, &reader.found, &reader.provenance);
    let problems = checks::check(&scenario, &finder, reader.problems).finish();
    if problems.iter().any(|problem| problem.severity == Severity::Error) {
        return Err(problems);
    }
    Ok(Loaded { scenario, provenance: reader.provenance, warnings: problems })
}

/// Reads a scenario file's bytes, which must be UTF-8.
///
/// # Errors
/// As [`read`]; the first byte that is not UTF-8 is a problem of its own.
pub fn read_bytes(bytes: &[u8], overrides: &[(String, String)]) -> Result<Loaded, Vec<Problem>> {
    match std::str::from_utf8(bytes) {
        Ok(text) => read(text, overrides),
        Err(error) => {
            let good = error.valid_up_to();
            let text = String::from_utf8_lossy(&bytes[..good]);
            let mut place = Place::new(&text, good..good);
            place.span = good..good + error.error_len().unwrap_or(bytes.len() - good);
            let message = "not a text file in UTF-8, as TOML must be";
            let problem = Problem::error("", message).value(format!("byte 0x{:02x}", bytes[good])).at(Some(place));
            Err(vec![problem])
        }
    }
}

impl Loaded {
    /// Where the value at a path comes from; that of the whole list for one of its items, such as `operation.load_n.0`.
    pub fn provenance_of(&self, key: &str) -> Option<&Provenance> {
        let mut path = key;
        loop {
            if let Some(found) = self.provenance.iter().find(|p| p.key == path) {
                return Some(found);
            }
            let (rest, item) = path.rsplit_once('.')?;
            item.parse::<usize>().ok()?;
            path = rest;
        }
    }

    /// Says of a defect whose shape was put in place of a file's name that it came from that file.
    pub fn read_from(&mut self, defect: usize, file: &str) {
        let name = match self.scenario.defects.get(defect).map(|d| &d.shape) {
            Some(Shape::Outline { polygons_mm }) if polygons_mm.len() == 1 => "outline.points_mm",
            Some(Shape::Outline { .. }) => "outline.polygons_mm",
            Some(Shape::DepthMap { .. }) => "depth_map.depth_um",
            _ => return,
        };
        self.provenance.push(Provenance {
            key: format!("defects.{defect}.shape.{name}"),
            value: String::new(),
            unit: if name.ends_with("um") { "um" } else { "mm" },
            origin: Origin::DamageFile(file.to_string()),
            assumed: false,
            plausible: None,
        });
    }

    /// Says of a defect whose table was put in place of a file's name that it came from that file.
    pub fn table_read_from(&mut self, defect: usize, file: &str) {
        let key = format!("defects.{defect}.table");
        if let Some(entry) = self.provenance.iter_mut().find(|entry| entry.key == key) {
            entry.value = String::new();
            entry.origin = Origin::DamageFile(file.to_string());
        }
    }

    /// Says that the level which divides damage from sound was found in the image of a defect, 0 black to 1 white.
    pub fn threshold_found(&mut self, defect: usize, level: f64) {
        let how = "found in the image, its light evened out where that is uneven";
        self.found(defect, "image", "threshold", "", level, Origin::Derived(how));
    }

    /// Says that the radius along s of the form of a defect's scan was fitted; `how`, in words.
    pub fn radius_found(&mut self, defect: usize, radius_mm: f64, how: String) {
        self.found(defect, "depth_map", "radius_mm", "mm", radius_mm, Origin::Found(how));
    }

    /// Behind all that the file says of the shape: where a written scenario has it.
    fn found(&mut self, defect: usize, kind: &str, name: &str, unit: &'static str, value: f64, origin: Origin) {
        let of_shape = format!("defects.{defect}.shape.{kind}.");
        let place = self.provenance.iter().rposition(|p| p.key.starts_with(&of_shape));
        let key = of_shape + name;
        let found = Provenance { key, value: toml_text::float(value), unit, origin, assumed: true, plausible: None };
        self.provenance.insert(place.map_or(self.provenance.len(), |place| place + 1), found);
    }

    /// The scenario as TOML with every default filled in, each assumed value with its reason beside it and in the
    /// section `[provenance]`, so that [`read`] says the same of it.
    pub fn to_toml(&self) -> String {
        let style = Style { provenance: by_key(&self.provenance), template: false };
        let mut writer = Writer::new(style);
        sections::scenario(&mut writer, &mut self.scenario.clone());
        recorded::provenance(&mut writer, &mut recorded::of(&self.provenance));
        writer.finish()
    }
}

impl Scenario {
    /// The scenario as TOML with every key given. Where [`Scenario::problems`] finds no error it reads back to the same
    /// scenario, bit for bit, but for fields of `tilting` that do not act: those have their defaults then.
    pub fn to_toml(&self) -> String {
        write(self, Style { provenance: HashMap::new(), template: false })
    }

    /// Everything wrong with a scenario built or changed in code, errors first; keys are those of the file. A field whose key
    /// has no meaning in the present case holds what a file's reader gives it there.
    pub fn problems(&self) -> Vec<Problem> {
        let tree = tree_of(self);
        match read_tree("", &tree.table) {
            Ok(loaded) => [lost(tree.left_out, tree_of(&loaded.scenario).left_out), loaded.warnings].concat(),
            Err(problems) => problems,
        }
    }
}

/// Every key that a scenario has, and the fields that have none.
fn tree_of(scenario: &Scenario) -> Tree {
    let mut tree = Tree::default();
    sections::scenario(&mut tree, &mut scenario.clone());
    tree
}

/// Values that a file has no key for, and that do not come back by themselves.
fn lost(left_out: Vec<LeftOut>, read_back: Vec<LeftOut>) -> Vec<Problem> {
    let differing = left_out.into_iter().zip(read_back).filter(|(own, back)| own.value != back.value);
    let problem = |(LeftOut { key, case, value }, back): (LeftOut, LeftOut)| {
        let unit = unit_of(key.rsplit('.').next().unwrap_or_default());
        let allowed = if back.value == "nan" { "none".into() } else { back.value };
        Problem::error(key, format!("has a meaning only where {case}")).value(value).allowed(allowed).unit(unit)
    };
    differing.map(problem).collect()
}

pub(crate) fn write(scenario: &Scenario, style: Style<'_>) -> String {
    let mut writer = Writer::new(style);
    sections::scenario(&mut writer, &mut scenario.clone());
    writer.finish()
}
