//! A labelled value.

use crate::number::significant;

/// A number, or words where no number will do.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A quantity in the unit beside it.
    Number(f64),
    /// A word or a phrase.
    Text(String),
}

impl Value {
    /// As it is read, a number with so many significant digits.
    pub(crate) fn words(&self, digits: usize) -> String {
        match self {
            Self::Number(number) => significant(*number, digits),
            Self::Text(text) => text.clone(),
        }
    }
}

impl From<f64> for Value {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<&str> for Value {
    fn from(value: &str) -> Self {
        Self::Text(value.to_owned())
    }
}

impl From<String> for Value {
    fn from(value: String) -> Self {
        Self::Text(value)
    }
}

/// One labelled value: a headline number, a line of the audit, the slip of a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Fact {
    /// What it is.
    pub label: String,
    /// How much.
    pub value: Value,
    /// In what; empty where it has no unit.
    pub unit: String,
    /// What to know about it; may be empty.
    pub note: String,
    /// Whether it kept its limit, where it has one.
    pub ok: Option<bool>,
}

impl Fact {
    /// It in a sentence, with the first part of its note.
    pub fn words(&self) -> String {
        let value = self.value.words(4);
        let note = self.note.split(';').next().unwrap_or_default();
        let parts = [value.as_str(), &self.unit, note];
        let parts: Vec<&str> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        // A value that begins with a run's name: "rectangle: 4.1 ×".
        let joint = if value.contains(": ") { ", " } else { ": " };
        format!("{}{joint}{}.", self.label, parts.join(" "))
    }

    /// A fact without limit.
    pub fn new(
        label: impl Into<String>,
        value: impl Into<Value>,
        unit: impl Into<String>,
        note: impl Into<String>,
    ) -> Self {
        Self { label: label.into(), value: value.into(), unit: unit.into(), note: note.into(), ok: None }
    }

    /// The same fact, judged against its limit.
    #[must_use]
    pub fn judged(mut self, ok: bool) -> Self {
        self.ok = Some(ok);
        self
    }
}
