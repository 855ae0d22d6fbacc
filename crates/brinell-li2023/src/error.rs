//! What can go wrong.

use brinell::document::Problem;
use brinell_io::IoError;
use std::io;
use std::path::PathBuf;

/// Why a reproduction cannot be made or written.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// [`crate::BASE`] with settings over it is no scenario.
    #[error("the paper's scenario: {}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    Scenario(Vec<Problem>),
    /// A folder cannot be made.
    #[error("cannot make the folder {}: {source}", folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// A file cannot be written.
    #[error(transparent)]
    Io(#[from] IoError),
}
