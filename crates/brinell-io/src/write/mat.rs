//! MATLAB v5, written: a column vector of doubles per channel, the sample rate as `fs`, and texts.
//!
//! Plain, what MATLAB calls v6: vibration compresses little and slowly. Texts: `brinell_units` (a JSON object),
//! `brinell_outcome`, and each pair of the metadata with `_` for the dots of its key.

use super::spool::{Limit, Variables};
use crate::atomic::{Complete, Destination};
use crate::{Column, IoError, Metadata, Outcome, SignalWriter};

const MI_INT8: u32 = 1;
const MI_UINT16: u32 = 4;
const MI_INT32: u32 = 5;
const MI_UINT32: u32 = 6;
const MI_DOUBLE: u32 = 9;
const MI_MATRIX: u32 = 14;
const CLASS_CHAR: u32 = 4;
const CLASS_DOUBLE: u32 = 6;
/// MATLAB reads variables of less than 2 GiB from such a file.
const MAX_ROWS: u64 = ((1 << 31) - 1024) / 8;
/// MATLAB's `namelengthmax`.
const LONGEST_NAME: usize = 63;

/// Writes a table as a MATLAB v5 file.
pub(crate) struct MatWriter(Variables);

impl MatWriter {
    /// Starts the file. Names must be MATLAB's: a letter, then letters, digits and `_`, 63 at most; dots become `_`.
    pub(crate) fn at(destination: Destination<'_>, columns: &[Column], metadata: &Metadata) -> Result<Self, IoError> {
        let limit = Limit { rows: MAX_ROWS, format: "MATLAB v5", of: "a variable" };
        let why_not = |name: &str| {
            // Of a machine's channels, `bearing1.outer_ax`, the dot is written as `_`.
            (!is_matlab_name(&name.replace('.', "_")))
                .then_some("MATLAB takes a letter, then letters, digits and `_`, 63 at most")
        };
        Ok(Self(Variables::at(destination, columns, metadata, Some(limit), why_not)?))
    }

    fn write(&mut self, outcome: &Outcome) -> Result<(), IoError> {
        let mut header = format!("MATLAB 5.0 MAT-file, written by brinell {}", env!("CARGO_PKG_VERSION")).into_bytes();
        header.resize(124, b' ');
        header.extend_from_slice(&0x0100u16.to_le_bytes());
        header.extend_from_slice(b"IM");
        let name = |key: &str| Some(key.replace('.', "_")).filter(|name| is_matlab_name(name));
        let texts = self.0.texts(outcome, name);
        let Variables { file, columns, metadata, spool } = &mut self.0;
        file.append(&header)?;
        let rows = spool.rows();
        for (index, column) in columns.iter().enumerate() {
            // Eight bytes each: no padding.
            file.append(&head(&column.name.replace('.', "_"), CLASS_DOUBLE, [rows, 1], MI_DOUBLE, 8 * rows))?;
            spool.column(index, |bytes| file.append(bytes))?;
        }
        if let Some(hz) = metadata.sample_rate() {
            file.append(&head("fs", CLASS_DOUBLE, [1, 1], MI_DOUBLE, 8))?;
            file.append(&hz.to_le_bytes())?;
        }
        for (name, text) in texts {
            let mut units: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
            let count = units.len() as u64 / 2;
            file.append(&head(&name, CLASS_CHAR, [1, count], MI_UINT16, 2 * count))?;
            units.resize(units.len().next_multiple_of(8), 0);
            file.append(&units)?;
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

impl SignalWriter for MatWriter {
    fn write_row(&mut self, row: &[f64]) -> Result<(), IoError> {
        self.0.push(row)
    }

    fn complete(mut self: Box<Self>, outcome: Outcome) -> Result<Complete, IoError> {
        self.0.file.check()?;
        self.write(&outcome)?;
        self.0.file.complete()
    }
}
