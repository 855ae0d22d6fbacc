//! What can go wrong with a file, and what to do about it.

use crate::file_kind::FileKind;
use std::io;
use std::path::{Path, PathBuf};

/// An error about one file. Its text names the file and, where there is one, the way out.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum IoError {
    /// No room on the disk, or in the quota.
    #[error("{}: the disk is full; free some space or write to another disk (the unfinished file is removed)", path.display())]
    DiskFull {
        /// The file being written.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// The file or its folder may not be written.
    #[error("{}: writing is not permitted here; choose a folder that you may write to", path.display())]
    NotPermitted {
        /// The file being written.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// The folder is missing, or is a file.
    #[error("{}: there is no such folder as {}; create it first", path.display(), path.parent().unwrap_or(path).display())]
    NoFolder {
        /// The file to be written.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// The name is that of a folder, or ends in `..`.
    #[error("{}: this is a folder, or no name at all; give the name of a file", path.display())]
    NotAFileName {
        /// The path as given.
        path: PathBuf,
    },
    /// Another writer has the file in hand.
    #[error("{}: another run is writing this file; wait for it or choose another folder", path.display())]
    Busy {
        /// The file to be written.
        path: PathBuf,
    },
    /// Any other failure to write.
    #[error("{}: cannot write: {source}", path.display())]
    Write {
        /// The file being written.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// A row or the end was given to a writer that had already failed.
    #[error("{}: an earlier write failed, so this file cannot be completed; run again", path.display())]
    AlreadyFailed {
        /// The file being written.
        path: PathBuf,
    },
    /// A failure to read.
    #[error("{}: cannot read: {}", path.display(), why_unread(source))]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// A table needs a column.
    #[error("{}: there are no columns to write; record at least one channel", path.display())]
    NoColumns {
        /// The file to be written.
        path: PathBuf,
    },
    /// A column's name would not survive.
    #[error("{}: the column name `{name}` cannot be used: {why}", path.display())]
    ColumnName {
        /// The file to be written.
        path: PathBuf,
        /// The name.
        name: String,
        /// What is wrong with it.
        why: &'static str,
    },
    /// A metadata key that the writer fills in itself.
    #[error("{}: the metadata key `{key}` is filled in by the writer; use another key", path.display())]
    ReservedKey {
        /// The file to be written.
        path: PathBuf,
        /// The key.
        key: String,
    },
    /// A row of the wrong length.
    #[error("{}: a row has {got} values for {expected} columns", path.display())]
    RowLength {
        /// The file being written.
        path: PathBuf,
        /// Columns of the file.
        expected: usize,
        /// Values of the row.
        got: usize,
    },
    /// A format that is not among [`crate::Format::ALL`].
    #[error("unknown signal format `{0}`; known are csv, parquet, mat, npz, uff58 and wav")]
    UnknownFormat(String),
    /// A format that this build does not have.
    #[error("{}: this build has no {format}; build with the feature `{format}` or choose csv", path.display())]
    FormatLeftOut {
        /// The file to be written.
        path: PathBuf,
        /// The format's name, and that of the cargo feature that brings it.
        format: &'static str,
    },
    /// A CSV value that is no number.
    #[error("{}: line {line}, column `{column}`: `{text}` is not a number", path.display())]
    CsvNumber {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: u64,
        /// The column's name.
        column: String,
        /// The value as written, cut to a few words.
        text: String,
    },
    /// A decimal point in a text file that has decimal commas, where points are between groups of three digits.
    #[error("{}: line {line}, column `{column}`: `{text}` has a decimal point, and the file has decimal commas; write one of them throughout", path.display())]
    DecimalPoint {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: u64,
        /// The column's name.
        column: String,
        /// The value as written.
        text: String,
    },
    /// A line of a text file with more or fewer values than the others.
    #[error("{}: line {line} has {got} values where the first line of numbers has {expected}", path.display())]
    TextRow {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: u64,
        /// Values of the first line.
        expected: usize,
        /// Values of this line.
        got: usize,
    },
    /// A second header among the numbers of a LabVIEW measurement file.
    #[error("{}: on line {line} a second segment begins, a recording with a header of its own; save each segment as a file", path.display())]
    Segment {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: u64,
    },
    /// A file of no bytes.
    #[error("{}: the file is empty", path.display())]
    EmptyFile {
        /// The file.
        path: PathBuf,
    },
    /// The name promises one format and the content shows another.
    #[error("{}: named like {name_says}, but the content is {content_is}; rename it or save it again", path.display())]
    Mislabelled {
        /// The file.
        path: PathBuf,
        /// The format that the extension promises.
        name_says: &'static str,
        /// What the first bytes show.
        content_is: String,
    },
    /// A file that is none of the formats that can be read.
    #[error("{}: cannot read: {what}; known are {}", path.display(), FileKind::known())]
    UnknownContent {
        /// The file.
        path: PathBuf,
        /// What it looks like.
        what: &'static str,
    },
    /// A file whose bytes contradict its format.
    #[error("{}: damaged {kind} file: {why}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The format.
        kind: crate::FileKind,
        /// What is wrong.
        why: String,
    },
    /// A file that is sound and beyond what is read.
    #[error("{}: cannot read: {why}", path.display())]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// What is not read.
        why: String,
    },
    /// A name that is not in the file.
    #[error("{}: there is no `{name}`; there are {names}", path.display())]
    NoChannel {
        /// The file.
        path: PathBuf,
        /// The name requested.
        name: String,
        /// The names that are there, some of them where there are many.
        names: String,
    },
    /// Nothing in the file may be a signal.
    #[error("{}: nothing here is a signal; there are {found}", path.display())]
    NoSignal {
        /// The file.
        path: PathBuf,
        /// What is there.
        found: String,
    },
    /// More than one channel may be the signal.
    #[error("{}: several channels may be the signal; name one of {names}", path.display())]
    SeveralSignals {
        /// The file.
        path: PathBuf,
        /// Their names, some of them where there are many.
        names: String,
    },
    /// A channel too long to be read whole.
    #[error("{}: `{name}` has more than {limit} values; read it piece by piece", path.display())]
    TooLong {
        /// The file.
        path: PathBuf,
        /// The channel.
        name: String,
        /// The most values that are read at once.
        limit: u64,
    },
    /// Something that a format needs is missing or beyond it.
    #[error("{}: {format} cannot hold this: {why}", path.display())]
    NotWritable {
        /// The file to be written.
        path: PathBuf,
        /// The format.
        format: &'static str,
        /// What is wrong.
        why: String,
    },
    /// A journal with a line that is not one of its own.
    #[error("{}: line {line} is no line of a journal: {why}; {}", path.display(), without(*line))]
    Journal {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// What the parser said.
        why: String,
    },
    /// A damaged or unsupported Parquet file.
    #[error("{}: cannot read this Parquet file: {why}", path.display())]
    Parquet {
        /// The file.
        path: PathBuf,
        /// What the reader said.
        why: String,
    },
}

/// What to do about a damaged line of a journal.
fn without(line: usize) -> &'static str {
    match line {
        1 => "choose another folder, or remove the file, and all is made again",
        _ => "remove the line, and what it holds is made again",
    }
}

