//! Parquet, written and read back; tests/python/check_parquet.py reads it with other programs.
#![cfg(feature = "parquet")]

use std::path::{Path, PathBuf};

use crate::common::{columns, names_in, numbered, write};
use brinell_io::{IoError, Metadata, Outcome, ParquetWriter, SignalFile, SignalWriter, keys, open};
use parquet::basic::Compression;
use parquet::data_type::{DoubleType, FloatType, Int64Type};
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;
use serde_json::{Value, json};

fn write_all(folder: &Path, rows: &[Vec<f64>], outcome: Outcome) -> PathBuf {
    let metadata = Metadata::default().with(keys::SCENARIO, "name = \"Prüfstand\"\n").with(keys::VERSION, "0.1.0");
    let columns = if rows[0].len() == 2 { columns() } else { numbered(rows[0].len()) };
    let mut writer = Box::new(ParquetWriter::create(folder.join("signals.parquet"), &columns, &metadata).unwrap());
    write(&mut *writer, rows).unwrap();
    writer.finish(outcome).unwrap()
}

fn units(file: &SignalFile) -> Vec<(&str, Option<&str>)> {
    file.channels().iter().map(|c| (c.name.as_str(), c.unit.as_deref())).collect()
}

#[test]
fn regress_parquet_carries_units_scenario_version_and_outcome() {
    let folder = tempfile::tempdir().unwrap();
    let rows = [vec![0.0, 1.0]];
    let mut file = open(write_all(folder.path(), &rows, Outcome::Partial("interrupted at 0.1 s".into()))).unwrap();
    assert_eq!(units(&file), [("t", Some("s")), ("outer_ax", Some("m/s^2"))]);
    assert_eq!(file.read("outer_ax").unwrap(), [1.0]);
    let get = |key| file.metadata().get(key).unwrap();
    assert_eq!(get(keys::SCENARIO), "name = \"Prüfstand\"\n");
    assert_eq!(get(keys::VERSION), "0.1.0");
    assert_eq!(get(keys::OUTCOME), "partial: interrupted at 0.1 s");
    // As values: the order of keys depends on a feature of serde_json that other crates of a build may turn on.
    let read = |key| serde_json::from_str::<Value>(get(key)).unwrap();
    let units = json!({ "t": "s", "outer_ax": "m/s^2" });
    assert_eq!(read(keys::UNITS), units);
    assert_eq!(read(keys::PANDAS_ATTRS), json!({ "units": units }));
    assert_eq!(read(keys::DESCRIPTIONS), json!({ "t": "time", "outer_ax": "outer ring \"along\" x" }));
    let file = open(write_all(folder.path(), &rows, Outcome::Complete)).unwrap();
    assert_eq!(file.metadata().get(keys::OUTCOME), Some("complete"));
}

#[test]
fn regress_a_table_without_rows_is_a_whole_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.parquet");
    let writer = Box::new(ParquetWriter::create(&path, &columns(), &Metadata::default()).unwrap());
    let mut file = open(writer.finish(Outcome::Complete).unwrap()).unwrap();
    assert_eq!(units(&file), [("t", Some("s")), ("outer_ax", Some("m/s^2"))]);
    assert!(file.read("t").unwrap().is_empty());
}

/// The memory for rows is that of one row group; this many columns and rows make several, the last one short.
#[test]
fn prop_row_groups_stay_within_their_memory() {
    let folder = tempfile::tempdir().unwrap();
    for (columns, rows) in [(400, 12_000), (1, 140_000)] {
        let table: Vec<Vec<f64>> = (0..rows).map(|i| vec![f64::from(i) * 0.1; columns]).collect();
        let path = write_all(folder.path(), &table, Outcome::Complete);
        let reader = SerializedFileReader::new(std::fs::File::open(&path).unwrap()).unwrap();
        let groups = reader.metadata().row_groups();
        assert!(groups.len() > 1);
        assert_eq!(groups.iter().map(|g| g.num_rows()).sum::<i64>(), i64::from(rows));
        for group in groups {
            assert!(group.num_rows() as usize * columns * 8 <= 16 << 20);
            let chunks = group.columns().iter();
            assert_eq!(chunks.clone().map(|c| c.compressed_size()).sum::<i64>(), group.compressed_size());
            assert_eq!(chunks.map(|c| c.uncompressed_size()).sum::<i64>(), group.total_byte_size());
        }
        let mut file = open(&path).unwrap();
        for column in [0, columns / 2, columns - 1] {
            let column = file.read(&format!("channel_{column}")).unwrap();
            assert!(column.len() == table.len() && column.iter().zip(&table).all(|(value, row)| *value == row[0]));
        }
    }
}

#[test]
fn regress_reserved_metadata_and_foreign_files_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.parquet");
    let metadata = Metadata::default().with(keys::UNITS, "{}");
    assert!(matches!(ParquetWriter::create(&path, &columns(), &metadata), Err(IoError::ReservedKey { .. })));
    assert!(names_in(folder.path()).is_empty());
    std::fs::write(&path, "t,x\n0,1\n").unwrap();
    assert!(matches!(open(&path), Err(IoError::Mislabelled { .. })));
}

/// As pandas writes it: Snappy, dictionaries, columns that may be empty, whole numbers.
#[test]
fn regress_parquet_of_others_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("theirs.parquet");
    let schema = parse_message_type("message m { optional double a; required int64 n; optional float f; }").unwrap();
    let properties = WriterProperties::builder().set_compression(Compression::SNAPPY).build();
    let file = std::fs::File::create(&path).unwrap();
    let mut writer = SerializedFileWriter::new(file, schema.into(), properties.into()).unwrap();
    let mut group = writer.next_row_group().unwrap();
    let mut column = group.next_column().unwrap().unwrap();
    column.typed::<DoubleType>().write_batch(&[1.5, 2.5], Some(&[1, 0, 1]), None).unwrap();
    column.close().unwrap();
    let mut column = group.next_column().unwrap().unwrap();
    column.typed::<Int64Type>().write_batch(&[7, 7, -8], None, None).unwrap();
    column.close().unwrap();
    let mut column = group.next_column().unwrap().unwrap();
    column.typed::<FloatType>().write_batch(&[0.25, 0.5, 4.0], Some(&[1, 1, 1]), None).unwrap();
    column.close().unwrap();
    group.close().unwrap();
    writer.close().unwrap();

    let mut file = open(&path).unwrap();
    let a = file.read("a").unwrap();
    assert!(a[0] == 1.5 && a[1].is_nan() && a[2] == 2.5);
    assert_eq!(file.read("n").unwrap(), [7.0, 7.0, -8.0]);
    assert_eq!(file.read("f").unwrap(), [0.25, 0.5, 4.0]);
}
