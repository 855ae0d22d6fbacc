//! What can go wrong with a data set.

use brinell::document::Problem;
use brinell_io::IoError;
use std::io;
use std::path::PathBuf;

/// Why a data set is not what was requested.
#[derive(Debug, thiserror::Error)]
pub enum DatasetError {
    /// The plan or its base scenario is bad; name and text of the file are for pointing at lines.
    #[error("{}", problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))]
    Document {
        /// The file.
        name: String,
        /// What it holds.
        text: String,
        /// What is wrong with it.
        problems: Vec<Problem>,
    },
    /// A folder that this cannot be done in, or a plan that cannot be done.
    #[error("{0}")]
    Refused(String),
    /// A file cannot be read.
    #[error("cannot read {}: {}", path.display(), brinell_io::why_unread(error))]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's error.
        error: io::Error,
    },
    /// A folder of the data set cannot be made.
    #[error("cannot make the folder {}: {error}", path.display())]
    NoFolder {
        /// The folder.
        path: PathBuf,
        /// The system's error.
        error: io::Error,
    },
    /// A file of the data set cannot be written or read.
    #[error(transparent)]
    Io(#[from] IoError),
}
