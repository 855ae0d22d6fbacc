//! Rows with lists as Parquet, row group by row group: memory is one group's, whatever the number of rows.
//!
//! Every column is optional; lists are Parquet's LIST with required elements, so that pandas, polars, Arrow and Spark
//! read arrays. Numbers are plain under Zstandard (fastparquet cannot read byte-stream-split ones, which would save a
//! tenth), words have dictionaries. The same rows in the same groups give the same bytes.

use super::parquet::{failed, zstd};
use crate::atomic::{Complete, PartialFile};
use crate::records::{Cell, Kind, RecordColumn, hexadecimal};
use crate::signals::{check_columns, units_json};
use crate::{IoError, Metadata, keys};
use parquet::basic::{Encoding, LogicalType, Repetition, Type as Physical};
use parquet::column::writer::ColumnWriterImpl;
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, FloatType, Int64Type};
use parquet::errors::{ParquetError, Result};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{ColumnPath, Type, TypePtr};
use sha2::{Digest, Sha256};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A file under construction that knows its checksum.
struct Summed {
    file: PartialFile,
    sum: Sha256,
    bytes: u64,
}

impl Write for Summed {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.file.write(bytes)?;
        self.sum.update(&bytes[..written]);
        self.bytes += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// A written file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// Where it is.
    pub path: PathBuf,
    /// Its length.
    pub bytes: u64,
    /// Its SHA-256, in hexadecimal.
    pub sha256: String,
}

/// Writes rows as Parquet; the file appears whole or not at all.
pub struct RecordWriter {
    file: SerializedFileWriter<Summed>,
    columns: Vec<RecordColumn>,
    path: PathBuf,
}

impl RecordWriter {
    /// Starts the file.
    ///
    /// # Errors
    /// Where columns have no sound names, or the disk refuses.
    pub fn create(
        path: impl AsRef<Path>,
        columns: &[RecordColumn],
        metadata: &Metadata,
    ) -> std::result::Result<Self, IoError> {
        let path = path.as_ref();
        let plain: Vec<_> = columns.iter().map(|c| c.column.clone()).collect();
        check_columns(path, &plain)?;
        let mut pairs: Vec<KeyValue> =
            metadata.pairs.iter().map(|(key, value)| KeyValue::new(key.clone(), value.clone())).collect();
        pairs.push(KeyValue::new(keys::UNITS.into(), units_json(&plain)));
        let target = Summed { file: PartialFile::create(path)?, sum: Sha256::new(), bytes: 0 };
        let start = || -> Result<_> {
            let properties = Arc::new(properties(columns, pairs)?);
            SerializedFileWriter::new(target, schema(columns)?, properties)
        };
        Ok(Self {
            file: start().map_err(|error| failed(path, error))?,
            columns: columns.to_vec(),
            path: path.to_owned(),
        })
    }

    /// Writes rows as one row group.
    ///
    /// # Errors
    /// Where a row does not fit the columns, or the disk refuses.
    pub fn write_group(&mut self, rows: &[Vec<Cell>]) -> std::result::Result<(), IoError> {
        let misfit = |row: &&Vec<Cell>| {
            row.len() != self.columns.len() || row.iter().zip(&self.columns).any(|(cell, c)| !cell.fits(c.kind))
        };
        if let Some(row) = rows.iter().find(misfit) {
            return Err(IoError::RowLength { path: self.path.clone(), expected: self.columns.len(), got: row.len() });
        }
        let mut write = || -> Result<()> {
            let mut group = self.file.next_row_group()?;
            for (k, column) in self.columns.iter().enumerate() {
                let cells = rows.iter().map(|row| &row[k]);
                let is_list = is_list(column.kind);
                let mut out =
                    group.next_column()?.ok_or_else(|| ParquetError::General("fewer columns than fields".into()))?;
                match column.kind {
                    Kind::Flag => put(out.typed::<BoolType>(), is_list, cells, |c, v| {
                        if let Cell::Flag(x) = c {
                            v.push(*x);
                        }
                    })?,
                    Kind::Whole | Kind::Wholes => put(out.typed::<Int64Type>(), is_list, cells, |c, v| match c {
                        Cell::Whole(x) => v.push(*x),
                        Cell::Wholes(x) => v.extend_from_slice(x),
                        _ => {}
                    })?,
                    Kind::Number | Kind::Numbers => put(out.typed::<DoubleType>(), is_list, cells, |c, v| match c {
                        Cell::Number(x) => v.push(*x),
                        Cell::Numbers(x) => v.extend_from_slice(x),
                        _ => {}
                    })?,
                    Kind::Signal => put(out.typed::<FloatType>(), is_list, cells, |c, v| {
                        if let Cell::Signal(x) = c {
                            v.extend_from_slice(x);
                        }
                    })?,
                    Kind::Words | Kind::WordsList => {
                        put(out.typed::<ByteArrayType>(), is_list, cells, |c, v: &mut Vec<ByteArray>| match c {
                            Cell::Words(text) => v.push(text.as_str().into()),
                            Cell::WordsList(x) => v.extend(x.iter().map(|t| ByteArray::from(t.as_str()))),
                            _ => {}
                        })?;
                    }
                }
                out.close()?;
            }
            group.close().map(drop)
        };
        write().map_err(|error| failed(&self.path, error))
    }

