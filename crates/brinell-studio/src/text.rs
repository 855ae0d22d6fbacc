//! Scenarios as text and as JSON, and what is wrong with them.

use crate::answers::Cause;
use crate::report::{Answer, Trouble};
use brinell::Error;
use brinell::document::{self, Loaded, Problem, Severity};
use serde_json::Value;

/// The scenario of a request, as TOML.
///
/// # Errors
/// Where there is none, or what is given as JSON has no place in TOML.
pub(crate) fn of_request(request: &Value) -> Answer<String> {
    match (request.get("toml"), request.get("scenario")) {
        (Some(Value::String(text)), _) => Ok(text.clone()),
        (_, Some(stated)) => of_stated(stated),
        _ => Err(Trouble::of("a scenario is missing: \"toml\" or \"scenario\"")),
    }
}

/// Stated keys as TOML.
pub(crate) fn of_stated(keys: &Value) -> Answer<String> {
    toml::to_string(keys).map_err(|e| Trouble::of(format!("not a scenario: {e}")))
}

/// The keys that a text states, as JSON.
pub(crate) fn stated(text: &str) -> Value {
    let table = toml::from_str::<toml::Table>(text).unwrap_or_default();
    serde_json::to_value(table).unwrap_or_default()
}

/// A text with nothing but its keys: however a scenario comes, the same keys give the same bytes.
pub(crate) fn plain(text: &str) -> Answer<String> {
    of_stated(&stated(text))
}

/// Reads a scenario.
pub(crate) fn read(text: &str) -> Answer<Loaded> {
    let loaded = document::read(text, &[]).map_err(|problems| Trouble::all(&problems))?;
    if loaded.scenario.machine.is_some() {
        return Err(Trouble::of(
            "the studio runs one bearing, and this is a machine: `brinell run` simulates it, and its page shows it",
        ));
    }
    Ok(loaded)
}

impl Trouble {
    /// One problem of no key.
    pub(crate) fn of(message: impl Into<String>) -> Self {
        Self(vec![Cause { key: None, line: None, message: message.into() }])
    }

    /// The errors of a scenario.
    fn all(problems: &[Problem]) -> Self {
        let errors = problems.iter().filter(|p| p.severity == Severity::Error);
        Self(errors.map(problem).collect())
    }
}

impl From<Error> for Trouble {
    fn from(error: Error) -> Self {
        match error {
            Error::Scenario(problems) => Self::all(&problems),
            other => Self::of(other.to_string()),
        }
    }
}

/// A problem as the page shows it: beside its key.
fn problem(p: &Problem) -> Cause {
    Cause { key: (!p.key.is_empty()).then(|| counted(&p.key)), line: p.line, message: words(p) }
}

/// A path with list items as a reader counts them: `defects.0.depth_um` is `defects[1].depth_um`.
fn counted(key: &str) -> String {
    let mut path = String::new();
    for part in key.split('.') {
        match part.parse::<usize>() {
            Ok(index) => path.push_str(&format!("[{}]", index + 1)),
            Err(_) if path.is_empty() => path.push_str(part),
            Err(_) => path.extend([".", part]),
        }
    }
    path
}

/// A problem in the library's words, in one line, without its severity.
pub(crate) fn words(p: &Problem) -> String {
    let text = p.to_string();
    let said = text.split_once(": ").map_or(text.as_str(), |(_, said)| said);
    said.replace("\n  ", "; ")
}
