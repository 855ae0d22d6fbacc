//! Rows in, columns out: for formats that store one channel after the other.
//!
//! Rows are collected by column until a block is full; blocks go to a nameless temporary file beside the result, which
//! the system removes even after a kill. It takes as much room as the result. Memory is one block, whatever the number
//! of rows; only for a result in memory the blocks are there too.

use std::io::{self, Cursor, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::atomic::{Destination, PartialFile};
use crate::signals::{check_columns, units_json};
use crate::{Column, IoError, Metadata, Outcome, keys};

/// Memory for the rows of one block.
const BLOCK_BYTES: usize = 16 << 20;
const MAX_BLOCK_ROWS: usize = 128 << 10;

/// What keeps the full blocks.
trait Store: Read + Write + Seek + Send {}

impl<T: Read + Write + Seek + Send> Store for T {}

/// The most rows of a format, and of what.
#[derive(Clone, Copy)]
pub(super) struct Limit {
    pub(super) rows: u64,
    pub(super) format: &'static str,
    pub(super) of: &'static str,
}

pub(super) struct Spool {
    file: Box<dyn Store>,
    /// What errors name: the result.
    path: PathBuf,
    limit: Option<Limit>,
    /// Column after column, `block_rows` places each.
    block: Vec<f64>,
    block_rows: usize,
    pending: usize,
    blocks: u64,
    failed: bool,
    bytes: Vec<u8>,
}

impl Spool {
    /// For a result at that place.
    pub(super) fn create(destination: Destination<'_>, columns: usize, limit: Option<Limit>) -> Result<Self, IoError> {
        let path = destination.path();
        let file = match destination {
            Destination::Disk(path) => beside(path).map_err(|e| IoError::writing(path, e))?,
            Destination::Memory(_) => Box::new(Cursor::new(Vec::new())),
        };
        let block_rows = (BLOCK_BYTES / 8 / columns.max(1)).clamp(1, MAX_BLOCK_ROWS);
        Ok(Self {
            file,
            path: path.to_owned(),
            limit,
            block: vec![0.0; block_rows * columns],
            block_rows,
            pending: 0,
            blocks: 0,
            failed: false,
            bytes: Vec::new(),
        })
    }

    pub(super) fn rows(&self) -> u64 {
        self.blocks * self.block_rows as u64 + self.pending as u64
    }

    /// Adds a row of as many values as there are columns.
    pub(super) fn push(&mut self, row: impl Iterator<Item = f64>) -> Result<(), IoError> {
        if self.failed {
            return Err(IoError::AlreadyFailed { path: self.path.clone() });
        }
        if let Some(Limit { rows, format, of }) = self.limit.filter(|limit| self.rows() >= limit.rows) {
            let why = format!("{of} holds at most {rows} values; choose parquet or npz");
            return Err(IoError::NotWritable { path: self.path.clone(), format, why });
        }
        for (column, value) in self.block.chunks_exact_mut(self.block_rows).zip(row) {
            column[self.pending] = value;
        }
        self.pending += 1;
        if self.pending < self.block_rows {
            return Ok(());
        }
        self.bytes.clear();
        for column in self.block.chunks_exact(self.block_rows) {
            self.bytes.clear();
            self.bytes.extend(column.iter().flat_map(|v| v.to_le_bytes()));
            self.file.write_all(&self.bytes).map_err(|e| {
                self.failed = true;
                IoError::writing(&self.path, e)
            })?;
        }
        self.blocks += 1;
        self.pending = 0;
        Ok(())
    }

    /// The values of one column in order, as little-endian bytes, piece by piece.
    pub(super) fn column(
        &mut self,
        index: usize,
        mut take: impl FnMut(&[u8]) -> Result<(), IoError>,
    ) -> Result<(), IoError> {
        let columns = (self.block.len() / self.block_rows) as u64;
        let length = 8 * self.block_rows as u64;
        let mut piece = vec![0; length as usize];
        for block in 0..self.blocks {
            let at = (block * columns + index as u64) * length;
            let mut read = || -> io::Result<()> {
                self.file.seek(SeekFrom::Start(at))?;
                self.file.read_exact(&mut piece)
            };
            read().map_err(|e| IoError::reading(&self.path, e))?;
            take(&piece)?;
        }
        let start = index * self.block_rows;
        let rest = &self.block[start..start + self.pending];
        let bytes: Vec<u8> = rest.iter().flat_map(|v| v.to_le_bytes()).collect();
        take(&bytes)
    }
}

/// A file under construction that has a variable for each channel, `fs`, and texts: units, outcome and metadata.
pub(super) struct Variables {
    pub(super) file: PartialFile,
    pub(super) columns: Vec<Column>,
    pub(super) metadata: Metadata,
    pub(super) spool: Spool,
}

impl Variables {
    /// Starts the file. `why_not` says what is wrong with a channel's name; `fs` and `brinell_...` are taken.
    pub(super) fn at(
        destination: Destination<'_>,
        columns: &[Column],
        metadata: &Metadata,
        limit: Option<Limit>,
        why_not: impl Fn(&str) -> Option<&'static str>,
    ) -> Result<Self, IoError> {
        let path = destination.path();
        check_columns(path, columns)?;
        for Column { name, .. } in columns {
            let taken = name == "fs" || name.starts_with("brinell_");
            let why = why_not(name).or(taken.then_some("the file has a variable of its own with it"));
            if let Some(why) = why {
                return Err(IoError::ColumnName { path: path.to_owned(), name: name.clone(), why });
            }
        }
        Ok(Self {
            file: PartialFile::at(destination)?,
            columns: columns.to_vec(),
            metadata: metadata.clone(),
            spool: Spool::create(destination, columns.len(), limit)?,
        })
    }

    pub(super) fn push(&mut self, row: &[f64]) -> Result<(), IoError> {
        self.file.check_row(self.columns.len(), row)?;
        self.spool.push(row.iter().copied())
    }

    /// Name and content of each text; a key of the metadata has `_` for what `name` does not let it hold, and is left
    /// out where that is no name or taken.
    pub(super) fn texts(&self, outcome: &Outcome, name: impl Fn(&str) -> Option<String>) -> Vec<(String, String)> {
        let mut texts = vec![
            (keys::UNITS_VARIABLE.to_owned(), units_json(&self.columns)),
            ("brinell_outcome".to_owned(), outcome.to_string()),
        ];
        for (key, value) in &self.metadata.pairs {
            let free = |name: &String| {
                name != "fs" && self.columns.iter().all(|c| c.name != *name) && texts.iter().all(|(n, _)| n != name)
            };
            if let Some(name) = name(key).filter(free) {
                texts.push((name, value.clone()));
            }
        }
        texts
    }
}

/// A nameless file in the folder of the result.
#[cfg(not(target_family = "wasm"))]
fn beside(path: &Path) -> io::Result<Box<dyn Store>> {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    Ok(Box::new(tempfile::tempfile_in(folder)?))
}

/// WebAssembly in a browser has no files.
#[cfg(target_family = "wasm")]
fn beside(_: &Path) -> io::Result<Box<dyn Store>> {
    Err(io::ErrorKind::Unsupported.into())
}
