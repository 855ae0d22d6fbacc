//! What is wrong with a scenario file, said so that its author can mend it.

use std::borrow::Cow;
use std::fmt;
use std::ops::Range;

/// Whether a run can start in spite of the problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// The scenario cannot run.
    Error,
    /// The scenario runs, and its author should know.
    Warning,
}

/// Where in the file something is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// Bytes of the text.
    pub span: Range<usize>,
}

impl Place {
    /// Finds line and column of a byte range of `text`; a range that leaves the text is cut.
    pub(crate) fn new(text: &str, span: Range<usize>) -> Place {
        let floor = |mut offset: usize| {
            offset = offset.min(text.len());
            while !text.is_char_boundary(offset) {
                offset -= 1;
            }
            offset
        };
        let start = floor(span.start);
        let end = floor(span.end).max(start);
        let before = &text[..start];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        Place {
            line: before.bytes().filter(|byte| *byte == b'\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
            span: start..end,
        }
    }
}

/// One thing wrong with a scenario.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// Error or warning.
    pub severity: Severity,
    /// Path of the key, `bearing.pitch_diameter_mm` or `defects.0.depth_um`; empty where the file is not TOML.
    pub key: String,
    /// What is wrong, without key and place.
    pub message: String,
    /// The value found.
    pub value: Option<String>,
    /// What would be accepted.
    pub allowed: Option<String>,
    /// Unit of value and range.
    pub unit: Option<&'static str>,
    /// Line, from 1; none where the key is not in the file.
    pub line: Option<usize>,
    /// Column in characters, from 1.
    pub column: Option<usize>,
    /// Bytes of the file that are at fault.
    pub span: Option<Range<usize>>,
    /// Other keys that take part, with their places.
    pub also: Vec<(String, Option<Place>)>,
    /// How many it represents: more than one where those of its kind are too many to be printed one by one.
    pub count: usize,
}

impl Problem {
    pub(crate) fn new(severity: Severity, key: impl Into<String>, message: impl Into<String>) -> Problem {
        Problem {
            severity,
            key: key.into(),
            message: message.into(),
            value: None,
            allowed: None,
            unit: None,
            line: None,
            column: None,
            span: None,
            also: Vec::new(),
            count: 1,
        }
    }

    /// That is wrong.
    pub fn error(key: impl Into<String>, message: impl Into<String>) -> Problem {
        Problem::new(Severity::Error, key, message)
    }

    /// That its author should know.
    pub fn warning(key: impl Into<String>, message: impl Into<String>) -> Problem {
        Problem::new(Severity::Warning, key, message)
    }

    /// Of a file that a key names and that cannot be used.
    pub fn of_file(key: &str, file: &str, message: &str) -> Problem {
        Problem::error(key, message).value(super::toml_text::quote(file))
    }

    /// The value at fault.
    #[must_use]
    pub fn value(mut self, value: impl Into<String>) -> Problem {
        self.value = Some(value.into());
        self
    }

    /// What would be right; nothing where that is empty.
    #[must_use]
    pub fn allowed(mut self, allowed: impl Into<String>) -> Problem {
        self.allowed = Some(allowed.into()).filter(|text: &String| !text.is_empty());
        self
    }

    pub(crate) fn unit(mut self, unit: &'static str) -> Problem {
        self.unit = Some(unit).filter(|unit| !unit.is_empty());
        self
    }

    /// At a place of the text.
    #[must_use]
    pub fn at(mut self, place: Option<Place>) -> Problem {
        if let Some(place) = place {
            self.line = Some(place.line);
            self.column = Some(place.column);
            self.span = Some(place.span);
        }
        self
    }

    /// Orders problems as the file reads; those without a line come last.
    pub(crate) fn order(&self) -> (Severity, usize, usize) {
        (self.severity, self.line.unwrap_or(usize::MAX), self.column.unwrap_or(usize::MAX))
    }
}

/// Number of the defect, from 1, that a key is about: 1 for `defects.0.depth_um`, whose path counts from 0 as every
/// list's does.
fn defect_number(key: &str) -> Option<usize> {
    let index = key.strip_prefix("defects.")?.split('.').next()?;
    index.parse::<usize>().ok()?.checked_add(1)
}

/// Characters of a key, a value or a word that are shown.
const SHOWN: usize = 200;

/// The first `most` characters: a file may hold a key of megabytes.
pub(super) fn cut(text: &str, most: usize) -> Cow<'_, str> {
    match text.char_indices().nth(most) {
        Some((end, _)) => format!("{}...", &text[..end]).into(),
        None => text.into(),
    }
}

/// A message may quote what the file holds.
fn cut_words(message: &str) -> String {
    let words: Vec<_> = message.split(' ').map(|word| cut(word, SHOWN)).collect();
    cut(&words.join(" "), 10 * SHOWN).into_owned()
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.severity {
            Severity::Error => write!(f, "error")?,
            Severity::Warning => write!(f, "warning")?,
        }
        if let Some(line) = self.line {
            write!(f, ", line {line}")?;
        }
        write!(f, ": ")?;
        if !self.key.is_empty() {
            write!(f, "{}", cut(&self.key, SHOWN))?;
            if let Some(value) = &self.value {
                write!(f, " = {}", cut(value, SHOWN))?;
            }
            if let Some(number) = defect_number(&self.key) {
                write!(f, " (defect {number})")?;
            }
            write!(f, ": ")?;
        }
        write!(f, "{}", cut_words(&self.message))?;
        if let Some(allowed) = &self.allowed {
            let word = match self.severity {
                Severity::Error => "allowed",
                Severity::Warning => "advised",
            };
            write!(f, "\n  {word}: {allowed}")?;
            // The words may hold the unit already.
            let said = |unit: &&str| allowed.split([' ', ',', ';']).any(|word| word == *unit);
            match self.unit.filter(|unit| !said(unit)) {
                Some(unit) if allowed.starts_with(char::is_alphabetic) => write!(f, ", in {unit}")?,
                Some(unit) => write!(f, " {unit}")?,
                None => {}
            }
        }
        let mut lead = "\n  see also: ";
        for (key, place) in &self.also {
            write!(f, "{lead}{}", cut(key, SHOWN))?;
            if let Some(place) = place {
                write!(f, " (line {})", place.line)?;
            }
            lead = ", ";
        }
        Ok(())
    }
}

impl std::error::Error for Problem {}
