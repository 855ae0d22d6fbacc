//! Parquet, read: flat columns of numbers, from brinell or anyone else (plain, Snappy, Zstandard, gzip or LZ4). Nested
//! columns are listed and not read.

use std::io::{self, BufReader, Read, Seek, SeekFrom};

use parquet::basic::{Compression, ConvertedType, LogicalType, TimeUnit, Type};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::errors::ParquetError;
use parquet::file::metadata::{ColumnChunkMetaData, ParquetMetaData};
use parquet::file::reader::{ChunkReader, FileReader, Length, SerializedFileReader};
use parquet::schema::types::{ColumnDescPtr, ColumnDescriptor};

use super::channel::{Channel, Rate, RateSource, lend_units};
use super::contents::Contents;
use super::fault::{Fault, damaged, unsupported};
use super::listing::{Listing, Source};
use super::numbers::{Number, Sink, give, half};
use crate::{Metadata, keys};

/// Values requested at a time.
const BATCH: usize = 64 << 10;

/// A file that ends: the crate takes the length of a read from the file's own claims and waits at the end for bytes to
/// come.
struct Bounded(Contents);

/// Reads on after the end are errors.
struct UntilEnd(Contents);

impl Read for UntilEnd {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        match self.0.read(buffer)? {
            0 if !buffer.is_empty() => Err(io::ErrorKind::UnexpectedEof.into()),
            count => Ok(count),
        }
    }
}

impl Length for Bounded {
    fn len(&self) -> u64 {
        self.0.length()
    }
}

impl ChunkReader for Bounded {
    type T = BufReader<UntilEnd>;

    fn get_read(&self, start: u64) -> Result<Self::T, ParquetError> {
        let mut contents = self.0.clone();
        contents.seek(SeekFrom::Start(start))?;
        Ok(BufReader::new(UntilEnd(contents)))
    }

    fn get_bytes(&self, start: u64, length: usize) -> Result<bytes::Bytes, ParquetError> {
        if length as u64 > self.0.length().saturating_sub(start) {
            return Err(ParquetError::EOF("a page points outside the file".into()));
        }
        let mut contents = self.0.clone();
        contents.seek(SeekFrom::Start(start))?;
        let mut bytes = vec![0; length];
        contents.read_exact(&mut bytes)?;
        Ok(bytes.into())
    }
}

/// A plain list is named after its column, what lies deeper by its path.
fn name_of(column: &ColumnDescriptor) -> String {
    match column.path().parts() {
        [name, list, _] if list == "list" => name.clone(),
        [name] => name.clone(),
        _ => column.path().string(),
    }
}

/// Why a column is not read, to follow its name; `None` where it is.
fn unreadable(about: &ParquetMetaData, index: usize) -> Option<String> {
    let column = about.file_metadata().schema_descr().column(index);
    if column.max_rep_level() > 0 {
        let name = column.path().parts().first()?;
        return Some(format!(
            "is nested, a list in each row, which is not supported here: save one row as a table of its own, such as \
             pandas.DataFrame({{\"{name}\": table[\"{name}\"][0]}})"
        ));
    }
    if column.path().parts().len() > 1 {
        return Some("is nested, which is not supported here: save it as a flat column".into());
    }
    if stored(&column).is_none() {
        return Some(match (column.physical_type(), column.logical_type_ref()) {
            (Type::BYTE_ARRAY, Some(LogicalType::String)) => "does not hold numbers".into(),
            (physical, _) => {
                format!("is of the type {physical}, which is not supported here: save it as double")
            }
        });
    }
    let packed = about.row_groups().iter().find_map(|group| match group.column(index).compression() {
        Compression::BROTLI(_) => Some("Brotli"),
        Compression::LZO => Some("LZO"),
        _ => None,
    })?;
    Some(format!(
        "is compressed with {packed}, which is not supported here: save the file with zstd, snappy, lz4 or gzip"
    ))
}

