//! A journal: lines of JSON that are on the disk when [`Journal::append`] returns.
//!
//! Lines are only ever added. A line that a killed process left unfinished is the last one; it is cut off when the journal is opened
//! again, and everything before it counts. One process at a time has a journal open.

use crate::IoError;
use serde_json::Value;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read, Seek, SeekFrom, Write};
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
    /// Where another process has it open, it cannot be read or written, or a line before the last is no JSON.
    pub fn open(path: impl AsRef<Path>) -> Result<(Self, Vec<Value>), IoError> {
        let path = path.as_ref();
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(path)
            .map_err(|e| IoError::writing(path, e))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(IoError::Busy {
                    path: path.to_owned(),
                });
            }
            // A file system without locks is no reason not to work.
            Err(TryLockError::Error(_)) => {}
        }
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes)
            .map_err(|e| IoError::reading(path, e))?;
        let (lines, good) = whole_lines(path, &bytes)?;
        let mut cut = || {
            if good < bytes.len() {
                file.set_len(good as u64)?;
                file.sync_all()?;
            }
            file.seek(SeekFrom::Start(good as u64))
        };
        cut().map_err(|e| IoError::writing(path, e))?;
        let journal = Self {
            file,
            path: path.to_owned(),
            failed: false,
        };
        Ok((journal, lines))
    }

    /// Adds one line and forces it to the disk.
    ///
    /// # Errors
    /// Where the disk does; the journal then takes no more.
    pub fn append(&mut self, line: &Value) -> Result<(), IoError> {
        if self.failed {
            return Err(IoError::AlreadyFailed {
                path: self.path.clone(),
            });
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

/// The lines, and the bytes that they take. A last line without its end, or that is no JSON, was being written when the process died.
fn whole_lines(path: &Path, bytes: &[u8]) -> Result<(Vec<Value>, usize), IoError> {
    let mut lines = Vec::new();
    let mut good = 0;
    for (number, line) in bytes.split_inclusive(|b| *b == b'\n').enumerate() {
        let end = good + line.len();
        match serde_json::from_slice(line) {
            Ok(value) if line.ends_with(b"\n") => lines.push(value),
            Ok(_) => break,
            Err(_) if end == bytes.len() => break,
            Err(error) => {
                return Err(IoError::Journal {
                    path: path.to_owned(),
                    line: number + 1,
                    why: error.to_string(),
                });
            }
        }
        good = end;
    }
    Ok((lines, good))
}
