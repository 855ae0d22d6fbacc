//! Rows of cells of many kinds, lists among them: what a data set is made of. One finished row goes to a small file of
//! its own, whole or not at all; many rows become one Parquet file ([`crate::RecordWriter`]).

use crate::{Column, IoError, atomic_write};
use serde::{Deserialize, Deserializer, Serialize};
use sha2::{Digest, Sha256};
use std::path::Path;

/// What the cells of a column are. Any cell may be empty.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// True or false.
    Flag,
    /// A whole number.
    Whole,
    /// A double.
    Number,
    /// UTF-8.
    Words,
    /// A list of 32-bit floats: a signal.
    Signal,
    /// A list of whole numbers.
    Wholes,
    /// A list of doubles.
    Numbers,
    /// A list of UTF-8.
    WordsList,
}

/// One cell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Cell {
    /// Nothing.
    Empty,
    /// Of a column of [`Kind::Flag`].
    Flag(bool),
    /// Of a column of [`Kind::Whole`].
    Whole(i64),
    /// Of a column of [`Kind::Number`].
    Number(f64),
    /// Of a column of [`Kind::Words`].
    Words(String),
    /// Of a column of [`Kind::Signal`].
    #[serde(deserialize_with = "numbers")]
    Signal(Vec<f32>),
    /// Of a column of [`Kind::Wholes`].
    Wholes(Vec<i64>),
    /// Of a column of [`Kind::Numbers`].
    #[serde(deserialize_with = "numbers")]
    Numbers(Vec<f64>),
    /// Of a column of [`Kind::WordsList`].
    WordsList(Vec<String>),
}

/// A list of numbers: JSON has `null` for one that is not finite.
fn numbers<'de, D: Deserializer<'de>, T: Deserialize<'de> + From<f32>>(list: D) -> Result<Vec<T>, D::Error> {
    let list = Vec::<Option<T>>::deserialize(list)?.into_iter();
    Ok(list.map(|x| x.unwrap_or_else(|| f32::NAN.into())).collect())
}

impl Cell {
    /// A number, or nothing where there is none or it is not finite.
    pub fn number(x: Option<f64>) -> Self {
        x.filter(|x| x.is_finite()).map_or(Self::Empty, Self::Number)
    }

    /// Bytes that it takes, roughly.
    pub fn size(&self) -> usize {
        match self {
            Self::Empty | Self::Flag(_) => 1,
            Self::Whole(_) | Self::Number(_) => 8,
            Self::Words(text) => text.len(),
            Self::Signal(x) => 4 * x.len(),
            Self::Wholes(x) => 8 * x.len(),
            Self::Numbers(x) => 8 * x.len(),
            Self::WordsList(x) => x.iter().map(String::len).sum(),
        }
    }

    /// Whether it may be in a column of that kind.
    pub fn fits(&self, kind: Kind) -> bool {
        match self {
            Self::Empty => true,
            Self::Flag(_) => kind == Kind::Flag,
            Self::Whole(_) => kind == Kind::Whole,
            Self::Number(_) => kind == Kind::Number,
            Self::Words(_) => kind == Kind::Words,
            Self::Signal(_) => kind == Kind::Signal,
            Self::Wholes(_) => kind == Kind::Wholes,
            Self::Numbers(_) => kind == Kind::Numbers,
            Self::WordsList(_) => kind == Kind::WordsList,
        }
    }
}

/// A column of a data set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecordColumn {
    /// Name, unit and description.
    pub column: Column,
    /// What its cells are.
    pub kind: Kind,
}

impl RecordColumn {
    /// Whether a row has a cell for each of the columns.
    pub(crate) fn fit(columns: &[Self], row: &[Cell]) -> bool {
        row.len() == columns.len() && row.iter().zip(columns).all(|(cell, column)| cell.fits(column.kind))
    }
}

/// Writes one row to a file of its own, which appears whole or not at all, on the disk when this returns: a checksum,
/// then JSON.
///
/// # Errors
/// Where the disk refuses.
pub fn write_row_file(path: impl AsRef<Path>, row: &[Cell]) -> Result<(), IoError> {
    let cells = serde_json::to_vec(row).map_err(|e| IoError::writing(path.as_ref(), e.into()))?;
    let digest = Sha256::digest(&cells);
    atomic_write(path, [&digest[..], &cells].concat())
}

/// Reads such a row; `None` where there is no whole one that fits the columns.
pub fn read_row_file(path: impl AsRef<Path>, columns: &[RecordColumn]) -> Option<Vec<Cell>> {
    let bytes = std::fs::read(path).ok()?;
    let (digest, cells) = bytes.split_first_chunk::<32>()?;
    if Sha256::digest(cells)[..] != digest[..] {
        return None;
    }
    let row: Vec<Cell> = serde_json::from_slice(cells).ok()?;
    RecordColumn::fit(columns, &row).then_some(row)
}

/// SHA-256 of a file, in hexadecimal, read piece by piece.
///
/// # Errors
/// Where it cannot be read.
pub fn sha256_of(path: impl AsRef<Path>) -> Result<String, IoError> {
    let path = path.as_ref();
    let mut sum = Sha256::new();
    let mut read = || {
        let mut file = std::fs::File::open(path)?;
        std::io::copy(&mut file, &mut sum)
    };
    read().map_err(|e| IoError::reading(path, e))?;
    Ok(hexadecimal(&sum.finalize()))
}

/// Bytes as hexadecimal digits, two each.
pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row() -> (Vec<RecordColumn>, Vec<Cell>) {
        let cells = [
            (Kind::Flag, Cell::Flag(true)),
            (Kind::Whole, Cell::Whole(-3)),
            (Kind::Number, Cell::Number(0.1)),
            (Kind::Words, Cell::Words("ä \"\n".into())),
            (Kind::Signal, Cell::Signal(vec![1.5, f32::MIN, 0.0])),
            (Kind::Wholes, Cell::Wholes(vec![])),
            (Kind::Numbers, Cell::Numbers(vec![f64::MAX, -0.0])),
            (Kind::WordsList, Cell::WordsList(vec!["a".into(), String::new()])),
            (Kind::Number, Cell::Empty),
        ];
        let column = |k: usize, kind| RecordColumn { column: Column::new(format!("c{k}"), "1", ""), kind };
        let columns = cells.iter().enumerate().map(|(k, (kind, _))| column(k, *kind)).collect();
        (columns, cells.into_iter().map(|(_, cell)| cell).collect())
    }

    #[test]
    fn prop_a_row_comes_back_or_not_at_all() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("row");
        let (columns, row) = row();
        write_row_file(&path, &row).unwrap();
        assert_eq!(read_row_file(&path, &columns), Some(row));
        assert_eq!(read_row_file(&path, &columns[1..]), None);
        assert_eq!(read_row_file(folder.path().join("other"), &columns), None);
        let signal = [Cell::Signal(vec![f32::NAN, 1.5])];
        write_row_file(folder.path().join("signal"), &signal).unwrap();
        let read = read_row_file(folder.path().join("signal"), &columns[4..5]).unwrap();
        assert!(matches!(&read[..], [Cell::Signal(x)] if x[0].is_nan() && x[1] == 1.5));
        let whole = std::fs::read(&path).unwrap();
        for k in 0..whole.len() {
            std::fs::write(&path, &whole[..k]).unwrap();
            assert_eq!(read_row_file(&path, &columns), None, "cut to {k} bytes");
            let mut flipped = whole.clone();
            flipped[k] ^= 4;
            std::fs::write(&path, &flipped).unwrap();
            assert_eq!(read_row_file(&path, &columns), None, "byte {k} is another");
        }
    }
}
