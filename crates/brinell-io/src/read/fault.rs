//! What a reader says when it cannot go on; [`crate::SignalFile`] adds the path.

use std::io;

/// Why a reader stopped.
#[derive(Debug)]
pub(crate) enum Fault {
    /// The system's error; an early end is reported as damage.
    Io(io::Error),
    /// The receiver of the values wanted no more.
    Stopped,
    /// The bytes contradict the format.
    Damaged(String),
    /// Sound, and beyond this reader.
    Unsupported(String),
    /// A value of a text file that is no number.
    Number { line: u64, column: String, text: String },
    /// One with a decimal point, in a file of decimal commas.
    Point { line: u64, column: String, text: String },
    /// A line of a text file with more or fewer values than the lines above it.
    Row { line: u64, expected: usize, got: usize },
    /// A line without a number among those of one column; it is blank or a comment.
    Between { line: u64, blank: bool },
    /// A header among the numbers of a LabVIEW file: a further segment.
    Segment { line: u64 },
}

impl Fault {
    /// The same, so many lines further down.
    pub(crate) fn after(mut self, lines: u64) -> Self {
        if let Self::Number { line, .. }
        | Self::Point { line, .. }
        | Self::Row { line, .. }
        | Self::Between { line, .. }
        | Self::Segment { line } = &mut self
        {
            *line += lines;
        }
        self
    }
}

impl From<io::Error> for Fault {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::UnexpectedEof => Self::Damaged("the file ends early".into()),
            // What the decompressors say of their input.
            io::ErrorKind::InvalidData | io::ErrorKind::InvalidInput => Self::Damaged(error.to_string()),
            _ => Self::Io(error),
        }
    }
}

/// A [`Fault::Damaged`].
pub(crate) fn damaged(why: impl Into<String>) -> Fault {
    Fault::Damaged(why.into())
}

/// A [`Fault::Unsupported`].
pub(crate) fn unsupported(why: impl Into<String>) -> Fault {
    Fault::Unsupported(why.into())
}
