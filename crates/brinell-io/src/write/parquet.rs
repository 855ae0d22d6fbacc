//! Parquet, written: one flat table of required DOUBLE columns, each byte-stream-split and Zstandard-compressed.
//!
//! Rows are collected by column until the row group is full; a row group is then one page per column. Its rows are
//! chosen so that the collected values take [`GROUP_BYTES`], whatever the number of columns. Beside them the `parquet`
//! crate keeps some hundred bytes for every column of every row group, which the file's end lists: of three columns
//! next to nothing, of three hundred about a hundredth of the values, which grows with the rows.

use std::path::Path;
use std::sync::Arc;

use parquet::basic::{Compression, Encoding, Repetition, Type as Physical, ZstdLevel};
use parquet::data_type::DoubleType;
use parquet::errors::{ParquetError, Result};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use serde_json::Value;

use crate::atomic::{Complete, Destination, PartialFile};
use crate::signals::{by_column, check_columns};
use crate::{Column, IoError, Metadata, Outcome, SignalWriter, keys};

/// Memory for the rows of one row group.
const GROUP_BYTES: usize = 16 << 20;
/// A page of more rows than this compresses no better and keeps a reader from skipping.
const MAX_GROUP_ROWS: usize = 128 << 10;
/// Zstandard's fastest ordinary level: the low mantissa bytes of a vibration signal are noise at any level.
const ZSTD_LEVEL: i32 = 1;

/// Writes a table as Parquet.
pub struct ParquetWriter {
    file: SerializedFileWriter<PartialFile>,
    columns: Vec<Column>,
    metadata: Metadata,
    /// Column after column, `group_rows` places each.
    values: Vec<f64>,
    group_rows: usize,
    /// Rows collected and not yet written.
    pending: usize,
}

impl ParquetWriter {
    /// Starts the file. The metadata comes at its end, with the columns' units and the outcome.
    pub fn create(
        path: impl AsRef<Path>,
        columns: &[Column],
        metadata: &Metadata,
    ) -> std::result::Result<Self, IoError> {
        Self::at(Destination::Disk(path.as_ref()), columns, metadata)
    }

    /// The same on the disk or in memory.
    pub(crate) fn at(
        destination: Destination<'_>,
        columns: &[Column],
        metadata: &Metadata,
    ) -> std::result::Result<Self, IoError> {
        let path = destination.path();
        check_columns(path, columns)?;
        if let Some((key, _)) = metadata.pairs.iter().find(|(key, _)| keys::RESERVED.contains(&key.as_str())) {
            return Err(IoError::ReservedKey { path: path.to_owned(), key: key.clone() });
        }
        let group_rows = (GROUP_BYTES / size_of::<f64>() / columns.len()).clamp(1, MAX_GROUP_ROWS);
        let file = PartialFile::at(destination)?;
        Ok(Self {
            file: start(file, columns, group_rows).map_err(|e| failed(path, e))?,
            columns: columns.to_vec(),
            metadata: metadata.clone(),
            values: vec![0.0; group_rows * columns.len()],
            group_rows,
            pending: 0,
        })
    }

    fn write_group(&mut self) -> std::result::Result<(), IoError> {
        if self.pending == 0 {
            return Ok(());
        }
        let mut write = || -> Result<()> {
            let mut group = self.file.next_row_group()?;
            for column in self.values.chunks_exact(self.group_rows) {
                let Some(mut out) = group.next_column()? else { break };
                out.typed::<DoubleType>().write_batch(&column[..self.pending], None, None)?;
                out.close()?;
            }
            group.close().map(drop)
        };
        let written = write();
        self.pending = 0;
        written.map_err(|e| failed(self.file.inner().path(), e))
    }

    /// Key and value of everything known about the table.
    fn key_values(&self, outcome: &Outcome) -> Metadata {
        let units = by_column(&self.columns, |c| &c.unit);
        (self.metadata.clone().with(keys::UNITS, units.to_string()))
            .with(keys::DESCRIPTIONS, by_column(&self.columns, |c| &c.description).to_string())
            .with(keys::OUTCOME, outcome.to_string())
            .with(keys::PANDAS_ATTRS, Value::from_iter([("units", units)]).to_string())
    }
}

impl SignalWriter for ParquetWriter {
    fn write_row(&mut self, row: &[f64]) -> std::result::Result<(), IoError> {
        self.file.inner().check_row(self.columns.len(), row)?;
        for (column, &value) in self.values.chunks_exact_mut(self.group_rows).zip(row) {
            column[self.pending] = value;
        }
        self.pending += 1;
        if self.pending == self.group_rows { self.write_group() } else { Ok(()) }
    }

    fn complete(mut self: Box<Self>, outcome: Outcome) -> std::result::Result<Complete, IoError> {
        self.file.inner().check()?;
        self.write_group()?;
        for (key, value) in self.key_values(&outcome).pairs {
            self.file.append_key_value_metadata(KeyValue::new(key, value));
        }
        let path = self.file.inner().path().to_owned();
        self.file.into_inner().map_err(|e| failed(&path, e))?.complete()
    }
}

fn start(file: PartialFile, columns: &[Column], group_rows: usize) -> Result<SerializedFileWriter<PartialFile>> {
    let field = |column: &Column| {
        let double = Type::primitive_type_builder(&column.name, Physical::DOUBLE);
        double.with_repetition(Repetition::REQUIRED).build().map(Arc::new)
    };
    let fields = columns.iter().map(field).collect::<Result<_>>()?;
    let schema = Type::group_type_builder("schema").with_fields(fields).build()?;
    let properties = WriterProperties::builder()
        .set_created_by(concat!("brinell version ", env!("CARGO_PKG_VERSION")).into())
        .set_compression(zstd()?)
        .set_dictionary_enabled(false)
        .set_encoding(Encoding::BYTE_STREAM_SPLIT)
        .set_statistics_enabled(EnabledStatistics::None)
        .set_offset_index_disabled(true)
        // One page per column.
        .set_data_page_size_limit(usize::MAX)
        .set_data_page_row_count_limit(group_rows)
        .set_write_batch_size(group_rows);
    SerializedFileWriter::new(file, Arc::new(schema), Arc::new(properties.build()))
}

pub(super) fn zstd() -> Result<Compression> {
    Ok(Compression::ZSTD(ZstdLevel::try_new(ZSTD_LEVEL)?))
}

pub(super) fn failed(path: &Path, error: ParquetError) -> IoError {
    match error {
        ParquetError::External(inner) => match inner.downcast::<std::io::Error>() {
            Ok(error) => IoError::writing(path, *error),
            Err(other) => IoError::writing(path, std::io::Error::other(other.to_string())),
        },
        other => IoError::NotWritable { path: path.to_owned(), format: "Parquet", why: other.to_string() },
    }
}
