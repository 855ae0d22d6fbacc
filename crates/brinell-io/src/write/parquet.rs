//! Parquet, written: one flat table of required DOUBLE columns, each byte-stream-split and Zstandard-compressed.
//!
//! Why a writer of our own, when the `parquet` crate has one: that one keeps several hundred bytes for every
//! column chunk until the end and copies them once more there, which passes 100 MB in a long run of hundreds of
//! channels. Here a chunk costs eight bytes. The subset is small, and the `parquet` crate, pyarrow, pandas
//! and polars read it (tests/parquet.rs, tests/python/check_parquet.py).
//!
//! Rows are collected by column until the row group is full; a row group is then one page per column. Its rows
//! are chosen so that the collected values take [`GROUP_BYTES`], whatever the number of columns.
//!
//! Layout and field numbers: <https://github.com/apache/parquet-format>, `parquet.thrift`; Thrift's compact protocol:
//! <https://github.com/apache/thrift/blob/master/doc/specs/thrift-compact-protocol.md>.

use std::path::Path;

use serde_json::{Map, Value, json};
use zstd::bulk::Compressor;

use crate::atomic::{Complete, Destination, PartialFile};
use crate::signals::check_columns;
use crate::{Column, IoError, Metadata, Outcome, SignalWriter, keys};

/// Memory for the rows of one row group.
const GROUP_BYTES: usize = 4 << 20;
/// A page of more rows than this compresses no better and keeps a reader from skipping.
const MAX_GROUP_ROWS: usize = 128 << 10;
/// Zstandard's fastest ordinary level: the low mantissa bytes of a vibration signal are noise at any level.
const ZSTD_LEVEL: i32 = 1;
/// The footer goes to the file in pieces of this size.
const FOOTER_PIECE: usize = 64 << 10;

const MAGIC: &[u8; 4] = b"PAR1";
const TYPE_DOUBLE: i32 = 5;
const REPETITION_REQUIRED: i32 = 0;
const ENCODING_RLE: i32 = 3;
const ENCODING_BYTE_STREAM_SPLIT: i32 = 9;
const CODEC_ZSTD: i32 = 6;
const PAGE_DATA: i32 = 0;

/// Writes a table as Parquet.
pub struct ParquetWriter {
    file: PartialFile,
    columns: Vec<Column>,
    metadata: Metadata,
    /// Column after column, `group_rows` places each.
    values: Vec<f64>,
    group_rows: usize,
    /// Rows collected and not yet written.
    pending: usize,
    /// Rows of each row group written.
    groups: Vec<u32>,
    /// Chunks written: those of the first row group, then those of the second, each right behind the last.
    chunks: Vec<Chunk>,
    compressor: Compressor<'static>,
    split: Vec<u8>,
    page: Vec<u8>,
}

/// What the footer needs to know of a column chunk; the rest follows from its place in the order.
#[derive(Clone, Copy)]
struct Chunk {
    header_bytes: u32,
    page_bytes: u32,
}

impl Chunk {
    /// Bytes in the file.
    fn stored_bytes(&self) -> i64 {
        i64::from(self.header_bytes) + i64::from(self.page_bytes)
    }

    /// Bytes before compression.
    fn raw_bytes(&self, rows: u32) -> i64 {
        i64::from(self.header_bytes) + 8 * i64::from(rows)
    }

    /// Its `ColumnChunk`.
    fn describe(&self, out: &mut Thrift, column: &Column, offset: i64, rows: u32) {
        out.begin();
        out.i64(2, offset);
        out.field(3, Thrift::STRUCT);
        out.begin();
        out.i32(1, TYPE_DOUBLE);
        out.list(2, Thrift::I32, 1);
        out.zigzag(i64::from(ENCODING_BYTE_STREAM_SPLIT));
        out.list(3, Thrift::BINARY, 1);
        out.bytes(column.name.as_bytes());
        out.i32(4, CODEC_ZSTD);
        out.i64(5, i64::from(rows));
        out.i64(6, self.raw_bytes(rows));
        out.i64(7, self.stored_bytes());
        out.i64(9, offset);
        out.end();
        out.end();
    }
}

impl ParquetWriter {
    /// Starts the file. The metadata comes at its end, with the columns' units and the outcome.
    pub fn create(path: impl AsRef<Path>, columns: &[Column], metadata: &Metadata) -> Result<Self, IoError> {
        Self::at(Destination::Disk(path.as_ref()), columns, metadata)
    }

