//! CSV: a header line of channel names, then one line of numbers per row.
//!
//! Each number is the shortest decimal that reads back to the same 64 bits, plain near 1 and with an exponent far from
//! it: `0.5`, `-0.0`, `0.00001`, `1e-7`. Not-a-number and the infinities are `NaN`, `inf`, `-inf`, which NumPy, pandas
//! and MATLAB understand.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use crate::atomic::{Complete, Destination, PartialFile};
use crate::signals::{check_columns, check_row};
use crate::{Column, IoError, Metadata, Outcome, SignalWriter, Signals};

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
        self.file.check()?;
        check_row(self.file.path(), self.columns, row)?;
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

/// Reads a CSV file of numbers under a header line.
pub fn read_csv(path: impl AsRef<Path>) -> Result<Signals, IoError> {
    let path = path.as_ref();
    let file = File::open(path).map_err(|e| IoError::reading(path, e))?;
    read_csv_from(BufReader::with_capacity(BUFFER_BYTES, file), path)
}

/// Reads CSV from anywhere; `path` is what errors call it. Names may be quoted; blank lines are skipped.
pub fn read_csv_from(mut reader: impl BufRead, path: impl AsRef<Path>) -> Result<Signals, IoError> {
    let path = path.as_ref();
    let header = |why| IoError::CsvHeader { path: path.to_owned(), why };
    let mut line = Vec::new();
    let mut next = |line: &mut Vec<u8>| {
        line.clear();
        reader.read_until(b'\n', line).map_err(|e| IoError::reading(path, e))
    };

    if next(&mut line)? == 0 {
        return Err(header("the file is empty"));
    }
    let text = std::str::from_utf8(&line).map_err(|_| header("this is not text in UTF-8"))?;
    let names = split_header(text.strip_prefix('\u{feff}').unwrap_or(text));
    if names.iter().all(String::is_empty) {
        return Err(header("it is blank"));
    }
    if names.iter().all(|n| n.parse::<f64>().is_ok()) {
        return Err(header("it holds numbers"));
    }

    let mut data = vec![Vec::new(); names.len()];
    let mut number = 1;
    while next(&mut line)? > 0 {
        number += 1;
        let row = line.trim_ascii();
        if row.is_empty() {
            continue;
        }
        let mut got = 0;
        for field in row.split(|&b| b == b',') {
            if let (Some(values), Some(name)) = (data.get_mut(got), names.get(got)) {
                values.push(parse(field).ok_or_else(|| IoError::CsvNumber {
                    path: path.to_owned(),
                    line: number,
                    column: name.clone(),
                    text: String::from_utf8_lossy(field).trim().chars().take(40).collect(),
                })?);
            }
            got += 1;
        }
        if got != names.len() {
            return Err(IoError::CsvRow { path: path.to_owned(), line: number, expected: names.len(), got });
        }
    }
    let columns = names.into_iter().map(|name| Column::new(name, "", "")).collect();
    Ok(Signals { columns, data, metadata: Metadata::default() })
}

fn parse(field: &[u8]) -> Option<f64> {
    std::str::from_utf8(field.trim_ascii()).ok()?.parse().ok()
}

/// Splits at the commas outside quotes; a doubled quote within quotes is one.
fn split_header(line: &str) -> Vec<String> {
    let mut names = vec![String::new()];
    let mut quoted = false;
    let mut chars = line.trim().chars().peekable();
    while let Some(c) = chars.next() {
        let end = names.len() - 1;
        match c {
            '"' if quoted && chars.peek() == Some(&'"') => {
                chars.next();
                names[end].push('"');
            }
            '"' => quoted = !quoted,
            ',' if !quoted => names.push(String::new()),
            c => names[end].push(c),
        }
    }
    for name in &mut names {
        *name = name.trim().to_owned();
    }
    names
}
