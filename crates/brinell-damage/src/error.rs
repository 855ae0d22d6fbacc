//! What can be wrong with a file of damage, and what to do about it.

use crate::kind::FileKind;

/// An error about one file of damage: what, where, the value, what is allowed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DamageError {
    /// An option outside its range.
    #[error("`{option}` is {value}; it must be {allowed}")]
    Option {
        /// The option's name.
        option: &'static str,
        /// The value given.
        value: String,
        /// What may be there.
        allowed: &'static str,
    },
    /// The file's content is not what its name, or the caller, says.
    #[error(
        "this should be {expected}, but its content is {}; correct the name or choose the right file",
        found.map_or("no format known here".to_owned(), |kind| kind.to_string())
    )]
    NotWhatItsNameSays {
        /// What was expected.
        expected: FileKind,
        /// What the first bytes say, where known.
        found: Option<FileKind>,
    },
    /// A format that no reader here takes.
    #[error("{what} cannot be read as {wanted}; {way_out}")]
    WrongKind {
        /// What the content is.
        what: String,
        /// What was requested.
        wanted: &'static str,
        /// What to do.
        way_out: &'static str,
    },
    /// Broken or cut-off content.
    #[error("this {kind} file is broken at {at}: {why}")]
    Broken {
        /// The format.
        kind: FileKind,
        /// Where in the file.
        at: String,
        /// What is wrong.
        why: String,
    },
    /// Something valid that is not understood here.
    #[error("{at}: {what} is not understood; {way_out}")]
    Unsupported {
        /// Where in the file.
        at: String,
        /// What is there.
        what: String,
        /// What to do.
        way_out: &'static str,
    },
    /// More than this reader takes.
    #[error("{what} is {value}, more than the {limit} that are read; {way_out}")]
    TooLarge {
        /// What is too large.
        what: &'static str,
        /// Its size.
        value: String,
        /// The largest size that is read.
        limit: String,
        /// What to do.
        way_out: &'static str,
    },
    /// The file has no damage in it.
    #[error("there is no damage in it: {why}")]
    NothingDamaged {
        /// How that was found.
        why: String,
    },
    /// A photo in which nothing is damage for certain.
    #[error("no spall found: {why}")]
    NoSpall {
        /// How that was found, and what would help.
        why: String,
    },
    /// All of it is damage.
    #[error("all of it would be damage: {why}")]
    AllDamaged {
        /// How that was found.
        why: String,
    },
    /// A drawing without a physical size.
    #[error("the drawing has no scale: {why}; give `mm_per_unit`")]
    NoScale {
        /// What is missing.
        why: String,
    },
    /// An id that the drawing does not have.
    #[error("the drawing has no element with the id `{id}`; {known}")]
    NoSuchId {
        /// The id requested.
        id: String,
        /// Some ids that it has.
        known: String,
    },
    /// An unfilled line whose ends do not meet.
    #[error("{at}: the line is open by {gap_mm:.4} mm (at most {tolerance_mm} mm is closed); join its ends or fill it")]
    OpenOutline {
        /// The element.
        at: String,
        /// The distance between its ends.
        gap_mm: f64,
        /// The largest gap that is closed without a word.
        tolerance_mm: f64,
    },
    /// Lines that cross too often to be an outline.
    #[error("{at}: {why}; save the damage's outline alone, without lines that cross")]
    Tangled {
        /// The element.
        at: String,
        /// How often.
        why: String,
    },
    /// A value of a table that is no number.
    #[error("line {line}, column {column}: `{text}` is not a number; a missing point is an empty cell or `nan`")]
    NotANumber {
        /// The line, from 1.
        line: usize,
        /// The column, from 1.
        column: usize,
        /// The value as written, cut to a few words.
        text: String,
    },
    /// A line of a table with another number of values.
    #[error("line {line} has {got} values where the first row has {expected}")]
    RowLength {
        /// The line, from 1.
        line: usize,
        /// Values of the first row.
        expected: usize,
        /// Values of this line.
        got: usize,
    },
    /// Points without a value, and no leave to fill them.
    #[error("{count} of {total} points are missing (the first in row {row}, column {column}); {way_out}")]
    MissingPoints {
        /// How many.
        count: usize,
        /// Points of the grid.
        total: usize,
        /// The first one's row in the file, from 1.
        row: usize,
        /// The first one's column in the file, from 1.
        column: usize,
        /// What to do.
        way_out: &'static str,
    },
    /// A plane or cylinder that cannot be fitted.
    #[error("the {form} cannot be fitted: {why}")]
    NoFit {
        /// The form requested.
        form: &'static str,
        /// What is in the way.
        why: String,
    },
}

/// An option that must be a number above `low` and at most `high`.
pub(crate) fn check_range(
    option: &'static str,
    value: f64,
    low: f64,
    high: f64,
    allowed: &'static str,
) -> Result<(), DamageError> {
    if value > low && value <= high {
        return Ok(());
    }
    Err(DamageError::Option { option, value: value.to_string(), allowed })
}

/// A few words of a file's text, fit for a message.
pub(crate) fn excerpt(text: &str) -> String {
    let mut short: String = text.chars().filter(|c| !c.is_control()).take(24).collect();
    if short.len() < text.len() {
        short.push_str("...");
    }
    short
}
