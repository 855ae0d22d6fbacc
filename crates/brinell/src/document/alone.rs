//! The tree of a file of one bearing to a scenario, and a scenario of one bearing to text.

use super::checks::{self, Finder};
use super::problem::{Problem, Severity};
use super::provenance::{Origin, Provenance};
use super::reader::Reader;
use super::writer::{Style, Writer};
use super::{sections, source, toml_text};
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

/// Reads the tree of a text, or of a scenario, which has none.
pub(super) fn read(text: &str, root: &source::Table) -> Result<Loaded, Vec<Problem>> {
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

    /// A key of a defect of the bearing that is observed.
    fn damage_key(&self, defect: usize, rest: &str) -> String {
        let of = self.scenario.machine.as_ref().map_or(String::new(), |machine| format!("bearing.{}.", machine.lead));
        format!("{of}defects.{defect}.{rest}")
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
            key: self.damage_key(defect, &format!("shape.{name}")),
            value: String::new(),
            unit: if name.ends_with("um") { "um" } else { "mm" },
            origin: Origin::DamageFile(file.to_string()),
            assumed: false,
            plausible: None,
        });
    }

    /// Says of a defect whose table was put in place of a file's name that it came from that file.
    pub fn table_read_from(&mut self, defect: usize, file: &str) {
        let key = self.damage_key(defect, "table");
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
        let of_shape = self.damage_key(defect, &format!("shape.{kind}."));
        let place = self.provenance.iter().rposition(|p| p.key.starts_with(&of_shape));
        let key = of_shape + name;
        let found = Provenance { key, value: toml_text::float(value), unit, origin, assumed: true, plausible: None };
        self.provenance.insert(place.map_or(self.provenance.len(), |place| place + 1), found);
    }
}

pub(crate) fn write(scenario: &Scenario, style: Style<'_>) -> String {
    let mut writer = Writer::new(style);
    sections::scenario(&mut writer, &mut scenario.clone());
    writer.finish()
}
