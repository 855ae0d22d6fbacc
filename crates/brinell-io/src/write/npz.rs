//! NumPy's archive, written: an array of float64 per channel, the sample rate as `fs`, and texts, as `numpy.savez`
//! would.
//!
//! Nothing is compressed: vibration compresses little. Texts are those of the MAT files: `brinell_units`,
//! `brinell_outcome`, and the metadata.

use std::io::Write;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::spool::Variables;
use crate::atomic::{Complete, Destination};
use crate::{Column, IoError, Metadata, Outcome, SignalWriter};

/// Writes a table as an npz file.
pub(crate) struct NpzWriter(Variables);

/// What would be a path within the archive.
const OF_PATHS: [char; 3] = ['/', '\\', ':'];

impl NpzWriter {
    pub(crate) fn at(destination: Destination<'_>, columns: &[Column], metadata: &Metadata) -> Result<Self, IoError> {
        let why_not = |name: &str| name.contains(OF_PATHS).then_some("it would be a path within the archive");
        Ok(Self(Variables::at(destination, columns, metadata, None, why_not)?))
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
        self.0.push(row)
    }

    fn complete(self: Box<Self>, outcome: Outcome) -> Result<Complete, IoError> {
        self.0.file.check()?;
        let texts = self.0.texts(&outcome, |key| Some(key.replace('.', "_").replace(OF_PATHS, "_")));
        let Variables { file, columns, metadata, mut spool } = self.0;
        let path = file.path().to_owned();
        let failed = |e: std::io::Error| IoError::writing(&path, e);
        let mut archive = ZipWriter::new(file);
        let options = SimpleFileOptions::default().compression_method(CompressionMethod::Stored).large_file(true);
        let rows = spool.rows();
        for (index, column) in columns.iter().enumerate() {
            let name = format!("{}.npy", column.name);
            archive.start_file(name, options).map_err(|e| failed(e.into()))?;
            let header = header("<f8", &format!("({rows},)"));
            archive.write_all(&header).map_err(failed)?;
            spool.column(index, |bytes| archive.write_all(bytes).map_err(failed))?;
        }
        let mut others = Vec::new();
        if let Some(hz) = metadata.sample_rate() {
            let mut bytes = header("<f8", "()");
            bytes.extend_from_slice(&hz.to_le_bytes());
            others.push(("fs".to_owned(), bytes));
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
