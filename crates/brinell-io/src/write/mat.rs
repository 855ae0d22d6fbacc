//! MATLAB v5, written: a column vector of doubles per channel, the sample rate as `fs`, and texts.
//!
//! Plain files are what MATLAB calls v6, compressed ones v7. Vibration compresses little and slowly, so
//! [`crate::Format::Mat`] is plain. Texts: `brinell_units` (a JSON object), `brinell_outcome`, and each pair of the
//! metadata with `_` for the dots of its key.

use std::io::Write;
use std::path::Path;

use flate2::Compression;
use flate2::write::ZlibEncoder;

use super::spool::Spool;
use crate::atomic::{Complete, Destination, PartialFile};
use crate::signals::{check_columns, check_row, units_json};
use crate::{Column, IoError, Metadata, Outcome, SignalWriter, keys};

const MI_INT8: u32 = 1;
const MI_UINT16: u32 = 4;
const MI_INT32: u32 = 5;
const MI_UINT32: u32 = 6;
const MI_DOUBLE: u32 = 9;
const MI_MATRIX: u32 = 14;
const MI_COMPRESSED: u32 = 15;
const CLASS_CHAR: u32 = 4;
const CLASS_DOUBLE: u32 = 6;
/// MATLAB reads variables of less than 2 GiB from such a file.
const MAX_ROWS: u64 = ((1 << 31) - 1024) / 8;
/// MATLAB's `namelengthmax`.
const LONGEST_NAME: usize = 63;

/// Writes a table as a MATLAB v5 file.
pub struct MatWriter {
    file: PartialFile,
    columns: Vec<Column>,
    metadata: Metadata,
    spool: Spool,
    compress: bool,
}

impl MatWriter {
    /// Starts the file. Names must be MATLAB's: a letter, then letters, digits and `_`, 63 at most; `fs` and
    /// `brinell_...` are taken.
    pub fn create(
        path: impl AsRef<Path>,
        columns: &[Column],
        metadata: &Metadata,
        compress: bool,
    ) -> Result<Self, IoError> {
        Self::at(Destination::Disk(path.as_ref()), columns, metadata, compress)
    }

    /// The same on the disk or in memory.
    pub(crate) fn at(
        destination: Destination<'_>,
        columns: &[Column],
        metadata: &Metadata,
        compress: bool,
    ) -> Result<Self, IoError> {
        let path = destination.path();
        check_columns(path, columns)?;
        for Column { name, .. } in columns {
            let why = if !is_matlab_name(name) {
                "MATLAB takes a letter, then letters, digits and `_`, 63 at most"
            } else if name == "fs" || name.starts_with("brinell_") {
                "the file has a variable of its own with it"
            } else {
                continue;
            };
            return Err(IoError::ColumnName { path: path.to_owned(), name: name.clone(), why });
        }
        Ok(Self {
            file: PartialFile::at(destination)?,
            columns: columns.to_vec(),
            metadata: metadata.clone(),
            spool: Spool::create(destination, columns.len())?,
            compress,
        })
    }

    fn write(&mut self, outcome: &Outcome) -> Result<(), IoError> {
        let mut header = format!("MATLAB 5.0 MAT-file, written by brinell {}", env!("CARGO_PKG_VERSION")).into_bytes();
        header.resize(124, b' ');
        header.extend_from_slice(&0x0100u16.to_le_bytes());
        header.extend_from_slice(b"IM");
        self.file.append(&header)?;
        let rows = self.spool.rows();
        for index in 0..self.columns.len() {
            let head = head(&self.columns[index].name, CLASS_DOUBLE, [rows, 1], MI_DOUBLE, 8 * rows);
            let spool = &mut self.spool;
            variable(&mut self.file, self.compress, &head, |take| spool.column(index, take))?;
        }
        if let Some(hz) = self.metadata.sample_rate() {
            let head = head("fs", CLASS_DOUBLE, [1, 1], MI_DOUBLE, 8);
            variable(&mut self.file, self.compress, &head, |take| take(&hz.to_le_bytes()))?;
        }
        let mut texts = vec![
            (keys::UNITS_VARIABLE.to_owned(), units_json(&self.columns)),
            ("brinell_outcome".to_owned(), outcome.to_string()),
        ];
        for (key, value) in &self.metadata.pairs {
            let name = key.replace('.', "_");
            if is_matlab_name(&name) && name != "fs" && texts.iter().all(|(n, _)| *n != name) {
                texts.push((name, value.clone()));
            }
        }
        for (name, text) in texts {
            let units: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
            let count = units.len() as u64 / 2;
            let head = head(&name, CLASS_CHAR, [1, count], MI_UINT16, 2 * count);
            variable(&mut self.file, self.compress, &head, |take| take(&units))?;
        }
        Ok(())
    }
}