    /// The same on the disk or in memory.
    pub(crate) fn at(destination: Destination<'_>, columns: &[Column], metadata: &Metadata) -> Result<Self, IoError> {
        let path = destination.path();
        check_columns(path, columns)?;
        if let Some((key, _)) = metadata.pairs.iter().find(|(key, _)| keys::RESERVED.contains(&key.as_str())) {
            return Err(IoError::ReservedKey { path: path.to_owned(), key: key.clone() });
        }
        let group_rows = (GROUP_BYTES / size_of::<f64>() / columns.len()).clamp(1, MAX_GROUP_ROWS);
        let compressor = Compressor::new(ZSTD_LEVEL).map_err(|e| IoError::writing(path, e))?;
        let mut file = PartialFile::at(destination)?;
        file.append(MAGIC)?;
        Ok(Self {
            file,
            columns: columns.to_vec(),
            metadata: metadata.clone(),
            values: vec![0.0; group_rows * columns.len()],
            group_rows,
            pending: 0,
            groups: Vec::new(),
            chunks: Vec::new(),
            compressor,
            split: Vec::new(),
            page: Vec::new(),
        })
    }

    fn write_group(&mut self) -> Result<(), IoError> {
        let rows = self.pending;
        if rows == 0 {
            return Ok(());
        }
        for column in self.values.chunks_exact(self.group_rows) {
            byte_stream_split(&column[..rows], &mut self.split);
            self.page.clear();
            self.page.reserve(zstd::zstd_safe::compress_bound(self.split.len()));
            self.compressor
                .compress_to_buffer(&self.split, &mut self.page)
                .map_err(|e| IoError::writing(self.file.path(), e))?;
            let header = page_header(rows, self.split.len(), self.page.len());
            self.file.append(&header)?;
            self.file.append(&self.page)?;
            // A page is at most 8 * MAX_GROUP_ROWS bytes before compression: far inside 32 bits.
            self.chunks.push(Chunk { header_bytes: header.len() as u32, page_bytes: self.page.len() as u32 });
        }
        self.groups.push(rows as u32);
        self.pending = 0;
        Ok(())
    }

    /// Key and value of everything known about the table.
    fn key_values(&self, outcome: &Outcome) -> Vec<(String, String)> {
        let object = |of: fn(&Column) -> &str| -> Value {
            let pairs = self.columns.iter().map(|c| (c.name.clone(), Value::from(of(c))));
            Value::Object(pairs.collect::<Map<_, _>>())
        };
        let units = object(|c| &c.unit);
        let mut pairs = self.metadata.pairs.clone();
        pairs.push((keys::UNITS.into(), units.to_string()));
        pairs.push((keys::DESCRIPTIONS.into(), object(|c| &c.description).to_string()));
        pairs.push((keys::OUTCOME.into(), outcome.to_string()));
        pairs.push((keys::PANDAS_ATTRS.into(), json!({ "units": units }).to_string()));
        pairs
    }

    /// Writes `FileMetaData`, its length and the closing magic.
    fn write_footer(&mut self, outcome: &Outcome) -> Result<(), IoError> {
        let mut length = 0;
        let mut out = Thrift::default();
        out.i32(1, 1); // format version
        out.list(2, Thrift::STRUCT, self.columns.len() + 1);
        out.begin();
        out.string(4, "schema");
        out.i32(5, self.columns.len() as i32);
        out.end();
        for column in &self.columns {
            out.begin();
            out.i32(1, TYPE_DOUBLE);
            out.i32(3, REPETITION_REQUIRED);
            out.string(4, &column.name);
            out.end();
        }
        out.i64(3, self.groups.iter().map(|&rows| i64::from(rows)).sum());
        out.list(4, Thrift::STRUCT, self.groups.len());
        let mut offset = MAGIC.len() as i64;
        for (&rows, chunks) in self.groups.iter().zip(self.chunks.chunks_exact(self.columns.len())) {
            out.begin();
            let group_offset = offset;
            let mut raw_total = 0;
            out.list(1, Thrift::STRUCT, chunks.len());
            for (chunk, column) in chunks.iter().zip(&self.columns) {
                chunk.describe(&mut out, column, offset, rows);
                offset += chunk.stored_bytes();
                raw_total += chunk.raw_bytes(rows);
            }
            out.i64(2, raw_total);
            out.i64(3, i64::from(rows));
            out.i64(5, group_offset);
            out.i64(6, offset - group_offset);
            out.end();
            if out.buffer.len() >= FOOTER_PIECE {
                length += out.buffer.len();
                self.file.append(&out.buffer)?;
                out.buffer.clear();
            }
        }
        let pairs = self.key_values(outcome);
        out.list(5, Thrift::STRUCT, pairs.len());
        for (key, value) in &pairs {
            out.begin();
            out.string(1, key);
            out.string(2, value);
            out.end();
        }
        out.string(6, concat!("brinell version ", env!("CARGO_PKG_VERSION")));
        out.end();
        length += out.buffer.len();
        // Readers take the length for a signed number; past it there are some ten terabytes of signal.
        let length = i32::try_from(length).map_err(|_| {
            IoError::writing(self.file.path(), std::io::Error::other("too many row groups for one Parquet file"))
        })?;
        out.buffer.extend_from_slice(&length.to_le_bytes());
        out.buffer.extend_from_slice(MAGIC);
        self.file.append(&out.buffer)
    }
}

