//! A thing that is known of a signal, by whom, and how surely.

use std::fmt;

/// Who says it.
#[derive(Debug, Clone, PartialEq)]
pub enum Source {
    /// Whoever asked.
    Given,
    /// The file, there: its header, a variable, a column of times, the scenario of the run that made it.
    File(String),
    /// Nobody: it is taken as that of the signal to which this one is compared.
    Like,
    /// Nobody: it is the only one, or brinell's own custom.
    Assumed,
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Given => f.write_str("as given"),
            Self::File(place) => write!(f, "from {place}"),
            Self::Like => f.write_str("as the first signal's"),
            Self::Assumed => f.write_str("assumed"),
        }
    }
}

/// A value with its source.
#[derive(Debug, Clone, PartialEq)]
pub struct Known<T> {
    /// The value.
    pub value: T,
    /// Who says it.
    pub source: Source,
    /// Where it comes from: sentences.
    pub notes: Vec<String>,
    /// What contradicts it, or may be meant otherwise: sentences.
    pub doubts: Vec<String>,
}

impl<T> Known<T> {
    /// Of this source, without a doubt.
    pub fn by(value: T, source: Source) -> Self {
        Self { value, source, notes: Vec::new(), doubts: Vec::new() }
    }

    pub(crate) fn noted(mut self, note: impl Into<Option<String>>) -> Self {
        self.notes.extend(note.into());
        self
    }

    pub(crate) fn doubted(mut self, doubt: impl Into<Option<String>>) -> Self {
        self.doubts.extend(doubt.into());
        self
    }
}