fn is_matlab_name(name: &str) -> bool {
    name.len() <= LONGEST_NAME
        && name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// What is before the values of a variable: its own tag, flags, dimensions, name and the tag of the values.
fn head(name: &str, class: u32, shape: [u64; 2], kind: u32, bytes: u64) -> Vec<u8> {
    let mut inner = Vec::new();
    let mut word = |n: u32| inner.extend_from_slice(&n.to_le_bytes());
    // Rows are limited, so every length is far inside 32 bits.
    [MI_UINT32, 8, class, 0].into_iter().for_each(&mut word);
    [MI_INT32, 8, shape[0] as u32, shape[1] as u32].into_iter().for_each(&mut word);
    [MI_INT8, name.len() as u32].into_iter().for_each(&mut word);
    inner.extend_from_slice(name.as_bytes());
    inner.resize(inner.len().next_multiple_of(8), 0);
    inner.extend_from_slice(&kind.to_le_bytes());
    inner.extend_from_slice(&(bytes as u32).to_le_bytes());
    let total = inner.len() as u64 + bytes.next_multiple_of(8);
    let mut head = MI_MATRIX.to_le_bytes().to_vec();
    head.extend_from_slice(&(total as u32).to_le_bytes());
    head.extend_from_slice(&inner);
    head
}

type Take<'a> = &'a mut dyn FnMut(&[u8]) -> Result<(), IoError>;

/// Writes one variable whose values `give` hands over.
fn variable(
    file: &mut PartialFile,
    compress: bool,
    head: &[u8],
    give: impl FnOnce(Take<'_>) -> Result<(), IoError>,
) -> Result<(), IoError> {
    let mut bytes = 0;
    let padding = |bytes: usize| vec![0; bytes.next_multiple_of(8) - bytes];
    if !compress {
        file.append(head)?;
        give(&mut |values| {
            bytes += values.len();
            file.append(values)
        })?;
        return file.append(&padding(bytes));
    }
    let path = file.path().to_owned();
    let failed = |e| IoError::writing(&path, e);
    file.append(&MI_COMPRESSED.to_le_bytes())?;
    file.append(&[0; 4])?;
    let mut encoder = ZlibEncoder::new(&mut *file, Compression::fast());
    encoder.write_all(head).map_err(failed)?;
    give(&mut |values| {
        bytes += values.len();
        encoder.write_all(values).map_err(failed)
    })?;
    encoder.write_all(&padding(bytes)).map_err(failed)?;
    encoder.try_finish().map_err(failed)?;
    let packed = encoder.total_out();
    drop(encoder);
    // Incompressible numbers grow by less than a thousandth: inside 32 bits too.
    let at = std::io::Seek::stream_position(file).map_err(failed)? - packed - 4;
    file.patch(at, &(packed as u32).to_le_bytes())
}

impl SignalWriter for MatWriter {
    fn write_row(&mut self, row: &[f64]) -> Result<(), IoError> {
        self.file.check()?;
        check_row(self.file.path(), self.columns.len(), row)?;
        if self.spool.rows() >= MAX_ROWS {
            return Err(IoError::NotWritable {
                path: self.file.path().to_owned(),
                format: "MATLAB v5",
                why: format!("a variable holds at most {MAX_ROWS} values; choose parquet or npz"),
            });
        }
        self.spool.push(row.iter().copied())
    }

    fn complete(mut self: Box<Self>, outcome: Outcome) -> Result<Complete, IoError> {
        self.file.check()?;
        self.write(&outcome)?;
        self.file.complete()
    }
}
