//! CSV: a header line of channel names, then one line of numbers per row.
//!
//! Each number is the shortest decimal that reads back to the same 64 bits, plain near 1 and with an exponent far from
//! it: `0.5`, `-0.0`, `0.00001`, `1e-7`. Not-a-number and the infinities are `NaN`, `inf`, `-inf`, which NumPy, pandas
//! and MATLAB understand.

use std::path::Path;

use crate::atomic::{Complete, Destination, PartialFile};
use crate::signals::check_columns;
use crate::{Column, IoError, Outcome, SignalWriter};

/// Text collected before it goes to the file.
const BUFFER_BYTES: usize = 256 << 10;
/// No f64 is longer than this, its comma included.
const LONGEST_FIELD: usize = 25;

/// Writes a table as CSV.
pub struct CsvWriter {
    file: PartialFile,
    columns: usize,
    text: Vec<u8>,
    number: zmij::Buffer,
}

impl CsvWriter {
    /// Starts the file with its header line. Units have no place in it: they go to the run's summary.
    pub fn create(path: impl AsRef<Path>, columns: &[Column]) -> Result<Self, IoError> {
        Self::at(Destination::Disk(path.as_ref()), columns)
    }

    /// The same on the disk or in memory.
    pub(crate) fn at(destination: Destination<'_>, columns: &[Column]) -> Result<Self, IoError> {
        check_columns(destination.path(), columns)?;
        let file = PartialFile::at(destination)?;
        // Room for one more row than the limit, so that a row never allocates.
        let mut text = Vec::with_capacity(BUFFER_BYTES + columns.len() * LONGEST_FIELD);
        for (i, column) in columns.iter().enumerate() {
            if i > 0 {
                text.push(b',');
            }
            text.extend_from_slice(column.name.as_bytes());
        }
        text.push(b'\n');
        let mut this = Self { file, columns: columns.len(), text, number: zmij::Buffer::new() };
        this.flush_if_full()?;
        Ok(this)
    }

    fn flush_if_full(&mut self) -> Result<(), IoError> {
        if self.text.len() < BUFFER_BYTES {
            return Ok(());
        }
        self.file.append(&self.text)?;
        self.text.clear();
        Ok(())
    }
}

impl SignalWriter for CsvWriter {
    fn write_row(&mut self, row: &[f64]) -> Result<(), IoError> {
        self.file.check_row(self.columns, row)?;
        for &value in row {
            self.text.extend_from_slice(self.number.format(value).as_bytes());
            self.text.push(b',');
        }
        if let Some(last) = self.text.last_mut() {
            *last = b'\n';
        }
        self.flush_if_full()
    }

    fn complete(mut self: Box<Self>, _: Outcome) -> Result<Complete, IoError> {
        self.file.append(&self.text)?;
        self.file.complete()
    }
}