    /// Writes the footer and gives the file its name.
    ///
    /// # Errors
    /// Where the disk refuses.
    pub fn finish(self) -> std::result::Result<Written, IoError> {
        let target = self.end()?;
        let (bytes, sha256) = (target.bytes, hexadecimal(&target.sum.finalize()));
        Ok(Written { path: target.file.commit()?, bytes, sha256 })
    }

    /// Writes the footer; [`Complete::publish`] gives the file its name.
    pub(crate) fn complete(self) -> std::result::Result<Complete, IoError> {
        self.end()?.file.complete()
    }

    fn end(self) -> std::result::Result<Summed, IoError> {
        let ended = self.file.into_inner();
        ended.map_err(|error| failed(&self.path, error))
    }
}

/// One column of a row group, cell by cell: a signal's levels are as long as the signal, so that not all rows' are made
/// at once.
fn put<'a, T: DataType>(
    out: &mut ColumnWriterImpl<'_, T>,
    is_list: bool,
    cells: impl Iterator<Item = &'a Cell>,
    values_of: impl Fn(&Cell, &mut Vec<T::T>),
) -> Result<()> {
    let (mut values, mut defined, mut repeated) = (Vec::new(), Vec::new(), Vec::new());
    for cell in cells {
        values.clear();
        values_of(cell, &mut values);
        // Levels of an optional value: 0 none, 1 there. Of an optional list of required elements: 0 no list, 1 an empty
        // one, 2 an element; the first element of a row repeats at 0, the others at 1.
        let level = match cell {
            Cell::Empty => 0,
            _ if is_list && !values.is_empty() => 2,
            _ => 1,
        };
        let count = values.len().max(1);
        defined.clear();
        defined.resize(count, level);
        repeated.clear();
        repeated.resize(count, 1_i16);
        repeated[0] = 0;
        out.write_batch(&values, Some(&defined), is_list.then_some(&repeated[..]))?;
    }
    Ok(())
}

fn is_list(kind: Kind) -> bool {
    matches!(kind, Kind::Signal | Kind::Wholes | Kind::Numbers | Kind::WordsList)
}

fn schema(columns: &[RecordColumn]) -> Result<TypePtr> {
    let field = |column: &RecordColumn| -> Result<TypePtr> {
        let (physical, logical) = match column.kind {
            Kind::Flag => (Physical::BOOLEAN, None),
            Kind::Whole | Kind::Wholes => (Physical::INT64, None),
            Kind::Number | Kind::Numbers => (Physical::DOUBLE, None),
            Kind::Signal => (Physical::FLOAT, None),
            Kind::Words | Kind::WordsList => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        let name = &column.column.name;
        let value = |name: &str, repetition| {
            Type::primitive_type_builder(name, physical)
                .with_repetition(repetition)
                .with_logical_type(logical.clone())
                .build()
        };
        if !is_list(column.kind) {
            return Ok(Arc::new(value(name, Repetition::OPTIONAL)?));
        }
        let element = Arc::new(value("element", Repetition::REQUIRED)?);
        let list = Type::group_type_builder("list")
            .with_repetition(Repetition::REPEATED)
            .with_fields(vec![element])
            .build()?;
        let whole = Type::group_type_builder(name)
            .with_repetition(Repetition::OPTIONAL)
            .with_logical_type(Some(LogicalType::List))
            .with_fields(vec![Arc::new(list)])
            .build()?;
        Ok(Arc::new(whole))
    };
    let fields = columns.iter().map(field).collect::<Result<_>>()?;
    Ok(Arc::new(Type::group_type_builder("schema").with_fields(fields).build()?))
}

fn properties(columns: &[RecordColumn], pairs: Vec<KeyValue>) -> Result<WriterProperties> {
    let mut builder = WriterProperties::builder()
        .set_compression(zstd()?)
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_key_value_metadata(Some(pairs));
    for column in columns {
        let name = column.column.name.clone();
        let path = ColumnPath::new(match is_list(column.kind) {
            true => vec![name, "list".into(), "element".into()],
            false => vec![name],
        });
        if matches!(column.kind, Kind::Signal | Kind::Number | Kind::Numbers) {
            builder = builder
                .set_column_dictionary_enabled(path.clone(), false)
                .set_column_encoding(path.clone(), Encoding::PLAIN);
        }
        if column.kind == Kind::Signal {
            builder = builder.set_column_statistics_enabled(path, EnabledStatistics::None);
        }
    }
    Ok(builder.build())
}

/// What a file of rows says of itself, and how many there are.
///
/// # Errors
/// Where it cannot be read.
pub fn record_facts(path: impl AsRef<Path>) -> std::result::Result<RecordFacts, IoError> {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    let path = path.as_ref();
    let file = std::fs::File::open(path).map_err(|e| IoError::reading(path, e))?;
    let reader = SerializedFileReader::new(file)
        .map_err(|error| IoError::Parquet { path: path.to_owned(), why: error.to_string() })?;
    let facts = reader.metadata().file_metadata();
    let pairs = facts.key_value_metadata().into_iter().flatten();
    Ok(RecordFacts {
        rows: facts.num_rows().max(0) as u64,
        columns: facts.schema().get_fields().iter().map(|f| f.name().to_owned()).collect(),
        metadata: Metadata { pairs: pairs.filter_map(|pair| Some((pair.key.clone(), pair.value.clone()?))).collect() },
    })
}

/// What a file's footer says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecordFacts {
    /// Rows.
    pub rows: u64,
    /// Names of the columns, in order.
    pub columns: Vec<String>,
    /// Facts about the table.
    pub metadata: Metadata,
}