impl IoError {
    /// Whether it is about one line of a text file, which [`crate::SignalFile::read_around`] takes as a missing value.
    pub fn is_of_a_line(&self) -> bool {
        self.is_of_a_row() || matches!(self, Self::CsvNumber { .. } | Self::DecimalPoint { .. })
    }

    /// Whether such a line is no row of the table: it has another number of cells, or begins another segment.
    pub(crate) fn is_of_a_row(&self) -> bool {
        matches!(self, Self::TextRow { .. } | Self::Segment { .. })
    }

    /// Sorts a system error met while writing `path` by what its reader can do about it.
    pub(crate) fn writing(path: &Path, source: io::Error) -> Self {
        use io::ErrorKind as K;
        let path = path.to_owned();
        match source.kind() {
            K::StorageFull | K::QuotaExceeded => Self::DiskFull { path, source },
            K::PermissionDenied | K::ReadOnlyFilesystem => Self::NotPermitted { path, source },
            // Some folders, as /proc, take no files.
            K::NotFound if path.parent().is_some_and(Path::is_dir) => Self::Write { path, source },
            K::NotFound | K::NotADirectory => Self::NoFolder { path, source },
            K::IsADirectory => Self::NotAFileName { path },
            _ => Self::Write { path, source },
        }
    }

    /// A system error met while reading `path`.
    pub(crate) fn reading(path: &Path, source: io::Error) -> Self {
        Self::Read { path: path.to_owned(), source }
    }
}

/// Why a file cannot be read, without the system's number where words say it.
pub fn why_unread(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".into(),
        io::ErrorKind::IsADirectory => "it is a folder; expected a file".into(),
        _ => error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_errors_say_which_file_and_what_to_do() {
        let say = |kind: io::ErrorKind| IoError::writing(Path::new("out/signals.csv"), kind.into()).to_string();
        assert_eq!(
            say(io::ErrorKind::StorageFull),
            "out/signals.csv: the disk is full; free some space or write to another disk (the unfinished file is removed)"
        );
        assert_eq!(
            say(io::ErrorKind::PermissionDenied),
            "out/signals.csv: writing is not permitted here; choose a folder that you may write to"
        );
        assert_eq!(say(io::ErrorKind::NotFound), "out/signals.csv: there is no such folder as out; create it first");
        let there = IoError::writing(&std::env::temp_dir().join("x.toml"), io::ErrorKind::NotFound.into());
        assert!(there.to_string().contains("x.toml: cannot write: "), "{there}");
    }
}
