//! What no single key can say: whether the bearing can exist, the damage fits it, and the run makes sense.
//!
//! Values that could not be read are NaN or 0 here; comparisons are written so that these raise no objection.

mod bearing;
mod contact;
mod damage_files;
mod defects;
mod laws;
mod operation;
mod rates;
mod sensor;
mod shapes;
mod slices;

use std::collections::HashMap;

use super::problem::{Place, Problem, Severity};
use super::problems::{Problems, numberless};
use super::provenance::{Origin, Provenance, by_key};
use super::source::Node;
use super::spec::unit_of;
use crate::scenario::Scenario;
use crate::signal;

/// Finds what the file says of a key, and where.
pub struct Finder<'a> {
    text: &'a str,
    found: &'a HashMap<String, &'a Node>,
    provenance: HashMap<&'a str, &'a Provenance>,
}

impl<'a> Finder<'a> {
    /// Of the keys that a reader found.
    pub fn new(text: &'a str, found: &'a HashMap<String, &'a Node>, provenance: &'a [Provenance]) -> Finder<'a> {
        Finder { text, found, provenance: by_key(provenance) }
    }

    /// Where the file gives a key.
    pub fn place(&self, key: &str) -> Option<Place> {
        let span = self.found.get(key)?.span.clone()?;
        Some(Place::new(self.text, span))
    }

    /// Whether the file or an override gives the key.
    fn is_given(&self, key: &str) -> bool {
        self.found.contains_key(key)
    }

    fn value(&self, key: &str) -> Option<String> {
        let found = self.found.get(key).map(|node| node.brief());
        found.or_else(|| self.provenance.get(key).map(|entry| entry.value.clone()))
    }

    /// A problem with its unit, value and places, and those of the other keys that take part.
    pub(in super::super) fn complete(&self, mut problem: Problem, also: &[&str]) -> Problem {
        let unit = unit_of(problem.key.rsplit('.').next().unwrap_or_default());
        problem = problem.unit(unit);
        problem.value = self.value(&problem.key);
        problem.also = also.iter().map(|key| (key.to_string(), self.place(key))).collect();
        // A key that nobody gives is at fault through the ones that the file gives; an override is at fault itself.
        let place = match self.is_given(&problem.key) {
            true => self.place(&problem.key),
            false => also.iter().find_map(|key| self.place(key)),
        };
        problem.at(place)
    }

    fn is_preset(&self, key: &str) -> bool {
        self.provenance.get(key).is_some_and(|entry| matches!(entry.origin, Origin::Preset { .. }))
    }
}

/// Gathers the problems of one scenario.
struct Checker<'a> {
    s: &'a Scenario,
    finder: &'a Finder<'a>,
    problems: Problems<'a>,
}

impl Checker<'_> {
    fn add(&mut self, severity: Severity, key: &str, message: String, allowed: String, also: &[&str]) {
        let kind = numberless(key) + &numberless(&message);
        let finder = self.finder;
        self.problems.add_of(severity, kind, || {
            let problem = Problem::new(severity, key, message).allowed(allowed);
            (finder.complete(problem, also), None)
        });
    }

    fn error(&mut self, key: &str, message: String, allowed: String, also: &[&str]) {
        self.add(Severity::Error, key, message, allowed, also);
    }

    fn warn(&mut self, key: &str, message: String, allowed: String, also: &[&str]) {
        self.add(Severity::Warning, key, message, allowed, also);
    }
}

/// Adds what is wrong to the problems of the reader.
pub(crate) fn check<'a>(scenario: &'a Scenario, finder: &'a Finder<'a>, problems: Problems<'a>) -> Problems<'a> {
    let mut checker = Checker { s: scenario, finder, problems };
    checker.laws();
    checker.bearing();
    checker.cage();
    checker.contact();
    checker.slices();
    checker.operation();
    checker.speed_factor();
    checker.overload();
    checker.support();
    checker.rates();
    checker.defects();
    checker.sensor();
    checker.simulation();
    checker.problems
}

/// A number in a message: four figures are enough, without zeros at the end.
fn short(x: f64) -> String {
    let text = signal::short(x, 4);
    if text.contains('.') && !text.contains('e') {
        text.trim_end_matches('0').trim_end_matches('.').into()
    } else {
        text
    }
}
