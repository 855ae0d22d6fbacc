//! Tables of numbers and words, small enough to be held whole: what a campaign of many runs leaves. As CSV and as Parquet.
//!
//! A cell may be empty. CSV follows RFC 4180: words are quoted where they hold a comma, a quote or a line's end, numbers are the shortest
//! decimals that read back to the same 64 bits. Parquet holds optional columns of doubles and of UTF-8; units and metadata go to its footer
//! under the same keys as those of signals. The same table gives the same bytes.

#[cfg(feature = "parquet")]
use crate::Metadata;
use crate::atomic::{Complete, atomic_prepare};
use crate::signals::check_columns;
use crate::{Column, IoError};
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
            Some(cells) => Err(IoError::RowLength {
                path: path.to_owned(),
                expected: rows,
                got: cells.len(),
            }),
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
    pub fn write_parquet(
        &self,
        path: impl AsRef<Path>,
        metadata: &Metadata,
    ) -> Result<PathBuf, IoError> {
        self.prepare_parquet(path, metadata)?.publish()
    }

    /// The same up to the file's name, which [`Complete::publish`] gives.
    ///
    /// # Errors
    /// As [`Table::write_parquet`].
    #[cfg(feature = "parquet")]
    pub fn prepare_parquet(
        &self,
        path: impl AsRef<Path>,
        metadata: &Metadata,
    ) -> Result<Complete, IoError> {
        let path = path.as_ref();
        self.check(path)?;
        let bytes = parquet::bytes(self, metadata).map_err(|error| IoError::NotWritable {
            path: path.to_owned(),
            format: "Parquet",
            why: error.to_string(),
        })?;
        atomic_prepare(path, bytes)
    }

    /// Reads a table back from Parquet.
    ///
    /// # Errors
    /// Where the file cannot be read or holds other columns than of doubles and of words.
    #[cfg(feature = "parquet")]
    pub fn read_parquet(path: impl AsRef<Path>) -> Result<Self, IoError> {
        let path = path.as_ref();
        parquet::table(path).map_err(|error| IoError::Parquet {
            path: path.to_owned(),
            why: error.to_string(),
        })
    }
}

/// Quotes where they are needed.
fn quoted(text: &str) -> String {
    let plain = !text.contains([',', '"', '\n', '\r']) && text.trim() == text;
    if plain {
        text.to_owned()
    } else {
        format!("\"{}\"", text.replace('"', "\"\""))
    }
}

#[cfg(feature = "parquet")]
mod parquet {
    use super::{Cells, Table};
    use crate::signals::units_json;
    use crate::{Column, Metadata, keys};
    use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical, ZstdLevel};
    use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
    use parquet::errors::{ParquetError, Result};
    use parquet::file::metadata::KeyValue;
    use parquet::file::properties::WriterProperties;
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::file::writer::SerializedFileWriter;
    use parquet::record::Field;
    use parquet::schema::types::Type;
    use std::path::Path;
    use std::sync::Arc;

    /// The file. One row group: a table is held whole anyway.
    pub(super) fn bytes(table: &Table, metadata: &Metadata) -> Result<Vec<u8>> {
        let fields = table
            .columns
            .iter()
            .zip(&table.cells)
            .map(|(column, cells)| {
                let (physical, logical) = match cells {
                    Cells::Numbers(_) => (Physical::DOUBLE, None),
                    Cells::Words(_) => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
                };
                let builder = Type::primitive_type_builder(&column.name, physical)
                    .with_repetition(Repetition::OPTIONAL)
                    .with_logical_type(logical);
                Ok(Arc::new(builder.build()?))
            });
        let schema = Type::group_type_builder("schema")
            .with_fields(fields.collect::<Result<_>>()?)
            .build()?;
        let mut pairs: Vec<KeyValue> = metadata
            .pairs
            .iter()
            .map(|(key, value)| KeyValue::new(key.clone(), value.clone()))
            .collect();
        pairs.push(KeyValue::new(
            keys::UNITS.into(),
            units_json(&table.columns),
        ));
        let properties = WriterProperties::builder()
            .set_compression(Compression::ZSTD(ZstdLevel::try_new(3)?))
            .set_key_value_metadata(Some(pairs))
            .build();
        let mut bytes = Vec::new();
        let mut file =
            SerializedFileWriter::new(&mut bytes, Arc::new(schema), Arc::new(properties))?;
        let mut group = file.next_row_group()?;
        for cells in &table.cells {
            let mut column = group
                .next_column()?
                .ok_or_else(|| ParquetError::General("fewer columns than fields".into()))?;
            match cells {
                Cells::Numbers(cells) => {
                    let values: Vec<f64> = cells.iter().flatten().copied().collect();
                    let levels: Vec<i16> = cells.iter().map(|c| i16::from(c.is_some())).collect();
                    column
                        .typed::<DoubleType>()
                        .write_batch(&values, Some(&levels), None)?;
                }
                Cells::Words(cells) => {
                    let values: Vec<ByteArray> =
                        cells.iter().flatten().map(|s| s.as_str().into()).collect();
                    let levels: Vec<i16> = cells.iter().map(|c| i16::from(c.is_some())).collect();
                    column
                        .typed::<ByteArrayType>()
                        .write_batch(&values, Some(&levels), None)?;
                }
            }
            column.close()?;
        }
        group.close()?;
        file.close()?;
        Ok(bytes)
    }

    pub(super) fn table(path: &Path) -> Result<Table> {
        let file = std::fs::File::open(path)?;
        let reader = SerializedFileReader::new(file)?;
        let meta = reader.metadata().file_metadata();
        let units = meta
            .key_value_metadata()
            .and_then(|pairs| pairs.iter().find(|pair| pair.key == keys::UNITS))
            .and_then(|pair| serde_json::from_str(pair.value.as_deref()?).ok())
            .unwrap_or(serde_json::Value::Null);
        let mut table = Table::default();
        for column in meta.schema_descr().columns() {
            let cells = match column.physical_type() {
                Physical::DOUBLE => Cells::Numbers(Vec::new()),
                Physical::BYTE_ARRAY => Cells::Words(Vec::new()),
                other => return Err(ParquetError::General(format!("a column of {other}"))),
            };
            let unit = units[column.name()].as_str().unwrap_or("");
            table.push(Column::new(column.name(), unit, ""), cells);
        }
        for row in reader.get_row_iter(None)? {
            for (cells, (_, field)) in table.cells.iter_mut().zip(row?.get_column_iter()) {
                match (cells, field) {
                    (Cells::Numbers(cells), Field::Double(x)) => cells.push(Some(*x)),
                    (Cells::Numbers(cells), Field::Null) => cells.push(None),
                    (Cells::Words(cells), Field::Str(text)) => cells.push(Some(text.clone())),
                    (Cells::Words(cells), Field::Null) => cells.push(None),
                    (_, other) => return Err(ParquetError::General(format!("a cell of {other}"))),
                }
            }
        }
        Ok(table)
    }
}
