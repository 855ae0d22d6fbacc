//! From a file's text to a scenario, and back.

use std::collections::HashMap;

use super::alone::{self, Loaded, write};
use super::problem::{Place, Problem};
use super::provenance::by_key;
use super::spec::unit_of;
use super::tree::{LeftOut, Tree};
use super::writer::{Style, Writer};
use super::{machine, recorded, sections, source};
use crate::scenario::Scenario;

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
    if machine::is_machine(root) { machine::read(text, root) } else { alone::read(text, root) }
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
    /// The scenario as TOML with every default filled in, each assumed value with its reason beside it and in the
    /// section `[provenance]`, so that [`read`] says the same of it.
    pub fn to_toml(&self) -> String {
        let style = || Style { provenance: by_key(&self.provenance), template: false };
        let mut record = Writer::new(style());
        recorded::provenance(&mut record, &mut recorded::of(&self.provenance));
        let text = match &self.scenario.machine {
            Some(of) => machine::write(&self.scenario, of, &self.provenance),
            None => write(&self.scenario, style()),
        };
        text + &record.finish()
    }
}

impl Scenario {
    /// The scenario as TOML with every key given. Where [`Scenario::problems`] finds no error it reads back to the same
    /// scenario, bit for bit, but for fields of `tilting` that do not act: those have their defaults then.
    pub fn to_toml(&self) -> String {
        match &self.machine {
            Some(of) => machine::write(self, of, &[]),
            None => write(self, Style { provenance: HashMap::new(), template: false }),
        }
    }

    /// Everything wrong with a scenario built or changed in code, errors first; keys are those of the file. A field whose key
    /// has no meaning in the present case holds what a file's reader gives it there.
    pub fn problems(&self) -> Vec<Problem> {
        if let Some(of) = &self.machine {
            return match read_tree("", &machine::tree_of(self, of)) {
                Ok(loaded) => loaded.warnings,
                Err(problems) => problems,
            };
        }
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
