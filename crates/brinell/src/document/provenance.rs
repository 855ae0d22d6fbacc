//! Where every value of a run comes from: the assumption sheet.

use std::collections::HashMap;

/// Name of the section of a scenario file that records it.
pub(super) const SECTION: &str = "provenance";

/// Who gave a value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Origin {
    /// The scenario file.
    File,
    /// An override of the scenario file.
    Override,
    /// The catalogue bearing.
    Preset {
        /// Where the catalogue has it from.
        source: String,
        /// True where the catalogue itself estimates it.
        estimated: bool,
    },
    /// A file that the scenario names, beside it.
    DamageFile(String),
    /// Found in such a file; says how.
    Found(String),
    /// Computed from other keys; says how.
    Derived(&'static str),
    /// Fixed default; says why.
    Default(&'static str),
    /// A written scenario that says the value was assumed; why, in the words of its `[provenance]`.
    Recorded(String),
}

/// Origin of one key's value.
#[derive(Debug, Clone, PartialEq)]
pub struct Provenance {
    /// Path of the key, `defects.0.depth_um`.
    pub key: String,
    /// The value as TOML.
    pub value: String,
    /// Unit, empty where there is none.
    pub unit: &'static str,
    /// Who gave it.
    pub origin: Origin,
    /// True where neither the user nor a cited source states the value.
    pub assumed: bool,
    /// Between which values it may lie, where it is assumed and a number of which that can be said.
    pub plausible: Option<[f64; 2]>,
}

impl Provenance {
    /// One line on where the value comes from.
    pub fn reason(&self) -> String {
        match &self.origin {
            Origin::File => "scenario file".into(),
            Origin::Override => "override".into(),
            Origin::Preset { source, estimated: false } => format!("catalogue: {source}"),
            Origin::Preset { source, estimated: true } => format!("catalogue estimate: {source}"),
            Origin::DamageFile(file) => format!("read from {file}"),
            Origin::Derived(how) => format!("derived: {how}"),
            Origin::Default(why) => format!("default: {why}"),
            Origin::Found(reason) | Origin::Recorded(reason) => reason.clone(),
        }
    }
}

/// Provenance by the path of the key.
pub(crate) fn by_key(provenance: &[Provenance]) -> HashMap<&str, &Provenance> {
    provenance.iter().map(|entry| (entry.key.as_str(), entry)).collect()
}