/// What the numbers of a column are stored as; `None` where it does not hold numbers that are read.
fn stored(column: &ColumnDescriptor) -> Option<(Number, &'static str)> {
    let number = match column.physical_type() {
        Type::DOUBLE => Number::F64,
        Type::FLOAT => Number::F32,
        Type::INT32 | Type::INT64 if decimals(column).is_some() => {
            return Some((Number::F64, "decimal"));
        }
        Type::INT32 if is_unsigned(column) => Number::U32,
        Type::INT32 => Number::I32,
        Type::INT64 if is_unsigned(column) => Number::U64,
        Type::INT64 => Number::I64,
        Type::FIXED_LEN_BYTE_ARRAY => match (column.logical_type_ref(), column.type_length()) {
            (Some(LogicalType::Float16), 2) => Number::F16,
            (_, 1..=16) if decimals(column).is_some() => return Some((Number::F64, "decimal")),
            _ => return None,
        },
        _ => return None,
    };
    Some((number, number.name()))
}

/// The unit that a column's type has, of times.
fn time_unit(column: &ColumnDescriptor) -> Option<&'static str> {
    let unit = match (column.logical_type_ref(), column.converted_type()) {
        (Some(LogicalType::Timestamp(time) | LogicalType::Time(time)), _) => &time.unit,
        (None, ConvertedType::TIMESTAMP_MILLIS | ConvertedType::TIME_MILLIS) => &TimeUnit::MILLIS,
        (None, ConvertedType::TIMESTAMP_MICROS | ConvertedType::TIME_MICROS) => &TimeUnit::MICROS,
        _ => return None,
    };
    Some(match unit {
        TimeUnit::MILLIS => "ms",
        TimeUnit::MICROS => "us",
        TimeUnit::NANOS => "ns",
    })
}

/// Decimal places of a column of decimals.
fn decimals(column: &ColumnDescriptor) -> Option<i32> {
    match column.logical_type_ref() {
        Some(LogicalType::Decimal(decimal)) => Some(decimal.scale),
        None if column.converted_type() == ConvertedType::DECIMAL => Some(column.type_scale()),
        _ => None,
    }
}

fn is_unsigned(column: &ColumnDescriptor) -> bool {
    match column.logical_type_ref() {
        Some(LogicalType::Integer(integer)) => !integer.is_signed,
        Some(_) => false,
        None => matches!(column.converted_type(), ConvertedType::UINT_32 | ConvertedType::UINT_64),
    }
}

/// An integer of up to 16 bytes, the highest first, in two's complement.
fn integer(bytes: &[u8]) -> i128 {
    let negative = bytes.first().is_some_and(|byte| byte & 0x80 != 0);
    let start = if negative { -1 } else { 0 };
    bytes.iter().fold(start, |sum, byte| sum << 8 | i128::from(*byte))
}

type Take<'a> = &'a mut dyn FnMut(&[f64]) -> Result<(), ParquetError>;

/// Hands on the values of one column, a batch at a time.
fn column_pieces(reader: &SerializedFileReader<Bounded>, index: usize, take: Take<'_>) -> Result<(), ParquetError> {
    let column = reader.metadata().file_metadata().schema_descr().column(index);
    let unit = decimals(&column).map_or(1.0, |places| 10_f64.powi(places));
    let is_unsigned = is_unsigned(&column);
    for group in 0..reader.num_row_groups() {
        let group = reader.get_row_group(group)?;
        match group.get_column_reader(index)? {
            ColumnReader::DoubleColumnReader(r) => pieces(r, take, |v| v)?,
            ColumnReader::FloatColumnReader(r) => pieces(r, take, f64::from)?,
            ColumnReader::Int32ColumnReader(r) if is_unsigned => {
                pieces(r, take, |v| f64::from(v as u32))?;
            }
            ColumnReader::Int32ColumnReader(r) => pieces(r, take, |v| f64::from(v) / unit)?,
            ColumnReader::Int64ColumnReader(r) if is_unsigned => {
                pieces(r, take, |v| v as u64 as f64)?;
            }
            ColumnReader::Int64ColumnReader(r) => pieces(r, take, |v| v as f64 / unit)?,
            ColumnReader::FixedLenByteArrayColumnReader(r) if decimals(&column).is_some() => {
                pieces(r, take, |v| integer(v.data()) as f64 / unit)?;
            }
            ColumnReader::FixedLenByteArrayColumnReader(r) => pieces(r, take, |v| match v.data() {
                [low, high] => half(u16::from_le_bytes([*low, *high])),
                _ => f64::NAN,
            })?,
            _ => {
                return Err(ParquetError::NYI(format!("`{}` does not hold numbers", name_of(&column))));
            }
        }
    }
    Ok(())
}

