//! Tables of numbers and words, small enough to be held whole: what a campaign of many runs leaves. As CSV and as
//! Parquet.
//!
//! A cell may be empty. CSV follows RFC 4180: words are quoted where they hold a comma, a quote or a line's end,
//! numbers are the shortest decimals that read back to the same 64 bits. Parquet holds optional columns of doubles and
//! of UTF-8; units and metadata go to its footer under the same keys as those of signals. The same table gives the same
//! bytes.

use crate::atomic::{Complete, atomic_prepare};
use crate::signals::check_columns;
use crate::{Column, IoError};
#[cfg(feature = "parquet")]
use crate::{Kind, Metadata, RecordColumn, RecordWriter, records::Cell};
use std::path::{Path, PathBuf};

/// A column's cells, one a row.
#[derive(Clone, Debug, PartialEq)]
pub enum Cells {
    /// Numbers; an empty cell is `None`.
    Numbers(Vec<Option<f64>>),
    /// Words; an empty cell is `None`.
    Words(Vec<Option<String>>),
}

impl Cells {
    /// Rows.
    pub fn len(&self) -> usize {
        match self {
            Self::Numbers(cells) => cells.len(),
            Self::Words(cells) => cells.len(),
        }
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// A table: columns of one length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Name, unit and description of each column.
    pub columns: Vec<Column>,
    /// The cells of each.
    pub cells: Vec<Cells>,
}

impl Table {
    /// Adds a column.
    pub fn push(&mut self, column: Column, cells: Cells) {
        self.columns.push(column);
        self.cells.push(cells);
    }

    /// Rows: those of the first column.
    pub fn rows(&self) -> usize {
        self.cells.first().map_or(0, Cells::len)
    }

    fn check(&self, path: &Path) -> Result<(), IoError> {
        check_columns(path, &self.columns)?;
        let rows = self.rows();
        match self.cells.iter().find(|cells| cells.len() != rows) {
            Some(cells) => Err(IoError::RowLength { path: path.to_owned(), expected: rows, got: cells.len() }),
            None => Ok(()),
        }
    }

    /// Writes the table as CSV; the file appears whole or not at all.
    ///
    /// # Errors
    /// Where the columns have no sound names or not one length, or the disk refuses.
    pub fn write_csv(&self, path: impl AsRef<Path>) -> Result<PathBuf, IoError> {
        self.prepare_csv(path)?.publish()
    }

    /// The same up to the file's name, which [`Complete::publish`] gives.
    ///
    /// # Errors
    /// As [`Table::write_csv`].
    pub fn prepare_csv(&self, path: impl AsRef<Path>) -> Result<Complete, IoError> {
        let path = path.as_ref();
        self.check(path)?;
        let mut text = String::new();
        let names = self.columns.iter().map(|c| quoted(&c.name));
        text.push_str(&names.collect::<Vec<_>>().join(","));
        text.push('\n');
        let mut number = zmij::Buffer::new();
        for row in 0..self.rows() {
            for (k, cells) in self.cells.iter().enumerate() {
                if k > 0 {
                    text.push(',');
                }
                match cells {
                    Cells::Numbers(cells) => {
                        if let Some(x) = cells[row] {
                            text.push_str(number.format(x));
                        }
                    }
                    Cells::Words(cells) => {
                        text.push_str(&cells[row].as_deref().map_or(String::new(), quoted));
                    }
                }
            }
            text.push('\n');
        }
        atomic_prepare(path, text)
    }

    /// Writes the table as Parquet; the file appears whole or not at all.
    ///
    /// # Errors
    /// Where the columns have no sound names or not one length, or the disk refuses.
    #[cfg(feature = "parquet")]
    pub fn write_parquet(&self, path: impl AsRef<Path>, metadata: &Metadata) -> Result<PathBuf, IoError> {
        self.prepare_parquet(path, metadata)?.publish()
    }

    /// The same up to the file's name, which [`Complete::publish`] gives.
    ///
    /// # Errors
    /// As [`Table::write_parquet`].
    #[cfg(feature = "parquet")]
    pub fn prepare_parquet(&self, path: impl AsRef<Path>, metadata: &Metadata) -> Result<Complete, IoError> {
        let path = path.as_ref();
        self.check(path)?;
        let columns = self.columns.iter().zip(&self.cells);
        let columns: Vec<RecordColumn> = columns
            .map(|(column, cells)| RecordColumn {
                column: column.clone(),
                kind: match cells {
                    Cells::Numbers(_) => Kind::Number,
                    Cells::Words(_) => Kind::Words,
                },
            })
            .collect();
        let cell = |cells: &Cells, row: usize| match cells {
            Cells::Numbers(cells) => cells[row].map(Cell::Number),
            Cells::Words(cells) => cells[row].clone().map(Cell::Words),
        };
        let row = |row: usize| -> Vec<Cell> {
            let cells = self.cells.iter().map(|cells| cell(cells, row));
            cells.map(|cell| cell.unwrap_or(Cell::Empty)).collect()
        };
        let mut writer = RecordWriter::create(path, &columns, metadata)?;
        // One row group: a table is held whole anyway.
        writer.write_group(&(0..self.rows()).map(row).collect::<Vec<_>>())?;
        writer.complete()
    }
}

/// Quotes where they are needed.
fn quoted(text: &str) -> String {
    let plain = !text.contains([',', '"', '\n', '\r']) && text.trim() == text;
    if plain { text.to_owned() } else { format!("\"{}\"", text.replace('"', "\"\"")) }
}
