//! Rows of cells of many kinds, lists among them: what a data set is made of. One finished row goes to a small file of
//! its own, whole or not at all; many rows become one Parquet file ([`crate::RecordWriter`]).

use crate::{Column, IoError, atomic_write};
use sha2::{Digest, Sha256};
use std::io::{BufRead, BufReader};
use std::path::Path;

/// Bytes of a file that are read at a time.
const PIECE: usize = 1 << 16;

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
#[derive(Clone, Debug, PartialEq)]
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
    Signal(Vec<f32>),
    /// Of a column of [`Kind::Wholes`].
    Wholes(Vec<i64>),
    /// Of a column of [`Kind::Numbers`].
    Numbers(Vec<f64>),
    /// Of a column of [`Kind::WordsList`].
    WordsList(Vec<String>),
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

    fn put(&self, out: &mut Vec<u8>) {
        fn list<T, const N: usize>(out: &mut Vec<u8>, tag: u8, x: &[T], bytes: fn(&T) -> [u8; N]) {
            out.push(tag);
            out.extend((x.len() as u64).to_le_bytes());
            out.extend(x.iter().flat_map(bytes));
        }
        match self {
            Self::Empty => out.push(0),
            Self::Flag(x) => out.extend([1, u8::from(*x)]),
            Self::Whole(x) => {
                out.push(2);
                out.extend(x.to_le_bytes());
            }
            Self::Number(x) => {
                out.push(3);
                out.extend(x.to_le_bytes());
            }
            Self::Words(text) => list(out, 4, text.as_bytes(), |b| [*b]),
            Self::Signal(x) => list(out, 5, x, |x| x.to_le_bytes()),
            Self::Wholes(x) => list(out, 6, x, |x| x.to_le_bytes()),
            Self::Numbers(x) => list(out, 7, x, |x| x.to_le_bytes()),
            Self::WordsList(x) => {
                out.push(8);
                out.extend((x.len() as u64).to_le_bytes());
                for text in x {
                    Self::Words(text.clone()).put(out);
                }
            }
        }
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        let [tag] = array(bytes)?;
        Some(match tag {
            0 => Self::Empty,
            1 => Self::Flag(array::<1>(bytes)? != [0]),
            2 => Self::Whole(i64::from_le_bytes(array(bytes)?)),
            3 => Self::Number(f64::from_le_bytes(array(bytes)?)),
            4 => {
                let count = count(bytes, 1)?;
                let (text, rest) = bytes.split_at(count);
                *bytes = rest;
                Self::Words(String::from_utf8(text.to_vec()).ok()?)
            }
            5 => Self::Signal(items(bytes, f32::from_le_bytes)?),
            6 => Self::Wholes(items(bytes, i64::from_le_bytes)?),
            7 => Self::Numbers(items(bytes, f64::from_le_bytes)?),
            8 => {
                let count = count(bytes, 1)?;
                let text = |_| match Self::take(bytes)? {
                    Self::Words(text) => Some(text),
                    _ => None,
                };
                Self::WordsList((0..count).map(text).collect::<Option<_>>()?)
            }
            _ => return None,
        })
    }
}

fn array<const N: usize>(bytes: &mut &[u8]) -> Option<[u8; N]> {
    let (first, rest) = bytes.split_first_chunk()?;
    *bytes = rest;
    Some(*first)
}

/// How many items of so many bytes at least follow; `None` where there are fewer.
fn count(bytes: &mut &[u8], each: usize) -> Option<usize> {
    let count = usize::try_from(u64::from_le_bytes(array(bytes)?)).ok()?;
    (count.checked_mul(each)? <= bytes.len()).then_some(count)
}

fn items<T, const N: usize>(bytes: &mut &[u8], of: fn([u8; N]) -> T) -> Option<Vec<T>> {
    let count = count(bytes, N)?;
    (0..count).map(|_| array(bytes).map(of)).collect()
}

/// A column of a data set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecordColumn {
    /// Name, unit and description.
    pub column: Column,
    /// What its cells are.
    pub kind: Kind,
}

/// Begins a row's file; changes with its layout.
const MAGIC: &[u8; 8] = b"brnrow01";

/// Writes one row to a file of its own, which appears whole or not at all, on the disk when this returns.
///
/// # Errors
/// Where the disk refuses.
pub fn write_row_file(path: impl AsRef<Path>, row: &[Cell]) -> Result<(), IoError> {
    let size: usize = row.iter().map(|cell| cell.size() + 9).sum();
    let mut cells = Vec::with_capacity(size);
    row.iter().for_each(|cell| cell.put(&mut cells));
    let mut bytes = Vec::with_capacity(cells.len() + 40);
    bytes.extend(MAGIC);
    bytes.extend(Sha256::digest(&cells));
    bytes.extend(cells);
    atomic_write(path, bytes)
}

/// Reads such a row; `None` where there is no whole one that fits the columns.
pub fn read_row_file(path: impl AsRef<Path>, columns: &[RecordColumn]) -> Option<Vec<Cell>> {
    let bytes = std::fs::read(path).ok()?;
    let (digest, mut cells) = bytes.strip_prefix(MAGIC)?.split_first_chunk::<32>()?;
    if Sha256::digest(cells)[..] != digest[..] {
        return None;
    }
    let cell = |column: &RecordColumn| Cell::take(&mut cells).filter(|cell| cell.fits(column.kind));
    let row = columns.iter().map(cell).collect::<Option<Vec<_>>>()?;
    cells.is_empty().then_some(row)
}

/// SHA-256 of a file, in hexadecimal, read piece by piece.
///
/// # Errors
/// Where it cannot be read.
pub fn sha256_of(path: impl AsRef<Path>) -> Result<String, IoError> {
    let path = path.as_ref();
    let read = || {
        let mut file = BufReader::with_capacity(PIECE, std::fs::File::open(path)?);
        let mut sum = Sha256::new();
        loop {
            let piece = file.fill_buf()?;
            if piece.is_empty() {
                return Ok(hexadecimal(&sum.finalize()));
            }
            sum.update(piece);
            let read = piece.len();
            file.consume(read);
        }
    };
    read().map_err(|e| IoError::reading(path, e))
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
