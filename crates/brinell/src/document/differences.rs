//! Which set of laws a scenario has, and which keys of it hold something else.

use schemars::JsonSchema;
use serde::Serialize;
use std::fmt;

use super::field::Field;
use super::sections;
use super::spec::Spec;
use super::walk::{Case, Fallback, Keys, Offers, Tables, Walk};
use crate::scenario::{Laws, Scenario};

/// The keys that a set of laws decides.
const OF_THE_SET: [&str; 12] = [
    "simulation.geometry",
    "contact.law",
    "contact.roller_path",
    CONSTANT,
    TIME,
    "contact.roughness_um",
    "contact.edge_radius_um",
    "cage.walls",
    "cage.pockets",
    "cage.friction_coefficient",
    "friction.rolling_coefficient",
    "housing.mass_kg",
];
const TIME: &str = "contact.damping_time_us";
const CONSTANT: &str = "contact.damping_ns_per_m";

/// A key that holds something else than its set of laws has.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Difference {
    /// The key.
    pub key: String,
    /// What it holds, as TOML.
    pub value: String,
    /// What the set has, as TOML; empty where the set has another key in its place.
    pub usual: String,
}

/// A set of laws, and what differs from it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LawsInForce {
    /// The set.
    pub laws: Laws,
    /// The keys that differ, in the file's order.
    pub differences: Vec<Difference>,
}

impl fmt::Display for LawsInForce {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.laws.word())?;
        for (i, Difference { key, value, usual }) in self.differences.iter().enumerate() {
            write!(f, "{} {key} = {value}", if i == 0 { ", but" } else { "," })?;
            if !usual.is_empty() {
                write!(f, " (not {usual})")?;
            }
        }
        Ok(())
    }
}

impl Scenario {
    /// The set of laws that it names, and the keys of contacts, cage, friction, housing and geometry that hold something
    /// else than that set has for this bearing.
    pub fn laws_and_differences(&self) -> LawsInForce {
        let in_machine = self.machine.is_some();
        let mut walk = Differing { path: Vec::new(), laws: self.simulation.laws, in_machine, found: Vec::new() };
        sections::scenario(&mut walk, &mut self.clone());
        LawsInForce { laws: self.simulation.laws, differences: walk.found }
    }
}

/// The walk that compares each key of a set with its default.
struct Differing {
    path: Vec<&'static str>,
    laws: Laws,
    in_machine: bool,
    found: Vec<Difference>,
}

impl Differing {
    fn compare(&mut self, spec: &Spec, fallback: Fallback<&dyn Field>, value: &dyn Field) {
        let key = [&self.path[..], &[spec.name]].concat().join(".");
        // In a machine housings are bodies of their own.
        let is_elsewhere = self.in_machine && key.starts_with("housing.");
        if is_elsewhere || !OF_THE_SET.contains(&key.as_str()) {
            return;
        }
        // Whichever damps, its default says nothing of which does.
        let of_another_set = match key.as_str() {
            TIME => self.laws != Laws::Mechanics,
            CONSTANT => self.laws == Laws::Mechanics,
            _ => false,
        };
        let value = value.write();
        let usual = fallback.value().map_or(String::new(), |usual| usual.write());
        if of_another_set {
            self.found.push(Difference { key, value, usual: String::new() });
        } else if value != usual {
            self.found.push(Difference { key, value, usual });
        }
    }
}

impl Walk for Differing {
    fn at_key(&mut self, spec: Spec, fallback: Fallback<&dyn Field>, value: &mut dyn Field) -> bool {
        self.compare(&spec, fallback, value);
        false
    }

    fn at_optional(&mut self, _: Spec, given: bool, _: &mut dyn Field) -> bool {
        given
    }

    fn at_only_where(&mut self, _: Spec, _: bool, _: &'static str, _: &mut dyn Field) {}

    fn at_key_where(
        &mut self,
        spec: Spec,
        (wanted, _): Case,
        fallback: Fallback<&dyn Field>,
        value: &mut dyn Field,
    ) -> bool {
        wanted && self.at_key(spec, fallback, value)
    }

    fn at_section(&mut self, spec: Spec, keys: &mut dyn FnMut(&mut Keys)) {
        self.path.push(spec.name);
        keys(self);
        self.path.pop();
    }

    fn at_tables(&mut self, _: Spec, _: &mut dyn Tables) {}

    fn at_one_of(&mut self, _: Spec, _: &mut dyn Offers) {}
}