/// Every column chunk must lie within the file: the crate asserts it where we can still say it.
fn check_chunks(metadata: &ParquetMetaData, file_bytes: u64) -> Result<(), ParquetError> {
    let inside = |chunk: &ColumnChunkMetaData| {
        let start = chunk.dictionary_page_offset().unwrap_or(chunk.data_page_offset());
        let end = start.checked_add(chunk.compressed_size())?;
        (start >= 0 && start <= end && u64::try_from(end).ok()? <= file_bytes).then_some(())
    };
    let mut chunks = metadata.row_groups().iter().flat_map(|group| group.columns());
    match chunks.find(|chunk| inside(chunk).is_none()) {
        Some(chunk) => Err(ParquetError::General(format!("column `{}` points outside the file", chunk.column_path()))),
        None => Ok(()),
    }
}

fn pieces<T: DataType>(
    mut reader: ColumnReaderImpl<T>,
    take: Take<'_>,
    convert: impl Fn(T::T) -> f64,
) -> Result<(), ParquetError> {
    let (mut present, mut values, mut piece) = (Vec::new(), Vec::new(), Vec::new());
    loop {
        present.clear();
        values.clear();
        piece.clear();
        let (rows, ..) = reader.read_records(BATCH, Some(&mut present), None, &mut values)?;
        if rows == 0 {
            return Ok(());
        }
        if present.is_empty() {
            piece.extend(values.drain(..).map(&convert));
        } else {
            let mut values = values.drain(..);
            let value = |&level: &i16| {
                if level > 0 { values.next().map_or(f64::NAN, &convert) } else { f64::NAN }
            };
            piece.extend(present.iter().map(value));
        }
        take(&piece)?;
    }
}

struct Table(SerializedFileReader<Bounded>);

impl From<ParquetError> for Fault {
    fn from(error: ParquetError) -> Self {
        match error {
            ParquetError::NYI(why) => unsupported(why),
            _ => damaged(error.to_string()),
        }
    }
}

/// An error where a column reaches outside the file.
pub(super) fn list(contents: Contents) -> Result<Listing, Fault> {
    let file_bytes = contents.length();
    let reader = SerializedFileReader::new(Bounded(contents))?;
    let about = reader.metadata();
    check_chunks(about, file_bytes)?;
    let pairs = about.file_metadata().key_value_metadata().into_iter().flatten();
    let metadata = Metadata { pairs: pairs.map(|kv| (kv.key.clone(), kv.value.clone().unwrap_or_default())).collect() };
    let rows: i64 = about.row_groups().iter().map(|g| g.num_rows().max(0)).sum();
    let rate = metadata.sample_rate().map(|hz| Rate { hz, source: RateSource::Header(keys::SAMPLE_RATE_HZ.into()) });
    let channel = |(i, column): (usize, &ColumnDescPtr)| {
        let (number, name) = stored(column).unwrap_or((Number::F64, "other"));
        let mut channel = Channel::array(name_of(column), vec![rows as u64], number);
        channel.stored_as = name;
        channel.unreadable = unreadable(about, i);
        channel.rate.clone_from(&rate);
        channel
    };
    let columns = about.file_metadata().schema_descr().columns().iter();
    let mut channels: Vec<Channel> = columns.enumerate().map(channel).collect();
    lend_units(&mut channels, &metadata, keys::UNITS);
    for (channel, column) in channels.iter_mut().zip(about.file_metadata().schema_descr().columns()) {
        channel.unit = channel.unit.take().or_else(|| time_unit(column).map(str::to_owned));
    }
    Ok(Listing { channels, metadata, source: Box::new(Table(reader)) })
}

impl Source for Table {
    fn stream(&mut self, index: usize, sink: Sink<'_>) -> Result<(), Fault> {
        let mut stopped = false;
        let result = column_pieces(&self.0, index, &mut |piece| {
            give(sink, piece).map_err(|_| {
                stopped = true;
                ParquetError::EOF("stopped".into())
            })
        });
        if stopped {
            return Err(Fault::Stopped);
        }
        Ok(result?)
    }
}