impl SignalWriter for ParquetWriter {
    fn write_row(&mut self, row: &[f64]) -> Result<(), IoError> {
        self.file.check_row(self.columns.len(), row)?;
        for (column, &value) in self.values.chunks_exact_mut(self.group_rows).zip(row) {
            column[self.pending] = value;
        }
        self.pending += 1;
        if self.pending == self.group_rows { self.write_group() } else { Ok(()) }
    }

    fn complete(mut self: Box<Self>, outcome: Outcome) -> Result<Complete, IoError> {
        self.file.check()?;
        self.write_group()?;
        self.write_footer(&outcome)?;
        self.file.complete()
    }
}

/// All first bytes, then all second bytes, and so on: signs and exponents lie together and compress.
fn byte_stream_split(values: &[f64], out: &mut Vec<u8>) {
    out.resize(8 * values.len(), 0);
    for (k, plane) in out.chunks_exact_mut(values.len()).enumerate() {
        for (byte, value) in plane.iter_mut().zip(values) {
            *byte = (value.to_bits() >> (8 * k)) as u8;
        }
    }
}

/// `PageHeader` of a version-1 data page without levels, for a required column has none.
fn page_header(rows: usize, raw: usize, compressed: usize) -> Vec<u8> {
    let mut out = Thrift::default();
    out.i32(1, PAGE_DATA);
    out.i32(2, raw as i32);
    out.i32(3, compressed as i32);
    out.field(5, Thrift::STRUCT);
    out.begin();
    out.i32(1, rows as i32);
    out.i32(2, ENCODING_BYTE_STREAM_SPLIT);
    out.i32(3, ENCODING_RLE);
    out.i32(4, ENCODING_RLE);
    out.end();
    out.end();
    out.buffer
}

/// Thrift's compact protocol, as much of it as the footer needs. Starts inside the outermost struct.
#[derive(Default)]
struct Thrift {
    buffer: Vec<u8>,
    /// The last field's number in the current struct, and in the structs around it.
    last: u8,
    outer: Vec<u8>,
}

impl Thrift {
    const I32: u8 = 5;
    const I64: u8 = 6;
    const BINARY: u8 = 8;
    const LIST: u8 = 9;
    const STRUCT: u8 = 12;

    fn begin(&mut self) {
        self.outer.push(std::mem::take(&mut self.last));
    }

    fn end(&mut self) {
        self.buffer.push(0);
        self.last = self.outer.pop().unwrap_or_default();
    }

    /// Numbers within a struct ascend by less than 16, so the short form always does.
    fn field(&mut self, number: u8, kind: u8) {
        self.buffer.push((number - self.last) << 4 | kind);
        self.last = number;
    }

    fn varint(&mut self, mut n: u64) {
        while n >= 0x80 {
            self.buffer.push(n as u8 | 0x80);
            n >>= 7;
        }
        self.buffer.push(n as u8);
    }

    fn zigzag(&mut self, n: i64) {
        self.varint((n << 1 ^ n >> 63) as u64);
    }

    fn bytes(&mut self, bytes: &[u8]) {
        self.varint(bytes.len() as u64);
        self.buffer.extend_from_slice(bytes);
    }

    fn i32(&mut self, number: u8, n: i32) {
        self.field(number, Self::I32);
        self.zigzag(i64::from(n));
    }

    fn i64(&mut self, number: u8, n: i64) {
        self.field(number, Self::I64);
        self.zigzag(n);
    }

    fn string(&mut self, number: u8, text: &str) {
        self.field(number, Self::BINARY);
        self.bytes(text.as_bytes());
    }

    /// The head of a list; its items follow.
    fn list(&mut self, number: u8, kind: u8, items: usize) {
        self.field(number, Self::LIST);
        if items < 15 {
            self.buffer.push((items as u8) << 4 | kind);
        } else {
            self.buffer.push(0xf0 | kind);
            self.varint(items as u64);
        }
    }
}
