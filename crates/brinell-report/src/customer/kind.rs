//! Kinds of damage, as ISO 15243:2017 names them.

/// A failure mode of ISO 15243:2017. Whoever has seen the damage states it: vibration does not tell it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DamageKind(usize);

/// How each is given, its subclause, and its name there.
const ALL: [(&str, &str, &str); 14] = [
    ("subsurface-fatigue", "5.1.2", "subsurface initiated fatigue"),
    ("surface-fatigue", "5.1.3", "surface initiated fatigue"),
    ("abrasive-wear", "5.2.2", "abrasive wear"),
    ("adhesive-wear", "5.2.3", "adhesive wear"),
    ("moisture-corrosion", "5.3.2", "moisture corrosion"),
    ("fretting-corrosion", "5.3.3.2", "fretting corrosion"),
    ("false-brinelling", "5.3.3.3", "false brinelling"),
    ("excessive-current", "5.4.2", "excessive current erosion"),
    ("current-leakage", "5.4.3", "current leakage erosion"),
    ("overload", "5.5.2", "overload deformation (true brinelling)"),
    ("particle-indentation", "5.5.3", "indentations from particles"),
    ("forced-fracture", "5.6.2", "forced fracture"),
    ("fatigue-fracture", "5.6.3", "fatigue fracture"),
    ("thermal-cracking", "5.6.4", "thermal cracking"),
];

impl DamageKind {
    /// All, in the order of the standard.
    pub fn all() -> impl ExactSizeIterator<Item = Self> {
        (0..ALL.len()).map(Self)
    }

    /// As it is given: `false-brinelling`.
    pub fn name(self) -> &'static str {
        ALL[self.0].0
    }

    /// With its subclause: `false brinelling (ISO 15243:2017, 5.3.3.3)`.
    pub fn words(self) -> String {
        let (_, clause, name) = ALL[self.0];
        format!("{name} (ISO 15243:2017, {clause})")
    }
}
