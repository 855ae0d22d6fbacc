//! A journal: lines of JSON that are on the disk when [`Journal::append`] returns.
//!
//! Lines are only ever added. A line that a killed process left unfinished is the last one and has no end; it is cut
//! off when the journal is opened again, and everything before it counts. The first line is an object: a file that
//! begins otherwise is somebody else's, and stays as it is. One process at a time has a journal open.

use crate::IoError;
use crate::atomic::lock;
use serde_json::Value;
use std::fs::{File, OpenOptions};
use std::io::{ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// A journal that is open for more.
#[derive(Debug)]
pub struct Journal {
    file: File,
    path: PathBuf,
    failed: bool,
}

impl Journal {
    /// Opens the journal, or starts one, and gives the lines that are in it.
    ///
    /// # Errors
    /// Where another process has it open, it cannot be read or written, or a line that has its end is no JSON.
    pub fn open(path: impl AsRef<Path>) -> Result<(Self, Vec<Value>), IoError> {
        let path = path.as_ref();
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(path)
            .map_err(|e| IoError::writing(path, e))?;
        lock(&file, path)?;
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(|e| IoError::reading(path, e))?;
        let (lines, good) = whole_lines(path, &bytes)?;
        let mut cut = || {
            if good < bytes.len() {
                file.set_len(good as u64)?;
                file.sync_all()?;
            }
            file.seek(SeekFrom::Start(good as u64))
        };
        cut().map_err(|e| IoError::writing(path, e))?;
        let journal = Self { file, path: path.to_owned(), failed: false };
        Ok((journal, lines))
    }

    /// The lines that are in a journal, which stays as it is, whoever has it open; none where there is no file.
    ///
    /// # Errors
    /// Where it cannot be read, or a line that has its end is no JSON.
    pub fn read(path: impl AsRef<Path>) -> Result<Vec<Value>, IoError> {
        let path = path.as_ref();
        match std::fs::read(path) {
            Ok(bytes) => Ok(whole_lines(path, &bytes)?.0),
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(Vec::new()),
            Err(error) => Err(IoError::reading(path, error)),
        }
    }

    /// Adds one line and forces it to the disk.
    ///
    /// # Errors
    /// Where the disk does; the journal then takes no more.
    pub fn append(&mut self, line: &Value) -> Result<(), IoError> {
        if self.failed {
            return Err(IoError::AlreadyFailed { path: self.path.clone() });
        }
        let mut text = line.to_string();
        text.push('\n');
        let mut write = || {
            self.file.write_all(text.as_bytes())?;
            self.file.sync_data()
        };
        write().map_err(|e| {
            self.failed = true;
            IoError::writing(&self.path, e)
        })
    }
}

/// The lines, and the bytes that they take. A last line without its end was being written when the process died; zeros
/// are what some file systems leave of it.
fn whole_lines(path: &Path, bytes: &[u8]) -> Result<(Vec<Value>, usize), IoError> {
    let mut lines = Vec::new();
    let mut good = 0;
    for line in bytes.split_inclusive(|b| *b == b'\n') {
        let unfinished = !line.ends_with(b"\n");
        if unfinished && (good > 0 || matches!(line[0], b'{' | 0)) {
            break;
        }
        match serde_json::from_slice(line) {
            Ok(value) if !unfinished => lines.push(value),
            other => {
                return Err(IoError::Journal {
                    path: path.to_owned(),
                    line: lines.len() + 1,
                    why: other.map_or_else(|error| error.to_string(), |_| "it has no end".into()),
                });
            }
        }
        good += line.len();
    }
    Ok((lines, good))
}
