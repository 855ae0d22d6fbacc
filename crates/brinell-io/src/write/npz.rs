//! NumPy's archive, written: an array of float64 per channel, the sample rate as `fs`, and texts, as `numpy.savez`
//! would.
//!
//! Nothing is compressed: vibration compresses little. Texts are those of the MAT files: `brinell_units`,
//! `brinell_outcome`, and the metadata.

use std::io::Write;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::spool::Spool;
use crate::atomic::{Complete, Destination, PartialFile};
use crate::signals::{check_columns, check_row, units_json};
use crate::{Column, IoError, Metadata, Outcome, SignalWriter, keys};

/// Writes a table as an npz file.
pub(crate) struct NpzWriter {
    file: PartialFile,
    columns: Vec<Column>,
    metadata: Metadata,
    spool: Spool,
}

impl NpzWriter {
    /// Starts the file. The names `fs` and `brinell_...` are taken.
    pub(crate) fn at(destination: Destination<'_>, columns: &[Column], metadata: &Metadata) -> Result<Self, IoError> {
        let path = destination.path();
        check_columns(path, columns)?;
        let why = |name: &str| {
            if name == "fs" || name.starts_with("brinell_") {
                Some("the file has an array of its own with it")
            } else if name.contains(['/', '\\', ':']) {
                Some("it would be a path within the archive")
            } else {
                None
            }
        };
        if let Some((name, why)) = columns.iter().find_map(|c| Some((&c.name, why(&c.name)?))) {
            return Err(IoError::ColumnName { path: path.to_owned(), name: name.clone(), why });
        }
        Ok(Self {
            file: PartialFile::at(destination)?,
            columns: columns.to_vec(),
            metadata: metadata.clone(),
            spool: Spool::create(destination, columns.len())?,
        })
    }
}

/// What is before the values of an array: magic, version 1.0, and a Python dict padded to 64 bytes.
fn header(kind: &str, shape: &str) -> Vec<u8> {
    let mut dict = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}");
    let length = (10 + dict.len() + 1).next_multiple_of(64) - 10;
    dict += &" ".repeat(length - 1 - dict.len());
    dict.push('\n');
    let mut header = b"\x93NUMPY\x01\x00".to_vec();
    // A dict of two short words and a shape is far below 64 KiB.
    header.extend_from_slice(&(length as u16).to_le_bytes());
    header.extend_from_slice(dict.as_bytes());
    header
}

impl SignalWriter for NpzWriter {
    fn write_row(&mut self, row: &[f64]) -> Result<(), IoError> {
        self.file.check()?;
        check_row(self.file.path(), self.columns.len(), row)?;
        self.spool.push(row.iter().copied())
    }

    fn complete(self: Box<Self>, outcome: Outcome) -> Result<Complete, IoError> {
        self.file.check()?;
        let mut spool = self.spool;
        let path = self.file.path().to_owned();
        let failed = |e: std::io::Error| IoError::writing(&path, e);
        let mut archive = ZipWriter::new(self.file);
        let options = SimpleFileOptions::default().compression_method(CompressionMethod::Stored).large_file(true);
        let rows = spool.rows();
        for (index, column) in self.columns.iter().enumerate() {
            let name = format!("{}.npy", column.name);
            archive.start_file(name, options).map_err(|e| failed(e.into()))?;
            let header = header("<f8", &format!("({rows},)"));
            archive.write_all(&header).map_err(failed)?;
            spool.column(index, |bytes| archive.write_all(bytes).map_err(failed))?;
        }
        let mut others = Vec::new();
        if let Some(hz) = self.metadata.sample_rate() {
            let mut bytes = header("<f8", "()");
            bytes.extend_from_slice(&hz.to_le_bytes());
            others.push(("fs".to_owned(), bytes));
        }
        let mut texts = vec![
            (keys::UNITS_VARIABLE.to_owned(), units_json(&self.columns)),
            ("brinell_outcome".to_owned(), outcome.to_string()),
        ];
        for (key, value) in &self.metadata.pairs {
            let name = key.replace(['.', '/', '\\', ':'], "_");
            let taken = |n: &String| *n == name;
            if !self.columns.iter().any(|c| taken(&c.name)) && !texts.iter().any(|t| taken(&t.0)) {
                texts.push((name, value.clone()));
            }
        }
        for (name, text) in texts {
            let count = text.chars().count();
            // NumPy has no text of no letters.
            let mut bytes = header(&format!("<U{}", count.max(1)), "()");
            bytes.extend(text.chars().flat_map(|c| u32::from(c).to_le_bytes()));
            bytes.extend_from_slice(if count == 0 { &[0; 4] } else { &[] });
            others.push((name, bytes));
        }
        for (name, bytes) in others {
            archive.start_file(format!("{name}.npy"), options).map_err(|e| failed(e.into()))?;
            archive.write_all(&bytes).map_err(failed)?;
        }
        archive.finish().map_err(|e| failed(e.into()))?.complete()
    }
}
